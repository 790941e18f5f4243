//! The characters of XML 1.0.

/// The first character of `text` that no XML can have, not even as a reference, and its place in bytes.
///
/// Reference: *Extensible Markup Language (XML) 1.0*, fifth edition, production 2 (`Char`).
pub fn forbidden(text: &str) -> Option<(usize, char)> {
    text.char_indices().find(|(_, character)| {
        let allowed =
            matches!(character, '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..);
        !allowed
    })
}

/// A character for messages, by its number: it may not be visible.
pub fn name(character: char) -> String {
    format!("U+{:04X}", u32::from(character))
}
