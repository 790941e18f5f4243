//! The program for Windows, run with Wine: its output and its exports equal those of this system, byte by byte.
//!
//! The program comes from the archive made by `packaging/release.py windows-x86_64`. Wine is the program in the variable WINE,
//! otherwise Debian's, unpacked in the target folder as for the tests of other systems.
#![cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]

use crate::command::{Run, brinell, contents, empty_folder, output, scene};
use crate::python;
use crate::systems;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The unpacked archive of the program.
static UNPACKED: LazyLock<PathBuf> = LazyLock::new(|| {
    let packaging = python::target_folder().join("packaging");
    let name = concat!("brinell-", env!("CARGO_PKG_VERSION"), "-windows-x86_64");
    let archive = packaging.join("dist").join(format!("{name}.zip"));
    assert!(archive.is_file(), "{} is missing: packaging/release.py windows-x86_64 makes it", archive.display());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("windows");
    let _ = fs::remove_dir_all(&folder);
    let unpack = "import sys, zipfile; zipfile.ZipFile(sys.argv[1]).extractall(sys.argv[2])";
    output(Command::new("python3").args(["-c", unpack]).arg(archive).arg(&folder)).with_status(0);
    let unpacked = folder.join(name);
    if output(wine(&unpacked).arg("--version")).status != Some(0) {
        let compiler = packaging.join("bin/x86_64-w64-mingw32-gcc");
        let compiler = if compiler.is_file() { compiler } else { "x86_64-w64-mingw32-gcc".into() };
        let mut compile = Command::new(compiler);
        compile.args(["-shared", "-O1"]).arg(root().join("tests/c/bcryptprimitives.c")).arg("-ladvapi32");
        output(compile.arg("-o").arg(unpacked.join("bin/bcryptprimitives.dll"))).with_status(0);
    }
    unpacked
});

/// The program that starts Wine.
static WINE: LazyLock<PathBuf> = LazyLock::new(|| match std::env::var_os("WINE") {
    Some(named) => named.into(),
    None => systems::wine().unwrap_or_else(|why| panic!("there is no Wine: {why}")).0,
});

/// A call of the program of `unpacked`.
fn wine(unpacked: &Path) -> Command {
    let mut command = Command::new(&*WINE);
    command.arg(unpacked.join("bin/brinell.exe"));
    command.env("WINEPREFIX", Path::new(env!("CARGO_TARGET_TMPDIR")).join("wine")).env("WINEDEBUG", "-all");
    command.env("WINEDLLOVERRIDES", "mscoree,mshtml=").env_remove("DISPLAY");
    command
}

/// The output of the program on Windows, in `folder`.
fn on_windows<A: AsRef<OsStr>>(folder: &Path, arguments: impl IntoIterator<Item = A>) -> Run {
    output(wine(&UNPACKED).args(arguments).current_dir(folder))
}

/// The output on this system, with the prebuilt libraries of the archive.
fn here<A: AsRef<OsStr>>(folder: &Path, arguments: impl IntoIterator<Item = A>) -> Run {
    output(brinell(folder).args(arguments).env("BRINELL_PREBUILT", UNPACKED.join("share/brinell/prebuilt")))
}

fn scenes() -> Vec<PathBuf> {
    contents(&root().join("scenes")).iter().map(|name| root().join("scenes").join(name)).collect()
}

#[test]
#[ignore = "takes Wine and the archive for Windows: cargo test --release --test platforms windows_program -- --ignored"]
fn it_knows_its_platform() {
    let version = on_windows(root(), ["--version", "--json"]).with_status(0).json();
    assert_eq!(version["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(version["platform"]["folder"], "win64");
    assert_eq!(version["library"], here(root(), ["--version", "--json"]).json()["library"]);
}

#[test]
#[ignore = "takes Wine and the archive for Windows"]
fn it_says_the_same_of_every_scene() {
    for scene in scenes() {
        let scene = scene.to_str().unwrap();
        for arguments in [
            vec!["predict", scene],
            vec!["predict", scene, "--json", "--laws", "all"],
            vec!["predict", scene, "--sweep", "speed", "0.01:100"],
            vec!["curve", scene],
            vec!["constants", scene],
        ] {
            let (one, other) = (on_windows(root(), &arguments), here(root(), &arguments));
            assert_eq!((one.status, &one.err), (other.status, &other.err), "{arguments:?}");
            assert!(one.out == other.out, "{arguments:?} answers otherwise than here");
        }
    }
}

#[test]
#[ignore = "takes Wine and the archive for Windows"]
fn what_it_writes_is_the_same() {
    let folders = [empty_folder(), empty_folder()];
    let scene = scene("mass_known");
    let scene = scene.to_str().unwrap();
    for arguments in [
        ["curve", scene, "--laws", "all", "--output", "curve.csv"].as_slice(),
        &["curve", scene, "--output", "curve.svg"],
        &["predict", scene, "--sweep", "speed", "0.1:10", "--output", "sweep.html"],
    ] {
        // twice: the second run replaces a file
        for _ in 0..2 {
            on_windows(folders[0].path(), arguments).with_status(0);
        }
        here(folders[1].path(), arguments).with_status(0);
    }
    assert_eq!(contents(folders[0].path()), contents(folders[1].path()));
    for name in contents(folders[1].path()) {
        let [one, other] = folders.each_ref().map(|folder| fs::read(folder.path().join(&name)).unwrap());
        assert!(one == other, "{name} is another file");
    }
}

#[test]
#[ignore = "takes Wine and the archive for Windows"]
fn it_exports_the_same_unit_and_checks_it() {
    let list = UNPACKED.join("share/brinell/prebuilt/x86_64-pc-windows-msvc.json");
    assert!(list.is_file(), "the archive was made without prebuilt libraries");
    let folders = [empty_folder(), empty_folder()];
    let scene = scene("mass_known");
    let export = ["export", scene.to_str().unwrap(), "--platforms", "all", "--output", "unit.fmu"];
    on_windows(folders[0].path(), export).with_status(0);
    here(folders[1].path(), export).with_status(0);
    let checked = on_windows(folders[0].path(), ["check", "unit.fmu", "--json"]).with_status(0).json();
    assert_eq!(checked, here(folders[1].path(), ["check", "unit.fmu", "--json"]).with_status(0).json());
    let [one, other] = folders.each_ref().map(|folder| fs::read(folder.path().join("unit.fmu")).unwrap());
    assert!(one == other, "the unit is another file");
    assert_eq!(contents(folders[0].path()), ["unit.fmu"], "nothing else is left");
}
