//! The names of FMUs and contacts: C identifiers.

use crate::layout::shortened;
use crate::mistake::Mistake;
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

/// The keywords of C, which are no identifiers. FMI asks that a modelIdentifier is one.
///
/// Reference: C11, section 6.4.1, without those that begin with `_`.
const C_KEYWORDS: [&str; 34] = [
    "auto", "break", "case", "char", "const", "continue", "default", "do", "double", "else", "enum", "extern", "float",
    "for", "goto", "if", "inline", "int", "long", "register", "restrict", "return", "short", "signed", "sizeof",
    "static", "struct", "switch", "typedef", "union", "unsigned", "void", "volatile", "while",
];

/// Text that is a C identifier.
pub fn check_identifier(name: &Spanned<String>) -> Result<String, Mistake> {
    let text = name.get_ref();
    let mut characters = text.chars();
    let begins = characters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_');
    // the name is also used for a file
    let short = text.len() <= 100;
    if C_KEYWORDS.contains(&text.as_str()) {
        let message =
            format!("name = {text:?} is a word of the language C, where no variable can have it: call it otherwise");
        return Err(Mistake(name.span(), message));
    }
    if short && begins && characters.all(|c| c.is_ascii_alphanumeric() || c == '_') {
        return Ok(text.clone());
    }
    let message = format!(
        "name = {:?} is not a C identifier: at most 100 letters, digits and `_`, and no digit at the beginning",
        shortened(text)
    );
    Err(Mistake(name.span(), message))
}

#[cfg(test)]
mod tests {
    use super::{C_KEYWORDS, check_identifier};
    use toml::Spanned;

    #[test]
    fn a_keyword_of_c_is_no_name_and_what_resembles_one_is() {
        for keyword in C_KEYWORDS {
            let refused = check_identifier(&Spanned::new(0..1, keyword.into())).map_err(|mistake| mistake.1);
            assert!(refused.is_err_and(|said| said.contains("a word of the language C")), "{keyword}");
            let near = format!("{keyword}_1");
            assert!(check_identifier(&Spanned::new(0..1, near.clone())).is_ok_and(|name| name == near));
        }
    }
}
