//! What is true of the FMU of any scene: it does what is predicted, it is the same bytes each time, a parameter that is set acts like that of
//! another scene, and a contact among several does what it does alone.

use crate::command::{Run, assert_same, run};
use crate::differential::scenes;
use crate::kinds::of_each_kind;
use crate::loaded::{Instance, OK, Unit};
use crate::physics::Random;
use crate::prebuilt::{export, export_anew, store};
use brinell_exporter::scene::Scene;
use brinell_testing::long;
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fs;
use std::path::Path;

/// The FMU of a scene.
fn unit(text: &str) -> Unit {
    Unit::open(&export(text, Some(store())))
}

/// The check of the FMU of a scene.
fn checked(text: &str) -> Run {
    run(export(text, Some(store())).parent().expect("a folder"), ["check", "unit.fmu", "--json"])
}

#[test]
fn the_fmu_of_any_scene_does_what_is_predicted_and_is_the_same_bytes_each_time() {
    let chosen = of_each_kind().into_iter().map(|(_, text)| text);
    for text in scenes(8, long::cases(120) as usize).map(|(text, _)| text).chain(chosen) {
        // a slow constant rate must reach the surface, and a contact that begins indented is not moved
        let text = text.replace("initial_gap = 1e-6", "initial_gap = 0.0").replace("initial_gap = -1e-7", "");
        let check = checked(&text);
        assert!(check.status == Some(0) && check.json()["passed"] == true, "{}\n{text}", check.out);
        let (fmu, (again, _)) = (export(&text, Some(store())), export_anew(&text, Some(store())));
        assert_same(&fs::read(&fmu).unwrap(), &fs::read(again).unwrap());
    }
}

/// The outputs after steps with rates of both signs and many sizes; contacts also slide.
fn history(mut instance: Instance, seed: u64) -> Vec<u64> {
    let (mut random, mut all, mut time) = (Random(seed), Vec::new(), 0.0);
    let named = instance.face.named.clone();
    for _ in 0..100 {
        let step = random.log_uniform(1e-8, 1e-6);
        let rates = instance.face.rates.iter().chain(&instance.face.sideways);
        for &rate in rates.collect::<Vec<_>>() {
            let speed = if random.next() < 0.6 { 3.0 } else { -3.0 } * random.next();
            assert_eq!(instance.set(&[rate], &[speed]), OK, "{}", instance.message());
        }
        assert_eq!(instance.step(time, step), OK, "{}", instance.message());
        time += step;
        all.extend(instance.bits());
        for name in named.keys().filter(|name| name.ends_with("contact_radius")) {
            let area = name.replace("contact_radius", "contact_area");
            if !named.contains_key(&area) {
                continue;
            }
            let [radius, area] = [name, &area].map(|name| instance.real(name));
            assert!((area - PI * radius * radius).abs() <= 4.0 * f64::EPSILON * area, "{area} of {radius}");
        }
    }
    instance.reset();
    all
}

/// The text of a scene with another number under the keys of this parameter.
fn with(text: &str, parameter: &str, value: f64) -> String {
    let mut scene: toml::Table = text.parse().expect("a scene");
    let (table, key) = match parameter {
        "initial_gap" => ("fmu", parameter),
        "effective_mass" => ("coupling", parameter),
        "restitution" | "elastic_restitution" => ("law", parameter),
        _ => parameter.split_once('.').expect("a body and its property"),
    };
    let table = scene.entry(table).or_insert_with(|| toml::Table::new().into()).as_table_mut().expect("a table");
    table.insert(key.into(), value.into());
    scene.to_string()
}

/// Scenes of one contact whose parameters are those of the FMU alone: no strength or damping follows from the impact.
fn plain_scenes(seed: u64, count: usize) -> impl Iterator<Item = (String, Scene)> {
    let follows =
        ["rate =", "power_law", "tangent_modulus", "[[contact]]", "[[body]]", "radius = [", "cylinder", "table ="];
    scenes(seed, usize::MAX).filter(move |(text, _)| !follows.iter().any(|word| text.contains(word))).take(count)
}

#[test]
fn a_parameter_that_is_set_acts_like_that_of_another_scene() {
    let (mut random, mut seen) = (Random(4), BTreeMap::new());
    for (text, _) in plain_scenes(17, long::cases(160) as usize) {
        let one = unit(&text);
        let parameters: Vec<_> =
            one.face.variables.iter().filter(|variable| variable.causality == "parameter").cloned().collect();
        for parameter in parameters {
            let start = parameter.start.expect("every parameter has one");
            let value = match &*parameter.name {
                "initial_gap" => -1e-7 * random.next(),
                "target.poissons_ratio" => 0.2 + 0.2 * random.next(),
                _ => start * (0.8 + 0.2 * random.next()),
            };
            let other = with(&text, &parameter.name, value);
            // such an impact may be too hard for the law
            let Ok(_) = Scene::parse(other.clone(), Path::new("other.toml")) else { continue };
            let set = history(one.ready_with(&[(&parameter.name, value)]), 3);
            let other = unit(&other);
            assert!(set == history(other.ready(), 3), "{} = {value} in\n{text}", parameter.name);
            *seen.entry(parameter.name.clone()).or_insert(0) += 1;
            let refused = one.instantiate();
            assert_ne!(refused.set(&[parameter.reference], &[2.0 * parameter.limits().1 + 1.0]), OK);
            assert!(refused.message().contains("is out of range: allowed is"), "{}", refused.message());
        }
    }
    println!("{seen:?}");
    assert!(seen.len() > 6, "{seen:?}");
}

/// Moves every contact of `all` and its FMU in `singles` alike, and compares all outputs.
fn compare(what: &str, all: &mut Instance, singles: &mut [(&str, Instance, &Unit)], random: &mut Random) {
    for step in 0..60 {
        for (prefix, single, unit) in singles.iter_mut() {
            for input in unit.face.variables.iter().filter(|variable| variable.causality == "input") {
                let value = match input.name.as_str() {
                    "effective_mass" => random.log_uniform(1e-3, 1e-1),
                    _ => 4.0 * random.next() - 1.9,
                };
                single.set_one(&input.name, value);
                all.set_one(&format!("{prefix}{}", input.name), value);
            }
            for output in unit.face.variables.iter().filter(|variable| variable.causality == "output") {
                let (own, name) = (&output.name, format!("{prefix}{}", output.name));
                let bits = match output.is_real {
                    true => [single.real(own), all.real(&name)].map(f64::to_bits),
                    false => [single.integer(own), all.integer(&name)].map(|number| number as u64),
                };
                assert_eq!(bits[0], bits[1], "{name} in step {step} of\n{what}");
            }
            assert_eq!(single.step(f64::from(step) * 1e-6, 1e-6), OK, "{}\n{what}", single.message());
        }
        assert_eq!(all.step(f64::from(step) * 1e-6, 1e-6), OK, "{}\n{what}", all.message());
    }
}

#[test]
fn a_contact_among_several_does_what_it_does_alone_to_the_last_bit() {
    let mut random = Random(27);
    for (text, _) in plain_scenes(29, long::cases(120) as usize) {
        let own = [("impactor.radius", 4e-3), ("target.youngs_modulus", 190e9), ("target.density", 5000.0)];
        let alone = own.iter().fold(text.clone(), |text, (name, value)| with(&text, name, *value));
        let own = "impactor = { radius = 4e-3 }\ntarget = { youngs_modulus = 190e9, density = 5000.0 }\n";
        // what can be set in the FMU of one contact, each of a row has for itself
        let plain = unit(&text);
        let given = [
            ("initial_gap", 3e-8),
            ("impactor.radius", 7e-3),
            ("target.yield_strength", 4e8),
            ("effective_mass", 9e-3),
        ];
        let has = |name: &str| plain.face.variables.iter().any(|one| one.name == name && one.causality == "parameter");
        let given: Vec<_> = given.into_iter().filter(|(name, _)| has(name)).collect();
        let row =
            format!("count = 2\nparameters_per_contact = {:?}\n", given.iter().map(|own| own.0).collect::<Vec<_>>());
        let row = if given.is_empty() { "count = 2\n" } else { &row };
        let several = format!("{text}[[contact]]\nname = \"row\"\n{row}[[contact]]\nname = \"own\"\n{own}");
        if [&several, &alone].iter().any(|text| Scene::parse(text.to_string(), Path::new("several.toml")).is_err()) {
            continue;
        }
        let (all, alone) = (unit(&several), unit(&alone));
        let mut several = all.instantiate();
        given.iter().for_each(|(name, value)| several.set_one(&format!("row[2].{name}"), *value));
        several.initialize();
        let mut singles = [
            ("row[1].", plain.ready(), &plain),
            ("row[2].", plain.ready_with(&given), &plain),
            ("own.", alone.ready(), &alone),
        ];
        compare(&text, &mut several, &mut singles, &mut random);
    }
}
