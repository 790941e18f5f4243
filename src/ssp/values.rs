//! The `.ssv` file: the values of the parameters.

use super::{COMMON, COMPONENT, TOOL, Xml, of_kind};
use crate::importer::Base;
use brinell_exporter::interface::Entry;
use brinell_exporter::model_description::number;
use brinell_exporter::plan::Plan;
use brinell_exporter::table::{self, Causality};
use std::collections::BTreeMap;
use std::io;

const VALUES: (&str, &str) = ("xmlns:ssv", "http://ssp-standard.org/SSP1/SystemStructureParameterValues");

/// The parameters with the values of the scene, with their names in the system.
pub fn write(xml: &mut Xml, plan: &Plan) -> io::Result<()> {
    let attributes = [VALUES, COMMON, ("version", "1.0"), ("name", plan.scene.name.as_str()), ("generationTool", TOOL)];
    let parameters: Vec<_> = of_kind(plan, Causality::Parameter).collect();
    xml.create_element("ssv:ParameterSet").with_attributes(attributes).write_inner_content(|xml| {
        xml.create_element("ssv:Parameters").write_inner_content(|xml| {
            let all = parameters.iter().flat_map(|entry| (0..entry.count).map(move |index| (entry, index)));
            for (entry, index) in all {
                let variable = entry.variable;
                let name = format!("{COMPONENT}.{}", entry.name(index));
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
        units(xml, "ssv:Units", &units_of(parameters.iter().copied()))
    })?;
    Ok(())
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
    xml.create_element(list).write_inner_content(|xml| {
        for (name, base) in units {
            xml.create_element("ssc:Unit").with_attribute(("name", *name)).write_inner_content(|xml| {
                let powers = Base::NAMES.into_iter().zip(base.powers);
                let powers = powers.filter(|(_, power)| *power != 0).map(|(name, power)| (name, power.to_string()));
                let sizes = [("factor", base.factor, 1.0), ("offset", base.offset, 0.0)];
                let sizes = sizes.into_iter().filter(|(_, value, usual)| value != usual);
                let all: Vec<_> = powers.chain(sizes.map(|(name, value, _)| (name, number(value)))).collect();
                let all = all.iter().map(|(name, value)| (*name, value.as_str()));
                xml.create_element("ssc:BaseUnit").with_attributes(all).write_empty().map(|_| ())
            })?;
        }
        Ok(())
    })?;
    Ok(())
}
