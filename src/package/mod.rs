//! From a plan to an `.fmu`: rustc compiles the library, its symbols are checked, and everything is zipped.

mod archive;
mod compiler;
mod diagnostics;
mod error;
mod folder;
mod hash;
mod library;
mod link;
mod parts;
mod resource;
mod rustc;
mod toolchain;
mod universal;
mod way;

pub use archive::archive;
pub use error::ExportError;
pub use hash::Hash;
pub use library::{Builder, Source};

pub use universal::join;
pub use way::{Origin, Way};

use crate::files::write_whole;
use crate::plan::Plan;
use crate::platform::Platform;
use crate::{documentation, model_description, symbols};
use archive::Archive;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use way::{Libraries, make};

include!(concat!(env!("OUT_DIR"), "/sources.rs"));

const LICENSE: &str = include_str!("../../LICENSE");
const THIRD_PARTY: &str = include_str!("../../modelDescription/licenses.txt");
const ICON: &[u8] = include_bytes!("../../modelDescription/model.png");

/// The result of an export.
#[derive(Default)]
pub struct Exported {
    pub path: PathBuf,
    pub guid: String,
    /// Size of the archive [bytes].
    pub size: usize,
    /// One library for each platform.
    pub libraries: Vec<Packed>,
    /// Where the libraries come from; unknown before the export.
    pub origin: Option<Origin>,
}

impl Exported {
    /// Size of all libraries together [bytes].
    pub fn library_size(&self) -> usize {
        self.libraries.iter().map(|library| library.size).sum()
    }

    /// The symbols that any of the libraries imports from the process.
    pub fn imports(&self) -> BTreeSet<&str> {
        self.libraries.iter().flat_map(|library| &library.imports).map(String::as_str).collect()
    }
}

/// A packed library.
pub struct Packed {
    /// Folder of its platform.
    pub platform: &'static str,
    /// Size [bytes].
    pub size: usize,
    /// The symbols that it imports from the process.
    pub imports: Vec<String>,
}

/// Makes the planned FMU in this `way` for `platforms` and writes it to `path`. An existing file is replaced only
/// after success.
///
/// # Errors
/// [`ExportError`]; nothing is written then.
pub fn export(plan: &Plan, way: Way, platforms: &[Platform], path: &Path) -> Result<Exported, ExportError> {
    let (archive, exported) = build(plan, way, platforms)?;
    write_whole(path, &archive)?;
    Ok(Exported { path: path.into(), ..exported })
}

/// Makes the planned FMU in this `way` for `platforms`. Returns the bytes of its archive and a description without a
/// path.
///
/// # Errors
/// [`ExportError`]
pub fn build(plan: &Plan, way: Way, platforms: &[Platform]) -> Result<(Vec<u8>, Exported), ExportError> {
    let scene = plan.scene;
    let Libraries { guid, libraries: built, origin } = make(plan, way, platforms)?;
    let mut libraries = Vec::new();
    for (platform, library) in platforms.iter().zip(&built) {
        let refused = |reason| ExportError::Symbols { platform: platform.folder, reason };
        let imports = symbols::check(library, platform, scene.standalone).map_err(refused)?;
        libraries.push(Packed { platform: platform.folder, size: library.len(), imports });
    }
    let license = format!("{LICENSE}\n{THIRD_PARTY}");
    let page = documentation::write(plan);
    let mut archive = Archive::new();
    archive.add_written("modelDescription.xml", |to| model_description::write(plan, &guid, to))?;
    archive.add("model.png", ICON)?;
    for (platform, library) in platforms.iter().zip(&built) {
        archive.add(&format!("binaries/{}/{}.{}", platform.folder, scene.name, platform.extension), library)?;
    }
    archive.add("documentation/index.html", page.as_bytes())?;
    archive.add("documentation/licenses/license.txt", license.as_bytes())?;
    archive.add("resources/scene.toml", scene.text.as_bytes())?;
    let archive = archive.finish()?;
    let size = archive.len();
    Ok((archive, Exported { path: PathBuf::new(), guid, size, libraries, origin: Some(origin) }))
}

/// Placeholder of the same length for the GUID. In quotes it can't occur anywhere else: in the texts of a scene,
/// quotes are written as `&quot;` and `\"`.
pub const GUID_TO_COME: &str = "GUID of 32 digits that will come";

/// `text` with the GUID instead of the placeholder.
pub fn identified(text: &str, guid: &str) -> String {
    let quoted = |text: &str| format!("\"{text}\"");
    text.replacen(&quoted(GUID_TO_COME), &quoted(guid), 1)
}

/// The common input of all libraries: names and texts of the files.
pub fn sources<'a>() -> impl Iterator<Item = &'a str> {
    [CONTACT_SOURCE, FMU_SOURCE, UNIT_SOURCE, LIBM_SOURCE].into_iter().flatten().flat_map(|&(name, text)| [name, text])
}

/// Identifier of the library: 16 digits of a hash of its source and that of `libm`.
pub fn library_identity() -> String {
    let mut identity = Hash::new().with_all(sources()).digits();
    identity.truncate(16);
    identity
}
