//! Suggestions for mistyped names.

use crate::layout::shortened;
use std::collections::HashSet;

/// Similarity (Jaro-Winkler) from which two names are considered the same.
const SIMILAR: f64 = 0.8;

/// The one of `names` that is nearest to `asked`, if any is near.
pub fn nearest<'a>(asked: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let asked = normal(asked);
    if asked.is_empty() {
        return None;
    }
    // a number of three digits is no mistyped letter: steel 316 isn't 304
    let numbers = asked.split(|c: char| !c.is_ascii_digit()).filter(|number| number.len() >= 3).collect::<Vec<_>>();
    let names = names.into_iter().filter(|name| numbers.iter().all(|number| name.contains(number)));
    let mut best: Option<(Rating, &str)> = None;
    for name in names {
        let rating = Rating::of(&asked, &normal(name));
        // of equally near ones the first
        if rating.similarity >= SIMILAR && best.as_ref().is_none_or(|(other, _)| rating.is_nearer(other)) {
            best = Some((rating, name));
        }
    }
    best.map(|(_, name)| name)
}

/// Mistyped letters up to which their number tells names apart: `impacter` is one from `impactor`, and two from `impact`, whose letters all
/// are in it.
const MISTYPED: usize = 2;

/// How near a name is to another.
struct Rating {
    /// Letters that were left out, added, changed or swapped; [`usize::MAX`] if more than [`MISTYPED`].
    letters: usize,
    similarity: f64,
}

impl Rating {
    fn of(asked: &str, name: &str) -> Rating {
        let letters = if asked.len().abs_diff(name.len()) > 4 * MISTYPED {
            usize::MAX
        } else {
            strsim::osa_distance(asked, name)
        };
        // of a short name, two letters may be all
        let is_mistyped = letters <= MISTYPED && 2 * letters < asked.chars().count();
        Rating { letters: if is_mistyped { letters } else { usize::MAX }, similarity: similarity(asked, name) }
    }

    fn is_nearer(&self, other: &Rating) -> bool {
        self.letters < other.letters || self.letters == other.letters && self.similarity > other.similarity
    }
}

/// Characters of a name that are compared. Every name that exists is shorter, and the time to compare two names grows with the
/// product of their lengths.
const COMPARED: usize = 200;

/// In lower case, and with spaces in place of hyphens and other joints.
pub fn normal(name: &str) -> String {
    let compared = name.trim().chars().take(COMPARED).collect::<String>();
    compared.to_lowercase().replace(['-', '_'], " ")
}

fn similarity(asked: &str, name: &str) -> f64 {
    // a complete part of a name, such as the last word of target.yield_strength
    let is_part = asked.len() >= 4 && name.contains(asked);
    strsim::jaro_winkler(asked, name).max(if is_part { SIMILAR } else { 0.0 })
}

/// Most names that a message lists. An FMU may have many thousands.
const LISTED: usize = 60;
/// How many of more names than that it lists.
const NEAREST: usize = 8;

/// The names to choose from, in words; of many, those that are nearest to `asked`.
pub fn choice(asked: &str, names: &[&str]) -> String {
    if names.len() <= LISTED {
        return one_of(names);
    }
    let nearest = nearest_first(asked, names);
    format!("{} (the nearest of {})", one_of(&nearest[..NEAREST]), names.len())
}

/// The names, those first that are most like `asked`.
pub fn nearest_first<'a>(asked: &str, names: &[&'a str]) -> Vec<&'a str> {
    let asked = normal(asked);
    let mut rated: Vec<(f64, &'a str)> = names.iter().map(|name| (similarity(&asked, &normal(name)), *name)).collect();
    // equally near ones stay in their order
    rated.sort_by(|one, other| other.0.total_cmp(&one.0));
    rated.into_iter().map(|(_, name)| name).collect()
}

/// The message about a name that does not exist, such as: unknown material `Mild Steel`; did you mean `mild steel`? Expected
/// one of ...
pub fn unknown<'a>(what: &str, asked: &str, names: impl Iterator<Item = &'a str>) -> String {
    let mut names: Vec<&str> = names.collect();
    // loading and unloading laws may share a name
    let mut known = HashSet::new();
    names.retain(|name| known.insert(*name));
    let guess = nearest(asked, names.iter().copied());
    let (joint, expected) = match guess {
        Some(name) => (format!("; did you mean `{name}`? "), "Expected"),
        None => (", ".into(), "expected"),
    };
    format!("unknown {what} `{}`{joint}{expected} {}", shortened(asked), choice(asked, &names))
}

/// The names as a choice.
pub fn one_of(names: &[&str]) -> String {
    match names {
        [] => "none".into(),
        [name] => format!("`{name}`"),
        [one, other] => format!("`{one}` or `{other}`"),
        names => format!("one of `{}`", names.join("`, `")),
    }
}

/// The pattern of these `names` in letters of any case.
pub fn any_case(names: &[&str]) -> String {
    let of_letter = |c: char| format!("[{}{}]", c.to_ascii_uppercase(), c.to_ascii_lowercase());
    let of_name = |name: &&str| name.chars().map(of_letter).collect::<String>();
    names.iter().map(of_name).collect::<Vec<_>>().join("|")
}
