//! Text for a terminal: paragraphs and tables of at most [`WIDTH`] columns.

/// The widest line that a command prints.
pub const WIDTH: usize = 100;

/// `text` behind its `heading`, in lines of at most [`WIDTH`] characters; the lines after the first are as far in as the text of
/// the first. A word that is longer has a line of its own.
pub fn paragraph(heading: &str, text: &str) -> String {
    let indent = heading.chars().count();
    let (mut lines, mut line) = (String::new(), String::from(heading));
    let mut is_empty = true;
    for word in text.split_whitespace() {
        if !is_empty && line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push_str(line.trim_end());
            lines.push('\n');
            (line, is_empty) = (" ".repeat(indent), true);
        }
        if !is_empty {
            line.push(' ');
        }
        line.push_str(word);
        is_empty = false;
    }
    lines.push_str(line.trim_end());
    lines.push('\n');
    lines
}

/// The rows in columns that are as wide as they must be, each after `indent` spaces: the first `left` columns begin in line, the
/// others end in line.
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
