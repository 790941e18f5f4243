//! A scene without yield strength gives an elastic FMU: nothing plastic is in its description, its code, or its numbers.
//!
//! Each test also examines the same scene with a yield strength, so that a search that never finds anything is noticed.
#![cfg(target_os = "linux")]

use crate::command::{empty_folder, run};
use crate::unit;
use brinell_contact::loading::BigAlabo;
use std::fs;
use std::path::{Path, PathBuf};

const OUTPUTS: &str = "outputs = [\"indentation\", \"max_indentation\", \"residual_indentation\", \"contact_radius\", \
                       \"mean_pressure\", \"stiffness\", \"work\", \"elastic_energy\", \"dissipated_energy\", \"regime\"]";

/// A scene with every output, elastic or not. The law that yields has its constants one by one.
fn scene(yields: bool) -> PathBuf {
    let law = "yield_strength = 3e8\n[law]\nloading = \"big-alabo\"";
    let (name, strength) = if yields { ("plastic", law) } else { ("elastic", "") };
    let text = format!(
        "name = \"{name}\"\n[impactor]\nradius = 5e-3\n[target]\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\n\
         {strength}\n[fmu]\n{OUTPUTS}\n[impact]\nmass = 4e-3\nspeed = 1.0\n"
    );
    unit::write_scene(name, &text)
}

fn library(scene: &Path) -> Vec<u8> {
    fs::read(unit::library(&unit::compiled(scene))).unwrap()
}

fn contains(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}

#[test]
fn every_output_of_an_elastic_fmu_is_right() {
    let folder = empty_folder();
    let elastic = unit::export(&scene(false));
    let check = run(folder.path(), ["check", elastic.to_str().unwrap(), "--json"]).with_status(0).json();
    assert_eq!(check["passed"], true, "{check}");
    assert_eq!(check["rows"][2]["quantity"], "dent");
    assert_eq!(check["rows"][2]["predicted"], 0.0);
    assert_eq!(check["rows"][3]["predicted"], 1.0, "restitution");
}

#[test]
fn an_elastic_fmu_has_no_yield_strength_in_its_description() {
    let description = |scene: &Path| {
        let library = unit::library(&unit::export(scene));
        let root = library.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY").to_path_buf();
        fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library")
    };
    assert!(description(&scene(true)).contains("yield_strength"));
    assert!(!description(&scene(false)).contains("yield"), "{}", description(&scene(false)));
}

/// The constants of a law are in the library as eight bytes each, or they are not.
#[test]
fn an_elastic_fmu_has_no_constant_of_a_plastic_law() {
    let law = BigAlabo::REFERENCE;
    let numbers = [
        law.yield_pressure_factor,
        law.plastic_pressure_factor,
        law.second_region,
        law.fully_plastic,
        law.plastic_slope,
    ];
    let [plastic, elastic] = ["steel_ball", "elastic"].map(|name| library(&unit::scene(name)));
    for number in numbers {
        let bytes = number.to_le_bytes();
        assert!(contains(&plastic, &bytes), "{number} is not to be found where it must be");
        assert!(!contains(&elastic, &bytes), "{number} is in the elastic unit");
    }
}
