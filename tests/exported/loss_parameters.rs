//! Scenes with a loss below yield: its constant is a parameter of the FMU, and it belongs to the target whichever body yields.

use crate::command::{empty_folder, run};
use crate::loaded::{Instance, OK, Unit};
use crate::physics::Random;
use crate::unit;
use serde_json::Value;
use std::fs;

/// A scene with these lines of impactor, target and law.
fn scene(impactor: &str, target: &str, law: &str) -> String {
    format!(
        "name = \"unit\"\n[impactor]\nradius = 5e-3\n{impactor}\n[target]\nmaterial = \"mild steel\"\n{target}\n\
         [law]\nloading = \"brinell\"\n{law}\n[fmu]\noutputs = [\"work\", \"dissipated_energy\"]\n\
         [impact]\nmass = 4.11e-3\nspeed = 0.5\n"
    )
}

fn predicted(text: &str, arguments: &[&str]) -> Value {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    let all = ["predict", "scene.toml", "--json"].into_iter().chain(arguments.iter().copied());
    run(folder.path(), all).with_status(0).json()
}

fn restitution(text: &str) -> f64 {
    predicted(text, &[])["laws"][0]["restitution"].as_f64().expect("a number")
}

/// The outputs after steps with rates of both signs.
fn history(instance: Instance) -> Vec<[f64; 3]> {
    let mut random = Random(3);
    let outputs = ["force", "work", "dissipated_energy"].map(|name| instance.real_of(name));
    let rate = instance.real_of("indentation_rate");
    let steps = (0..300).map(|step| {
        let speed = if random.next() < 0.6 { 0.5 } else { -0.5 } * random.next();
        assert_eq!(instance.set(&[rate], &[speed]), OK);
        assert_eq!(instance.step(f64::from(step) * 1e-6, 1e-6), OK, "{}", instance.message());
        let mut values = [0.0; 3];
        assert_eq!(instance.get(&outputs, &mut values), OK);
        values
    });
    steps.collect()
}

const LOSSES: [(&str, [&str; 2], [f64; 2]); 2] = [
    ("elastic_restitution", ["", "elastic_restitution = "], [0.98, 0.6]),
    ("target.plate_thickness", ["plate_thickness = ", ""], [4e-3, 15e-3]),
];

/// The scene with the constant of a loss.
fn with(keys: [&str; 2], value: f64) -> String {
    let [target, law] = keys.map(|key| if key.is_empty() { String::new() } else { format!("{key}{value}") });
    scene("", &target, &law)
}

#[test]
fn a_constant_that_is_set_acts_like_that_of_another_scene() {
    for (name, keys, [first, second]) in LOSSES {
        let [one, other] = [first, second].map(|value| Unit::load(&unit::write_scene("unit", &with(keys, value))));
        let set = history(one.ready_with(&[(name, second)]));
        assert_eq!(set, history(other.ready()), "{name}");
        assert_ne!(set, history(one.ready()), "{name}");
        let refused = one.instantiate();
        let reference = refused.real_of(name);
        assert_ne!(refused.set(&[reference], &[-1.0]), OK, "{name}");
        assert!(refused.message().contains(&format!("{name} = -1 is out of range")), "{}", refused.message());
    }
}

#[test]
fn a_sweep_over_the_constant_is_that_of_other_scenes() {
    for (name, keys, [first, second]) in LOSSES {
        let (low, high) = (f64::min(first, second), f64::max(first, second));
        let answer = predicted(&with(keys, first), &["--sweep", &format!("{name}={low}:{high}:2")]);
        let found: Vec<f64> = serde_json::from_value(answer["laws"][0]["restitution"].clone()).expect("numbers");
        assert_eq!(found, [low, high].map(|value| restitution(&with(keys, value))), "{name}");
    }
}

#[test]
fn the_loss_is_that_of_the_target_also_if_the_impactor_yields() {
    let aluminium = "youngs_modulus = 69e9\npoissons_ratio = 0.36";
    for (target, law) in [("plate_thickness = 4e-3", ""), ("", "elastic_restitution = \"waves\"")] {
        let slow = |text: String| text.replace("speed = 0.5", "speed = 1e-4");
        let elastic = restitution(&slow(scene(aluminium, target, law)));
        let soft = restitution(&slow(scene(&format!("{aluminium}\nyield_strength = 250e6"), target, law)));
        assert!(elastic < 1.0 - 1e-7, "{elastic}");
        assert_eq!(elastic, soft, "below yield the strength doesn't matter");
    }
}
