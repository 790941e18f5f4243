//! What is true of the FMU of any scene: it does what is predicted, it is the same bytes each time, a parameter that is set acts like that of
//! another scene, and a contact among several does what it does alone.

use crate::command::{Run, assert_same, run};
use crate::differential::scenes;
use crate::kinds::of_each_kind;
use crate::loaded::{Instance, OK, Unit};
use crate::physics::Random;
use crate::prebuilt::{export, export_anew, store};
use brinell_exporter::scene::Scene;
use brinell_testing::importer::Importer;
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
        "effective_mass" => {
            // that of the impact is the same, and without bodies to move the only one
            if let Some(impact) = scene.get_mut("impact") {
                impact["mass"] = value.into();
            }
            if scene.contains_key("coupling") { ("coupling", parameter) } else { ("impact", "mass") }
        }
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
    // one with a restitution below yield, and one with a plate in place of waves
    let lossy = of_each_kind().into_iter().filter(|(kind, text)| *kind == "lossy" && text.contains("elastic"));
    let lossy = lossy.map(|(_, text)| match text.split_once("elastic_restitution = \"waves\"\n") {
        Some((before, after)) => {
            (before.to_string() + after).replace("[target]\n", "[target]\nplate_thickness = 0.01\n")
        }
        None => text,
    });
    for text in plain_scenes(17, long::cases(80) as usize).map(|(text, _)| text).chain(lossy) {
        let one = unit(&text);
        let parameters: Vec<_> =
            one.face.variables.iter().filter(|variable| variable.causality == "parameter").cloned().collect();
        for parameter in parameters {
            let start = parameter.start.expect("every parameter has one");
            let value = match &*parameter.name {
                "initial_gap" => -1e-7 * random.next(),
                "target.poissons_ratio" => 0.2 + 0.2 * random.next(),
                // the other body may become the softer one
                name if name.ends_with("_strength") => start * random.log_uniform(0.4, 2.5),
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
    let losses = ["elastic_restitution", "target.plate_thickness"];
    assert!(seen.len() > 6 && losses.iter().all(|name| seen.contains_key(*name)), "{seen:?}");
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
    for (text, _) in plain_scenes(29, long::cases(60) as usize) {
        let own = [("impactor.radius", 4e-3), ("target.youngs_modulus", 190e9), ("target.density", 5000.0)];
        let alone = own.iter().fold(text.clone(), |text, (name, value)| with(&text, name, *value));
        let own = "impactor = { radius = 4e-3 }\ntarget = { youngs_modulus = 190e9, density = 5000.0 }\n";
        // what can be set in the FMU of one contact, each of a row has for itself; the others have another value in common
        let plain = unit(&text);
        let given = [
            ("initial_gap", 3e-8, 5e-8),
            ("impactor.radius", 7e-3, 6e-3),
            ("target.yield_strength", 4e8, 3.5e8),
            ("effective_mass", 9e-3, 6e-3),
        ];
        let has = |name: &str| plain.face.variables.iter().any(|one| one.name == name && one.causality == "parameter");
        let given: Vec<_> = given.into_iter().filter(|(name, ..)| has(name)).collect();
        let row =
            format!("count = 2\nparameters_per_contact = {:?}\n", given.iter().map(|own| own.0).collect::<Vec<_>>());
        let row = if given.is_empty() { "count = 2\n" } else { &row };
        // steps without derivatives are the same where none can be set
        let several = text.replace("input_derivatives = false\n", "");
        let several = several + "[[contact]]\nname = \"plain\"\n[[contact]]\nname = \"row\"\n" + row;
        let several = several + "[[contact]]\nname = \"own\"\n" + own;
        if [&several, &alone].iter().any(|text| Scene::parse(text.to_string(), Path::new("several.toml")).is_err()) {
            continue;
        }
        let (all, alone) = (unit(&several), unit(&alone));
        let mut several = all.instantiate();
        for (name, of_one, of_others) in &given {
            several.set_one(&format!("row[2].{name}"), *of_one);
            several.set_one(name, *of_others);
        }
        several.initialize();
        let of_one: Vec<_> = given.iter().map(|(name, value, _)| (*name, *value)).collect();
        let of_others: Vec<_> = given.iter().map(|(name, _, value)| (*name, *value)).collect();
        let of_own: Vec<_> = of_others.iter().filter(|(name, _)| *name != "impactor.radius").copied().collect();
        let mut singles = [
            ("plain.", plain.ready_with(&of_others), &plain),
            ("row[1].", plain.ready(), &plain),
            ("row[2].", plain.ready_with(&of_one), &plain),
            ("own.", alone.ready_with(&of_own), &alone),
        ];
        compare(&text, &mut several, &mut singles, &mut random);
    }
}

/// Outputs of a step as a whole, which do not change at its end.
const OF_A_STEP: [&str; 5] = ["mean_force", "mean_tangential", "predicted_", "_moment", "_number"];

/// Sets the rates of bodies that the FMU moves to their own speeds.
fn go_on(instance: &mut Instance) {
    for variable in &instance.face.variables {
        let own =
            variable.name.replace("indentation_rate", "closing_speed").replace("tangential_rate", "tangential_speed");
        if own != variable.name && instance.face.named.contains_key(&own) {
            assert_eq!(instance.set(&[variable.reference], &[instance.real(&own)]), OK);
        }
    }
}

/// Moves contacts to and fro by three steps from the time `from`, and returns the time.
fn moved(instance: &mut Instance, random: &mut Random, from: f64) -> f64 {
    let mut time = from;
    for length in [random.log_uniform(1e-8, 1e-6), random.log_uniform(1e-8, 1e-6), 1e-9] {
        let inputs = instance.face.variables.iter().filter(|variable| variable.causality == "input");
        for variable in inputs.filter(|variable| !variable.name.contains("mass")) {
            let size = random.log_uniform(1e-2, 3.0);
            let value = if random.next() < 0.6 { size } else { -size };
            assert_eq!(instance.set(&[variable.reference], &[value]), OK, "{}", instance.message());
        }
        if length == 1e-9 {
            go_on(instance);
        }
        assert_eq!(instance.step(time, length), OK, "{}", instance.message());
        time += length;
    }
    time
}

/// All outputs.
fn read(instance: &Instance) -> Vec<f64> {
    let mut values = vec![0.0; instance.face.outputs.len()];
    assert_eq!(instance.get(&instance.face.outputs, &mut values), OK, "{}", instance.message());
    values
}

/// How often derivatives of an output that isn't constant were judged: first and second ones by time, and those by inputs.
type Judged = BTreeMap<String, [u32; 3]>;

/// Outputs of friction, and how many of their derivatives are as near as those of others, and how many aren't: springs are tried, and a dent
/// that grows changes them.
struct Springs(bool, [u32; 2]);

/// Derivatives by time, for motions that go on as they are. At a corner of the law there is nothing to compare with.
fn of_a_course(instance: &mut Instance, time: f64, text: &str, judged: &mut Judged, springs: &mut Springs) {
    let (state, width, mut after) = (instance.save(), 2e-10, vec![read(instance)]);
    for place in 1..7 {
        instance.restore(state);
        go_on(instance);
        assert_eq!(instance.step(time, f64::from(place) * width), OK, "{}", instance.message());
        after.push(read(instance));
    }
    let face = instance.face;
    for (name, reference) in &face.named {
        let place_of = |reference: &u32| face.outputs.iter().position(|other| other == reference).expect("an output");
        let (at, (prefix, own)) = (place_of(reference), name.rsplit_once('.').unwrap_or(("", name)));
        let mut slope = |order| {
            instance.restore(state);
            let mut slope = [0.0];
            (instance.output_derivatives(&[*reference], order, &mut slope) == OK).then_some(slope[0])
        };
        let (Some(first), second) = (slope(1), slope(2)) else {
            assert!(text.contains("plate_thickness"), "{name} has no derivative in\n{text}");
            continue;
        };
        let count = judged.entry(own.into()).or_default();
        if OF_A_STEP.iter().any(|part| own.contains(part)) {
            assert_eq!((first, second.unwrap_or(0.0)), (0.0, 0.0), "{name} in\n{text}");
            continue;
        }
        let [near, far] = [1, 2].map(|every| {
            let (width, of) = (width * every as f64, |place: usize| after[every * place][at]);
            let first = (-11.0 * of(0) + 18.0 * of(1) - 9.0 * of(2) + 2.0 * of(3)) / (6.0 * width);
            (first, (2.0 * of(0) - 5.0 * of(1) + 4.0 * of(2) - of(3)) / (width * width))
        });
        let size = after.iter().map(|values| values[at].abs()).fold(f64::MIN_POSITIVE, f64::max);
        let noise = 1e-13 * size / width;
        let slides = own == "stick_radius" && after[0][at] == 0.0;
        if slides || (near.0 - far.0).abs() > 1e-4 * near.0.abs() + noise {
            continue;
        }
        let what = format!("{name}: {first:e}, {second:?} for {near:?} in\n{text}");
        let off = (first - near.0).abs() / (near.0.abs() + noise * 1e4);
        let of_springs = springs.0 && ["tangential", "friction", "stick"].iter().any(|part| own.contains(part));
        springs.1[usize::from(off > 1e-3)] += u32::from(of_springs);
        assert!(off <= if of_springs { 0.2 } else { 1e-4 }, "{what}");
        let is_heat = own != "friction_work" || after.windows(2).all(|two| two[1][at] >= two[0][at] - 1e-12 * size);
        assert!(is_heat, "{name} falls in\n{text}");
        count[0] += u32::from(near.0 != 0.0);
        // those of some laws are differences, too
        let force = place_of(&face.named[&if prefix.is_empty() { "force".into() } else { format!("{prefix}.force") }]);
        let pace = (after[1][force] - after[0][force]).abs() / width / after[0][force].max(f64::MIN_POSITIVE);
        let noise = size * (1e-12 / (width * width) + 1e-4 * pace * pace);
        let is_smooth = (near.1 - far.1).abs() <= 1e-2 * near.1.abs() + noise;
        if let Some(second) = second.filter(|_| is_smooth && !of_springs) {
            assert!((second - near.1).abs() <= 5e-2 * near.1.abs() + noise, "{what}");
            count[1] += u32::from(near.1.abs() > 10.0 * noise);
        }
    }
    instance.restore(state);
    instance.free(state);
}

/// Derivatives by each input, of all outputs.
fn by_inputs(instance: &mut Instance, text: &str, judged: &mut Judged) {
    let (state, here, face) = (instance.save(), read(instance), instance.face);
    for &input in &face.inputs {
        let (mut slopes, rate) = (vec![0.0; here.len()], Importer::real(instance, input));
        let status = instance.directional(&face.outputs, input, &mut slopes);
        assert_eq!(status, OK, "{} in\n{text}", instance.message());
        let width = 1e-4 * rate.abs().max(1e-3);
        let [above, below] = [width, -width].map(|by| {
            assert_eq!(instance.set(&[input], &[rate + by]), OK);
            read(instance)
        });
        instance.restore(state);
        for (name, reference) in &face.named {
            let at = face.outputs.iter().position(|other| other == reference).expect("an output");
            let (slope, one_sided) = ((above[at] - below[at]) / (2.0 * width), (above[at] - here[at]) / width);
            let off = (slopes[at] - slope).abs();
            let is_right = off <= 1e-2 * slope.abs() + 1e-12 * here[at].abs() / width;
            let is_corner = (slope - one_sided).abs() > 1e-3 * slope.abs();
            assert!(is_right || is_corner, "{name} by {input}: {:e} for {slope:e} in\n{text}", slopes[at]);
            let own = name.rsplit('.').next().expect("a last part");
            judged.entry(own.into()).or_default()[2] += u32::from(slope != 0.0 && !is_corner);
        }
    }
    instance.free(state);
}

#[test]
fn derivatives_of_any_scene_are_those_of_its_course_and_by_its_inputs() {
    let (mut random, mut judged, mut springs) = (Random(5), Judged::new(), Springs(false, [0; 2]));
    for (text, _) in scenes(41, long::cases(160) as usize) {
        springs.0 = text.contains("[friction]");
        // an importer that applies forces late owes the bodies some, and the speed along the surface has to be told
        let is_untold = springs.0 && text.contains("[coupling]") && !text.contains("\"tangential_speed");
        if is_untold || text.contains("parallel") {
            continue;
        }
        let unit = unit(&text);
        let (mut instance, mut time) = (unit.ready(), 0.0);
        for _ in 0..8 {
            time = moved(&mut instance, &mut random, time);
            of_a_course(&mut instance, time, &text, &mut judged, &mut springs);
            by_inputs(&mut instance, &text, &mut judged);
        }
    }
    let seen = [0, 1, 2].map(|kind| judged.values().filter(|counts| counts[kind] > 5).count());
    println!("{judged:?}, of springs {:?}", springs.1);
    assert!(seen[0] >= 20 && seen[1] >= 10 && seen[2] >= 5, "{seen:?}: little was judged");
    assert!(springs.1[0] > 20 * springs.1[1], "{:?}", springs.1);
}
