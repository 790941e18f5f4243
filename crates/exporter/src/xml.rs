//! XML 1.0: its characters, and elements as they are written.

use quick_xml::Writer;
use std::io::{self, Write};

/// Writes the element `name` with those of its `attributes` that aren't empty, and what `inner` writes in it.
///
/// # Errors
/// Those of the writer.
pub fn element<W: Write>(
    xml: &mut Writer<W>,
    name: &str,
    attributes: &[(&str, &str)],
    inner: impl FnOnce(&mut Writer<W>) -> io::Result<()>,
) -> io::Result<()> {
    let given = attributes.iter().copied().filter(|(_, value)| !value.is_empty());
    xml.create_element(name).with_attributes(given).write_inner_content(inner).map(|_| ())
}

/// The same with nothing in it.
///
/// # Errors
/// Those of the writer.
pub fn leaf<W: Write>(xml: &mut Writer<W>, name: &str, attributes: &[(&str, &str)]) -> io::Result<()> {
    let given = attributes.iter().copied().filter(|(_, value)| !value.is_empty());
    xml.create_element(name).with_attributes(given).write_empty().map(|_| ())
}

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
