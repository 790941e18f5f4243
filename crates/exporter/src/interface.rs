//! The variables of the FMU of a scene, in order. XML, constants and documentation are all made from this list.

use crate::nominal;
use crate::scene::{Group, InverseMasses, Parameter, Scene, SceneLaws};
use crate::table::{self, Causality, Feature, Follows, VARIABLES, Variable};
use brinell_contact::damped::Damped;

/// Variables of one kind: one for each contact of a group, or a parameter. Value references number them all in the order of the
/// list; the indices in the model description have the same order.
pub struct Entry<'a> {
    pub variable: &'static Variable,
    /// Its description in this FMU.
    pub description: &'static str,
    /// Its minimum.
    pub minimum: Option<f64>,
    /// Its group; `None` for a parameter of all contacts.
    pub group: Option<&'a Group>,
    /// Value reference of the first variable.
    pub reference: usize,
    /// Number of variables.
    pub count: usize,
    /// Whether each contact of the group has its own variable.
    pub per_contact: bool,
    /// Start value, for inputs and parameters.
    pub start: Option<f64>,
    /// The parameters on which the values before the first step depend.
    pub dependencies: Vec<Dependency>,
    /// Reference of the input on which the first variable depends at the same instant; the second variable depends on the next
    /// input, and so on.
    pub follows: Option<usize>,
    /// References of the tangential rates on which the first variable depends at the same instant.
    pub follows_tangential: Vec<usize>,
    /// The same as for `follows` before the first step.
    pub follows_at_start: Option<usize>,
    pub nominal: Option<f64>,
    /// Whether it is the first of two directions.
    is_first: bool,
    /// Row and column of the first, counted from 0, if they are inverse masses in a row of their matrix.
    cell: Option<(usize, usize)>,
}

/// A parameter on which an output of a contact depends.
pub struct Dependency {
    /// Value reference; for several contacts, that of the first contact of the group.
    reference: usize,
    /// Whether each contact of the group has its own.
    per_contact: bool,
}

impl Dependency {
    /// The value reference of the parameter for the contact with this `index` in its group.
    pub fn of(&self, index: usize) -> usize {
        if self.per_contact { self.reference + index } else { self.reference }
    }
}

impl Entry<'_> {
    /// The name of the variable with this `index`.
    pub fn name(&self, index: usize) -> String {
        let name = &self.variable.name;
        match self.group {
            Some(group) if self.per_contact => format!("{}{}", group.prefix(index), self.component()),
            Some(group) => group.variable(name),
            None => match self.cell {
                Some((row, column)) => format!("{name}[{},{}]", row + 1, column + index + 1),
                None => name.clone(),
            },
        }
    }

    /// The name of the variable of one contact: with its index, if it is the component of a vector.
    pub fn component(&self) -> String {
        format!("{}{}", self.variable.name, if self.is_first { "[1]" } else { "" })
    }

    /// One name for all of the variables: `contact[1..1000].force`.
    pub fn label(&self) -> String {
        let (first, last) = (self.name(0), self.name(self.count - 1));
        match self.count {
            1 => first,
            _ if self.cell.is_some() => format!("{first} to {}", last.trim_start_matches(INVERSE_MASS)),
            count => last.replacen(&format!("[{count}]"), &format!("[1..{count}]"), 1),
        }
    }
}

/// The variables of the FMU of the scene, which has these `kinds`.
pub fn entries<'a>(scene: &'a Scene, kinds: &[Feature]) -> Vec<Entry<'a>> {
    let shown = |variable: &&'static Variable| match variable.causality {
        Causality::Input => variable.name == "indentation_rate" || scene.has_input(&variable.name),
        Causality::Output => match &variable.second_of {
            Some(first) => scene.directions > 1 && scene.outputs.contains(first),
            None => variable.name == "force" || scene.outputs.contains(&variable.name),
        },
        Causality::Parameter => false,
    };
    let shown: Vec<_> = VARIABLES.iter().filter(shown).collect();
    let parameters = Parameters::of(scene, shown.len() * scene.contact_count());
    let nominals = nominal::of(scene);
    let tangential_rates: Vec<_> = ["tangential_rate", "tangential_rate[2]"]
        .iter()
        .filter_map(|name| shown.iter().position(|variable| variable.name == *name))
        .collect();
    let mut entries = Vec::new();
    let mut reference = 0;
    for variable in shown {
        let mut first = 0;
        let has_damping = match variable.follows_rate {
            Follows::Never | Follows::AtStart => false,
            Follows::WithLaw => scene.follows_rate(),
            Follows::Always => true,
        };
        // with a law that depends on the rate, bodies that the FMU moves have their own speed from the first step on
        let has_own_speed = scene.coupling.is_some() && scene.follows_rate();
        let follows = has_damping && !has_own_speed;
        let damped_at_start = has_damping && scene.is_rate_dependent();
        let follows_at_start = damped_at_start || variable.follows_rate == Follows::AtStart;
        let is_listed = |name: &str| variable.depends_on.iter().any(|other| other == "*" || other == name);
        let depends = |name: &str| match name {
            // they affect only the damping
            "restitution" | "elastic_restitution" => damped_at_start,
            // without a motion the plate doesn't give way, and there is no tangential force
            "target.plate_thickness" | "friction.coefficient" => false,
            "effective_mass" => {
                damped_at_start && scene.damps_by_mass() || is_listed(name) && elastic_part_follows_mass(scene)
            }
            _ => is_listed(name),
        };
        for (index, group) in scene.contacts.iter().enumerate() {
            entries.push(Entry {
                variable,
                description: variable.description(kinds),
                minimum: variable.minimum(kinds),
                group: Some(group),
                reference,
                count: group.size(),
                per_contact: true,
                start: (variable.causality == Causality::Input).then(|| start(variable, scene, index)),
                dependencies: parameters.of_group(index, depends),
                follows: follows.then_some(first),
                follows_tangential: tangential_rates
                    .iter()
                    .filter(|_| variable.follows_tangential_rate == Follows::Always)
                    .map(|place| place * scene.contact_count() + first)
                    .collect(),
                follows_at_start: follows_at_start.then_some(first).or_else(|| {
                    let direction = usize::from(variable.second_of.is_some());
                    let place = tangential_rates.get(direction)?;
                    let follows = variable.follows_tangential_rate == Follows::AtStart;
                    follows.then_some(place * scene.contact_count() + first)
                }),
                nominal: nominals[index].get(variable),
                is_first: scene.directions > 1 && has_second(variable),
                cell: None,
            });
            reference += group.size();
            first += group.size();
        }
    }
    entries.extend(parameters.0.iter().map(|settable| Entry {
        variable: table::variable(settable.parameter.name),
        description: table::variable(settable.parameter.name).description(kinds),
        minimum: table::variable(settable.parameter.name).minimum,
        group: settable.group.map(|group| &scene.contacts[group]),
        reference: settable.reference,
        count: settable.count,
        per_contact: settable.parameter.per_contact,
        start: Some(settable.parameter.value),
        dependencies: Vec::new(),
        follows: None,
        follows_tangential: Vec::new(),
        is_first: false,
        cell: None,
        follows_at_start: None,
        nominal: None,
    }));
    let variable = table::variable(INVERSE_MASS);
    let contacts = if inverse_mass_inputs(scene) > 0 { scene.rows() } else { 0 };
    // before they are set, the contacts share no body, and each has the mass of the impact
    let cells = (0..contacts).flat_map(|row| {
        let rest = contacts - row - 1;
        [((row, row), 1, 1.0 / scene.impact.mass), ((row, row + 1), rest, 0.0)]
    });
    for (cell, count, start) in cells.filter(|(_, count, _)| *count > 0) {
        entries.push(Entry {
            variable,
            description: variable.description(kinds),
            minimum: None,
            group: None,
            reference: entries.last().map_or(0, |last| last.reference + last.count),
            count,
            per_contact: false,
            start: Some(start),
            dependencies: Vec::new(),
            follows: None,
            follows_tangential: Vec::new(),
            is_first: false,
            follows_at_start: None,
            nominal: None,
            cell: Some(cell),
        });
    }
    entries
}

/// The name of the inputs for the inverse masses of contacts that share bodies, before their indices.
pub const INVERSE_MASS: &str = "inverse_mass";

/// The number of these inputs: the upper triangle of the matrix.
pub fn inverse_mass_inputs(scene: &Scene) -> usize {
    let rows = scene.rows();
    if scene.inverse_masses() == Some(&InverseMasses::Inputs) { rows * (rows + 1) / 2 } else { 0 }
}

/// Whether `variable` has a second direction.
fn has_second(variable: &Variable) -> bool {
    VARIABLES.iter().any(|other| other.second_of.as_ref() == Some(&variable.name))
}

/// Whether the parameter `name` can also be set between steps: the mass of bodies that the FMU moves, if the damping of its law
/// doesn't follow from it.
pub fn is_tunable(scene: &Scene, name: &str) -> bool {
    name == "effective_mass" && scene.coupling.is_some() && !scene.damps_by_mass()
}

/// The start value of the input `variable` for the contacts of `group`.
fn start(variable: &Variable, scene: &Scene, group: usize) -> f64 {
    // the mass is the only input with a value in the scene
    scene.group_value(group, &variable.name).unwrap_or(0.0)
}

/// Whether the elastic part of a rate-dependent law also depends on the mass.
fn elastic_part_follows_mass(scene: &Scene) -> bool {
    let pair = scene.model().pair;
    matches!(scene.laws, SceneLaws::Damped(_, law) if law.parts(&pair, 0.5, 1.0).0 != law.parts(&pair, 0.5, 2.0).0)
}

/// A parameter that can be set.
struct SettableParameter<'a> {
    parameter: &'a Parameter,
    /// `None` if it belongs to all contacts.
    group: Option<usize>,
    /// Value reference of the first.
    reference: usize,
    count: usize,
}

/// The parameters that can be set: first those of all contacts, then those of each group.
struct Parameters<'a>(Vec<SettableParameter<'a>>);

impl<'a> Parameters<'a> {
    fn of(scene: &'a Scene, first: usize) -> Parameters<'a> {
        let shared = scene.parameters.iter().map(|parameter| (None, parameter));
        let groups = scene.contacts.iter().enumerate();
        let own = groups.flat_map(|(index, group)| group.own.iter().map(move |parameter| (Some(index), parameter)));
        let settable = shared.chain(own).filter(|(_, parameter)| parameter.settable);
        let mut end = first;
        let settable = settable.map(|(group, parameter)| {
            let count = group.map_or(1, |group| scene.contacts[group].variables_of(parameter));
            end += count;
            SettableParameter { parameter, group, reference: end - count, count }
        });
        Parameters(settable.collect())
    }

    /// Those that apply to `group` and satisfy `wanted`.
    fn of_group(&self, group: usize, wanted: impl Fn(&str) -> bool) -> Vec<Dependency> {
        let shared = self.0.iter().take_while(|settable| settable.group.is_none());
        let begin = self.0.partition_point(|settable| settable.group < Some(group));
        let own = || self.0[begin..].iter().take_while(|settable| settable.group == Some(group));
        let replaced = |name: &str| own().any(|settable| settable.parameter.name == name);
        let shared = shared.filter(|settable| !replaced(settable.parameter.name));
        // in the order of the table, as in an FMU with one contact
        let mut all: Vec<_> = shared.chain(own()).filter(|settable| wanted(settable.parameter.name)).collect();
        all.sort_by_key(|settable| settable.reference);
        let dependency = |settable: &SettableParameter| Dependency {
            reference: settable.reference,
            per_contact: settable.parameter.per_contact,
        };
        all.into_iter().map(dependency).collect()
    }
}
