//! The zip archive of an FMU: the same bytes for the same files.

use std::io::{self, BufWriter, Cursor, Write};
use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, System, ZipWriter};

/// An archive under construction.
pub struct Archive(ZipWriter<Cursor<Vec<u8>>>);

impl Default for Archive {
    fn default() -> Archive {
        Archive(ZipWriter::new(Cursor::new(Vec::new())))
    }
}

impl Archive {
    /// Adds a file.
    ///
    /// # Errors
    /// [`ZipError`]
    pub fn add(&mut self, name: &str, bytes: &[u8]) -> Result<(), ZipError> {
        self.add_written(name, |to| to.write_all(bytes))
    }

    /// Adds a file with contents that `write` writes piece by piece.
    ///
    /// # Errors
    /// [`ZipError`]
    pub fn add_written(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), ZipError> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(9))
            // the same bytes on every system
            .last_modified_time(zip::DateTime::default())
            .system(System::Unix)
            .unix_permissions(0o644);
        self.0.start_file(name, options)?;
        let mut buffer = BufWriter::new(&mut self.0);
        write(&mut buffer).and_then(|()| buffer.flush())?;
        Ok(())
    }

    /// The bytes of the archive.
    ///
    /// # Errors
    /// [`ZipError`]
    pub fn finish(self) -> Result<Vec<u8>, ZipError> {
        Ok(self.0.finish()?.into_inner())
    }
}

/// An archive of `files`.
///
/// # Errors
/// [`ZipError`]
pub fn archive(files: &[(String, &[u8])]) -> Result<Vec<u8>, ZipError> {
    let mut archive = Archive::default();
    for (name, bytes) in files {
        archive.add(name, bytes)?;
    }
    archive.finish()
}
