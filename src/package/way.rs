//! The two ways to get a library: compile it, or fill in a prebuilt one.

use super::folder::Cache;
use super::library::{self, Source};
use super::rustc::Rustc;
use super::{ExportError, sources_hash};
use crate::parallel;
use crate::prebuilt::{PrebuiltError, Unit};
use brinell_exporter::constants;
use brinell_exporter::package::{GUID_TO_COME, guid, identified};
use brinell_exporter::plan::Plan;
use brinell_exporter::platform::Platform;
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// The way to make the library of an FMU.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
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
pub fn make(plan: &Plan, way: Way, platforms: &[Platform]) -> Result<Libraries, ExportError> {
    match way {
        Way::Compiled => compile(plan, platforms),
        Way::Prebuilt => Ok(fill_in(plan, platforms)?),
        Way::Any => match no_compiler() {
            None => compile(plan, platforms),
            // a prebuilt library needs neither a compiler nor a folder to build in
            Some(error) => fill_in(plan, platforms).map_err(|reason| match error {
                ExportError::NoRustc(_) => ExportError::NoCompiler(reason),
                other => other,
            }),
        },
    }
}

impl Way {
    /// Whether this way compiles the libraries.
    pub fn compiles(self) -> bool {
        self == Way::Compiled || self == Way::Any && no_compiler().is_none()
    }
}

/// The reason why no compiler can be started: there is none, or there is no build folder.
fn no_compiler() -> Option<ExportError> {
    match Cache::open().and_then(|cache| Rustc::find(&cache.folder)) {
        Err(error @ (ExportError::NoRustc(_) | ExportError::Folder(_))) => Some(error),
        _ => None,
    }
}

/// Compiles. The GUID is a hash of everything in the FMU: description, constants, source of the library and of `libm`.
fn compile(plan: &Plan, platforms: &[Platform]) -> Result<Libraries, ExportError> {
    let begin = Instant::now();
    let constants = constants::write(plan, GUID_TO_COME);
    let guid = guid(plan, &[&constants], sources_hash());
    let constants = identified(&constants, &guid);
    let libraries = library::build(&Source::Scene { plan, constants: &constants }, platforms)?;
    Ok(Libraries { guid, libraries, origin: Origin { prebuilt: None, time: begin.elapsed() } })
}

/// Uses a prebuilt library.
fn fill_in(plan: &Plan, platforms: &[Platform]) -> Result<Libraries, PrebuiltError> {
    let begin = Instant::now();
    let unit = Unit::of(plan)?;
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
