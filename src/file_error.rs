//! The error of a file.

use brinell_exporter::layout::shown;
use std::io;
use std::path::{Path, PathBuf};

/// A file that cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {source}", path = shown(path))]
pub struct FileError {
    pub path: PathBuf,
    pub source: io::Error,
}

impl FileError {
    /// For `map_err`: the error at `path`.
    pub fn at(path: &Path) -> impl Fn(io::Error) -> FileError {
        move |source| FileError { path: path.into(), source }
    }
}
