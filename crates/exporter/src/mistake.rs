//! Mistakes in a scene, each with its place; the check of numbers against their ranges.

use crate::layout::shown;
use crate::numbers::{in_message, out_of_range};
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
/// [`SceneError::Wrong`] with the place of the first byte that isn't.
pub fn text(bytes: Vec<u8>, path: &Path) -> Result<String, SceneError> {
    let is_utf16 = bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]);
    String::from_utf8(bytes).map_err(|error| {
        let end = error.utf8_error().valid_up_to();
        let (before, wrong) = error.as_bytes().split_at(end);
        let before = String::from_utf8_lossy(before);
        let encoding = if is_utf16 { "the file is in UTF-16" } else { "this isn't UTF-8" };
        let message = format!("byte 0x{:02X}: {encoding}; save the scene in UTF-8", wrong[0]);
        Mistake(end..end, message).in_file(&before, path)
    })
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
    /// The error with its line and column in the `text` of the file at `path`.
    pub fn in_file(self, text: &str, path: &Path) -> SceneError {
        let Mistake(span, message) = self;
        let before = &text[..span.start];
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
        SceneError::Wrong { path: path.into(), line, column, span, message }
    }
}

/// Rejects a value with this name and unit unless it is `allowed`. `owner` precedes the name in the message.
pub fn check_range(
    (name, unit): (&str, &str),
    owner: &str,
    value: &Spanned<f64>,
    allowed: RangeInclusive<f64>,
) -> Result<(), Mistake> {
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
