//! The hash of the contents of an FMU, which determines its GUID.

use sha2::{Digest, Sha256};
use std::io::{self, Write};

/// The hash of several texts.
#[derive(Default)]
pub struct Hash(Sha256);

impl Hash {
    /// Adds a text.
    #[must_use]
    pub fn with(mut self, text: &str) -> Hash {
        self.0.update(text);
        self.end_text();
        self
    }

    /// Adds the contents of a file.
    #[must_use]
    pub fn with_bytes(mut self, bytes: &[u8]) -> Hash {
        self.0.update(bytes);
        self.end_text();
        self
    }

    /// Adds all `texts`.
    #[must_use]
    pub fn with_all<'a>(self, texts: impl IntoIterator<Item = &'a str>) -> Hash {
        texts.into_iter().fold(self, Hash::with)
    }

    /// Adds a text that `write` writes in pieces.
    ///
    /// # Errors
    /// The errors of `write`.
    pub fn with_written(mut self, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<Hash> {
        write(&mut Pieces(&mut self.0))?;
        self.end_text();
        Ok(self)
    }

    /// Different lists of texts must have different hashes.
    fn end_text(&mut self) {
        self.0.update([0]);
    }

    /// 32 digits.
    pub fn digits(self) -> String {
        self.0.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect()
    }
}

/// Takes the pieces of a text.
struct Pieces<'a>(&'a mut Sha256);

impl Write for Pieces<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
