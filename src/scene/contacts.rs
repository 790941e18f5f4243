//! The contacts: the numbers that a scene gives for all contacts, and those that a contact overrides.

use super::error::Mistake;
use super::file::{File, Impactor, PowerLawTable, RateTable, Target};
use super::given::{Given, given};
use super::group::{Group, Parameter};
use super::numbers::{
    DENSITY, FRICTION, HARDENING, IMPACTOR_HARDENING, IMPACTOR_STRENGTH, MASS, Numbers, check_numbers,
};
use super::power_law::{self, PowerLaw};
use super::rate::{self, Rate};
use super::softer::{self, Body, Both};
use crate::nearest::unknown;
use crate::table::{MATERIALS, VARIABLES};
use brinell_contact::loading::AnyLoading;
use std::ops::Range;
use toml::Spanned;

/// Largest number of values of parameters that each contact has for itself. Restoring a state from bytes puts them on the
/// stack.
const MOST_VALUES: usize = 10_000;

/// The contacts of a scene.
pub struct Contacts {
    shared: Numbers,
    /// The hardening of all bodies by a power law.
    pub power_laws: Both<Option<PowerLaw>>,
    /// The strain-rate dependence of the strength of all bodies.
    pub rates: Both<Option<Rate>>,
    rate_spans: Both<Range<usize>>,
    given: Vec<Given>,
}

impl Contacts {
    /// The contacts of the scene `file`, all of them complete.
    pub fn of(file: &File) -> Result<Contacts, Mistake> {
        let impactor = file.impactor.as_ref().map(Spanned::get_ref);
        let target = file.target.as_ref().map(Spanned::get_ref);
        let standard = (Impactor::default(), Target::default());
        let no_gap = Spanned::new(0..0, 0.0);
        let gap = file.fmu.initial_gap.as_ref().unwrap_or(&no_gap);
        let friction = file.friction.as_ref().map(|friction| &friction.get_ref().coefficient);
        let (impactor, of_target) = (impactor.unwrap_or(&standard.0), target.unwrap_or(&standard.1));
        let shared = Numbers::of(impactor, of_target, None, Some(gap), friction, None)?;
        check_numbers(&shared, "")?;
        let surface = target.and_then(|target| target.surface);
        let given = given(file, surface, &shared)?;
        let power_law = |body, table: &Option<Spanned<PowerLawTable>>| {
            table.as_ref().map(|table| power_law::check(body, table)).transpose()
        };
        let power_laws = Both {
            impactor: power_law(Body::Impactor, &impactor.power_law)?,
            target: power_law(Body::Target, &of_target.power_law)?,
        };
        let rate =
            |body, table: &Option<Spanned<RateTable>>| table.as_ref().map(|table| rate::check(body, table)).transpose();
        let rates =
            Both { impactor: rate(Body::Impactor, &impactor.rate)?, target: rate(Body::Target, &of_target.rate)? };
        let span = |table: &Option<Spanned<RateTable>>| table.as_ref().map_or(0..0, Spanned::span);
        let rate_spans = Both { impactor: span(&impactor.rate), target: span(&of_target.rate) };
        let mut contacts = Contacts { shared, power_laws, rates, rate_spans, given };
        for index in 0..contacts.given.len() {
            match contacts.given[index].name {
                Some(_) => contacts.check_complete(index)?,
                None => check_tables(file, &contacts)?,
            }
            contacts.check_impactor(index)?;
            contacts.check_strengths(index)?;
        }
        Ok(contacts)
    }

    /// The number `name` of a contact: its own, otherwise that of all contacts.
    pub fn number(&self, index: usize, name: &str) -> Option<&Spanned<f64>> {
        self.given[index].own.get(name).or_else(|| self.shared.get(name))
    }

    /// `text` after the name of the contact, if it has one.
    pub fn said(&self, index: usize, text: &str) -> String {
        self.given[index].name.as_ref().map_or(text.into(), |name| format!("contact `{name}`: {text}"))
    }

    /// Yield strength of the softer body of a contact [Pa], if it has one.
    pub fn yield_strength(&self, index: usize) -> Option<f64> {
        let strength = |name| self.number(index, name).map(|strength| *strength.get_ref());
        let impactor = strength(IMPACTOR_STRENGTH).filter(|_| self.level_of_impactor(index).impactor_may_yield);
        [impactor, strength("target.yield_strength")].into_iter().flatten().reduce(f64::min)
    }

    /// Whether a contact has a yield strength.
    pub fn any_yields(&self) -> bool {
        (0..self.given.len()).any(|index| self.yield_strength(index).is_some())
    }

    /// The numbers that have the strength of the impactor of a contact: its own, or those of all contacts.
    fn level_of_impactor(&self, index: usize) -> &Numbers {
        let own = &self.given[index].own;
        if own.get(IMPACTOR_STRENGTH).is_some() { own } else { &self.shared }
    }

    /// Rejects a strength of the impactor without effect. Otherwise, where the scene gives it, or it is below that of the
    /// target, it becomes a parameter. That of a harder material is only known.
    fn check_strengths(&mut self, index: usize) -> Result<(), Mistake> {
        let given = self.level_of_impactor(index).gives_impactor_strength;
        softer::check(self, index, given)?;
        let Some(strength) = self.number(index, IMPACTOR_STRENGTH).map(|strength| *strength.get_ref()) else {
            return Ok(());
        };
        let target = self.number(index, "target.yield_strength");
        let is_softer = target.is_some_and(|target| strength < *target.get_ref());
        let deforms = self.number(index, "impactor.youngs_modulus").is_some();
        if deforms && (given || is_softer) {
            let own = self.given[index].own.get(IMPACTOR_STRENGTH).is_some();
            let level = if own { &mut self.given[index].own } else { &mut self.shared };
            level.impactor_may_yield = true;
        }
        Ok(())
    }

    /// A contact whose target has no density.
    pub fn without_density(&self) -> Option<usize> {
        (0..self.given.len()).find(|index| self.number(*index, DENSITY).is_none())
    }

    /// Rejects a contact without yield strength for a `law` that needs it.
    pub fn check_strength(&self, law: &str) -> Result<(), Mistake> {
        let elastic = |index: &usize| self.yield_strength(*index).is_none();
        let Some(index) = (0..self.given.len()).find(elastic) else { return Ok(()) };
        let message = format!("law.loading = \"{law}\" needs target.yield_strength (or a material) for every contact");
        Err(Mistake(self.given[index].span.clone(), self.said(index, &message)))
    }

    /// Rejects a strain rate for a law without strength.
    pub fn check_rate(&self, has_no_strength: bool) -> Result<(), Mistake> {
        let given = [Body::Impactor, Body::Target].into_iter().find(|body| self.rates.of(*body).is_some());
        let Some(body) = given.filter(|_| has_no_strength) else { return Ok(()) };
        let message = format!("{}.rate has no effect: the law has no yield strength", body.name());
        Err(Mistake(self.rate_spans.of(body).clone(), message))
    }

    /// Rejects a hardening body for the law `name`, if the law has no form for it.
    pub fn check_hardening(&self, name: &str, hardens: bool) -> Result<(), Mistake> {
        let of = |(body, name): (Body, &str)| {
            (0..self.given.len()).find_map(|index| Some((body, index, self.number(index, name)?)))
        };
        let given = [(Body::Target, HARDENING), (Body::Impactor, IMPACTOR_HARDENING)].into_iter().find_map(of);
        let Some((body, index, modulus)) = given.filter(|_| !hardens) else { return Ok(()) };
        let laws = AnyLoading::ALL.iter().filter(|(_, law)| law.strengthened(0.0).is_some());
        let laws = laws.map(|(name, _)| *name).collect::<Vec<_>>().join("\", \"");
        let message = format!(
            "the hardening of the {} has no effect on law.loading = \"{name}\": it belongs to \"{laws}\"",
            body.name()
        );
        Err(Mistake(modulus.span(), self.said(index, &message)))
    }

    /// For a law that has no yield strength.
    pub fn forget_strength(&mut self) {
        let own = self.given.iter_mut().map(|given| &mut given.own);
        for numbers in own.chain([&mut self.shared]) {
            [IMPACTOR_STRENGTH, "target.yield_strength"].iter().for_each(|name| numbers.remove(name));
        }
    }

    /// Rejects the mass of a single contact if the FMU does not know the mass.
    pub fn check_masses(&self, known: bool) -> Result<(), Mistake> {
        let given = self.given.iter().enumerate().find_map(|(index, given)| Some((index, given.own.get(MASS)?)));
        match given {
            Some((index, mass)) if !known => {
                let message =
                    "effective_mass is that of bodies which the unit moves: it needs [coupling] effective_mass for all";
                Err(Mistake(mass.span(), self.said(index, message)))
            }
            _ => Ok(()),
        }
    }

    /// Rejects the friction of a single contact if the scene gives none for all.
    pub fn check_friction(&self) -> Result<(), Mistake> {
        let given = self.given.iter().enumerate().find_map(|(index, given)| Some((index, given.own.get(FRICTION)?)));
        match given {
            Some((index, coefficient)) if self.shared.get(FRICTION).is_none() => {
                let message = "friction.coefficient of one contact needs [friction] coefficient for all: every contact has the \
                               same variables; 0 is a contact without friction";
                Err(Mistake(coefficient.span(), self.said(index, message)))
            }
            _ => Ok(()),
        }
    }

    /// Gives each contact its own value of the properties that its group names. They may be parameters of the group or of all
    /// contacts (`shared`). `is_input` returns whether a property is an input and so cannot be a parameter.
    pub fn divide(
        &self,
        shared: &[Parameter],
        groups: &mut [Group],
        is_input: impl Fn(&str) -> bool,
    ) -> Result<(), Mistake> {
        let mut total = 0;
        for (index, (given, group)) in self.given.iter().zip(groups).enumerate() {
            for name in &given.per_contact {
                let text = name.get_ref().as_str();
                let wrong = |message: &str| Mistake(name.span(), self.said(index, message));
                if is_input(text) {
                    return Err(wrong(&format!("{text} is an input of each contact already")));
                }
                let has = |parameter: &&Parameter| parameter.name == text;
                let Some(mut parameter) = group.own.iter().chain(shared).find(has).cloned() else {
                    let names = group.own.iter().chain(shared).map(|parameter| parameter.name);
                    return Err(wrong(&unknown("parameter", text, names)));
                };
                total += group.len();
                if total > MOST_VALUES {
                    let message = format!("{text} makes {total} values per contact: allowed are {MOST_VALUES} in all");
                    return Err(wrong(&message));
                }
                parameter.per_contact = true;
                group.own.retain(|own| own.name != text);
                group.own.push(parameter);
            }
            group.own.sort_by_key(|parameter| VARIABLES.iter().position(|variable| variable.name == parameter.name));
        }
        Ok(())
    }

    /// The parameters of all contacts, and the groups with their own parameters.
    pub fn parameters(&self) -> (Vec<Parameter>, Vec<Group>) {
        let group = |(index, given): (usize, &Given)| {
            let own = given.own.parameters(|_| true);
            let density = self.number(index, DENSITY).map(|density| *density.get_ref());
            let impactor_strength = self.number(index, IMPACTOR_STRENGTH).map(|strength| *strength.get_ref());
            let (name, count, surface) = (given.name.clone(), given.count, given.surface);
            Group { name, count, own, surface, density, impactor_strength }
        };
        (self.shared.parameters(|_| true), self.given.iter().enumerate().map(group).collect())
    }

    /// Rejects an incomplete contact.
    fn check_complete(&self, index: usize) -> Result<(), Mistake> {
        let missing = |name| self.number(index, name).is_none();
        let span = self.given[index].span.clone();
        if missing("impactor.radius") {
            let message = "impactor.radius is missing: neither the contact nor [impactor] gives one";
            return Err(Mistake(span, self.said(index, message)));
        }
        if missing("target.youngs_modulus") || missing("target.poissons_ratio") {
            return Err(Mistake(span, self.said(index, &target_needs())));
        }
        Ok(())
    }

    fn check_impactor(&self, index: usize) -> Result<(), Mistake> {
        let modulus = self.number(index, "impactor.youngs_modulus");
        let ratio = self.number(index, "impactor.poissons_ratio");
        if let (Some(given), None) | (None, Some(given)) = (modulus, ratio) {
            let message = "an elastic impactor needs both `youngs_modulus` and `poissons_ratio`, or a `material`; a rigid one needs neither";
            return Err(Mistake(given.span(), self.said(index, message)));
        }
        Ok(())
    }
}

/// Rejects a scene without `[[contact]]` whose tables are incomplete.
fn check_tables(file: &File, contacts: &Contacts) -> Result<(), Mistake> {
    let span =
        |table: Option<Range<usize>>, name| table.ok_or_else(|| Mistake(0..0, format!("missing table `{name}`")));
    let impactor = span(file.impactor.as_ref().map(Spanned::span), "impactor")?;
    let target = span(file.target.as_ref().map(Spanned::span), "target")?;
    let missing = |name| contacts.shared.get(name).is_none();
    if missing("impactor.radius") {
        return Err(Mistake(impactor, "missing field `radius` of the impactor".into()));
    }
    if missing("target.youngs_modulus") || missing("target.poissons_ratio") {
        return Err(Mistake(target, target_needs()));
    }
    Ok(())
}

fn target_needs() -> String {
    let names = MATERIALS.iter().map(|material| material.name.as_str()).collect::<Vec<_>>().join("`, `");
    format!("the target needs `youngs_modulus` and `poissons_ratio`, or a `material`: there are `{names}`")
}
