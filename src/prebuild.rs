//! `brinell prebuild`: compiles the libraries that need no compiler afterwards.

use crate::arguments::PrebuildArguments;
use crate::files::FileError;
use crate::messages::tell;
use crate::package::{Builder, ExportError, LibraryWay, Source};
use crate::parallel;
use crate::prebuilt::{self, Written};
use crate::sources;
use brinell_exporter::layout::json_line;
use brinell_exporter::package::PackError;
use brinell_exporter::platform::{self, Target};
use brinell_exporter::prebuilt::{KINDS, Library, LibraryLaws};
use brinell_exporter::symbols;
use serde_json::json;
use std::error::Error;
use std::fs;

/// The command: builds the requested libraries for each target and writes them to a folder.
///
/// # Errors
/// Unknown laws and kinds; the first library that can't be built or written.
pub fn run(arguments: &PrebuildArguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let libraries = chosen(arguments)?;
    let targets = platform::targets(&arguments.platforms.chosen(LibraryWay::Compiled)?);
    let builder = Builder::new()?;
    builder.check(&targets)?;
    fs::create_dir_all(&arguments.output).map_err(FileError::at(&arguments.output))?;
    for target in targets {
        let built = build_all(&builder, &libraries, target)?;
        let listed: Vec<_> = libraries.iter().zip(built).collect();
        let Written { libraries, unpacked, packed } = prebuilt::write(&arguments.output, target, &listed)?;
        let triple = target.triple;
        if as_json {
            let object = json!({ "target": triple, "libraries": libraries, "size": unpacked, "compressed": packed });
            print!("{}", json_line(&object));
        } else {
            println!("{triple}: {libraries} libraries of {unpacked} bytes, {packed} bytes compressed");
        }
    }
    Ok(())
}

/// The requested libraries.
fn chosen(arguments: &PrebuildArguments) -> Result<Vec<Library>, String> {
    let known: Vec<_> = LibraryLaws::all().iter().flat_map(|laws| [laws.loading.to_string(), laws.name()]).collect();
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

/// The libraries for `target`.
fn build_all(builder: &Builder, libraries: &[Library], target: &'static Target) -> Result<Vec<Vec<u8>>, ExportError> {
    tell(&format!("compiling {} libraries for {} ...", libraries.len(), target.triple));
    parallel::each(libraries, |library| {
        let (text, _) = library.source(sources::hash());
        let bytes = builder.build(&Source::Kind { text: &text }, target)?;
        let refused = |reason| PackError::Symbols { platform: target.triple, reason };
        symbols::check(&bytes, &target.alone(), false).map_err(refused)?;
        Ok(bytes)
    })
}
