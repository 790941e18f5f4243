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
fn normal(name: &str) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::MATERIALS;
    use brinell_contact::loading::AnyLoading;

    #[test]
    fn a_mistyped_name_finds_the_one_that_is_meant() {
        let materials = || MATERIALS.iter().map(|material| material.name.as_str());
        for (asked, meant) in [
            ("Mild Steel", Some("mild steel")),
            ("aluminum 6061", Some("aluminium 6061-T6")),
            ("AISI 1018", Some("steel AISI 1018")),
            ("Ti-6Al-4V", Some("titanium Ti-6Al-4V")),
            ("mild_steel", Some("mild steel")),
            ("stainless steel 316", Some("stainless steel 316L, annealed")),
            ("stainless steel 321", None),
            ("steel 1.2379", None),
            ("cheese", None),
            ("", None),
        ] {
            assert_eq!(nearest(asked, materials()), meant, "{asked}");
        }
        let laws = || AnyLoading::ALL.iter().map(|(name, _)| *name);
        for (asked, meant) in
            [("brinel", "brinell"), ("Big-Alabo", "big-alabo"), ("jackson_green", "jackson-green"), ("herz", "hertz")]
        {
            assert_eq!(nearest(asked, laws()), Some(meant));
        }
        assert_eq!(nearest("rubber", laws()), None);
    }

    #[test]
    fn of_many_names_the_nearest_are_listed() {
        let names: Vec<String> = (1..=2000).map(|index| format!("bead_{index}.initial_gap")).collect();
        let said = unknown("parameter", "bead_777.intial_gap", names.iter().map(String::as_str));
        assert!(
            said.contains("did you mean `bead_777.initial_gap`?") && said.contains("(the nearest of 2000)"),
            "{said}"
        );
        assert!(said.len() < 500, "{} bytes: {said}", said.len());
        let said = unknown("parameter", &"x".repeat(100_000), names.iter().map(String::as_str));
        assert!(said.len() < 500, "{} bytes: {said}", said.len());
    }

    #[test]
    fn a_name_that_is_there_twice_is_listed_once() {
        assert_eq!(unknown("law", "foo", ["a", "b", "a"].into_iter()), "unknown law `foo`, expected `a` or `b`");
    }

    /// A wrong letter, one too many or too few, or two swapped: the suggestion is no farther away than the name that was meant.
    #[test]
    fn any_single_mistyped_letter_finds_a_name_that_is_as_near_as_what_was_meant() {
        let keys =
            ["impactor", "impact", "target", "law", "fmu", "friction", "coupling", "body", "contact", "material"];
        let keys =
            keys.into_iter().chain(["youngs_modulus", "yield_strength", "drop_height", "plate_thickness", "mass"]);
        // a wrong digit isn't taken for a mistyped letter
        let laws =
            AnyLoading::ALL.iter().map(|(name, _)| *name).filter(|name| !name.contains(|c: char| c.is_ascii_digit()));
        let keys: Vec<&str> = keys.chain(laws).collect();
        let mut tried = 0;
        for meant in &keys {
            let letters: Vec<char> = meant.chars().collect();
            // the first letter is seldom wrong, and short words have many neighbours
            for place in 1..letters.len() {
                let (before, after) = (&letters[..place], &letters[place + 1..]);
                let spelt =
                    |middle: &[char], after: &[char]| [before, middle, after].concat().iter().collect::<String>();
                let mut wrong = vec![spelt(&[], after), spelt(&['e'], after), spelt(&[letters[place]; 2], after)];
                wrong.extend(after.split_first().map(|(next, after)| spelt(&[*next, letters[place]], after)));
                for asked in wrong.into_iter().filter(|asked| asked != meant && asked.len() > 3) {
                    let found = nearest(&asked, keys.iter().copied()).unwrap_or_else(|| panic!("nothing near {asked}"));
                    let distance = strsim::osa_distance(&normal(&asked), &normal(found));
                    assert!(distance <= 1, "{asked}: {found} for {meant}");
                    tried += 1;
                }
            }
        }
        assert!(tried > 500, "{tried}");
        assert_eq!(nearest("impacter", keys.iter().copied()), Some("impactor"));
        assert_eq!(nearest("impac", keys.iter().copied()), Some("impact"));
    }

    #[test]
    fn of_equally_near_names_the_first_is_suggested() {
        assert_eq!(
            nearest("bearing steel", ["bearing steel, aaaa", "bearing steel, bbbb"]),
            Some("bearing steel, aaaa")
        );
    }

    #[test]
    fn every_name_is_nearest_to_itself() {
        for (name, _) in AnyLoading::ALL {
            assert_eq!(nearest(name, AnyLoading::ALL.iter().map(|(name, _)| *name)), Some(name));
        }
    }
}
