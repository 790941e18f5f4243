//! The program under difficult conditions: interrupted, with a closed pipe, writing to links and devices, and with
//! FMUs that harm the process that loads them.
#![cfg(target_os = "linux")]

use crate::command::{Run, brinell, contents, empty_folder, output, run, scene};
use crate::unit;
use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// The names of the build folders in `cache`.
fn builds(cache: &Path) -> Vec<String> {
    contents(cache).into_iter().filter(|name| name.starts_with("build-")).collect()
}

/// Number of processes that run in a folder below `folder`.
fn processes_below(folder: &Path) -> usize {
    let folder = folder.canonicalize().expect("it exists");
    let entries = fs::read_dir("/proc").expect("Linux").flatten();
    entries.filter(|entry| fs::read_link(entry.path().join("cwd")).is_ok_and(|cwd| cwd.starts_with(&folder))).count()
}

/// Waits until `condition` holds.
#[track_caller]
fn wait_for(what: &str, mut condition: impl FnMut() -> bool) {
    let begin = Instant::now();
    while !condition() {
        assert!(begin.elapsed() < Duration::from_secs(120), "{what} hasn't happened");
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn an_interrupted_export_leaves_neither_files_nor_a_compiler() {
    for signal in ["INT", "TERM", "HUP"] {
        let (folder, cache) = (empty_folder(), empty_folder());
        let mut command = brinell(folder.path());
        command.env("BRINELL_CACHE", cache.path()).args(["export".into(), scene("steel_ball").display().to_string()]);
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the program");
        wait_for("the compiler's start", || {
            builds(cache.path()).iter().any(|build| processes_below(&cache.path().join(build)) > 0)
        });
        // the shell's own: small systems have no program of this name
        output(Command::new("sh").args(["-c", &format!("kill -{signal} {}", child.id())])).with_status(0);
        let status = child.wait().expect("a child");
        assert_eq!(status.code(), Some(130), "after SIG{signal}: {status}");
        assert_eq!(builds(cache.path()), [""; 0], "after SIG{signal}");
        assert_eq!(contents(folder.path()), [""; 0], "after SIG{signal}");
        wait_for("the compiler's end", || processes_below(cache.path()) == 0);
    }
}

/// `nohup` ignores SIGHUP, and a shell script SIGINT for its jobs in the background.
#[test]
fn a_signal_that_the_caller_ignores_does_not_end_an_export() {
    for signal in ["INT", "HUP"] {
        let (folder, cache) = (empty_folder(), empty_folder());
        let mut command = Command::new("sh");
        command.args(["-c", "trap '' INT HUP; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_brinell"), "export"]);
        command.arg(scene("steel_ball")).current_dir(folder.path()).env("BRINELL_CACHE", cache.path());
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the program");
        wait_for("the compiler's start", || {
            builds(cache.path()).iter().any(|build| processes_below(&cache.path().join(build)) > 0)
        });
        output(Command::new("kill").args([format!("-{signal}"), child.id().to_string()])).with_status(0);
        assert_eq!(child.wait().expect("a child").code(), Some(0), "after SIG{signal}");
        assert_eq!(contents(folder.path()), ["steel_ball.fmu"], "after SIG{signal}");
    }
}

#[test]
fn a_file_beyond_the_limit_of_the_user_is_an_error_and_leaves_nothing() {
    let folder = empty_folder();
    let mut command = Command::new("sh");
    command.current_dir(folder.path()).args(["-c", "ulimit -f 1; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_brinell")]);
    let run = output(command.args(curve_to("curve.csv"))).with_status(1);
    assert!(run.err.contains("curve.csv: File too large"), "{run:#?}");
    assert_eq!(contents(folder.path()), [""; 0]);
}

#[test]
fn a_new_scene_that_does_not_fit_on_the_disk_leaves_nothing() {
    let folder = empty_folder();
    let mut command = Command::new("sh");
    command.current_dir(folder.path()).args(["-c", "ulimit -f 0; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_brinell")]);
    let run = output(command.args(["new", "ball"])).with_status(1);
    assert!(run.err.contains("ball.toml: File too large"), "{run:#?}");
    assert_eq!(contents(folder.path()), [""; 0]);
}

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
            command.current_dir(folder.path()).args(["-c", &script, "sh", env!("CARGO_BIN_EXE_brinell")]);
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
        command.current_dir(folder.path()).env("BRINELL_CACHE", crate::command::cache());
        command.args(["-c", "exec \"$@\" > /dev/full", "sh", env!("CARGO_BIN_EXE_brinell")]);
        let run = output(command.args(arguments)).with_status(1);
        let said = "brinell: standard output can't be written to: No space left";
        assert!(run.err.contains(said) && !run.err.contains("panicked"), "{arguments:?}: {}", run.err);
    }
}

/// Copies an FMU with another library.
const REPLACE: &str = "
import sys, zipfile
source, goal, library = sys.argv[1:]
with zipfile.ZipFile(source) as old, zipfile.ZipFile(goal, 'w') as new:
    for name in old.namelist():
        new.writestr(name, open(library, 'rb').read() if name.endswith('.so') else old.read(name))
";

/// The default scene's FMU with a harmful library, as `unit.fmu`.
fn stranger(option: &str) -> TempDir {
    let folder = empty_folder();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/c/stranger.c");
    let library = folder.path().join("stranger.so");
    let mut compiler = Command::new("cc");
    compiler.args(["-shared", "-fPIC", "-O1", "-Wall", "-Wextra", "-Werror", option, "-o"]).arg(&library).arg(source);
    output(&mut compiler).with_status(0);
    let mut python = Command::new("python3");
    python.args(["-c", REPLACE]).arg(unit::export(&unit::scene("steel_ball")));
    output(python.arg(folder.path().join("unit.fmu")).arg(&library)).with_status(0);
    folder
}

/// The output of `check` for such an FMU; its temporary files are removed.
#[track_caller]
fn said_of(option: &str) -> Run {
    let (folder, temporary) = (stranger(option), empty_folder());
    let mut command = brinell(folder.path());
    let run = output(command.env("TMPDIR", temporary.path()).args(["check", "unit.fmu", "--time-limit", "2"]));
    assert_eq!(contents(temporary.path()), [""; 0], "{option}");
    run.with_status(1)
}

#[test]
fn a_library_that_ends_the_process_that_loads_it_is_a_failed_check() {
    for (option, said) in [("-DEND", "exit status: 0"), ("-DCRASH", "signal: 6")] {
        let run = said_of(option);
        assert!(run.err.contains("ended the process") && run.err.contains(said), "{option}: {}", run.err);
        assert_eq!(run.out, "", "{option}");
    }
}

/// Compiles a library that crashes when its process ends, and has the functions of the FMU's own one.
const LATE: &str = "
import subprocess, sys, zipfile
source, goal = sys.argv[1:]
open('late.c', 'w').write('#include <stdlib.h>\\n__attribute__((destructor)) static void late(void) { abort(); }')
with zipfile.ZipFile(source) as old, zipfile.ZipFile(goal, 'w') as new:
    own = next(name for name in old.namelist() if name.endswith('.so'))
    open('own.so', 'wb').write(old.read(own))
    link = ['-L.', '-Wl,--no-as-needed', '-l:own.so', '-Wl,-rpath,$ORIGIN', '-Wl,-z,nodelete']
    subprocess.run(['cc', '-shared', '-fPIC', 'late.c', '-o', 'late.so', *link], check=True)
    for name in old.namelist():
        new.writestr(name, open('late.so', 'rb').read() if name == own else old.read(name))
    new.writestr(own.rsplit('/', 1)[0] + '/own.so', old.read(own))
";

/// A library that stays loaded can crash after all has been found.
#[test]
fn a_library_that_crashes_at_the_very_end_is_a_failed_check() {
    let folder = empty_folder();
    let mut python = Command::new("python3");
    python.current_dir(folder.path()).args(["-c", LATE]).arg(unit::export(&unit::scene("steel_ball"))).arg("unit.fmu");
    output(&mut python).with_status(0);
    let run = run(folder.path(), ["check", "unit.fmu"]).with_status(1);
    assert!(run.err.contains("ended the process") && run.err.contains("signal: 6"), "{run:#?}");
    assert_eq!(run.out, "");
}

#[test]
fn a_library_that_never_returns_is_a_failed_check() {
    let run = said_of("-DHANG");
    assert!(run.err.contains("unit.fmu") && run.err.contains("2 s"), "{}", run.err);
}

/// A process that the library has left behind keeps the pipes open.
#[test]
fn a_library_that_leaves_a_process_behind_does_not_delay_the_answer() {
    let begin = Instant::now();
    let run = said_of("-DFORK");
    assert!(run.err.contains("ended the process"), "{}", run.err);
    assert!(begin.elapsed() < Duration::from_secs(50), "after {:?}", begin.elapsed());
}

#[test]
fn a_library_that_prints_gigabytes_is_told_in_little_memory_and_few_words() {
    let (folder, temporary) = (stranger("-DTALK"), empty_folder());
    let mut command = Command::new("sh");
    command.args(["-c", "ulimit -v 600000; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_brinell"), "check", "unit.fmu"]);
    let run = output(command.current_dir(folder.path()).env("TMPDIR", temporary.path())).with_status(1);
    assert!(run.err.contains("ended the process") && run.err.contains("xxx ... xxx"), "{}", run.err.len());
    assert!(run.err.len() < 1000, "{} bytes", run.err.len());
}

#[test]
fn a_nan_force_and_an_endless_impact_are_failed_checks() {
    for (option, said) in [
        ("-DFORCE=NAN", "the force is NaN"),
        ("-DFORCE=INFINITY", "the force is inf"),
        ("-DFORCE=0.0", "hasn't ended after"),
    ] {
        let run = said_of(option);
        assert!(run.err.contains(said), "{option}: {}{}", run.out, run.err);
    }
}

/// An archive that contains gigabytes, and declares them.
#[test]
fn an_archive_that_unpacks_to_gigabytes_is_rejected() {
    let folder = empty_folder();
    let make = "
import sys, zipfile
with zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_DEFLATED, compresslevel=1) as new:
    new.writestr('modelDescription.xml', '<fmiModelDescription/>')
    with new.open('resources/zeros', 'w', force_zip64=True) as zeros:
        for _ in range(int(sys.argv[2])):
            zeros.write(bytes(1 << 24))
";
    let bomb = folder.path().join("bomb.fmu");
    output(Command::new("python3").args(["-c", make]).arg(&bomb).arg("129")).with_status(0);
    assert!(fs::metadata(&bomb).unwrap().len() < 20_000_000, "a bomb is small");
    for arguments in [&["check", "bomb.fmu"][..], &["merge", "bomb.fmu", "bomb.fmu", "-o", "both.fmu"]] {
        let run = run(folder.path(), arguments).with_status(1);
        assert!(run.err.contains("larger than") && run.err.contains("bomb.fmu"), "{arguments:?}: {}", run.err);
    }
    assert_eq!(contents(folder.path()), ["bomb.fmu"]);
}

/// Paths that are difficult to pass on.
#[test]
fn paths_with_spaces_and_other_letters_work() {
    let folder = empty_folder();
    let inside: PathBuf = folder.path().join("a b/Größe ‘x’ #%s");
    fs::create_dir_all(&inside).unwrap();
    fs::copy(scene("steel_ball"), inside.join("szene ä.toml")).unwrap();
    let mut command = brinell(&inside);
    command.env("BRINELL_CACHE", inside.join("ca che")).env("TMPDIR", &inside);
    output(command.args(["export", "szene ä.toml", "-o", "kugel ö.fmu"])).with_status(0);
    let mut command = brinell(&inside);
    output(command.env("TMPDIR", &inside).args(["check", "kugel ö.fmu"])).with_status(0);
    assert_eq!(contents(&inside), ["ca che", "kugel ö.fmu", "szene ä.toml"]);
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
    for answer in [exported, call(&[os("check"), name]), call(&[os("merge"), name, name, os("-o"), name])] {
        assert_eq!(answer["fmu"], "b\u{fffd}ll.fmu", "{answer}");
    }
}

/// A check of 100,000 contacts, with a model description of 600 MB, in little memory.
#[test]
#[ignore = "it takes half a minute"]
fn a_hundred_thousand_contacts_are_checked_in_little_memory() {
    let folder = empty_folder();
    let outputs = "[\"indentation\", \"max_indentation\", \"residual_indentation\", \"contact_radius\", \"mean_pressure\", \
                   \"stiffness\", \"work\", \"elastic_energy\", \"dissipated_energy\", \"impulse\", \"regime\"]";
    let text = format!(
        "name = \"big\"\nimpactor = {{ radius = 2e-3 }}\ntarget = {{ material = \"mild steel\" }}\n[fmu]\n\
         outputs = {outputs}\n[[contact]]\nname = \"bead\"\ncount = 100000\n"
    );
    fs::write(folder.path().join("big.toml"), text).unwrap();
    run(folder.path(), ["export", "big.toml"]).with_status(0);
    // address space, of which a quarter is used
    let mut command = Command::new("sh");
    command.current_dir(folder.path()).args([
        "-c",
        "ulimit -v 600000; exec \"$@\"",
        "sh",
        env!("CARGO_BIN_EXE_brinell"),
    ]);
    output(command.args(["check", "big.fmu"])).with_status(0);
}
