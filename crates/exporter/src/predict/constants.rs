//! Constants of laws as quantities of a sweep, with the names that they have in a scene.

use super::PredictError;
use crate::law_check;
use crate::laws::Choice;
use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::model::{AnyModel, RateLaw};
use crate::numbers::in_message;
use crate::pairing::{check_ties, published};
use crate::parameters::{ConstantTable, apply};
use crate::scene::Scene;
use crate::table;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Prefixes of the constants of a loading law and of an unloading law.
pub const LOADING: &str = "law.loading_parameters.";
const UNLOADING: &str = "law.unloading_parameters.";

/// All constants of a law, with their units; `None` for a depth in units of the law, such as its yield indentation.
static ALL: LazyLock<Vec<(String, &str)>> = LazyLock::new(|| {
    let mut all = Vec::new();
    for (laws, prefix) in [(table::loading_laws(), LOADING), (table::unloading_laws(), UNLOADING)] {
        for parameter in laws.iter().flat_map(|law| &law.parameters) {
            let name = format!("{prefix}{}", parameter.name);
            if !all.iter().any(|(known, _)| *known == name) {
                let unit = parameter.unit.as_str();
                all.push((name, if unit.starts_with("d_") { "" } else { unit }));
            }
        }
    }
    all
});

/// The constants of all laws, with their units.
pub fn names() -> impl Iterator<Item = (&'static str, &'static str)> {
    ALL.iter().map(|(name, unit)| (name.as_str(), *unit))
}

/// Whether the quantity `name` is a constant of a law.
pub fn is_one(name: &str) -> bool {
    name.starts_with(LOADING) || name.starts_with(UNLOADING)
}

/// The table entry of the law of `choice` that could have a constant called `name`.
fn law_with(choice: &Choice, name: &str) -> Option<&'static table::Law> {
    let (loading, other) = choice.names();
    match (choice.model.rate_law(), name.starts_with(LOADING)) {
        (Some(_), true) => Some(table::damped_law(loading)),
        (None, true) => Some(table::loading_law(loading)),
        (None, false) => other.map(table::unloading_law),
        (Some(_), false) => None,
    }
}

/// Whether the laws of `choice` have the constant `name`.
pub fn has(choice: &Choice, name: &str) -> bool {
    let constant = name.rsplit('.').next().unwrap_or_default();
    law_with(choice, name).is_some_and(|law| law.parameters.iter().any(|parameter| parameter.name == constant))
}

/// Sets the constant `name` of the laws of `choice` to `value`, with the checks of a scene.
///
/// # Errors
/// The allowed values of the constant, or that no law has it.
pub fn set(scene: &Scene, choice: &mut Choice, name: &str, value: f64) -> Result<(), PredictError> {
    let wrong = |Mistake(_, message): Mistake| {
        let is_named = message.starts_with(name);
        PredictError::Varied(if is_named { message } else { format!("{name}: {message}") })
    };
    let Some(law) = law_with(choice, name) else {
        return Err(PredictError::Varied(format!("{name}: {} has no unloading law with constants", choice.laws)));
    };
    let constant = name.rsplit('.').next().unwrap_or_default();
    let number = Spanned::new(0..0, toml::Value::Float(value));
    let given: ConstantTable = Spanned::new(0..0, BTreeMap::from([(Spanned::new(0..0, constant.to_string()), number)]));
    let names = choice.clone();
    let ((loading, unloading), guarded) = (names.names(), names.is_guarded());
    let mut model = match choice.model {
        AnyModel::Elastoplastic(model) => model,
        AnyModel::Lossy(model, None) => model.plastic,
        AnyModel::Lossy(model, Some(own)) => {
            let own = RateLaw { law: apply(own.law, "law.loading", Some(&given), law).map_err(wrong)?, ..own };
            choice.model = own.on(model.plastic.pair);
            return Ok(());
        }
    };
    if name.starts_with(LOADING) {
        model.loading = apply(model.loading, "law.loading", Some(&given), law).map_err(wrong)?;
    } else {
        // the guard wraps the law that has the constants
        let own = scene.laws.unloading().filter(|_| guarded).map_or(model.unloading, |(_, own)| own);
        let changed = apply(own, "law.unloading", Some(&given), law).map_err(wrong)?;
        model.unloading = if guarded { changed.guarded().unwrap_or(changed) } else { changed };
    }
    let refused = |message: String| PredictError::Varied(format!("with {name} = {} {message}", in_message(value)));
    if let Some(unloading) = unloading.filter(|_| !guarded) {
        check_ties((loading, model.loading), (unloading, model.unloading)).map_err(PredictError::Varied)?;
    }
    law_check::check_loading(&model, published(loading)).map_err(refused)?;
    law_check::check_unloading(&model).map_err(refused)?;
    choice.model = choice.model.with_plastic(model);
    Ok(())
}
