//! An FMU for several platforms, unpacked, and its results in an ordinary program of this system.

use brinell_testing::command::{empty_folder, output};
use brinell_testing::courses;
use brinell_testing::hosts::{Host, Interface, Said};
use brinell_testing::unit;
use std::cell::OnceCell;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

pub struct Unpacked {
    folder: TempDir,
    /// The kind of its prebuilt library, or `compiled`.
    pub kind: String,
    /// The folders of its libraries.
    pub platforms: Vec<String>,
    pub interface: Interface,
    here: OnceCell<Said>,
}

impl Unpacked {
    /// The FMU that a program, called in a new folder, makes of the scene with this text.
    pub fn of(text: &str, program: impl FnOnce(&Path) -> Command, arguments: &[&str]) -> Unpacked {
        let folder = empty_folder();
        fs::write(folder.path().join("scene.toml"), text).expect("a folder for temporary files");
        let mut export = program(folder.path());
        export.args(["export", "scene.toml", "-o", "unit.fmu", "--json"]).args(arguments);
        let said = output(&mut export).with_status(0).json();
        unit::unpack(&folder.path().join("unit.fmu"), folder.path());
        let description = fs::read_to_string(folder.path().join("modelDescription.xml")).expect("just unpacked");
        Unpacked {
            folder,
            kind: said["made"]["prebuilt"].as_str().unwrap_or("compiled").into(),
            platforms: said["libraries"].as_object().expect("libraries").keys().cloned().collect(),
            interface: Interface::of(&description),
            here: OnceCell::new(),
        }
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// The file `unit.fmu`.
    pub fn file(&self) -> PathBuf {
        self.path().join("unit.fmu")
    }

    /// The only file in the folder of a platform.
    pub fn library(&self, platform: &str) -> PathBuf {
        let folder = self.path().join("binaries").join(platform);
        let mut files = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        files.next().expect("a library").expect("a readable folder").path()
    }

    pub fn source(&self) -> PathBuf {
        self.path().join("sources/fmi2.c")
    }

    /// The results in an ordinary program, of this system's library.
    pub fn here(&self) -> &Said {
        self.here.get_or_init(|| {
            let said = Host::ordinary().run(&self.library("linux64"), &self.interface, &courses::history());
            let said = said.unwrap_or_else(|why| panic!("{why}"));
            courses::assert_moving(&said.bits);
            said
        })
    }

    /// How the bits and the message of a host with this library differ from those here.
    pub fn difference(&self, host: &Host, library: &Path) -> Option<String> {
        match host.run(library, &self.interface, &courses::history()) {
            Err(why) => Some(why),
            Ok(said) if said.bits != self.here().bits => Some("other bits".into()),
            Ok(said) => (said.message != self.here().message).then_some(said.message),
        }
    }
}
