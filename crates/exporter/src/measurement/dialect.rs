//! Rows of cells from a text of any dialect: coding, separator, quotes and decimal sign are those of the machine or the spreadsheet.
//!
//! The separator is the one that gives the most lines the same number of cells, with numbers in them. Guessing crates judge bytes: they know
//! neither blanks as a separator, nor a decimal comma, nor a heading in a comment.

use crate::reading::scale_in;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};

/// A table that can't be used, with the place and the reason.
#[derive(Debug, Serialize)]
pub struct Wrong {
    pub line: Option<usize>,
    pub column: Option<usize>,
    pub why: String,
}

impl Wrong {
    pub fn whole(why: impl Into<String>) -> Wrong {
        Wrong { line: None, column: None, why: why.into() }
    }

    pub fn in_line(line: usize, why: impl Into<String>) -> Wrong {
        Wrong { line: Some(line), column: None, why: why.into() }
    }
}

impl Display for Wrong {
    fn fmt(&self, to: &mut Formatter) -> fmt::Result {
        match (self.line, self.column) {
            (Some(line), Some(column)) => write!(to, "line {line}, column {column}: {}", self.why),
            (Some(line), None) => write!(to, "line {line}: {}", self.why),
            _ => write!(to, "{}", self.why),
        }
    }
}

/// How many lines tell the separator.
const SAMPLE: usize = 1000;

/// How many lines may stand before the heading.
pub const MOST_BEFORE: usize = 200;

/// How many lines a quoted cell may have.
const QUOTED: usize = 20;

/// A line that isn't empty. Of quoted cells it may be several.
pub struct Line {
    pub number: usize,
    pub text: String,
    /// Whether a `#` stood before it.
    pub is_comment: bool,
}

/// What stands between cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Separator {
    Sign(char),
    /// Two blanks or more: names may have one.
    Gaps,
    Blanks,
    /// One cell is the whole line.
    None,
}

impl Separator {
    pub const ALL: [Separator; 7] = [
        Separator::Sign(';'),
        Separator::Sign('\t'),
        Separator::Sign(','),
        Separator::Sign('|'),
        Separator::Gaps,
        Separator::Blanks,
        Separator::None,
    ];

    /// Its name, in the plural.
    pub fn name(self) -> String {
        match self {
            Separator::Sign(';') => "semicolons".into(),
            Separator::Sign('\t') => "tabs".into(),
            Separator::Sign(',') => "commas".into(),
            Separator::Sign('|') => "bars".into(),
            Separator::Sign(other) => format!("`{other}`"),
            Separator::Gaps | Separator::Blanks => "blanks".into(),
            Separator::None => "lines".into(),
        }
    }

    /// How many letters at the beginning of `rest` end a cell; blanks within brackets don't, nor those before one.
    fn end(self, rest: &[char], is_inside: bool) -> usize {
        let blanks = rest.iter().take_while(|letter| letter.is_whitespace()).count();
        match self {
            Separator::Sign(sign) => usize::from(rest[0] == sign),
            Separator::Gaps if blanks >= 2 && !is_inside => blanks,
            Separator::Blanks if !is_inside && !rest.get(blanks).is_some_and(|next| "[(".contains(*next)) => blanks,
            _ => 0,
        }
    }

    /// The cells of a line, without their quotation marks.
    pub fn cells(self, line: &str) -> Vec<String> {
        let line = if matches!(self, Separator::Sign(_)) { line } else { line.trim() };
        let letters: Vec<char> = line.chars().collect();
        let (mut cells, mut cell, mut at) = (Vec::new(), String::new(), 0);
        let (mut is_quoted, mut was_quoted, mut depth) = (false, false, 0_i32);
        while let Some(&letter) = letters.get(at) {
            let doubled = letter == '"' && letters.get(at + 1) == Some(&'"');
            let end = if is_quoted { 0 } else { self.end(&letters[at..], depth > 0) };
            match letter {
                '"' if is_quoted && doubled => {
                    cell.push('"');
                    at += 1;
                }
                '"' if is_quoted => is_quoted = false,
                '"' if cell.trim().is_empty() && !was_quoted => (is_quoted, was_quoted) = (true, true),
                _ if end > 0 => {
                    cells.push(trimmed(&std::mem::take(&mut cell)));
                    was_quoted = false;
                    at += end - 1;
                }
                _ => {
                    depth += i32::from("[(".contains(letter)) - i32::from("])".contains(letter));
                    cell.push(letter);
                }
            }
            at += 1;
        }
        cells.push(trimmed(&cell));
        // "speed, restitution" above numbers that blanks separate
        if self == Separator::Blanks || self == Separator::Gaps {
            cells.iter_mut().for_each(|cell| cell.truncate(cell.trim_end_matches([',', ';']).len()));
        }
        cells
    }
}

/// A cell in one line, without blanks around it.
fn trimmed(cell: &str) -> String {
    cell.split(['\r', '\n']).map(str::trim).collect::<Vec<_>>().join(" ").trim().into()
}

/// The text of a file as spreadsheets write it: UTF-8, UTF-16 with its mark, or else one byte for each letter.
///
/// # Errors
/// A file that is no text.
pub fn text_of(bytes: &[u8]) -> Result<String, Wrong> {
    let wide = |of: fn([u8; 2]) -> u16| {
        let words: Vec<u16> = bytes[2..].chunks_exact(2).map(|pair| of([pair[0], pair[1]])).collect();
        String::from_utf16_lossy(&words)
    };
    let text = match bytes {
        [0xff, 0xfe, ..] => wide(u16::from_le_bytes),
        [0xfe, 0xff, ..] => wide(u16::from_be_bytes),
        _ => std::str::from_utf8(bytes)
            .map_or_else(|_| bytes.iter().map(|byte| char::from(*byte)).collect(), String::from),
    };
    match (bytes, text.contains('\0')) {
        ([b'P', b'K', 3, 4, ..] | [0xd0, 0xcf, 0x11, 0xe0, ..], _) => Err(Wrong::whole(
            "it is a workbook: save it as CSV, or let Python read it, which takes .xlsx wherever it takes CSV",
        )),
        (_, true) => Err(Wrong::whole("the file is no text; a table as CSV is expected")),
        _ => Ok(text.trim_start_matches('\u{feff}').into()),
    }
}

/// The lines of a text, and the separator that Excel says in a line of its own.
///
/// # Errors
/// A quotation mark that isn't closed.
pub fn lines_of(text: &str) -> Result<(Option<Separator>, Vec<Line>), Wrong> {
    let (mut said, mut lines) = (None, Vec::<Line>::new());
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    let mut physical = text.split('\n').enumerate();
    while let Some((index, line)) = physical.next() {
        let number = index + 1;
        if line.trim().is_empty() {
            continue;
        }
        if lines.is_empty() && said.is_none() && line.to_lowercase().starts_with("sep=") {
            said = line.chars().nth(4).map(Separator::Sign);
            continue;
        }
        let comment = line.trim_start().strip_prefix('#');
        let mut whole = comment.map_or(line, |rest| rest.trim_start_matches('#')).to_string();
        for _ in 0..QUOTED {
            if comment.is_some() || !is_open(&whole) {
                break;
            }
            let Some((_, more)) = physical.next() else { break };
            whole = whole + "\n" + more;
        }
        if comment.is_none() && is_open(&whole) {
            return Err(Wrong::in_line(number, "a quotation mark is not closed"));
        }
        if !whole.trim().is_empty() {
            lines.push(Line { number, text: whole, is_comment: comment.is_some() });
        }
    }
    Ok((said, lines))
}

/// Whether a quotation mark at the beginning of a cell isn't closed.
fn is_open(line: &str) -> bool {
    let (mut is_quoted, mut may_open) = (false, true);
    for letter in line.chars() {
        match letter {
            // a doubled one closes and opens
            '"' if is_quoted => (is_quoted, may_open) = (false, true),
            '"' if may_open => is_quoted = true,
            _ => may_open = ";,\t| ".contains(letter),
        }
    }
    is_quoted
}

/// The place of a table in its lines.
pub struct Body {
    pub separator: Separator,
    /// Its first line with numbers, or the end.
    pub first: usize,
    /// How many cells most of its lines have.
    pub width: usize,
}

/// The body for this `separator`, and how well it fits: for each line of the longest run of lines with the same number of cells, the part
/// of them that are numbers.
fn body(lines: &[Line], separator: Separator) -> (f64, Body) {
    let mut best = (0.0, Body { separator, first: lines.len(), width: 0 });
    let (mut first, mut width, mut fits) = (0, 0, 0.0);
    for (index, line) in lines.iter().enumerate().filter(|(_, line)| !line.is_comment).take(SAMPLE) {
        let cells = separator.cells(&line.text);
        let numbers = cells.iter().filter(|cell| is_number(cell)).count();
        if numbers == 0 || (cells.len() < 2 && separator != Separator::None) {
            (width, fits) = (0, 0.0);
            continue;
        }
        if cells.len() != width {
            (first, width, fits) = (index, cells.len(), 0.0);
        }
        fits += numbers as f64 / width as f64;
        if fits > best.0 {
            best = (fits, Body { separator, first, width });
        }
    }
    best
}

/// The body by the separator that fits best, the `said` one or any; at equal fits, by the heading with the most `names`, those that are known.
pub fn body_of(lines: &[Line], said: Option<Separator>, names: impl Fn(&[String]) -> usize) -> Body {
    let all = said.as_ref().map_or(&Separator::ALL[..], std::slice::from_ref);
    let rated = all.iter().map(|separator| {
        let (fits, body) = body(lines, *separator);
        let known = |line: &Line| {
            // numpy separates the names in another way than the numbers
            let others =
                Separator::ALL.iter().filter(|other| *other != separator && body.width > 1).map(|other| (0.4, other));
            let ways = std::iter::once((0.5, separator)).chain(others);
            ways.map(|(worth, way)| {
                let cells = way.cells(&line.text);
                let is_as_wide = cells.len() == body.width || body.width == 0;
                if is_as_wide { worth + names(&cells) as f64 } else { 0.0 }
            })
            .fold(0.0, f64::max)
        };
        let above = lines.iter().take(body.first.min(MOST_BEFORE)).map(known);
        (fits + above.fold(0.0, f64::max), body)
    });
    // the first of equals
    rated.reduce(|best, other| if other.0 > best.0 { other } else { best }).expect("there are separators").1
}

/// Whether a cell is a number by any decimal sign, or the reading of a hardness.
pub fn is_number(cell: &str) -> bool {
    let is_one = |sign| number(cell, sign).is_some_and(f64::is_finite);
    let (start, scale) = cell.split_at(cell.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(cell.len()));
    is_one('.') || is_one(',') || (is_number_of_reading(start) && scale_in(scale).is_some())
}

/// Whether a reading such as `180-220 HBW` may begin so.
fn is_number_of_reading(start: &str) -> bool {
    start.contains(|c: char| c.is_ascii_digit())
}

/// The text of a cell as a number with a decimal point, by its `decimal` sign: without blanks, apostrophes and signs between thousands.
fn plain(cell: &str, decimal: char) -> Option<String> {
    let cell = without_gaps(cell.trim()).replace('\u{2212}', "-");
    let other = if decimal == '.' { ',' } else { '.' };
    if !cell.contains(other) {
        return Some(cell.replace(decimal, "."));
    }
    let (whole, part) = cell.split_once(decimal).map_or((cell.as_str(), None), |(whole, part)| (whole, Some(part)));
    let is_part = part.is_none_or(|part| part.bytes().all(|byte| byte.is_ascii_digit()));
    let plain = whole.replace(other, "");
    (is_grouped(whole, other) && is_part).then(|| part.map_or(plain.clone(), |part| format!("{plain}.{part}")))
}

/// The number in a cell with this `decimal` sign; `None` for what is none.
pub fn number(cell: &str, decimal: char) -> Option<f64> {
    let plain = plain(cell, decimal)?;
    // no words such as `inf`
    let is_written = plain.contains(|c: char| c.is_ascii_digit()) && !plain.starts_with(|c: char| c.is_alphabetic());
    plain.parse().ok().filter(|_| is_written)
}

/// Whether these are digits with `sign` between thousands.
fn is_grouped(whole: &str, sign: char) -> bool {
    let mut groups = whole.trim_start_matches(['+', '-']).split(sign);
    let is_all =
        |group: &str, most: usize| (1..=most).contains(&group.len()) && group.bytes().all(|byte| byte.is_ascii_digit());
    let first = groups.next().is_some_and(|first| is_all(first, 3) && !first.starts_with('0'));
    let rest: Vec<&str> = groups.collect();
    first && !rest.is_empty() && rest.iter().all(|group| group.len() == 3 && is_all(group, 3))
}

/// A cell without blanks and apostrophes between thousands.
fn without_gaps(cell: &str) -> String {
    let letters: Vec<char> = cell.chars().collect();
    let is_digit = |at: usize| letters.get(at).is_some_and(char::is_ascii_digit);
    let is_gap = |at: usize| {
        let before = at.checked_sub(1).is_some_and(is_digit);
        let three = (1..4).all(|step| is_digit(at + step)) && !is_digit(at + 4);
        "\u{a0}\u{2009}\u{202f}' \u{2019}".contains(letters[at]) && before && three
    };
    (0..letters.len()).filter(|at| !is_gap(*at)).map(|at| letters[at]).collect()
}

/// The decimal sign of all numbers in `columns` of cells.
///
/// # Errors
/// Two signs, or numbers such as `1.234` that may be 1.234 or 1234.
pub fn decimal_of(columns: &[Vec<&str>], separator: Separator) -> Result<char, String> {
    let mut evidence = [None; 2];
    let mut doubt = None;
    for cell in columns.iter().flatten() {
        let text = without_gaps(cell);
        let digits = text.trim_start_matches(['+', '-', '\u{2212}']);
        let mantissa = digits.split(['e', 'E']).next().unwrap_or_default();
        let is_one =
            mantissa.contains(['.', ',']) && mantissa.bytes().all(|c| c.is_ascii_digit() || b".,".contains(&c));
        if !is_one {
            continue;
        }
        let [points, commas] = ['.', ','].map(|sign| mantissa.matches(sign).count());
        let last = mantissa.rfind(['.', ',']).map(|at| mantissa.as_bytes()[at]);
        let sign = match (points, commas) {
            (1.., 1..) => last.map(|last| usize::from(last == b',')),
            (2.., 0) => Some(1),
            (0, 2..) => Some(0),
            // an exponent follows no thousands
            _ if is_grouped(mantissa, if points == 1 { '.' } else { ',' }) && mantissa == digits => None,
            _ => Some(usize::from(commas == 1)),
        };
        match sign {
            Some(sign) => evidence[sign] = evidence[sign].or(Some(*cell)),
            None if commas == 1 || separator == Separator::Sign(';') => doubt = doubt.or(Some(*cell)),
            None => {}
        }
    }
    match (evidence, doubt.or_else(|| mixed(columns))) {
        ([Some(point), Some(comma)], _) => {
            Err(format!("`{point}` has a decimal point, and `{comma}` a decimal comma; one sign is allowed in a file"))
        }
        ([Some(_), None], _) | ([None, None], None) => Ok('.'),
        ([None, Some(_)], _) => Ok(','),
        ([None, None], Some(doubt)) => Err(format!(
            "`{doubt}` is ambiguous: {} with a decimal sign, or {} with a separator of thousands. Write one of the numbers with other \
             digits, such as 1.0820 or 1082",
            doubt.replace(',', "."),
            doubt.replace([',', '.'], "")
        )),
    }
}

/// A number such as `1.234` in a column with larger numbers that have no sign, such as `950`: thousands are written with a sign, hundreds
/// without.
fn mixed<'a>(columns: &[Vec<&'a str>]) -> Option<&'a str> {
    columns.iter().find_map(|column| {
        let grouped = || column.iter().filter(|cell| is_grouped(cell, '.'));
        let is_plain = |cell: &&&str| (1..=3).contains(&cell.len()) && cell.bytes().all(|c| c.is_ascii_digit());
        let plain = column.iter().filter(is_plain).count();
        let all = column.iter().filter(|cell| !cell.is_empty()).count();
        (plain > 0 && plain + grouped().count() == all).then(|| grouped().next().copied())?
    })
}
