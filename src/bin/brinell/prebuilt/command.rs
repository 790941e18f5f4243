//! `brinell prebuild`: compiles the libraries that need no compiler afterwards.

use super::kinds::{KINDS, Laws, Library};
use super::store::{self, Written};
use crate::arguments::PrebuildArguments;
use crate::constants;
use crate::files::FileError;
use crate::package::{ExportError, Source, build_library};
use crate::plan::Plan;
use crate::platform::{self, Platform};
use crate::symbols;
use indicatif::ProgressBar;
use serde_json::json;
use std::collections::BTreeMap;
use std::error::Error;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::{fs, thread};

/// The command: builds the libraries that are asked for, for each platform, and writes them into a folder.
///
/// # Errors
/// A law or kind that there isn't, or that of the first library that can't be built or written.
pub fn run(arguments: &PrebuildArguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let libraries = chosen(arguments)?;
    let platforms = [platform::here()?];
    fs::create_dir_all(&arguments.output).map_err(FileError::at(&arguments.output))?;
    for platform in &platforms {
        let built = build_all(&libraries, platform)?;
        let saves = compiling_saves(&libraries, &built, platform)?;
        let listed: Vec<_> = libraries.iter().zip(built).collect();
        let Written { libraries, unpacked, packed } = store::write(&arguments.output, platform, &listed, saves)?;
        let folder = platform.folder;
        if as_json {
            println!(
                "{}",
                json!({ "platform": folder, "libraries": libraries, "size": unpacked, "compressed": packed })
            );
        } else {
            println!("{folder}: {libraries} libraries of {unpacked} bytes, {packed} bytes compressed");
        }
    }
    Ok(())
}

/// The libraries that are asked for.
fn chosen(arguments: &PrebuildArguments) -> Result<Vec<Library>, String> {
    let known: Vec<_> = Laws::all().iter().flat_map(|laws| [laws.loading.to_string(), laws.name()]).collect();
    refuse_unknown("law", &arguments.laws, &known)?;
    let kinds: Vec<_> = KINDS.iter().map(|kind| kind.name.to_string()).collect();
    refuse_unknown("kind", &arguments.kinds, &kinds)?;
    let is_asked_for = |asked: &[String], names: &[&str]| {
        asked.is_empty() || asked.iter().any(|asked| names.contains(&asked.as_str()))
    };
    let mut libraries = Library::all();
    libraries.retain(|library| {
        is_asked_for(&arguments.laws, &[library.laws.loading, &library.laws.name()])
            && is_asked_for(&arguments.kinds, &[library.kind.name])
    });
    Ok(libraries)
}

fn refuse_unknown(what: &str, asked: &[String], known: &[String]) -> Result<(), String> {
    let Some(unknown) = asked.iter().find(|asked| !known.contains(asked)) else { return Ok(()) };
    let mut known = known.to_vec();
    known.dedup();
    Err(format!("there is no {what} `{unknown}`, but `{}`", known.join("`, `")))
}

/// Libraries with their places in a list.
type Built = Vec<(usize, Vec<u8>)>;

/// The libraries for `platform`, as many at a time as there are processors.
fn build_all(libraries: &[Library], platform: &Platform) -> Result<Vec<Vec<u8>>, ExportError> {
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    let progress = ProgressBar::new(libraries.len() as u64);
    let next = AtomicUsize::new(0);
    let work = || {
        let mut built = Built::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(library) = libraries.get(index) else { return Ok(built) };
            let made = build(library, platform);
            if made.is_err() {
                // the others needn't go on
                next.store(libraries.len(), Ordering::Relaxed);
            }
            built.push((index, made?));
            progress.inc(1);
        }
    };
    let parts: Vec<Result<Built, ExportError>> = thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        threads.into_iter().map(|thread| thread.join().expect("building doesn't panic")).collect()
    });
    progress.finish_and_clear();
    let mut built = parts.into_iter().collect::<Result<Vec<_>, _>>()?.concat();
    built.sort_by_key(|(index, _)| *index);
    Ok(built.into_iter().map(|(_, bytes)| bytes).collect())
}

/// One prebuilt library.
fn build(library: &Library, platform: &Platform) -> Result<Vec<u8>, ExportError> {
    let (text, _) = library.source();
    let bytes = build_library(&Source::Kind { text: &text }, platform)?;
    symbols::check(&bytes)?;
    Ok(bytes)
}

/// By how much the compiled library of a scene with the same laws and outputs is smaller, for the first laws of each kind.
fn compiling_saves(
    libraries: &[Library],
    built: &[Vec<u8>],
    platform: &Platform,
) -> Result<BTreeMap<String, i64>, ExportError> {
    let mut saves = BTreeMap::new();
    for (library, bytes) in libraries.iter().zip(built) {
        if !saves.contains_key(library.kind.name) {
            let plan = Plan::of(&library.scene);
            let constants = constants::write(&plan, &"0".repeat(32));
            let compiled = build_library(&Source::Scene { plan: &plan, constants: &constants }, platform)?;
            saves.insert(library.kind.name.to_string(), bytes.len() as i64 - compiled.len() as i64);
        }
    }
    Ok(saves)
}
