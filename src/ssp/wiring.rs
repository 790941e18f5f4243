//! The other FMUs of a system, and their connections.

use super::document::{COMPONENT, of_kind};
use super::values::{base_of, units_of};
use crate::importer::{self, Base, ImportError, VariableUnit};
use brinell_exporter::layout::{shortened, shown};
use brinell_exporter::nearest::nearest_first;
use brinell_exporter::numbers::in_message;
use brinell_exporter::plan::Plan;
use brinell_exporter::table::{Causality, Type};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::{fs, io};

/// A connection that is not possible.
#[derive(Debug, thiserror::Error)]
pub enum WiringError {
    #[error("{path}: {source}", path = shown(path))]
    Unreadable { path: PathBuf, source: io::Error },
    #[error("{path}: {source}", path = shown(path))]
    Component { path: PathBuf, source: ImportError },
    #[error("{path}: its fmiVersion is `{version}`; a system takes FMUs of 2.0 for co-simulation", path = shown(path))]
    Version { path: PathBuf, version: String },
    #[error("{path}: the FMU would be called `{name}`; only letters, digits, `_` and `-` are allowed", path = shown(path))]
    Name { path: PathBuf, name: String },
    #[error("{path}: the system already has an FMU `{name}`; give the file another name", path = shown(path))]
    Twice { path: PathBuf, name: String },
    #[error("--connect {0}: write a connection as FMU.OUTPUT=FMU.INPUT, such as contact.mean_force=mass.force")]
    Form(String),
    #[error("--connect {connection}: there is no FMU `{name}`; the system has {allowed}")]
    NoUnit { connection: String, name: String, allowed: String },
    #[error("--connect {connection}: {unit} has no {kind} `{name}` of type Real; it has {allowed}")]
    NoVariable { connection: String, unit: String, kind: &'static str, name: String, allowed: String },
    #[error("--connect {connection}: the input {input} is already connected")]
    Taken { connection: String, input: String },
    #[error("--connect {connection}: {from} and {to} are different quantities")]
    Quantity { connection: String, from: String, to: String },
    #[error(
        "--connect {connection}: {from} and {to}: tools such as fmpy pass numbers on unconverted, {words}; give both FMUs the \
         same unit, or put a gain between them"
    )]
    Size { connection: String, from: String, to: String, words: String },
}

impl WiringError {
    /// Whether the arguments are wrong, and not a file.
    pub fn is_in_call(&self) -> bool {
        use WiringError::{Form, NoUnit, NoVariable, Quantity, Size, Taken};
        matches!(self, Form(_) | NoUnit { .. } | NoVariable { .. } | Taken { .. } | Quantity { .. } | Size { .. })
    }
}

/// What can be connected.
struct Component {
    name: String,
    inputs: Variables,
    outputs: Variables,
}

/// Variables by name, with their units if they state any.
type Variables = BTreeMap<String, Option<VariableUnit>>;

/// One end of a connection.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct End {
    pub unit: String,
    pub variable: String,
}

impl std::fmt::Display for End {
    fn fmt(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(to, "{}.{}", self.unit, self.variable)
    }
}

/// Another FMU of the system.
pub struct Peer {
    pub name: String,
    pub bytes: Vec<u8>,
}

impl Peer {
    /// Its path in the package.
    pub fn file(&self) -> String {
        format!("resources/{}.fmu", self.name)
    }
}

/// The other FMUs, and the connections.
#[derive(Default)]
pub struct Wiring {
    pub peers: Vec<Peer>,
    /// From outputs to inputs.
    pub connections: Vec<(End, End)>,
    /// The units of the connected variables that state one.
    pub units: BTreeMap<End, VariableUnit>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

impl Wiring {
    /// Reads the FMUs at `with`, and checks the connections.
    ///
    /// # Errors
    /// [`WiringError`]
    pub fn read(plan: &Plan, with: &[PathBuf], connect: &[String]) -> Result<Wiring, WiringError> {
        let mut units = vec![contact(plan)];
        let mut wiring = Wiring::default();
        for path in with {
            let unit = unit(path, plan, &units)?;
            let bytes = fs::read(path).map_err(|source| WiringError::Unreadable { path: path.clone(), source })?;
            wiring.peers.push(Peer { name: unit.name.clone(), bytes });
            units.push(unit);
        }
        for text in connect {
            let (from, to) = connection(text, &units)?;
            if wiring.connections.iter().any(|(_, connected)| *connected == to) {
                return Err(WiringError::Taken { connection: text.clone(), input: to.to_string() });
            }
            let ends = [(&from, false), (&to, true)].map(|(end, is_input)| {
                let unit = units.iter().find(|unit| unit.name == end.unit);
                unit.and_then(|unit| if is_input { &unit.inputs } else { &unit.outputs }.get(&end.variable)?.as_ref())
            });
            wiring.warnings.extend(compared(text, [&from, &to], ends)?);
            for (end, unit) in [&from, &to].into_iter().zip(ends) {
                wiring.units.extend(unit.map(|unit| (end.clone(), unit.clone())));
            }
            wiring.connections.push((from, to));
        }
        wiring.tell_units_apart(plan);
        Ok(wiring)
    }

    /// Gives a unit of another FMU its component's name, too, if the system already has another unit of the same name.
    fn tell_units_apart(&mut self, plan: &Plan) {
        let own = units_of(plan.variables.iter()).into_iter().map(|(name, base)| (name.to_string(), base));
        let mut listed: BTreeMap<String, Base> = own.collect();
        for (end, unit) in &mut self.units {
            let Some(base) = &unit.base else { continue };
            if listed.get(&unit.name).is_some_and(|known| known != base) {
                unit.name = format!("{} ({})", unit.name, end.unit);
            }
            listed.entry(unit.name.clone()).or_insert_with(|| base.clone());
        }
    }

    /// The connected variables of the component `name`, each once: its inputs if `input`, otherwise its outputs.
    pub fn connected(&self, name: &str, input: bool) -> BTreeSet<&str> {
        let ends = self.connections.iter().map(|(from, to)| if input { to } else { from });
        ends.filter(|end| end.unit == name).map(|end| end.variable.as_str()).collect()
    }
}

/// The contact itself.
fn contact(plan: &Plan) -> Component {
    let names = |causality| {
        let entries = of_kind(plan, causality).filter(|entry| entry.variable.r#type == Type::Real);
        entries
            .flat_map(|entry| {
                let name = entry.variable.unit.clone().unwrap_or_default();
                let unit = VariableUnit { name, base: Some(base_of(entry.variable)) };
                (0..entry.count).map(move |index| (entry.name(index), Some(unit.clone())))
            })
            .collect()
    };
    Component { name: COMPONENT.into(), inputs: names(Causality::Input), outputs: names(Causality::Output) }
}

/// Compares the units of the two `ends` of a connection. Returns a warning if one of them is unknown.
fn compared(text: &str, ends: [&End; 2], units: [Option<&VariableUnit>; 2]) -> Result<Option<String>, WiringError> {
    let said = |index: usize| match units[index] {
        None => format!("{} (no unit)", ends[index]),
        Some(unit) if unit.name.is_empty() => format!("{} (a number)", ends[index]),
        Some(unit) => format!("{} [{}]", ends[index], shortened(&unit.name)),
    };
    let [from, to] = [said(0), said(1)];
    let bases = units.map(|unit| unit.and_then(|unit| unit.base.as_ref()));
    let connection = shortened(text);
    let [Some(one), Some(other)] = bases else {
        // of two that state nothing, or the same name without a definition, nothing can be said
        let same = units[0].map(|unit| &unit.name) == units[1].map(|unit| &unit.name);
        let warning =
            format!("--connect {connection}: {from} and {to} can't be compared; they must have the same unit");
        return Ok((!same).then_some(warning));
    };
    if one.powers != other.powers {
        return Err(WiringError::Quantity { connection, from, to });
    }
    let factor = one.factor / other.factor;
    let words = match one.offset == other.offset {
        // the rounding of a written factor
        true if (factor - 1.0).abs() < 1e-9 => return Ok(None),
        true => format!("here {} times too small or too large", in_message(factor.max(1.0 / factor))),
        false => "and here the zeros differ".into(),
    };
    Err(WiringError::Size { connection, from, to, words })
}

/// The FMU at `path`, named after its file.
fn unit(path: &Path, plan: &Plan, others: &[Component]) -> Result<Component, WiringError> {
    let description =
        importer::description_in(path).map_err(|source| WiringError::Component { path: path.into(), source })?;
    if description.fmi_version != "2.0" || description.identifier.is_empty() {
        return Err(WiringError::Version { path: path.into(), version: description.fmi_version });
    }
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    if !name.chars().all(|character| character.is_ascii_alphanumeric() || "_-".contains(character)) {
        return Err(WiringError::Name { path: path.into(), name });
    }
    // the file of the contact has the name of the scene
    if name == plan.scene.name || others.iter().any(|other| other.name == name) {
        return Err(WiringError::Twice { path: path.into(), name });
    }
    let names =
        |causality| description.reals(causality).map(|(name, unit)| (name.to_string(), unit.cloned())).collect();
    Ok(Component { name, inputs: names(importer::Causality::Input), outputs: names(importer::Causality::Output) })
}

fn connection(text: &str, units: &[Component]) -> Result<(End, End), WiringError> {
    let form = || WiringError::Form(text.into());
    let end = |part: &str, kind: &'static str| {
        let (name, variable) = part.split_once('.').ok_or_else(form)?;
        let unit = units.iter().find(|unit| unit.name == name).ok_or_else(|| WiringError::NoUnit {
            connection: text.into(),
            name: name.into(),
            allowed: list(name, units.iter().map(|unit| unit.name.as_str())),
        })?;
        let variables = if kind == "input" { &unit.inputs } else { &unit.outputs };
        if !variables.contains_key(variable) {
            return Err(WiringError::NoVariable {
                connection: text.into(),
                unit: name.into(),
                kind,
                name: variable.into(),
                allowed: list(variable, variables.keys().map(String::as_str)),
            });
        }
        Ok(End { unit: name.into(), variable: variable.into() })
    };
    let (from, to) = text.split_once('=').ok_or_else(form)?;
    Ok((end(from, "output")?, end(to, "input")?))
}

/// The names, in words; of many, those that are nearest to `asked`.
fn list<'a>(asked: &str, names: impl Iterator<Item = &'a str>) -> String {
    const SHOWN: usize = 20;
    let mut names: Vec<_> = names.collect();
    if names.len() > SHOWN {
        names = nearest_first(asked, &names);
    }
    let more = if names.len() > SHOWN { format!(" and {} more", names.len() - SHOWN) } else { String::new() };
    match names.len() {
        0 => "none".into(),
        _ => names.into_iter().take(SHOWN).collect::<Vec<_>>().join(", ") + &more,
    }
}
