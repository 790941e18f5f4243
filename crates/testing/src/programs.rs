//! The program for another system, from an archive made by `packaging/release.py`: its answers and files equal those of
//! this system, byte by byte.

use super::command::{Run, brinell, contents, empty_folder, output, scene};
use super::python::target_folder;
use crate::places::{root, temporary};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A program and how it is started here.
pub struct Program {
    /// Its unpacked archive.
    pub folder: PathBuf,
    file: PathBuf,
    start: fn(&Path) -> Command,
}

impl Program {
    /// The program in the archive for `platform`; `start` gives the command that runs the program at a path.
    pub fn unpacked(platform: &str, (ending, suffix): (&str, &str), start: fn(&Path) -> Command) -> Program {
        let name = format!("brinell-{}-{platform}", env!("CARGO_PKG_VERSION"));
        let archive = target_folder().join("packaging/dist").join(format!("{name}.{ending}"));
        assert!(archive.is_file(), "{} is missing: packaging/release.py {platform} makes it", archive.display());
        let folder = temporary().join(platform);
        let _ = fs::remove_dir_all(&folder);
        let unpack = "import sys, shutil; shutil.unpack_archive(sys.argv[1], sys.argv[2])";
        output(Command::new("python3").args(["-c", unpack]).arg(archive).arg(&folder)).with_status(0);
        let folder = folder.join(name);
        Program { file: folder.join("bin").join(format!("brinell{suffix}")), folder, start }
    }

    /// Its output on its system, in `folder`.
    pub fn there<A: AsRef<OsStr>>(&self, folder: &Path, arguments: impl IntoIterator<Item = A>) -> Run {
        output((self.start)(&self.file).args(arguments).current_dir(folder))
    }

    /// The output on this system, with the prebuilt libraries of the archive.
    fn here<A: AsRef<OsStr>>(&self, folder: &Path, arguments: impl IntoIterator<Item = A>) -> Run {
        output(brinell(folder).args(arguments).env("BRINELL_PREBUILT", self.folder.join("share/brinell/prebuilt")))
    }

    /// It says that it is the program for the platform with this folder in FMUs.
    pub fn knows_its_platform(&self, folder: &str) {
        let version = self.there(root(), ["--version", "--json"]).with_status(0).json();
        assert_eq!(version["version"], env!("CARGO_PKG_VERSION"));
        assert_eq!(version["platform"]["folder"], folder);
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

    /// It exports the same FMU for every platform and checks it in a process of its own, for whose platform the archive
    /// must have prebuilt libraries.
    pub fn exports_the_same_unit_and_checks_it(&self, target: &str) {
        let list = self.folder.join(format!("share/brinell/prebuilt/{target}.json"));
        assert!(list.is_file(), "the archive was made without prebuilt libraries");
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
