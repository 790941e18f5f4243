//! Compatible loading and unloading laws and constants, according to the table of laws.

use crate::numbers::in_message;
use crate::parameters::value_of;
use crate::table;
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;

/// The loading law of a scene that names none. A contact in which nothing yields is elastic: "hertz".
pub const DEFAULT_LOADING: &str = "brinell";

/// The law of line contacts.
pub const LINE: &str = "line";

/// The law of a curve of one's own, and its key that may be the name of a file.
pub const TABLE: &str = "table";

/// The unloading law for a loading law that is named alone: the one with which it was published, otherwise "contact-radius".
pub fn default_unloading(loading: &str) -> &'static str {
    table::loading_law(loading).unloading.as_deref().unwrap_or("contact-radius")
}

/// The existing loading law `name` with its reference constants.
pub fn published(name: &str) -> AnyLoading {
    let found = AnyLoading::ALL.into_iter().find(|(known, _)| *known == name);
    found.expect("a law that was found by its name").1
}

/// The unloading law for a loading law that is named alone, as for a scene that names no unloading law.
pub fn unloading_of(loading: &str) -> (&'static str, AnyUnloading) {
    let own = default_unloading(loading);
    AnyUnloading::ALL.into_iter().find(|(name, _)| *name == own).expect("the table names laws that exist")
}

/// Rejects two incompatible laws.
///
/// # Errors
/// A sentence with the reason and the compatible laws.
pub fn check(loading: &str, unloading: &str) -> Result<(), String> {
    let (one, other) = (table::loading_law(loading), table::unloading_law(unloading));
    let pair = format!("law.loading = \"{loading}\" doesn't go with law.unloading = \"{unloading}\"");
    if let (Some(own), Some(why)) = (&one.unloading, &one.no_other_unloading)
        && own != unloading
    {
        return Err(format!("{pair}: {why}, and unloads by \"{own}\""));
    }
    if one.above_hertz && other.lowers_hertz {
        return Err(format!("{pair}: its curve is above Hertz's in places, which can't be lowered to it"));
    }
    match &other.made_for {
        Some(made) if made.loading != loading => {
            Err(format!("{pair}: that {} the loading law \"{}\"", made.because, made.loading))
        }
        _ => Ok(()),
    }
}

/// Rejects two laws `(name, law)` whose constants contradict each other.
///
/// # Errors
/// A sentence with the constants that must be equal or as published.
pub fn check_ties(
    (loading_name, loading): (&str, AnyLoading),
    (unloading_name, unloading): (&str, AnyUnloading),
) -> Result<(), String> {
    let made_for = table::unloading_law(unloading_name).made_for.as_ref();
    let Some(made) = made_for.filter(|made| made.loading == loading_name) else { return Ok(()) };
    for name in &made.same {
        let (one, other) = (value_of(&loading, name), value_of(&unloading, name));
        if one != other {
            return Err(format!(
                "`{name}` must be the same in law.loading_parameters ({}) and law.unloading_parameters ({})",
                in_message(one.unwrap_or(f64::NAN)),
                in_message(other.unwrap_or(f64::NAN))
            ));
        }
    }
    for name in &made.as_published {
        let (one, published) = (value_of(&loading, name), value_of(&published(loading_name), name));
        if one != published {
            return Err(format!(
                "law.unloading = \"{unloading_name}\" takes its units from \"{loading_name}\" as published: with it \
                 `{name}` must be {}; law.unloading = \"contact-radius\" takes any",
                in_message(published.unwrap_or(f64::NAN))
            ));
        }
    }
    Ok(())
}
