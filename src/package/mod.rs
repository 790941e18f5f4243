//! From a plan to an `.fmu`: rustc compiles the library, or a prebuilt one is filled in, and everything is packed.

pub mod c_source;
mod compiler;
mod diagnostics;
pub mod error;
pub mod folder;
mod library;
mod link;
pub mod parts;
mod rustc;

pub use error::ExportError;
pub use library::{Builder, Source};

use crate::files::write_whole;
use crate::parallel;
use crate::prebuilt::{PrebuiltError, StoredUnit};
use crate::sources;
use brinell_exporter::library::{guid_of, write};
use brinell_exporter::package::{Packed, pack};
use brinell_exporter::plan::Plan;
use brinell_exporter::platform::Platform;
use folder::Cache;
use rustc::Rustc;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

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
pub fn export(plan: &Plan, way: LibraryWay, platforms: &[Platform], path: &Path) -> Result<Exported, ExportError> {
    let (archive, exported) = build(plan, way, platforms)?;
    write_whole(path, &archive)?;
    Ok(Exported { path: path.into(), ..exported })
}

/// Makes the planned FMU in this `way` for `platforms`. Returns the bytes of its archive and a description without a
/// path.
///
/// # Errors
/// [`ExportError`]
pub fn build(plan: &Plan, way: LibraryWay, platforms: &[Platform]) -> Result<(Vec<u8>, Exported), ExportError> {
    let Libraries { guid, libraries, origin } = make(plan, way, platforms)?;
    let (archive, libraries) = pack(plan, &guid, platforms, &libraries)?;
    let size = archive.len();
    Ok((archive, Exported { path: PathBuf::new(), guid, size, libraries, origin: Some(origin) }))
}

/// The way to make the library of an FMU.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LibraryWay {
    /// Compile if there is a compiler, otherwise use a prebuilt library.
    Any,
    Compiled,
    Prebuilt,
}

/// The libraries of an FMU.
pub struct Libraries {
    pub guid: String,
    /// One for each platform.
    pub libraries: Vec<Vec<u8>>,
    pub origin: Origin,
}

/// Where the libraries of an FMU come from.
#[derive(Debug)]
pub struct Origin {
    /// The name of the prebuilt library; `None` if it was compiled.
    prebuilt: Option<String>,
    /// How long it took.
    time: Duration,
}

/// Makes the libraries of the planned FMU for `platforms`, and the files that belong to them.
///
/// # Errors
/// [`ExportError`]
pub fn make(plan: &Plan, way: LibraryWay, platforms: &[Platform]) -> Result<Libraries, ExportError> {
    match way {
        LibraryWay::Compiled => compile(plan, platforms),
        LibraryWay::Prebuilt => Ok(fill_in(plan, platforms)?),
        LibraryWay::Any => match no_compiler() {
            None => compile(plan, platforms),
            // a prebuilt library needs neither a compiler nor a folder to build in
            Some(error) => fill_in(plan, platforms).map_err(|reason| match error {
                ExportError::NoRustc(_) => ExportError::NoCompiler(reason),
                other => other,
            }),
        },
    }
}

impl LibraryWay {
    /// Whether this way compiles the libraries.
    pub fn compiles(self) -> bool {
        self == LibraryWay::Compiled || self == LibraryWay::Any && no_compiler().is_none()
    }
}

/// The reason why no compiler can be started: there is none, or there is no build folder.
fn no_compiler() -> Option<ExportError> {
    match Cache::open().and_then(|cache| Rustc::find(&cache.folder)) {
        Err(error @ (ExportError::NoRustc(_) | ExportError::Folder(_))) => Some(error),
        _ => None,
    }
}

/// Compiles; C source comes from a prebuilt library. The GUID is a hash of everything in the FMU: description, data, source of the
/// library and of `libm`.
fn compile(plan: &Plan, platforms: &[Platform]) -> Result<Libraries, ExportError> {
    let begin = Instant::now();
    let guid = guid_of(plan, sources::hash());
    let (sources, native): (Vec<_>, Vec<_>) = platforms.iter().copied().partition(Platform::is_source);
    let mut libraries = library::build(&Source::Scene { plan, text: &write(plan, &guid) }, &native)?;
    // the last of all platforms; no C source is compiled from Rust
    if !sources.is_empty() {
        let unit = StoredUnit::of(plan)?;
        for platform in &sources {
            libraries.push(unit.library(platform)?);
        }
    }
    Ok(Libraries { guid, libraries, origin: Origin { prebuilt: None, time: begin.elapsed() } })
}

/// Uses a prebuilt library.
fn fill_in(plan: &Plan, platforms: &[Platform]) -> Result<Libraries, PrebuiltError> {
    let begin = Instant::now();
    let unit = StoredUnit::of(plan)?;
    let libraries = parallel::each(platforms, |platform| unit.library(platform))?;
    let (guid, name) = unit.named();
    Ok(Libraries { guid, libraries, origin: Origin { prebuilt: Some(name), time: begin.elapsed() } })
}

impl Origin {
    /// For people.
    pub fn words(&self) -> String {
        let seconds = self.time.as_secs_f64();
        match &self.prebuilt {
            None => format!("compiled in {seconds:.1} s"),
            Some(name) => format!(
                "from the prebuilt library `{name}` in {seconds:.2} s; a compiled one (--compile) has less that the scene doesn't need"
            ),
        }
    }

    /// For programs.
    pub fn json(&self) -> Value {
        let by = if self.prebuilt.is_some() { "prebuilt" } else { "compiler" };
        json!({ "by": by, "seconds": self.time.as_secs_f64(), "prebuilt": self.prebuilt })
    }
}
