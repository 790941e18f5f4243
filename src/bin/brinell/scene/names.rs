//! Names and texts of the FMU.

use super::error::Mistake;
use crate::layout::shortened;
use crate::xml;
use toml::Spanned;

/// The name of an FMU: a C identifier that every operating system accepts as a file name.
///
/// Reference: "Naming Files, Paths, and Namespaces" in the documentation of Windows.
pub fn check_name(name: &Spanned<String>) -> Result<String, Mistake> {
    let text = check_identifier(name)?;
    let lower = text.to_ascii_lowercase();
    let port = lower.strip_prefix("com").or(lower.strip_prefix("lpt"));
    let is_port = port.is_some_and(|number| number.len() == 1 && number.bytes().all(|digit| digit.is_ascii_digit()));
    if is_port || ["con", "prn", "aux", "nul"].contains(&lower.as_str()) {
        let message =
            format!("name = {text:?} is that of a device on Windows, where no library can have it: call it otherwise");
        return Err(Mistake(name.span(), message));
    }
    Ok(text)
}

/// Text that is a C identifier.
pub fn check_identifier(name: &Spanned<String>) -> Result<String, Mistake> {
    let text = name.get_ref();
    let mut characters = text.chars();
    let begins = characters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_');
    // the name is also used for a file
    let short = text.len() <= 100;
    if short && begins && characters.all(|c| c.is_ascii_alphanumeric() || c == '_') {
        return Ok(text.clone());
    }
    let message = format!(
        "name = {:?} is not a C identifier: at most 100 letters, digits and `_`, and no digit at the beginning",
        shortened(text)
    );
    Err(Mistake(name.span(), message))
}

/// A text that the model description can contain.
pub fn check_description(given: Option<&Spanned<String>>) -> Result<String, Mistake> {
    let Some(text) = given else { return Ok(String::new()) };
    match xml::forbidden(text.get_ref()) {
        None => Ok(text.get_ref().clone()),
        Some((place, character)) => {
            let number = text.get_ref()[..place].chars().count() + 1;
            let character = xml::name(character);
            let message = format!("description has {character} as character {number}, which XML doesn't allow");
            Err(Mistake(text.span(), message))
        }
    }
}
