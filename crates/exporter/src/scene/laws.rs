//! The laws of a scene: what is wrong with their names, and whether they suit its bodies and each other.

use super::checked::{HERTZ, Scene, SceneLaws};
use super::contacts::Contacts;
use super::file::LawTable;
use super::losses::Loss;
use crate::law_check;
use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::model::Dampings;
use crate::nearest::unknown;
use crate::pairing::{self, LINE, TABLE};
use crate::parameters;
use crate::table;
use brinell_contact::damped::AnyDamped;
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;

/// The laws of the table `law`, which suit the `contacts`, and each other, with a `loss`. `broken` is the first rule about them that the
/// scene breaks.
pub fn of(
    law: &LawTable,
    contacts: &Contacts,
    loss: Option<Loss>,
    is_line: bool,
    broken: Option<Mistake>,
) -> Result<SceneLaws, Mistake> {
    let damped = find_damped(law)?;
    let loading = match damped {
        Some(_) => HERTZ,
        None => check_loading(law, contacts, is_line)?,
    };
    let elastic = matches!(loading.1, AnyLoading::Hertz(_));
    if let Some(mistake) = broken {
        return Err(mistake);
    }
    let unloading = if elastic { None } else { Some(check_unloading(law, loading.0)?) };
    check_parameters(law, &loading, unloading.as_ref())?;
    let passivity_guard = law.passivity_guard.as_ref().is_some_and(|asked| *asked.get_ref());
    Ok(match (damped, unloading) {
        (Some((name, damped)), _) => SceneLaws::Damped(name, damped),
        (None, Some(unloading)) => SceneLaws::Plastic { loading, unloading, passivity_guard, loss },
        (None, None) => SceneLaws::Elastic { loss },
    })
}

/// The rate-dependent law of the scene, with its damping variant and constants.
fn find_damped(law: &LawTable) -> Result<Option<(&'static str, AnyDamped)>, Mistake> {
    let asked = law.loading.as_ref();
    let found = asked.and_then(|asked| AnyDamped::ALL.into_iter().find(|(name, _)| name == asked.get_ref()));
    let Some((name, reference)) = found else { return Ok(None) };
    let chosen = match &law.damping {
        Some(damping) => with_damping(reference, damping)?,
        None => reference,
    };
    let parameters = law.loading_parameters.as_ref();
    Ok(Some((name, parameters::apply(chosen, "law.loading", parameters, table::damped_law(name))?)))
}

/// The `law` with the damping variant of the scene.
fn with_damping(law: AnyDamped, asked: &Spanned<String>) -> Result<AnyDamped, Mistake> {
    let dampings = law.dampings();
    law.with_damping(asked.get_ref())
        .ok_or_else(|| Mistake(asked.span(), unknown("law.damping", asked.get_ref(), dampings.into_iter())))
}

/// The loading law of a scene without a rate-dependent law.
fn check_loading(given: &LawTable, contacts: &Contacts, is_line: bool) -> Result<(&'static str, AnyLoading), Mistake> {
    let name = given.loading.as_ref();
    let yields = contacts.any_yields();
    let default = match yields {
        _ if is_line => LINE,
        true => pairing::DEFAULT_LOADING,
        false => "hertz",
    };
    let asked = name.map_or(default, |name| name.get_ref().as_str());
    let span = name.map_or(0..0, Spanned::span);
    let law = AnyLoading::ALL.into_iter().find(|(name, _)| *name == asked).ok_or_else(|| {
        let names = AnyLoading::ALL.iter().map(|(name, _)| *name);
        let names = names.chain(AnyDamped::ALL.iter().map(|(name, _)| *name));
        Mistake(span.clone(), unknown("law.loading", asked, names))
    })?;
    if law.1.table().is_some() && given.own_curve.is_none() {
        let message = "law.loading = \"table\" needs the file, as in law.loading.table = \"file.csv\"";
        return Err(Mistake(span, message.into()));
    }
    let needs_strength = law.0 != "hertz" && law.0 != TABLE;
    if !yields && needs_strength {
        let message =
            format!("law.loading = \"{asked}\" needs target.yield_strength (or a material); \"hertz\" doesn't");
        return Err(Mistake(span, message));
    }
    if needs_strength {
        contacts.check_strength(law.0)?;
    }
    let parameters = given.loading_parameters.as_ref();
    Ok((law.0, parameters::apply(law.1, "law.loading", parameters, table::loading_law(law.0))?))
}

/// The unloading law of a contact that yields.
fn check_unloading(given: &LawTable, loading: &str) -> Result<(&'static str, AnyUnloading), Mistake> {
    let name = given.unloading.as_ref();
    let parameters = given.unloading_parameters.as_ref();
    let span = name.map_or(0..0, Spanned::span);
    let asked = name.map_or(pairing::default_unloading(loading), |name| name.get_ref().as_str());
    let law = AnyUnloading::ALL.into_iter().find(|(name, _)| *name == asked).ok_or_else(|| {
        let names = AnyUnloading::ALL.iter().map(|(name, _)| *name);
        Mistake(span.clone(), unknown("law.unloading", asked, names))
    })?;
    pairing::check(loading, asked).map_err(|message| Mistake(span, message))?;
    Ok((law.0, parameters::apply(law.1, "law.unloading", parameters, table::unloading_law(law.0))?))
}

/// The place of the constants that the scene gives to its laws, if any.
fn parameters_span(given: &LawTable) -> Option<std::ops::Range<usize>> {
    given.loading_parameters.as_ref().or(given.unloading_parameters.as_ref()).map(Spanned::span)
}

/// Rejects constants of the two laws that contradict each other.
fn check_parameters(
    given: &LawTable,
    loading: &(&'static str, AnyLoading),
    unloading: Option<&(&'static str, AnyUnloading)>,
) -> Result<(), Mistake> {
    let (Some(span), Some(unloading)) = (parameters_span(given), unloading) else { return Ok(()) };
    pairing::check_ties(*loading, *unloading).map_err(|message| Mistake(span, message))
}

/// Rejects laws whose constants from the scene make them useless on the bodies of `group`.
pub fn check_curves(given: &LawTable, scene: &Scene, group: usize) -> Result<(), Mistake> {
    let Some(span) = parameters_span(given).filter(|_| scene.laws.unloading().is_some()) else { return Ok(()) };
    let model = scene.model_of(group);
    let unloading = given.unloading_parameters.as_ref().map_or(span.clone(), Spanned::span);
    law_check::check_loading(&model, pairing::published(scene.laws.name()))
        .map_err(|message| Mistake(span, format!("with these parameters {message}")))?;
    law_check::check_unloading(&model).map_err(|message| Mistake(unloading, format!("with these parameters {message}")))
}
