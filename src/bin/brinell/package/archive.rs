//! The zip archive of an FMU: the same bytes for the same files.

use super::ExportError;
use super::deflate::{self, Deflated};
use crate::parallel;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::io::{self, Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

/// An archive under construction.
pub struct Archive(ZipWriter<Cursor<Vec<u8>>>);

impl Archive {
    pub fn new() -> Archive {
        Archive(ZipWriter::new(Cursor::new(Vec::new())))
    }

    /// Adds files, which are compressed on several processors.
    ///
    /// # Errors
    /// [`ExportError::Zip`]
    pub fn add_all(&mut self, files: &[(String, &[u8])]) -> Result<(), ExportError> {
        let mut largest_first: Vec<usize> = (0..files.len()).collect();
        largest_first.sort_by_key(|&index| Reverse(files[index].1.len()));
        let compressed =
            parallel::each(&largest_first, |&index| Ok::<_, ExportError>((index, Deflated::new(files[index].1))))?;
        let compressed: BTreeMap<usize, Option<Deflated>> = compressed.into_iter().collect();
        for ((name, bytes), compressed) in files.iter().zip(compressed.values()) {
            match compressed {
                Some(compressed) => self.add_deflated(name, compressed)?,
                None => self.add_written(name, |to| to.write_all(bytes))?,
            }
        }
        Ok(())
    }

    /// Adds a file that is compressed already. The writer takes such a file only from another archive.
    fn add_deflated(&mut self, name: &str, file: &Deflated) -> Result<(), ExportError> {
        let mut archive = ZipArchive::new(Cursor::new(deflate::archive_of_one(name, file)))?;
        self.0.raw_copy_file(archive.by_index_raw(0)?)?;
        Ok(())
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
        let mut pieces = Pieces { to: self, name, piece: Vec::with_capacity(PIECE), is_started: false };
        write(&mut pieces).map_err(zip::result::ZipError::from)?;
        let Pieces { piece, is_started, .. } = pieces;
        if !is_started && let Some(deflated) = Deflated::new(&piece) {
            return self.add_deflated(name, &deflated);
        }
        self.0.write_all(&piece).map_err(zip::result::ZipError::from)?;
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

/// Length of the pieces passed to the compressor [bytes]. A file that is one piece is compressed as a whole.
const PIECE: usize = 1 << 16;
const _: () = assert!(PIECE <= deflate::LARGEST);

/// Passes a file to the compressor in pieces of one length: the compressed bytes depend on the borders of the pieces. The last,
/// shorter one is left.
struct Pieces<'a> {
    to: &'a mut Archive,
    name: &'a str,
    piece: Vec<u8>,
    is_started: bool,
}

impl Write for Pieces<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.piece.len() == PIECE {
            let writer = &mut self.to.0;
            if !self.is_started {
                let options = SimpleFileOptions::default()
                    .compression_method(CompressionMethod::Deflated)
                    .compression_level(Some(9))
                    .last_modified_time(zip::DateTime::default())
                    .unix_permissions(0o644);
                writer.start_file(self.name, options)?;
                self.is_started = true;
            }
            writer.write_all(&self.piece)?;
            self.piece.clear();
        }
        let count = bytes.len().min(PIECE - self.piece.len());
        self.piece.extend_from_slice(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// An archive of `files`.
///
/// # Errors
/// [`ExportError::Zip`]
pub fn archive(files: &[(String, &[u8])]) -> Result<Vec<u8>, ExportError> {
    let mut archive = Archive::new();
    archive.add_all(files)?;
    archive.finish()
}
