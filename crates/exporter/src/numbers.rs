//! Numbers in words for people: digits, ranges, and what is out of its range.

use std::ops::RangeInclusive;

/// At most six significant digits.
pub fn digits(value: f64) -> String {
    significant(value, 6)
}

/// At most `count` significant digits.
pub fn significant(value: f64, count: usize) -> String {
    let rounded = rounded(value, count);
    if rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) {
        // avoids a sign of zero
        format!("{}", rounded + 0.0)
    } else {
        format!("{rounded:e}")
    }
}

/// Significant digits in output for people.
pub const DIGITS: usize = 4;

pub fn rounded(value: f64, count: usize) -> f64 {
    let rounded = format!("{value:.*e}", count - 1).parse().expect("a number");
    // the largest numbers would become infinite
    if f64::is_infinite(rounded) { value } else { rounded }
}

/// `value` with one significant digit, the nearest number to what a person would write; `round` rounds its mantissa, from 1 to 10.
/// Numbers without their full digits (zero, subnormal or not finite) stay as they are.
pub fn one_digit(value: f64, round: impl Fn(f64) -> f64) -> f64 {
    if !value.is_normal() {
        return value;
    }
    let exponent = libm::log10(value.abs()).floor() as i32;
    let mantissa = round(value / libm::pow(10.0, f64::from(exponent)));
    format!("{mantissa}e{exponent}").parse().unwrap_or(value)
}

/// A `number` of units of this `size`: where that is a power of ten, the number with the same digits.
pub fn of_size(number: f64, size: f64) -> f64 {
    let power = libm::log10(size).round();
    let written = format!("{number:e}");
    match written.split_once('e') {
        Some((digits, exponent)) if format!("1e{power}").parse() == Ok(size) => {
            let exponent: f64 = exponent.parse().expect("an exponent");
            format!("{digits}e{}", exponent + power).parse().expect("a number")
        }
        _ => size * number,
    }
}

/// The SI prefixes, with their powers of ten.
const PREFIXES: [(&str, i32); 10] =
    [("f", -15), ("p", -12), ("n", -9), ("u", -6), ("m", -3), ("", 0), ("k", 3), ("M", 6), ("G", 9), ("T", 12)];

/// A unit with its prefix, and its size in the SI unit.
pub struct Prefixed {
    pub unit: String,
    pub size: f64,
}

impl Prefixed {
    /// The unit under the name of a column.
    pub fn heading(&self) -> String {
        if self.unit.is_empty() { String::new() } else { format!("[{}]", self.unit) }
    }
}

/// The best prefix of `unit` for a number of the size of `value` [`unit`].
///
/// Lengths, times and speeds have no prefix above 1 (`1200 m`), and masses below a kilogram are in grams. Units that take no
/// prefix (`kg/m^3`, dimensionless numbers) do not change.
pub fn prefixed(value: f64, unit: &'static str) -> Prefixed {
    let (base, first, largest) = match unit {
        "m" | "s" | "m/s" => (unit, 0, 0),
        "kg" => ("g", -3, 3),
        "N" | "J" | "Pa" | "N/m" | "N.s" => (unit, 0, 12),
        _ => return Prefixed { unit: unit.into(), size: 1.0 },
    };
    let value = rounded(value, DIGITS).abs();
    let wanted = if value > 0.0 && value.is_finite() { value.log10() } else { 0.0 };
    let power = (wanted.floor() as i32 - first).div_euclid(3) * 3;
    let nearest = PREFIXES.iter().min_by_key(|(_, own)| (own - power.min(largest)).abs());
    let (prefix, power) = nearest.expect("there are prefixes");
    // converted through text: the power of ten that a person would write
    let size = format!("1e{}", power + first).parse().expect("a power of ten");
    Prefixed { unit: format!("{prefix}{base}"), size }
}

/// A number with its unit, four significant digits and an SI prefix: `330.7 N`, `12.56 um`.
pub fn quantity(value: f64, unit: &'static str) -> String {
    with_unit(value, unit, DIGITS)
}

/// The same with six significant digits.
pub fn precise(value: f64, unit: &'static str) -> String {
    with_unit(value, unit, 6)
}

fn with_unit(value: f64, unit: &'static str, digits: usize) -> String {
    let Prefixed { unit, size } = prefixed(value, unit);
    format!("{} {unit}", significant(value / size, digits)).trim_end().into()
}

/// A number with its unit and the `band` that it is in: `345 N (331 to 358 N)`. A band without width is left out.
pub fn with_band(value: f64, band: Option<[f64; 2]>, unit: &'static str) -> String {
    /// Digits of the ends.
    const ENDS: usize = 3;
    let text = quantity(value, unit);
    let Some([low, high]) = band.filter(|[low, high]| high - low > 1e-9 * high.abs()) else { return text };
    let Prefixed { unit, size } = prefixed(high, unit);
    let [low, high] = [low, high].map(|end| significant(end / size, ENDS));
    let ends = format!("{low} to {high} {unit}");
    format!("{text} ({})", ends.trim_end())
}

/// A number in a table, in units of this size; a dash if there is none.
pub fn cell(value: f64, size: f64) -> String {
    if value.is_nan() { "-".into() } else { significant(value / size, DIGITS) }
}

/// A relative difference in percent with its sign. A negligible difference is described as such.
pub fn percent(difference: f64) -> String {
    const LEAST: f64 = 1e-6;
    match difference {
        0.0 => "0 %".into(),
        difference if difference.abs() < LEAST => format!("below {} %", rounded(100.0 * LEAST, 1)),
        difference => {
            let sign = if difference > 0.0 { "+" } else { "" };
            format!("{sign}{} %", rounded(100.0 * difference, 2))
        }
    }
}

/// What is wrong with the `value` of a name: `= -1 is out of range: allowed is 0 to 1e9 m`. Numbers look as in the messages of an
/// FMU, but have all their digits.
pub fn out_of_range(value: f64, allowed: &RangeInclusive<f64>, unit: &str) -> String {
    let (value, allowed) = (in_message(value), in_range(allowed));
    format!("= {value} is out of range{ALLOWED}{allowed} {unit}").trim_end().into()
}

/// What comes before the range in a message.
pub const ALLOWED: &str = ": allowed is ";

/// A range in a message: `1e-9 to 10`.
pub fn in_range(allowed: &RangeInclusive<f64>) -> String {
    format!("{} to {}", in_message(*allowed.start()), in_message(*allowed.end()))
}

/// A number in a message, with all its digits: `0.005`, `300000`, `1e300`.
pub fn in_message(value: f64) -> String {
    let is_plain = value == 0.0 || !value.is_finite() || (1e-5..1e9).contains(&value.abs());
    if is_plain { value.to_string() } else { format!("{value:e}") }
}

/// A message without what Rust says about a text that is no number.
pub fn in_words(message: &str) -> String {
    const WORDS: [(&str, &str); 7] = [
        ("invalid float literal", "a number is expected"),
        ("cannot parse float from empty string", "a number is expected"),
        ("invalid digit found in string", "a whole number is expected"),
        ("cannot parse integer from empty string", "a whole number is expected"),
        ("number too large to fit in target type", "the number is too large"),
        ("number too small to fit in target type", "the number is too small"),
        // an open range
        ("0 is not in 1..18446744073709551615", "the number is too small: at least 1 is expected"),
    ];
    WORDS.iter().fold(message.into(), |message, (theirs, ours)| message.replace(theirs, ours))
}

/// A number in the form of a scene file: `5e-3`, `210e9`, `7850`.
pub fn plain(value: f64) -> String {
    let value = rounded(value, 12);
    let size = value.abs();
    if size == 0.0 || (0.01..1e5).contains(&size) || !size.is_finite() {
        return format!("{value}");
    }
    let power = (size.log10().floor() as i32).div_euclid(3) * 3;
    let mantissa = rounded(value / 10f64.powi(power), 12);
    // of the smallest numbers, the power of ten would be zero
    if mantissa.is_finite() { format!("{mantissa}e{power}") } else { format!("{value:e}") }
}
