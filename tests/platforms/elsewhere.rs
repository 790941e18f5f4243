//! The programs in the wheels for other systems, installed by pip: what they say and write equals that of this system, byte by
//! byte. For musl in a namespace without glibc, for arm64 Linux in QEMU, for Windows in Wine; and the first example of the Python
//! module on arm64.
//!
//! The wheels are those of `python3 packaging/rehearse.py --toolchain FOLDER`, or in the folder BRINELL_WHEELS. QEMU, musl and
//! Python for arm64 are Debian's, unpacked in the target folder as for the tests of other systems; Wine is the program in the
//! variable WINE, otherwise Debian's. `brinell check` starts a second process, an arm64 program, too: the kernel passes it to
//! QEMU, which takes Linux 6.7 or newer.
#![cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]

use brinell_testing::command::{self, empty_folder, output};
use brinell_testing::places::{root, temporary};
use brinell_testing::programs::{Program, wheels};
use brinell_testing::systems::{self, Qemu};
use brinell_testing::windows::Wine;
use brinell_testing::{debian, python};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

static PROGRAMS: LazyLock<[Program; 3]> = LazyLock::new(|| {
    [
        Program::installed("musllinux_1_2_x86_64", ("linux64", "x86_64-unknown-linux-gnu"), musl),
        Program::installed("manylinux2014_aarch64", ("aarch64-linux", "aarch64-unknown-linux-gnu"), qemu),
        for_windows(),
    ]
});

/// The folder that is `/lib` for the programs for musl: there is nothing but its C library, which is also the loader.
static MUSL: LazyLock<PathBuf> = LazyLock::new(|| {
    let packages = debian::packages("musl", "bookworm", &["musl", "musl-dev"], false);
    let packages = packages.unwrap_or_else(|why| panic!("there is no musl: {why}"));
    let folder = temporary().join("lib-of-musl");
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    fs::copy(packages.folder.join("lib/x86_64-linux-musl/libc.so"), folder.join("ld-musl-x86_64.so.1"))
        .expect("the C library of the package");
    folder
});

/// A call of the program at `path` in a namespace of its own: no root, and nothing changes outside of it.
fn musl(path: &Path) -> Command {
    let mut command = Command::new("unshare");
    command.args(["--user", "--map-root-user", "--mount", "sh", "-c", "mount --bind \"$0\" /lib && exec \"$@\""]);
    command.arg(&*MUSL).arg(path);
    command
}

static QEMU: LazyLock<Qemu> = LazyLock::new(|| systems::qemu().unwrap_or_else(|why| panic!("there is no QEMU: {why}")));

/// A call of the program for arm64 at `path`.
fn qemu(path: &Path) -> Command {
    let mut command = Command::new(&QEMU.with_arm64);
    command.arg(path);
    command
}

static WINE: LazyLock<Wine> = LazyLock::new(|| Wine::find().unwrap_or_else(|why| panic!("there is no Wine: {why}")));

/// A call of the program for Windows at `path`.
fn wine(path: &Path) -> Command {
    WINE.command(path)
}

/// The program for Windows.
fn for_windows() -> Program {
    let program = Program::installed("win_amd64", ("win64", "x86_64-pc-windows-msvc"), wine);
    WINE.settle(&program.folder.join("bin"));
    program
}

#[test]
#[ignore = "takes wheels: python3 packaging/rehearse.py --toolchain FOLDER"]
fn programs_know_their_platforms() {
    PROGRAMS.iter().for_each(Program::knows_its_platform);
}

#[test]
#[ignore = "takes wheels: python3 packaging/rehearse.py --toolchain FOLDER"]
fn programs_say_the_same_of_every_scene() {
    PROGRAMS.iter().for_each(Program::says_the_same_of_every_scene);
}

#[test]
#[ignore = "takes wheels: python3 packaging/rehearse.py --toolchain FOLDER"]
fn what_programs_write_is_the_same() {
    PROGRAMS.iter().for_each(Program::writes_the_same);
}

#[test]
#[ignore = "takes wheels: python3 packaging/rehearse.py --toolchain FOLDER"]
fn programs_export_the_same_unit_and_check_it() {
    PROGRAMS.iter().for_each(Program::exports_the_same_unit_and_checks_it);
}

/// Packages of Python for arm64; its C library comes with QEMU.
const PYTHON: [&str; 11] = [
    "python3.11-minimal:arm64",
    "libpython3.11-minimal:arm64",
    "libpython3.11-stdlib:arm64",
    "libbz2-1.0:arm64",
    "libexpat1:arm64",
    "libffi8:arm64",
    "libgcc-s1:arm64",
    "liblzma5:arm64",
    "libssl3:arm64",
    "libstdc++6:arm64",
    "zlib1g:arm64",
];

/// With the module's wheel and what it depends on, from the Python Package Index.
#[test]
#[ignore = "takes wheels: python3 packaging/rehearse.py --toolchain FOLDER"]
fn the_first_example_of_the_module_runs_on_arm64() {
    let system = debian::packages("python-arm64", "bookworm", &PYTHON, false);
    let system = system.unwrap_or_else(|why| panic!("there is no Python for arm64: {why}")).folder;
    let (modules, folder) = (empty_folder(), empty_folder());
    let mut pip = Command::new(python::python());
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-compile"]);
    pip.args(["--only-binary", ":all:", "--python-version", "3.11", "--target"]).arg(modules.path());
    for platform in ["manylinux2014_aarch64", "manylinux_2_28_aarch64"] {
        pip.args(["--platform", platform]);
    }
    output(pip.arg("--find-links").arg(wheels()).arg("brinell")).with_status(0);
    let readme = fs::read_to_string(root().join("python/README.md")).expect("the text of the module");
    let example = readme.split("```python\n").nth(1).and_then(|rest| rest.split("```").next()).expect("an example");
    // in QEMU, a program that is not there seems to start, so that without a compiler it would be a broken one
    PROGRAMS[1]
        .there(folder.path(), ["export", &command::scene("mass_known").to_string_lossy(), "--prebuilt"])
        .with_status(0);
    let example = example.replace("brinell.export(\"scenes/mass_known.toml\")", "\"mass_known.fmu\"");
    let libraries =
        ["usr/lib", "lib"].map(|folder| system.join(folder).join("aarch64-linux-gnu").display().to_string());
    let mut run = qemu(&system.join("usr/bin/python3.11"));
    run.env("ARM64_LIBRARIES", libraries.join(":")).env("PYTHONHOME", system.join("usr"));
    run.env("PYTHONPATH", modules.path()).env_remove("BRINELL").current_dir(folder.path());
    let said = output(run.args(["-c", &example])).with_status(0).out;
    assert!(said.contains("m/s"), "{said}");
}
