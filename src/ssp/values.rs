//! The `.ssv` file: the values of the parameters.

use super::document::{COMMON, COMPONENT, TOOL, Xml, of_kind};
use crate::importer::Base;
use brinell_exporter::interface::Entry;
use brinell_exporter::model_description::number;
use brinell_exporter::plan::Plan;
use brinell_exporter::table::{self, Causality};
use brinell_exporter::xml::{element, leaf};
use std::collections::BTreeMap;
use std::io;

const VALUES: (&str, &str) = ("xmlns:ssv", "http://ssp-standard.org/SSP1/SystemStructureParameterValues");

/// The parameters with the values of the scene, with their names in the system.
pub fn write(xml: &mut Xml, plan: &Plan) -> io::Result<()> {
    let attributes = [VALUES, COMMON, ("version", "1.0"), ("name", plan.scene.name.as_str()), ("generationTool", TOOL)];
    let parameters: Vec<_> = of_kind(plan, Causality::Parameter).collect();
    element(xml, "ssv:ParameterSet", &attributes, |xml| {
        element(xml, "ssv:Parameters", &[], |xml| {
            let mut all = parameters.iter().flat_map(|entry| (0..entry.count).map(move |index| (entry, index)));
            all.try_for_each(|(entry, index)| {
                let name = format!("{COMPONENT}.{}", entry.name(index));
                element(xml, "ssv:Parameter", &[("name", &name), ("description", entry.description)], |xml| {
                    let value = entry.start.map(number).unwrap_or_default();
                    let unit = entry.variable.unit.as_deref().unwrap_or_default();
                    leaf(xml, "ssv:Real", &[("value", &value), ("unit", unit)])
                })
            })
        })?;
        units(xml, "ssv:Units", &units_of(parameters.iter().copied()))
    })
}

/// The units of these variables by name.
pub fn units_of<'a>(entries: impl Iterator<Item = &'a Entry<'a>>) -> BTreeMap<&'a str, Base> {
    entries.filter_map(|entry| Some((entry.variable.unit.as_deref()?, base_of(entry.variable)))).collect()
}

/// The unit of a variable of the contact in base units. One without a unit is a plain number.
pub fn base_of(variable: &table::Variable) -> Base {
    let mut powers = [0; 8];
    if let Some(unit) = table::UNITS.iter().find(|unit| Some(&unit.name) == variable.unit.as_ref()) {
        powers[..3].copy_from_slice(&[unit.kg, unit.m, unit.s]);
    }
    Base { powers, factor: 1.0, offset: 0.0 }
}

/// The list of these units. Without any, there is no list, because the schema allows no empty one.
pub fn units(xml: &mut Xml, list: &str, units: &BTreeMap<&str, Base>) -> io::Result<()> {
    if units.is_empty() {
        return Ok(());
    }
    element(xml, list, &[], |xml| {
        units.iter().try_for_each(|(name, base)| {
            element(xml, "ssc:Unit", &[("name", name)], |xml| {
                let powers = Base::NAMES.into_iter().zip(base.powers);
                let powers = powers.filter(|(_, power)| *power != 0).map(|(name, power)| (name, power.to_string()));
                let sizes = [("factor", base.factor, 1.0), ("offset", base.offset, 0.0)];
                let sizes = sizes.into_iter().filter(|(_, value, usual)| value != usual);
                let all: Vec<_> = powers.chain(sizes.map(|(name, value, _)| (name, number(value)))).collect();
                let all: Vec<_> = all.iter().map(|(name, value)| (*name, value.as_str())).collect();
                leaf(xml, "ssc:BaseUnit", &all)
            })
        })
    })
}
