//! The files of an FMU, and their archive.

pub mod archive;
mod hash;
pub mod resource;
mod universal;

pub use archive::archive;
pub use hash::Hash;
pub use universal::join;

use crate::plan::Plan;
use crate::platform::Platform;
use crate::symbols::{self, SymbolError};
use crate::{c_source, documentation, model_description};
use brinell_tables::{ICON, LICENSES};
pub use zip::result::ZipError;

use archive::Archive;

/// A packed library.
pub struct Packed {
    /// Folder of its platform.
    pub platform: &'static str,
    /// Size \[bytes\].
    pub size: usize,
    /// The symbols that it imports from the process.
    pub imports: Vec<String>,
}

/// An FMU that can't be packed.
#[derive(Debug, thiserror::Error)]
pub enum PackError {
    #[error("the library for {platform} is not packed: {reason}")]
    Symbols { platform: &'static str, reason: SymbolError },
    #[error("the archive can't be written: {0}")]
    Zip(#[from] ZipError),
}

/// The bytes of the planned FMU with this `guid` and these `libraries`, one for each of the `platforms`. The symbols of each are
/// checked.
///
/// # Errors
/// [`PackError`]
pub fn pack(
    plan: &Plan,
    guid: &str,
    platforms: &[Platform],
    libraries: &[Vec<u8>],
) -> Result<(Vec<u8>, Vec<Packed>), PackError> {
    let scene = plan.scene;
    let mut packed = Vec::new();
    for (platform, library) in platforms.iter().zip(libraries) {
        let refused = |reason| PackError::Symbols { platform: platform.folder, reason };
        let imports = match platform.is_source() {
            true => c_source::NEEDED.map(String::from).into(),
            false => symbols::check(library, platform, scene.standalone).map_err(refused)?,
        };
        packed.push(Packed { platform: platform.folder, size: library.len(), imports });
    }
    let page = documentation::write(plan);
    let mut archive = Archive::default();
    let source = platforms.iter().any(Platform::is_source).then_some(c_source::LISTED);
    archive.add_written("modelDescription.xml", |to| model_description::write(plan, guid, source, to))?;
    archive.add("model.png", ICON)?;
    for (platform, library) in platforms.iter().zip(libraries) {
        if platform.is_source() {
            for (name, text) in c_source::files(library) {
                archive.add(&format!("sources/{name}"), text)?;
            }
            continue;
        }
        archive.add(&format!("binaries/{}/{}.{}", platform.folder, scene.name, platform.extension), library)?;
    }
    archive.add("documentation/index.html", page.as_bytes())?;
    archive.add("documentation/licenses/license.txt", LICENSES.as_bytes())?;
    archive.add("resources/scene.toml", scene.text.as_bytes())?;
    Ok((archive.finish()?, packed))
}

/// Placeholder of the same length for the GUID, for what its hash is made of.
pub const GUID_TO_COME: &str = "GUID of 32 digits that will come";

/// The GUID of the planned FMU: a hash of its description, of its `data` and of the sources of its library.
pub(crate) fn guid(plan: &Plan, data: &str, sources: &str) -> String {
    let written = Hash::default().with_written(|to| model_description::write(plan, GUID_TO_COME, None, to));
    let written = written.expect("a hash takes everything");
    written.with(data).with(sources).digits()
}
