//! An importer of FMI 2.0 co-simulation FMUs. It uses only the archive and the C interface.

#![allow(unsafe_code, reason = "units are called through the C interface")]

mod bounded;
mod description;
#[cfg(test)]
mod hostile_tests;
mod unit;

use crate::files::private_folder;
use brinell_exporter::layout::{shortened, without_middle};
use brinell_exporter::numbers::in_message;
use brinell_exporter::platform::{self, NoPlatform, Platform};
use std::collections::BTreeSet;
use std::ffi::c_int;
use std::io::{BufReader, Cursor, Read, Seek};
use std::path::Path;
use std::{env, fs, io};
use tempfile::TempDir;

pub use bounded::{Bound, open};
pub use description::{Base, Causality, Description, VariableUnit};
pub use unit::{Instance, Unit};

/// An FMU that cannot be loaded, or a call that failed.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    #[error("{0}")]
    Unreadable(io::Error),
    #[error("{name} in it can't be unpacked: {source}")]
    Entry { name: String, source: io::Error },
    #[error("it has more than {} files, which no FMU needs", bounded::MOST_FILES)]
    TooMany,
    #[error("modelDescription.xml is not of FMI 2.0 (fmiVersion is {0:?})")]
    Version(String),
    #[error("modelDescription.xml has no element CoSimulation with a modelIdentifier: it is no FMU for co-simulation")]
    NoCoSimulation,
    #[error("modelDescription.xml has modelIdentifier = {0:?}, which is no name of a library")]
    Identifier(String),
    #[error("binaries/{platform} has no {library}, which modelDescription.xml names")]
    OtherLibrary { platform: &'static str, library: String },
    #[error("{name} is missing or can't be read: {source}")]
    Part { name: &'static str, source: io::Error },
    #[error("it can't be unpacked: {0}")]
    Unpack(io::Error),
    #[error("it is larger than {} MB when unpacked, which no FMU needs", bounded::LARGEST / 1_000_000)]
    TooLarge,
    #[error("it is no zip archive, as every FMU is, or an incomplete one; `brinell export` makes the FMU of a scene")]
    NoArchive,
    #[error("its zip archive is damaged: {0}")]
    Zip(#[from] zip::result::ZipError),
    #[error("the name {0:?} in it is no plain path inside the archive")]
    Path(String),
    #[error("two files in it have the same name")]
    Twice,
    #[error("modelDescription.xml can't be read: {0}")]
    Xml(String),
    #[error("there is no binary for this platform ({wanted}), {present}")]
    Binary { wanted: String, present: String },
    #[error("{0}")]
    Platform(#[from] NoPlatform),
    // Windows says what is wrong, but not with which file
    #[error("the library {name} can't be loaded: {}", chain(.source))]
    Library { name: String, source: libloading::Error },
    #[error("the library has no function {name}: {}", chain(.source))]
    Function { name: &'static str, source: libloading::Error },
    #[error("fmi2Instantiate gave no instance: {0}")]
    Instantiate(String),
    #[error("{function} returned status {status}: {message}")]
    Call { function: &'static str, status: c_int, message: String },
    #[error("there is no variable {0}")]
    Variable(String),
    #[error("the force is {} after {} s", in_message(*.force), in_message(*.time))]
    Force { force: f64, time: f64 },
    #[error("the impact hasn't ended after {steps} steps")]
    Endless { steps: u32 },
}

/// The scene of an FMU that this program has made.
const SCENE: &str = "resources/scene.toml";

/// The scene of the FMU at `path`, or of the FMU `unit` in the system there, if this program has made it.
pub fn scene_in(path: &Path, unit: Option<&str>) -> Option<String> {
    let file = fs::File::open(path).ok()?;
    let text = match unit {
        None => part(file, SCENE)?,
        Some(unit) => part(Cursor::new(part(file, unit)?), SCENE)?,
    };
    String::from_utf8(text).ok()
}

/// The contents of the file `name` in an archive.
fn part(archive: impl Read + Seek, name: &str) -> Option<Vec<u8>> {
    let mut archive = bounded::open(archive).ok()?;
    let mut bound = Bound::of(&archive).ok()?;
    let mut bytes = Vec::new();
    bound.copy(&mut archive.by_name(name).ok()?, &mut bytes).ok()?;
    Some(bytes)
}

/// An error with its causes.
fn chain(error: &dyn std::error::Error) -> String {
    match error.source() {
        Some(source) => format!("{error}: {}", chain(source)),
        None => error.to_string(),
    }
}

/// An unpacked archive.
pub struct Archive {
    folder: TempDir,
    pub description: Description,
    /// Platforms with a binary.
    pub platforms: BTreeSet<String>,
    /// The scene of the FMU, if it was made by this program.
    pub scene: Option<String>,
}

impl Archive {
    /// Unpacks the FMU at `path`.
    pub fn open(path: &Path) -> Result<Archive, ImportError> {
        let mut archive = bounded::open(fs::File::open(path).map_err(ImportError::Unreadable)?)?;
        // the library in this folder will be loaded: nobody else may write to the folder
        let folder =
            private_folder("brinell-check-", &env::temp_dir()).map_err(|error| ImportError::Unpack(error.source))?;
        bounded::unpack(&mut archive, folder.path())?;
        let names = archive.file_names().map(|name| Ok(name?.into_owned())).collect::<Result<Vec<_>, ImportError>>()?;
        let platform = |name: &String| Some(name.strip_prefix("binaries/")?.split('/').next()?.to_string());
        let description_path = folder.path().join("modelDescription.xml");
        let description = Description::read(|| fs::File::open(&description_path).map(BufReader::new))?;
        let scene = match fs::read_to_string(folder.path().join(SCENE)) {
            Ok(scene) => Some(scene),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(source) => return Err(ImportError::Part { name: SCENE, source }),
        };
        Ok(Archive { description, platforms: names.iter().filter_map(platform).collect(), scene, folder })
    }

    /// Loads the binary for this machine.
    pub fn load(&self) -> Result<Unit, ImportError> {
        let Description { identifier, fmi_version, .. } = &self.description;
        if fmi_version != "2.0" {
            return Err(ImportError::Version(shortened(fmi_version)));
        }
        if identifier.is_empty() {
            return Err(ImportError::NoCoSimulation);
        }
        // a path would lead to a library outside the archive
        if identifier.contains(['/', '\\', ':', '\0']) {
            return Err(ImportError::Identifier(shortened(identifier)));
        }
        let loadable = platform::loadable()?;
        let path = |platform: &Platform| {
            let name = format!("{identifier}.{}", platform.extension);
            self.folder.path().join("binaries").join(platform.folder).join(name)
        };
        let Some(path) = loadable.iter().map(path).find(|path| path.exists()) else {
            if let Some(platform) = loadable.iter().find(|platform| self.platforms.contains(platform.folder)) {
                let library = format!("{}.{}", shortened(identifier), platform.extension);
                return Err(ImportError::OtherLibrary { platform: platform.folder, library });
            }
            let present = match self.platforms.iter().cloned().collect::<Vec<_>>().join(", ") {
                none if none.is_empty() => "nor for any other".into(),
                some => format!("only for {}", without_middle(&some)),
            };
            return Err(ImportError::Binary { wanted: loadable[0].folder.into(), present });
        };
        Unit::load(&path, self.folder.path(), &self.description.guid)
    }
}
