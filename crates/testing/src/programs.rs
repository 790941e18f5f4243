//! The program for another system, from its wheel: its answers and files equal those of this system, byte by byte.

use super::command::{Run, brinell, contents, empty_folder, output, scene};
use super::python::{python, target_folder};
use crate::places::{root, temporary};
use std::env;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A program and how it is started here.
pub struct Program {
    /// Its wheel, installed.
    pub folder: PathBuf,
    file: PathBuf,
    /// The folder in FMUs of its platform, and the target of its prebuilt libraries.
    platform: (&'static str, &'static str),
    start: fn(&Path) -> Command,
}

/// The folder of wheels.
///
/// # Panics
/// If there is none.
pub fn wheels() -> PathBuf {
    let named = env::var_os("BRINELL_WHEELS").filter(|value| !value.is_empty());
    let folder = named.map_or_else(|| target_folder().join("rehearsal/python"), PathBuf::from);
    assert!(folder.is_dir(), "{} is missing: packaging/rehearse.py makes it, with wheels", folder.display());
    folder
}

impl Program {
    /// The program in the wheel with this `tag`; `start` gives the command that runs the program at a path.
    pub fn installed(tag: &str, platform: (&'static str, &'static str), start: fn(&Path) -> Command) -> Program {
        let folder = temporary().join(tag);
        let _ = fs::remove_dir_all(&folder);
        let mut pip = Command::new(python());
        pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--no-index"]);
        pip.args(["--no-compile", "--only-binary", ":all:", "--platform", tag, "--target"]).arg(&folder);
        output(pip.arg("--find-links").arg(wheels()).arg("brinell")).with_status(0);
        let suffix = if tag.starts_with("win") { ".exe" } else { "" };
        Program { file: folder.join(format!("bin/brinell{suffix}")), folder, platform, start }
    }

    /// Its output on its system, in `folder`.
    pub fn there<A: AsRef<OsStr>>(&self, folder: &Path, arguments: impl IntoIterator<Item = A>) -> Run {
        output((self.start)(&self.file).args(arguments).current_dir(folder))
    }

    /// The output on this system, with the prebuilt libraries of the wheel.
    fn here<A: AsRef<OsStr>>(&self, folder: &Path, arguments: impl IntoIterator<Item = A>) -> Run {
        output(brinell(folder).args(arguments).env("BRINELL_PREBUILT", self.folder.join("share/brinell/prebuilt")))
    }

    /// It says which platform it is for.
    pub fn knows_its_platform(&self) {
        let version = self.there(root(), ["--version", "--json"]).with_status(0).json();
        assert_eq!(version["version"], env!("CARGO_PKG_VERSION"));
        assert_eq!(version["platform"]["folder"], self.platform.0);
        assert_eq!(version["library"], self.here(root(), ["--version", "--json"]).json()["library"]);
    }

    pub fn says_the_same_of_every_scene(&self) {
        for name in contents(&root().join("scenes")) {
            let scene = root().join("scenes").join(name);
            let scene = scene.to_str().expect("UTF-8");
            for arguments in [
                vec!["predict", scene],
                vec!["predict", scene, "--json", "--laws", "all"],
                vec!["predict", scene, "--sweep", "speed=0.01:100"],
                vec!["curve", scene],
                vec!["constants", scene],
            ] {
                let (one, other) = (self.there(root(), &arguments), self.here(root(), &arguments));
                // not every law has what it needs in every scene
                assert!(other.status == Some(0) || arguments.contains(&"all"), "{arguments:?}: {}", other.err);
                assert_eq!((one.status, &one.err), (other.status, &other.err), "{arguments:?}");
                assert!(one.out == other.out, "{arguments:?} answers otherwise than here");
            }
        }
    }

    pub fn writes_the_same(&self) {
        let folders = [empty_folder(), empty_folder()];
        let scene = scene("mass_known");
        let scene = scene.to_str().expect("UTF-8");
        for arguments in [
            ["curve", scene, "--laws", "all", "--output", "curve.csv"].as_slice(),
            &["curve", scene, "--output", "curve.svg"],
            &["predict", scene, "--sweep", "speed=0.1:10", "--output", "sweep.csv"],
        ] {
            // twice: the second run replaces a file
            for _ in 0..2 {
                self.there(folders[0].path(), arguments).with_status(0);
            }
            self.here(folders[1].path(), arguments).with_status(0);
        }
        assert_eq!(contents(folders[0].path()), contents(folders[1].path()));
        for name in contents(folders[1].path()) {
            let [one, other] = folders.each_ref().map(|folder| fs::read(folder.path().join(&name)).expect("a file"));
            assert!(one == other, "{name} is another file");
        }
    }

    /// It exports the same FMU for every platform and checks it in a process of its own, for whose platform the wheel must
    /// have prebuilt libraries.
    pub fn exports_the_same_unit_and_checks_it(&self) {
        let list = self.folder.join(format!("share/brinell/prebuilt/{}.json", self.platform.1));
        assert!(list.is_file(), "the wheel was made without prebuilt libraries");
        let folders = [empty_folder(), empty_folder()];
        let scene = scene("mass_known");
        let scene = scene.to_str().expect("UTF-8");
        let export = ["export", scene, "--prebuilt", "--platforms", "all", "--output", "unit.fmu"];
        self.there(folders[0].path(), export).with_status(0);
        self.here(folders[1].path(), export).with_status(0);
        let check = ["check", "unit.fmu", "--json"];
        let checked = self.there(folders[0].path(), check).with_status(0).json();
        assert_eq!(checked, self.here(folders[1].path(), check).with_status(0).json());
        let [one, other] = folders.each_ref().map(|folder| fs::read(folder.path().join("unit.fmu")).expect("an FMU"));
        assert!(one == other, "the unit is another file");
        assert_eq!(contents(folders[0].path()), ["unit.fmu"], "nothing else is left");
    }
}
