//! Groups of equal contacts, and their parameters.

use brinell_contact::Surface;

/// A parameter of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    pub name: &'static str,
    pub value: f64,
    /// Whether it can be set; otherwise it is a constant of the FMU.
    pub settable: bool,
    /// Whether each contact of a group has its own value.
    pub per_contact: bool,
}

impl Parameter {
    /// A parameter that contacts share.
    pub fn shared(name: &'static str, value: f64, settable: bool) -> Parameter {
        Parameter { name, value, settable, per_contact: false }
    }
}

/// One contact or several equal ones: a table `[[contact]]`, or the contact of a scene without such tables.
#[derive(Clone, Debug)]
pub struct Group {
    /// `None` for the single contact of a scene without `[[contact]]`, whose variables have plain names.
    pub name: Option<String>,
    /// The number of contacts in the group, if their names are counted.
    pub count: Option<usize>,
    /// The parameters of this group that override those of all contacts, in the order of the table.
    pub own: Vec<Parameter>,
    pub surface: Surface,
    /// Density of the target [kg/m^3], if known. It is not a variable; it limits the speeds for which the law is valid.
    pub density: Option<f64>,
    /// Yield strength of the impactor [Pa], if known. It is a variable only where the impactor may be the softer body.
    pub impactor_strength: Option<f64>,
}

impl Group {
    /// The number of contacts in the group.
    pub fn len(&self) -> usize {
        self.count.unwrap_or(1)
    }

    /// The prefix of the variables of a contact, counted from 0: "", "left." or "contact\[7].".
    pub fn prefix(&self, index: usize) -> String {
        match (&self.name, self.count) {
            (None, _) => String::new(),
            (Some(name), None) => format!("{name}."),
            (Some(name), Some(_)) => format!("{name}[{}].", index + 1),
        }
    }

    /// One name for all contacts of the group: "left", or "bead\[1..1000]".
    pub fn label(&self) -> String {
        match (&self.name, self.count) {
            (Some(name), Some(count @ 2..)) => format!("{name}[1..{count}]"),
            _ => self.prefix(0).trim_end_matches('.').into(),
        }
    }

    /// The name in the FMU of the parameter `name` that all contacts of the group share.
    pub fn variable(&self, name: &str) -> String {
        self.name.as_ref().map_or(name.into(), |own| format!("{own}.{name}"))
    }

    /// The name in the FMU of the group's own `parameter`, for the contact with this `index`.
    pub fn own_variable(&self, parameter: &Parameter, index: usize) -> String {
        match parameter.per_contact {
            true => self.prefix(index) + parameter.name,
            false => self.variable(parameter.name),
        }
    }

    /// The number of variables for the group's own `parameter`.
    pub fn variables_of(&self, parameter: &Parameter) -> usize {
        if parameter.per_contact { self.len() } else { 1 }
    }
}
