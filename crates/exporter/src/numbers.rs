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
const DIGITS: usize = 4;

fn rounded(value: f64, count: usize) -> f64 {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_people_write_them() {
        for (value, unit, text) in [
            (330.664, "N", "330.7 N"),
            (1.256060e-5, "m", "12.56 um"),
            (2.984606e-5, "s", "29.85 us"),
            (4.11e-3, "kg", "4.11 g"),
            (2.5, "kg", "2.5 kg"),
            (0.99996, "kg", "1 kg"),
            (1.0, "m/s", "1 m/s"),
            (1.8737e-3, "m/s", "1.874 mm/s"),
            (5000.0, "m/s", "5000 m/s"),
            (206e9, "Pa", "206 GPa"),
            (999.96e6, "Pa", "1 GPa"),
            (7850.0, "kg/m^3", "7850 kg/m^3"),
            (0.44629924, "", "0.4463"),
            (-0.05, "m", "-50 mm"),
            (0.0, "J", "0 J"),
            (-0.0, "J", "0 J"),
            (2e-30, "m", "2e-15 fm"),
            (3e20, "N", "3e8 TN"),
        ] {
            assert_eq!(quantity(value, unit), text);
        }
    }

    #[test]
    fn a_band_stands_behind_its_number_in_one_unit() {
        assert_eq!(with_band(344.6, Some([331.4, 357.5]), "N"), "344.6 N (331 to 358 N)");
        assert_eq!(with_band(0.569, Some([0.5512, 0.5871]), ""), "0.569 (0.551 to 0.587)");
        assert_eq!(with_band(9.9e-7, Some([0.0, 1.2e-6]), "m"), "990 nm (0 to 1.2 um)");
        assert_eq!(with_band(1.0, Some([1.0, 1.0]), ""), "1");
        assert_eq!(with_band(2.0, None, "J"), "2 J");
    }

    #[test]
    fn differences_that_nobody_sees_are_called_so() {
        for (difference, text) in [
            (0.0, "0 %"),
            (-0.0, "0 %"),
            (-3e-9, "below 0.0001 %"),
            (1.234e-5, "+0.0012 %"),
            (-0.021, "-2.1 %"),
            (1e-6, "+0.0001 %"),
        ] {
            assert_eq!(percent(difference), text);
        }
    }

    #[test]
    fn numbers_in_messages_have_no_rows_of_zeros() {
        for (value, text) in [
            (0.005, "0.005"),
            (-3e5, "-300000"),
            (0.0, "0"),
            (1e300, "1e300"),
            (-1e300, "-1e300"),
            (5e-324, "5e-324"),
            (1.5e-9, "1.5e-9"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(in_message(value), text);
        }
    }

    #[test]
    fn a_range_has_one_form_of_numbers() {
        for (value, allowed, unit, text) in [
            (-0.005, 1e-12..=1e9, "m", "= -0.005 is out of range: allowed is 1e-12 to 1e9 m"),
            (1e10, 0.001..=1e6, "", "= 1e10 is out of range: allowed is 0.001 to 1000000"),
            (f64::NAN, -1e40..=1e40, "m/s", "= NaN is out of range: allowed is -1e40 to 1e40 m/s"),
            (1.0000000001, 0.0..=1.0, "", "= 1.0000000001 is out of range: allowed is 0 to 1"),
        ] {
            assert_eq!(out_of_range(value, &allowed, unit), text);
        }
    }

    /// Zeros, what is no number, the ends of all doubles, and numbers of all sizes.
    fn any_numbers() -> impl Iterator<Item = f64> {
        let special =
            [0.0, f64::MIN_POSITIVE, f64::from_bits(1), f64::MAX, f64::INFINITY, f64::NAN, 1.0, 9.5, 999.9996];
        // every exponent, with a mantissa of all digits
        let sizes = (0..2047_u64)
            .map(|exponent| f64::from_bits(exponent << 52 | exponent.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 12));
        special.into_iter().chain(sizes).flat_map(|value| [value, -value])
    }

    #[test]
    fn every_double_has_a_text_that_reads_back_as_it() {
        let near = |text: &str, value: f64, digits: i32| {
            let read: f64 = text.parse().unwrap_or_else(|_| panic!("{text:?} for {value:e}"));
            // a subnormal number has fewer digits than its text
            let allowed = 0.501 * 10f64.powi(1 - digits) * value.abs() + f64::from_bits(1);
            let is_near = if value.is_finite() { (read - value).abs() <= allowed } else { !read.is_finite() };
            assert!(is_near, "{text} for {value:e}");
        };
        for value in any_numbers() {
            near(&digits(value), value, 6);
            near(&plain(value), value, 12);
            near(&in_message(value), value, 17);
            near(&crate::model_description::number(value), value, 17);
            for count in [1, 3, 17] {
                near(&significant(value, count), value, count as i32);
            }
            for unit in ["m", "s", "m/s", "kg", "N", "J", "Pa", "N/m", "N.s", "", "kg/m^3"] {
                let size = prefixed(value, unit).size;
                for (text, digits) in [(quantity(value, unit), DIGITS as i32), (precise(value, unit), 6)] {
                    let number = text.split(' ').next().unwrap().parse::<f64>().unwrap();
                    // the number may be beyond all doubles in the unit itself
                    near(&format!("{number:e}"), value / size, digits);
                }
            }
            for round in [f64::round, f64::floor, f64::ceil] {
                let short = one_digit(value, round);
                assert!(
                    (short - value).abs() <= value.abs() || !value.is_normal() || !short.is_finite(),
                    "{value:e}: {short:e}"
                );
            }
            // a number that isn't finite is named as it is
            let _ = percent(value);
            let _ = cell(value, 1e-3);
            assert!(out_of_range(value, &(-1.0..=1.0), "m").starts_with(&format!("= {}", in_message(value))));
        }
    }

    #[test]
    fn what_rust_says_about_a_text_that_is_no_number_is_in_words() {
        let of_real = ["", "abc", "1,5"].map(|text| text.parse::<f64>().unwrap_err().to_string());
        let of_whole = ["", "x", "-300", "300", "2.5"].map(|text| text.parse::<i8>().unwrap_err().to_string());
        for error in of_real.iter().chain(&of_whole) {
            assert!(in_words(error).contains("number is "), "{error}");
        }
    }

    #[test]
    fn numbers_of_a_scene_keep_their_digits() {
        for (value, text) in [
            (5.0 * 1e-3, "5e-3"),
            (210e9, "210e9"),
            (7.85 * 1e3, "7850"),
            (0.3, "0.3"),
            (1.5e-6, "1.5e-6"),
            (0.0, "0"),
            (-0.005, "-5e-3"),
            (33e6, "33e6"),
        ] {
            assert_eq!(plain(value), text);
            assert_eq!(text.parse::<f64>().unwrap(), rounded(value, 12));
        }
    }
}
