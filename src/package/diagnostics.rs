//! Error messages of the compiler, reduced to their cause.

use super::error::{ExportError, how_to_install};
use serde::Deserialize;
use std::env;
use std::path::Path;
use std::process::Output;

/// One line of `rustc --error-format=json`.
#[derive(Deserialize)]
struct Message {
    message: String,
    #[serde(default)]
    level: String,
    #[serde(default)]
    children: Vec<Message>,
}

/// Messages of operating systems for a full disk.
const NO_SPACE: [&str; 5] =
    ["No space left on device", "Disk quota exceeded", "File too large", "not enough space on the disk", "SIGXFSZ"];

/// The reason why the compiler failed in `folder` with this `output`.
pub fn cause(output: &Output, folder: &Path) -> ExportError {
    let said = String::from_utf8_lossy(&output.stderr);
    let (mut errors, mut plain) = (Vec::new(), Vec::new());
    for line in said.lines().filter(|line| !line.trim().is_empty()) {
        match serde_json::from_str::<Message>(line) {
            Ok(message) if message.level.starts_with("error") => errors.push(message),
            Ok(_) => {}
            // an error before the compiler has read its arguments, or while it crashes
            Err(_) => plain.push(line.trim()),
        }
    }
    let status = output.status.to_string();
    let is_said = |words: &&&str| said.contains(**words) || status.contains(**words);
    if let Some(words) = NO_SPACE.iter().find(is_said) {
        // the place to free space; the build folder of this FMU no longer exists
        let folder = folder.ancestors().nth(2).unwrap_or(folder).into();
        return ExportError::NoSpace { folder, said: (*words).into() };
    }
    let Some(first) = errors.first() else {
        let said = plain.first().map(|line| format!(": {line}")).unwrap_or_default();
        return ExportError::Compiler(format!("it ended with {status}{said}"));
    };
    linker_fault(first).unwrap_or_else(|| {
        let notes = first.children.iter().map(|child| child.message.trim());
        let all: Vec<_> = std::iter::once(first.message.trim()).chain(notes).collect();
        ExportError::Compiler(all.join("; "))
    })
}

/// The linker error, if the message is about the linker.
fn linker_fault(error: &Message) -> Option<ExportError> {
    let linker = error.message.split('`').nth(1)?.to_string();
    if error.message == format!("linker `{linker}` not found") {
        return Some(ExportError::NoLinker { linker, install: how_to_install(env::consts::OS) });
    }
    let status = match error.message.strip_prefix(&format!("linking with `{linker}` failed: ")) {
        Some(status) => status,
        None if error.message == format!("could not exec the linker `{linker}`") => "it can't be started",
        None => return None,
    };
    // besides the message there is the whole command, and a note that some of it was left out
    let words = error.children.iter().map(|child| child.message.as_str());
    let words =
        words.filter(|words| !words.trim_start().starts_with('"') && !words.starts_with("some arguments are omitted"));
    let lines: Vec<_> = words.flat_map(str::lines).map(str::trim).filter(|line| !line.is_empty()).collect();
    let said = lines.iter().find(|line| !line.contains("warning")).or(lines.first());
    let said = said.map_or("it says nothing".into(), |line| (*line).to_string());
    Some(ExportError::Linker { linker, status: status.into(), said })
}
