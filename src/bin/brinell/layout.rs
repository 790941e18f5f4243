//! Text for a terminal: paragraphs and tables of at most [`WIDTH`] columns.

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_line_of_a_paragraph_is_too_wide() {
        let text = "word ".repeat(60) + &"x".repeat(120);
        let lines: Vec<_> = paragraph("  heading  ", &text).lines().map(str::to_string).collect();
        assert!(lines[0].starts_with("  heading  word word") && lines[1].starts_with("           word"));
        assert!(lines.iter().all(|line| line.len() <= WIDTH || line.trim() == "x".repeat(120)), "{lines:?}");
        assert!(
            lines.iter().rev().skip(2).all(|line| line.len() > 90),
            "a line is filled before the next begins: {lines:?}"
        );
    }

    #[test]
    fn columns_are_in_line() {
        let rows = [["law", "force"], ["hertz", "1"]].map(|row| row.map(String::from).to_vec());
        assert_eq!(table(&rows, 1, 2), "  law    force\n  hertz      1\n");
    }
}
