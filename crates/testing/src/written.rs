//! The library of a scene as the exporter writes it for the compiler: its laws as types, and its data as words.

use crate::command::{empty_folder, run};
use std::fs;

/// What the exporter writes for a scene.
pub struct Written {
    /// The file.
    pub rust: String,
    /// The words of the data.
    pub words: Vec<u64>,
}

impl Written {
    /// That of the scene with this `text`.
    pub fn of(text: &str) -> Written {
        let folder = empty_folder();
        fs::write(folder.path().join("scene.toml"), text).expect("the folder is writable");
        let rust = run(folder.path(), ["constants", "scene.toml"]).with_status(0).out;
        let word = |part: &str| u64::from_str_radix(part.strip_prefix("0x")?.trim_end_matches(','), 16).ok();
        let words = rust.split_whitespace().filter_map(word).collect();
        Written { rust, words }
    }

    /// Whether this number is among the data.
    pub fn has_number(&self, number: f64) -> bool {
        self.words.contains(&number.to_bits())
    }

    /// Whether this text is among the data.
    pub fn has_text(&self, text: &str) -> bool {
        let bytes: Vec<u8> = self.words.iter().flat_map(|word| word.to_le_bytes()).collect();
        bytes.windows(text.len()).any(|window| window == text.as_bytes())
    }
}
