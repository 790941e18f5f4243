//! Exports with missing or broken tools, or without disk space: one line gives the reason and a remedy, and no file changes.
#![cfg(target_os = "linux")]

use crate::command::{brinell, cache_with, contents, empty_folder, output, scene, settled};
use brinell_testing::{long, skips};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Stdio};
use std::{env, fs};
use tempfile::TempDir;

/// The line that a failing export prints after "building".
#[track_caller]
fn message(circumstances: impl FnOnce(&mut Command) -> &mut Command) -> String {
    let folder = empty_folder();
    let mut command = brinell(folder.path());
    let parts = cache_with(".rlib");
    command.env("BRINELL_CACHE", parts.path());
    command.arg("export").arg(scene("steel_ball"));
    circumstances(&mut command);
    let run = output(&mut command).with_status(1);
    assert!(run.out.is_empty() && contents(folder.path()).is_empty(), "{run:#?}");
    let lines: Vec<_> = run.err.lines().collect();
    let [_, line] = lines[..] else { panic!("not one line: {run:#?}") };
    line.into()
}

#[track_caller]
fn contains(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "nothing of {part:?} in: {message}");
    }
}

/// A folder with a program of this name, for PATH.
fn program(name: &str, script: &str) -> TempDir {
    let folder = empty_folder();
    let path = folder.path().join(name);
    fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
    fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
    folder
}

/// The compiler of the tests.
fn rustc() -> String {
    let cargo = env::var("CARGO").expect("cargo runs this test");
    Path::new(&cargo).with_file_name("rustc").display().to_string()
}

/// The user saw only "could not compile due to 1 previous error".
#[test]
fn a_missing_linker_is_named_with_what_to_install() {
    let empty = empty_folder();
    let message = message(|command| command.env("PATH", empty.path()));
    contains(&message, &["there is no C linker `cc`", "apt install gcc", "Debian", "dnf install gcc", "Fedora"]);
}

/// One that fails, one that warns before, one that says nothing, one that is killed, and one that is no program.
#[test]
fn what_a_failing_linker_says_is_quoted() {
    // each of them compiles a library first
    if long::leaves_out("linkers that fail") {
        return;
    }
    for (script, told) in [
        (
            "echo 'cc: no such spell: -shared' >&2; echo 'cc: and more' >&2; exit 3",
            "the C linker `cc` fails (exit status: 3): cc: no such spell: -shared",
        ),
        (
            "echo 'ld: warning: this is old' >&2; echo; echo 'ld: error: cannot do it' >&2; exit 1",
            "`cc` fails (exit status: 1): ld: error: cannot do it",
        ),
        ("exit 7", "`cc` fails (exit status: 7): it says nothing"),
        ("kill -9 $$", "`cc` fails (signal: 9"),
        ("", "Permission denied"),
    ] {
        let cc = program("cc", script);
        if script.is_empty() {
            fs::set_permissions(cc.path().join("cc"), fs::Permissions::from_mode(0o644)).unwrap();
        }
        let message = message(|command| command.env("PATH", cc.path()));
        contains(&message, &["`cc`", told]);
        assert!(!message.contains("and more") && !message.contains("-nostartfiles"), "{message}");
    }
}

#[test]
fn without_a_rust_toolchain_the_message_says_where_to_get_one() {
    let empty = empty_folder();
    let bare = |command: &mut Command| {
        command.env_remove("CARGO").env("PATH", empty.path()).env("BRINELL_PREBUILT", empty.path());
    };
    let parts = ["no Rust toolchain on PATH", "rustup.rs", "no prebuilt libraries in", "BRINELL_PREBUILT"];
    let any = message(|command| {
        bare(command);
        command
    });
    contains(&any, &parts);
    let compiled = message(|command| {
        bare(command);
        command.arg("--compile")
    });
    contains(&compiled, &["rustc can't be started", "Rust toolchain", "rustup.rs"]);
}

#[test]
fn a_compiler_that_is_too_old_is_reported_with_the_version_that_is_needed() {
    let script = "case $1 in --print) echo /no/sysroot;; *) echo 'rustc 1.70.0'; echo 'release: 1.70.0';; esac";
    let old = program("rustc", script);
    let message = message(|command| command.env_remove("CARGO").env("PATH", old.path()));
    contains(&message, &["rustc 1.70.0 is too old", "need 1.89 or newer", "rustup update"]);
}

/// Like rustup without a default toolchain.
#[test]
fn a_compiler_that_does_not_answer_is_quoted() {
    let script = "echo 'error: rustup could not choose a version of rustc to run' >&2; exit 1";
    let broken = program("rustc", script);
    let message = message(|command| command.env_remove("CARGO").env("PATH", broken.path()));
    contains(&message, &["rustc is there and doesn't work", "rustup could not choose a version of rustc to run"]);
}

/// The toolchain of another C library or system: the real message of the compiler for a target that no test has.
#[test]
fn a_missing_standard_library_is_reported_with_what_to_install() {
    let script = format!(
        "case $1 in --print) echo /no/sysroot;; -vV) exec {0} -vV;; *) \
         for word do shift; case $word in x86_64-unknown-linux-gnu|aarch64-unknown-linux-gnu) word=s390x-unknown-linux-gnu;; esac; \
         set -- \"$@\" \"$word\"; done; exec {0} \"$@\";; esac",
        rustc()
    );
    let other = program("rustc", &script);
    let cache = empty_folder();
    let path = format!("{}:{}", other.path().display(), env::var("PATH").unwrap());
    let message = message(|command| command.env_remove("CARGO").env("PATH", path).env("BRINELL_CACHE", cache.path()));
    contains(
        &message,
        &["rustc doesn't build the library", "can't find crate for `core`", "s390x-unknown-linux-gnu", "target"],
    );
}

/// The message of an export in a shell after `before`, with its own cache; `None` if there was enough space.
fn in_shell(before: &str, cache: &Path) -> Option<String> {
    let folder = empty_folder();
    let program = brinell(folder.path()).get_program().to_owned();
    let mut command = Command::new("sh");
    settled(&mut command).current_dir(folder.path()).args(["-c", &format!("{before}; exec \"$@\""), "sh"]);
    command.arg(program).arg("export").arg(scene("steel_ball")).env("BRINELL_CACHE", cache);
    let run = output(&mut command);
    if run.status == Some(0) {
        return None;
    }
    assert!(run.status == Some(1) && contents(folder.path()).is_empty(), "{before}: {run:#?}");
    Some(run.err.lines().last().unwrap_or_default().into())
}

/// No file can exceed this number of blocks of 512 bytes. First not even the sources can be written, then the output of the
/// compiler.
#[test]
fn a_file_that_cannot_grow_is_reported_with_the_folder() {
    for blocks in [1, 20, 1000] {
        let cache = empty_folder();
        let message = in_shell(&format!("trap '' XFSZ; ulimit -f {blocks}"), cache.path()).expect("too little room");
        contains(&message, &["there is no space left to build in", cache.path().to_str().unwrap(), "BRINELL_CACHE"]);
        assert!(contents(cache.path()).iter().all(|name| !name.starts_with("libm")), "half of a file was left");
    }
}

/// On file systems of several sizes, if they can be mounted.
#[test]
fn a_full_disk_is_reported_with_the_folder() {
    if long::leaves_out("full disks of several sizes") {
        return;
    }
    let can_mount = Command::new("unshare")
        .args(["-rm", "mount", "-t", "tmpfs", "tmpfs"])
        .arg(empty_folder().path())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success());
    if !can_mount {
        return skips::skipped("a full disk", "no file system can be mounted");
    }
    let mut full = 0;
    for kilobytes in [100, 700, 1500, 2500, 3500, 4500, 5500, 100_000] {
        let disk = empty_folder();
        let folder = empty_folder();
        let cache = disk.path().join("cache");
        let script = format!("mount -t tmpfs -o size={kilobytes}k tmpfs \"$DISK\" && exec \"$@\"");
        let mut command = Command::new("unshare");
        settled(&mut command).args(["-rm", "sh", "-c", &script, "sh"]).current_dir(folder.path());
        command.arg(brinell(folder.path()).get_program()).arg("export").arg(scene("steel_ball"));
        let run = output(command.env("BRINELL_CACHE", &cache).env("DISK", disk.path()));
        if run.status == Some(0) {
            continue;
        }
        full += 1;
        let message = run.err.lines().last().unwrap_or_default();
        let parts = ["there is no space left to build in", cache.to_str().unwrap(), "No space left on device"];
        assert!(
            parts.iter().all(|part| message.to_lowercase().contains(&part.to_lowercase())),
            "{kilobytes}: {run:#?}"
        );
        assert!(contents(folder.path()).is_empty(), "files were left");
    }
    assert!((4..8).contains(&full), "{full} of the disks were too small");
}
