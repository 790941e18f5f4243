//! Translates the messages of the parser into the terms of the scene file.

use crate::layout::{shortened, without_middle};
use crate::nearest::{nearest, one_of};
use crate::numbers::in_message;
use crate::reading::SCALES;
use crate::units;
use toml::value::Datetime;

/// Unsupported features, with the words by which users would look for them.
const UNSUPPORTED: [(&[&str], &str); 7] = [
    (
        &["angle", "spin", "oblique"],
        "the impact of a scene is along the normal; with [friction] the importer moves the bodies along the surface, too",
    ),
    (&["tangential_stiffness", "rolling_friction", "rolling_resistance"], "[friction] has a coefficient only"),
    (&["coating", "layer", "film"], "bodies are of one material each, and thick"),
    (&["cylinder", "shape", "geometry", "cone", "plane", "mesh"], "the bodies are spheres, sockets and flat surfaces"),
    (&["adhesion", "cohesion", "surface_energy", "work_of_adhesion", "stickiness"], "surfaces don't stick"),
    (&["roughness", "asperities"], "surfaces are smooth"),
    (&["temperature", "creep"], "yield strength doesn't depend on temperature"),
];

/// Keys that belong to another table, or have another name.
const ELSEWHERE: [(&[&str], &str); 19] = [
    (&["mass"], "[impact] has a mass, the bodies have none"),
    (&["speed"], "[impact] has a speed"),
    (&["velocity", "v"], "it is called speed, in [impact]"),
    (&["drop_height", "height"], "[impact] has a drop_height"),
    (
        &[
            "hb",
            "hbw",
            "hv",
            "hv10",
            "hv30",
            "hrc",
            "hrb",
            "hld",
            "brinell_hardness",
            "vickers_hardness",
            "rockwell_hardness",
            "leeb_hardness",
            "hardness",
        ],
        HARDNESS,
    ),
    (&["rm", "uts", "ultimate_strength"], "it is called tensile_strength, as in tensile_strength = \"655 MPa\""),
    // `rp0` is Rp0.2 without quotes
    (
        &["rp02", "rp0", "proof_stress", "re"],
        "it is called yield_strength, or with the tensile strength tensile_test = { proof_stress = \"240 MPa\", tensile_strength = \"480 MPa\" }",
    ),
    (
        &["stress_strain_curve", "stress_strain", "curve", "tensile_curve"],
        "it is called tensile_test, as in tensile_test = \"curve.csv\"",
    ),
    (&["sigma_y"], "it is called yield_strength"),
    (&["e"], "it is called youngs_modulus"),
    (&["elasticity"], "give youngs_modulus"),
    (&["nu", "poisson_ratio"], "it is called poissons_ratio"),
    (&["rho"], "it is called density"),
    (&["strain_rate"], "give rate = { model = \"johnson-cook\", c = ..., reference_rate = ... } of the body"),
    (&["diameter"], "give the radius"),
    (&["surface"], "[target] has a surface"),
    (&["thickness"], "[target] has a thickness under a cylinder, and a plate_thickness for a plate that gives way"),
    (
        &["external_acceleration", "gravity", "g"],
        "it is an input of the FMU with inputs = [\"external_acceleration\"] in [coupling]",
    ),
    (&["friction", "friction_coefficient", "mu"], "a table [friction] with a `coefficient` gives it for all contacts"),
];

/// Stands for [`hardness`] in the table.
const HARDNESS: &str = "hardness";

/// How a hardness is given.
fn hardness() -> String {
    format!("a body has hardness = {SCALES}")
}

/// What word processors and pages of the web put in place of a character of TOML: the characters, their name, and what to type.
const TYPOGRAPHIC: [(&str, &str, &str); 6] = [
    (
        "\u{201c}\u{201d}\u{201e}\u{201f}\u{2033}\u{ab}\u{bb}\u{ff02}\u{2018}\u{2019}\u{201a}\u{2032}",
        "a quotation mark of a word processor",
        "\"",
    ),
    ("\u{b4}`", "an accent", "\""),
    ("\u{2212}", "a minus sign of a word processor", "-"),
    ("\u{2013}\u{2014}", "a dash of a word processor", "-"),
    ("\u{a0}\u{202f}", "a space of a page of the web", "a space"),
    ("\u{ff1d}", "an equals sign of another script", "="),
];

/// The place of the first character of a wrong `line` that stands for one of TOML, and a message. It isn't in a remark, nor in a text in
/// quotes that ends.
pub fn typographic(line: &str) -> Option<(usize, String)> {
    let (mut quote, mut first) = (None, None);
    for (place, c) in line.char_indices() {
        match quote {
            None if c == '#' => break,
            None if c == '"' || c == '\'' => quote = Some(c),
            // a text that ends may have any in it
            Some(open) if c == open => (quote, first) = (None, None),
            _ => first = first.or_else(|| Some((place, c, TYPOGRAPHIC.iter().find(|(those, ..)| those.contains(c))?))),
        }
        if quote.is_none() && first.is_some() {
            break;
        }
    }
    let (place, c, (_, what, typed)) = first?;
    let shown = if c.is_whitespace() { String::new() } else { format!("`{c}` ") };
    let (code, line) = (u32::from(c), shortened(line.trim()));
    Some((place, format!("{shown}(U+{code:04X}) is {what}; type {typed} in `{line}`")))
}

/// The `message` of the parser about the part `meant` of a `line`.
pub fn words(message: &str, line: &str, meant: &str) -> String {
    if let Some(field) = message.strip_prefix("missing field ") {
        return missing(field, line);
    }
    // the parser takes a date for a table with a key of its own
    if meant.parse::<Datetime>().is_ok() {
        let expected = message.rsplit_once(", expected ").map_or("a string", |(_, expected)| expected);
        return format!("this is a date, expected {} in `{}`", wanted(expected), shortened(line));
    }
    if let Some(names) = message.strip_prefix("unknown field ") {
        return unknown_field(names);
    }
    if let Some(hint) = decimal_comma(line).or_else(|| hint(line, meant)) {
        return hint;
    }
    if let Some(names) = message.strip_prefix("unknown variant ") {
        let names = quoted(names);
        let (asked, known) = names.split_first().expect("the parser names the variant");
        return format!("{} in `{}`", crate::nearest::unknown("word", asked, known.iter().copied()), shortened(line));
    }
    // the parser names Rust types but not the key; the key is in the line
    let line = shortened(line);
    let message = in_words_of_the_file(message);
    let list = message.ends_with("a list") && line.starts_with('[') && !line.starts_with("[[");
    let help = if list { format!("; write `[{}]`", line.trim_end()) } else { String::new() };
    format!("{} in `{line}`{help}", without_middle(&message))
}

/// The `message` of the parser with the words of TOML instead of Rust's.
fn in_words_of_the_file(message: &str) -> String {
    if message == "floating-point number overflowed" {
        return format!("the number is too large: numbers are below {}", in_message(f64::MAX));
    }
    let (problem, expected) = message.rsplit_once(", expected ").unwrap_or((message, ""));
    if let Some(value) = problem.strip_prefix("invalid type: ") {
        let is = KINDS.iter().find(|(kind, _)| value.starts_with(kind)).map_or(value, |(_, words)| words);
        return format!("this is {is}, expected {}", wanted(expected));
    }
    if problem.starts_with("invalid value: integer") {
        return "the number is too large for a whole number".into();
    }
    if NO_NUMBER.iter().any(|theirs| problem.starts_with(theirs)) {
        return "this is no number: numbers are written like 0.3, 206e9 or -5".into();
    }
    match problem {
        "string values must be quoted" | "invalid boolean" => "this is neither a number nor text in quotes".into(),
        "wanted string or table" => "this isn't text in quotes".into(),
        "unexpected key or value" => "the line goes on after its end".into(),
        _ => message.trim_end_matches(", expected nothing").into(),
    }
}

/// What the parser calls a value, whose text the line shows, and what it is.
const KINDS: [(&str, &str); 6] = [
    ("string", "text"),
    ("integer", "a whole number"),
    ("floating point", "a number with a fraction"),
    ("boolean", "true or false"),
    ("sequence", "a list"),
    ("map", "a table"),
];

/// What the parser expects, and how a scene calls it.
const WANTED: [(&str, &str); 10] = [
    ("f64", "a number"),
    ("i64", "a whole number"),
    ("a string", "text in quotes"),
    ("a boolean", "true or false"),
    ("a sequence", "a list"),
    ("struct ", "a table"),
    ("a map", "a table"),
    ("a spanned value", "a table"),
    // the keys of a table
    ("one of ", "a table"),
    ("`", "a table"),
];

/// What the parser expects, in the words of a scene.
fn wanted(expected: &str) -> &str {
    WANTED.iter().find(|(theirs, _)| expected.starts_with(theirs)).map_or(expected, |(_, ours)| ours)
}

/// How the parser begins what it says about a wrong number.
const NO_NUMBER: [&str; 10] = [
    "invalid float",
    "invalid exponent",
    "invalid fraction",
    "invalid mantissa",
    "invalid hexadecimal number",
    "invalid octal number",
    "invalid binary number",
    "redundant numeric sign",
    "unexpected leading zero",
    "`_` may only go between digits",
];

/// The message about a missing key in the table that begins in `line`; without a line, in the file.
fn missing(field: &str, line: &str) -> String {
    match (field, line) {
        ("`name`", line) if !line.starts_with("[[") => {
            "missing `name`: begin the scene with name = \"my_contact\", which is the name of the FMU".into()
        }
        (field, line) => format!("missing {field} in `{}`", shortened(line)),
    }
}

/// The names between backquotes.
fn quoted(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// The message about an unknown key, given the known ones: "`laoding`, expected one of `loading`, `unloading`".
fn unknown_field(names: &str) -> String {
    let names = quoted(names);
    let (asked, known) = names.split_first().expect("the parser names the key");
    let plain = asked.to_lowercase();
    if let Some((_, why)) = UNSUPPORTED.iter().find(|(words, _)| words.contains(&plain.as_str())) {
        return format!("`{asked}` is not supported: {why}; see Limits in the guide. Expected {}", one_of(known));
    }
    let guess = nearest(asked, known.iter().copied());
    let elsewhere = ELSEWHERE.iter().find(|(names, _)| names.contains(&plain.as_str())).map(|(_, words)| *words);
    let elsewhere = elsewhere.map(|words| if words == HARDNESS { hardness() } else { words.into() });
    let more = match (guess, elsewhere) {
        (_, Some(elsewhere)) => format!("; {elsewhere}. Expected "),
        (Some(guess), None) => format!("; did you mean `{guess}`? Expected "),
        (None, None) => ", expected ".into(),
    };
    format!("unknown key `{}`{more}{}", shortened(asked), one_of(known))
}

/// The message about a number followed by a unit without quotes, as in `radius = 5mm`.
fn hint(line: &str, meant: &str) -> Option<String> {
    let (key, value) = line.split_once('=')?;
    let value = value.split('#').next().unwrap_or_default();
    let key = key.trim().rsplit('.').next()?.trim();
    // in an inline table, the part that is meant
    let (key, value) = match line.find('{') {
        Some(_) => {
            let before = &line[..line.find(meant)?];
            let key = before.trim_end().strip_suffix('=')?.trim_end();
            (key.rsplit([' ', '{', ',']).next()?, meant)
        }
        None => (key, value),
    };
    let hint = units::needs_quotes(value)?;
    Some(format!("{key} = {}: {hint}", shortened(value.trim())))
}

/// The message about a number with a decimal comma, as in `radius = 5,3` or `{ exponent = 0,2 }`.
fn decimal_comma(line: &str) -> Option<String> {
    let line = line.split('#').next()?;
    line.match_indices('=').find_map(|(place, _)| {
        let (before, after) = (line[..place].trim_end(), line[place + 1..].trim_start());
        // an `=` in a text in quotes follows no key
        if before.matches('"').count() % 2 == 1 {
            return None;
        }
        let key = before.rsplit([' ', '\t', '{', ',', '.']).next()?;
        let value = after.trim_start_matches('"').split(['"', '}']).next()?;
        // a second comma ends the number in a table
        let end = value.match_indices(',').nth(1).map_or(value.len(), |(end, _)| end);
        let value = value[..end].trim();
        let hint = units::decimal_comma(value)?;
        Some(format!("{key} = {}: {hint}", shortened(value)))
    })
}
