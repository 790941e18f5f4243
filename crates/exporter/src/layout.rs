//! Text for a terminal: paragraphs and tables of at most [`WIDTH`] columns.

use serde::Serialize;
use std::path::Path;
use textwrap::{Options, WordSplitter};

/// The widest line that a command prints.
pub const WIDTH: usize = 100;

/// `text` after its `heading`, in lines of at most [`WIDTH`] characters. Later lines are indented to the start of the text. A
/// longer word has its own line.
pub fn paragraph(heading: &str, text: &str) -> String {
    let indent = " ".repeat(heading.chars().count());
    let options = Options::new(WIDTH).initial_indent(heading).subsequent_indent(&indent).break_words(false);
    let options = options.word_splitter(WordSplitter::NoHyphenation);
    let filled = textwrap::fill(text, options);
    format!("{}\n", if text.is_empty() { heading.trim_end() } else { &filled })
}

/// `text` with a replacement character for each control character but line ends: it may come from a stranger's file, and must not
/// give commands to the terminal.
pub fn harmless(text: &str) -> String {
    text.chars().map(|c| if c.is_control() && c != '\n' { char::REPLACEMENT_CHARACTER } else { c }).collect()
}

/// `value` as JSON for standard output: one line. JSON may have the characters U+007F to U+009F raw in its texts, but standard
/// output may be a terminal, which takes some of them for commands; they are escaped, and a reader finds them as they were.
pub fn json_line(value: &impl Serialize) -> String {
    let text = serde_json::to_string(value).expect("answers have no other keys than text");
    let mut line = String::with_capacity(text.len() + 1);
    for c in text.chars() {
        match c {
            '\u{7f}'..='\u{9f}' => line += &format!("\\u{:04x}", u32::from(c)),
            c => line.push(c),
        }
    }
    line.push('\n');
    line
}

/// A path for the terminal: a name may contain line ends, too.
pub fn shown(path: &Path) -> String {
    harmless(&path.display().to_string()).replace('\n', "\u{fffd}")
}

/// At most 80 characters of `text`, for a message.
pub fn shortened(text: &str) -> String {
    const MOST: usize = 80;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.into(),
    }
}

/// `text` without its middle if it is very long, for a message that others have made.
pub fn without_middle(text: &str) -> String {
    const END: usize = 150;
    let count = text.chars().count();
    if count <= 2 * END {
        return text.into();
    }
    let end = |index| text.char_indices().nth(index).map_or(text.len(), |(place, _)| place);
    format!("{} ... {}", &text[..end(END)], &text[end(count - END)..])
}

/// The rows in columns of the necessary width, after `indent` spaces. The first `left` columns are left-aligned, the others
/// right-aligned.
pub fn table(rows: &[Vec<String>], left: usize, indent: usize) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..count).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = " ".repeat(indent);
        for (column, cell) in row.iter().enumerate() {
            let space = " ".repeat(widths[column] - cell.chars().count());
            let gap = if column == 0 { "" } else { "  " };
            line += &if column < left { format!("{gap}{cell}{space}") } else { format!("{gap}{space}{cell}") };
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}
