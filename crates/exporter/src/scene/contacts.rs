//! The contacts: the numbers that a scene gives for all of them, and those that one gives for itself, directly or by a material.

use super::checked::{Flows, Group, Parameter};
use super::file::{BodyTable, ContactTable, FrictionTable, Impactor, LawTable, MOST_CONTACTS, Radius, SceneFile};
use super::names::check_identifier;
use super::own_materials::{self, OwnMaterial};
use super::quantities::check_quantity;
use super::strength::{self, Elastic, Flow, Rate};
use crate::body::{Body, Both, Rod};
use crate::measured::{MeasuredStrength, STEEL_RATE};
use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::nearest::unknown;
use crate::pairing;
use crate::table::{self, VARIABLES};
use brinell_contact::Surface;
use brinell_contact::loading::AnyLoading;
use std::collections::HashSet;
use std::ops::Range;
use std::sync::Arc;

/// Largest number of values of parameters that each contact has for itself. Restoring a state from bytes puts them on the
/// stack.
const MOST_VALUES: usize = 10_000;

/// A property that the scene gives elsewhere for all contacts.
const MASS: &str = "effective_mass";

/// A property that every contact has as soon as the scene gives it for all.
const FRICTION: &str = "friction.coefficient";

/// The numbers at one level, the whole scene or one contact, with their places in the file.
#[derive(Default)]
struct Numbers {
    values: Vec<(&'static str, Spanned<f64>)>,
    /// The radii of both bodies, also where they are two numbers.
    radii: Both<Option<Spanned<Radius>>>,
    /// Whether the scene gives the strength of the impactor at this level, rather than by a material.
    gives_impactor_strength: bool,
    /// Whether the impactor may yield, so that its strength is a parameter.
    impactor_may_yield: bool,
}

impl Numbers {
    /// The numbers of the two bodies, and `others` with their names. Those that a contact doesn't give are in `shared`.
    fn of(
        bodies: &Both<&BodyTable>,
        others: [(&'static str, Option<&Spanned<f64>>); 3],
        above: &Above,
    ) -> Result<Numbers, Mistake> {
        let of = |body| numbers_of(body, bodies.of(body), above);
        let (target, impactor) = (of(Body::Target)?, of(Body::Impactor)?);
        let others = others.into_iter().map(|(name, value)| (name, value.cloned()));
        let numbers = impactor.into_iter().chain(target).chain(others);
        Ok(Numbers {
            values: numbers.filter_map(|(name, value)| Some((name, value?))).collect(),
            radii: Both::each(|body| bodies.of(body).radius.clone()),
            gives_impactor_strength: bodies.impactor.gives_strength(),
            impactor_may_yield: false,
        })
    }

    fn get(&self, name: &str) -> Option<&Spanned<f64>> {
        self.values.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    /// Rejects a number outside its range. `owner` precedes its name in the message.
    fn check(&self, owner: &str) -> Result<(), Mistake> {
        self.values.iter().try_for_each(|(name, value)| check_quantity(name, owner, value))
    }

    /// The numbers that are parameters. The strength of an impactor that never yields is none.
    fn parameters(&self) -> Vec<Parameter> {
        let [strength, hardening] = [Body::Impactor.yield_strength(), Body::Impactor.hardening_modulus()];
        let is_parameter = |name: &'static str| {
            let never = Body::ALL.iter().any(|body| [body.density(), body.length(), body.area()].contains(&name));
            !never && (self.impactor_may_yield || (name != strength && name != hardening))
        };
        let parameters = self.values.iter().filter(|(name, _)| is_parameter(name));
        parameters.map(|(name, value)| Parameter::shared(name, *value.get_ref(), true)).collect()
    }
}

/// The name of a property, and its number if there is one.
type NamedNumber = (&'static str, Option<Spanned<f64>>);

/// What the tables of a level may ask for beside themselves.
struct Above<'a> {
    /// The materials that aren't built in.
    materials: &'a [OwnMaterial],
    /// Whether the law takes hardening.
    hardens: bool,
    /// Of a contact: the numbers of all contacts, and the tables that they are from.
    shared: Option<(&'a Numbers, &'a Both<&'a BodyTable>)>,
}

impl<'a> Above<'a> {
    fn material<'b>(&'b self, table: &'b BodyTable) -> Result<Option<(&'b table::Material, Range<usize>)>, Mistake> {
        let of = |name: &'b Spanned<String>| Ok((own_materials::find(name, self.materials)?, name.span()));
        table.material.as_ref().map(of).transpose()
    }

    /// What a reading of a `body` needs to know, by its `table`, and these moduli of it where it has them.
    fn elastic<'b>(
        &'b self,
        body: Body,
        table: &'b BodyTable,
        [modulus, ratio]: [Option<&'b Spanned<f64>>; 2],
    ) -> Result<Elastic<'b>, Mistake> {
        let shared = |name| self.shared?.0.get(name);
        // a body with moduli of its own is of another metal
        let of_all = self.shared.filter(|_| modulus.is_none()).map(|(_, tables)| *tables.of(body));
        let material = match self.material(table)? {
            Some((material, _)) => Some(material),
            None => of_all.map(|table| self.material(table)).transpose()?.flatten().map(|(material, _)| material),
        };
        Ok(Elastic {
            youngs_modulus: modulus.or_else(|| shared(body.youngs_modulus())),
            poissons_ratio: ratio.or_else(|| shared(body.poissons_ratio())),
            material,
            hardens: self.hardens,
            hardens_above: shared(body.hardening_modulus()).is_some(),
        })
    }
}

/// The numbers of a `body`. An explicit number overrides that of the material.
fn numbers_of(body: Body, table: &BodyTable, above: &Above) -> Result<[NamedNumber; 8], Mistake> {
    let material = above.material(table)?;
    let or = |given: Option<Spanned<f64>>, of_material: fn(&table::Material) -> Option<f64>| {
        given.or_else(|| {
            let (material, span) = material.as_ref()?;
            Some(Spanned::new(span.clone(), of_material(material)?))
        })
    };
    let youngs_modulus = or(table.youngs_modulus.clone(), |material| Some(material.youngs_modulus));
    let poissons_ratio = or(table.poissons_ratio.clone(), |material| Some(material.poissons_ratio));
    let elastic = above.elastic(body, table, [youngs_modulus.as_ref(), poissons_ratio.as_ref()])?;
    let [yield_strength, hardening_modulus] = table.flow(body, &elastic)?;
    let values = [
        table.one_radius(),
        youngs_modulus.clone(),
        poissons_ratio.clone(),
        or(yield_strength, |material| material.yield_strength),
        hardening_modulus,
        or(table.density.clone(), |material| Some(material.density)),
        table.length.clone(),
        table.area.clone(),
    ];
    let mut values = values.into_iter();
    Ok(body.properties().map(|name| (name, values.next().flatten())))
}

/// Whether the law of the table takes the hardening of a body that yields. Wrong names are refused elsewhere.
fn takes_hardening(law: &LawTable) -> bool {
    let name = law.loading.as_ref().map_or(pairing::DEFAULT_LOADING, |name| name.get_ref().as_str());
    AnyLoading::ALL.iter().any(|(known, law)| *known == name && law.takes_both_bodies())
}

/// One `[[contact]]`, or the one contact of a scene without any.
struct Contact {
    name: Option<String>,
    count: Option<usize>,
    surface: Surface,
    own: Numbers,
    /// The hardening of its bodies that depends on the strain, if their strength is its own.
    flows: Flows,
    /// The properties with separate values for each contact of the group.
    per_contact: Vec<Spanned<String>>,
    /// The place for an error message, if no more precise place is known.
    span: Range<usize>,
}

/// The contacts of `file`; those without their own surface have `surface`.
fn contacts_of(file: &SceneFile, surface: Surface, above: &Above) -> Result<Vec<Contact>, Mistake> {
    let Some(contacts) = &file.contact else {
        let own = Numbers::default();
        let flows = Flows::default();
        return Ok(vec![Contact { name: None, count: None, surface, own, flows, per_contact: Vec::new(), span: 0..0 }]);
    };
    if contacts.get_ref().is_empty() {
        let message = "the list of contacts is empty; leave it out for one contact with plain variable names";
        return Err(Mistake(contacts.span(), message.into()));
    }
    let (mut names, mut total) = (HashSet::new(), 0);
    let mut all = Vec::new();
    for contact in contacts.get_ref() {
        let span = contact.span();
        let ContactTable { name, count, impactor: Impactor(impactor), target, .. } = contact.get_ref();
        let ContactTable { initial_gap, effective_mass, friction, parameters_per_contact, .. } = contact.get_ref();
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
        let bodies = Both { impactor, target };
        let others = [
            (MASS, effective_mass.as_ref()),
            ("initial_gap", initial_gap.as_ref()),
            (FRICTION, friction.coefficient.as_ref()),
        ];
        let of_contact = |Mistake(span, why)| Mistake(span, format!("contact `{text}`: {why}"));
        let own = Numbers::of(&bodies, others, above).map_err(of_contact)?;
        own.check(&format!("{text}."))?;
        let flows = flows_of(&bodies, &own, above).map_err(of_contact)?;
        let surface = target.surface.map_or(surface, Surface::from);
        let (count, per_contact) = (count.map(|count| count as usize), parameters_per_contact.clone());
        all.push(Contact { name: Some(text), count, surface, own, flows, per_contact, span });
    }
    Ok(all)
}

/// The hardening of the `bodies` that depends on the strain, by their tables and the numbers of the same level.
fn flows_of(bodies: &Both<&BodyTable>, own: &Numbers, above: &Above) -> Result<Flows, Mistake> {
    Both::try_each(|body| {
        let table = *bodies.of(body);
        let moduli = [body.youngs_modulus(), body.poissons_ratio()].map(|name| own.get(name));
        Ok(strength::flow_of(body, table, &above.elastic(body, table, moduli)?)?.map(Arc::new))
    })
}

/// The beginnings of the names of variables.
pub fn reserved_names() -> Vec<&'static str> {
    let mut reserved: Vec<_> = VARIABLES.iter().filter_map(|variable| variable.name.split('.').next()).collect();
    reserved.dedup();
    reserved
}

/// The name of a contact, which must not be the beginning of the name of another variable.
fn check_contact_name(name: &Spanned<String>) -> Result<String, Mistake> {
    let text = check_identifier(name)?;
    let reserved = reserved_names();
    if reserved.contains(&text.as_str()) {
        let message = format!("name = {text:?} belongs to a variable of the FMU, as do `{}`", reserved.join("`, `"));
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

/// The number of tangential directions of all contacts.
pub fn check_directions(friction: &FrictionTable) -> Result<usize, Mistake> {
    let Some(directions) = &friction.directions else { return Ok(1) };
    match *directions.get_ref() {
        number @ (1 | 2) => Ok(number as usize),
        number => {
            let message = format!(
                "friction.directions = {number} is out of range: allowed are 1, one tangential direction along which the \
                 bodies move to and fro, and 2, two directions across each other"
            );
            Err(Mistake(directions.span(), message))
        }
    }
}

/// The contacts of a scene.
pub struct Contacts {
    shared: Numbers,
    /// The hardening of all bodies that depends on the strain of the impact.
    flows: Flows,
    /// The strain-rate dependence of the strength of all bodies.
    rates: Both<Option<Spanned<Rate>>>,
    all: Vec<Contact>,
}

impl Contacts {
    /// The contacts of the scene `file`, which the rules have found complete.
    pub fn of(file: &SceneFile) -> Result<Contacts, Mistake> {
        let none = BodyTable::default();
        let bodies = Both {
            impactor: file.impactor.as_ref().map_or(&none, |impactor| &impactor.get_ref().0),
            target: file.target.as_ref().map_or(&none, Spanned::get_ref),
        };
        let no_gap = Spanned::new(0..0, 0.0);
        let gap = file.fmu.initial_gap.as_ref().unwrap_or(&no_gap);
        let friction = file.friction.as_ref().map(|friction| &friction.get_ref().coefficient);
        let hardens = takes_hardening(&file.law);
        let above = Above { materials: &file.own, hardens, shared: None };
        let shared = Numbers::of(&bodies, [(MASS, None), ("initial_gap", Some(gap)), (FRICTION, friction)], &above)?;
        shared.check("")?;
        let flows = flows_of(&bodies, &shared, &above)?;
        let surface = bodies.target.surface.map_or(Surface::Dented, Surface::from);
        let all = contacts_of(file, surface, &Above { shared: Some((&shared, &bodies)), ..above })?;
        let share_bodies =
            file.body.is_some() || file.coupling.as_ref().is_some_and(|table| table.get_ref().inverse_masses.is_some());
        // the rate of a line contact has not been compared with anything
        let has_no_rate = share_bodies || file.is_line();
        let mut contacts = Contacts { shared, flows, rates: Both::default(), all };
        contacts.rates = Both::try_each(|body| contacts.rate_of(body, bodies.of(body), has_no_rate))?;
        (0..contacts.all.len()).try_for_each(|index| contacts.check_impactor(index))?;
        Ok(contacts)
    }

    /// The hardening of a `body` of a contact that depends on the strain.
    fn flow(&self, index: usize, body: Body) -> Option<&Arc<Flow>> {
        let contact = &self.all[index];
        // a strength of its own has a hardening of its own, or none
        let flows = if contact.own.get(body.yield_strength()).is_some() { &contact.flows } else { &self.flows };
        flows.of(body).as_ref()
    }

    /// The strain-rate dependence of a `body`, by the `table` of all contacts. Steel whose strength was measured slowly, in every contact,
    /// has one also if the scene gives none, unless the scene `has_no_rate`, as where contacts share bodies.
    fn rate_of(&self, body: Body, table: &BodyTable, has_no_rate: bool) -> Result<Option<Spanned<Rate>>, Mistake> {
        fn measured(flow: Option<&Arc<Flow>>) -> Option<&MeasuredStrength> {
            flow.and_then(|flow| flow.measured())
        }
        let of_all = measured(self.flows.of(body).as_ref());
        let slow = |measured: Option<&MeasuredStrength>| measured.is_some_and(MeasuredStrength::is_slow_steel);
        let strength = self.shared.get(body.yield_strength());
        let each_slow = || (0..self.all.len()).all(|index| slow(measured(self.flow(index, body))));
        let is_slow = if strength.is_some() { slow(of_all) } else { each_slow() };
        let rate = match &table.rate {
            Some(rate) => Some(strength::check_rate(body, rate, of_all)?),
            None if is_slow && !has_no_rate => {
                let strength = strength.or_else(|| self.all[0].own.get(body.yield_strength()));
                Some(Spanned::new(strength.map_or(0..0, Spanned::span), STEEL_RATE))
            }
            None => None,
        };
        let has_none = |rate: &Rate| matches!(rate, Rate::JohnsonCook { c: 0.0, .. });
        let acts = rate.as_ref().is_some_and(|rate| !has_none(rate.get_ref()));
        for (index, contact) in self.all.iter().enumerate().filter(|_| acts) {
            let Some(own) = measured(contact.flows.of(body).as_ref()) else { continue };
            if let (false, Some(rate)) = (own.has_rate, &table.rate) {
                let of_contact = |Mistake(span, why)| self.wrong(index, span, &why);
                strength::check_rate(body, rate, Some(own)).map_err(of_contact)?;
            }
            if own.has_rate {
                let (name, span) = (body.name(), contact.own.get(body.yield_strength()).map_or(0..0, Spanned::span));
                let message = format!(
                    "{name}.hardness = \"{}\" has a rate in it, and the rate of [{name}] is for all contacts: give rate = {{ model = \
                     \"johnson-cook\", c = 0 }} there, and strengths at the rate of the impact",
                    own.given
                );
                return Err(self.wrong(index, span, &message));
            }
        }
        Ok(rate)
    }

    /// The number `name` of a contact: its own, otherwise that of all contacts.
    pub fn number(&self, index: usize, name: &str) -> Option<&Spanned<f64>> {
        self.all[index].own.get(name).or_else(|| self.shared.get(name))
    }

    /// The radius of a `body` of a contact, or its two radii: its own, otherwise that of all contacts.
    pub fn radius(&self, index: usize, body: Body) -> Option<&Spanned<Radius>> {
        self.all[index].own.radii.of(body).as_ref().or(self.shared.radii.of(body).as_ref())
    }

    /// The number of groups.
    pub fn count(&self) -> usize {
        self.all.len()
    }

    /// `text` after the name of the contact, if it has one.
    pub fn said(&self, index: usize, text: &str) -> String {
        self.all[index].name.as_ref().map_or(text.into(), |name| format!("contact `{name}`: {text}"))
    }

    /// A mistake in a contact.
    fn wrong(&self, index: usize, span: Range<usize>, message: &str) -> Mistake {
        Mistake(span, self.said(index, message))
    }

    /// The strain-rate dependence of both bodies.
    pub fn rates(&self) -> Both<Option<Rate>> {
        Both::each(|body| self.rates.of(body).as_ref().map(|rate| *rate.get_ref()))
    }

    /// Yield strength of the softer body of a contact \[Pa\], if it has one.
    pub fn yield_strength(&self, index: usize) -> Option<f64> {
        let may_yield = |body| body == Body::Target || self.level_of_impactor(index).impactor_may_yield;
        let strength = |body: Body| self.number(index, body.yield_strength()).map(|strength| *strength.get_ref());
        Body::ALL.into_iter().filter(|body| may_yield(*body)).filter_map(strength).reduce(f64::min)
    }

    /// Whether a contact has a yield strength.
    pub fn any_yields(&self) -> bool {
        (0..self.all.len()).any(|index| self.yield_strength(index).is_some())
    }

    /// The numbers that have the strength of the impactor of a contact: its own, or those of all contacts.
    fn level_of_impactor(&self, index: usize) -> &Numbers {
        let own = &self.all[index].own;
        if own.get(Body::Impactor.yield_strength()).is_some() { own } else { &self.shared }
    }

    /// Rejects a contact without yield strength for a `law` that needs it.
    pub fn check_strength(&self, law: &str) -> Result<(), Mistake> {
        let elastic = |index: &usize| self.yield_strength(*index).is_none();
        let Some(index) = (0..self.all.len()).find(elastic) else { return Ok(()) };
        let message = format!("law.loading = \"{law}\" needs target.yield_strength (or a material) for every contact");
        Err(self.wrong(index, self.all[index].span.clone(), &message))
    }

    /// For a law that has no yield strength.
    pub fn forget_strength(&mut self) {
        for numbers in self.all.iter_mut().map(|contact| &mut contact.own).chain([&mut self.shared]) {
            numbers.values.retain(|(name, _)| Body::ALL.iter().all(|body| body.yield_strength() != *name));
        }
        self.all.iter_mut().for_each(|contact| contact.flows = Both::default());
        (self.flows, self.rates) = (Both::default(), Both::default());
    }

    /// Gives each contact its own value of the properties that its group names. They may be parameters of the group or of all
    /// contacts (`shared`).
    pub fn divide(&self, shared: &[Parameter], groups: &mut [Group]) -> Result<(), Mistake> {
        let mut total = 0;
        for (index, (contact, group)) in self.all.iter().zip(groups).enumerate() {
            for name in &contact.per_contact {
                let text = name.get_ref().as_str();
                let wrong = |message: &str| self.wrong(index, name.span(), message);
                let has = |parameter: &&Parameter| parameter.name == text;
                let Some(mut parameter) = group.own.iter().chain(shared).find(has).cloned() else {
                    let names = group.own.iter().chain(shared).map(|parameter| parameter.name);
                    return Err(wrong(&unknown("parameter", text, names)));
                };
                total += group.size();
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
        let group = |(index, contact): (usize, &Contact)| {
            let number = |name| self.number(index, name).map(|number| *number.get_ref());
            Group {
                name: contact.name.clone(),
                count: contact.count,
                own: contact.own.parameters(),
                surface: contact.surface,
                density: number(Body::Target.density()),
                impactor_density: number(Body::Impactor.density()),
                line_length: number(Body::Impactor.length()).filter(|_| number(Body::Impactor.area()).is_none()),
                ellipse: None,
                rods: Both::each(|body| {
                    let [density, length, area] = [body.density(), body.length(), body.area()].map(number);
                    Some(Rod { density: density?, length: length?, area: area? })
                }),
                impactor_strength: number(Body::Impactor.yield_strength()),
                flows: Both::each(|body| self.flow(index, body).cloned()),
            }
        };
        (self.shared.parameters(), self.all.iter().enumerate().map(group).collect())
    }

    /// Rejects the hardening of an impactor without a strength. Where the scene gives its strength, or it is below that of the target, it
    /// becomes a parameter. That of a harder material is only known.
    fn check_impactor(&mut self, index: usize) -> Result<(), Mistake> {
        let number = |name| self.number(index, name);
        let Some(strength) = number(Body::Impactor.yield_strength()) else {
            let Some(hardening) = number(Body::Impactor.hardening_modulus()) else { return Ok(()) };
            let message = "the hardening of the impactor needs impactor.yield_strength, or a material";
            return Err(self.wrong(index, hardening.span(), message));
        };
        let given = self.level_of_impactor(index).gives_impactor_strength;
        let target = number(Body::Target.yield_strength());
        let is_softer = target.is_some_and(|target| strength.get_ref() < target.get_ref());
        if number(Body::Impactor.youngs_modulus()).is_some() && (given || is_softer) {
            self.let_impactor_yield(index);
        }
        Ok(())
    }

    /// Makes the strength of the impactor of a contact a parameter.
    fn let_impactor_yield(&mut self, index: usize) {
        let own = self.all[index].own.get(Body::Impactor.yield_strength()).is_some();
        let level = if own { &mut self.all[index].own } else { &mut self.shared };
        level.impactor_may_yield = true;
    }

    /// For a law that takes each body for itself: the strength of a harder impactor is a parameter, too.
    pub fn let_both_yield(&mut self) {
        for index in 0..self.all.len() {
            let knows = |name| self.number(index, name).is_some();
            let strengths = Body::ALL.iter().all(|body| knows(body.yield_strength()));
            if strengths && knows(Body::Impactor.youngs_modulus()) {
                self.let_impactor_yield(index);
            }
        }
    }
}
