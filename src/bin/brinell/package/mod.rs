//! From a plan to an `.fmu`: rustc builds the library, its symbols are checked, everything is zipped.

mod diagnostics;
mod error;
mod folder;
mod library;
mod rustc;

pub use error::ExportError;

use crate::files::write_whole;
use crate::plan::Plan;
use crate::platform::{self, Platform};
use crate::symbols;
use crate::{constants, documentation, model_description};
use sha2::{Digest, Sha256};
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
    /// Size of the library in it [bytes].
    pub library_size: usize,
    pub imports: Vec<String>,
}

/// Builds the planned unit and writes it to `path`, which is replaced only when everything has gone well.
///
/// # Errors
/// [`ExportError`]; nothing is then written.
pub fn export(plan: &Plan, path: &Path) -> Result<Exported, ExportError> {
    let (archive, exported) = build(plan)?;
    write_whole(path, &archive)?;
    Ok(Exported { path: path.into(), ..exported })
}

/// Builds the planned unit: the bytes of its archive, and what is in it. It has no path yet.
///
/// # Errors
/// [`ExportError`]
pub fn build(plan: &Plan) -> Result<(Vec<u8>, Exported), ExportError> {
    let platform = platform::here()?;
    let Platform { folder, extension, .. } = platform;
    let scene = plan.scene;
    let Identified { guid, description, constants } = Identified::of(plan);
    let library = library::build(scene, &constants, &platform)?;
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
    Ok((archive, Exported { path: PathBuf::new(), guid, size, library_size: library.len(), imports }))
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
        let guid = hash([description.as_str(), &constants].into_iter().chain(sources()));
        let quoted = |text: &str| format!("\"{text}\"");
        let identified = |text: String| text.replacen(&quoted(GUID_TO_COME), &quoted(&guid), 1);
        let (description, constants) = (identified(description), identified(constants));
        Identified { guid, description, constants }
    }
}

/// What the library is recognised by: 16 digits of a hash of its source and that of `libm`.
pub fn library_identity() -> String {
    let mut identity = hash(sources());
    identity.truncate(16);
    identity
}

/// Names and texts of the source files of the library and of `libm`.
fn sources<'a>() -> impl Iterator<Item = &'a str> {
    LIBRARY_SOURCE.iter().chain(LIBM_SOURCE).flat_map(|(name, text)| -> [&'a str; 2] { [name, text] })
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
