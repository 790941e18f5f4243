//! Scenes with a target whose strength depends on the strain rate.

use crate::command::{empty_folder, run};
use crate::written::Written;
use serde_json::Value;
use std::fs;

const JOHNSON_COOK: &str = "rate = { model = \"johnson-cook\", c = 0.014, reference_rate = 1.0 }";
const COWPER_SYMONDS: &str = "rate = { model = \"cowper-symonds\", d = 40.4, q = 5 }";

fn scene(target: &str, law: &str, more: &str) -> String {
    format!(
        "name = \"unit\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n{target}\n[law]\nloading = {law:?}\n\
         [impact]\nmass = 4.11e-3\nspeed = 2.0\n{more}"
    )
}

fn predicted(text: &str, arguments: &[&str]) -> Value {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    let all = ["predict", "scene.toml", "--json"].into_iter().chain(arguments.iter().copied());
    run(folder.path(), all).with_status(0).json()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn the_strength_follows_from_the_mean_strain_rate_of_the_impact() {
    let johnson_cook = |rate: f64| 1.0 + 0.014 * rate.ln();
    let cowper_symonds = |rate: f64| 1.0 + (rate / 40.4).powf(0.2);
    let models: [(&str, &dyn Fn(f64) -> f64); 2] = [(JOHNSON_COOK, &johnson_cook), (COWPER_SYMONDS, &cowper_symonds)];
    for (model, factor) in models {
        for law in ["brinell", "big-alabo", "johnson", "jackson-green"] {
            for speed in ["0.2", "1.0", "20.0"] {
                let answer = predicted(&scene(model, law, ""), &["--speed", speed]);
                let (strength, impact) = (&answer["strength"], &answer["laws"][0]);
                let strain = 0.2 * number(&impact["largest_contact_radius"]) / 5e-3;
                let rate = strain / number(&impact["loading_time"]);
                assert!((number(&strength["strain_rate"]) / rate - 1.0).abs() < 1e-8, "{law} at {speed}: {answer}");
                assert!((number(&strength["factor"]) / factor(rate) - 1.0).abs() < 1e-8, "{law} at {speed}: {answer}");
                let expected = 300e6 * factor(rate);
                assert!((number(&strength["yield_strength"]) / expected - 1.0).abs() < 1e-8, "{law} at {speed}");
                assert!(answer["notes"].to_string().contains("strain rate of this impact"), "{answer}");
            }
        }
    }
}

#[test]
fn below_the_reference_rate_nothing_changes() {
    let model = "rate = { model = \"johnson-cook\", c = 0.5, reference_rate = 1e6 }";
    let (slow, plain) = (predicted(&scene(model, "brinell", ""), &[]), predicted(&scene("", "brinell", ""), &[]));
    assert_eq!(slow["laws"], plain["laws"]);
    assert_eq!(number(&slow["strength"]["factor"]), 1.0);
}

#[test]
fn the_fmu_starts_with_the_strength_of_the_impact_and_agrees_with_the_prediction() {
    let folder = empty_folder();
    let coupled = "[coupling]\neffective_mass = 4.11e-3\n";
    let hardens = format!("{COWPER_SYMONDS}\nhardening_modulus = 2e9");
    let moved = scene(&hardens, "brinell", coupled);
    let bodies = "[[body]]\nname = \"lower\"\nmass = 0.033\n[[body]]\nname = \"upper\"\nmass = 0.02\n\
                  [[contact]]\nname = \"pair\"\nbetween = [\"upper\", \"lower\"]\n\
                  [[contact]]\nname = \"floor\"\nbetween = [\"lower\", \"ground\"]\n";
    let shared = scene(&hardens, "brinell", bodies).replace("mass = 4.11e-3\n", "");
    let losing = |text: &str| text.replace("[law]\n", "[law]\nelastic_restitution = 0.8\n");
    for (text, finds) in [
        (scene(JOHNSON_COOK, "brinell", ""), false),
        (scene(COWPER_SYMONDS, "big-alabo", ""), false),
        (losing(&moved), true),
        (losing(&shared), true),
        (moved, true),
        (shared, true),
    ] {
        fs::write(folder.path().join("scene.toml"), &text).unwrap();
        let strength = predicted(&text, &[])["strength"].clone();
        let written = Written::of(&text);
        let numbers: Vec<f64> = written.words.iter().copied().map(f64::from_bits).collect();
        // a unit that knows the mass multiplies by the factor itself
        let factor = if finds { number(&strength["factor"]) } else { 1.0 };
        for name in ["yield_strength", "hardening_modulus"] {
            let value = number(&strength[name]) / factor;
            // reading the JSON may change the last digit
            let is_near = |found: &f64| (found - value).abs() < 1e-12 * value;
            let found = numbers.iter().any(is_near) || finds && numbers.contains(&value.round());
            assert!(value == 0.0 || found, "{name} = {value:e} in {}", written.rust);
        }
        run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(0);
        run(folder.path(), ["check", "unit.fmu"]).with_status(0);
    }
}

#[test]
fn contacts_with_other_bodies_have_their_own_factor() {
    let contacts = "[[contact]]\nname = \"small\"\nimpactor = { radius = 1e-3 }\ntarget = { yield_strength = 300e6 }\n\
                    [[contact]]\nname = \"large\"\ntarget = { yield_strength = 300e6 }\n";
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), scene(COWPER_SYMONDS, "brinell", contacts)).unwrap();
    let exported = run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu", "--json"]).with_status(0).json();
    let strength = |index: usize| number(&exported["contacts"][index]["own"]["target.yield_strength"]);
    assert!(strength(0) > 1.05 * strength(1) && strength(1) > 2.0 * 300e6, "{exported}");
}
