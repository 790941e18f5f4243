//! Files that the program writes for its user.

use std::io;
use std::io::Write;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A file that can't be read or written.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {source}", path = path.display())]
pub struct FileError {
    pub path: PathBuf,
    pub source: io::Error,
}

impl FileError {
    /// For `map_err`: what went wrong at `path`.
    pub fn at(path: &Path) -> impl Fn(io::Error) -> FileError {
        move |source| FileError { path: path.into(), source }
    }
}

/// Writes beside the goal and renames, so that no half of a file is ever found there.
///
/// # Errors
/// [`FileError`]; the goal is then as it was.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let file_error = FileError::at(path);
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let mut file = tempfile::Builder::new().prefix(".brinell-").tempfile_in(folder).map_err(&file_error)?;
    file.write_all(bytes).map_err(&file_error)?;
    #[cfg(unix)]
    {
        use std::fs::{Permissions, set_permissions};
        use std::os::unix::fs::PermissionsExt;
        let readable = Permissions::from_mode(0o644);
        set_permissions(file.path(), readable).map_err(&file_error)?;
    }
    file.persist(path).map_err(|error| file_error(error.error))?;
    Ok(())
}

/// A new folder in `parent` that nobody else can read or write, its name begins with `prefix`; it goes when it is dropped.
///
/// # Errors
/// [`FileError`]
pub fn private_folder(prefix: &str, parent: &Path) -> Result<TempDir, FileError> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o700));
    builder.prefix(prefix).tempdir_in(parent).map_err(FileError::at(parent))
}

/// Prints `text`, or writes it where the user wants it.
///
/// # Errors
/// [`FileError`]
pub fn deliver(text: &str, output: Option<&Path>) -> Result<(), FileError> {
    match output {
        None => {
            print!("{text}");
            Ok(())
        }
        Some(path) => write_whole(path, text.as_bytes()),
    }
}

/// The ending of the file that `output` names, one of `allowed`; without a file the first of them.
///
/// # Errors
/// What is allowed.
pub fn ending(output: Option<&Path>, allowed: &[&'static str]) -> Result<&'static str, String> {
    let Some(path) = output else { return Ok(allowed[0]) };
    let given = path.extension().and_then(|extension| extension.to_str());
    allowed.iter().copied().find(|&ending| given == Some(ending)).ok_or_else(|| {
        let (last, others) = allowed.split_last().expect("something is allowed");
        let others = others.iter().map(|ending| format!(".{ending}")).collect::<Vec<_>>().join(", ");
        let or = if others.is_empty() { "" } else { " or " };
        format!("{}: the name must end in {others}{or}.{last}", path.display())
    })
}
