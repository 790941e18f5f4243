//! From a plan to an `.fmu`: rustc builds the library, its symbols are checked, everything is zipped.

mod compiler;
mod diagnostics;
mod error;
mod folder;
mod library;
mod link;
mod resource;
mod rustc;
mod toolchain;
mod universal;

pub use error::ExportError;
pub use folder::Cache;
pub use rustc::Rustc;
pub use toolchain::Toolchain;

use crate::files::write_whole;
use crate::plan::Plan;
use crate::platform::Platform;
use crate::symbols;
use crate::{constants, documentation, model_description};
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use zip::CompressionMethod;
use zip::write::SimpleFileOptions;

include!(concat!(env!("OUT_DIR"), "/library_source.rs"));

const LICENSE: &str = include_str!("../../../../LICENSE");
const THIRD_PARTY: &str = include_str!("../../../../modelDescription/licenses.txt");
const ICON: &[u8] = include_bytes!("../../../../modelDescription/model.png");

/// What was exported.
#[derive(Default)]
pub struct Exported {
    pub path: PathBuf,
    pub guid: String,
    /// Size of the archive [bytes].
    pub size: usize,
    /// One library for each platform.
    pub libraries: Vec<Packed>,
}

impl Exported {
    /// Size of all libraries together [bytes].
    pub fn library_size(&self) -> usize {
        self.libraries.iter().map(|library| library.size).sum()
    }

    /// What any of the libraries takes from the process.
    pub fn imports(&self) -> BTreeSet<&str> {
        self.libraries.iter().flat_map(|library| &library.imports).map(String::as_str).collect()
    }
}

/// A library that was packed.
pub struct Packed {
    /// Folder of its platform.
    pub platform: &'static str,
    /// Size [bytes].
    pub size: usize,
    /// What it takes from the process.
    pub imports: Vec<String>,
}

/// Builds the planned FMU for `platforms` and writes it to `path`, which is replaced only when everything has gone well.
///
/// # Errors
/// [`ExportError`]; nothing is then written.
pub fn export(plan: &Plan, platforms: &[Platform], path: &Path) -> Result<Exported, ExportError> {
    let (archive, exported) = build(plan, platforms)?;
    write_whole(path, &archive)?;
    Ok(Exported { path: path.into(), ..exported })
}

/// Builds the planned FMU for `platforms`: the bytes of its archive, and what is in it. It has no path yet.
///
/// # Errors
/// [`ExportError`]
pub fn build(plan: &Plan, platforms: &[Platform]) -> Result<(Vec<u8>, Exported), ExportError> {
    let scene = plan.scene;
    let Identified { guid, description, constants } = Identified::of(plan);
    let built = library::build(scene, &constants, platforms)?;
    let mut libraries = Vec::new();
    for (platform, library) in platforms.iter().zip(&built) {
        let refused = |reason| ExportError::Symbols { platform: platform.folder, reason };
        let imports = symbols::check(library, platform).map_err(refused)?;
        libraries.push(Packed { platform: platform.folder, size: library.len(), imports });
    }
    let license = format!("{LICENSE}\n{THIRD_PARTY}");
    let page = documentation::write(plan);
    let path = |platform: &Platform| format!("binaries/{}/{}.{}", platform.folder, scene.name, platform.extension);
    let mut files: Vec<(String, &[u8])> =
        vec![("modelDescription.xml".into(), description.as_bytes()), ("model.png".into(), ICON)];
    files.extend(platforms.iter().zip(&built).map(|(platform, library)| (path(platform), library.as_slice())));
    files.extend([
        ("documentation/index.html".into(), page.as_bytes()),
        ("documentation/licenses/license.txt".into(), license.as_bytes()),
        ("resources/scene.toml".into(), scene.text.as_bytes()),
    ]);
    let archive = archive(&files)?;
    let size = archive.len();
    Ok((archive, Exported { path: PathBuf::new(), guid, size, libraries }))
}

/// The two texts that the unit recognises itself by, and what they have in common.
struct Identified {
    guid: String,
    description: String,
    constants: String,
}

/// What stands for the GUID until it is known. In quotes it can't be in any other place: those of a scene's texts are written
/// as `&quot;` and `\"`.
const GUID_TO_COME: &str = "GUID to come";

impl Identified {
    /// The GUID is a hash of all that the unit is made of: description, constants, source of the library and of `libm`.
    fn of(plan: &Plan) -> Identified {
        let description = model_description::write(plan, GUID_TO_COME);
        let constants = constants::write(plan, GUID_TO_COME);
        let sources = LIBRARY_SOURCE.iter().chain(LIBM_SOURCE).flat_map(|(name, text)| [*name, *text]);
        let guid = hash([description.as_str(), &constants].into_iter().chain(sources));
        let quoted = |text: &str| format!("\"{text}\"");
        let identified = |text: String| text.replacen(&quoted(GUID_TO_COME), &quoted(&guid), 1);
        let (description, constants) = (identified(description), identified(constants));
        Identified { guid, description, constants }
    }
}

/// The hash of `texts`: 32 digits.
fn hash<'a>(texts: impl Iterator<Item = &'a str>) -> String {
    let mut hash = Sha256::new();
    for text in texts {
        hash.update(text);
        // so that no two lists of texts are the same
        hash.update([0]);
    }
    hash.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect()
}

/// The files as a zip archive: the same bytes for the same files.
///
/// # Errors
/// [`ExportError::Zip`]
pub fn archive(files: &[(String, &[u8])]) -> Result<Vec<u8>, ExportError> {
    let mut archive = zip::ZipWriter::new(io::Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .compression_level(Some(9))
        .last_modified_time(zip::DateTime::default())
        .unix_permissions(0o644);
    for (name, bytes) in files {
        archive.start_file(name.as_str(), options)?;
        archive.write_all(bytes).map_err(zip::result::ZipError::from)?;
    }
    Ok(archive.finish()?.into_inner())
}
