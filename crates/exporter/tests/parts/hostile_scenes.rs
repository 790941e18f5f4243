//! Hostile scenes: read without a panic, or refused with a place in the file and a message of ordinary length. What is accepted
//! can be planned and written.

use brinell_exporter::mistake::SceneError;
use brinell_exporter::package::GUID_TO_COME;
use brinell_exporter::plan::Plan;
use brinell_exporter::scene::{InverseMasses, Scene};
use brinell_exporter::table::VARIABLES;
use brinell_exporter::{documentation, library, model_description};
use brinell_testing::mutations::{assert_message, cases, text};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// Good scenes with everything that the tables know.
const SEEDS: [&str; 18] = [
    include_str!("../../../../scenes/steel_ball.toml"),
    include_str!("../../../../scenes/coupled.toml"),
    include_str!("../../../../scenes/damped.toml"),
    include_str!("../../../../scenes/elastic.toml"),
    include_str!("../../../../scenes/everything.toml"),
    include_str!("../../../../scenes/mass_known.toml"),
    include_str!("../../../../scenes/oblique.toml"),
    include_str!("../../../../scenes/rough_contacts.toml"),
    include_str!("../../../../scenes/two_contacts.toml"),
    include_str!("../../../../scenes/two_directions.toml"),
    include_str!("../../../../scenes/wired.toml"),
    "name = \"a\"\nimpactor = { radius = 5e-3, material = \"tungsten carbide\" }\n[target]\nmaterial = \"mild steel\"\n\
     surface = \"fresh\"\n[law]\nloading = \"stronge\"\nunloading = \"thornton\"\npassivity_guard = true\n\
     [impact]\nmass = 4e-3\nspeed = 1.0\nwatch = false\n",
    "name = \"a\"\nimpactor.radius = 5e-3\n[target]\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 3e8\n\
     hardening_modulus = 1e9\n[fmu]\nparameters = [\"target.yield_strength\"]\nnames = \"structured\"\nstandalone = true\n\
     [[contact]]\nname = \"left\"\ncount = 3\nparameters_per_contact = [\"initial_gap\"]\ninitial_gap = 1e-6\n",
    "name = \"a\"\nimpactor.radius = 5e-3\n[target]\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\n\
     power_law = { strength = 5e8, exponent = 0.2 }\nrate = { model = \"johnson-cook\", coefficient = 0.02, reference_rate = 1.0 }\n",
    "name = \"a\"\nimpactor.radius = 5e-3\ntarget.material = \"mild steel\"\ncoupling.master = \"parallel\"\n\
     [[body]]\nname = \"b\"\nmass = 0.1\n[[body]]\nname = \"c\"\nmass = 0.2\n[[contact]]\nname = \"d\"\n\
     between = [\"b\", \"ground\"]\n[[contact]]\nname = \"e\"\nbetween = [\"c\", \"b\"]\ndirection = -1\n",
    "name = \"a\"\nimpactor.radius = 5e-3\ntarget.material = \"mild steel\"\n[[body]]\nname = \"b\"\nmass = 0.3\n\
     inertia = [1.2e-4, 2.6e-4, 3.5e-4, 1e-5, 0, -2e-5]\n[[contact]]\nname = \"d\"\nbetween = [\"b\", \"ground\"]\n\
     normal = [0, 0, -1]\narms = [[-0.04, 0, -0.025], []]\n[[contact]]\nname = \"e\"\nbetween = [\"ground\", \"b\"]\n\
     normal = [0, 0, 1]\narms = [[], [0.04, 0, -0.025]]\n",
    "name = \"a\"\nimpactor.radius = 5e-3\ntarget.material = \"mild steel\"\n[coupling]\ninverse_masses = \"input\"\n\
     inputs = [\"external_acceleration\"]\n[[contact]]\nname = \"d\"\n[[contact]]\nname = \"e\"\ncount = 3\n",
    "name = \"a\"\nimpactor = { radius = 5e-3, material = \"b\" }\n[target]\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\n\
     tensile_test = { plastic_strain = [0.005, 0.01, 0.02], true_stress = [3e8, 3.4e8, 3.9e8] }\n[[contact]]\nname = \"c\"\n\
     target = { hardness = \"200 HV10\", hardening_exponent = 0.1 }\n[[contact]]\nname = \"d\"\n\
     target.tensile_test = { proof_stress = 3e8, tensile_strength = 4e8 }\n[[material]]\nname = \"b\"\nyoungs_modulus = 2e11\n\
     poissons_ratio = 0.3\ndensity = 7800.0\ntension = { coefficient = 9e8, exponent = 0.2 }\n",
];

/// The case is read, and what it makes is written.
fn read(case: &str) -> Result<bool, SceneError> {
    let scene = Scene::parse(case.into(), Path::new("scene.toml"))?;
    if let Some(InverseMasses::Constant { entries, .. }) = scene.inverse_masses() {
        assert!(entries.iter().all(|entry| entry.is_finite()), "a mass in {entries:?}");
    }
    // millions of contacts would only take time
    if scene.contact_count() < 500 {
        let plan = Plan::of(&scene);
        let written = library::write(&plan, GUID_TO_COME).len() + documentation::write(&plan).len();
        let mut xml = Vec::new();
        model_description::write(&plan, "guid", None, &mut xml).expect("memory can be written to");
        let xml = String::from_utf8(xml).expect("XML is UTF-8");
        for word in ["\"NaN\"", "\"inf\"", "\"-inf\"", "\"INF\""] {
            let is_name = word.trim_matches('"') == scene.name;
            assert!(is_name || !xml.contains(word), "{word} in the XML");
        }
        assert!(written > 1000, "little was written");
    }
    Ok(true)
}

#[test]
fn hostile_scenes_are_refused_with_a_place_or_can_be_exported() {
    let names: Vec<&str> = VARIABLES.iter().flat_map(|variable| [variable.name.as_str()]).collect();
    let (mut accepted, all) = (0, cases(4000));
    for number in 0..all {
        let case = text(number, &SEEDS, &names);
        match catch_unwind(AssertUnwindSafe(|| read(&case))) {
            Ok(Ok(_)) => accepted += 1,
            Ok(Err(error)) => {
                let message = error.to_string();
                assert_message(&message, &case);
                let SceneError::Wrong { line, column, .. } = error else { panic!("there is no file: {message}") };
                let text =
                    case.split('\n').nth(line - 1).unwrap_or_else(|| panic!("no line {line}: {message}\n{case}"));
                assert!(column <= text.chars().count() + 1, "no column {column}: {message}\n{case}");
            }
            Err(_) => panic!("case {number} panics:\n{case}"),
        }
    }
    assert!(accepted > all / 50 && accepted < all / 2, "{accepted} of {all} were accepted");
}
