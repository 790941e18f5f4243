//! From a plan to an `.fmu`: rustc builds the library, its symbols are checked, everything is zipped.

mod diagnostics;
mod error;
mod folder;
mod library;
mod rustc;
mod way;

pub use error::ExportError;
pub use library::{Source, build as build_library};
pub use way::{How, Way};

use crate::files::write_whole;
use crate::plan::Plan;
use crate::platform::{self, Platform};
use crate::{documentation, symbols};
use sha2::{Digest, Sha256};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use way::{Made, make};
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
    /// Size of the library in it [bytes].
    pub library_size: usize,
    pub imports: Vec<String>,
    /// How the library was made; unknown before there is one.
    pub how: Option<How>,
}

/// Builds the planned unit in this `way` and writes it to `path`, which is replaced only when everything has gone well.
///
/// # Errors
/// [`ExportError`]; nothing is then written.
pub fn export(plan: &Plan, way: Way, path: &Path) -> Result<Exported, ExportError> {
    let (archive, exported) = build(plan, way)?;
    write_whole(path, &archive)?;
    Ok(Exported { path: path.into(), ..exported })
}

/// Builds the planned unit in this `way`: the bytes of its archive, and what is in it. It has no path yet.
///
/// # Errors
/// [`ExportError`]
pub fn build(plan: &Plan, way: Way) -> Result<(Vec<u8>, Exported), ExportError> {
    let platform = platform::here()?;
    let Platform { folder, extension, .. } = platform;
    let scene = plan.scene;
    let Made { guid, description, mut libraries, how } = make(plan, way, &[platform])?;
    let library = libraries.remove(0);
    let imports = symbols::check(&library)?;
    let license = format!("{LICENSE}\n{THIRD_PARTY}");
    let page = documentation::write(plan);
    let files: [(String, &[u8]); 6] = [
        ("modelDescription.xml".into(), description.as_bytes()),
        ("model.png".into(), ICON),
        (format!("binaries/{folder}/{}.{extension}", scene.name), &library),
        ("documentation/index.html".into(), page.as_bytes()),
        ("documentation/licenses/license.txt".into(), license.as_bytes()),
        ("resources/scene.toml".into(), scene.text.as_bytes()),
    ];
    let archive = archive(&files)?;
    let size = archive.len();
    Ok((archive, Exported { path: PathBuf::new(), guid, size, library_size: library.len(), imports, how: Some(how) }))
}

/// What stands for the GUID until it is known, as long as one. In quotes it can't be in any other place: those of a scene's texts
/// are written as `&quot;` and `\"`.
pub const GUID_TO_COME: &str = "GUID of 32 digits that will come";

/// `text` with the GUID in its place.
pub fn identified(text: &str, guid: &str) -> String {
    let quoted = |text: &str| format!("\"{text}\"");
    text.replacen(&quoted(GUID_TO_COME), &quoted(guid), 1)
}

/// What every library is made of: names and texts of the files.
pub fn sources<'a>() -> impl Iterator<Item = &'a str> {
    LIBRARY_SOURCE.iter().chain(LIBM_SOURCE).flat_map(|&(name, text)| [name, text])
}

/// The hash of `texts`: 32 digits.
pub fn hash<'a>(texts: impl Iterator<Item = &'a str>) -> String {
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
