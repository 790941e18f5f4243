//! From a plan to an `.fmu`: rustc compiles the library, its symbols are checked, and everything is zipped.

mod compiler;
mod diagnostics;
mod error;
mod folder;
mod library;
mod link;
mod parts;
mod rustc;
mod toolchain;
mod way;

pub use error::ExportError;
pub use library::{Builder, Source};
pub use way::{Origin, Way};

use crate::files::write_whole;
use brinell_exporter::package::{Hash, Packed, pack};
use brinell_exporter::plan::Plan;
use brinell_exporter::platform::Platform;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use way::{Libraries, make};

include!(concat!(env!("OUT_DIR"), "/sources.rs"));

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
    let Libraries { guid, libraries, origin } = make(plan, way, platforms)?;
    let (archive, libraries) = pack(plan, &guid, platforms, &libraries)?;
    let size = archive.len();
    Ok((archive, Exported { path: PathBuf::new(), guid, size, libraries, origin: Some(origin) }))
}

/// The hash of the common input of all libraries: names and texts of the files.
pub fn sources_hash() -> &'static str {
    static HASH: LazyLock<String> = LazyLock::new(|| {
        let all = [CONTACT_SOURCE, FMU_SOURCE, UNIT_SOURCE, LIBM_SOURCE].into_iter().flatten();
        Hash::default().with_all(all.flat_map(|&(name, text)| [name, text])).digits()
    });
    &HASH
}

/// Identifier of the library: 16 digits of the hash of its sources and those of `libm`.
pub fn library_identity() -> &'static str {
    &sources_hash()[..16]
}
