//! The characters of XML 1.0.

/// The first character of `text` that XML does not allow, not even as a reference, and its position in bytes.
///
/// Reference: *Extensible Markup Language (XML) 1.0*, fifth edition, production 2 (`Char`).
pub fn forbidden(text: &str) -> Option<(usize, char)> {
    text.char_indices().find(|(_, character)| {
        let allowed =
            matches!(character, '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..);
        !allowed
    })
}

/// The same as a pattern of JSON Schema.
pub const ALLOWED: &str = r"^[^\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]*$";

/// The number of a character, for messages: it may be invisible.
pub fn name(character: char) -> String {
    format!("U+{:04X}", u32::from(character))
}
