//! Unpacks untrusted archives with a bound on their size.

use super::ImportError;
use brinell_exporter::layout::shortened;
use std::fs::{self, File};
use std::io::{self, Read, Seek, Write};
use std::path::Path;
use zip::ZipArchive;

/// The largest size of an unpacked archive [bytes]. An FMU of 100,000 contacts with all outputs takes a third of it.
pub const LARGEST: u64 = 2 << 30;

/// The largest number of files. Each takes a place in the file system, whatever its size.
pub const MOST_FILES: usize = 100_000;

/// The remaining number of bytes.
pub struct Bound {
    left: u64,
}

impl Bound {
    /// The full bound, for an archive that does not declare more.
    ///
    /// # Errors
    /// [`ImportError::TooLarge`]
    pub fn of<R: Read + Seek>(archive: &ZipArchive<R>) -> Result<Bound, ImportError> {
        match archive.decompressed_size() {
            Some(size) if size > u128::from(LARGEST) => Err(ImportError::TooLarge),
            _ => Ok(Bound { left: LARGEST }),
        }
    }

    /// Copies all of `from`, whatever size it declares.
    ///
    /// # Errors
    /// [`ImportError::TooLarge`], [`ImportError::Unpack`]
    pub fn copy(&mut self, from: &mut impl Read, to: &mut impl Write) -> Result<(), ImportError> {
        let copied = io::copy(&mut from.take(self.left.saturating_add(1)), to).map_err(ImportError::Unpack)?;
        self.left = self.left.checked_sub(copied).ok_or(ImportError::TooLarge)?;
        Ok(())
    }
}

/// Opens an archive whose files have plain paths inside it as names, each once. Other names mean another file to each tool that
/// unpacks them.
///
/// # Errors
/// [`ImportError::NoArchive`], [`ImportError::TooMany`], [`ImportError::Path`], [`ImportError::Twice`]
pub fn open<R: Read + Seek>(reader: R) -> Result<ZipArchive<R>, ImportError> {
    let archive = ZipArchive::new(reader).map_err(|_| ImportError::NoArchive)?;
    if archive.len() > MOST_FILES {
        return Err(ImportError::TooMany);
    }
    for name in archive.file_names() {
        let name = name?;
        if !is_plain(&name) {
            return Err(ImportError::Path(shortened(&name)));
        }
    }
    if archive.has_duplicate_names() {
        return Err(ImportError::Twice);
    }
    Ok(archive)
}

/// Whether this name of a file or a folder is a path inside the archive on every operating system, without detours.
fn is_plain(name: &str) -> bool {
    let separators = ['/', '\\'];
    let path = name.strip_suffix(separators).unwrap_or(name);
    path.split(separators).all(|part| !matches!(part, "" | "." | "..") && !part.contains([':', '\0']))
}

/// Unpacks `archive` into `folder`: only files, and only those with paths inside the folder.
///
/// # Errors
/// [`ImportError::TooLarge`], [`ImportError::Unpack`], [`ImportError::Path`]
pub fn unpack<R: Read + Seek>(archive: &mut ZipArchive<R>, folder: &Path) -> Result<(), ImportError> {
    let mut bound = Bound::of(archive)?;
    for index in 0..archive.len() {
        let mut file = archive.by_index(index)?;
        if file.is_dir() {
            continue;
        }
        let Some(inside) = file.enclosed_name() else {
            let name = shortened(&String::from_utf8_lossy(file.name_raw()));
            return Err(ImportError::Path(name));
        };
        let goal = folder.join(inside);
        let name = shortened(&String::from_utf8_lossy(file.name_raw()));
        let named = |source| ImportError::Entry { name: format!("{name:?}"), source };
        let made = fs::create_dir_all(goal.parent().unwrap_or(folder)).and_then(|()| File::create(&goal));
        bound.copy(&mut file, &mut made.map_err(&named)?).map_err(|error| match error {
            ImportError::Unpack(source) => named(source),
            other => other,
        })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{Bound, ImportError};

    /// The size that an archive declares may be a lie: what counts is what comes out.
    #[test]
    fn more_than_the_bound_is_never_copied() {
        let mut bound = Bound { left: 10 };
        let mut to = Vec::new();
        bound.copy(&mut &[1; 4][..], &mut to).expect("four of ten");
        bound.copy(&mut &[2; 6][..], &mut to).expect("all ten");
        assert!(matches!(bound.copy(&mut std::io::repeat(3), &mut to), Err(ImportError::TooLarge)));
        assert_eq!(to.len(), 11, "one byte more shows that there are more");
    }
}
