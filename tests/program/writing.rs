//! What the program writes, and where: links, devices, protected files, full disks, closed pipes, and unusual paths.
#![cfg(target_os = "linux")]

use crate::command::{brinell, compile, contents, empty_folder, output, run, scene, settled};
use brinell_testing::folder::{Folder, arguments};
use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The arguments that write the default scene's curve to `goal`.
fn curve_to(goal: &str) -> [String; 4] {
    ["curve".into(), scene("steel_ball").display().to_string(), "-o".into(), goal.into()]
}

#[test]
fn a_symbolic_link_stays_and_its_target_is_written() {
    let folder = empty_folder();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("deep")).unwrap();
    fs::write(path("deep/old.csv"), "old").unwrap();
    // a chain of links, and one to a missing file
    symlink("deep/old.csv", path("middle.csv")).unwrap();
    symlink("middle.csv", path("link.csv")).unwrap();
    symlink("deep/new.csv", path("dangling.csv")).unwrap();
    for (link, target) in [("link.csv", "deep/old.csv"), ("dangling.csv", "deep/new.csv")] {
        run(folder.path(), curve_to(link)).with_status(0);
        assert!(fs::symlink_metadata(path(link)).unwrap().is_symlink(), "{link} was replaced");
        assert!(fs::symlink_metadata(path(target)).unwrap().is_file());
        assert!(fs::read_to_string(path(target)).unwrap().len() > 1000, "{target} wasn't written");
    }
    assert_eq!(contents(folder.path()).len(), 4, "nothing else is there");
    symlink("round.csv", path("round.csv")).unwrap();
    let refused = run(folder.path(), curve_to("round.csv")).with_status(1);
    assert!(refused.err.contains("round.csv") && refused.err.contains("symbolic links"), "{}", refused.err);
}

#[test]
fn a_scene_is_not_replaced_by_its_fmu() {
    let folder = Folder::of_scene("steel_ball");
    let before = folder.read("scene.toml");
    symlink("scene.toml", folder.at("link.fmu")).unwrap();
    for goal in ["scene.toml", "./scene.toml", "link.fmu"] {
        let refused = folder.call(&format!("export scene.toml -o {goal}")).with_status(1);
        assert!(refused.err.contains(goal) && refused.err.contains("the scene itself"), "{}", refused.err);
        assert!(folder.read("scene.toml") == before, "{goal}: the scene was overwritten");
    }
}

/// The name of an FMU, and of a system, is that of the scene, which two scene files may share.
#[test]
fn an_fmu_of_another_scene_is_replaced_only_where_it_is_named() {
    for (command, what, name) in [("export", "FMU", "steel_ball.fmu"), ("ssp", "system", "steel_ball.ssp")] {
        let text = fs::read_to_string(scene("steel_ball")).unwrap();
        let with = |speed: &str| text.replace("speed = 1.0", &format!("speed = {speed}"));
        assert_ne!(with("2.0"), text);
        let folder = Folder::with(&[("one.toml", &with("2.0")), ("two.toml", &with("3.0"))]);
        let (one, two) = (format!("{command} one.toml"), format!("{command} two.toml"));
        folder.call(&one).with_status(0);
        folder.call(&one).with_status(0);
        // a new text of the same scene
        folder.write("one.toml", &with("2.5"));
        folder.call(&one).with_status(0);
        let before = fs::read(folder.at(name)).unwrap();
        let refused = folder.call(&two).with_status(1).err;
        assert!(refused.starts_with(&format!("brinell: {name}: this is the {what} of ./one.toml")), "{refused}");
        assert!(refused.contains("-o FILE") && !refused.contains("building"), "{refused}");
        assert!(fs::read(folder.at(name)).unwrap() == before);
        folder.call(&format!("{two} -o {name}")).with_status(0);
        assert!(fs::read(folder.at(name)).unwrap() != before);
        folder.write(name, "of another program");
        let refused = folder.call(&two).with_status(1).err;
        assert!(refused.starts_with(&format!("brinell: {name}: this is no {what} of a scene")), "{refused}");
        assert_eq!(folder.read(name), "of another program");
        folder.write(name, &text);
        let refused = folder.call(&format!("{command} {name} -o {name}")).with_status(1).err;
        assert!(refused.contains("the scene itself"), "{refused}");
    }
}

#[test]
fn a_goal_that_can_never_be_written_is_refused_before_any_work() {
    let folder = Folder::of_scene("steel_ball");
    let long = |ending: &str| format!("{}.{ending}", "x".repeat(300));
    for (command, goal, said) in [
        ("export", long("fmu"), "File name too long"),
        ("ssp", long("ssp"), "File name too long"),
        ("curve", long("csv"), "File name too long"),
        ("report", long("d"), "File name too long"),
        ("export", "/dev/full".into(), "there is no space left on this device"),
    ] {
        let refused = folder.call(&format!("{command} scene.toml -o {goal}")).with_status(1);
        assert!(refused.err.contains(said) && !refused.err.contains("building"), "{command}: {}", refused.err);
    }
    assert_eq!(folder.names(), ["scene.toml"]);
}

#[test]
fn a_file_name_gives_no_commands_to_the_terminal() {
    const NAME: &str = "b\u{1b}[2J\u{9b}31m\nbrinell: x";
    let folder = empty_folder();
    let path = |ending: &str| format!("{NAME}.{ending}");
    fs::copy(scene("steel_ball"), folder.path().join(path("toml"))).unwrap();
    fs::write(folder.path().join(path("bad")), "name = 1").unwrap();
    let calls = [
        vec!["export".into(), path("toml"), "-o".into(), path("fmu")],
        vec!["check".into(), path("fmu")],
        vec!["ssp".into(), path("toml"), "-o".into(), path("ssp")],
        vec!["predict".into(), path("toml"), "--time-history".into(), path("csv")],
        vec!["new".into(), "ball".into(), "-o".into(), path("new")],
        vec!["new".into(), "ball".into(), "-o".into(), path("new")],
        vec!["export".into(), path("bad")],
        vec!["check".into(), path("none")],
        vec![path("command")],
    ];
    for call in calls {
        for json in [false, true] {
            let mut command = brinell(folder.path());
            let ended = command.args(&call).args(json.then_some("--json")).output().expect("the program");
            let [out, err] = [ended.stdout, ended.stderr].map(|text| String::from_utf8(text).unwrap());
            let said = out.clone() + &err;
            assert!(!said.contains(|c: char| c.is_control() && c != '\n'), "{call:?} {json}: {said:?}");
            // in JSON, which is for programs, the name is whole
            if json && !out.is_empty() {
                let answer: serde_json::Value = serde_json::from_str(&out).expect("JSON");
                let written = |value: &serde_json::Value| value.as_str().is_some_and(|text| text.starts_with(NAME));
                assert!(answer.as_object().expect("an object").values().any(written), "{call:?}: {answer}");
            }
            // nor does it begin a message of its own
            assert!(
                !said.is_empty() && (call.len() == 1 || !said.contains("\nbrinell: x")),
                "{call:?} {json}: {said:?}"
            );
        }
    }
}

#[test]
fn a_pipe_is_written_to_and_not_replaced() {
    let folder = empty_folder();
    let pipe = folder.path().join("pipe.csv");
    output(Command::new("mkfifo").arg(&pipe)).with_status(0);
    let reader = Command::new("cat").arg(&pipe).stdout(Stdio::piped()).spawn().expect("cat");
    run(folder.path(), curve_to("pipe.csv")).with_status(0);
    let read = reader.wait_with_output().expect("a child").stdout;
    assert!(read.len() > 1000, "{} bytes came through", read.len());
    assert!(fs::symlink_metadata(&pipe).unwrap().file_type().is_fifo(), "the pipe was replaced");
    assert_eq!(contents(folder.path()), ["pipe.csv"]);
}

#[test]
fn an_fmu_on_standard_output_is_followed_by_nothing() {
    let folder = empty_folder();
    let goal = folder.path().join("piped.fmu");
    let mut command = brinell(folder.path());
    command.args(["export".into(), scene("steel_ball").display().to_string(), "-o".into(), "/dev/stdout".into()]);
    let piped = command.stdin(Stdio::null()).output().expect("the program");
    assert!(piped.status.success(), "{piped:?}");
    fs::write(&goal, &piped.stdout).unwrap();
    compile(folder.path(), ["export", &scene("steel_ball").display().to_string()]).with_status(0);
    assert!(fs::read(&goal).unwrap() == fs::read(folder.path().join("steel_ball.fmu")).unwrap());
}

/// The permissions of `path`.
fn mode(path: &Path) -> u32 {
    fs::metadata(path).expect("it was written").permissions().mode() & 0o777
}

#[test]
fn a_new_file_has_the_permissions_of_the_umask_and_an_old_one_keeps_its_own() {
    for (umask, expected) in [("022", 0o644), ("077", 0o600), ("002", 0o664), ("000", 0o666)] {
        let folder = empty_folder();
        let goal = folder.path().join("curve.csv");
        let script = format!("umask {umask}; exec \"$@\"");
        let write = || {
            let mut command = Command::new("sh");
            settled(command.current_dir(folder.path())).args(["-c", &script, "sh", env!("CARGO_BIN_EXE_brinell")]);
            output(command.args(curve_to("curve.csv"))).with_status(0);
        };
        write();
        assert_eq!(mode(&goal), expected, "umask {umask}");
        fs::set_permissions(&goal, fs::Permissions::from_mode(0o640)).unwrap();
        write();
        assert_eq!(mode(&goal), 0o640, "umask {umask}");
    }
}

#[test]
fn a_read_only_file_is_refused_before_any_work_and_stays() {
    let folder = Folder::of_scene("steel_ball");
    for (command, goal) in [("export", "old.fmu"), ("curve", "old.csv")] {
        folder.write(goal, "old");
        fs::set_permissions(folder.at(goal), fs::Permissions::from_mode(0o444)).unwrap();
        let refused = folder.call(&format!("{command} scene.toml -o {goal}")).with_status(1);
        assert!(refused.err.starts_with(&format!("brinell: {goal}: this file is read-only")), "{}", refused.err);
        assert_eq!(folder.read(goal), "old");
    }
}

/// Runs the program with a pipe that nobody reads.
fn without_reader(folder: &Path, call: &str, of_errors: bool) -> Option<i32> {
    let mut command = brinell(folder);
    command.args(arguments(call)).stdin(Stdio::null());
    if of_errors {
        command.stdout(Stdio::null()).stderr(Stdio::piped())
    } else {
        command.stdout(Stdio::piped()).stderr(Stdio::null())
    };
    let mut child = command.spawn().expect("the program");
    drop((child.stdout.take(), child.stderr.take()));
    child.wait().expect("a child").code()
}

#[test]
fn a_closed_pipe_ends_quietly_and_the_work_is_done() {
    let folder = Folder::of_scene("steel_ball");
    for of_errors in [false, true] {
        let ended = |call: &str| without_reader(folder.path(), call, of_errors);
        let _ = fs::remove_file(folder.at("steel_ball.fmu"));
        assert_eq!(ended("export scene.toml"), Some(0), "of errors: {of_errors}");
        assert!(folder.at("steel_ball.fmu").is_file(), "of errors: {of_errors}");
        for call in ["laws", "predict scene.toml", "check steel_ball.fmu", "completions zsh"] {
            assert_eq!(ended(call), Some(0), "{call}");
        }
        // an error still counts
        assert_eq!(ended("check none.fmu"), Some(1), "of errors: {of_errors}");
        assert_eq!(ended("nothing"), Some(2), "of errors: {of_errors}");
    }
}

#[test]
fn a_full_disk_behind_standard_output_is_an_error_with_a_message() {
    let folder = Folder::of_scene("steel_ball");
    folder.call("export scene.toml").with_status(0);
    for call in [
        "export scene.toml",
        "check steel_ball.fmu",
        "predict scene.toml",
        "predict scene.toml --json",
        "laws",
        "completions bash",
        "--version",
        "--help",
    ] {
        let mut command = Command::new("sh");
        settled(command.current_dir(folder.path()));
        command.args(["-c", "exec \"$@\" > /dev/full", "sh", env!("CARGO_BIN_EXE_brinell")]);
        let run = output(command.args(arguments(call))).with_status(1);
        let said = "brinell: standard output can't be written to: No space left";
        assert!(run.err.contains(said) && !run.err.contains("panicked"), "{call}: {}", run.err);
    }
}

/// Paths that are difficult to pass on.
#[test]
fn paths_with_spaces_and_other_letters_work() {
    let folder = empty_folder();
    let inside: PathBuf = folder.path().join("a b/Größe ‘x’ #%s");
    fs::create_dir_all(&inside).unwrap();
    fs::copy(scene("steel_ball"), inside.join("szene ä.toml")).unwrap();
    let mut command = brinell(&inside);
    command.env("TMPDIR", &inside);
    output(command.args(["export", "szene ä.toml", "-o", "kugel ö.fmu"])).with_status(0);
    let mut command = brinell(&inside);
    output(command.env("TMPDIR", &inside).args(["check", "kugel ö.fmu"])).with_status(0);
    assert_eq!(contents(&inside), ["kugel ö.fmu", "szene ä.toml"]);
}

/// JSON has only Unicode.
#[test]
fn a_path_that_is_not_unicode_is_in_the_json_with_a_replacement() {
    let folder = empty_folder();
    let inside = folder.path().join(OsStr::from_bytes(b"caf\xe9"));
    fs::create_dir(&inside).unwrap();
    fs::copy(scene("steel_ball"), inside.join("ball.toml")).unwrap();
    let name = OsStr::from_bytes(b"b\xe4ll.fmu");
    let call = |arguments: &[&OsStr]| output(brinell(&inside).args(arguments).arg("--json")).with_status(0).json();
    let os = OsStr::new;
    let exported = call(&[os("export"), os("ball.toml"), os("-o"), name]);
    for answer in [exported, call(&[os("check"), name])] {
        assert_eq!(answer["fmu"], "b\u{fffd}ll.fmu", "{answer}");
    }
}
