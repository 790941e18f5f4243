//! What the program writes, and where: links, devices, protected files, full disks, closed pipes, and unusual paths.
#![cfg(target_os = "linux")]

use crate::command::{brinell, compile, contents, empty_folder, output, run, scene, settled};
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
    let folder = empty_folder();
    let path = folder.path().join("ball.toml");
    fs::copy(scene("steel_ball"), &path).unwrap();
    let before = fs::read(&path).unwrap();
    symlink("ball.toml", folder.path().join("link.fmu")).unwrap();
    for goal in ["ball.toml", "./ball.toml", "link.fmu"] {
        let refused = run(folder.path(), ["export", "ball.toml", "-o", goal]).with_status(1);
        assert!(refused.err.contains(goal) && refused.err.contains("the scene itself"), "{}", refused.err);
        assert!(fs::read(&path).unwrap() == before, "{goal}: the scene was overwritten");
    }
}

/// The name of an FMU is that of the scene, which two scene files may share.
#[test]
fn an_fmu_of_another_scene_is_replaced_only_where_it_is_named() {
    let folder = empty_folder();
    let text = fs::read_to_string(scene("steel_ball")).unwrap();
    let write = |name: &str, speed: &str| {
        fs::write(folder.path().join(name), text.replace("speed = 1.0", &format!("speed = {speed}"))).unwrap();
    };
    let fmu = folder.path().join("steel_ball.fmu");
    let export = |arguments: &[&str], status| run(folder.path(), [&["export"], arguments].concat()).with_status(status);
    assert!(text.contains("speed = 1.0"));
    write("one.toml", "2.0");
    write("two.toml", "3.0");
    export(&["one.toml"], 0);
    export(&["one.toml"], 0);
    // a new text of the same scene
    write("one.toml", "2.5");
    export(&["one.toml"], 0);
    let before = fs::read(&fmu).unwrap();
    let refused = export(&["two.toml"], 1).err;
    assert!(refused.starts_with("brinell: steel_ball.fmu: this is the FMU of ./one.toml"), "{refused}");
    assert!(refused.contains("-o FILE"), "{refused}");
    assert!(fs::read(&fmu).unwrap() == before);
    export(&["two.toml", "-o", "steel_ball.fmu"], 0);
    assert!(fs::read(&fmu).unwrap() != before);
    fs::write(&fmu, "of another program").unwrap();
    let refused = export(&["two.toml"], 1).err;
    assert!(refused.starts_with("brinell: steel_ball.fmu: this is no FMU of a scene"), "{refused}");
    assert_eq!(fs::read_to_string(&fmu).unwrap(), "of another program");
}

#[test]
fn a_system_of_another_scene_is_replaced_only_where_it_is_named() {
    let folder = empty_folder();
    let text = fs::read_to_string(scene("steel_ball")).unwrap();
    let write = |name: &str, speed: &str| {
        fs::write(folder.path().join(name), text.replace("speed = 1.0", &format!("speed = {speed}"))).unwrap();
    };
    let system = folder.path().join("steel_ball.ssp");
    let pack = |arguments: &[&str], status| run(folder.path(), [&["ssp"], arguments].concat()).with_status(status);
    write("one.toml", "2.0");
    write("two.toml", "3.0");
    pack(&["one.toml"], 0);
    // a new text of the same scene
    write("one.toml", "2.5");
    pack(&["one.toml"], 0);
    let before = fs::read(&system).unwrap();
    let refused = pack(&["two.toml"], 1).err;
    assert!(refused.starts_with("brinell: steel_ball.ssp: this is the system of ./one.toml"), "{refused}");
    assert!(fs::read(&system).unwrap() == before && !refused.contains("building"));
    pack(&["two.toml", "-o", "steel_ball.ssp"], 0);
    assert!(fs::read(&system).unwrap() != before);
    write("steel_ball.ssp", "3.0");
    let refused = pack(&["two.toml"], 1).err;
    assert!(refused.starts_with("brinell: steel_ball.ssp: this is no system of a scene"), "{refused}");
    let refused = pack(&["steel_ball.ssp", "-o", "steel_ball.ssp"], 1).err;
    assert!(refused.contains("the scene itself"), "{refused}");
}

#[test]
fn a_goal_that_can_never_be_written_is_refused_before_any_work() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let long = "x".repeat(300);
    let goals = [
        ("export", "fmu", "File name too long"),
        ("ssp", "ssp", "File name too long"),
        ("curve", "csv", "File name too long"),
        ("report", "d", "File name too long"),
    ];
    let named = goals.map(|(command, ending, said)| (command, format!("{long}.{ending}"), said));
    let full = "there is no space left on this device";
    for (command, goal, said) in named.into_iter().chain([("export", "/dev/full".into(), full)]) {
        let refused = run(folder.path(), [command, &scene, "-o", &goal]).with_status(1);
        assert!(refused.err.contains(said) && !refused.err.contains("building"), "{command}: {}", refused.err);
    }
    assert_eq!(contents(folder.path()), [""; 0]);
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
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    for (arguments, goal) in
        [(&["export", &scene, "-o", "old.fmu"][..], "old.fmu"), (&["curve", &scene, "-o", "old.csv"], "old.csv")]
    {
        let path = folder.path().join(goal);
        fs::write(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).unwrap();
        let refused = run(folder.path(), arguments).with_status(1);
        assert!(refused.err.starts_with(&format!("brinell: {goal}: this file is read-only")), "{}", refused.err);
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    }
}

/// Runs the program with a pipe that nobody reads.
fn without_reader(folder: &Path, arguments: &[String], of_errors: bool) -> Option<i32> {
    let mut command = brinell(folder);
    command.args(arguments).stdin(Stdio::null());
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
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let all = |arguments: &[&str]| arguments.iter().map(ToString::to_string).collect::<Vec<_>>();
    for of_errors in [false, true] {
        let _ = fs::remove_file(folder.path().join("steel_ball.fmu"));
        let status = without_reader(folder.path(), &all(&["export", &scene]), of_errors);
        assert_eq!(status, Some(0), "of errors: {of_errors}");
        assert!(folder.path().join("steel_ball.fmu").is_file(), "of errors: {of_errors}");
        for arguments in [&["laws"][..], &["predict", &scene], &["check", "steel_ball.fmu"], &["completions", "zsh"]] {
            assert_eq!(without_reader(folder.path(), &all(arguments), of_errors), Some(0), "{arguments:?}");
        }
        // an error still counts
        let status = without_reader(folder.path(), &all(&["check", "none.fmu"]), of_errors);
        assert_eq!(status, Some(1), "of errors: {of_errors}");
        assert_eq!(without_reader(folder.path(), &all(&["nothing"]), of_errors), Some(2), "of errors: {of_errors}");
    }
}

#[test]
fn a_full_disk_behind_standard_output_is_an_error_with_a_message() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    run(folder.path(), ["export", &scene]).with_status(0);
    for arguments in [
        &["export", &scene][..],
        &["check", "steel_ball.fmu"],
        &["predict", &scene],
        &["predict", &scene, "--json"],
        &["laws"],
        &["completions", "bash"],
        &["--version"],
        &["--help"],
    ] {
        let mut command = Command::new("sh");
        settled(command.current_dir(folder.path()));
        command.args(["-c", "exec \"$@\" > /dev/full", "sh", env!("CARGO_BIN_EXE_brinell")]);
        let run = output(command.args(arguments)).with_status(1);
        let said = "brinell: standard output can't be written to: No space left";
        assert!(run.err.contains(said) && !run.err.contains("panicked"), "{arguments:?}: {}", run.err);
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
