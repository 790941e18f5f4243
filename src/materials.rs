//! `brinell materials`: the built-in materials.

use brinell_exporter::layout::{json_line, paragraph, table};
use brinell_exporter::numbers::quantity;
use brinell_exporter::table::MATERIALS;

/// The command: prints the list.
pub fn run(as_json: bool) {
    if as_json {
        print!("{}", json_line(&*MATERIALS));
        return;
    }
    let heading = ["material", "Young's modulus", "Poisson's ratio", "yield strength", "density"];
    let mut rows = vec![heading.map(String::from).to_vec()];
    rows.extend(MATERIALS.iter().map(|material| {
        vec![
            material.name.clone(),
            quantity(material.youngs_modulus, "Pa"),
            quantity(material.poissons_ratio, ""),
            quantity(material.yield_strength, "Pa"),
            quantity(material.density, "kg/m^3"),
        ]
    }));
    print!("{}\nsources\n", table(&rows, 1, 0));
    let widest = MATERIALS.iter().map(|material| material.name.len()).max().unwrap_or(0);
    for material in MATERIALS.iter() {
        print!("{}", paragraph(&format!("  {:<widest$}  ", material.name), &material.source));
    }
}
