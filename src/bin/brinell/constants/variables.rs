//! What value references mean, as functions.

use super::add;
use crate::interface::Entry;
use crate::table::{Causality, Type, Variable};

/// The kinds of variables that a contact has, those of type `kind` as arms of a match.
fn arms(entries: &[Entry], kind: Type) -> (usize, String) {
    let mut kinds: Vec<&Variable> = entries.iter().map(|entry| entry.variable).collect();
    kinds.retain(|variable| variable.causality != Causality::Parameter);
    kinds.dedup_by_key(|variable| variable.name.as_str());
    let arm = |(place, variable): (usize, &&Variable)| {
        (variable.r#type == kind).then(|| format!("        {place} => {kind:?}::{},\n", variable.rust))
    };
    (kinds.len(), kinds.iter().enumerate().filter_map(arm).collect())
}

pub fn add_reals(text: &mut String, entries: &[Entry]) {
    let (kinds, arms) = arms(entries, Type::Real);
    let settable = entries.iter().any(|entry| entry.variable.causality == Causality::Parameter);
    if settable {
        let count =
            format!("/// How many variables a contact has, beside the parameters.\nconst KINDS: u32 = {kinds};\n");
        add(text, &count);
    }
    let parameter = "        KINDS.. => {
            let index = (kind - KINDS) as usize * CONTACTS + contact;
            return (index < SETTABLE.len()).then_some((Real::Parameter(index), 0));
        }
";
    let parameter = if settable { parameter } else { "" };
    // if all kinds are Real and whatever comes behind them is a parameter nothing is left
    let nothing = if settable && arms.lines().count() == kinds { "" } else { "        _ => return None,\n" };
    add(
        text,
        &format!(
            "/// The Real variable with this value reference, and its contact.\n#[inline]\n\
             pub fn real(value_reference: u32) -> Option<(Real, usize)> {{\n    \
             let (kind, contact) = kind_and_contact(value_reference, CONTACTS);\n    \
             let variable = match kind {{\n{arms}{parameter}{nothing}    }};\n    \
             Some((variable, contact))\n}}\n"
        ),
    );
}

pub fn add_integers(text: &mut String, entries: &[Entry]) {
    let (_, arms) = arms(entries, Type::Integer);
    let body = if arms.is_empty() {
        "    let _ = value_reference;\n    None\n".to_string()
    } else {
        format!(
            "    let (kind, contact) = kind_and_contact(value_reference, CONTACTS);\n    \
             let variable = match kind {{\n{arms}        _ => return None,\n    }};\n    Some((variable, contact))\n"
        )
    };
    add(
        text,
        &format!(
            "/// The Integer variable with this value reference, and its contact.\n\
             pub fn integer(value_reference: u32) -> Option<(Integer, usize)> {{\n{body}}}\n"
        ),
    );
}
