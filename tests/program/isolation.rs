//! The same scene gives the same bytes, whatever the environment of the export: settings, other exports, and foreign files.
#![cfg(unix)]

use crate::command::{assert_same, brinell, cache, cache_with, contents, empty_folder, exported, output, scene};
use brinell_testing::{long, skips};
use std::ffi::OsStr;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};
use std::{env, fs, thread};
use tempfile::TempDir;

/// Removes the libraries of FMUs from the folder `cache`, so that the next export compiles.
fn forget(cache: &Path) {
    for name in contents(cache).iter().filter(|name| name.starts_with("library-")) {
        fs::remove_file(cache.join(name)).unwrap();
    }
}

/// A cache in which an export finds all that it needs.
fn filled() -> TempDir {
    exported(|command| command);
    cache_with("")
}

#[test]
fn the_same_scene_gives_the_same_bytes_wherever_temporary_files_are() {
    let (other, own) = (empty_folder(), filled());
    let export = || exported(|command| command.env("TMPDIR", other.path()).env("BRINELL_CACHE", own.path()));
    let kept = export();
    forget(own.path());
    assert_same(&kept, &export());
    assert!(contents(other.path()).is_empty(), "temporary files were left");
}

/// Users who build for their own processor, or without optimization, mean their own programs and not FMUs. A linker, a wrapper
/// or a target would fail at once, because these names do not exist. The registry is not needed.
#[test]
fn no_setting_in_the_environment_affects_the_fmu() {
    let settings = [
        ("RUSTFLAGS", "-Ctarget-cpu=native -Cdebuginfo=2"),
        ("CARGO_ENCODED_RUSTFLAGS", "-Copt-level=0"),
        ("CARGO_BUILD_RUSTFLAGS", "-Copt-level=0"),
        ("CARGO_BUILD_TARGET", "x86_64-unknown-linux-musl"),
        ("CARGO_BUILD_RUSTC", "/no/rustc"),
        ("CARGO_BUILD_TARGET_DIR", "/proc"),
        ("CARGO_TARGET_DIR", "/proc"),
        ("CARGO_TARGET_X86_64_UNKNOWN_LINUX_GNU_LINKER", "/no/linker"),
        ("CARGO_TARGET_X86_64_UNKNOWN_LINUX_GNU_RUSTFLAGS", "-Copt-level=0"),
        ("CARGO_PROFILE_RELEASE_OPT_LEVEL", "0"),
        ("CARGO_PROFILE_RELEASE_DEBUG", "true"),
        ("CARGO_PROFILE_RELEASE_LTO", "false"),
        ("CARGO_INCREMENTAL", "1"),
        ("CARGO_BUILD_INCREMENTAL", "true"),
        ("CARGO_HOME", "/no/registry"),
        ("CARGO_NET_OFFLINE", "true"),
        ("RUSTC", "/no/rustc"),
        ("RUSTC_WRAPPER", "/no/wrapper"),
        ("RUSTC_WORKSPACE_WRAPPER", "/no/wrapper"),
        ("RUSTC_BOOTSTRAP", "1"),
        ("RUSTC_LOG", "info"),
        ("LD_RUN_PATH", "/tmp/libraries"),
        ("LIBRARY_PATH", "/tmp/libraries"),
        ("COMPILER_PATH", "/no/compiler"),
        ("LDFLAGS", "-Wl,-rpath,/tmp/libraries"),
        ("LC_ALL", "de_DE.UTF-8"),
    ];
    // its own cache, so that files created with these settings affect no other test
    let own = if long::is_asked() { empty_folder() } else { filled() };
    let exported_with = |settings: &[(&str, &str)]| {
        let settings = settings.iter().copied();
        forget(own.path());
        exported(|command| command.env("BRINELL_CACHE", own.path()).envs(settings))
    };
    let plain = exported(|command| command);
    if exported_with(&settings) != plain {
        let different: Vec<_> = settings.iter().filter(|setting| exported_with(&[**setting]) != plain).collect();
        panic!("these change the unit, alone or together: {different:?}");
    }
}

/// Settings in a `.cargo/config.toml` that would change bytes or run a foreign program.
fn hostile_configuration(linker: &Path) -> String {
    let linker = format!("{:?}", linker.display().to_string());
    format!(
        "[build]\nrustc-wrapper = {linker}\ntarget = \"x86_64-unknown-linux-musl\"\nrustflags = [\"-Copt-level=0\"]\n\
         [target.x86_64-unknown-linux-gnu]\nlinker = {linker}\n\
         [profile.release]\nopt-level = 1\nlto = false\n\
         [profile.release.package.libm]\nopt-level = 0\n\
         [env]\nRUSTC_BOOTSTRAP = \"1\"\nLD_RUN_PATH = {{ value = \"/tmp\", force = true }}\n\
         [source.crates-io]\nreplace-with = \"nowhere\"\n[source.nowhere]\ndirectory = \"/no/registry\"\n"
    )
}

/// A home directory with a folder of temporary files, a place for a cache and a working folder deep inside, and hostile files above
/// them all. If they ran, they would create `ran`.
struct Home {
    folder: TempDir,
    ran: PathBuf,
}

impl Home {
    fn hostile() -> Home {
        let folder = empty_folder();
        let home = folder.path();
        for inside in ["deep/temporary", "deep/cache", "deep/work"] {
            fs::create_dir_all(home.join(inside)).unwrap();
        }
        let (linker, ran) = (home.join("linker"), home.join("ran"));
        fs::write(&linker, "#!/bin/sh\ntouch \"${0%/*}/ran\"\nexit 1\n").unwrap();
        fs::set_permissions(&linker, fs::Permissions::from_mode(0o755)).unwrap();
        for place in ["", "deep", "deep/temporary", "deep/cache", "deep/work"].map(|place| home.join(place)) {
            fs::create_dir_all(place.join(".cargo")).unwrap();
            fs::write(place.join(".cargo/config.toml"), hostile_configuration(&linker)).unwrap();
            fs::write(place.join("rust-toolchain.toml"), "[toolchain]\nchannel = \"1.2.3\"\n").unwrap();
        }
        Home { folder, ran }
    }

    /// The FMU, exported with this home by the compiler on PATH, without variables that would select another compiler.
    fn exported(&self) -> Vec<u8> {
        let home = self.folder.path();
        let rustup = env::var_os("RUSTUP_HOME").map(PathBuf::from);
        let rustup = rustup.or_else(|| Some(PathBuf::from(env::var_os("HOME")?).join(".rustup")));
        let mut command = brinell(&home.join("deep/work"));
        command.arg("export").arg(scene("steel_ball"));
        command.env_remove("BRINELL_CACHE").env_remove("CARGO").env_remove("RUSTUP_TOOLCHAIN");
        command.env("HOME", home).env("CARGO_HOME", home.join(".cargo")).env("TMPDIR", home.join("deep/temporary"));
        command.env("XDG_CACHE_HOME", home.join("deep/cache/new")).env("RUSTUP_HOME", rustup.unwrap_or_default());
        output(&mut command).with_status(0);
        fs::read(home.join("deep/work/steel_ball.fmu")).expect("NAME.fmu in the current folder")
    }
}

/// On a shared machine, everybody can write to the folder of temporary files: a foreign linker once ran as the exporting user.
#[test]
fn no_file_above_the_build_changes_the_fmu_or_is_run_and_only_the_owner_can_access_the_build_folder() {
    if long::leaves_out("files above the build folder") {
        return;
    }
    let hostile = Home::hostile();
    assert_same(&exported(|command| command), &hostile.exported());
    assert!(!hostile.ran.exists(), "a program that a configuration names was run");
    let mode = |path| fs::metadata(hostile.folder.path().join(path)).unwrap().permissions().mode() & 0o777;
    assert_eq!(["deep/cache/new", "deep/cache/new/brinell"].map(mode), [0o700; 2]);
}

/// Both compile files that the other one may already have in the cache.
#[test]
fn two_exports_of_one_scene_at_the_same_time_do_not_disturb_each_other() {
    if long::leaves_out("two exports at the same time") {
        return;
    }
    let plain = exported(|command| command);
    let new = empty_folder();
    thread::scope(|scope| {
        let export = || exported(|command| command.env("BRINELL_CACHE", new.path()));
        let exports: Vec<_> = (0..2).map(|_| scope.spawn(export)).collect();
        for export in exports {
            assert_same(&plain, &export.join().expect("an export at the same time as another one"));
        }
    });
}

/// After a loss of power a file may be empty, or have other bytes.
#[test]
fn damaged_files_in_the_cache_are_made_anew() {
    let own = filled();
    let export = || exported(|command| command.env("BRINELL_CACHE", own.path()));
    let (plain, before) = (export(), contents(own.path()));
    let empty = |_: Vec<u8>| Vec::new();
    let half = |bytes: Vec<u8>| bytes[..bytes.len() / 2].to_vec();
    let changed = |mut bytes: Vec<u8>| {
        let middle = bytes.len() / 3;
        bytes[middle] ^= 1;
        bytes
    };
    let damages = [changed as fn(Vec<u8>) -> Vec<u8>, empty, half];
    // the libraries in one way; in a long run in each, and each of their parts in one
    let turns = if long::is_asked() { &[("library-", 3), ("lib", 1)][..] } else { &[("library-", 1)] };
    for &(prefix, turns) in turns {
        for turn in 0..turns {
            let names = contents(own.path());
            for (place, name) in names.iter().filter(|name| name.starts_with(prefix)).enumerate() {
                let path = own.path().join(name);
                let damaged = damages[(turn + place) % 3](fs::read(&path).unwrap());
                fs::remove_file(&path).unwrap();
                fs::write(&path, damaged).unwrap();
            }
            assert_same(&plain, &export());
        }
    }
    assert_eq!(contents(own.path()), before);
}

/// An FMU has some tens of kilobytes, but every change of a parameter creates a new one.
#[test]
fn a_new_cache_does_not_affect_the_fmu_and_fmus_do_not_accumulate_in_it() {
    if long::leaves_out("new caches") {
        return;
    }
    let own = empty_folder();
    for _ in 0..2 {
        assert_same(&exported(|command| command), &exported(|command| command.env("BRINELL_CACHE", own.path())));
    }
    let mut left = contents(own.path());
    left.sort();
    let names: Vec<_> = left.iter().map(|name| name.split('-').next().unwrap()).collect();
    assert_eq!(names, ["libbrinell_contact", "libbrinell_fmu", "liblibm", "library"], "{left:?}");
    // one refers to the other by a hash of all that it holds: both must be the same wherever they were compiled
    for name in left.iter().take(3) {
        let read = |folder: &Path| fs::read(folder.join(name)).expect("a compiled part");
        assert!(read(own.path()) == read(&cache()), "{name} depends on its folder");
    }
    for number in 0..300 {
        let path = own.path().join(format!("library-{number}.bin"));
        fs::write(&path, "").unwrap();
        set_age(&path, 1 + number);
    }
    exported(|command| command.env("BRINELL_CACHE", own.path()));
    let libraries: Vec<_> = contents(own.path()).into_iter().filter(|name| name.starts_with("library-")).collect();
    assert_eq!(libraries.len(), 200, "those that were used last");
    for kept in [&left[3], "library-0.bin", "library-198.bin"] {
        assert!(libraries.iter().any(|name| name == kept), "{kept}: {libraries:?}");
    }
}

/// Sets the time of the last change of a file or folder.
fn set_age(path: &Path, hours: u64) {
    let moment = SystemTime::now() - Duration::from_secs(3600 * hours);
    fs::File::open(path).unwrap().set_modified(moment).unwrap();
}

/// An export that was killed cannot clean up; parts of other versions are not used any more.
#[test]
fn files_that_no_export_uses_any_more_are_removed() {
    if long::leaves_out("old files in the cache") {
        return;
    }
    let own = empty_folder();
    exported(|command| command.env("BRINELL_CACHE", own.path()));
    forget(own.path());
    for (name, hours) in [("build-old", 48), ("build-new", 1), ("other", 48)] {
        let path = own.path().join(name);
        fs::create_dir_all(path.join("src")).unwrap();
        set_age(&path, hours);
    }
    let month = 31 * 24;
    for (name, hours) in [
        ("libbrinell_fmu-old.rlib", month),
        ("libbrinell_fmu-new.rlib", month - 48),
        ("library-old.bin", month),
        ("library-new.bin", month - 48),
        ("other.txt", month),
    ] {
        let path = own.path().join(name);
        fs::write(&path, "").unwrap();
        set_age(&path, hours);
    }
    exported(|command| command.env("BRINELL_CACHE", own.path()));
    let left = contents(own.path());
    for kept in ["build-new", "other", "libbrinell_fmu-new.rlib", "library-new.bin", "other.txt"] {
        assert!(left.contains(&kept.into()), "{kept}: {left:?}");
    }
    for removed in ["build-old", "libbrinell_fmu-old.rlib", "library-old.bin"] {
        assert!(!left.contains(&removed.into()), "{removed}: {left:?}");
    }
    // an export that uses them keeps them: the library alone if it is there, otherwise the parts
    let used = |ending: &'static str| left.iter().filter(move |name| name.ends_with(ending) && !name.contains("new"));
    for ending in [".bin", ".rlib"] {
        used(ending).for_each(|name| set_age(&own.path().join(name), 29 * 24));
        exported(|command| command.env("BRINELL_CACHE", own.path()));
        for name in used(ending) {
            let age = fs::metadata(own.path().join(name)).unwrap().modified().unwrap().elapsed().unwrap_or_default();
            assert!(age < Duration::from_secs(3600), "{name}: {age:?}");
        }
        forget(own.path());
    }
}

/// Whatever a command was writing when it was killed, the next command that writes there removes.
#[test]
fn what_a_killed_command_left_is_swept_by_the_next() {
    let folder = empty_folder();
    let [out, temporary] = ["out", "temporary"].map(|name| folder.path().join(name));
    for path in [&out, &temporary] {
        fs::create_dir(path).unwrap();
    }
    let left = |place: &Path, prefix: &str, is_folder: bool| {
        let path = place.join(format!("{prefix}a1b2C3d4E5f6.tmp"));
        if is_folder { fs::create_dir(&path) } else { fs::write(&path, "half") }.unwrap();
        let minute = Duration::from_secs(60);
        fs::File::open(&path).unwrap().set_modified(SystemTime::now() - minute).unwrap();
        path
    };
    let own = filled();
    let all =
        [left(&out, ".brinell-", false), left(&temporary, "brinell-check-", true), left(own.path(), "build-", true)];
    let in_use = left(&out, ".brinell-", false).with_file_name(".brinell-000000000000.tmp");
    fs::copy(&all[0], &in_use).unwrap();
    fs::File::open(&in_use).unwrap().set_modified(SystemTime::now() - Duration::from_secs(60)).unwrap();
    let lock = fs::File::open(&in_use).unwrap();
    lock.lock().unwrap();
    let scene = scene("steel_ball").display().to_string();
    for call in [&["export", &scene, "-o", "out/ball.fmu"][..], &["check", "out/ball.fmu"]] {
        let mut command = brinell(folder.path());
        output(command.args(call).env("BRINELL_CACHE", own.path()).env("TMPDIR", &temporary)).with_status(0);
    }
    for path in all {
        assert!(!path.exists(), "{}", path.display());
    }
    assert_eq!(contents(&out), [".brinell-000000000000.tmp", "ball.fmu"], "another program writes the first");
    assert_eq!(contents(&temporary), [""; 0]);
}

/// The message of the rejected export of the default scene with this cache.
#[track_caller]
fn refused(cache: &OsStr) -> String {
    let folder = empty_folder();
    let mut command = brinell(folder.path());
    let run = output(command.arg("export").arg(scene("steel_ball")).env("BRINELL_CACHE", cache)).with_status(1);
    assert!(contents(folder.path()).is_empty() && run.out.is_empty(), "{run:#?}");
    run.err
}

#[test]
fn a_folder_that_others_can_write_to_is_not_used_for_the_build() {
    let folder = empty_folder();
    for mode in [0o777, 0o1777, 0o770, 0o702] {
        fs::set_permissions(folder.path(), fs::Permissions::from_mode(mode)).unwrap();
        let message = refused(folder.path().as_os_str());
        let parts = [folder.path().to_str().unwrap(), "others can write to", "chmod go-w", "BRINELL_CACHE"];
        assert!(parts.iter().all(|part| message.contains(part)), "{mode:o}: {message}");
        assert!(contents(folder.path()).is_empty(), "files were left");
    }
}

/// Only the superuser can give a folder to another user, so this is tried only if the tests run as superuser.
#[test]
fn a_folder_or_link_of_another_user_is_not_used_for_the_build() {
    let folder = empty_folder();
    let (theirs, link) = (folder.path().join("theirs"), folder.path().join("link"));
    fs::create_dir(&theirs).unwrap();
    fs::create_dir(folder.path().join("ours")).unwrap();
    symlink(folder.path().join("ours"), &link).unwrap();
    let given = std::os::unix::fs::chown(&theirs, Some(12345), None);
    if given.and_then(|()| std::os::unix::fs::lchown(&link, Some(12345), None)).is_err() {
        return skips::skipped("a build folder of another user", "only the superuser can give a folder away");
    }
    for path in [theirs, link] {
        let message = refused(path.as_os_str());
        assert!(message.contains("belongs to somebody else") && message.contains(path.to_str().unwrap()), "{message}");
    }
}

#[test]
fn a_cache_that_is_a_file_is_named() {
    let folder = empty_folder();
    let file = folder.path().join("cache");
    fs::write(&file, "").unwrap();
    let message = refused(file.as_os_str());
    assert!(message.contains(file.to_str().unwrap()), "{message}");
    assert_eq!(contents(folder.path()), ["cache"], "files were left");
}

/// The compiler runs in another folder, where a relative path would have another meaning.
#[test]
fn a_relative_cache_is_relative_to_the_current_folder() {
    if long::leaves_out("a relative cache") {
        return;
    }
    let folder = empty_folder();
    fs::rename(filled().keep(), folder.path().join("own cache")).unwrap();
    let mut command = brinell(folder.path());
    output(command.arg("export").arg(scene("elastic")).env("BRINELL_CACHE", "own cache")).with_status(0);
    assert_eq!(contents(folder.path()), ["elastic.fmu", "own cache"]);
    assert!(contents(&folder.path().join("own cache")).iter().any(|name| name.starts_with("library-")));
}

/// It must not build where everybody can write.
#[test]
fn without_any_cache_the_message_names_what_is_missing() {
    let folder = empty_folder();
    let mut command = brinell(folder.path());
    command
        .arg("export")
        .arg(scene("elastic"))
        .env_remove("BRINELL_CACHE")
        .env("HOME", "")
        .env("XDG_CACHE_HOME", "cache");
    let run = output(&mut command).with_status(1);
    assert!(run.err.contains("HOME") && run.err.contains("BRINELL_CACHE names one"), "{run:#?}");
    assert!(contents(folder.path()).is_empty(), "files were left");
}
