//! Scenes with errors: the message names the place, and no file changes.
//!
//! In the scenes, `§` marks the place that the message must name; it is removed before the file is written.

use super::command::{contents, empty_folder, run};
use std::fs;

/// Exports `bytes` over an existing FMU. Returns the message, after checking that the FMU has not changed.
#[track_caller]
pub fn message_of(bytes: &[u8]) -> String {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), bytes).unwrap();
    fs::write(folder.path().join("unit.fmu"), "an older unit").unwrap();
    let run = run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(1);
    assert_eq!(contents(folder.path()), ["scene.toml", "unit.fmu"], "files were left");
    assert_eq!(fs::read(folder.path().join("unit.fmu")).unwrap(), b"an older unit");
    assert_eq!(run.out, "", "results of a job that failed");
    run.err
}

/// Exports the marked scene: the message must name the marked place and contain `parts`. Returns it.
#[track_caller]
pub fn refused_text(marked: &str, parts: &[&str]) -> String {
    let (before, after) = marked.split_once('§').expect("a marked place");
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
    let message = message_of(format!("{before}{after}").as_bytes());
    let place = format!("brinell: scene.toml:{line}:{column}: ");
    assert!(message.starts_with(&place), "not at {place}: {message}");
    for part in parts {
        assert!(message.contains(part), "nothing of {part:?} in: {message}");
    }
    message
}
