//! The two ways to get a library: compile it, or fill in a prebuilt one.

use super::folder::Cache;
use super::library::{self, Source};
use super::rustc::Rustc;
use super::{ExportError, GUID_TO_COME, Hash, identified, sources};
use crate::plan::Plan;
use crate::platform::Platform;
use crate::prebuilt::{PrebuiltError, StoreError, Unit};
use crate::{constants, model_description, parallel};
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

/// The parts of an FMU that depend on the way.
pub struct Made {
    pub guid: String,
    /// One for each platform.
    pub libraries: Vec<Vec<u8>>,
    pub how: How,
}

/// How a library was made, and the result of the other way.
#[derive(Debug)]
pub struct How {
    /// How long it took.
    time: Duration,
    by: By,
}

#[derive(Debug)]
enum By {
    /// The prebuilt library that fits the scene and its additional size [bytes], or the reason why there is none.
    Compiler(Result<(String, i64), String>),
    /// The prebuilt library, and the saving of a compiled one [bytes].
    Prebuilt(String, Option<i64>),
}

/// Makes the libraries of the planned FMU for `platforms`, and the files that belong to them.
///
/// # Errors
/// [`ExportError`]
pub fn make(plan: &Plan, way: Way, platforms: &[Platform]) -> Result<Made, ExportError> {
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
fn compile(plan: &Plan, platforms: &[Platform]) -> Result<Made, ExportError> {
    let begin = Instant::now();
    let constants = constants::write(plan, GUID_TO_COME);
    let description = Hash::new().with_written(|to| model_description::write(plan, GUID_TO_COME, to));
    let guid = description.map_err(zip::result::ZipError::from)?.with(&constants).with_all(sources()).digits();
    let constants = identified(&constants, &guid);
    let libraries = library::build(&Source::Scene { plan, constants: &constants }, platforms)?;
    let time = begin.elapsed();
    let larger = |unit: Unit| {
        let mut larger = 0;
        for (platform, library) in platforms.iter().zip(&libraries) {
            larger += unit.sizes(platform)?.0 as i64 - library.len() as i64;
        }
        Some((unit.library.name(), larger))
    };
    let other = Unit::of(plan).map_err(|error| match error {
        PrebuiltError::Store(StoreError::NoFolder | StoreError::Empty { .. }) => {
            "no prebuilt libraries are installed".into()
        }
        PrebuiltError::NeedsCompiler(needs) => needs.to_string(),
        other => other.to_string(),
    });
    let other = other.and_then(|unit| larger(unit).ok_or_else(|| "there is none for these platforms".into()));
    Ok(Made { guid, libraries, how: How { time, by: By::Compiler(other) } })
}

/// Uses a prebuilt library.
fn fill_in(plan: &Plan, platforms: &[Platform]) -> Result<Made, PrebuiltError> {
    let begin = Instant::now();
    let unit = Unit::of(plan)?;
    let libraries = parallel::each(platforms, |platform| unit.library(platform))?;
    let saves = platforms.iter().map(|platform| unit.sizes(platform).and_then(|(_, saves)| saves)).sum();
    let how = How { time: begin.elapsed(), by: By::Prebuilt(unit.library.name(), saves) };
    Ok(Made { guid: unit.guid, libraries, how })
}

impl How {
    /// For people.
    pub fn words(&self) -> String {
        let seconds = self.time.as_secs_f64();
        match &self.by {
            By::Compiler(Ok((name, larger))) => format!(
                "compiled in {seconds:.1} s; the prebuilt library `{name}` (--prebuilt) would save that, and take {larger} \
                 bytes more"
            ),
            By::Compiler(Err(reason)) => format!("compiled in {seconds:.1} s; not prebuilt ({reason})"),
            By::Prebuilt(name, saves) => {
                let saves = saves.map_or("some bytes".into(), |saves| format!("at least {saves} bytes"));
                format!(
                    "from the prebuilt library `{name}` in {seconds:.2} s; compiling (--compile) would save {saves}"
                )
            }
        }
    }

    /// For programs.
    pub fn json(&self) -> Value {
        let seconds = self.time.as_secs_f64();
        match &self.by {
            By::Compiler(Ok((name, larger))) => {
                json!({ "by": "compiler", "seconds": seconds, "prebuilt": name, "prebuilt_is_larger_by": larger })
            }
            By::Compiler(Err(reason)) => json!({ "by": "compiler", "seconds": seconds, "not_prebuilt": reason }),
            By::Prebuilt(name, saves) => {
                json!({ "by": "prebuilt", "seconds": seconds, "prebuilt": name, "prebuilt_is_larger_by": saves })
            }
        }
    }
}
