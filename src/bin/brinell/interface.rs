//! The variables that a scene's unit has, in order: the one list from which XML, constants and documentation are made.

use crate::nominal;
use crate::scene::{Group, Parameter, Scene};
use crate::table::{self, Causality, Follows, VARIABLES, Variable};
use brinell::contact::damped::Damped;

/// Variables of one kind: that of each contact of a group, or a parameter. Value references count them all in the order of the
/// list, and so do the places in the model description.
pub struct Entry<'a> {
    pub variable: &'static Variable,
    /// The group that it belongs to; none for a parameter of all contacts.
    pub group: Option<&'a Group>,
    /// Value reference of the first.
    pub reference: usize,
    /// How many they are.
    pub count: usize,
    /// For the input and the parameters.
    pub start: Option<f64>,
    /// References of the parameters that the values before the first step follow.
    pub dependencies: Vec<usize>,
    /// Reference of the input that the first one follows at the same instant, the second one the next, and so on.
    pub follows: Option<usize>,
    /// Whether they follow it before the first step, too.
    pub follows_from_the_start: bool,
    pub nominal: Option<f64>,
}

impl Entry<'_> {
    /// The name of the variable with this `index` among them.
    pub fn name(&self, index: usize) -> String {
        let name = &self.variable.name;
        match self.group {
            Some(group) if self.variable.causality == Causality::Parameter => group.variable(name),
            Some(group) => format!("{}{name}", group.prefix(index)),
            None => name.clone(),
        }
    }

    /// One name for all of them: `contact[1..1000].force`.
    pub fn label(&self) -> String {
        let (first, last) = (self.name(0), self.name(self.count - 1));
        match self.count {
            1 => first,
            count => last.replacen(&format!("[{count}]"), &format!("[1..{count}]"), 1),
        }
    }
}

/// The variables of the scene's unit.
pub fn entries(scene: &Scene) -> Vec<Entry<'_>> {
    let shown = |variable: &&'static Variable| match variable.causality {
        Causality::Input => true,
        Causality::Output => variable.name == "force" || scene.outputs.contains(&variable.name),
        Causality::Parameter => false,
    };
    let kinds: Vec<_> = VARIABLES.iter().filter(shown).collect();
    let parameters = Parameters::of(scene, kinds.len() * scene.contact_count());
    let nominals = nominal::of(scene);
    // a damping that waits for the first touch is none before the first step
    let damped_from_the_start = scene.damped.is_some_and(|(_, law)| !law.scaled_by_touch());
    let mut entries = Vec::new();
    let mut reference = 0;
    for variable in kinds {
        let mut first = 0;
        for (index, group) in scene.contacts.iter().enumerate() {
            let depends = |name: &str| {
                (damped_from_the_start || !["restitution", "effective_mass"].contains(&name))
                    && variable.depends_on.iter().any(|other| other == "*" || other == name)
            };
            let follows = match variable.follows_rate {
                Follows::Never => false,
                Follows::WithLaw => scene.damped.is_some(),
                Follows::Always => true,
            };
            entries.push(Entry {
                variable,
                group: Some(group),
                reference,
                count: group.len(),
                start: (variable.causality == Causality::Input).then_some(0.0),
                dependencies: parameters.of_group(index, depends),
                follows: follows.then_some(first),
                follows_from_the_start: damped_from_the_start,
                nominal: nominals[index].get(variable),
            });
            reference += group.len();
            first += group.len();
        }
    }
    entries.extend(parameters.0.iter().map(|settable| Entry {
        variable: table::variable(settable.parameter.name),
        group: settable.group.map(|group| &scene.contacts[group]),
        reference: settable.reference,
        count: 1,
        start: Some(settable.parameter.value),
        dependencies: Vec::new(),
        follows: None,
        follows_from_the_start: false,
        nominal: None,
    }));
    entries
}

/// A parameter that can be set.
struct SettableParameter<'a> {
    parameter: &'a Parameter,
    /// None if it belongs to all contacts.
    group: Option<usize>,
    reference: usize,
}

/// The parameters that can be set: first those of all contacts, then group by group.
struct Parameters<'a>(Vec<SettableParameter<'a>>);

impl<'a> Parameters<'a> {
    fn of(scene: &'a Scene, first: usize) -> Parameters<'a> {
        let shared = scene.parameters.iter().map(|parameter| (None, parameter));
        let groups = scene.contacts.iter().enumerate();
        let own = groups.flat_map(|(index, group)| group.own.iter().map(move |parameter| (Some(index), parameter)));
        let settable = shared.chain(own).filter(|(_, parameter)| parameter.settable).enumerate();
        let settable = settable.map(|(index, (group, parameter))| SettableParameter {
            parameter,
            group,
            reference: first + index,
        });
        Parameters(settable.collect())
    }

    /// References of those that hold for `group` and that `wanted` names.
    fn of_group(&self, group: usize, wanted: impl Fn(&str) -> bool) -> Vec<usize> {
        let shared = self.0.iter().take_while(|settable| settable.group.is_none());
        let begin = self.0.partition_point(|settable| settable.group < Some(group));
        let own = || self.0[begin..].iter().take_while(|settable| settable.group == Some(group));
        let replaced = |name: &str| own().any(|settable| settable.parameter.name == name);
        let shared = shared.filter(|settable| !replaced(settable.parameter.name));
        // in the order of the table, as in a unit of one contact
        let mut all: Vec<_> = shared.chain(own()).filter(|settable| wanted(settable.parameter.name)).collect();
        all.sort_by_key(|settable| settable.reference);
        all.into_iter().map(|settable| settable.reference).collect()
    }
}
