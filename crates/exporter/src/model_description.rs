//! `modelDescription.xml`: capabilities of the FMU, units, variables, and the structure of the model.

use crate::interface::{Entry, is_tunable};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::table::{Causality, Type, UNITS, Unit};
use crate::xml::{element, leaf};
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
    element(xml, "fmiModelDescription", &attributes, |xml| {
        co_simulation(xml, scene, source)?;
        units(xml, entries)?;
        types(xml, entries)?;
        element(xml, "LogCategories", &[], |xml| {
            let mut all = LOG_CATEGORIES.into_iter();
            all.try_for_each(|(name, description)| {
                leaf(xml, "Category", &[("name", name), ("description", description)])
            })
        })?;
        let [stop, step] = [experiment.stop, experiment.step].map(number);
        leaf(xml, "DefaultExperiment", &[("startTime", "0"), ("stopTime", &stop), ("stepSize", &step)])?;
        element(xml, "ModelVariables", &[], |xml| {
            let mut all = entries.iter().flat_map(|entry| (0..entry.count).map(move |index| (entry, index)));
            all.try_for_each(|(entry, index)| scalar_variable(xml, scene, entry, index))
        })?;
        structure(xml, entries)
    })
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
    let takes_derivatives = scene.has_course() && !scene.has_input("external_acceleration");
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
    let Some(file) = source else { return leaf(xml, "CoSimulation", &attributes) };
    element(xml, "CoSimulation", &attributes, |xml| {
        element(xml, "SourceFiles", &[], |xml| leaf(xml, "File", &[("name", file)]))
    })
}

/// The units of the variables, with their display units.
fn units(xml: &mut Xml<'_>, entries: &[Entry]) -> io::Result<()> {
    let used: BTreeSet<_> = entries.iter().filter_map(|entry| entry.variable.unit.as_deref()).collect();
    element(xml, "UnitDefinitions", &[], |xml| {
        let mut used = UNITS.iter().filter(|unit| used.contains(unit.name.as_str()));
        used.try_for_each(|unit| element(xml, "Unit", &[("name", &unit.name)], |xml| definition(xml, unit)))
    })
}

fn definition(xml: &mut Xml<'_>, unit: &Unit) -> io::Result<()> {
    let exponent = |exponent: i32| if exponent == 0 { String::new() } else { exponent.to_string() };
    let [kg, m, s] = [unit.kg, unit.m, unit.s].map(exponent);
    leaf(xml, "BaseUnit", &[("kg", &kg), ("m", &m), ("s", &s)])?;
    let mut all = unit.display.iter();
    all.try_for_each(|shown| leaf(xml, "DisplayUnit", &[("name", &shown.name), ("factor", &number(shown.factor))]))
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
    element(xml, "TypeDefinitions", &[], |xml| {
        used.into_iter().try_for_each(|variable| {
            element(xml, "SimpleType", &[("name", &variable.symbol().to_string())], |xml| {
                element(xml, "Enumeration", &[], |xml| {
                    variable.items.iter().enumerate().try_for_each(|(value, item)| {
                        let value = value.to_string();
                        leaf(
                            xml,
                            "Item",
                            &[("name", &item.name), ("value", &value), ("description", &item.description)],
                        )
                    })
                })
            })
        })
    })
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
    let real = variable.r#type == Type::Real;
    let limit = |value: Option<f64>| value.map(number).unwrap_or_default();
    let declared = if real { String::new() } else { variable.symbol().to_string() };
    let [minimum, maximum, nominal, start] = [entry.minimum, variable.maximum, entry.nominal, entry.start].map(limit);
    let kind = [
        ("declaredType", declared.as_str()),
        ("unit", variable.unit.as_deref().unwrap_or_default()),
        ("displayUnit", variable.display_unit.as_deref().unwrap_or_default()),
        ("min", &minimum),
        ("max", &maximum),
        ("nominal", &nominal),
        ("start", &start),
    ];
    element(xml, "ScalarVariable", &attributes, |xml| leaf(xml, if real { "Real" } else { "Enumeration" }, &kind))
}

/// Outputs do not depend on an input at the same instant, unless the law does. Before the first step they depend on the
/// parameters.
fn structure(xml: &mut Xml<'_>, entries: &[Entry]) -> io::Result<()> {
    let outputs = || {
        let outputs = entries.iter().filter(|entry| entry.variable.causality == Causality::Output);
        outputs.flat_map(|entry| (0..entry.count).map(move |index| (entry, index)))
    };
    element(xml, "ModelStructure", &[], |xml| {
        element(xml, "Outputs", &[], |xml| {
            outputs().try_for_each(|(entry, index)| {
                let inputs = entry.follows.iter().chain(&entry.follows_tangential).map(|first| first + index);
                unknown(xml, entry.reference + index, inputs)
            })
        })?;
        element(xml, "InitialUnknowns", &[], |xml| {
            outputs().try_for_each(|(entry, index)| {
                let input = entry.follows_at_start.map(|first| first + index);
                let parameters = entry.dependencies.iter().map(|dependency| dependency.of(index));
                unknown(xml, entry.reference + index, input.into_iter().chain(parameters))
            })
        })
    })
}

/// The index of an unknown, and those of the input and the parameters on which it depends. Indices in the XML start from 1.
fn unknown(xml: &mut Xml<'_>, place: usize, dependencies: impl Iterator<Item = usize>) -> io::Result<()> {
    let index = (place + 1).to_string();
    let dependencies = dependencies.map(|place| (place + 1).to_string()).collect::<Vec<_>>().join(" ");
    // an empty list says that it depends on none
    let attributes = [("index", index.as_str()), ("dependencies", &dependencies)];
    xml.create_element("Unknown").with_attributes(attributes).write_empty().map(|_| ())
}

/// The shortest text that reads back as the same number.
pub fn number(value: f64) -> String {
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) { format!("{value}") } else { format!("{value:e}") }
}
