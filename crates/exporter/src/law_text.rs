//! The texts about a law from the table. `{name}` in them is replaced by a number of the law.

use crate::numbers::significant;
use crate::pairing;
use crate::parameters::numbers_of;
use crate::table::{self, Law};
use brinell_contact::Loading;
use brinell_contact::damped::AnyDamped;
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use serde::Serialize;

/// The texts of a law with numbers filled in.
pub struct LawText {
    pub law: &'static Law,
    /// With the constants of the law.
    pub formulas: Vec<String>,
    /// For the law with its reference constants.
    pub notes: String,
    /// For the law with its reference constants.
    pub validity: String,
    /// Whether the law has its reference constants.
    pub is_published: bool,
}

/// The texts about the loading law `name` with the constants of `law`.
pub fn loading(name: &str, law: &AnyLoading) -> LawText {
    let published = pairing::published(name);
    text(table::loading_law(name), law, &published, |law, name| law.derived(name))
}

/// The texts about the unloading law `name` with the constants of `law`.
pub fn unloading(name: &str, law: &AnyUnloading) -> LawText {
    let published = AnyUnloading::ALL.into_iter().find(|(known, _)| *known == name);
    text(table::unloading_law(name), law, &published.expect("a law of the table").1, |_, _| None)
}

/// The texts about the rate-dependent law `name` with the constants of `law`.
pub fn damped(name: &str, law: &AnyDamped) -> LawText {
    let published = AnyDamped::ALL.into_iter().find(|(known, _)| *known == name);
    text(table::damped_law(name), law, &published.expect("a law of the table").1, |_, _| None)
}

/// The texts of a law from its entry in the table; `derived` finds numbers that are not constants.
fn text<L: Serialize + PartialEq>(
    told: &'static Law,
    law: &L,
    published: &L,
    derived: impl Fn(&L, &str) -> Option<f64>,
) -> LawText {
    let fill = |text: &str, law: &L| {
        filled(text, |name| {
            let numbers = numbers_of(law, name).or_else(|| Some(vec![derived(law, name)?]));
            numbers.unwrap_or_else(|| panic!("laws.toml: the law {} has no number {name}", told.name))
        })
    };
    LawText {
        law: told,
        formulas: told.formulas.iter().map(|formula| fill(formula, law)).collect(),
        notes: fill(&told.notes, published),
        validity: fill(&told.validity, published),
        is_published: law == published,
    }
}

/// `text` with numbers of five digits in place of the names in braces. A list of numbers is separated by commas.
fn filled(text: &str, numbers: impl Fn(&str) -> Vec<f64>) -> String {
    let mut parts = text.split('{');
    let mut result = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let (name, rest) = part.split_once('}').expect("laws.toml closes its braces");
        let numbers: Vec<_> = numbers(name).into_iter().map(|number| significant(number, 5)).collect();
        result += &numbers.join(", ");
        result += rest;
    }
    result
}
