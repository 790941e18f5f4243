//! Hostile variants of good texts and files, for tests of what reads them. The same number gives the same variants everywhere.

use fastrand::Rng;

/// Numbers at an end of something, as they are written.
const NUMBERS: [&str; 22] = [
    "1e300",
    "-1e300",
    "1e-320",
    "nan",
    "inf",
    "-inf",
    "+inf",
    "0",
    "-0.0",
    "-1",
    "1e999",
    "0x1f",
    "1_000",
    "9223372036854775807",
    "9223372036854775808",
    "5e-324",
    "1.7976931348623157e308",
    "true",
    "\"\"",
    "[]",
    "{}",
    "1979-05-27",
];

/// Pieces that nest, quote or escape.
const PIECES: [&str; 20] = [
    "[", "]", "[[", "{", "}", "\"", "'''", "\\u0000", "\u{0}", "\n", "=", ".", "#", "<", ">", "&amp;", "&#1;", "<!--",
    "]]>", "\u{fffe}",
];

/// The number of cases of a test, or that in `BRINELL_HOSTILE`, such as 1e6.
pub fn cases(usual: usize) -> usize {
    let wanted = std::env::var("BRINELL_HOSTILE").ok();
    wanted.map_or(usual, |count| count.parse::<f64>().expect("BRINELL_HOSTILE is a number, such as 1e6") as usize)
}

/// The case with this `number`: one of `seeds` with one to four changes. `words` are known to the reader.
pub fn text(number: usize, seeds: &[&str], words: &[&str]) -> String {
    let random = &mut Rng::with_seed(number as u64);
    let mut text = seeds[random.usize(..seeds.len())].to_string();
    for _ in 0..random.usize(1..5) {
        text = changed(random, &text, seeds, words);
    }
    text
}

/// A place between two characters.
fn place(random: &mut Rng, text: &str) -> usize {
    let mut place = random.usize(..=text.len());
    while !text.is_char_boundary(place) {
        place -= 1;
    }
    place
}

fn changed(random: &mut Rng, text: &str, seeds: &[&str], words: &[&str]) -> String {
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let mut any = |words: &[&'static str]| words[random.usize(..words.len())];
    let (number, piece) = (any(&NUMBERS), any(&PIECES));
    let word = if words.is_empty() { "" } else { words[random.usize(..words.len())] };
    match random.u8(..10) {
        // another value, or another name
        0..=3 => {
            let is_part = |c: char| c.is_ascii_alphanumeric() || "_.-+".contains(c);
            let tokens: Vec<&str> = text.split(|c: char| !is_part(c)).filter(|token| !token.is_empty()).collect();
            if tokens.is_empty() {
                return number.into();
            }
            let token = tokens[random.usize(..tokens.len())];
            let at = token.as_ptr() as usize - text.as_ptr() as usize;
            let new = match random.u8(..4) {
                0 => word,
                1 => tokens[random.usize(..tokens.len())],
                _ => number,
            };
            format!("{}{new}{}", &text[..at], &text[at + token.len()..])
        }
        // lines twice, left out, or from another text
        4 if !lines.is_empty() => {
            let (from, to) = (random.usize(..lines.len()), random.usize(..=lines.len()));
            [&lines[..to], &lines[from..=from], &lines[to..]].concat().concat()
        }
        5 if !lines.is_empty() => {
            let from = random.usize(..lines.len());
            [&lines[..from], &lines[from + 1..]].concat().concat()
        }
        6 => {
            let other = seeds[random.usize(..seeds.len())];
            let (at, from) = (place(random, text), place(random, other));
            format!("{}{}", &text[..at], &other[from..])
        }
        // a piece, once or so often that nothing on a stack survives
        7 => {
            let times = [1, 2, 3000][random.usize(..3)];
            let at = place(random, text);
            format!("{}{}{}", &text[..at], piece.repeat(times), &text[at..])
        }
        8 => text[..place(random, text)].into(),
        _ => {
            let mut bytes = text.as_bytes().to_vec();
            if !bytes.is_empty() {
                let at = random.usize(..bytes.len());
                bytes[at] = random.u8(..);
            }
            String::from_utf8_lossy(&bytes).into_owned()
        }
    }
}

/// The case with this `number` of a file: the bytes of `seed` with one to four changes.
pub fn bytes(number: usize, seed: &[u8]) -> Vec<u8> {
    let random = &mut Rng::with_seed(number as u64);
    let mut bytes = seed.to_vec();
    for _ in 0..random.usize(1..5) {
        if bytes.is_empty() {
            break;
        }
        let at = random.usize(..bytes.len());
        // the directory of an archive is at its end
        let at = if random.bool() { at } else { bytes.len() - 1 - at % bytes.len().min(600) };
        let end = (at + random.usize(1..9)).min(bytes.len());
        match random.u8(..7) {
            0 => bytes[at] ^= 1 << random.u8(..8),
            1 => bytes[at] = random.u8(..),
            2 => bytes[at..end].fill(0xff),
            3 => bytes[at..end].fill(0),
            4 => bytes.truncate(at),
            5 => drop(bytes.drain(at..end)),
            _ => {
                let part = bytes[at..(at + random.usize(1..200)).min(bytes.len())].to_vec();
                let to = random.usize(..=bytes.len());
                bytes.splice(to..to, part);
            }
        }
    }
    bytes
}

/// Checks what is said about a case: it is short, speaks no Rust, and writes no number with a hundred digits.
#[track_caller]
pub fn assert_message(message: &str, case: &str) {
    let longest = message.split(|c: char| !c.is_ascii_digit()).map(str::len).max().unwrap_or(0);
    let is_good = !message.is_empty() && message.len() < LONGEST && longest < 40;
    let speaks_rust = ["f64", "i64", "Option", "unwrap", "Utf8Error"].iter().any(|word| message.contains(word));
    assert!(is_good && !speaks_rust, "{} bytes of message: {message}\nabout: {case}", message.len());
}

/// More than any message is long \[bytes\].
const LONGEST: usize = 3000;
