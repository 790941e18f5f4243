//! The valid range of the laws, and the messages of the program about an impact beyond.

use crate::archive;
use crate::command::{empty_folder, run};
use crate::physics::{AnyModel, Random, all_models, mild, pair_of};
use crate::written::Written;
use brinell_contact::damped::{AnyDamped, Damped};
use brinell_contact::losses;
use brinell_contact::validity::{LARGEST_RADIUS_RATIO, LARGEST_SPEED_RATIO, largest_speed};
use brinell_contact::{Contact, History, Loading};
use std::fs;

/// The size of the smaller body is from a hundred thousandth of the effective radius, as of a ball in a socket that hardly differs from it, or
/// of a pin with a blunt end, to twice that, as of two equal balls.
#[test]
fn at_the_valid_depth_the_contact_radius_is_three_tenths_of_the_smaller_radius_with_every_law() {
    let mut random = Random(4);
    // steel, rubber-like, a huge sphere, and a target so hard that it hardly yields
    for pair in [mild(), pair_of(1e-2, 1e7, 5e5), pair_of(1e6, 200e9, 1e9), pair_of(5e-3, 100e9, 20e9)] {
        for round in 0..12 {
            let size = pair.radius * if round == 0 { 1.0 } else { random.log_uniform(1e-5, 2.0) };
            let right = |name: &str, radius: f64| {
                let error = radius / (LARGEST_RADIUS_RATIO * size.min(pair.radius)) - 1.0;
                assert!(error.abs() <= 1e-12, "{name} on {pair:?} with {size:e} m: off by {error:e}");
            };
            // a line has limits of its own, and a curve of one's own that of its file
            let models = all_models(pair).into_iter();
            for (name, model) in models.filter(|(name, model)| !model.loading.is_line() && !name.starts_with("table "))
            {
                right(&name, model.loading.contact_radius(&pair, model.valid_depth(size)));
            }
            for (name, law) in AnyDamped::ALL {
                let model = law.model(pair, 0.5, 1.0);
                let history = losses::History::start(&model, -model.plastic.valid_depth(size)).unwrap();
                right(name, history.contact_radius(&model));
            }
        }
    }
}

/// A mark on the way makes the step evaluate its branch again, and the branch does not change.
#[test]
fn a_mark_on_the_way_changes_no_bit_of_the_force() {
    for (name, model) in all_models(mild()) {
        let depth = model.valid_depth(f64::INFINITY);
        for mark in [0.3 * depth, depth, 1.7 * depth] {
            let (mut marked, mut plain) = (History::start(&model, 0.0).unwrap(), History::start(&model, 0.0).unwrap());
            for step in 1..400 {
                let increment = if step % 7 == 0 { -0.02 * depth } else { 0.01 * depth };
                Contact::<AnyModel>::stays_within(&mut marked, mark);
                marked.advance(&model, increment).unwrap();
                plain.advance(&model, increment).unwrap();
                assert_eq!(marked.force().to_bits(), plain.force().to_bits(), "{name} at {}", plain.indentation());
                assert_eq!(marked.max_indentation(), plain.max_indentation(), "{name}");
            }
            assert!(plain.max_indentation() > mark, "the mark was passed");
        }
    }
}

#[test]
fn the_largest_speed_is_a_hundredth_of_that_of_waves_in_a_rod() {
    assert_eq!(LARGEST_SPEED_RATIO, 0.01);
    // steel: 5 km/s
    assert!((largest_speed(200e9, 8000.0) - 50.0).abs() < 1e-12);
}

const SCENE: &str = "name = \"ball\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n\
                     [impact]\nmass = 4.11e-3\nspeed = 1.0\n";

/// The output of `predict` for the scene with these arguments.
fn predicted(scene: &str, arguments: &[&str]) -> String {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), scene).unwrap();
    run(folder.path(), [&["predict", "scene.toml"], arguments].concat()).with_status(0).out
}

#[test]
fn predict_warns_of_an_impact_beyond_the_validity_and_of_no_other() {
    let warnings = |scene: &str, speed: &str| {
        let text = predicted(scene, &["--speed", speed]);
        let json: serde_json::Value = serde_json::from_str(&predicted(scene, &["--speed", speed, "--json"])).unwrap();
        let list = json["laws"][0]["warnings"].as_array().unwrap().clone();
        let lines = text.lines().filter(|line| line.starts_with("warning: "));
        assert_eq!(lines.count(), list.len(), "{text}");
        list.iter().map(|warning| warning.as_str().unwrap().to_string()).collect::<Vec<_>>()
    };
    assert!(warnings(SCENE, "1").is_empty());
    let wide = warnings(SCENE, "40");
    assert!(wide.len() == 1 && wide[0].contains("effective radii; above 0.3 "), "{wide:?}");
    let both = warnings(SCENE, "60");
    assert!(both.len() == 2 && both[1].contains("of the wave speed of 5123 m/s; above 0.01 "), "{both:?}");
    let numbers = "youngs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 300e6";
    let unknown = warnings(&SCENE.replace("material = \"mild steel\"", numbers), "60");
    assert_eq!(unknown.len(), 1, "nothing is known of waves: {unknown:?}");
    let light = warnings(&SCENE.replace("material", "density = 1e-3\nmaterial"), "60");
    assert_eq!(light.len(), 1, "a number stands before a material's: {light:?}");
}

#[test]
fn the_density_is_a_constant_of_the_fmu_and_not_a_variable() {
    let steel = Written::of(SCENE);
    assert!(steel.has_number(7850.0) && !steel.has_text("density"), "{}", steel.rust);
    let contacts = "[[contact]]\nname = \"a\"\n[[contact]]\nname = \"b\"\ntarget = { density = 2e3 }\n";
    let several = Written::of(&format!("{SCENE}{contacts}"));
    assert!(several.has_number(7850.0) && several.has_number(2e3), "{}", several.rust);
    let unknown =
        Written::of(&SCENE.replace("material = \"mild steel\"", "youngs_modulus = 1e9\npoissons_ratio = 0.3"));
    assert!(!unknown.has_number(7850.0), "{}", unknown.rust);
}

#[test]
fn materials_have_a_density_and_say_so() {
    let folder = empty_folder();
    let materials = run(folder.path(), ["materials", "--json"]).with_status(0).json();
    for material in materials.as_array().unwrap() {
        let density = material["density"].as_f64().unwrap();
        assert!((1e3..2e4).contains(&density), "{material}");
    }
    let table = run(folder.path(), ["materials"]).with_status(0).out;
    assert!(table.contains("density") && table.contains("7850 kg/m^3"), "{table}");
}

#[test]
fn export_and_its_page_say_what_predict_says() {
    let folder = empty_folder();
    let law = "speed = 60.0\n[law]\nloading = \"big-alabo\"";
    fs::write(folder.path().join("scene.toml"), SCENE.replace("speed = 1.0", law)).unwrap();
    let exported = run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu", "--json"]).with_status(0).json();
    let warnings = exported["warnings"].as_array().unwrap();
    assert_eq!(warnings.len(), 2, "{exported}");
    let said = run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(0).out;
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    let page = archive::text(&folder.path().join("unit.fmu"), "documentation/index.html");
    for warning in warnings {
        let warning = warning.as_str().unwrap();
        assert!(said.contains(&format!("warning {warning}")), "{said}");
        assert!(page.contains(&format!("<strong>Beyond the validity of the law:</strong> {warning}.")), "{warning}");
    }
    assert!(page.contains("here an indentation of 225 \u{b5}m") && page.contains("here 51.23 m/s"));
}
