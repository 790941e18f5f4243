//! The command line as its user sees it: exit status, results, the unit and its library.

#[path = "support/command.rs"]
mod command;
#[path = "support/unit.rs"]
mod unit;

use command::{brinell, cache, contents, empty_folder, output, run, scene};
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::thread;

/// The bytes of a unit of the default scene, exported under other circumstances.
#[track_caller]
fn exported(circumstances: impl FnOnce(&mut Command) -> &mut Command) -> Vec<u8> {
    let folder = empty_folder();
    let mut command = brinell(folder.path());
    command.arg("export").arg(scene("steel_ball"));
    circumstances(&mut command);
    output(&mut command).with_status(0);
    fs::read(folder.path().join("steel_ball.fmu")).expect("NAME.fmu in the current folder")
}

/// `assert_eq` would print both archives.
#[track_caller]
fn assert_same(left: &[u8], right: &[u8]) {
    let first = left.iter().zip(right).position(|(left, right)| left != right);
    assert!(left == right, "{} and {} bytes, different from byte {first:?} on", left.len(), right.len());
}

#[test]
fn a_wrong_call_ends_with_2_and_shows_the_usage() {
    let folder = empty_folder();
    for arguments in
        [&["export"][..], &["exprt"], &["check"], &["export", "a", "b"], &["--colour"], &["check", "-o", "x"]]
    {
        let run = run(folder.path(), arguments).with_status(2);
        assert!(run.err.contains("Usage:") && run.out.is_empty(), "{arguments:?}: {run:#?}");
    }
    assert!(contents(folder.path()).is_empty());
}

#[test]
fn help_and_version_go_to_standard_output() {
    let folder = empty_folder();
    let help = run(folder.path(), ["--help"]).with_status(0);
    assert!(help.out.contains("export") && help.out.contains("check") && help.err.is_empty(), "{help:#?}");
    let version = run(folder.path(), ["--version"]).with_status(0);
    assert_eq!(version.out.trim(), concat!("brinell ", env!("CARGO_PKG_VERSION")));
}

#[test]
fn without_arguments_the_default_scene_is_exported_and_checked() {
    let folder = empty_folder();
    let run = run(folder.path(), [] as [&str; 0]).with_status(0);
    assert_eq!(contents(folder.path()), ["steel_ball.fmu"]);
    for part in ["steel_ball.fmu", "predicted", "simulated", "largest force", "restitution", "they agree"] {
        assert!(run.out.contains(part), "nothing of {part:?} in {run:#?}");
    }
}

#[test]
fn the_same_scene_gives_the_same_bytes() {
    assert_same(&exported(|command| command), &exported(|command| command));
}

#[test]
fn the_cache_does_not_show_in_the_unit() {
    let other = empty_folder();
    assert_same(
        &exported(|command| command),
        &exported(|command| command.env("BRINELL_CACHE", other.path().join("new"))),
    );
}

#[test]
fn the_folder_of_temporary_files_does_not_show_in_the_unit() {
    let other = empty_folder();
    assert_same(&exported(|command| command), &exported(|command| command.env("TMPDIR", other.path())));
    assert!(contents(other.path()).is_empty(), "temporary files were left");
}

/// Whoever builds for the own processor, or without optimization, says so for the own programs, not for units.
#[test]
fn the_users_compiler_settings_do_not_show_in_the_unit() {
    // a cache of its own, so that what these settings leave there meets no other test
    let own = empty_folder();
    let exported_with =
        |name: &str, value: &str| exported(|command| command.env("BRINELL_CACHE", own.path()).env(name, value));
    let plain = exported(|command| command);
    let settings = [
        ("RUSTFLAGS", "-Ctarget-cpu=native -Cdebuginfo=2"),
        ("CARGO_BUILD_RUSTFLAGS", "-Copt-level=0"),
        ("CARGO_PROFILE_RELEASE_OPT_LEVEL", "0"),
        ("CARGO_PROFILE_RELEASE_DEBUG", "true"),
        ("CARGO_INCREMENTAL", "1"),
        ("CARGO_BUILD_INCREMENTAL", "true"),
        ("RUSTC_BOOTSTRAP", "1"),
    ];
    let different: Vec<_> = settings.iter().filter(|(name, value)| exported_with(name, value) != plain).collect();
    assert!(different.is_empty(), "these change the unit: {different:?}");
}

/// A user's own `.cargo/config.toml` stands before the profile of a package.
#[test]
fn the_users_cargo_configuration_does_not_show_in_the_unit() {
    let (user, own) = (empty_folder(), empty_folder());
    fs::create_dir_all(user.path().join("temporary")).unwrap();
    fs::create_dir_all(user.path().join(".cargo")).unwrap();
    let configuration = "[profile.release]\nopt-level = 1\nlto = false\n";
    fs::write(user.path().join(".cargo/config.toml"), configuration).unwrap();
    // cargo looks for it in all folders above the one that it works in
    let temporary = user.path().join("temporary");
    let unit = exported(|command| command.env("TMPDIR", temporary).env("BRINELL_CACHE", own.path()));
    assert_same(&unit, &exported(|command| command));
}

/// One takes the library out of the cache, the other removes it there.
#[test]
fn exports_of_one_scene_at_the_same_time_do_not_disturb_each_other() {
    let plain = exported(|command| command);
    for _ in 0..3 {
        thread::scope(|scope| {
            let exports: Vec<_> = (0..4).map(|_| scope.spawn(|| exported(|command| command))).collect();
            for export in exports {
                assert_same(&plain, &export.join().expect("an export at the same time as others"));
            }
        });
    }
}

/// A unit is some ten kilobytes, but every change of a parameter makes a new one.
#[test]
fn units_do_not_pile_up_in_the_cache() {
    let own = empty_folder();
    exported(|command| command.env("BRINELL_CACHE", own.path()));
    let mut folders = vec![own.path().to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            assert_ne!(path.extension(), Some(OsStr::new("so")), "{} is left", path.display());
            if path.is_dir() {
                folders.push(path);
            }
        }
    }
}

#[test]
fn every_scene_is_exported_and_agrees_with_its_prediction() {
    for path in unit::scenes() {
        let folder = empty_folder();
        let export =
            run(folder.path(), [OsStr::new("--json"), OsStr::new("export"), path.as_os_str()]).with_status(0).json();
        let unit = export["fmu"].as_str().expect("the path of the unit");
        assert_eq!(contents(folder.path()), [unit]);
        assert_eq!(fs::metadata(folder.path().join(unit)).unwrap().len(), export["size"].as_u64().unwrap());
        let check = run(folder.path(), ["check", unit, "--json"]).with_status(0).json();
        assert_eq!(check["passed"], true, "{check}");
        // a rate-dependent law leaves no dent to compare
        let rows = if unit == "damped.fmu" { 4 } else { 5 };
        let contacts = check["contacts"].as_array().cloned().unwrap_or_else(|| vec![check.clone()]);
        for contact in contacts {
            assert_eq!(contact["rows"].as_array().expect("rows").len(), rows, "{check}");
        }
        assert_eq!(check["variables"], export["variable_count"]);
    }
}

/// Everything that there is stands on one side or the other.
#[test]
fn what_a_unit_has_and_what_was_left_out_of_it_is_everything_there_is() {
    let folder = empty_folder();
    let list =
        |value: &serde_json::Value| -> BTreeSet<String> { serde_json::from_value(value.clone()).expect("names") };
    let told = |name: &str| {
        let scene = scene(name).display().to_string();
        run(folder.path(), ["export", &scene, "--json"]).with_status(0).json()
    };
    let [default, everything, elastic] = ["steel_ball", "everything", "elastic"].map(told);
    let all = |unit: &serde_json::Value| &list(&unit["variables"]) | &list(&unit["left_out"]);
    assert_eq!(all(&default), all(&everything));
    assert_eq!(all(&default), all(&elastic));
    for unit in [&default, &everything, &elastic] {
        assert!(list(&unit["variables"]).is_disjoint(&list(&unit["left_out"])), "{unit}");
        assert!(list(&unit["constants"]).is_subset(&list(&unit["left_out"])), "{unit}");
        assert!(list(&unit["absent"]).is_disjoint(&list(&unit["constants"])), "{unit}");
    }
    let laws = run(folder.path(), ["laws", "--json"]).with_status(0).json();
    let known = |kind: &str| -> BTreeSet<String> {
        laws[kind].as_array().unwrap().iter().map(|law| law["name"].as_str().unwrap().to_string()).collect()
    };
    let but = |kind: &str, name: &str| &known(kind) - &BTreeSet::from([name.to_string()]);
    let left_out = &default["left_out_laws"];
    assert_eq!(list(&left_out["loading"]), but("loading", "big-alabo"));
    assert_eq!(list(&left_out["unloading"]), but("unloading", "contact-radius"));
    assert_eq!(list(&elastic["left_out_laws"]["unloading"]), known("unloading"), "an elastic contact has no unloading");
    assert!(list(&elastic["absent"]).contains("target.yield_strength"), "{elastic}");
    assert!(list(&elastic["constants"]).contains("impactor.radius"), "{elastic}");
}

/// Letters of any language, quotation marks, tabs and line ends, and the words that stand for the GUID until it is known.
#[test]
fn a_description_of_any_other_characters_is_exported_and_checked() {
    let folder = empty_folder();
    let description = r#"Kugelsto\u00df \u2014 \u7403 \U0001f600 \ufffd <&>' \t\r\n \"GUID to come\""#;
    let text = fs::read_to_string(scene("elastic")).unwrap();
    let (before, after) = text.split_once("glass bead on a glass plate, elastic").expect("its description");
    fs::write(folder.path().join("scene.toml"), format!("{before}{description}{after}")).unwrap();
    run(folder.path(), ["export", "scene.toml"]).with_status(0);
    run(folder.path(), ["check", "elastic.fmu"]).with_status(0);
}

#[test]
fn json_has_the_keys_that_programs_read() {
    let folder = empty_folder();
    let keys = |json: &serde_json::Value| json.as_object().expect("an object").keys().cloned().collect::<BTreeSet<_>>();
    let export = run(folder.path(), ["export", scene("steel_ball").to_str().unwrap(), "--json"]).with_status(0).json();
    let left_out = ["left_out", "left_out_laws", "left_out_features", "absent", "constants"];
    for key in ["fmu", "guid", "size", "library_size", "imports", "variables", "variable_count"].iter().chain(&left_out)
    {
        assert!(keys(&export).contains(*key), "no {key} in {export}");
    }
    let check = run(folder.path(), ["check", "steel_ball.fmu", "--json"]).with_status(0).json();
    for key in ["fmu", "platforms", "variables", "impact", "step", "rows", "wrong_starts", "passed"] {
        assert!(keys(&check).contains(key), "no {key} in {check}");
    }
    for key in ["quantity", "unit", "predicted", "simulated", "difference"] {
        assert!(keys(&check["rows"][0]).contains(key), "no {key} in {check}");
    }
    let materials = run(folder.path(), ["materials", "--json"]).with_status(0).json();
    assert!(materials[0]["youngs_modulus"].as_f64().is_some_and(|modulus| modulus > 1e9), "{materials}");
}

/// The source tree holds the constants of the default scene, so that the library can be built and tested without export.
#[test]
fn the_constants_in_the_source_are_those_of_the_default_scene() {
    let folder = empty_folder();
    let constants = run(folder.path(), ["constants", scene("steel_ball").to_str().unwrap()]).with_status(0);
    let source = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/scene/exported.rs")).unwrap();
    assert!(constants.out == source, "src/scene/exported.rs is not what the exporter writes:\n{}", constants.out);
}

#[test]
fn a_unit_is_written_to_the_place_asked_for_and_replaces_an_older_one() {
    let folder = empty_folder();
    fs::create_dir(folder.path().join("units")).unwrap();
    fs::write(folder.path().join("units/ball.fmu"), "an older unit").unwrap();
    let source = scene("steel_ball");
    let run = run(folder.path(), ["export", source.to_str().unwrap(), "-o", "units/ball.fmu"]).with_status(0);
    assert!(run.out.starts_with("units/ball.fmu\n"), "{run:#?}");
    assert_eq!(contents(folder.path()), ["units"]);
    assert_eq!(contents(&folder.path().join("units")), ["ball.fmu"]);
    assert_same(&fs::read(folder.path().join("units/ball.fmu")).unwrap(), &exported(|command| command));
}

#[test]
fn an_output_that_cannot_be_written_is_named() {
    let folder = empty_folder();
    fs::write(folder.path().join("file"), "").unwrap();
    fs::create_dir(folder.path().join("folder.fmu")).unwrap();
    // a folder without write permission would stop everyone but the superuser, as whom containers run; these stop all
    for path in ["missing/unit.fmu", "file/unit.fmu", "folder.fmu"] {
        let run = run(folder.path(), ["export", scene("steel_ball").to_str().unwrap(), "-o", path]).with_status(1);
        assert!(run.err.contains(&format!("brinell: {path}: ")) && run.out.is_empty(), "{run:#?}");
        assert_eq!(contents(folder.path()), ["file", "folder.fmu"], "files were left");
    }
}

#[test]
fn a_cache_that_is_a_file_is_named() {
    let folder = empty_folder();
    let file = folder.path().join("cache");
    fs::write(&file, "").unwrap();
    let mut command = brinell(folder.path());
    let run = output(command.arg("export").arg(scene("steel_ball")).env("BRINELL_CACHE", &file)).with_status(1);
    assert!(run.err.contains(file.to_str().unwrap()), "{run:#?}");
    assert_eq!(contents(folder.path()), ["cache"], "files were left");
}

/// cargo runs in a folder of its own, so that a relative path would mean another place there.
#[test]
fn a_relative_cache_is_relative_to_the_current_folder() {
    let folder = empty_folder();
    let mut command = brinell(folder.path());
    output(command.arg("export").arg(scene("elastic")).env("BRINELL_CACHE", "own cache")).with_status(0);
    assert_eq!(contents(folder.path()), ["elastic.fmu", "own cache"]);
}

#[test]
fn without_a_rust_toolchain_the_message_says_where_to_get_one() {
    let folder = empty_folder();
    let mut command = brinell(folder.path());
    command.arg("export").arg(scene("steel_ball")).env_remove("CARGO").env("PATH", folder.path());
    let run = output(&mut command).with_status(1);
    assert!(run.err.contains("cargo") && run.err.contains("rustup.rs"), "{run:#?}");
    assert!(contents(folder.path()).is_empty(), "files were left");
    assert!(cache().ends_with("cache"), "the tests' own cache");
}
