//! `brinell materials`: the materials of one's own in the current folder and of the user, and the built-in ones.

use crate::scene_file;
use brinell_exporter::layout::{json_line, paragraph, table};
use brinell_exporter::measured::{self, Metal};
use brinell_exporter::mistake::SceneError;
use brinell_exporter::numbers::quantity;
use brinell_exporter::table::{Class, MATERIALS, Material};
use serde_json::{Value, json};
use std::path::Path;

/// The command: prints the list.
///
/// # Errors
/// A mistake in a table of one's own, with its place.
pub fn run(as_json: bool) -> Result<(), SceneError> {
    let tables = scene_file::materials(Path::new(""))?;
    let own = tables.iter().flat_map(|table| table.materials.iter().map(|material| (table.place, material)));
    let all: Vec<_> = own.chain(MATERIALS.iter().map(|material| (BUILT_IN, material))).collect();
    if as_json {
        let value = |(place, material): &(&str, &Material)| {
            let mut value = json!(material);
            value["place"] = json!(place);
            value
        };
        print!("{}", json_line(&all.iter().map(value).collect::<Vec<Value>>()));
        return Ok(());
    }
    let heading = ["material", "E", "nu", "strength", "density"];
    let mut rows = vec![heading.map(String::from).to_vec()];
    rows.extend(all.iter().map(|(_, material)| {
        vec![
            material.name.clone(),
            quantity(material.youngs_modulus, "Pa"),
            quantity(material.poissons_ratio, ""),
            strength(material),
            quantity(material.density, "kg/m^3"),
        ]
    }));
    print!("{}\nsources\n", table(&rows, 1, 0));
    let widest = all.iter().map(|(_, material)| material.name.len()).max().unwrap_or(0);
    for (place, material) in all {
        let source = match place {
            BUILT_IN => material.source.clone(),
            place => {
                [place, &material.source].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(": ")
            }
        };
        print!("{}", paragraph(&format!("  {:<widest$}  ", material.name), &source));
    }
    Ok(())
}

/// The place of a material of the program.
const BUILT_IN: &str = "built in";

/// Its yield strength, the flow stress at 3 % plastic strain where that depends on the strain, or a dash.
fn strength(material: &Material) -> String {
    let Material { youngs_modulus, poissons_ratio, class, .. } = *material;
    let class = class.unwrap_or(Class::of_modulus(youngs_modulus));
    let metal = Metal { youngs_modulus, poissons_ratio, class, exponent: None };
    let at_strain =
        measured::of_material(material, &metal).map(|found| format!("{} at 3 %", quantity(found.at(0.03), "Pa")));
    let number = || material.yield_strength.map(|strength| quantity(strength, "Pa"));
    at_strain.or_else(number).unwrap_or("-".into())
}
