//! `brinell new`: a commented scene to start from.

use crate::files::{self, FileError};
use crate::messages::WrongCall;
use crate::schema;
use brinell_exporter::layout::{json_line, shown};
use brinell_exporter::scene::{check_name, new_scene};
use serde_json::json;
use std::error::Error;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The arguments of `brinell new`.
#[derive(clap::Args)]
#[command(next_line_help = true)]
pub struct Arguments {
    /// Name of the contact: letters, digits and `_`
    pub name: String,
    /// Where to write the scene [default: NAME.toml in the current folder]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// Writes the scene, unless the file exists, and beside it the schema that its first line names.
pub fn run(arguments: &Arguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let Arguments { name, output } = arguments;
    check_name(name).map_err(WrongCall)?;
    let path = output.clone().unwrap_or_else(|| format!("{name}.toml").into());
    let text = format!("#:schema ./{}\n{}", schema::FILE, new_scene(name));
    write_new(&path, &text)?;
    let schema = files::folder_of(&path).join(schema::FILE);
    schema::write(Some(&schema))?;
    if as_json {
        print!("{}", json_line(&json!({ "scene": path.to_string_lossy(), "schema": schema.to_string_lossy() })));
    } else {
        let [file, schema] = [shown(&path), shown(&schema)];
        print!(
            "wrote {file}, a scene to change in any editor\n      {schema}, by which editors complete and check it\n\
             next:  brinell predict {file}    what the impact does\n\
             \x20      brinell export {file}     the FMU, {name}.fmu\n"
        );
    }
    Ok(())
}

/// Writes a file that must not exist.
fn write_new(path: &Path, text: &str) -> Result<(), FileError> {
    let file_error = FileError::at(path);
    if path.exists() {
        let error = io::Error::new(io::ErrorKind::AlreadyExists, "this file exists already, and is not overwritten");
        return Err(file_error(error));
    }
    files::check_goal(path)?;
    let mut file = std::fs::File::create_new(path).map_err(&file_error)?;
    file.write_all(text.as_bytes()).map_err(|error| {
        // half a scene would be in the way of the next attempt
        let _ = std::fs::remove_file(path);
        file_error(error)
    })
}
