//! The contents of a model description.

use super::error::ImportError;
use brinell_exporter::layout::{shortened, without_middle};
use brinell_exporter::numbers::in_words;
use brinell_exporter::xml;
use quick_xml::events::{BytesStart, Event};
use std::collections::HashMap;
use std::io::{self, BufRead};
use std::str::FromStr;

/// A variable of the model description.
#[derive(Clone, Debug)]
pub struct Variable {
    pub reference: u32,
    pub is_real: bool,
    pub causality: Causality,
    /// Start value of a Real variable; NaN if it has none.
    start: f64,
    /// The index of its unit in the description.
    unit: Option<u32>,
}

/// What a unit is in the base units of SI: a number of it is `factor` times itself, plus `offset`.
///
/// Reference: FMI 2.0.4, section 2.2.2.
#[derive(Clone, Debug, PartialEq)]
pub struct Base {
    /// The powers of [`Base::NAMES`].
    pub powers: [i32; 8],
    pub factor: f64,
    pub offset: f64,
}

impl Base {
    pub const NAMES: [&str; 8] = ["kg", "m", "s", "A", "K", "mol", "cd", "rad"];
}

/// A unit that variables have.
#[derive(Clone, Debug, PartialEq)]
pub struct VariableUnit {
    pub name: String,
    /// Unknown if the file doesn't define the unit.
    pub base: Option<Base>,
}

/// The causalities that matter to this importer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Causality {
    Input,
    Output,
    Other,
}

impl Variable {
    /// The start value, if there is one.
    pub fn start(&self) -> Option<f64> {
        Some(self.start).filter(|start| !start.is_nan())
    }
}

/// The model description.
#[derive(Debug, Default)]
pub struct Description {
    pub fmi_version: String,
    /// Model identifier for co-simulation; empty if there is none.
    pub identifier: String,
    pub guid: String,
    /// Whether inputs may have derivatives.
    pub interpolates_inputs: bool,
    /// Highest order of the derivatives of outputs; 0 for none.
    pub output_derivatives: u32,
    /// Variables with their names, in the order of the names. There may be millions of them.
    pub variables: Vec<(Box<str>, Variable)>,
    units: Vec<VariableUnit>,
}

impl Description {
    /// Reads a model description piece by piece, twice.
    ///
    /// # Errors
    /// [`ImportError::Xml`], [`ImportError::Part`]
    pub fn read<R: BufRead>(open: impl Fn() -> io::Result<R>) -> Result<Description, ImportError> {
        let unreadable = |source| ImportError::Part { name: "modelDescription.xml", source };
        check_lines(open().map_err(unreadable)?)?;
        let mut description = Description::parse(open().map_err(unreadable)?)?;
        description.variables.sort_by(|(one, _), (other, _)| one.cmp(other));
        description.variables.shrink_to_fit();
        Ok(description)
    }

    fn parse(from: impl BufRead) -> Result<Description, ImportError> {
        let mut reader = quick_xml::Reader::from_reader(from);
        let mut description = Description::default();
        let (mut current, mut piece) = (None, Vec::new());
        // the units of the types by name, and the type that is being read
        let (mut types, mut r#type) = (HashMap::new(), None);
        let wrong = |error: &dyn std::fmt::Display| invalid(&error.to_string());
        loop {
            piece.clear();
            match reader.read_event_into(&mut piece).map_err(|error| wrong(&error))? {
                Event::Eof => return Ok(description),
                Event::Start(element) | Event::Empty(element) => {
                    let attributes = attributes(&element)?;
                    let get = |name: &str| attributes.get(name).cloned().unwrap_or_default();
                    match element.name().as_ref() {
                        "fmiModelDescription" => {
                            (description.guid, description.fmi_version) = (get("guid"), get("fmiVersion"));
                        }
                        "CoSimulation" => {
                            description.identifier = get("modelIdentifier");
                            description.interpolates_inputs =
                                matches!(get("canInterpolateInputs").as_str(), "true" | "1");
                            description.output_derivatives = get("maxOutputDerivativeOrder").parse().unwrap_or(0);
                        }
                        "ScalarVariable" => {
                            let reference = number(&get("valueReference"), &get("name"), "valueReference")?;
                            current = Some((get("name"), reference, Causality::named(&get("causality"))));
                        }
                        "Unit" => description.units.push(VariableUnit { name: get("name"), base: None }),
                        "BaseUnit" => {
                            if let Some(unit) = description.units.last_mut() {
                                unit.base = Some(base(&attributes, &unit.name)?);
                            }
                        }
                        "SimpleType" => r#type = Some(get("name")),
                        "Real" if current.is_none() => {
                            if let (Some(name), Some(unit)) = (r#type.take(), attributes.get("unit")) {
                                types.insert(name, unit.clone());
                            }
                        }
                        kind @ ("Real" | "Integer" | "Enumeration") => {
                            let unit = attributes.get("unit").or_else(|| types.get(&get("declaredType")));
                            let unit = unit.map(|name| description.unit(name));
                            if let Some((name, reference, causality)) = current.take() {
                                let start = attributes.get("start").map(|start| number(start, &name, "start"));
                                let start = start.transpose()?.unwrap_or(f64::NAN);
                                let variable = Variable { reference, is_real: kind == "Real", causality, start, unit };
                                description.variables.push((name.into(), variable));
                            }
                        }
                        _ => {}
                    }
                }
                // an entity of it could be a file of this machine, or grow without end
                Event::DocType(_) => {
                    return Err(invalid("it has a document type, which no model description has"));
                }
                Event::GeneralRef(reference) => {
                    let character = reference.resolve_char_ref().map_err(|error| wrong(&error))?;
                    check_characters(&character.map(String::from).unwrap_or_default())?;
                }
                _ => {}
            }
        }
    }

    /// The index of the unit with this name; a new one has no definition.
    fn unit(&mut self, name: &str) -> u32 {
        let index = self.units.iter().position(|unit| unit.name == name).unwrap_or_else(|| {
            self.units.push(VariableUnit { name: name.into(), base: None });
            self.units.len() - 1
        });
        u32::try_from(index).unwrap_or(u32::MAX)
    }

    /// The value reference of the Real variable `name`.
    pub fn real(&self, name: &str) -> Result<u32, ImportError> {
        let found = self.variables.binary_search_by(|(other, _)| (**other).cmp(name));
        let variable = found.ok().map(|place| &self.variables[place].1).filter(|variable| variable.is_real);
        variable.map(|variable| variable.reference).ok_or_else(|| ImportError::Variable(name.into()))
    }

    /// Names of the Real variables of this causality, with their units.
    pub fn reals(&self, causality: Causality) -> impl Iterator<Item = (&str, Option<&VariableUnit>)> {
        let reals =
            self.variables.iter().filter(move |(_, variable)| variable.is_real && variable.causality == causality);
        reals.map(|(name, variable)| (&**name, variable.unit.and_then(|index| self.units.get(index as usize))))
    }
}

impl Causality {
    fn named(name: &str) -> Causality {
        match name {
            "input" => Causality::Input,
            "output" => Causality::Output,
            _ => Causality::Other,
        }
    }
}

/// The definition of the unit `name` in these attributes.
fn base(attributes: &HashMap<String, String>, name: &str) -> Result<Base, ImportError> {
    let mut base = Base { powers: [0; 8], factor: 1.0, offset: 0.0 };
    for (power, key) in base.powers.iter_mut().zip(Base::NAMES) {
        *power = attributes.get(key).map_or(Ok(0), |text| number(text, name, key))?;
    }
    for (value, key, usual) in [(&mut base.factor, "factor", 1.0), (&mut base.offset, "offset", 0.0)] {
        *value = attributes.get(key).map_or(Ok(usual), |text| number(text, name, key))?;
    }
    Ok(base)
}

/// The number `text` of an attribute of `variable`. XML Schema allows spaces around it.
fn number<T: FromStr>(text: &str, variable: &str, attribute: &str) -> Result<T, ImportError>
where
    T::Err: std::fmt::Display,
{
    text.trim_matches([' ', '\t', '\r', '\n']).parse().map_err(|error: T::Err| {
        let (text, variable) = (shortened(text), shortened(variable));
        let error = in_words(&error.to_string());
        ImportError::Xml(format!("{variable:?} has {attribute} = {text:?}: {error}"))
    })
}

/// Rejects characters that are invalid in XML, with their position.
fn check_lines(mut from: impl BufRead) -> Result<(), ImportError> {
    let mut line = Vec::new();
    for number in 1_usize.. {
        line.clear();
        let unreadable = |source| ImportError::Part { name: "modelDescription.xml", source };
        if from.read_until(b'\n', &mut line).map_err(unreadable)? == 0 {
            break;
        }
        let text = str::from_utf8(&line).map_err(|_| ImportError::Xml(format!("line {number} is not UTF-8")))?;
        if let Some((place, character)) = xml::forbidden(text) {
            let column = text[..place].chars().count() + 1;
            return Err(not_xml(character, &format!(" at {number}:{column}")));
        }
    }
    Ok(())
}

fn attributes(element: &BytesStart) -> Result<HashMap<String, String>, ImportError> {
    let mut map = HashMap::new();
    for attribute in element.attributes() {
        let attribute = attribute.map_err(|error| invalid(&error.to_string()))?;
        let name = attribute.key.as_ref().to_string();
        let value = attribute.normalized_value(quick_xml::XmlVersion::Implicit1_0);
        let value = value.map_err(|error| invalid(&error.to_string()))?.into_owned();
        check_characters(&value)?;
        map.insert(name, value);
    }
    Ok(map)
}

/// Rejects characters from references such as `&#1;`.
fn check_characters(text: &str) -> Result<(), ImportError> {
    xml::forbidden(text).map_or(Ok(()), |(_, character)| Err(not_xml(character, &format!(" in {text:?}"))))
}

fn not_xml(character: char, place: &str) -> ImportError {
    invalid(&format!("the character {}{place} is none that XML can have", xml::name(character)))
}

/// The error with this `reason`, which may quote a long text.
fn invalid(reason: &str) -> ImportError {
    ImportError::Xml(without_middle(reason))
}
