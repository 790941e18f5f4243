//! Reads untrusted archives by rules that are checked before anything is unpacked, and while it is.

use super::error::{ImportError, LARGEST, MOST_FILES, allowed};
use brinell_exporter::layout::shortened;
use std::fs::{self, File};
use std::io::{self, Cursor, Read, Seek, SeekFrom, Write};
use std::path::Path;
use zip::ZipArchive;

/// An archive that keeps the rules: each file has a plain path as its name, each path is there once, no file is a link, and none, nor all
/// together, is too large. Other names, and links, mean another file to each tool that unpacks them.
pub struct BoundedArchive<R>(ZipArchive<R>);

impl<R: Read + Seek> BoundedArchive<R> {
    /// Opens an archive.
    ///
    /// # Errors
    /// [`ImportError`] of the first rule that it breaks.
    pub fn open(mut reader: R) -> Result<BoundedArchive<R>, ImportError> {
        let packed = reader.seek(SeekFrom::End(0)).map_err(|_| ImportError::NoArchive)?;
        // some commands hold all of it in memory
        if packed > LARGEST {
            return Err(ImportError::LargeFile(packed));
        }
        let archive = ZipArchive::new(reader).map_err(|_| ImportError::NoArchive)?;
        if archive.len() > MOST_FILES {
            return Err(ImportError::TooMany);
        }
        if archive.has_duplicate_names() {
            return Err(ImportError::Twice);
        }
        let mut total: u64 = 0;
        for index in 0..archive.len() {
            let file = archive.by_index_data(index)?;
            let name = file.name()?;
            let shown = || shortened(&name);
            if !is_plain(&name) {
                return Err(ImportError::Path(shown()));
            }
            if file.is_symlink() {
                return Err(ImportError::Link(shown()));
            }
            let most = allowed(file.compressed_size());
            if file.size() > most {
                return Err(ImportError::LargePart { name: shown(), size: file.size(), allowed: most });
            }
            total = total.saturating_add(file.size());
        }
        // the parts of an archive may overlap
        let most = allowed(packed);
        if total > most {
            return Err(ImportError::TooLarge { size: total, allowed: most });
        }
        Ok(BoundedArchive(archive))
    }

    /// The places of the files, without folders, by their names.
    pub fn files(&self) -> Result<Vec<(usize, String)>, ImportError> {
        let mut files = Vec::new();
        for index in 0..self.0.len() {
            let file = self.0.by_index_data(index)?;
            if !file.is_dir() {
                files.push((index, file.name()?.into_owned()));
            }
        }
        Ok(files)
    }

    /// Unpacks a file. It ends with an error if more comes out than the archive declares.
    ///
    /// # Errors
    /// [`ImportError::Entry`], [`ImportError::Undeclared`], [`ImportError::Zip`]
    pub fn copy(&mut self, index: usize, to: &mut impl Write) -> Result<(), ImportError> {
        let mut file = self.0.by_index(index)?;
        let (declared, name) = (file.size(), shortened(&file.name()?));
        match io::copy(&mut file.by_ref().take(declared.saturating_add(1)), to) {
            Ok(copied) if copied > declared => Err(ImportError::Undeclared { name, declared }),
            Ok(_) => Ok(()),
            Err(source) => Err(ImportError::Entry { name, source }),
        }
    }

    /// The bytes of the file with this name, of at most `most` bytes; `None` if there is none.
    ///
    /// # Errors
    /// As for [`BoundedArchive::copy`], and [`ImportError::LargePart`].
    pub fn read(&mut self, name: &str, most: u64) -> Result<Option<Vec<u8>>, ImportError> {
        let Some(index) = self.0.index_for_name(name) else { return Ok(None) };
        let size = self.0.by_index_data(index)?.size();
        if size > most {
            return Err(ImportError::LargePart { name: shortened(name), size, allowed: most });
        }
        let mut bytes = Vec::new();
        self.copy(index, &mut bytes)?;
        Ok(Some(bytes))
    }

    /// Unpacks all files into `folder`.
    ///
    /// # Errors
    /// As for [`BoundedArchive::copy`].
    pub fn unpack(&mut self, folder: &Path) -> Result<(), ImportError> {
        for (index, name) in self.files()? {
            let goal = folder.join(name.replace('\\', "/"));
            // where names of letters of another case are one file, it isn't written twice
            let made = fs::create_dir_all(goal.parent().unwrap_or(folder)).and_then(|()| File::create_new(&goal));
            let mut file = made.map_err(|source| ImportError::Entry { name: shortened(&name), source })?;
            self.copy(index, &mut file)?;
        }
        Ok(())
    }
}

impl BoundedArchive<Cursor<Vec<u8>>> {
    /// Opens an archive in an archive.
    ///
    /// # Errors
    /// As for [`BoundedArchive::open`].
    pub fn inside(bytes: Vec<u8>) -> Result<Self, ImportError> {
        BoundedArchive::open(Cursor::new(bytes))
    }
}

/// Whether this name of a file or a folder is a path inside the archive on every operating system, without detours.
fn is_plain(name: &str) -> bool {
    let separators = ['/', '\\'];
    let path = name.strip_suffix(separators).unwrap_or(name);
    path.split(separators).all(|part| !matches!(part, "" | "." | "..") && !part.contains([':', '\0']))
}
