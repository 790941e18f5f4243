use brinell_exporter::table::VARIABLES;
use brinell_exporter::units::*;

/// Every usual unit and every prefix, on numbers of all sizes: what a person would write in SI is the very number, or one rounding
/// from it where the unit is no power of ten.
#[test]
fn a_number_with_a_unit_is_its_number_in_si() {
    let numbers =
        ["0.3", "5", "-7.25", "1_000", "2e3", "1.2E-7", "0.1", "123456789.123456789", "4.11", "9.99e22", "+3."];
    let powers = "nm m -9, um m -6, \u{b5}m m -6, mm m -3, cm m -2, km m 3, kPa Pa 3, MPa Pa 6, GPa Pa 9, N/mm^2 Pa 6, mg kg -6, g kg -3, \
                  kg kg 0, t kg 3, mm/s m/s -3, m/ms m/s 3, g/cm\u{b3} kg/m^3 3, kg/dm3 kg/m^3 3, uJ J -6, N.mm J -3, kN N 3, mm2 m^2 -6, \
                  kHz 1/s 3, s^-1 1/s 0, ms s -3, kg_mm^2 kg.m^2 -6, g*cm**2 kg.m^2 -7";
    // unit, that of SI, and the number of the second in the first, with a blank as `_`
    let rows = |table: &'static str| {
        table.split(", ").map(|row| {
            let [unit, si, size] = row.split(' ').collect::<Vec<_>>()[..] else { panic!("{row}") };
            (unit.replace('_', " "), si, size)
        })
    };
    for (unit, si, power) in rows(powers) {
        let power: i32 = power.parse().unwrap();
        for number in numbers {
            let plain = number.replace('_', "");
            let (digits, exponent) = plain.split_once(['e', 'E']).unwrap_or((&plain, "0"));
            let expected: f64 = format!("{digits}e{}", exponent.parse::<i32>().unwrap() + power).parse().unwrap();
            for text in [format!("{number} {unit}"), format!("{number}{unit}"), format!("\"{number} {unit}\"")] {
                assert_eq!(with_unit(&text, si), Some(Ok(expected)), "{text} in {si}");
            }
        }
    }
    let others = "in m 0.0254, ft m 0.3048, mil m 2.54e-5, psi Pa 6894.757293168361, ksi Pa 6894757.293168361, lb kg 0.45359237, \
                  oz kg 0.028349523125, km/h m/s 0.2777777777777778, mph m/s 0.44704, kgf N 9.80665, lbf N 4.4482216152605, \
                  kgf/mm^2 Pa 9806650, lb/in^3 kg/m^3 27679.90471020312, rad deg 57.29577951308232, rpm rad/s 0.10471975511965977, \
                  1/min 1/s 0.016666666666666666, deg deg 1, \u{b0} deg 1";
    for (unit, si, size) in rows(others) {
        for number in numbers {
            let expected = number.replace('_', "").parse::<f64>().unwrap() * size.parse::<f64>().unwrap();
            let found = with_unit(&format!("{number} {unit}"), si).unwrap().unwrap();
            let is_near = (found - expected).abs() <= 2.0 * f64::EPSILON * expected.abs();
            assert!(is_near, "{number} {unit}: {found}, not {expected}");
        }
    }
}

#[test]
fn the_units_that_messages_name_are_units_of_their_kind() {
    for (unit, usual) in usual() {
        for name in usual.iter().map(|(name, _)| name).chain([&unit]) {
            assert!(with_unit(&format!("1 {name}"), unit).unwrap().is_ok(), "{name} in {unit}");
        }
    }
    let units = VARIABLES.iter().filter_map(|variable| variable.unit.as_deref());
    assert!(units.clone().count() > 10 && units.into_iter().all(|unit| size(unit, unit).is_some()));
}

#[test]
fn what_is_wrong_with_a_unit_is_said_with_what_is_allowed() {
    for (text, unit, said) in [
        ("5 mm", "Pa", "mm is a length; a pressure has a unit like one of `Pa`, `kPa`, `MPa`"),
        ("5 Nm", "m", "there is no unit `Nm`; did you mean `nm`?"),
        ("5 N.m", "m", "N.m is an energy; a length has"),
        ("5 kg^3", "m", "kg^3; a length has"),
        ("5 furlongs", "m", "there is no unit `furlongs`; a length has a unit like one of `nm`, `um`, `mm`"),
        ("210 Gpa", "Pa", "there is no unit `Gpa`; did you mean `GPa`?"),
        ("5", "m", "in quotes a number needs its unit: \"5 m\"; without quotes it is in metres"),
        ("5 /s", "1/s", "there is no unit `/s`"),
        ("5 mm^9", "m", "there is no unit `mm^9`"),
        ("5 dkm", "m", "there is no unit `dkm`"),
        ("9e307 km", "m", "the number is too large"),
        ("1e99999999999 km", "m", "the number is too large"),
    ] {
        let found = with_unit(text, unit).map(Result::unwrap_err);
        assert!(found.as_ref().is_some_and(|found| found.contains(said)), "{text}: {found:?}");
    }
    for text in ["", "five", "mm", "-", "e5 mm", "inf m", "nan mm"] {
        assert_eq!(with_unit(text, "m"), None, "{text}");
    }
}

#[test]
fn a_number_of_the_command_line_has_a_unit_or_is_in_si() {
    assert_eq!(number("5mm", "m"), Ok(5e-3));
    assert_eq!(number("5e-3", "m"), Ok(5e-3));
    assert_eq!(number("4.11 g", "kg"), Ok(4.11e-3));
    assert_eq!(number("3.6km/h", "m/s"), Ok(1.0));
    assert_eq!(number("45", "deg"), Ok(45.0));
    assert!(
        number("five", "J").unwrap_err().contains("a number in joules is expected, or with a unit like one of `uJ`")
    );
    assert!(number("5mm", "m/s").unwrap_err().contains("mm is a length; a speed has"));
    assert_eq!((number("1,5", "m/s"), number("-0,25 mm", "m")), (Ok(1.5), Ok(-0.25e-3)));
}

/// Every usual unit: what is out of range is said in the unit in which it was given.
#[test]
fn a_message_about_a_number_with_a_unit_is_in_that_unit() {
    for (unit, usual) in usual() {
        for (own, _) in usual {
            for number in ["-3", "0", "1e99", "0.25"] {
                let si = with_unit(&format!("{number} {own}"), unit).unwrap().unwrap();
                let message = format!("a.b {}", brinell_exporter::numbers::out_of_range(si, &(1e-12..=1e9), unit));
                let said = in_unit_of(&format!("\"{number} {own}\""), &message).expect("it gives the number");
                let ends = said.strip_prefix(&format!("a.b = {number} {own} is out of range: allowed is ")).unwrap();
                let (from, to) = ends.strip_suffix(own).unwrap().split_once(" to ").unwrap();
                for (end, expected) in [(from, 1e-12), (to.trim_end(), 1e9)] {
                    let end = with_unit(&format!("{end} {own}"), unit).unwrap().unwrap();
                    assert!((end / expected - 1.0).abs() < 1e-15, "{said}");
                }
            }
        }
    }
    let message = "the mass = -0.004 must be positive and finite";
    let said = in_unit_of("'-4 g'", message);
    assert_eq!(said.as_deref(), Some("the mass = -4 g must be positive and finite"));
    for text in ["-4e-3", "[1, 2]", "\"-5 g\"", "\"steel\"", ""] {
        assert_eq!(in_unit_of(text, message), None, "{text}");
    }
}

/// Numbers of all forms with a comma: read as with a point unless the comma may separate thousands, and the schema takes the same.
#[test]
fn a_comma_in_a_quantity_is_decimal_unless_it_may_separate_thousands() {
    let wholes = ["0", "1", "12", "206", "1234", "012", "007"];
    let parts = ["1", "25", "125", "000", "1250", "123456"];
    for (whole, part) in wholes.iter().flat_map(|whole| parts.map(|part| (whole, part))) {
        for (sign, exponent) in [("", ""), ("-", ""), ("+", "e-3"), ("", "E2")] {
            for unit in ["mm", " mm", "\u{a0}in", " km"] {
                let text = format!("{sign}{whole},{part}{exponent}{unit}");
                let found = with_unit(&text, "m").expect("a number");
                let is_group = part.len() == 3 && whole.len() <= 3 && !whole.starts_with('0') && exponent.is_empty();
                if is_group {
                    let group = format!("{sign}{whole}{part}{unit} if it separates thousands");
                    assert!(found.is_err_and(|why| why.contains(&group)), "{text}");
                } else {
                    assert_eq!(found, with_unit(&text.replace(',', "."), "m").unwrap(), "{text}");
                }
            }
        }
    }
    for text in ["1,234.5 mm", "1.234,5 mm", "1,2,3 mm", "1 234,5 mm", "1'234 mm"] {
        let said = with_unit(text, "m").unwrap().unwrap_err();
        assert!(said.contains("a number has one decimal point or comma"), "{text}: {said}");
    }
    for text in [",5 mm", "5, mm", "5, 3 mm", "5,x", "5,3"] {
        assert!(!matches!(with_unit(text, "m"), Some(Ok(_))), "{text}");
    }
}

#[test]
fn a_decimal_comma_is_called_so() {
    for (text, said) in [
        ("5,3", "this is a decimal comma; write 5.3"),
        ("-0,25", "this is a decimal comma; write -0.25"),
        ("5,3e-3", "this is a decimal comma; write 5.3e-3"),
        ("0,125", "this is a decimal comma; write 0.125"),
        ("206,000", "this is a decimal comma; write 206.000, or 206000 if it separates thousands"),
        ("\"5,3 mm\"", "this is a decimal comma; write 5.3 mm"),
    ] {
        assert_eq!(decimal_comma(text).as_deref(), Some(said));
    }
    for text in ["5", "5.3", "5, 3", "1,2,3", "1.5,3", ",5", "5,", "a,5", "5,3=4", "0,3 x", "5,3,", ""] {
        assert_eq!(decimal_comma(text), None, "{text}");
    }
}

#[test]
fn a_load_has_a_unit() {
    assert_eq!(loads("29.4kN"), Ok(29400.0));
    assert_eq!(loads("3000 kgf"), Ok(3000.0 * 9.80665));
    assert_eq!(loads("1e3N"), Ok(1e3));
    assert!(loads("29400").unwrap_err().contains("29.4kN") && loads("5mm").is_err());
}
