//! `brinell materials`: the built-in materials.

use crate::table::MATERIALS;

/// The command: prints the list.
pub fn run(as_json: bool) {
    if as_json {
        println!("{}", serde_json::to_string(&*MATERIALS).expect("a table of numbers and words"));
        return;
    }
    println!("{:<22} {:>10} {:>8} {:>10} {:>13}   source", "material", "E [GPa]", "nu", "S [MPa]", "rho [kg/m^3]");
    for material in MATERIALS.iter() {
        let (modulus, strength) = (1e-9 * material.youngs_modulus, 1e-6 * material.yield_strength);
        println!(
            "{:<22} {modulus:>10.1} {:>8} {strength:>10.0} {:>13}   {}",
            material.name, material.poissons_ratio, material.density, material.source
        );
    }
}
