//! The common parts of all HTML pages: the head, escaped text, and numbers with their units.

use crate::numbers;
use crate::table::UNITS;
use std::fmt::Write;

/// The style of a page of text.
pub const TEXT_STYLE: &str = "\
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 50rem; margin: 0 auto; padding: 1rem; }
table { border-collapse: collapse; display: block; overflow-x: auto; }
th, td { text-align: left; padding: .25rem .75rem .25rem 0; border-bottom: 1px solid #8886; vertical-align: top; }
td.n { text-align: right; white-space: nowrap; } td:last-child:not(.n) { min-width: 12rem; }
figure { margin: 1rem 0; } svg { max-width: 100%; height: auto; }
code { font-size: .95em; } p code, li code { overflow-wrap: anywhere; } sup { line-height: 0; }
pre { overflow-x: auto; padding: .6rem .8rem; background: #8881; font-size: .85em; }
@media (prefers-color-scheme: dark) { svg { filter: invert(.9) hue-rotate(180deg); } }";

/// The beginning of a page, up to its heading.
pub fn begin(page: &mut String, title: &str, style: &str) -> std::fmt::Result {
    writeln!(page, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">")?;
    writeln!(page, "<title>{title}</title>\n<meta name=\"viewport\" content=\"width=device-width\">")?;
    writeln!(page, "<style>\n{style}\n</style>\n</head>\n<body>")
}

/// `text`, escaped for HTML.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// `text` of a terminal for a page: escaped, and its numbers and units with the signs that a terminal may lack.
pub fn prose(text: &str) -> String {
    let text = escape(text);
    let mut after_number = false;
    let words = text.split(' ').map(|word| {
        let core = word.trim_start_matches('(').trim_end_matches([',', '.', ';', ':', ')']);
        let shown = if after_number && is_unit(core) { unit(core) } else { number(core) };
        after_number = core.parse::<f64>().is_ok();
        word.replacen(core, &shown, 1)
    });
    words.collect::<Vec<_>>().join(" ")
}

/// A number of at most six digits with its unit and an SI prefix: `206 GPa`, `12.5606 µm`.
pub fn quantity(value: f64, unit: &'static str) -> String {
    prose(&numbers::precise(value, unit))
}

/// A number without `e`: `1e-12` becomes the twelfth negative power of ten.
pub fn number(text: &str) -> String {
    match text.split_once('e') {
        Some((mantissa, "0")) if text.parse::<f64>().is_ok() => mantissa.into(),
        Some((mantissa, exponent)) if text.parse::<f64>().is_ok() => {
            let times = match mantissa {
                "1" => String::new(),
                "-1" => "-".into(),
                _ => format!("{mantissa}\u{b7}"),
            };
            format!("{times}10<sup>{}</sup>", exponent.replace('-', "\u{2212}"))
        }
        _ => text.into(),
    }
}

/// A unit as it is printed: `um` becomes `µm`, and `m/s2` has a raised 2.
pub fn unit(text: &str) -> String {
    let text = text.strip_prefix('u').map_or_else(|| text.into(), |rest| format!("\u{b5}{rest}"));
    text.replace('^', "").replace('2', "\u{b2}").replace('3', "\u{b3}").replace('.', "\u{b7}")
}

/// Whether `text` is a unit, which may have the prefix `u`.
fn is_unit(text: &str) -> bool {
    let base = text.strip_prefix('u').unwrap_or(text);
    ["s", "g", "kg/m^3"].contains(&base) || UNITS.iter().any(|unit| unit.name == base)
}
