//! The program when signals interrupt it.
#![cfg(target_os = "linux")]

use crate::command::{brinell, contents, empty_folder, output, scene};
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

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

/// Sends a signal with the shell: small systems have no program `kill`.
fn send(signal: &str, child: &Child) {
    output(Command::new("sh").args(["-c", &format!("kill -{signal} {}", child.id())])).with_status(0);
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
        send(signal, &child);
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
        send(signal, &child);
        assert_eq!(child.wait().expect("a child").code(), Some(0), "after SIG{signal}");
        assert_eq!(contents(folder.path()), ["steel_ball.fmu"], "after SIG{signal}");
    }
}
