//! `SystemStructure.ssd`: the components of a system, their connectors and their connections.

use super::document::{COMMON, COMPONENT, Files, TOOL, Xml, of_kind};
use super::values;
use super::wiring::{End, Peer, Wiring};
use crate::importer::VariableUnit;
use brinell_exporter::interface::Entry;
use brinell_exporter::model_description::number;
use brinell_exporter::plan::Plan;
use brinell_exporter::table::{Causality, Type};
use brinell_exporter::xml::{element, leaf};
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
    element(xml, "ssd:SystemStructureDescription", &attributes, |xml| {
        element(xml, "ssd:System", &[("name", &scene.name)], |xml| {
            if wiring.peers.is_empty() {
                connectors(xml, plan, wiring)?;
            }
            element(xml, "ssd:ParameterBindings", &[], |xml| {
                leaf(xml, "ssd:ParameterBinding", &[("source", &files.values)])
            })?;
            element(xml, "ssd:Elements", &[], |xml| {
                let component = [("name", COMPONENT), ("source", &files.unit), ("implementation", "CoSimulation")];
                element(xml, "ssd:Component", &component, |xml| connectors(xml, plan, wiring))?;
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
        leaf(xml, "ssd:DefaultExperiment", &[("startTime", "0"), ("stopTime", &number(experiment.stop))])
    })
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
    let is_shown = |(_, kind, name): &(_, &str, String)| alone || *kind == "output" || inputs.contains(name.as_str());
    element(xml, "ssd:Connectors", &[], |xml| {
        ports(plan).filter(is_shown).try_for_each(|(entry, kind, name)| {
            let variable = entry.variable;
            let connector = [("name", name.as_str()), ("kind", kind), ("description", entry.description)];
            element(xml, "ssd:Connector", &connector, |xml| match variable.r#type {
                Type::Real => leaf(xml, "ssc:Real", &[("unit", variable.unit.as_deref().unwrap_or_default())]),
                Type::Enumeration => leaf(xml, "ssc:Enumeration", &[("name", &variable.symbol().to_string())]),
            })
        })
    })
}

/// Another component, with its connected variables.
fn beside(xml: &mut Xml, peer: &Peer, wiring: &Wiring) -> io::Result<()> {
    let ports = [(true, "input"), (false, "output")].map(|(input, kind)| (wiring.connected(&peer.name, input), kind));
    let file = peer.file();
    let component = [("name", peer.name.as_str()), ("source", &file), ("implementation", "CoSimulation")];
    element(xml, "ssd:Component", &component, |xml| {
        // the schema allows no empty list
        if ports.iter().all(|(names, _)| names.is_empty()) {
            return Ok(());
        }
        element(xml, "ssd:Connectors", &[], |xml| {
            let mut all = ports.iter().flat_map(|(names, kind)| names.iter().map(move |name| (*name, *kind)));
            all.try_for_each(|(name, kind)| {
                let end = End { unit: peer.name.clone(), variable: name.into() };
                // a name without a definition is none of the system's units
                let unit = wiring.units.get(&end).filter(|unit| unit.base.is_some());
                let unit = unit.map_or("", |unit| &unit.name);
                element(xml, "ssd:Connector", &[("name", name), ("kind", kind)], |xml| {
                    leaf(xml, "ssc:Real", &[("unit", unit)])
                })
            })
        })
    })
}

/// The connections between the components. A system that contains only the contact connects its own inputs and outputs to it.
fn connections(xml: &mut Xml, plan: &Plan, wiring: &Wiring) -> io::Result<()> {
    if !wiring.peers.is_empty() && wiring.connections.is_empty() {
        return Ok(());
    }
    element(xml, "ssd:Connections", &[], |xml| {
        wiring.connections.iter().try_for_each(|(from, to)| {
            let start = [("startElement", from.unit.as_str()), ("startConnector", &from.variable)];
            let end = [("endElement", to.unit.as_str()), ("endConnector", &to.variable)];
            leaf(xml, "ssd:Connection", &[start, end].concat())
        })?;
        ports(plan).filter(|_| wiring.peers.is_empty()).try_for_each(|(_, kind, name)| {
            let end = if kind == "input" { "endElement" } else { "startElement" };
            leaf(xml, "ssd:Connection", &[(end, COMPONENT), ("startConnector", &name), ("endConnector", &name)])
        })
    })
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
    element(xml, "ssd:Enumerations", &[], |xml| {
        used.into_iter().try_for_each(|variable| {
            element(xml, "ssc:Enumeration", &[("name", &variable.symbol().to_string())], |xml| {
                let mut items = variable.items.iter().enumerate();
                items.try_for_each(|(value, item)| {
                    leaf(xml, "ssc:Item", &[("name", &item.name), ("value", &value.to_string())])
                })
            })
        })
    })
}
