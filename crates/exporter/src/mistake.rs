//! Mistakes in a scene, each with its place; the check of numbers against their ranges.

use crate::layout::shown;
use crate::numbers::{in_message, out_of_range};
use crate::table;
use std::ops::{Range, RangeInclusive};
use std::path::{Path, PathBuf};
use toml::Spanned;

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

/// Rejects a value of the parameter `name` outside its range. `owner` precedes the name in the message.
pub fn check_limits(name: &str, owner: &str, value: &Spanned<f64>) -> Result<(), Mistake> {
    let variable = table::variable(name);
    let allowed = variable.minimum.unwrap_or(f64::MIN)..=variable.maximum.unwrap_or(f64::MAX);
    check_range((name, variable.unit.as_deref().unwrap_or("")), owner, value, allowed)
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
