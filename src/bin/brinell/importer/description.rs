//! The contents of a model description.

use super::ImportError;
use crate::xml;
use quick_xml::events::{BytesStart, Event};
use std::collections::HashMap;

/// A variable of the model description.
#[derive(Clone, Debug)]
pub struct Variable {
    pub reference: u32,
    pub is_real: bool,
    pub causality: String,
    /// Start value of a Real variable.
    pub start: Option<f64>,
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
    /// Variables by name.
    pub variables: HashMap<String, Variable>,
}

impl Description {
    pub fn parse(text: &str) -> Result<Description, ImportError> {
        if let Some((place, character)) = xml::forbidden(text) {
            let (line, column) = place_of(&text[..place]);
            return Err(not_xml(character, &format!(" at {line}:{column}")));
        }
        let mut reader = quick_xml::Reader::from_str(text);
        let mut description = Description::default();
        let mut current = None;
        let wrong = |error: &dyn std::fmt::Display| ImportError::Xml(error.to_string());
        loop {
            match reader.read_event().map_err(|error| wrong(&error))? {
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
                            let reference = get("valueReference").parse().map_err(|error| wrong(&error))?;
                            current = Some((get("name"), reference, get("causality")));
                        }
                        kind @ ("Real" | "Integer" | "Enumeration") => {
                            if let Some((name, reference, causality)) = current.take() {
                                let start = attributes.get("start").map(|start| start.parse());
                                let start = start.transpose().map_err(|error| wrong(&error))?;
                                let variable = Variable { reference, is_real: kind == "Real", causality, start };
                                description.variables.insert(name, variable);
                            }
                        }
                        _ => {}
                    }
                }
                Event::GeneralRef(reference) => {
                    let character = reference.resolve_char_ref().map_err(|error| wrong(&error))?;
                    check_characters(&character.map(String::from).unwrap_or_default())?;
                }
                _ => {}
            }
        }
    }

    /// The value reference of the Real variable `name`.
    pub fn real(&self, name: &str) -> Result<u32, ImportError> {
        let variable = self.variables.get(name).filter(|variable| variable.is_real);
        variable.map(|variable| variable.reference).ok_or_else(|| ImportError::Variable(name.into()))
    }
}

fn attributes(element: &BytesStart) -> Result<HashMap<String, String>, ImportError> {
    let mut map = HashMap::new();
    for attribute in element.attributes() {
        let attribute = attribute.map_err(|error| ImportError::Xml(error.to_string()))?;
        let name = attribute.key.as_ref().to_string();
        let value = attribute.normalized_value(quick_xml::XmlVersion::Implicit1_0);
        let value = value.map_err(|error| ImportError::Xml(error.to_string()))?.into_owned();
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
    ImportError::Xml(format!("the character {}{place} is none that XML can have", xml::name(character)))
}

/// Line and column at the end of the text `before`.
fn place_of(before: &str) -> (usize, usize) {
    (before.matches('\n').count() + 1, before.chars().rev().take_while(|&c| c != '\n').count() + 1)
}
