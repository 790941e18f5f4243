//! Suggestions for mistyped names.

/// Similarity (Jaro-Winkler) from which two names are considered the same.
const SIMILAR: f64 = 0.8;

/// The one of `names` that is nearest to `asked`, if any is near.
pub fn nearest<'a>(asked: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let asked = normal(asked);
    if asked.is_empty() {
        return None;
    }
    let rated = names.into_iter().map(|name| (similarity(&asked, &normal(name)), name));
    let best = rated.max_by(|one, other| one.0.total_cmp(&other.0))?;
    (best.0 >= SIMILAR).then_some(best.1)
}

/// In lower case, and with spaces in place of hyphens and other joints.
fn normal(name: &str) -> String {
    name.trim().to_lowercase().replace(['-', '_'], " ")
}

fn similarity(asked: &str, name: &str) -> f64 {
    // a complete part of a name, such as the last word of target.yield_strength
    let is_part = asked.len() >= 4 && name.contains(asked);
    strsim::jaro_winkler(asked, name).max(if is_part { SIMILAR } else { 0.0 })
}

/// The message about a name that does not exist, such as: unknown material `Mild Steel`; did you mean `mild steel`? Expected
/// one of ...
pub fn unknown<'a>(what: &str, asked: &str, names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    let guess = nearest(asked, names.iter().copied());
    let (joint, expected) = match guess {
        Some(name) => (format!("; did you mean `{name}`? "), "Expected"),
        None => (", ".into(), "expected"),
    };
    format!("unknown {what} `{asked}`{joint}{expected} {}", one_of(&names))
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
    use brinell::contact::loading::AnyLoading;

    #[test]
    fn a_mistyped_name_finds_the_one_that_is_meant() {
        let materials = || MATERIALS.iter().map(|material| material.name.as_str());
        for (asked, meant) in [
            ("Mild Steel", Some("mild steel")),
            ("aluminum 6061", Some("aluminium 6061-T6")),
            ("AISI 1018", Some("steel AISI 1018")),
            ("Ti-6Al-4V", Some("titanium Ti-6Al-4V")),
            ("mild_steel", Some("mild steel")),
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
    fn every_name_is_nearest_to_itself() {
        for (name, _) in AnyLoading::ALL {
            assert_eq!(nearest(name, AnyLoading::ALL.iter().map(|(name, _)| *name)), Some(name));
        }
    }
}
