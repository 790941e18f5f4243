//! Numbers with a unit, as people write them: `5 mm`, `240 MPa`, `7.85 g/cm3`.
//!
//! Inside there is SI alone. A unit is a product of symbols with prefixes and powers, so that its dimension is known: a length where
//! a pressure belongs is a mistake, not a factor.

use crate::layout::shortened;
use crate::nearest::{nearest, one_of};
use crate::numbers::{ALLOWED, in_message};
use std::borrow::Cow;

/// The size of a unit: `numerator/denominator * 10^power` of the SI unit. Powers of ten are kept apart, since a number is read with
/// its exponent: `0.3 mm` is the very number that `0.3e-3` is.
#[derive(Clone, Copy)]
struct Unit {
    numerator: f64,
    denominator: f64,
    power: i32,
    /// Exponents of kg, m, s and rad.
    dimension: [i32; 4],
}

const ONE: Unit = Unit { numerator: 1.0, denominator: 1.0, power: 0, dimension: [0; 4] };

/// A symbol, its size with a power of ten apart, and its dimension.
type Symbol = (&'static str, f64, i32, [i32; 4]);

/// The symbols that take a prefix.
const METRIC: [Symbol; 8] = [
    ("g", 1.0, -3, [1, 0, 0, 0]),
    ("m", 1.0, 0, [0, 1, 0, 0]),
    ("s", 1.0, 0, [0, 0, 1, 0]),
    ("N", 1.0, 0, [1, 1, -2, 0]),
    ("Pa", 1.0, 0, [1, -1, -2, 0]),
    ("J", 1.0, 0, [1, 2, -2, 0]),
    ("Hz", 1.0, 0, [0, 0, -1, 0]),
    ("bar", 1.0, 5, [1, -1, -2, 0]),
];

/// The symbols that take none. `kp` and `kgf` are the weight of a kilogram.
const OTHERS: [Symbol; 21] = [
    ("1", 1.0, 0, [0; 4]),
    ("t", 1.0, 3, [1, 0, 0, 0]),
    ("lb", 0.453_592_37, 0, [1, 0, 0, 0]),
    ("oz", 0.028_349_523_125, 0, [1, 0, 0, 0]),
    ("in", 0.0254, 0, [0, 1, 0, 0]),
    ("ft", 0.3048, 0, [0, 1, 0, 0]),
    ("mil", 25.4, -6, [0, 1, 0, 0]),
    ("min", 60.0, 0, [0, 0, 1, 0]),
    ("h", 3600.0, 0, [0, 0, 1, 0]),
    ("mph", 0.447_04, 0, [0, 1, -1, 0]),
    ("kgf", 9.806_65, 0, [1, 1, -2, 0]),
    ("kp", 9.806_65, 0, [1, 1, -2, 0]),
    ("lbf", 4.448_221_615_260_5, 0, [1, 1, -2, 0]),
    // lbf/in^2
    ("psi", 6_894.757_293_168_361, 0, [1, -1, -2, 0]),
    ("ksi", 6_894.757_293_168_361, 3, [1, -1, -2, 0]),
    ("Mpsi", 6_894.757_293_168_361, 6, [1, -1, -2, 0]),
    ("rad", 1.0, 0, [0, 0, 0, 1]),
    ("mrad", 1.0, -3, [0, 0, 0, 1]),
    ("deg", std::f64::consts::PI / 180.0, 0, [0, 0, 0, 1]),
    ("\u{b0}", std::f64::consts::PI / 180.0, 0, [0, 0, 0, 1]),
    ("rpm", std::f64::consts::PI / 30.0, 0, [0, 0, -1, 1]),
];

/// The prefixes; micro has two signs, and a letter that stands for them.
const PREFIXES: [(&str, i32); 12] = [
    ("p", -12),
    ("n", -9),
    ("u", -6),
    ("\u{b5}", -6),
    ("\u{3bc}", -6),
    ("m", -3),
    ("c", -2),
    ("d", -1),
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
];

impl Unit {
    /// The unit that `text` names: symbols with powers, such as `kg/m^3`, `N/mm2`, `kg m^2`, `1/s`. Each `/` divides by what follows it
    /// directly.
    fn parse(text: &str) -> Option<Unit> {
        let text = text.replace("**", "^").replace(['\u{b7}', '*'], ".").replace('\u{b2}', "2").replace('\u{b3}', "3");
        let mut unit = ONE;
        for (index, factors) in text.split('/').enumerate() {
            let mut factors = factors.split(['.', ' ']).filter(|factor| !factor.is_empty());
            // "/s" has nothing to divide
            let first = power_of(factors.next()?)?;
            unit = unit.times(first, if index == 0 { 1 } else { -1 });
            for factor in factors {
                unit = unit.times(power_of(factor)?, 1);
            }
        }
        Some(unit)
    }

    /// This unit times the `power` of another, which is a symbol to a small power.
    fn times(self, (other, exponent): (Unit, i32), sign: i32) -> Unit {
        let exponent = sign * exponent;
        let size = other.numerator.powi(exponent.abs());
        let (up, down) = if exponent > 0 { (size, 1.0) } else { (1.0, size) };
        let mut dimension = self.dimension;
        dimension.iter_mut().zip(other.dimension).for_each(|(own, other)| *own += exponent * other);
        Unit {
            numerator: self.numerator * up,
            denominator: self.denominator * down,
            power: self.power + exponent * other.power,
            dimension,
        }
    }

    /// The `number`, a decimal text, of this unit in another of the same dimension.
    fn number(self, number: &str, other: Unit) -> f64 {
        let (digits, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
        let beyond = if exponent.starts_with('-') { i32::MIN / 2 } else { i32::MAX / 2 };
        let exponent = exponent.parse().unwrap_or(beyond).saturating_add(self.power - other.power);
        let decimal: f64 = format!("{digits}e{exponent}").parse().unwrap_or(f64::NAN);
        decimal * (self.numerator * other.denominator) / (self.denominator * other.numerator)
    }

    /// What a number of this dimension is.
    fn kind(self) -> Option<&'static Kind> {
        KINDS.iter().find(|kind| Unit::parse(kind.unit).is_some_and(|unit| unit.dimension == self.dimension))
    }
}

/// A symbol with its prefix, and its power: `mm2` or `s^-1`.
fn power_of(factor: &str) -> Option<(Unit, i32)> {
    let (symbol, exponent) = match factor.find(|c: char| c == '^' || c == '-' || c.is_ascii_digit()) {
        Some(end) if end > 0 => (&factor[..end], factor[end..].trim_start_matches('^').parse().ok()?),
        _ => (factor, 1),
    };
    let is_power = exponent != 0_i32 && exponent.abs() <= 4;
    let of = |(_, size, power, dimension): &Symbol, prefix: i32| Unit {
        numerator: *size,
        denominator: 1.0,
        power: power + prefix,
        dimension: *dimension,
    };
    let alone = OTHERS.iter().chain(&METRIC).find(|(name, ..)| *name == symbol).map(|found| of(found, 0));
    let prefixed = || {
        PREFIXES.iter().find_map(|(prefix, power)| {
            let name = symbol.strip_prefix(prefix)?;
            METRIC.iter().find(|(known, ..)| *known == name).map(|found| of(found, *power))
        })
    };
    Some((alone.or_else(prefixed).filter(|_| is_power)?, exponent))
}

/// A kind of quantity: its SI unit, what a number of it is, the unit in words, and the units that messages name.
struct Kind {
    unit: &'static str,
    is: &'static str,
    name: &'static str,
    usual: &'static [&'static str],
}

const KINDS: [Kind; 14] = [
    Kind { unit: "m", is: "a length", name: "metres", usual: &["nm", "um", "mm", "cm", "m", "km", "in", "ft"] },
    Kind {
        unit: "Pa",
        is: "a pressure",
        name: "pascals",
        usual: &["Pa", "kPa", "MPa", "GPa", "N/mm^2", "kgf/mm^2", "psi", "ksi"],
    },
    Kind { unit: "kg", is: "a mass", name: "kilograms", usual: &["mg", "g", "kg", "t", "oz", "lb"] },
    Kind {
        unit: "m/s",
        is: "a speed",
        name: "metres per second",
        usual: &["mm/s", "cm/s", "m/s", "km/s", "km/h", "ft/s", "mph"],
    },
    Kind {
        unit: "kg/m^3",
        is: "a density",
        name: "kilograms per cubic metre",
        usual: &["kg/m^3", "g/cm^3", "kg/dm^3", "t/m^3", "lb/in^3"],
    },
    Kind { unit: "J", is: "an energy", name: "joules", usual: &["uJ", "mJ", "J", "kJ"] },
    Kind { unit: "N", is: "a force", name: "newtons", usual: &["uN", "mN", "N", "kN", "MN", "kgf", "kp", "lbf"] },
    Kind { unit: "m^2", is: "an area", name: "square metres", usual: &["mm^2", "cm^2", "m^2", "in^2"] },
    Kind { unit: "1/s", is: "a rate", name: "per second", usual: &["1/s", "1/ms", "1/min", "Hz", "kHz"] },
    Kind { unit: "s", is: "a time", name: "seconds", usual: &["ns", "us", "ms", "s", "min", "h"] },
    Kind {
        unit: "kg.m^2",
        is: "a moment of inertia",
        name: "kilogram square metres",
        usual: &["kg.m^2", "kg.mm^2", "g.cm^2", "g.mm^2"],
    },
    Kind { unit: "deg", is: "an angle", name: "degrees", usual: &["deg", "rad", "mrad"] },
    Kind {
        unit: "m/N",
        is: "a compliance",
        name: "metres per newton",
        usual: &["nm/N", "um/N", "mm/N", "mm/kN", "m/N"],
    },
    Kind { unit: "rad/s", is: "a spin", name: "radians per second", usual: &["rad/s", "deg/s", "rpm"] },
];

/// The kind of quantity with this SI unit; `None` for units of a law, such as its yield force, and for numbers without dimension.
fn kind(unit: &str) -> Option<&'static Kind> {
    Unit::parse(unit).and_then(Unit::kind)
}

/// The SI units of quantities, each with the units that people write and the SI number of one of each.
pub fn usual() -> impl Iterator<Item = (&'static str, Vec<(&'static str, f64)>)> {
    let size = |own: &str, unit: &str| Some(Unit::parse(own)?.number("1", Unit::parse(unit)?));
    KINDS.iter().map(move |Kind { unit, usual, .. }| {
        (*unit, usual.iter().filter_map(|own| Some((*own, size(own, unit)?))).collect())
    })
}

/// The number in `text`, and the unit after it, if there is one.
fn split(text: &str) -> Option<(String, &str)> {
    let text = text.trim().trim_matches(['"', '\'']).trim();
    // the longest prefix that is a number: an `e` may belong to it or to the unit
    let ends = (1..=text.len()).rev().filter(|end| text.is_char_boundary(*end));
    ends.filter(|end| text[..*end].ends_with(|last: char| last.is_ascii_digit() || last == '.')).find_map(|end| {
        let number = text[..end].replace('_', "");
        let is_one = number.parse::<f64>().is_ok();
        is_one.then(|| (number, text[end..].trim()))
    })
}

/// The pattern, for JSON Schema, of texts that stand for a number in this SI `unit`, and usual units. A single symbol has the same
/// dimension; that of a product no regular expression knows.
pub fn pattern(unit: &str, may_be_negative: bool) -> Option<(String, &'static [&'static str])> {
    // a comma is decimal unless it may separate thousands, see `comma`
    const NUMBER: &str = r"(?:(?:[0-9_]+(?:\.[0-9_]*|,[0-9]{1,2}|,[0-9]{4,})?|(?:0[0-9_]*|[0-9_]{4,}),[0-9]{3}|\.[0-9_]+)(?:[eE][+-]?[0-9_]+)?|[0-9_]{1,3},[0-9]{3}[eE][+-]?[0-9_]+)";
    let (Kind { usual, .. }, Unit { dimension, .. }) = (kind(unit)?, Unit::parse(unit)?);
    let sign = if may_be_negative { "[+-]?" } else { r"\+?" };
    let prefixes: String = PREFIXES.iter().map(|(prefix, _)| *prefix).collect();
    let with_power = |(name, .., own): &Symbol| {
        let power = (1..=4).find(|power| own.map(|part| part * power) == dimension)?;
        Some(match power {
            1 => (*name).to_string(),
            2 => format!("{name}(?:(?:\\^|\\*\\*)?2|\u{b2})"),
            3 => format!("{name}(?:(?:\\^|\\*\\*)?3|\u{b3})"),
            power => format!("{name}(?:\\^|\\*\\*)?{power}"),
        })
    };
    let list = |symbols: &[Symbol], of: &dyn Fn(&Symbol) -> Option<String>| {
        symbols.iter().filter_map(of).collect::<Vec<_>>().join("|")
    };
    let any = |of: &dyn Fn(&Symbol) -> Option<String>| match [list(&METRIC, of), list(&OTHERS, of)] {
        [metric, others] if metric.is_empty() => others,
        [metric, others] if others.is_empty() => format!("[{prefixes}]?(?:{metric})"),
        [metric, others] => format!("[{prefixes}]?(?:{metric})|{others}"),
    };
    let symbol = any(&|(name, ..)| Some((*name).to_string()));
    let product = format!("(?:(?:{symbol})[-^*0-9\u{b2}\u{b3}]*(?:[./*\u{b7} ]+|\\s*$)){{2,}}");
    let ways = [any(&with_power), product].into_iter().filter(|way| !way.is_empty()).collect::<Vec<_>>().join("|");
    Some((format!("^\\s*{sign}{NUMBER}\\s*(?:{ways})\\s*$"), usual))
}

/// A number with a unit in `text`, in this SI `unit`. `None` if the text doesn't begin with a number, or no other unit is known.
///
/// # Errors
/// What is wrong with the unit, and what is allowed.
pub fn with_unit(text: &str, unit: &str) -> Option<Result<f64, String>> {
    let text = match pointed(text) {
        Ok(text) => text,
        Err(why) => return Some(Err(why)),
    };
    let (number, suffix) = split(&text)?;
    let (expected, si) = (kind(unit)?, Unit::parse(unit)?);
    let allowed = || format!("{} has a unit like {}", expected.is, one_of(expected.usual));
    if suffix.is_empty() {
        return Some(Err(format!(
            "in quotes a number needs its unit: \"{number} {}\"; without quotes it is in {}",
            expected.unit, expected.name
        )));
    }
    let Some(own) = Unit::parse(suffix) else {
        if suffix.trim_start_matches([',', '.', '\'', '\u{2019}', ' ']).starts_with(|c: char| c.is_ascii_digit()) {
            let why = "has one decimal point or comma, and nothing else between its digits";
            return Some(Err(format!("a number {why}; `{}` follows {number}", shortened(suffix))));
        }
        let guess = nearest(suffix, expected.usual.iter().copied());
        let more = match guess {
            Some(guess) => format!("did you mean `{guess}`? A{}", &allowed()[1..]),
            None => allowed(),
        };
        return Some(Err(format!("there is no unit `{}`; {more}", shortened(suffix))));
    };
    if own.dimension != si.dimension {
        let is = own.kind().map_or(String::new(), |kind| format!(" is {}", kind.is));
        return Some(Err(format!("{suffix}{is}; {}", allowed())));
    }
    let value = own.number(&number, si);
    if value.is_finite() { Some(Ok(value)) } else { Some(Err("the number is too large".into())) }
}

/// The size of the unit `text` in this SI `unit`; `None` for what is no unit of that dimension.
pub fn size(text: &str, unit: &str) -> Option<f64> {
    let (own, si) = (Unit::parse(text)?, Unit::parse(unit)?);
    (own.dimension == si.dimension).then(|| own.number("1", si))
}

/// Whether a `text` is a unit that some quantity has.
pub fn is_unit(text: &str) -> bool {
    Unit::parse(text).is_some_and(|unit| unit.kind().is_some())
}

/// A number with a comma between its digits.
struct Comma {
    /// With a point in its place.
    decimal: String,
    /// Without it, where three digits follow as in `206,000`: it may separate thousands.
    group: Option<String>,
    /// What stands behind the number.
    suffix: String,
}

/// The comma in `text`, if that begins with a number that has one.
fn comma(text: &str) -> Option<Comma> {
    let text = text.trim().trim_matches(['"', '\'']).trim();
    let (whole, rest) = text.split_once(',')?;
    let figures = whole.strip_prefix(['+', '-']).unwrap_or(whole);
    let is_whole = !figures.is_empty() && figures.bytes().all(|byte| byte.is_ascii_digit() || byte == b'_');
    let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    if !is_whole || digits == 0 || rest[digits..].starts_with([',', '.']) {
        return None;
    }
    let decimal = format!("{whole}.{rest}");
    let (number, suffix) = split(&decimal)?;
    // an exponent says that it is no group
    let is_group = digits == 3 && figures.len() <= 3 && !figures.starts_with('0') && !number.contains(['e', 'E']);
    let suffix = suffix.to_string();
    Some(Comma { decimal, group: is_group.then(|| format!("{whole}{rest}")), suffix })
}

/// A quantity in `text` with a point for its decimal comma: where no list is possible, a comma between digits is one.
///
/// # Errors
/// The comma may separate thousands.
pub fn pointed(text: &str) -> Result<Cow<'_, str>, String> {
    match comma(text) {
        None => Ok(text.into()),
        Some(Comma { decimal, group: None, .. }) => Ok(decimal.into()),
        Some(Comma { decimal, group: Some(group), .. }) => {
            Err(format!("write {decimal} if this is a decimal comma, or {group} if it separates thousands"))
        }
    }
}

/// The message about a number with a decimal comma where a list is possible: `this is a decimal comma; write 5.3`.
pub fn decimal_comma(text: &str) -> Option<String> {
    let Comma { decimal, group, suffix } = comma(text).filter(|_| text.matches(',').count() == 1)?;
    let is_quantity = suffix.is_empty() || Unit::parse(&suffix).is_some();
    let group = group.map_or(String::new(), |group| format!(", or {group} if it separates thousands"));
    is_quantity.then(|| format!("this is a decimal comma; write {decimal}{group}"))
}

/// A number with a unit, as a form shows it.
pub struct Shown {
    /// With a decimal point.
    pub digits: String,
    pub unit: String,
    /// The SI number of one such unit.
    pub size: f64,
    /// The SI number of all.
    pub number: f64,
}

/// The parts of a `text` that is a number with a unit of the dimension of this SI `unit`.
pub fn shown(text: &str, unit: &str) -> Option<Shown> {
    let number = with_unit(text, unit)?.ok()?;
    let text = pointed(text).ok()?;
    let (digits, own) = split(&text)?;
    Some(Shown { digits, unit: own.into(), size: Unit::parse(own)?.number("1", Unit::parse(unit)?), number })
}

/// Its SI number, if a power of ten is between them: then a scene that has it without a unit keeps all of its digits.
pub fn bare(shown: &Shown) -> Option<f64> {
    let power = libm::log10(shown.size);
    ((power - libm::round(power)).abs() < 1e-12).then_some(shown.number)
}

/// A `message` in SI units about the number that a scene writes as `text`, in the unit that it has there: `radius = -3 mm is out of range:
/// allowed is 1e-9 to 1000000000000 mm`. `None` if the text has no unit, or the message doesn't give its number.
pub fn in_unit_of(text: &str, message: &str) -> Option<String> {
    let text = pointed(text.trim_matches(['"', '\''])).ok()?;
    let (number, suffix) = split(&text)?;
    let own = Unit::parse(suffix)?;
    let unit = own.kind()?.unit;
    let si = Unit::parse(unit)?;
    let (before, after) = message.split_once(&format!("= {} ", in_message(own.number(&number, si))))?;
    let (range, after) = match after.split_once(ALLOWED) {
        Some((between, range)) => {
            let (from, range) = range.split_once(" to ")?;
            let (to, rest) = range.split_once(' ')?;
            let [from, to] = [from, to].map(|end| in_message(si.number(end, own)));
            (
                format!("{between}{ALLOWED}{from} to {to} {suffix}"),
                rest.strip_prefix(unit).or_else(|| rest.strip_prefix(&unit.replace('.', " ")))?,
            )
        }
        None => (String::new(), after),
    };
    Some(format!("{before}= {number} {suffix} {range}{after}"))
}

/// The message about a number with a unit that isn't in quotes, though in a scene it must be.
pub fn needs_quotes(text: &str) -> Option<String> {
    let (number, suffix) = split(text).filter(|_| !text.trim().starts_with(['"', '\'']))?;
    Unit::parse(suffix).map(|_| format!("a number with a unit is in quotes: \"{number} {suffix}\""))
}

/// A number on the command line, with a unit or in this SI `unit`.
///
/// # Errors
/// What is wrong with it, and what is allowed.
pub fn number(text: &str, unit: &str) -> Result<f64, String> {
    if let Ok(number) = pointed(text)?.trim().parse() {
        return Ok(number);
    }
    let expected = || match kind(unit) {
        Some(Kind { name, usual, .. }) => {
            format!("a number in {name} is expected, or with a unit like {}", one_of(usual))
        }
        None => "a number is expected".into(),
    };
    with_unit(text, unit).unwrap_or_else(|| Err(expected()))
}

/// Reads numbers on the command line, with a unit or in this SI `unit`.
pub fn numbers_in(unit: &'static str) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| number(text, unit)
}

/// A load with its unit on the command line, in newtons: `29.4kN`, `3000kgf`.
pub fn loads(text: &str) -> Result<f64, String> {
    let usual = one_of(kind("N").map_or(&[], |kind| kind.usual));
    let missing = || Err(format!("a number with a unit is expected, such as 29.4kN; units are {usual}"));
    if text.trim().parse::<f64>().is_ok() { missing() } else { with_unit(text, "N").unwrap_or_else(missing) }
}
