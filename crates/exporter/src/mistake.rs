//! Mistakes in a scene, each with its place; the check of numbers against their ranges.

use crate::layout::shown;
use crate::numbers::{in_message, out_of_range};
use crate::units;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;
use std::borrow::Cow;
use std::ops::{Range, RangeInclusive};
use std::path::{Path, PathBuf};

/// A scene that cannot be used, with the place and the reason.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    #[error("{}: {source}", shown(path))]
    Unreadable { path: PathBuf, source: std::io::Error },
    #[error("{}:{line}:{column}: {message}", shown(path))]
    Wrong {
        path: PathBuf,
        line: usize,
        column: usize,
        /// The bytes of the text that are meant.
        span: Range<usize>,
        message: String,
    },
}

/// The text of a file with these `bytes`, which must be UTF-8.
///
/// # Errors
/// [`SceneError::Wrong`] with the place of the first byte that isn't, and what the file is if it is no text.
pub fn text(bytes: Vec<u8>, path: &Path) -> Result<String, SceneError> {
    let at_begin = |message: String| Err(Mistake(0..0, message).in_file("", path));
    let first = bytes.first().copied().unwrap_or_default();
    if let Some(encoding) = wide_encoding(&bytes) {
        return at_begin(format!("byte 0x{first:02X}: the file is in {encoding}; save the scene in UTF-8"));
    }
    if let Some((_, what)) = NO_SCENES.iter().find(|(begin, _)| bytes.starts_with(begin)) {
        return at_begin(format!("this is {what}; a scene is plain text (TOML): `brinell new NAME` writes one"));
    }
    if bytes.contains(&0) {
        let message =
            "this is no text, since it has bytes 0x00; a scene is plain text (TOML): `brinell new NAME` writes one";
        return at_begin(message.into());
    }
    String::from_utf8(bytes).map_err(|error| {
        let end = error.utf8_error().valid_up_to();
        let (before, wrong) = error.as_bytes().split_at(end);
        let before = String::from_utf8_lossy(before);
        let message = format!("byte 0x{:02X}: this isn't UTF-8; save the scene in UTF-8", wrong[0]);
        Mistake(end..end, message).in_file(&before, path)
    })
}

/// How files begin that are opened instead of a scene, and what they are. No scene begins so.
const NO_SCENES: [(&[u8], &str); 21] = [
    (b"\x89PNG", "a picture (PNG)"),
    (b"\xff\xd8\xff", "a picture (JPEG)"),
    (b"GIF8", "a picture (GIF)"),
    (b"II*\0", "a picture (TIFF)"),
    (b"%PDF", "a document (PDF)"),
    (b"{\\rtf", "a document (RTF): save it as plain text"),
    (b"\xd0\xcf\x11\xe0", "a document of an office program"),
    (b"PK\x03\x04", "a zip archive"),
    (b"PK\x05\x06", "an empty zip archive"),
    (b"\x1f\x8b", "compressed (gzip)"),
    (b"BZh", "compressed (bzip2)"),
    (b"\xfd7zXZ", "compressed (xz)"),
    (b"7z\xbc\xaf", "compressed (7z)"),
    (b"\x28\xb5\x2f\xfd", "compressed (zstd)"),
    (b"\x7fELF", "a program or a library"),
    (b"MZ\x90\0", "a program or a library"),
    (b"\xcf\xfa\xed\xfe", "a program or a library"),
    (b"\0asm", "a program or a library"),
    (b"\x89HDF", "data (HDF5)"),
    (b"PAR1", "a table (Parquet)"),
    (b"<", "a page of the web or other XML"),
];

/// The encoding of a text whose characters have more than one byte each, with a mark at its begin or without.
fn wide_encoding(bytes: &[u8]) -> Option<&'static str> {
    const LOOKED_AT: usize = 1000;
    let begin = || bytes.chunks_exact(4).take(LOOKED_AT);
    // of texts in Latin letters nearly all
    let is_zero = |place: usize| {
        let zeros = begin().filter(|letters| letters[place] == 0).count();
        10 * zeros > 9 * begin().count()
    };
    match (bytes, [0, 1, 2, 3].map(is_zero)) {
        ([0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..], _) => Some("UTF-32"),
        ([0xff, 0xfe, ..] | [0xfe, 0xff, ..], _) => Some("UTF-16"),
        (_, [false, true, true, true] | [true, true, true, false]) => Some("UTF-32"),
        (_, [false, true, false, true] | [true, false, true, false]) => Some("UTF-16"),
        _ => None,
    }
}

/// A value with its place in the text.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
#[serde(transparent)]
pub struct Spanned<T>(toml::Spanned<T>);

impl<T: JsonSchema> JsonSchema for Spanned<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

impl<T> Spanned<T> {
    pub fn new(span: Range<usize>, value: T) -> Spanned<T> {
        Spanned(toml::Spanned::new(span, value))
    }

    pub fn span(&self) -> Range<usize> {
        self.0.span()
    }

    pub fn get_ref(&self) -> &T {
        self.0.get_ref()
    }

    pub fn into_inner(self) -> T {
        self.0.into_inner()
    }
}

/// An error at a place in the text.
pub struct Mistake(pub Range<usize>, pub String);

impl Mistake {
    /// The error with its line and column in the `text` of the file at `path`. Numbers of a value with a unit are in that unit.
    pub fn in_file(self, text: &str, path: &Path) -> SceneError {
        let Mistake(span, message) = self;
        let message = units::in_unit_of(text.get(span.clone()).unwrap_or_default(), &message).unwrap_or(message);
        let before = &text[..span.start];
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
        SceneError::Wrong { path: path.into(), line, column, span, message }
    }
}

/// Positive and finite.
pub const POSITIVE: RangeInclusive<f64> = f64::MIN_POSITIVE..=f64::MAX;

/// Rejects a value with this name and unit unless it is `allowed`. `owner` precedes the name in the message.
pub fn check_range(
    (name, unit): (&str, &str),
    owner: &str,
    value: &Spanned<f64>,
    allowed: RangeInclusive<f64>,
) -> Result<(), Mistake> {
    if allowed == POSITIVE {
        return positive(&format!("{owner}{name}"), value).map(drop);
    }
    if allowed.contains(value.get_ref()) {
        return Ok(());
    }
    Err(Mistake(value.span(), format!("{owner}{name} {}", out_of_range(*value.get_ref(), &allowed, unit))))
}

/// Rejects a value with this name unless it is positive and finite.
pub fn positive(name: &str, value: &Spanned<f64>) -> Result<f64, Mistake> {
    let number = *value.get_ref();
    if number > 0.0 && number.is_finite() {
        return Ok(number);
    }
    Err(Mistake(value.span(), format!("{name} = {} must be positive and finite", in_message(number))))
}
