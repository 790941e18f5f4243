//! `modelDescription.xml`: capabilities of the FMU, units, variables, and the structure of the model.

use crate::interface::{Entry, is_tunable};
use crate::library;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::table::{Causality, Type, UNITS, Unit};
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};
use std::collections::BTreeSet;
use std::io::{self, Write};

type Xml<'a> = Writer<&'a mut dyn Write>;

/// The log categories of `crates/fmu/src/fmi2/report.rs`.
const LOG_CATEGORIES: [(&str, &str); 4] = [
    (
        "logStatusWarning",
        "the law is not valid there, the passivity guard acts, or the coupling is wrong; each told once, also without loggingOn",
    ),
    ("logStatusDiscard", "information that is not available"),
    ("logStatusError", "refused calls; logged in any case"),
    ("logAll", "all of them"),
];

/// Writes the model description of the planned FMU with the identification `guid`, and the file of its C `source` if it has any. An
/// FMU of 100,000 contacts has 640 MB of it, which are never in memory at once.
///
/// # Errors
/// Those of `to`.
pub fn write(plan: &Plan, guid: &str, source: Option<&str>, to: &mut dyn Write) -> io::Result<()> {
    document(&mut Writer::new_with_indent(&mut *to, b' ', 2), plan, guid, source)?;
    to.write_all(b"\n")
}

fn document(xml: &mut Xml<'_>, plan: &Plan, guid: &str, source: Option<&str>) -> io::Result<()> {
    let Plan { scene, variables: entries, experiment, .. } = plan;
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let tool = concat!("Brinell ", env!("CARGO_PKG_VERSION"));
    let attributes = [
        ("fmiVersion", "2.0"),
        ("modelName", &scene.name),
        ("guid", guid),
        ("description", &scene.description),
        ("author", &scene.author),
        ("generationTool", tool),
        ("variableNamingConvention", if scene.structured_names { "structured" } else { "flat" }),
    ];
    let given = attributes.into_iter().filter(|(_, value)| !value.is_empty());
    xml.create_element("fmiModelDescription").with_attributes(given).write_inner_content(|xml| {
        co_simulation(xml, scene, source)?;
        units(xml, entries)?;
        types(xml, entries)?;
        xml.create_element("LogCategories").write_inner_content(|xml| {
            for (name, description) in LOG_CATEGORIES {
                let category = xml.create_element("Category");
                category.with_attributes([("name", name), ("description", description)]).write_empty()?;
            }
            Ok(())
        })?;
        let times = [("startTime", 0.0), ("stopTime", experiment.stop), ("stepSize", experiment.step)];
        let times = times.map(|(name, value)| (name, number(value)));
        let times = times.iter().map(|(name, value)| (*name, value.as_str()));
        xml.create_element("DefaultExperiment").with_attributes(times).write_empty()?;
        variables(xml, scene, entries)?;
        structure(xml, entries)
    })?;
    Ok(())
}

/// The highest order of the derivative of an output.
fn output_order(scene: &Scene) -> &'static str {
    match scene.is_rate_dependent() {
        true if scene.follows_rate() => "1",
        // the rate of indentation on a plate isn't the input
        true => "0",
        false => "2",
    }
}

fn co_simulation(xml: &mut Xml<'_>, scene: &Scene, source: Option<&str>) -> io::Result<()> {
    let takes_derivatives = library::has_course(scene) && !scene.has_input("external_acceleration");
    let attributes = [
        ("modelIdentifier", scene.name.as_str()),
        ("needsExecutionTool", "false"),
        ("canHandleVariableCommunicationStepSize", "true"),
        ("canInterpolateInputs", if takes_derivatives { "true" } else { "false" }),
        ("maxOutputDerivativeOrder", output_order(scene)),
        ("canRunAsynchronuously", "false"),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canNotUseMemoryManagementFunctions", if scene.standalone { "false" } else { "true" }),
        ("canGetAndSetFMUstate", "true"),
        ("canSerializeFMUstate", "true"),
        ("providesDirectionalDerivative", "true"),
    ];
    let element = xml.create_element("CoSimulation").with_attributes(attributes);
    let Some(file) = source else {
        element.write_empty()?;
        return Ok(());
    };
    element.write_inner_content(|xml| {
        xml.create_element("SourceFiles").write_inner_content(|xml| {
            xml.create_element("File").with_attribute(("name", file)).write_empty()?;
            Ok(())
        })?;
        Ok(())
    })?;
    Ok(())
}

/// The units of the variables, with their display units.
fn units(xml: &mut Xml<'_>, entries: &[Entry]) -> io::Result<()> {
    let used: BTreeSet<_> = entries.iter().filter_map(|entry| entry.variable.unit.as_deref()).collect();
    xml.create_element("UnitDefinitions").write_inner_content(|xml| {
        for unit in UNITS.iter().filter(|unit| used.contains(unit.name.as_str())) {
            xml.create_element("Unit")
                .with_attribute(("name", unit.name.as_str()))
                .write_inner_content(|xml| definition(xml, unit))?;
        }
        Ok(())
    })?;
    Ok(())
}

fn definition(xml: &mut Xml<'_>, unit: &Unit) -> io::Result<()> {
    let exponents = [("kg", unit.kg), ("m", unit.m), ("s", unit.s)];
    let exponents = exponents.into_iter().filter(|(_, exponent)| *exponent != 0);
    let exponents: Vec<_> = exponents.map(|(name, exponent)| (name, exponent.to_string())).collect();
    let exponents = exponents.iter().map(|(name, exponent)| (*name, exponent.as_str()));
    xml.create_element("BaseUnit").with_attributes(exponents).write_empty()?;
    for display in &unit.display {
        let factor = number(display.factor);
        let element = xml.create_element("DisplayUnit");
        element.with_attributes([("name", display.name.as_str()), ("factor", &factor)]).write_empty()?;
    }
    Ok(())
}

/// The enumerations of the variables, with their values.
fn types(xml: &mut Xml<'_>, entries: &[Entry]) -> io::Result<()> {
    let mut used: Vec<_> = entries.iter().map(|entry| entry.variable).collect();
    used.retain(|variable| variable.r#type == Type::Enumeration);
    used.dedup_by_key(|variable| variable.name.as_str());
    // the schema allows no empty list
    if used.is_empty() {
        return Ok(());
    }
    xml.create_element("TypeDefinitions").write_inner_content(|xml| {
        for variable in used {
            let name = variable.symbol().to_string();
            let name = [("name", name.as_str())];
            xml.create_element("SimpleType").with_attributes(name).write_inner_content(|xml| {
                xml.create_element("Enumeration").write_inner_content(|xml| {
                    for (value, item) in variable.items.iter().enumerate() {
                        let value = value.to_string();
                        let item = [("name", &item.name), ("value", &value), ("description", &item.description)];
                        let item = item.map(|(name, value)| (name, value.as_str()));
                        xml.create_element("Item").with_attributes(item).write_empty()?;
                    }
                    Ok(())
                })?;
                Ok(())
            })?;
        }
        Ok(())
    })?;
    Ok(())
}

fn variables(xml: &mut Xml<'_>, scene: &Scene, entries: &[Entry]) -> io::Result<()> {
    xml.create_element("ModelVariables").write_inner_content(|xml| {
        for entry in entries {
            for index in 0..entry.count {
                scalar_variable(xml, scene, entry, index)?;
            }
        }
        Ok(())
    })?;
    Ok(())
}

fn scalar_variable(xml: &mut Xml<'_>, scene: &Scene, entry: &Entry, index: usize) -> io::Result<()> {
    let variable = entry.variable;
    let (causality, variability, initial) = match (variable.causality, variable.r#type) {
        (Causality::Input, _) => ("input", "continuous", ""),
        (Causality::Output, Type::Real) if variable.held => ("output", "discrete", "calculated"),
        (Causality::Output, Type::Real) => ("output", "continuous", "calculated"),
        (Causality::Output, Type::Enumeration) => ("output", "discrete", "calculated"),
        (Causality::Parameter, _) if is_tunable(scene, &variable.name) => ("parameter", "tunable", "exact"),
        (Causality::Parameter, _) => ("parameter", "fixed", "exact"),
    };
    let (name, reference) = (entry.name(index), (entry.reference + index).to_string());
    let attributes = [
        ("name", name.as_str()),
        ("valueReference", &reference),
        ("description", entry.description),
        ("causality", causality),
        ("variability", variability),
        ("initial", initial),
    ];
    let given = attributes.into_iter().filter(|(_, value)| !value.is_empty());
    let real = variable.r#type == Type::Real;
    let limit = |value: Option<f64>| value.map(number).unwrap_or_default();
    let declared = if real { String::new() } else { variable.symbol().to_string() };
    let kind = [
        ("declaredType", declared),
        ("unit", variable.unit.clone().unwrap_or_default()),
        ("displayUnit", variable.display_unit.clone().unwrap_or_default()),
        ("min", limit(entry.minimum)),
        ("max", limit(variable.maximum)),
        ("nominal", limit(entry.nominal)),
        ("start", limit(entry.start)),
    ];
    let kind = kind.iter().filter(|(_, value)| !value.is_empty()).map(|(name, value)| (*name, value.as_str()));
    xml.create_element("ScalarVariable").with_attributes(given).write_inner_content(|xml| {
        xml.create_element(if real { "Real" } else { "Enumeration" }).with_attributes(kind).write_empty()?;
        Ok(())
    })?;
    Ok(())
}

/// Outputs do not depend on an input at the same instant, unless the law does. Before the first step they depend on the
/// parameters.
fn structure(xml: &mut Xml<'_>, entries: &[Entry]) -> io::Result<()> {
    let outputs = || {
        let outputs = entries.iter().filter(|entry| entry.variable.causality == Causality::Output);
        outputs.flat_map(|entry| (0..entry.count).map(move |index| (entry, index)))
    };
    xml.create_element("ModelStructure").write_inner_content(|xml| {
        xml.create_element("Outputs").write_inner_content(|xml| {
            for (entry, index) in outputs() {
                let inputs = entry.follows.iter().chain(&entry.follows_tangential);
                let inputs: Vec<_> = inputs.map(|first| first + index).collect();
                unknown(xml, entry.reference + index, &inputs)?;
            }
            Ok(())
        })?;
        xml.create_element("InitialUnknowns").write_inner_content(|xml| {
            for (entry, index) in outputs() {
                let input = entry.follows_at_start.map(|first| first + index);
                let parameters = entry.dependencies.iter().map(|dependency| dependency.of(index));
                let places: Vec<_> = input.into_iter().chain(parameters).collect();
                unknown(xml, entry.reference + index, &places)?;
            }
            Ok(())
        })?;
        Ok(())
    })?;
    Ok(())
}

/// The index of an unknown, and those of the input and the parameters on which it depends. Indices in the XML start from 1.
fn unknown(xml: &mut Xml<'_>, place: usize, dependencies: &[usize]) -> io::Result<()> {
    let index = (place + 1).to_string();
    let dependencies = dependencies.iter().map(|place| (place + 1).to_string());
    let dependencies = dependencies.collect::<Vec<_>>().join(" ");
    let element = xml.create_element("Unknown");
    element.with_attributes([("index", index.as_str()), ("dependencies", &dependencies)]).write_empty()?;
    Ok(())
}

/// The shortest text that reads back as the same number.
pub fn number(value: f64) -> String {
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) { format!("{value}") } else { format!("{value:e}") }
}
