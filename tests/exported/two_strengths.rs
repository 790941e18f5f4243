//! Scenes whose impactor may yield, too: the softer body yields first.

use crate::command::{empty_folder, run};
use crate::loaded::{Instance, OK, Unit};
use crate::physics::{Random, brinell};
use crate::unit;
use crate::written::Written;
use brinell_contact::{Body, Loading, OtherBody, Pair, TwoBodies};
use serde_json::Value;
use std::fs;

/// Steel, stronger and stiffer than the aluminium.
const STEEL: &str = "youngs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 400e6\n";
const ALUMINIUM: &str = "youngs_modulus = 69e9\npoissons_ratio = 0.36\nyield_strength = 250e6\n";
const OUTPUTS: [&str; 6] =
    ["force", "indentation", "residual_indentation", "contact_radius", "work", "dissipated_energy"];

/// A scene with these lines of its bodies, which are balls of the same size, this law, and more tables.
fn scene(impactor: &str, target: &str, law: &str, more: &str) -> String {
    let outputs = &OUTPUTS[1..];
    format!(
        "name = \"unit\"\n[impactor]\nradius = 10e-3\n{impactor}[target]\nradius = 10e-3\n{target}[law]\n\
         loading = {law:?}\n[fmu]\noutputs = {outputs:?}\n[impact]\nmass = 4.11e-3\nspeed = 2.0\n{more}"
    )
}

/// The answer of `predict` for the scene `text`.
fn predicted(text: &str) -> Value {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    run(folder.path(), ["predict", "scene.toml", "--json"]).with_status(0).json()
}

fn load(name: &str, text: &str) -> Unit {
    Unit::load(&unit::write_scene(name, text))
}

/// A random number between two, log-uniform.
fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low * (high / low).powf(random.next())
}

/// Steps of any size with rates of both signs, and the outputs after each.
fn history(instance: Instance, seed: u64) -> Vec<[f64; 6]> {
    let mut random = Random(seed);
    let outputs = OUTPUTS.map(|name| instance.real_of(name));
    let rate = instance.real_of("indentation_rate");
    let (mut time, mut all, mut depth) = (0.0, Vec::new(), 0.0);
    for _ in 0..400 {
        let (speed, step) = (between(&mut random, 1e-3, 10.0), between(&mut random, 1e-8, 1e-5));
        let sign = if 1.4 * random.next() - 0.4 > depth * 2e3 { 1.0 } else { -1.0 };
        assert_eq!(instance.set(&[rate], &[sign * speed]), OK);
        assert_eq!(instance.step(time, step), OK, "{}", instance.message());
        time += step;
        depth += sign * speed * step;
        let mut values = [0.0; 6];
        assert_eq!(instance.get(&outputs, &mut values), OK);
        all.push(values);
    }
    assert!(all.iter().any(|values| values[2] > 0.0), "it has yielded");
    all
}

#[test]
fn scenes_with_exchanged_materials_have_the_same_force() {
    // the only law that hardens, and one whose work is an integral
    for law in ["brinell", "jackson-green"] {
        let name = |order: &str| format!("{law}-{order}").replace('-', "_");
        let hardens = if law == "brinell" { "hardening_modulus = 2e9\n" } else { "" };
        let soft = format!("{ALUMINIUM}{hardens}");
        let one = load(&name("soft_ball"), &scene(&soft, STEEL, law, ""));
        let other = load(&name("soft_plate"), &scene(STEEL, &soft, law, ""));
        for seed in 1..20 {
            let histories = [one.ready(), other.ready()].map(|instance| history(instance, seed));
            assert_eq!(histories[0], histories[1], "{law}, {seed}");
        }
    }
}

/// Young's modulus, Poisson's ratio, yield strength and hardening modulus of any metal.
fn any_metal(random: &mut Random) -> [f64; 4] {
    let modulus = between(random, 2e10, 6e11);
    let hardening = if random.next() < 0.3 { 0.0 } else { modulus * between(random, 1e-4, 0.1) };
    [modulus, 0.2 + 0.25 * random.next(), modulus / between(random, 100.0, 2000.0), hardening]
}

#[test]
fn an_fmu_has_the_force_of_the_law_for_any_two_bodies_that_are_set() {
    let text = |metal: &str| format!("{metal}hardening_modulus = 2e9\n");
    let balls = scene(&text(STEEL), &text(ALUMINIUM), "brinell", "");
    let unit = load("any_two_bodies", &balls.replace("[target]\nradius = 10e-3", "[target]\nradius = 30e-3"));
    let mut random = Random(23);
    for _ in 0..60 {
        let metals = [any_metal(&mut random), any_metal(&mut random)];
        let names = ["youngs_modulus", "poissons_ratio", "yield_strength", "hardening_modulus"];
        let named: Vec<_> = ["impactor", "target"]
            .iter()
            .zip(metals)
            .flat_map(|(body, metal)| names.map(|name| format!("{body}.{name}")).into_iter().zip(metal))
            .collect();
        let values: Vec<_> = named.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let instance = unit.ready_with(&values);
        let [impactor, target] = [(10e-3, metals[0]), (30e-3, metals[1])]
            .map(|(radius, [youngs_modulus, poissons_ratio, ..])| Body { radius, youngs_modulus, poissons_ratio });
        let (soft, hard) = if metals[0][2] < metals[1][2] { (0, 1) } else { (1, 0) };
        let bodies = [impactor, target];
        let pair = Pair::new(&impactor, &target, metals[soft][2]).expect("they touch");
        let other = OtherBody {
            modulus: bodies[hard].plane_strain_modulus(),
            poissons_ratio: bodies[hard].poissons_ratio,
            yield_strength: metals[hard][2],
            hardening_modulus: metals[hard][3],
        };
        let pair = pair.yielding_in(&bodies[soft], metals[soft][2]);
        let curvature = bodies[soft].curvature(&bodies[hard]);
        let model = brinell(pair, TwoBodies { hardening_modulus: metals[soft][3], curvature, other });
        let (rate, force) = (instance.real_of("indentation_rate"), instance.real_of("force"));
        let (mut time, mut depth) = (0.0, 0.0);
        for _ in 0..20 {
            let (speed, step) = (between(&mut random, 0.1, 10.0), 1e-7);
            assert_eq!((instance.set(&[rate], &[speed]), instance.step(time, step)), (OK, OK));
            (time, depth) = (time + step, depth + speed * step);
            let mut shown = [0.0];
            assert_eq!(instance.get(&[force], &mut shown), OK);
            let expected = model.loading.segment(&pair, depth).force(depth);
            assert!((shown[0] - expected).abs() <= 1e-11 * expected, "{metals:?} at {depth}: {shown:?} {expected}");
        }
    }
}

#[test]
fn the_prediction_is_that_of_exchanged_bodies_and_the_fmu_agrees_with_it() {
    let folder = empty_folder();
    let rate = "rate = { model = \"johnson-cook\", c = 0.014, reference_rate = 1.0 }\n";
    let power_law = "youngs_modulus = 69e9\npoissons_ratio = 0.36\npower_law = { coefficient = 5e8, exponent = 0.2 }\n";
    let rated = format!("{ALUMINIUM}{rate}");
    let strong = STEEL.replace("400e6", "900e6");
    let coupled = "[coupling]\neffective_mass = 4.11e-3\n";
    for (soft, law, more) in [
        (ALUMINIUM, "big-alabo", ""),
        (power_law, "brinell", ""),
        (&rated, "brinell", ""),
        (&rated, "brinell", coupled),
        (&rated, "thornton", coupled),
        (ALUMINIUM, "jackson-green", coupled),
    ] {
        let text = scene(soft, &strong, law, more);
        let (one, other) = (predicted(&text), predicted(&scene(&strong, soft, law, more)));
        assert_eq!(one["laws"], other["laws"], "{soft} {law}");
        assert_eq!(one["strength"], other["strength"], "{soft} {law}");
        assert!(one["notes"].to_string().contains("the dent is in the impactor"), "{one}");
        assert!(!other["notes"].to_string().contains("the dent is in the impactor"), "{other}");
        fs::write(folder.path().join("scene.toml"), text).unwrap();
        run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(0);
        run(folder.path(), ["check", "unit.fmu"]).with_status(0);
    }
}

#[test]
fn a_target_without_a_strength_stays_elastic_under_an_impactor_that_yields() {
    let hard = "youngs_modulus = 206e9\npoissons_ratio = 0.3\n";
    let one = predicted(&scene(ALUMINIUM, hard, "big-alabo", ""));
    let other = predicted(&scene(hard, ALUMINIUM, "big-alabo", ""));
    assert_eq!(one["laws"], other["laws"]);
}

#[test]
fn the_strength_of_a_material_is_a_parameter_only_if_it_is_below_that_of_the_target() {
    for (impactor, is_parameter) in [
        ("material = \"aluminium 6061-T6\"\n", true),
        ("material = \"titanium Ti-6Al-4V\"\n", false),
        ("material = \"titanium Ti-6Al-4V\"\nyield_strength = 880e6\n", true),
        ("", false),
    ] {
        let written = Written::of(&scene(impactor, STEEL, "big-alabo", ""));
        assert_eq!(written.has_text("impactor.yield_strength"), is_parameter, "{impactor}");
    }
}
