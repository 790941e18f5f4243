//! The program for arm64 Linux, run with QEMU: its output and its exports equal those of this system, byte by byte.
//!
//! The program comes from the archive made by `packaging/release.py linux-aarch64`. QEMU and an arm64 C library are
//! unpacked in the target folder as for the tests of other systems. `brinell check` starts a second process, an arm64
//! program, too: the kernel passes it to QEMU, which takes Linux 6.7 or newer.
#![cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]

use crate::programs::Program;
use crate::systems::{self, Qemu};
use std::path::Path;
use std::process::Command;
use std::sync::LazyLock;

static ARM64: LazyLock<Program> = LazyLock::new(|| Program::unpacked("linux-aarch64", ("tar.gz", ""), qemu));

static QEMU: LazyLock<Qemu> = LazyLock::new(|| systems::qemu().unwrap_or_else(|why| panic!("there is no QEMU: {why}")));

/// A call of the program at `path`.
fn qemu(path: &Path) -> Command {
    let mut command = Command::new(&QEMU.with_arm64);
    command.arg(path);
    command
}

#[test]
#[ignore = "takes the archive for arm64 Linux: cargo test --release --test platforms arm64_program -- --ignored"]
fn it_knows_its_platform() {
    ARM64.knows_its_platform("aarch64-linux");
}

#[test]
#[ignore = "takes the archive for arm64 Linux"]
fn it_says_the_same_of_every_scene() {
    ARM64.says_the_same_of_every_scene();
}

#[test]
#[ignore = "takes the archive for arm64 Linux"]
fn what_it_writes_is_the_same() {
    ARM64.writes_the_same();
}

#[test]
#[ignore = "takes the archive for arm64 Linux"]
fn it_exports_the_same_unit_and_checks_it() {
    ARM64.exports_the_same_unit_and_checks_it("aarch64-unknown-linux-gnu");
}
