//! Numbers of the command line that are written with a unit, such as `5mm`.

/// A kind of quantity: its SI unit, its name, and other units with their sizes.
struct Dimension {
    unit: &'static str,
    name: &'static str,
    others: &'static [(&'static str, f64)],
}

const KINDS: [Dimension; 7] = [
    Dimension {
        unit: "m",
        name: "metres",
        others: &[
            ("m", 1.0),
            ("mm", 1e-3),
            ("cm", 1e-2),
            ("um", 1e-6),
            ("\u{b5}m", 1e-6),
            ("\u{3bc}m", 1e-6),
            ("nm", 1e-9),
            ("km", 1e3),
            ("in", 0.0254),
        ],
    },
    Dimension {
        unit: "Pa",
        name: "pascals",
        others: &[
            ("Pa", 1.0),
            ("kPa", 1e3),
            ("MPa", 1e6),
            ("GPa", 1e9),
            ("N/mm2", 1e6),
            ("N/mm^2", 1e6),
            ("psi", 6_894.757_293_168),
            ("ksi", 6_894_757.293_168),
        ],
    },
    Dimension {
        unit: "kg",
        name: "kilograms",
        others: &[("kg", 1.0), ("g", 1e-3), ("mg", 1e-6), ("t", 1e3), ("lb", 0.453_592_37)],
    },
    Dimension {
        unit: "m/s",
        name: "metres per second",
        others: &[("m/s", 1.0), ("mm/s", 1e-3), ("cm/s", 1e-2), ("km/s", 1e3), ("km/h", 1.0 / 3.6)],
    },
    Dimension {
        unit: "kg/m^3",
        name: "kilograms per cubic metre",
        others: &[("kg/m^3", 1.0), ("kg/m3", 1.0), ("g/cm^3", 1e3), ("g/cm3", 1e3), ("kg/dm3", 1e3)],
    },
    Dimension { unit: "J", name: "joules", others: &[("J", 1.0), ("mJ", 1e-3), ("uJ", 1e-6), ("kJ", 1e3)] },
    Dimension {
        unit: "N",
        name: "newtons",
        others: &[
            ("N", 1.0),
            ("kN", 1e3),
            ("MN", 1e6),
            ("mN", 1e-3),
            ("uN", 1e-6),
            ("kgf", 9.806_65),
            ("kp", 9.806_65),
            ("lbf", 4.448_221_615_260_5),
        ],
    },
];

fn kind(unit: &str) -> &'static Dimension {
    KINDS.iter().find(|kind| kind.unit == unit).expect("a unit of the program")
}

/// The number in `text` and the unit after it, if there is one.
fn split(text: &str) -> Option<(f64, &str)> {
    let text = text.trim().trim_matches(['"', '\'']).trim();
    // the longest prefix that is a number: an `e` may belong to it or to the unit
    let ends = (1..=text.len()).rev().filter(|end| text.is_char_boundary(*end));
    ends.filter(|end| text[..*end].ends_with(|last: char| last.is_ascii_digit() || last == '.')).find_map(|end| {
        let number = text[..end].replace('_', "").parse().ok()?;
        Some((number, text[end..].trim()))
    })
}

/// The number in SI units, if `text` is a number with a unit of the same kind as `unit`.
pub fn with_unit(text: &str, unit: &str) -> Option<f64> {
    let (number, suffix) = split(text)?;
    let (_, size) = kind(unit).others.iter().find(|(name, _)| *name == suffix)?;
    Some(number * size)
}

/// The message about a number with a decimal comma, and perhaps a unit where none is allowed; `unit` is the SI unit if there is one:
/// `this is a decimal comma; write 5.3`.
pub fn decimal_comma(text: &str, unit: Option<&str>) -> Option<String> {
    let text = text.trim_matches(['"', '\'']);
    let (whole, rest) = text.split_once(',')?;
    let sign = ['+', '-'];
    let is_whole = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'_');
    let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    if !is_whole(whole.trim().trim_start_matches(sign)) || digits == 0 || rest.contains([',', '=']) {
        return None;
    }
    let point = format!("{}.{rest}", whole.trim());
    let (_, suffix) = split(&point)?;
    if !suffix.is_empty() {
        return hint(&point, unit?);
    }
    let is_group = digits == 3 && rest.len() == 3 && whole.trim().trim_start_matches(sign) != "0";
    let group = if is_group { format!(", or {whole}{rest} if it separates thousands") } else { String::new() };
    Some(format!("this is a decimal comma; write {point}{group}"))
}

/// The message about a number with a unit, where none is allowed: `metres, a number without unit: 5e-3`.
pub fn hint(text: &str, unit: &str) -> Option<String> {
    let kind = KINDS.iter().find(|kind| kind.unit == unit)?;
    let (_, suffix) = split(text)?;
    if suffix.is_empty() {
        return None;
    }
    let number = with_unit(text, unit).map_or(String::new(), |number| format!(": {}", crate::numbers::plain(number)));
    Some(format!("{}, a number without unit{number}", kind.name))
}

/// A number on the command line, in this SI unit.
fn number(text: &str, unit: &str) -> Result<f64, String> {
    let said = || decimal_comma(text, Some(unit)).or_else(|| hint(text, unit));
    text.parse().map_err(|_| said().unwrap_or_else(|| format!("a number in {} is expected", kind(unit).name)))
}

/// A mass \[kg\] on the command line.
pub fn masses(text: &str) -> Result<f64, String> {
    number(text, "kg")
}

/// A speed \[m/s\] on the command line.
pub fn speeds(text: &str) -> Result<f64, String> {
    number(text, "m/s")
}

/// An energy \[J\] on the command line.
pub fn energies(text: &str) -> Result<f64, String> {
    number(text, "J")
}

/// A length \[m\] on the command line.
pub fn lengths(text: &str) -> Result<f64, String> {
    number(text, "m")
}

/// A force \[N\] on the command line.
pub fn forces(text: &str) -> Result<f64, String> {
    number(text, "N")
}

/// A load with its unit on the command line, in newtons: `29.4kN`, `3000kgf`.
pub fn loads(text: &str) -> Result<f64, String> {
    let known = || kind("N").others.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
    with_unit(text, "N")
        .ok_or_else(|| format!("a number with a unit is expected, such as 29.4kN; units are {}", known()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_says_what_is_meant() {
        for (text, unit, said) in [
            ("5mm", "m", "metres, a number without unit: 5e-3"),
            ("\"5 mm\"", "m", "metres, a number without unit: 5e-3"),
            ("210 GPa", "Pa", "pascals, a number without unit: 210e9"),
            ("1e3 MPa", "Pa", "pascals, a number without unit: 1e9"),
            ("4.11g", "kg", "kilograms, a number without unit: 4.11e-3"),
            ("7.85 g/cm3", "kg/m^3", "kilograms per cubic metre, a number without unit: 7850"),
            ("5 furlongs", "m", "metres, a number without unit"),
        ] {
            assert_eq!(hint(text, unit).as_deref(), Some(said));
        }
        for text in ["5", "5e-3", "", "five", "mm"] {
            assert_eq!(hint(text, "m"), None);
        }
    }

    #[test]
    fn a_decimal_comma_is_called_so() {
        for (text, unit, said) in [
            ("5,3", Some("m"), "this is a decimal comma; write 5.3"),
            ("-0,25", None, "this is a decimal comma; write -0.25"),
            ("5,3e-3", Some("m"), "this is a decimal comma; write 5.3e-3"),
            ("0,125", None, "this is a decimal comma; write 0.125"),
            ("206,000", Some("Pa"), "this is a decimal comma; write 206.000, or 206000 if it separates thousands"),
            ("\"5,3 mm\"", Some("m"), "metres, a number without unit: 5.3e-3"),
            ("5,3 furlongs", Some("m"), "metres, a number without unit"),
        ] {
            assert_eq!(decimal_comma(text, unit).as_deref(), Some(said));
        }
        for text in ["5", "5.3", "5, 3", "1,2,3", "1.5,3", ",5", "5,", "a,5", "5,3=4", "0,3 x", ""] {
            assert_eq!(decimal_comma(text, None), None, "{text}");
        }
        assert_eq!(speeds("1,5"), Err("this is a decimal comma; write 1.5".into()));
    }

    #[test]
    fn a_load_has_a_unit() {
        assert_eq!(loads("29.4kN"), Ok(29400.0));
        assert_eq!(loads("3000 kgf"), Ok(3000.0 * 9.80665));
        assert_eq!(loads("1e3N"), Ok(1e3));
        assert!(loads("29400").unwrap_err().contains("29.4kN") && loads("5mm").is_err());
    }
}
