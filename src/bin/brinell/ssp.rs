//! `brinell ssp`: the unit of a scene as a system of SSP 1.0, with its parameters in a file of their own.
//!
//! Reference: *System Structure and Parameterization*, version 1.0 (Modelica Association, 2019): SystemStructure.ssd is the
//! system, a `.ssv` file the values of its parameters, and `resources/` has what both refer to.

use crate::files::{ending, write_whole};
use crate::interface::Entry;
use crate::model_description::number;
use crate::package::{self, Exported};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::table::{Causality, Type, UNITS};
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};
use serde_json::json;
use std::collections::BTreeSet;
use std::error::Error;
use std::io::{self, Cursor};
use std::path::Path;

type Xml = Writer<Cursor<Vec<u8>>>;

const TOOL: &str = concat!("Brinell ", env!("CARGO_PKG_VERSION"));
const COMMON: (&str, &str) = ("xmlns:ssc", "http://ssp-standard.org/SSP1/SystemStructureCommon");
const DESCRIPTION: (&str, &str) = ("xmlns:ssd", "http://ssp-standard.org/SSP1/SystemStructureDescription");
const VALUES: (&str, &str) = ("xmlns:ssv", "http://ssp-standard.org/SSP1/SystemStructureParameterValues");

/// The name of the unit within the system.
const COMPONENT: &str = "contact";

/// The command: writes the system of the scene at `scene` to `output`, or into the current folder.
///
/// # Errors
/// That of the name, the scene, the export, or the file.
pub fn run(scene: &Path, output: Option<&Path>, as_json: bool) -> Result<(), Box<dyn Error>> {
    // told before anything is built
    ending(output, &["ssp"])?;
    let scene = Scene::read(scene)?;
    let path = output.map_or_else(|| format!("{}.ssp", scene.name).into(), Path::to_path_buf);
    eprintln!("building {} ...", path.display());
    let plan = Plan::of(&scene);
    let (unit, exported) = package::build(&plan)?;
    let files = Files::of(&plan);
    let archive = package::archive(&[
        ("SystemStructure.ssd".into(), document(|xml| structure(xml, &plan, &files)).as_bytes()),
        (files.values.clone(), document(|xml| values(xml, &plan)).as_bytes()),
        (files.unit.clone(), &unit),
    ])?;
    write_whole(&path, &archive)?;
    tell(&plan, &files, Exported { path, size: archive.len(), ..exported }, as_json);
    Ok(())
}

/// The names of the other files of the package.
struct Files {
    unit: String,
    values: String,
}

impl Files {
    fn of(plan: &Plan) -> Files {
        let name = &plan.scene.name;
        Files { unit: format!("resources/{name}.fmu"), values: format!("resources/{name}.ssv") }
    }
}

fn tell(plan: &Plan, files: &Files, system: Exported, as_json: bool) {
    let Exported { path, size, guid, .. } = system;
    let labels = |causality| -> Vec<_> { of_kind(plan, causality).map(Entry::label).collect() };
    let (inputs, outputs) = (labels(Causality::Input), labels(Causality::Output));
    let parameters = labels(Causality::Parameter);
    if as_json {
        let object = json!({
            "ssp": path, "size": size, "guid": guid, "component": COMPONENT, "fmu": files.unit, "parameter_values": files.values,
            "inputs": inputs, "outputs": outputs, "parameters": parameters,
        });
        println!("{object}");
        return;
    }
    println!("{}", path.display());
    println!("  {size} bytes; the unit is its component `{COMPONENT}`");
    println!("  inputs      {}", inputs.join(", "));
    println!("  outputs     {}", outputs.join(", "));
    println!("  parameters  {}", parameters.join(", "));
}

/// The variables of one kind.
fn of_kind<'a>(plan: &'a Plan, causality: Causality) -> impl Iterator<Item = &'a Entry<'a>> {
    plan.variables.iter().filter(move |entry| entry.variable.causality == causality)
}

/// A file of XML with this content.
fn document(content: impl FnOnce(&mut Xml) -> io::Result<()>) -> String {
    let mut xml = Writer::new_with_indent(Cursor::new(Vec::new()), b' ', 2);
    let written = xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)));
    written.and_then(|()| content(&mut xml)).expect("memory takes everything");
    let mut text = String::from_utf8(xml.into_inner().into_inner()).expect("XML is written as UTF-8");
    text.push('\n');
    text
}

/// The system: it has the inputs and outputs of its one component.
fn structure(xml: &mut Xml, plan: &Plan, files: &Files) -> io::Result<()> {
    let Plan { scene, experiment, .. } = plan;
    let attributes = [
        DESCRIPTION,
        COMMON,
        ("version", "1.0"),
        ("name", scene.name.as_str()),
        ("description", scene.description.as_str()),
        ("generationTool", TOOL),
    ];
    let root = xml.create_element("ssd:SystemStructureDescription");
    let given = attributes.into_iter().filter(|(_, value)| !value.is_empty());
    root.with_attributes(given).write_inner_content(|xml| {
        let system = xml.create_element("ssd:System").with_attribute(("name", scene.name.as_str()));
        system.write_inner_content(|xml| {
            connectors(xml, plan)?;
            xml.create_element("ssd:ParameterBindings").write_inner_content(|xml| {
                let binding = xml.create_element("ssd:ParameterBinding");
                binding.with_attribute(("source", files.values.as_str())).write_empty().map(|_| ())
            })?;
            xml.create_element("ssd:Elements").write_inner_content(|xml| {
                let component = [("name", COMPONENT), ("source", &files.unit), ("implementation", "CoSimulation")];
                let component = xml.create_element("ssd:Component").with_attributes(component);
                component.write_inner_content(|xml| connectors(xml, plan)).map(|_| ())
            })?;
            connections(xml, plan)
        })?;
        enumerations(xml, plan)?;
        units(xml, "ssd:Units", &plan.variables.iter().collect::<Vec<_>>())?;
        let times = [("startTime", number(0.0)), ("stopTime", number(experiment.stop))];
        let times = times.iter().map(|(name, value)| (*name, value.as_str()));
        xml.create_element("ssd:DefaultExperiment").with_attributes(times).write_empty().map(|_| ())
    })?;
    Ok(())
}

/// The inputs and outputs, each with its kind.
fn ports<'a>(plan: &'a Plan) -> impl Iterator<Item = (&'a Entry<'a>, &'static str, String)> {
    let of = |causality, kind| of_kind(plan, causality).map(move |entry| (entry, kind));
    let entries = of(Causality::Input, "input").chain(of(Causality::Output, "output"));
    entries.flat_map(|(entry, kind)| (0..entry.count).map(move |index| (entry, kind, entry.name(index))))
}

fn connectors(xml: &mut Xml, plan: &Plan) -> io::Result<()> {
    xml.create_element("ssd:Connectors").write_inner_content(|xml| {
        for (entry, kind, name) in ports(plan) {
            let variable = entry.variable;
            let connector = [("name", name.as_str()), ("kind", kind), ("description", entry.description)];
            xml.create_element("ssd:Connector").with_attributes(connector).write_inner_content(|xml| {
                let (element, attribute) = match variable.r#type {
                    Type::Real => ("ssc:Real", ("unit", variable.unit.as_deref())),
                    Type::Enumeration => ("ssc:Enumeration", ("name", Some(variable.rust.as_str()))),
                };
                let given = attribute.1.map(|value| (attribute.0, value));
                xml.create_element(element).with_attributes(given).write_empty().map(|_| ())
            })?;
        }
        Ok(())
    })?;
    Ok(())
}

/// From the inputs of the system to those of the component, and from its outputs to those of the system.
fn connections(xml: &mut Xml, plan: &Plan) -> io::Result<()> {
    xml.create_element("ssd:Connections").write_inner_content(|xml| {
        for (_, kind, name) in ports(plan) {
            let end = if kind == "input" { "endElement" } else { "startElement" };
            let connection = [(end, COMPONENT), ("startConnector", &name), ("endConnector", &name)];
            xml.create_element("ssd:Connection").with_attributes(connection).write_empty()?;
        }
        Ok(())
    })?;
    Ok(())
}

/// The enumerations among the outputs, with their values.
fn enumerations(xml: &mut Xml, plan: &Plan) -> io::Result<()> {
    let mut used: Vec<_> = plan.variables.iter().map(|entry| entry.variable).collect();
    used.retain(|variable| variable.r#type == Type::Enumeration);
    used.dedup_by_key(|variable| variable.name.as_str());
    // the schema allows no empty list
    if used.is_empty() {
        return Ok(());
    }
    xml.create_element("ssd:Enumerations").write_inner_content(|xml| {
        for variable in used {
            let name = ("name", variable.rust.as_str());
            xml.create_element("ssc:Enumeration").with_attribute(name).write_inner_content(|xml| {
                for (value, item) in variable.items.iter().enumerate() {
                    let item = [("name", item.name.as_str()), ("value", &value.to_string())];
                    xml.create_element("ssc:Item").with_attributes(item).write_empty()?;
                }
                Ok(())
            })?;
        }
        Ok(())
    })?;
    Ok(())
}

/// The parameters with the values of the scene, under their names in the system.
fn values(xml: &mut Xml, plan: &Plan) -> io::Result<()> {
    let attributes = [VALUES, COMMON, ("version", "1.0"), ("name", plan.scene.name.as_str()), ("generationTool", TOOL)];
    let parameters: Vec<_> = of_kind(plan, Causality::Parameter).collect();
    xml.create_element("ssv:ParameterSet").with_attributes(attributes).write_inner_content(|xml| {
        xml.create_element("ssv:Parameters").write_inner_content(|xml| {
            for entry in &parameters {
                let variable = entry.variable;
                let name = format!("{COMPONENT}.{}", entry.name(0));
                let parameter = [("name", name.as_str()), ("description", entry.description)];
                xml.create_element("ssv:Parameter").with_attributes(parameter).write_inner_content(|xml| {
                    let value = entry.start.map(number).unwrap_or_default();
                    let value = [("value", Some(value.as_str())), ("unit", variable.unit.as_deref())];
                    let given = value.into_iter().filter_map(|(key, value)| value.map(|value| (key, value)));
                    xml.create_element("ssv:Real").with_attributes(given).write_empty().map(|_| ())
                })?;
            }
            Ok(())
        })?;
        units(xml, "ssv:Units", &parameters)
    })?;
    Ok(())
}

/// The units that these variables use; no list if there are none, since the schema allows no empty one.
fn units(xml: &mut Xml, list: &str, entries: &[&Entry]) -> io::Result<()> {
    let used: BTreeSet<_> = entries.iter().filter_map(|entry| entry.variable.unit.as_deref()).collect();
    if used.is_empty() {
        return Ok(());
    }
    xml.create_element(list).write_inner_content(|xml| {
        for unit in UNITS.iter().filter(|unit| used.contains(unit.name.as_str())) {
            let name = ("name", unit.name.as_str());
            xml.create_element("ssc:Unit").with_attribute(name).write_inner_content(|xml| {
                let exponents =
                    [("kg", unit.kg), ("m", unit.m), ("s", unit.s)].map(|(name, power)| (name, power.to_string()));
                let exponents =
                    exponents.iter().filter(|(_, power)| power != "0").map(|(name, power)| (*name, power.as_str()));
                xml.create_element("ssc:BaseUnit").with_attributes(exponents).write_empty().map(|_| ())
            })?;
        }
        Ok(())
    })?;
    Ok(())
}
