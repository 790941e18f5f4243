//! `brinell merge`: joins FMUs of one scene for different platforms.

use crate::files::{FileError, check_goal, write_whole};
use crate::importer::{self, BoundedArchive, DESCRIPTION, Description, ImportError};
use brinell_exporter::layout::{json_line, shown};
use brinell_exporter::package::{ZipError, archive};
use brinell_exporter::platform::Platform;
use serde_json::json;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::rc::Rc;

const BINARIES: &str = "binaries/";

/// The reason why FMUs cannot be joined.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    #[error("{0}")]
    File(#[from] FileError),
    #[error("the archive can't be written: {0}")]
    Zip(#[from] ZipError),
    #[error("{path}: {reason}", path = shown(path))]
    NoFmu { path: PathBuf, reason: ImportError },
    #[error(
        "{} and {} are not of one scene: their GUIDs are {} and {}",
        shown(&one.path), shown(&other.path), one.guid, other.guid
    )]
    Guid { one: Box<Fmu>, other: Box<Fmu> },
    #[error("{} and {} both have files for {platform}, which differ", shown(one), shown(other))]
    Platform { one: PathBuf, other: PathBuf, platform: String },
    #[error("{} and {} differ in {name}", shown(one), shown(other))]
    Part { one: PathBuf, other: PathBuf, name: String },
}

/// An FMU that has been read.
#[derive(Debug)]
pub struct Fmu {
    path: PathBuf,
    guid: String,
    /// Contents of its files, by name. Equal files of several FMUs are in memory once.
    files: BTreeMap<String, Rc<[u8]>>,
}

/// The command: joins the FMUs at `paths` into `output`.
///
/// # Errors
/// [`MergeError`]; nothing is written then.
pub fn run(paths: &[PathBuf], output: &Path, as_json: bool) -> Result<(), MergeError> {
    check_goal(output)?;
    let mut fmus = Vec::new();
    for path in paths {
        fmus.push(Fmu::read(path, &fmus)?);
    }
    let files = join(fmus)?;
    let files: Vec<(String, &[u8])> = files.iter().map(|(name, bytes)| (name.clone(), &**bytes)).collect();
    let archive = archive(&files)?;
    write_whole(output, &archive)?;
    let mut platforms: Vec<_> = files.iter().filter_map(|(name, _)| platform(name)).collect();
    platforms.dedup();
    if as_json {
        let object = json!({ "fmu": output.to_string_lossy(), "size": archive.len(), "platforms": platforms });
        print!("{}", json_line(&object));
    } else {
        println!("{}\n  {} bytes, for {}", shown(output), archive.len(), platforms.join(", "));
    }
    Ok(())
}

impl Fmu {
    /// Reads the FMU at `path`, after `others`.
    fn read(path: &Path, others: &[Fmu]) -> Result<Fmu, MergeError> {
        Fmu::unpacked(path, others).map_err(|reason| MergeError::NoFmu { path: path.into(), reason })
    }

    fn unpacked(path: &Path, others: &[Fmu]) -> Result<Fmu, ImportError> {
        let mut archive: BoundedArchive<File> = BoundedArchive::open(importer::file(path)?)?;
        let mut files = BTreeMap::new();
        for (index, name) in archive.files()? {
            let mut bytes = Vec::new();
            archive.copy(index, &mut bytes)?;
            let known = others.iter().filter_map(|other| other.files.get(&name)).find(|known| ***known == *bytes);
            files.insert(name, known.cloned().unwrap_or_else(|| bytes.into()));
        }
        let missing = || ImportError::Part { name: DESCRIPTION, source: io::ErrorKind::NotFound.into() };
        let text = files.get(DESCRIPTION).ok_or_else(missing)?;
        let Description { guid, .. } = Description::read(|| Ok(&**text))?;
        Ok(Fmu { path: path.into(), guid, files })
    }

    /// The files for a platform, by name.
    fn of_platform(&self, platform: &str) -> Vec<(&String, &Rc<[u8]>)> {
        self.files.iter().filter(|(name, _)| self::platform(name) == Some(platform)).collect()
    }
}

/// The platform of a file of an FMU.
fn platform(name: &str) -> Option<&str> {
    let (platform, _) = name.strip_prefix(BINARIES)?.split_once('/')?;
    Some(platform)
}

/// Name and contents of a file; equal contents are there once.
type Part = (String, Rc<[u8]>);

/// The files of all FMUs, in the order of an export.
fn join(fmus: Vec<Fmu>) -> Result<Vec<Part>, MergeError> {
    for (index, other) in fmus.iter().enumerate() {
        if let Some(one) = fmus[..index].iter().find(|one| one.guid != other.guid) {
            let copy = |fmu: &Fmu| Fmu { path: fmu.path.clone(), guid: fmu.guid.clone(), files: BTreeMap::new() };
            return Err(MergeError::Guid { one: copy(one).into(), other: copy(other).into() });
        }
        for one in &fmus[..index] {
            let (one_path, other_path) = (one.path.clone(), other.path.clone());
            let of_both = other.files.keys().filter_map(|name| platform(name));
            let differ = |platform: &&str| {
                let files = one.of_platform(platform);
                !files.is_empty() && files != other.of_platform(platform)
            };
            if let Some(platform) = of_both.into_iter().find(differ) {
                return Err(MergeError::Platform { one: one_path, other: other_path, platform: platform.into() });
            }
        }
    }
    let mut all: BTreeMap<String, (Rc<[u8]>, PathBuf)> = BTreeMap::new();
    for Fmu { path, files, .. } in fmus {
        for (name, bytes) in files {
            match all.entry(name) {
                Entry::Vacant(place) => drop(place.insert((bytes, path.clone()))),
                Entry::Occupied(there) if there.get().0 == bytes => {}
                Entry::Occupied(there) => {
                    let (name, one) = (there.key().clone(), there.get().1.clone());
                    return Err(MergeError::Part { one, other: path, name });
                }
            }
        }
    }
    let mut files: Vec<_> = all.into_iter().map(|(name, (bytes, _))| (name, bytes)).collect();
    files.sort_by_key(|(name, _)| rank(name));
    Ok(files)
}

/// The position of a file in the archive of an export. Files of equal rank are in the order of their names.
fn rank(name: &str) -> usize {
    let known = |folder: &str| Platform::ALL.iter().position(|platform| platform.folder == folder);
    match (name, platform(name)) {
        (DESCRIPTION, _) => 0,
        ("model.png", _) => 1,
        (_, Some(platform)) => 2 + known(platform).unwrap_or(Platform::ALL.len()),
        _ => 3 + Platform::ALL.len(),
    }
}
