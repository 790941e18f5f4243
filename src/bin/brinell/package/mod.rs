//! From a scene to an `.fmu`: cargo builds the library, its symbols are checked, everything is zipped.

mod library;

use crate::files::{FileError, write_whole};
use crate::plan::Plan;
use crate::platform::{self, NoPlatform, Platform};
use crate::symbols::{self, SymbolError};
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

/// A unit that couldn't be made.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    #[error("{0}")]
    File(#[from] FileError),
    #[error("cargo can't be started ({0}): exporting needs a Rust toolchain on PATH, see rustup.rs")]
    NoCargo(io::Error),
    #[error("cargo didn't build the library:\n{0}")]
    Build(String),
    #[error("the library is not packed: {0}")]
    Symbols(#[from] SymbolError),
    #[error("the archive can't be written: {0}")]
    Zip(#[from] zip::result::ZipError),
    #[error("{0}")]
    Platform(#[from] NoPlatform),
}

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
    let Platform { folder, extension } = platform::here()?;
    let scene = plan.scene;
    let Identified { guid, description, constants } = Identified::of(plan);
    let library = library::build(scene, &constants, &guid)?;
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
    write_whole(path, &archive)?;
    Ok(Exported { path: path.into(), guid, size: archive.len(), library_size: library.len(), imports })
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
    /// The GUID is a hash of all that the unit is made of: description, constants, source of the library.
    fn of(plan: &Plan) -> Identified {
        let description = model_description::write(plan, GUID_TO_COME);
        let constants = constants::write(plan, GUID_TO_COME);
        let mut hash = Sha256::new();
        hash.update(&description);
        hash.update(&constants);
        for (name, text) in LIBRARY_SOURCE {
            hash.update(name);
            hash.update(text);
        }
        let guid: String = hash.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect();
        let quoted = |text: &str| format!("\"{text}\"");
        let identified = |text: String| text.replacen(&quoted(GUID_TO_COME), &quoted(&guid), 1);
        let (description, constants) = (identified(description), identified(constants));
        Identified { guid, description, constants }
    }
}

/// The files as a zip archive: the same bytes for the same files.
fn archive(files: &[(String, &[u8])]) -> Result<Vec<u8>, ExportError> {
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
