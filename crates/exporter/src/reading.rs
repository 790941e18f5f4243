//! The reading of a hardness test as people write it: a number with its scale, and perhaps a spread.

use crate::nearest::any_case;
use crate::numbers::in_message;
use crate::units;

/// A hardness of 1 kgf/mm^2 in pascals.
pub const KGF_PER_MM2: f64 = 9.806_65e6;

/// A number on a hardness scale.
pub enum Reading {
    /// Number, ball diameter \[m\] and load \[N\], if they are given.
    Brinell(f64, Option<(f64, f64)>),
    Vickers(f64),
    /// The letter of the scale.
    Rockwell(f64, char),
    Leeb(f64),
}

/// The scales, as messages name them.
pub const SCALES: &str = "\"200 HBW 10/3000\" (ball in mm, load in kgf), \"640 HV10\", \"58 HRC\", \"90 HRB\", \"700 HLD\" or a range, \
                          \"180-220 HBW\"";

/// The names of the scales.
const BRINELL: [&str; 4] = ["HBW", "HB", "HBS", "BHN"];
const VICKERS: [&str; 2] = ["HV", "VHN"];
const ROCKWELL: [&str; 4] = ["HRC", "HRB", "HRBW", "HRBS"];
const LEEB: [&str; 2] = ["HLD", "LD"];

/// The form of a hardness, as a pattern of JSON Schema.
pub fn pattern() -> String {
    let [brinell, vickers, rockwell] = [any_case(&BRINELL), any_case(&VICKERS), any_case(&ROCKWELL)];
    // three digits behind a comma may be thousands
    let number = r"(?:[0-9.]+|[0-9]+,[0-9]{1,2})";
    let test = format!(r"(?:\s*{number}\s*/\s*{number}(?:\s*/\s*{number})?)?");
    let spread = spread_pattern(number);
    let scale = format!(r"(?:(?:{brinell}){test}|{vickers}[0-9./ ]*|{rockwell}|{})", any_case(&LEEB));
    // the scale may be the first
    format!(r"^\s*{number}{spread}\s*{scale}\s*$|^\s*[A-Za-z].*[0-9]")
}

/// What stands between the two numbers of a range, and before a standard deviation.
const RANGE: [&str; 6] = ["-", "\u{2013}", "\u{2212}", "...", "\u{2026}", ".."];
const DEVIATION: [&str; 3] = ["\u{b1}", "+/-", "+-"];

fn spread_pattern(number: &str) -> String {
    let signs = RANGE.iter().chain(&DEVIATION).map(|sign| sign.replace('.', r"\.").replace('+', r"\+"));
    format!(r"(?:\s*(?:{}|{})\s*{number})?", signs.collect::<Vec<_>>().join("|"), any_case(&["TO"]))
}

/// The scale that the heading of a column names, as a reading has it: `HV10`, `HBW 10/3000`. A number of the column may follow. A rebound
/// hardness without the letter of its device is that of device D.
pub fn scale_in(heading: &str) -> Option<String> {
    let heading = heading.trim();
    let letters = heading.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(heading.len());
    let (name, rest) = (heading[..letters].to_uppercase(), &heading[letters..]);
    let mut words = rest.split([' ', '_', '#', '(', ')', '[', ']']).filter(|word| !word.is_empty()).peekable();
    let is_number = |word: &str| word.parse::<f64>().is_ok_and(f64::is_finite);
    let scale = match name.as_str() {
        name if BRINELL.contains(&name) => {
            let test = words.next_if(|word| word.contains('/') && word.split('/').all(is_number));
            test.map_or(name.to_string(), |test| format!("{name} {test}"))
        }
        name if VICKERS.contains(&name) => {
            let load = words.next_if(|word| word.split('/').all(is_number));
            format!("{name}{}", load.unwrap_or_default())
        }
        name if ROCKWELL.contains(&name) || LEEB.contains(&name) => name.to_string(),
        "HL" => LEEB[0].to_string(),
        _ => return None,
    };
    words.all(is_number).then_some(scale)
}

/// Whether a `text` is a reading.
///
/// # Errors
/// A sentence with what is wrong, and what is allowed.
pub fn check_reading(text: &str) -> Result<(), String> {
    Reading::parse(&parted(text)?.0).map(|_| ())
}

/// A reading in capitals, and its spread.
pub fn parted(text: &str) -> Result<(String, Option<Spread>), String> {
    without_spread(&pointed(text)?.trim().to_uppercase())
}

/// That of one that was measured by impacts, the rate of which is in its strength.
pub fn of_impacts() -> String {
    any_case(&LEEB)
}

/// The spread of a reading: that of its two ends, over this many standard deviations on each side.
pub struct Spread {
    pub ends: [String; 2],
    pub deviations: f64,
}

/// A reading without its spread, and the spread of `180-220 HBW` or `212 ± 3 HV10`. In a range each number is as likely as any other.
fn without_spread(text: &str) -> Result<(String, Option<Spread>), String> {
    let is_number = |c: char| c.is_ascii_digit() || c == '.';
    let ranges = RANGE.iter().chain(&["TO"]).map(|sign| (*sign, true));
    for (sign, is_range) in DEVIATION.iter().map(|sign| (*sign, false)).chain(ranges) {
        let Some((before, after)) = text.split_once(sign) else { continue };
        let (before, after) = (before.trim_end(), after.trim_start());
        let start = before.trim_end_matches(is_number).len();
        let end = after.find(|c: char| !is_number(c)).unwrap_or(after.len());
        let (Ok(first), Ok(second)) = (before[start..].parse::<f64>(), after[..end].parse::<f64>()) else { continue };
        // the load of a scale is none
        if before[..start].ends_with(|c: char| !c.is_whitespace()) {
            continue;
        }
        if is_range && first >= second {
            let [first, second] = [first, second].map(in_message);
            return Err(format!("a range goes from the least number to the largest, not from {first} to {second}"));
        }
        let reading = |number: f64| format!("{}{}{}", &before[..start], in_message(number), &after[end..]);
        let (number, half) = if is_range { (0.5 * (first + second), 0.5 * (second - first)) } else { (first, second) };
        let deviations = if is_range { 3.0_f64.sqrt() } else { 1.0 };
        return Ok((reading(number), Some(Spread { ends: [number - half, number + half].map(reading), deviations })));
    }
    Ok((text.into(), None))
}

/// A `text` with points for the decimal commas, of ball and load, too: `200 HBW 2,5/187,5`.
fn pointed(text: &str) -> Result<String, String> {
    let pointed = |word: &str| Ok(word.split('/').map(units::pointed).collect::<Result<Vec<_>, String>>()?.join("/"));
    Ok(text.split_whitespace().map(pointed).collect::<Result<Vec<_>, String>>()?.join(" "))
}

/// The number and the scale of a hardness that begins with its number, as a form shows it.
pub fn shown(text: &str) -> Option<(String, String)> {
    check_reading(text).ok()?;
    let text = pointed(text).ok()?;
    let (number, scale) = text.split_at(text.find(|c: char| c.is_alphabetic())?);
    number.trim().parse::<f64>().is_ok().then(|| (number.trim().into(), scale.into()))
}

impl Reading {
    /// The reading in a `text` in capitals: a number and its scale, in either order.
    pub fn parse(text: &str) -> Result<Reading, String> {
        let unknown = || Err(format!("a hardness is a number with its scale, such as {SCALES}"));
        let end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
        let (number, scale) = match end {
            0 => {
                let words = || text.split_whitespace();
                let Some(place) = words().position(|word| word.parse::<f64>().is_ok_and(f64::is_finite)) else {
                    return unknown();
                };
                let others = words().enumerate().filter(|(index, _)| *index != place).map(|(_, word)| word);
                (words().nth(place).unwrap_or_default().to_string(), others.collect::<String>())
            }
            end => (text[..end].to_string(), text[end..].split_whitespace().collect()),
        };
        let Ok(number) = number.parse::<f64>() else { return unknown() };
        let letters = scale.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(scale.len());
        let (name, test) = scale.split_at(letters);
        match (name, test) {
            (name, "") if BRINELL.contains(&name) => Ok(Reading::Brinell(number, None)),
            (name, test) if BRINELL.contains(&name) => {
                let parts: Vec<f64> = test.split('/').map_while(|part| part.parse().ok()).collect();
                match parts[..] {
                    [ball, load] | [ball, load, _] if ball > 0.0 && load > 0.0 => {
                        Ok(Reading::Brinell(number, Some((1e-3 * ball, 1e-6 * KGF_PER_MM2 * load))))
                    }
                    _ => Err(format!("`{test}` is not the ball's diameter in mm and the load in kgf, as in 10/3000")),
                }
            }
            (name, test)
                if VICKERS.contains(&name)
                    && (test.is_empty() || test.split('/').all(|part| part.parse::<f64>().is_ok())) =>
            {
                Ok(Reading::Vickers(number))
            }
            (name, "") if ROCKWELL.contains(&name) => {
                Ok(Reading::Rockwell(number, if name == "HRC" { 'C' } else { 'B' }))
            }
            (name, "") if LEEB.contains(&name) => Ok(Reading::Leeb(number)),
            ("HL", _) => {
                Err("a rebound hardness has the letter of its device; that of device D is known, as in \"700 HLD\""
                    .into())
            }
            _ => unknown(),
        }
    }
}
