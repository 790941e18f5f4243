//! What the heading of a column says: its quantity and its unit, in the words of laboratories and of their instruments.

use super::dialect::Wrong;
use crate::layout::shortened;
use crate::nearest::{nearest, one_of};
use crate::reading::scale_in;
use crate::units;

/// What the numbers of a column may be.
pub struct ColumnKind {
    /// Its key, for programs.
    pub key: &'static str,
    /// SI unit; degrees for angles.
    pub unit: &'static str,
    /// Headings in lower case; messages use the first.
    pub names: &'static [&'static str],
    /// Whether a name may be a part of the heading: `Nominal strain (extensometer)`.
    by_word: bool,
    /// Numbers without a unit are in the SI unit, unless one of them is larger than this.
    pub largest: f64,
}

const fn kind(key: &'static str, unit: &'static str, largest: f64, names: &'static [&'static str]) -> ColumnKind {
    ColumnKind { key, unit, names, by_word: false, largest }
}

const ANY: f64 = f64::INFINITY;

#[rustfmt::skip]
pub const KINDS: [ColumnKind; 27] = [
    kind("speed", "m/s", 3000.0, &["speed", "velocity", "v", "impact speed", "impact velocity", "closing speed",
        "incident speed", "incident velocity", "incoming speed", "approach speed", "speed before", "geschwindigkeit",
        "aufprallgeschwindigkeit"]),
    kind("drop_height", "m", 100.0, &["drop height", "height", "fall height", "fallh\u{f6}he"]),
    kind("mass", "kg", 1e5, &["mass", "effective mass", "masse"]),
    kind("restitution", "", 1.0, &["restitution", "e", "cor", "coefficient of restitution", "restitution coefficient",
        "sto\u{df}zahl"]),
    kind("rebound_speed", "m/s", 3000.0, &["rebound speed", "rebound velocity", "return speed", "return velocity",
        "outgoing speed", "speed after", "velocity after"]),
    kind("rebound_height", "m", 100.0, &["rebound height", "return height", "bounce height",
        "r\u{fc}ckprallh\u{f6}he", "r\u{fc}cksprungh\u{f6}he"]),
    kind("bounce_interval", "s", 60.0, &["bounce interval", "interval", "flight time", "time of flight",
        "time between bounces", "time between impacts", "flugzeit"]),
    kind("bounce_time", "s", ANY, &["bounce time", "time of bounce", "impact time", "time of impact", "hit time",
        "aufprallzeit"]),
    kind("dent_depth", "m", 0.05, &["dent depth", "dent", "residual depth", "residual indentation", "crater depth"]),
    kind("dent_diameter", "m", 0.2, &["dent diameter", "crater diameter", "indentation diameter",
        "imprint diameter"]),
    kind("contact_time", "s", 0.1, &["contact time", "contact duration", "impact duration", "kontaktzeit"]),
    kind("largest_force", "N", ANY, &["largest force", "max force", "maximum force", "peak force", "fmax"]),
    kind("angle", "deg", 90.0, &["angle", "impact angle", "angle of incidence", "incidence angle"]),
    kind("tangential_restitution", "", ANY, &["tangential restitution", "e_t", "et"]),
    kind("rebound_angle", "deg", 90.0, &["rebound angle"]),
    kind("depth", "m", 0.01, &["depth", "indentation", "displacement", "penetration", "penetration depth",
        "indentation depth", "displacement into surface", "penetration into surface", "extension", "travel",
        "standard travel", "stroke", "crosshead travel", "compressive extension", "tensile extension",
        "axial displacement", "change of length", "pd", "weg", "standardweg", "traversenweg", "eindringtiefe",
        "verl\u{e4}ngerung"]),
    kind("force", "N", ANY, &["force", "load", "load on sample", "standard force", "axial force", "normal force",
        "compressive load", "tensile load", "fn", "kraft", "pr\u{fc}fkraft", "standardkraft"]),
    kind("contact_radius", "m", 0.1, &["contact radius", "radius of contact", "radius of the contact", "kontaktradius"]),
    kind("hardness", "", ANY, &["hardness", "h\u{e4}rte", "brinell hardness", "vickers hardness", "rockwell hardness",
        "leeb hardness", "hardness number"]),
    ColumnKind { by_word: true, ..kind("strain", "", ANY, &["strain", "dehnung", "elongation", "epsilon", "eps",
        "\u{3b5}"]) },
    ColumnKind { by_word: true, ..kind("stress", "Pa", ANY, &["stress", "spannung", "sigma", "\u{3c3}"]) },
    // of the specimen of a tensile test, above the heading
    kind("section", "m^2", ANY, &["section", "cross section", "cross sectional area", "area", "initial area",
        "specimen area", "querschnitt", "probenquerschnitt", "anfangsquerschnitt", "s0", "a0"]),
    kind("gauge_length", "m", ANY, &["gauge length", "gage length", "gauge length standard travel",
        "gage length standard travel", "initial gauge length", "initial gage length", "initial length",
        "messl\u{e4}nge", "anfangsmessl\u{e4}nge", "grip to grip separation", "l0"]),
    kind("thickness", "m", ANY, &["thickness", "specimen thickness", "probendicke", "dicke"]),
    kind("width", "m", ANY, &["width", "specimen width", "probenbreite", "breite"]),
    kind("diameter", "m", ANY, &["diameter", "specimen diameter", "probendurchmesser", "durchmesser", "d0"]),
    kind("time", "s", ANY, &["time", "zeit"]),
];

/// Other signs of units, and how many of which they are.
const ALIASES: [(&str, f64, &str); 9] = [
    ("micron", 1.0, "um"),
    ("microns", 1.0, "um"),
    ("inch", 1.0, "in"),
    ("inches", 1.0, "in"),
    ("degree", 1.0, "deg"),
    ("degrees", 1.0, "deg"),
    ("sec", 1.0, "s"),
    ("daN", 10.0, "N"),
    ("gf", 1e-3, "kgf"),
];

/// Units of a force that are masses.
const MASSES: [(&str, &str); 4] = [
    ("kg", "a force in kg is one in kgf: write kgf, or N"),
    ("g", "a force in g is one in gf: write gf, or mN"),
    ("t", "a force in t: write kN"),
    ("lb", "a force in lb is one in lbf: write lbf, or N"),
];

/// What a heading says.
pub struct Heading {
    pub kind: &'static ColumnKind,
    /// The unit as it is written, or the scale of a hardness.
    pub unit: Option<String>,
    /// The unit in the SI unit.
    pub size: f64,
}

/// A name as it is compared.
fn key(name: &str) -> String {
    let text = name.to_lowercase().replace(['_', '-', ','], " ");
    let text = text.trim_matches([' ', ':', '=']).split_whitespace().collect::<Vec<_>>().join(" ");
    if text == "e t" { "e_t".into() } else { text }
}

fn exactly(name: &str) -> Option<&'static ColumnKind> {
    let key = key(name);
    KINDS.iter().find(|kind| kind.names.contains(&key.as_str()))
}

fn by_word(name: &str) -> Option<&'static ColumnKind> {
    const LONG: usize = 6;
    let key = key(name);
    let has =
        |name: &&str| if name.len() < LONG { key.split(' ').any(|word| word == *name) } else { key.contains(name) };
    KINDS.iter().find(|kind| kind.by_word && kind.names.iter().any(has))
}

/// Name and unit of a heading: `depth [um]`, `depth (um)`, `depth / um`, `depth, um`, `depth_um`, `speed_m_per_s`.
fn parted(heading: &str) -> (String, Option<String>) {
    let text = heading.split_whitespace().collect::<Vec<_>>().join(" ");
    if let Some(last) = text.rfind(['[', '(']) {
        let inside = text[last + 1..].split([']', ')']).next().unwrap_or_default();
        let first = text.find(['[', '(']).unwrap_or(last);
        return (text[..first].trim_matches([' ', ',', ':']).into(), Some(inside.trim().into()));
    }
    if exactly(&text).is_some() || scale_in(&text).is_some() {
        return (text, None);
    }
    for mark in [" / ", ",", " in ", "/", " ", "_"] {
        // the longest name that is known
        for (place, _) in text.rmatch_indices(mark) {
            let (name, unit) = (&text[..place], text[place + mark.len()..].trim());
            if (exactly(name).is_some() || by_word(name).is_some()) && is_unit(unit) {
                return (name.trim().into(), Some(unit.into()));
            }
        }
    }
    (text, None)
}

/// What a `heading` says, with the unit in the line `below`, if that has units; `None` for one that names no quantity.
///
/// # Errors
/// A unit that the quantity has not.
pub fn heading(heading: &str, below: Option<&str>) -> Result<Option<Heading>, String> {
    let (name, unit) = parted(heading);
    let opening = heading.rfind(['[', '(']).map(|at| &heading[at..]);
    let unit = unit.filter(|unit| !unit.is_empty()).or(below.filter(|below| !below.is_empty()).map(String::from));
    let hardness =
        |unit| Ok(KINDS.iter().find(|kind| kind.key == "hardness").map(|kind| Heading { kind, unit, size: 1.0 }));
    // an index in brackets is no unit
    if let Some(scale) = scale_in(&name) {
        return hardness(Some(scale));
    }
    let Some(kind) = exactly(&name).or_else(|| by_word(&name)) else { return Ok(None) };
    if opening.is_some_and(|opening| !opening.contains([']', ')'])) {
        return Err(format!("`{}` has no closing bracket", shortened(heading.trim())));
    }
    if kind.key == "hardness" {
        let scale = unit.as_deref().map(|unit| {
            scale_in(unit).ok_or_else(|| {
                format!("`{}` is no scale of hardness; expected HV10, HBW 10/3000, HRC", shortened(unit))
            })
        });
        return hardness(scale.transpose()?);
    }
    match unit.as_deref().map_or(Ok(1.0), |unit| size_of(unit, kind.unit, &name)) {
        Ok(size) => Ok(Some(Heading { kind, unit, size })),
        // a strain rate is no strain
        Err(_) if exactly(&name).is_none() => Ok(None),
        Err(why) => Err(why),
    }
}

/// Whether a heading names a quantity, with whatever unit.
pub fn is_known(text: &str) -> bool {
    heading(text, None).is_ok_and(|found| found.is_some()) || exactly(&parted(text).0).is_some()
}

/// A unit as [`units`] writes it.
fn written(unit: &str) -> String {
    unit.trim().trim_matches(['[', ']', '(', ')']).replace("_per_", "/").replace('_', "/").replace(" / ", "/")
}

/// The size of `unit` in the SI unit `si`, for the quantity `name`.
fn size_of(unit: &str, si: &str, name: &str) -> Result<f64, String> {
    let plain = written(unit);
    if si.is_empty() {
        return match plain.to_lowercase().as_str() {
            "%" | "percent" | "pct" | "prozent" => Ok(0.01),
            "-" | "1" | "" | "mm/mm" | "m/m" | "in/in" => Ok(1.0),
            _ => Err(format!("{name} has no unit, not `{}`", shortened(unit))),
        };
    }
    let alias = ALIASES.iter().find(|(alias, ..)| *alias == plain);
    let (count, own) = alias.map_or((1.0, plain.as_str()), |(_, count, own)| (*count, own));
    if let Some(size) = units::size(own, si) {
        return Ok(count * size);
    }
    if let Some((_, why)) = MASSES.iter().find(|(mass, _)| si == "N" && *mass == plain) {
        return Err(format!("`{unit}` is ambiguous for {name}: {why}"));
    }
    let usual = usual_of(si);
    let alike: Vec<&str> = usual.iter().copied().filter(|other| other.to_lowercase() == plain.to_lowercase()).collect();
    match alike[..] {
        [one] => units::size(one, si).ok_or_else(|| format!("`{unit}` is no unit of {name}")),
        [] => Err(format!("`{}` is no unit of {name}; expected {}", shortened(unit), one_of(&usual))),
        _ => Err(format!("`{unit}` is ambiguous for {name}: it may be {}", one_of(&alike))),
    }
}

/// Whether a cell is a unit and nothing else.
pub fn is_unit(cell: &str) -> bool {
    let plain = written(cell);
    // a number is none
    plain != "1" && !plain.is_empty() && (units::is_unit(&plain) || size_of(&plain, "", "").is_ok() || is_alias(&plain))
}

fn is_alias(plain: &str) -> bool {
    ALIASES.iter().any(|(alias, ..)| *alias == plain)
}

/// The usual units of a quantity, for messages.
pub fn usual(kind: &ColumnKind) -> Vec<&'static str> {
    usual_of(kind.unit)
}

/// The usual units of the quantities with this SI unit.
fn usual_of(si: &str) -> Vec<&'static str> {
    let units = units::usual().filter(|(unit, _)| *unit == si).flat_map(|(_, usual)| usual);
    units.map(|(unit, _)| unit).collect()
}

/// The name that is most like that of an unknown `heading`, if any is.
pub fn nearest_name(heading: &str) -> Option<&'static str> {
    let (name, _) = parted(heading);
    let name = key(&name);
    // those of a specimen stand above the heading
    let columns = || KINDS.iter().take_while(|kind| kind.key != "section");
    let names = || columns().flat_map(|kind| kind.names).filter(|name| name.len() > 2).copied();
    let within = || {
        let padded = format!(" {name} ");
        names()
            .filter(|known| known.len() > 3 && padded.contains(&format!(" {known} ")))
            .max_by_key(|known| known.len())
    };
    within().or_else(|| nearest(&name, names()))
}

/// An unknown heading, with the nearest name.
pub fn asked(heading: &str) -> String {
    let name = nearest_name(heading).map_or(String::new(), |name| format!(" ({name}?)"));
    format!("`{}`{name}", shortened(heading))
}

/// That none of these headings names a quantity: each with the nearest name. The rows may name a `scale` of hardness.
pub fn none_known(headings: &[String], scale: Option<String>, examples: &str) -> Wrong {
    const TOLD: usize = 8;
    let first = headings.iter().position(|heading| !heading.is_empty()).unwrap_or(0);
    let named: Vec<String> =
        headings.iter().filter(|heading| !heading.is_empty()).take(TOLD).map(|heading| asked(heading)).collect();
    let all: Vec<&str> = KINDS.iter().map(|kind| kind.names[0]).collect();
    let scale = scale.map_or(String::new(), |scale| format!("; a column of readings is called `{scale}`"));
    let why = format!(
        "no quantity is called {}{scale}; expected {}; for example {examples}",
        named.join(" or "),
        one_of(&all)
    );
    Wrong { line: None, column: Some(first + 1), why }
}
