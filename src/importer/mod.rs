//! An importer of FMI 2.0 co-simulation FMUs. It uses only the archive and the C interface.

#![allow(unsafe_code, reason = "units are called through the C interface")]

mod bounded;
mod description;
mod error;
mod unit;

use crate::files::{self, FMU};
use crate::temporary::PrivateFolder;
use brinell_exporter::layout::{shortened, without_middle};
use brinell_exporter::platform::{self, Platform};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::{env, io};

pub use bounded::BoundedArchive;
pub use description::{Base, Causality, Description, VariableUnit};
pub use error::{ImportError, size};
pub use unit::{Instance, Unit};

/// The scene of an FMU that this program has made.
pub const SCENE: &str = "resources/scene.toml";

/// The largest scene [bytes]. One with 100,000 contacts, each with its own numbers, takes a tenth of it.
pub const LARGEST_SCENE: u64 = 256_000_000;

/// The model description of an FMU.
pub const DESCRIPTION: &str = "modelDescription.xml";

/// The file at `path`, if it is one: a pipe would have to be waited for.
///
/// # Errors
/// [`ImportError::Unreadable`]
pub fn file(path: &Path) -> Result<File, ImportError> {
    files::check_readable(path, &FMU).map_err(ImportError::Unreadable)?;
    if !path.is_file() {
        return Err(ImportError::NoFile);
    }
    File::open(path).map_err(ImportError::Unreadable)
}

/// The scene of the FMU at `path`, or of the FMU `unit` in the system there; `None` if this program has not made it.
///
/// # Errors
/// [`ImportError`] of an archive that can't be read.
pub fn scene_in(path: &Path, unit: Option<&str>) -> Result<Option<String>, ImportError> {
    let mut archive = BoundedArchive::open(file(path)?)?;
    let Some(unit) = unit else { return scene_of(&mut archive) };
    match archive.read(unit, u64::MAX)? {
        Some(bytes) => scene_of(&mut BoundedArchive::inside(bytes)?),
        None => Ok(None),
    }
}

/// The model description of the FMU at `path`.
///
/// # Errors
/// [`ImportError`]
pub fn description_in(path: &Path) -> Result<Description, ImportError> {
    let missing = || ImportError::Part { name: DESCRIPTION, source: io::ErrorKind::NotFound.into() };
    let bytes = BoundedArchive::open(file(path)?)?.read(DESCRIPTION, u64::MAX)?.ok_or_else(missing)?;
    Description::read(|| Ok(bytes.as_slice()))
}

/// The scene in an archive.
fn scene_of(archive: &mut BoundedArchive<impl io::Read + io::Seek>) -> Result<Option<String>, ImportError> {
    let Some(bytes) = archive.read(SCENE, LARGEST_SCENE)? else { return Ok(None) };
    let wrong = |_| ImportError::Part { name: SCENE, source: io::Error::other("it isn't UTF-8") };
    String::from_utf8(bytes).map(Some).map_err(wrong)
}

/// An unpacked archive.
pub struct Archive {
    // held until it is dropped
    _folder: Option<PrivateFolder>,
    path: PathBuf,
    pub description: Description,
    /// Platforms with a binary.
    pub platforms: BTreeSet<String>,
    /// The scene of the FMU, if it was made by this program.
    pub scene: Option<String>,
}

impl Archive {
    /// Unpacks the FMU at `path`.
    pub fn open(path: &Path) -> Result<Archive, ImportError> {
        let archive = BoundedArchive::open(file(path)?)?;
        // the library in this folder will be loaded: nobody else may write to the folder
        let folder = PrivateFolder::new("brinell-check-", &env::temp_dir());
        let folder = folder.map_err(|error| ImportError::Unpack(error.source))?;
        let path = folder.path().to_path_buf();
        Ok(Archive { _folder: Some(folder), ..Archive::unpack(archive, path)? })
    }

    /// Unpacks the FMU at `path` into the folder `to`, which stays.
    pub fn open_in(path: &Path, to: &Path) -> Result<Archive, ImportError> {
        Archive::unpack(BoundedArchive::open(file(path)?)?, to.into())
    }

    fn unpack(mut archive: BoundedArchive<File>, path: PathBuf) -> Result<Archive, ImportError> {
        archive.unpack(&path)?;
        let names = archive.files()?;
        let platform =
            |(_, name): &(usize, String)| Some(name.strip_prefix("binaries/")?.split('/').next()?.to_string());
        let platforms = names.iter().filter_map(platform).collect();
        let scene = scene_of(&mut archive)?;
        let description = path.join(DESCRIPTION);
        let description = Description::read(|| File::open(&description).map(BufReader::new))?;
        Ok(Archive { _folder: None, path, description, platforms, scene })
    }

    /// The path of the library for this machine.
    pub fn library(&self) -> Result<PathBuf, ImportError> {
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
            self.path.join("binaries").join(platform.folder).join(name)
        };
        loadable.iter().map(path).find(|path| path.is_file()).ok_or_else(|| {
            if let Some(platform) = loadable.iter().find(|platform| self.platforms.contains(platform.folder)) {
                let library = format!("{}.{}", shortened(identifier), platform.extension);
                return ImportError::OtherLibrary { platform: platform.folder, library };
            }
            let present = match self.platforms.iter().cloned().collect::<Vec<_>>().join(", ") {
                none if none.is_empty() => "nor for any other".into(),
                some => format!("only for {}", without_middle(&some)),
            };
            ImportError::Binary { wanted: loadable[0].folder.into(), present }
        })
    }

    /// Loads the library for this machine.
    pub fn load(&self) -> Result<Unit, ImportError> {
        Unit::load(&self.library()?, &self.path, &self.description.guid)
    }
}
