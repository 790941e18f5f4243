//! The tables `[[contact]]` of a scene.

use super::error::Mistake;
use super::file::{Contact, File, SurfaceName};
use super::hardening;
use super::names::check_identifier;
use super::numbers::{Numbers, check_numbers};
use crate::table::VARIABLES;
use brinell_contact::Surface;
use std::collections::HashSet;
use std::ops::Range;
use toml::Spanned;

/// Largest number of contacts of an FMU. The model description then has a few hundred megabytes.
const MOST_CONTACTS: i64 = 100_000;

/// One `[[contact]]`, or the one contact of a scene without any.
pub struct Given {
    pub name: Option<String>,
    pub count: Option<usize>,
    pub surface: Surface,
    pub own: Numbers,
    /// The properties with separate values for each contact of the group.
    pub per_contact: Vec<Spanned<String>>,
    /// The place for an error message, if no more precise place is known.
    pub span: Range<usize>,
}

/// The values of each contact; contacts without their own surface have `surface`.
pub fn given(file: &File, surface: Option<SurfaceName>, shared: &Numbers) -> Result<Vec<Given>, Mistake> {
    let surface_of = |own: Option<SurfaceName>| own.or(surface).map_or(Surface::Dented, Surface::from);
    let Some(contacts) = &file.contact else {
        let (own, surface) = (Numbers::none(), surface_of(None));
        return Ok(vec![Given { name: None, count: None, surface, own, per_contact: Vec::new(), span: 0..0 }]);
    };
    if contacts.get_ref().is_empty() {
        let message = "the list of contacts is empty; leave it out for one contact with plain variable names";
        return Err(Mistake(contacts.span(), message.into()));
    }
    let (mut names, mut total) = (HashSet::new(), 0);
    let mut all = Vec::new();
    for contact in contacts.get_ref() {
        let span = contact.span();
        let Contact { name, count, impactor, target, initial_gap, effective_mass, friction, parameters_per_contact } =
            contact.get_ref();
        let text = check_contact_name(name)?;
        if !names.insert(text.clone()) {
            return Err(Mistake(name.span(), format!("name = {text:?} is taken by another contact")));
        }
        let count = count.as_ref().map(check_count).transpose()?;
        total += count.unwrap_or(1);
        if total > MOST_CONTACTS {
            let message =
                format!("with contact `{text}` there are {total} contacts in all: allowed are {MOST_CONTACTS}");
            return Err(Mistake(span, message));
        }
        hardening::check_contact(&text, impactor, target)?;
        let (mass, gap, coefficient) = (effective_mass.as_ref(), initial_gap.as_ref(), friction.coefficient.as_ref());
        let own = Numbers::of(impactor, target, mass, gap, coefficient, Some(shared))?;
        check_numbers(&own, &format!("{text}."))?;
        let surface = surface_of(target.surface);
        let (count, per_contact) = (count.map(|count| count as usize), parameters_per_contact.clone());
        all.push(Given { name: Some(text), count, surface, own, per_contact, span });
    }
    Ok(all)
}

/// The name of a contact, which must not be the beginning of the name of another variable.
fn check_contact_name(name: &Spanned<String>) -> Result<String, Mistake> {
    let text = check_identifier(name)?;
    let mut taken: Vec<_> = VARIABLES.iter().filter_map(|variable| variable.name.split('.').next()).collect();
    taken.dedup();
    if taken.contains(&text.as_str()) {
        let message = format!("name = {text:?} belongs to a variable of the FMU, as do `{}`", taken.join("`, `"));
        return Err(Mistake(name.span(), message));
    }
    Ok(text)
}

fn check_count(count: &Spanned<i64>) -> Result<i64, Mistake> {
    let number = *count.get_ref();
    if (1..=MOST_CONTACTS).contains(&number) {
        return Ok(number);
    }
    let message = format!("count = {number} is out of range: allowed is 1 to {MOST_CONTACTS}");
    Err(Mistake(count.span(), message))
}
