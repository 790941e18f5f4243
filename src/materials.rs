//! `brinell materials`: the built-in materials.

use brinell_exporter::layout::{json_line, paragraph, table};
use brinell_exporter::measured::{self, Metal};
use brinell_exporter::numbers::quantity;
use brinell_exporter::table::{Class, MATERIALS, Material};

/// The command: prints the list.
pub fn run(as_json: bool) {
    if as_json {
        print!("{}", json_line(&*MATERIALS));
        return;
    }
    let heading = ["material", "E", "nu", "strength", "density"];
    let mut rows = vec![heading.map(String::from).to_vec()];
    rows.extend(MATERIALS.iter().map(|material| {
        vec![
            material.name.clone(),
            quantity(material.youngs_modulus, "Pa"),
            quantity(material.poissons_ratio, ""),
            strength(material),
            quantity(material.density, "kg/m^3"),
        ]
    }));
    print!("{}\nsources\n", table(&rows, 1, 0));
    let widest = MATERIALS.iter().map(|material| material.name.len()).max().unwrap_or(0);
    for material in MATERIALS.iter() {
        print!("{}", paragraph(&format!("  {:<widest$}  ", material.name), &material.source));
    }
}

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
