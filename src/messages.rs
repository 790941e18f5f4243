//! Messages on standard error, and the error of a wrong command line.

use brinell_exporter::layout::{WIDTH, harmless, without_middle};
use std::borrow::Cow;
use std::fmt::Display;
use std::io::{self, Write};
use textwrap::{Options, WordSeparator, WordSplitter};

/// A word of a message without its middle if it is longer than any path: such as a number of a million digits.
pub fn held(word: &str) -> Cow<'_, str> {
    const LONGEST_PATH: usize = 4096;
    if word.len() <= LONGEST_PATH { word.into() } else { without_middle(word).into() }
}

/// Writes an error, a warning or progress to standard error. Lines are wrapped for people, and left alone for programs, which use
/// `--json`.
pub fn tell(message: &str) {
    let for_program = std::env::args_os().any(|argument| argument == "--json");
    // a closed standard error must not stop the work
    let message = harmless(&message.split(' ').map(held).collect::<Vec<_>>().join(" "));
    let _ = writeln!(io::stderr(), "{}", if for_program { message } else { wrapped(&message) });
}

/// Writes a warning to standard error, also beside an answer for a program.
pub fn warn(message: &str) {
    tell(&format!("brinell: warning: {message}"));
}

/// `message` in lines of at most [`WIDTH`] characters, unless a word is longer. Continuation lines are indented by two more columns.
/// Quoted lines of a file with their numbers are not wrapped.
pub fn wrapped(message: &str) -> String {
    let line = |line: &str| {
        let text = line.trim_start();
        let is_shown = text.trim_start_matches(|digit: char| digit.is_ascii_digit() || digit == ' ').starts_with('|');
        let indent = &line[..line.len() - text.len()];
        let further = format!("{indent}  ");
        let options = Options::new(WIDTH).initial_indent(indent).subsequent_indent(&further).break_words(false);
        let options = options.word_splitter(WordSplitter::NoHyphenation).word_separator(WordSeparator::AsciiSpace);
        if is_shown || line.chars().count() <= WIDTH { line.to_string() } else { textwrap::fill(text, options) }
    };
    message.split('\n').map(line).collect::<Vec<_>>().join("\n")
}

/// Description of the error in the arguments.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct WrongCall(pub String);

impl WrongCall {
    /// For `map_err`.
    pub fn of(error: impl Display) -> WrongCall {
        WrongCall(error.to_string())
    }
}
