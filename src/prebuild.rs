//! `brinell prebuild`: compiles the libraries that need no compiler afterwards.

use crate::arguments::PrebuildArguments;
use crate::files::FileError;
use crate::messages::tell;
use crate::package::{Builder, ExportError, LibraryWay, Source, c_source};
use crate::parallel;
use crate::prebuilt;
use crate::sources;
use brinell_exporter::layout::json_line;
use brinell_exporter::package::PackError;
use brinell_exporter::platform::{self, System, Target};
use brinell_exporter::prebuilt::archive::Written;
use brinell_exporter::prebuilt::{LIBRARIES, Library};
use brinell_exporter::symbols;
use serde_json::json;
use std::error::Error;
use std::fs;

/// The command: builds the requested libraries for each target and writes them to a folder.
///
/// # Errors
/// Unknown kinds; the first library that can't be built or written.
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
    let known = LIBRARIES.map(|library| library.name);
    if let Some(unknown) = arguments.kinds.iter().find(|asked| !known.contains(&asked.as_str())) {
        return Err(format!("there is no kind `{unknown}`, but `{}`", known.join("`, `")));
    }
    let is_asked_for = |library: &Library| arguments.kinds.iter().any(|asked| asked == library.name);
    Ok(LIBRARIES.into_iter().filter(|library| arguments.kinds.is_empty() || is_asked_for(library)).collect())
}

/// The libraries for `target`.
fn build_all(builder: &Builder, libraries: &[Library], target: &'static Target) -> Result<Vec<Vec<u8>>, ExportError> {
    tell(&format!("compiling {} libraries for {} ...", libraries.len(), target.triple));
    parallel::each(libraries, |library| {
        let (text, _) = library.source(sources::hash());
        let bytes = builder.build(&Source::Kind { text: &text }, target)?;
        if target.system == System::WebAssembly {
            return c_source::made(&bytes, library.name);
        }
        let refused = |reason| PackError::Symbols { platform: target.triple, reason };
        symbols::check(&bytes, &target.alone(), false).map_err(refused)?;
        Ok(bytes)
    })
}
