//! The zip archive of an FMU: the same bytes for the same files.

use super::ExportError;
use std::io::{self, Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// An archive under construction.
pub struct Archive(ZipWriter<Cursor<Vec<u8>>>);

impl Archive {
    pub fn new() -> Archive {
        Archive(ZipWriter::new(Cursor::new(Vec::new())))
    }

    /// Adds a file.
    ///
    /// # Errors
    /// [`ExportError::Zip`]
    pub fn add(&mut self, name: &str, bytes: &[u8]) -> Result<(), ExportError> {
        self.add_written(name, |to| to.write_all(bytes))
    }

    /// Adds a file with contents that `write` writes in pieces.
    ///
    /// # Errors
    /// [`ExportError::Zip`]
    pub fn add_written(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), ExportError> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(9))
            .last_modified_time(zip::DateTime::default())
            .unix_permissions(0o644);
        self.0.start_file(name, options)?;
        let mut pieces = Pieces { to: &mut self.0, piece: Vec::with_capacity(PIECE) };
        write(&mut pieces).and_then(|()| pieces.flush()).map_err(zip::result::ZipError::from)?;
        Ok(())
    }

    /// The bytes of the archive.
    ///
    /// # Errors
    /// [`ExportError::Zip`]
    pub fn finish(self) -> Result<Vec<u8>, ExportError> {
        Ok(self.0.finish()?.into_inner())
    }
}

/// Length of the pieces passed to the compressor [bytes].
const PIECE: usize = 1 << 16;

/// Passes a file to the compressor in pieces of one length: the compressed bytes depend on the borders of the pieces.
struct Pieces<'a, W> {
    to: &'a mut W,
    piece: Vec<u8>,
}

impl<W: Write> Write for Pieces<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = bytes.len().min(PIECE - self.piece.len());
        self.piece.extend_from_slice(&bytes[..count]);
        if self.piece.len() == PIECE {
            self.to.write_all(&self.piece)?;
            self.piece.clear();
        }
        Ok(count)
    }

    /// Completes the file with the last, shorter piece.
    fn flush(&mut self) -> io::Result<()> {
        self.to.write_all(&self.piece)?;
        self.piece.clear();
        Ok(())
    }
}

/// An archive of `files`.
///
/// # Errors
/// [`ExportError::Zip`]
pub fn archive(files: &[(String, &[u8])]) -> Result<Vec<u8>, ExportError> {
    let mut archive = Archive::new();
    for (name, bytes) in files {
        archive.add(name, bytes)?;
    }
    archive.finish()
}
