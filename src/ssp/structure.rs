//! `SystemStructure.ssd`: the components of a system, their connectors and their connections.

use super::wiring::{End, Peer, Wiring};
use super::{COMMON, COMPONENT, Files, TOOL, Xml, of_kind, values};
use crate::importer::VariableUnit;
use brinell_exporter::interface::Entry;
use brinell_exporter::model_description::number;
use brinell_exporter::plan::Plan;
use brinell_exporter::table::{Causality, Type};
use std::io;

const DESCRIPTION: (&str, &str) = ("xmlns:ssd", "http://ssp-standard.org/SSP1/SystemStructureDescription");

/// The system. If it contains only the contact, it has the contact's inputs and outputs. Otherwise it has no connectors,
/// because some tools support only connections between components.
pub fn write(xml: &mut Xml, plan: &Plan, files: &Files, wiring: &Wiring) -> io::Result<()> {
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
            if wiring.peers.is_empty() {
                connectors(xml, plan, wiring)?;
            }
            xml.create_element("ssd:ParameterBindings").write_inner_content(|xml| {
                let binding = xml.create_element("ssd:ParameterBinding");
                binding.with_attribute(("source", files.values.as_str())).write_empty().map(|_| ())
            })?;
            xml.create_element("ssd:Elements").write_inner_content(|xml| {
                let component = [("name", COMPONENT), ("source", &files.unit), ("implementation", "CoSimulation")];
                let component = xml.create_element("ssd:Component").with_attributes(component);
                component.write_inner_content(|xml| connectors(xml, plan, wiring))?;
                wiring.peers.iter().try_for_each(|peer| beside(xml, peer, wiring))
            })?;
            connections(xml, plan, wiring)
        })?;
        enumerations(xml, plan)?;
        let mut units = values::units_of(plan.variables.iter());
        for VariableUnit { name, base } in wiring.units.values().filter(|unit| !unit.name.is_empty()) {
            if let Some(base) = base {
                units.entry(name).or_insert_with(|| base.clone());
            }
        }
        values::units(xml, "ssd:Units", &units)?;
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

/// Among other components, an input is listed only if it is connected, because fmpy treats all listed inputs as connected.
fn connectors(xml: &mut Xml, plan: &Plan, wiring: &Wiring) -> io::Result<()> {
    let inputs = wiring.connected(COMPONENT, true);
    let alone = wiring.peers.is_empty();
    xml.create_element("ssd:Connectors").write_inner_content(|xml| {
        for (entry, kind, name) in ports(plan) {
            if !alone && kind == "input" && !inputs.contains(name.as_str()) {
                continue;
            }
            let variable = entry.variable;
            let connector = [("name", name.as_str()), ("kind", kind), ("description", entry.description)];
            xml.create_element("ssd:Connector").with_attributes(connector).write_inner_content(|xml| {
                let (element, attribute, value) = match variable.r#type {
                    Type::Real => ("ssc:Real", "unit", variable.unit.clone()),
                    Type::Enumeration => ("ssc:Enumeration", "name", Some(variable.symbol().to_string())),
                };
                let given = value.as_deref().map(|value| (attribute, value));
                xml.create_element(element).with_attributes(given).write_empty().map(|_| ())
            })?;
        }
        Ok(())
    })?;
    Ok(())
}

/// Another component, with its connected variables.
fn beside(xml: &mut Xml, peer: &Peer, wiring: &Wiring) -> io::Result<()> {
    let ports = [(true, "input"), (false, "output")].map(|(input, kind)| (wiring.connected(&peer.name, input), kind));
    let file = peer.file();
    let component = [("name", peer.name.as_str()), ("source", &file), ("implementation", "CoSimulation")];
    let component = xml.create_element("ssd:Component").with_attributes(component);
    component.write_inner_content(|xml| {
        // the schema allows no empty list
        if ports.iter().all(|(names, _)| names.is_empty()) {
            return Ok(());
        }
        xml.create_element("ssd:Connectors").write_inner_content(|xml| {
            for (names, kind) in &ports {
                for name in names {
                    let connector =
                        xml.create_element("ssd:Connector").with_attributes([("name", *name), ("kind", kind)]);
                    let end = End { unit: peer.name.clone(), variable: (*name).into() };
                    // a name without a definition is none of the system's units
                    let unit = wiring.units.get(&end).filter(|unit| unit.base.is_some() && !unit.name.is_empty());
                    connector.write_inner_content(|xml| {
                        let given = unit.map(|unit| ("unit", unit.name.as_str()));
                        xml.create_element("ssc:Real").with_attributes(given).write_empty().map(|_| ())
                    })?;
                }
            }
            Ok(())
        })?;
        Ok(())
    })?;
    Ok(())
}

/// The connections between the components. A system that contains only the contact connects its own inputs and outputs to it.
fn connections(xml: &mut Xml, plan: &Plan, wiring: &Wiring) -> io::Result<()> {
    if !wiring.peers.is_empty() && wiring.connections.is_empty() {
        return Ok(());
    }
    xml.create_element("ssd:Connections").write_inner_content(|xml| {
        for (from, to) in &wiring.connections {
            let connection = [
                ("startElement", from.unit.as_str()),
                ("startConnector", &from.variable),
                ("endElement", &to.unit),
                ("endConnector", &to.variable),
            ];
            xml.create_element("ssd:Connection").with_attributes(connection).write_empty()?;
        }
        for (_, kind, name) in ports(plan).filter(|_| wiring.peers.is_empty()) {
            let end = if kind == "input" { "endElement" } else { "startElement" };
            let connection = [(end, COMPONENT), ("startConnector", &name), ("endConnector", &name)];
            xml.create_element("ssd:Connection").with_attributes(connection).write_empty()?;
        }
        Ok(())
    })?;
    Ok(())
}

/// The enumerations of the outputs, with their values.
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
            let name = variable.symbol().to_string();
            let name = ("name", name.as_str());
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
