//! A scene that cannot be used.

use std::ops::Range;
use std::path::{Path, PathBuf};

/// A scene that cannot be used, with the place and the reason.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    #[error("{}: {source}", path.display())]
    Unreadable { path: PathBuf, source: std::io::Error },
    #[error("{}:{line}:{column}: {message}", path.display())]
    Wrong { path: PathBuf, line: usize, column: usize, message: String },
}

/// An error at a place in the text.
pub struct Mistake(pub Range<usize>, pub String);

impl Mistake {
    /// The error with its line and column in the `text` of the file at `path`.
    pub fn in_file(self, text: &str, path: &Path) -> SceneError {
        let Mistake(span, message) = self;
        let before = &text[..span.start];
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
        SceneError::Wrong { path: path.into(), line, column, message }
    }
}
