//! Scenes with errors: the message names the place, and no file changes.

use super::command::{contents, empty_folder, run};
use crate::places::{build, temporary};
use serde_json::json;
use std::collections::hash_map::DefaultHasher;
use std::fs;
use std::hash::{Hash as _, Hasher as _};
use std::path::PathBuf;
use std::sync::Once;

/// The folder of the scenes that this build of the program has refused, one file for each with the message: the page says the same.
pub fn folder() -> PathBuf {
    temporary().join("refused").join(build())
}

/// Keeps a scene and its message.
fn keep(bytes: &[u8], message: &str) {
    static FORGET: Once = Once::new();
    FORGET.call_once(|| {
        // those of earlier builds
        let all = temporary().join("refused");
        let others = fs::read_dir(all).into_iter().flatten().flatten().map(|entry| entry.path());
        others.filter(|other| *other != folder()).for_each(|other| drop(fs::remove_dir_all(other)));
    });
    let Ok(scene) = str::from_utf8(bytes) else { return };
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    fs::create_dir_all(folder()).expect("the target folder can be written to");
    let file = folder().join(format!("{:016x}.json", hasher.finish()));
    let text = json!({ "scene": scene, "message": message }).to_string();
    // a test that reads meanwhile finds all or nothing
    let half = file.with_extension("half");
    fs::write(&half, text).and_then(|()| fs::rename(half, file)).expect("the target folder can be written to");
}

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
    keep(bytes, &run.err);
    run.err
}
