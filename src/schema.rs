//! `brinell schema`: the JSON Schema of scenes, by which editors complete and check them.

use crate::files::{FileError, deliver};
use brinell_exporter::layout::json_line;
use brinell_exporter::schema::schema;
use std::path::{Path, PathBuf};

/// The file beside a scene that the first line of a new one names. It is relative, so that scenes and their schema move together, and
/// no scene knows its author's folders.
pub const FILE: &str = ".brinell.schema.json";

/// The arguments of `brinell schema`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Where to write it [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// The command: prints the schema.
pub fn run(arguments: &Arguments) -> Result<(), FileError> {
    write(arguments.output.as_deref())
}

/// Prints the schema, or writes it to this file.
pub fn write(output: Option<&Path>) -> Result<(), FileError> {
    deliver(&json_line(&schema()), output)
}
