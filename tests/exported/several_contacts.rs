//! FMUs with several contacts, called like by an importer: each contact equals that of a separate FMU to the last bit, whatever the
//! features and whatever it has for itself; either all of them move or none.

use crate::loaded::{ERROR, Instance, OK, Unit};
use crate::physics::Random;
use crate::unit::write_scene;
use std::fmt::Write;

const LAWS: [&str; 9] = [
    "loading = \"big-alabo\"",
    "loading = \"brinell\"",
    "loading = \"thornton\"\nunloading = \"thornton\"",
    "loading = \"jackson-green\"\nunloading = \"jackson\"",
    "loading = \"hertz\"",
    "loading = \"brinell\"\nelastic_restitution = 0.9",
    "loading = \"big-alabo\"\nelastic_restitution = \"waves\"",
    "loading = \"hunt-crossley\"\nrestitution = 0.6",
    "loading = \"tsuji\"\nrestitution = 0.6",
];

/// What contacts may have besides a law. Friction is for those without a loss.
const FEATURES: [&str; 5] = ["", "parallel", "serial", "line", "plane"];

/// What a contact may have for itself.
#[derive(Clone, Copy)]
struct Own {
    radius: f64,
    /// Yield strength of an impactor that yields \[Pa\].
    soft: Option<f64>,
    strength: f64,
    density: f64,
    gap: f64,
    coefficient: f64,
    mass: f64,
}

const COMMON: Own =
    Own { radius: 5e-3, soft: None, strength: 3e8, density: 7850.0, gap: 1e-7, coefficient: 0.3, mass: 4e-3 };
const OTHER: Own = Own {
    radius: 4e-3,
    soft: Some(2.5e8),
    strength: 4.2e8,
    density: 5000.0,
    gap: -1e-6,
    coefficient: 0.05,
    mass: 1e-3,
};

/// A scene whose contacts have this law and feature, and these numbers.
fn scene(law: &str, feature: &str, surface: &str, own: Own) -> String {
    let Own { radius, soft, strength, density, gap, coefficient, mass } = own;
    let mut text = format!(
        "name = \"unit\"\n[impactor]\nradius = {radius:e}\nyoungs_modulus = 210e9\npoissons_ratio = 0.3\n{}[target]\n\
         material = \"mild steel\"\nyield_strength = {strength:e}\ndensity = {density:e}\nsurface = {surface:?}\n[law]\n{law}\n\
         [fmu]\ninitial_gap = {gap:e}\noutputs = [\"indentation\", \"residual_indentation\", \"contact_radius\", \"stiffness\", \
         \"dissipated_energy\", \"mean_force\", \"predicted_force\", \"regime\"",
        soft.map(|strength| format!("yield_strength = {strength:e}\n")).unwrap_or_default()
    );
    text += match feature {
        "" => "]\n",
        "serial" | "parallel" => ", \"closing_speed\"]\n",
        _ => ", \"mean_tangential_force\", \"friction_work\", \"sliding\"]\n",
    };
    match feature {
        "" => write!(text, "[impact]\nmass = {mass:e}\nspeed = 1.0\n"),
        "serial" | "parallel" => write!(text, "[coupling]\nmaster = {feature:?}\neffective_mass = {mass:e}\n"),
        _ => {
            let directions = if feature == "plane" { 2 } else { 1 };
            write!(text, "[friction]\ncoefficient = {coefficient:e}\ndirections = {directions}\n")
        }
    }
    .expect("a text can be written to");
    text
}

/// The table of a contact that has all of `own` for itself.
fn table(name: &str, feature: &str, own: Own) -> String {
    let Own { radius, soft, strength, density, gap, coefficient, mass } = own;
    let soft = soft.map(|strength| format!(", yield_strength = {strength:e}")).unwrap_or_default();
    let more = match feature {
        "" => String::new(),
        "serial" | "parallel" => format!("effective_mass = {mass:e}\n"),
        _ => format!("friction = {{ coefficient = {coefficient:e} }}\n"),
    };
    format!(
        "[[contact]]\nname = {name:?}\nimpactor = {{ radius = {radius:e}{soft} }}\n\
         target = {{ yield_strength = {strength:e}, density = {density:e} }}\ninitial_gap = {gap:e}\n{more}"
    )
}

/// Moves every contact of `all` and its FMU in `singles` alike, and compares all outputs.
fn compare(what: &str, all: &mut Instance, singles: &mut [(&str, Instance, &Unit)], random: &mut Random) {
    let mut touched = 0;
    for step in 0..60 {
        for (prefix, single, unit) in singles.iter_mut() {
            for input in unit.face.variables.iter().filter(|variable| variable.causality == "input") {
                let rate = match input.name.as_str() {
                    "indentation_rate" => (5e-6 * random.next() - 1e-6 - single.real("indentation")) / STEP,
                    _ => 4.0 * random.next() - 2.0,
                };
                single.set_one(&input.name, rate);
                all.set_one(&format!("{prefix}{}", input.name), rate);
            }
            for output in unit.face.variables.iter().filter(|variable| variable.causality == "output") {
                let (own, name) = (&output.name, format!("{prefix}{}", output.name));
                let bits = match output.is_real {
                    true => [single.real(own), all.real(&name)].map(f64::to_bits),
                    false => [single.integer(own), all.integer(&name)].map(|number| number as u64),
                };
                assert_eq!(bits[0], bits[1], "{what}, {name} in step {step}");
            }
            touched += u32::from(single.real("force") > 0.0);
            assert_eq!(single.step(step as f64 * STEP, STEP), OK, "{what}: {}", single.message());
        }
        assert_eq!(all.step(step as f64 * STEP, STEP), OK, "{what}: {}", all.message());
    }
    assert!(touched > 20, "{what}: {touched}");
}

#[test]
fn every_contact_is_an_fmu_of_one_contact_to_the_last_bit_whatever_it_has_for_itself() {
    let mut random = Random(27);
    for (place, law) in LAWS.into_iter().enumerate() {
        for turn in 0..2 {
            let has_friction = place < 5;
            let feature = FEATURES[(place + 3 * turn) % if has_friction { 5 } else { 3 }];
            let surface = ["dented", "fresh"][turn];
            // a body that yields needs a law that does
            let own = if place < 4 { OTHER } else { Own { soft: None, ..OTHER } };
            let mass = if ["serial", "parallel"].contains(&feature) { ", \"effective_mass\"" } else { "" };
            let row = format!("parameters_per_contact = [\"initial_gap\", \"impactor.radius\"{mass}]\n");
            let common = scene(law, feature, surface, COMMON);
            let text = format!(
                "{common}[[contact]]\nname = \"plain\"\n{}[[contact]]\nname = \"row\"\ncount = 2\n{row}",
                table("own", feature, own)
            );
            let load = |text: &str| Unit::load(&write_scene("unit", text));
            let (all, plain, alone) = (load(&text), load(&common), load(&scene(law, feature, surface, own)));
            let rows = [[3e-8, 7e-3, 2e-3], [-4e-7, 2.5e-3, 9e-3]];
            let (mut several, mut given) = (all.instantiate(), rows.map(|_| Vec::new()));
            for (index, values) in rows.iter().enumerate() {
                let names = ["initial_gap", "impactor.radius", "effective_mass"];
                for (name, value) in names.into_iter().zip(*values).take(if mass.is_empty() { 2 } else { 3 }) {
                    several.set_one(&format!("row[{}].{name}", index + 1), value);
                    given[index].push((name, value));
                }
            }
            several.initialize();
            let mut singles = [
                ("plain.", plain.ready(), &plain),
                ("own.", alone.ready(), &alone),
                ("row[1].", plain.ready_with(&given[0]), &plain),
                ("row[2].", plain.ready_with(&given[1]), &plain),
            ];
            compare(&format!("{law}, {feature}, {surface}"), &mut several, &mut singles, &mut random);
        }
    }
}

/// Step size of the simulations [s].
const STEP: f64 = 1e-6;

/// Rates [m/s] of steps of 1 us: through all branches of the law, apart, and in again.
const RATES: [f64; 12] = [1.3, 2.0, 0.7, -0.4, 0.3, -5.0, -1.0, 4.0, 5.0, -0.1, -9.0, 3.0];

/// The bodies of contacts, as lines of a scene file.
const PLAIN: &str = "impactor = { radius = 5e-3 }\ntarget = { material = \"mild steel\" }\n";
const OUTPUTS: &str = "[fmu]\noutputs = [\"indentation\", \"dissipated_energy\", \"mean_force\"]\n";

/// An FMU with these further lines.
fn load(name: &str, more: &str) -> Unit {
    Unit::load(&write_scene(name, &format!("name = \"{name}\"\n{PLAIN}{OUTPUTS}{more}")))
}

fn counted(count: usize) -> Unit {
    load(&format!("counted_{count}"), &format!("[[contact]]\nname = \"contact\"\ncount = {count}\n"))
}

/// The rate of a contact in a step [m/s]: different for each contact.
fn rate(contact: usize, step: usize) -> f64 {
    RATES[(step + contact) % RATES.len()] * (1.0 + 0.001 * contact as f64)
}

/// Every output of the contact whose variables begin with `prefix`, as bits.
fn outputs(instance: &Instance, prefix: &str) -> [u64; 4] {
    let names = ["force", "indentation", "dissipated_energy", "mean_force"];
    names.map(|name| instance.real(&format!("{prefix}{name}")).to_bits())
}

/// Runs all contacts of `instance` over `steps`, and returns their forces.
fn run(instance: &mut Instance, steps: std::ops::Range<usize>, contacts: usize) -> Vec<f64> {
    for step in steps {
        let rates: Vec<_> = (0..contacts).map(|contact| rate(contact, step)).collect();
        assert_eq!(instance.set(&references(0, contacts), &rates), OK);
        assert_eq!(instance.step(step as f64 * STEP, STEP), OK);
    }
    let mut forces = vec![f64::NAN; contacts];
    assert_eq!(instance.get(&references(contacts, contacts), &mut forces), OK);
    forces
}

/// The `count` references from `first` on.
fn references(first: usize, count: usize) -> Vec<u32> {
    (first as u32..).take(count).collect()
}

#[test]
fn one_wrong_reference_or_value_and_nothing_is_set() {
    const COUNT: usize = 40;
    let unit = counted(COUNT);
    let forbidden = [
        (COUNT as u32, 1.0), // an output
        (1_000_000, 1.0),    // nothing
        (5, f64::NAN),
        (5, f64::INFINITY),
    ];
    for (reference, value) in forbidden {
        for place in [0, COUNT / 2, COUNT - 1] {
            let instance = unit.ready();
            let mut all = references(0, COUNT);
            let mut values = vec![1.0; COUNT];
            (all[place], values[place]) = (reference, value);
            assert_eq!(instance.set(&all, &values), ERROR, "{reference} at {place}");
            let mut rates = vec![f64::NAN; COUNT];
            assert_eq!(instance.get(&references(0, COUNT), &mut rates), OK);
            assert_eq!(rates, vec![0.0; COUNT], "{reference} at {place}");
        }
    }
    // consecutive references beyond the last contact
    let instance = unit.ready();
    assert_eq!(instance.set(&references(COUNT - 2, 4), &[1.0; 4]), ERROR);
    assert_eq!(instance.real("contact[40].indentation_rate"), 0.0);
}

#[test]
fn a_refused_step_names_the_contact_and_moves_none() {
    // a fitted law, which ends before the deepest indentation if the target is nearly as strong as stiff
    let strong = "target = { youngs_modulus = 91e9, poissons_ratio = 0.3, yield_strength = 1e11 }\n";
    let groups = ["name = \"left\"\n".into(), format!("name = \"row\"\ncount = 3\n{strong}")];
    let groups = groups.map(|group| format!("[[contact]]\n{group}")).concat();
    let unit = load("refusing", &format!("[law]\nloading = \"jackson-green\"\nunloading = \"jackson\"\n{groups}"));
    let mut instance = unit.ready();
    run(&mut instance, 0..5, 4);
    let prefixes = ["left.", "row[1].", "row[2].", "row[3]."];
    let before = prefixes.map(|prefix| outputs(&instance, prefix));
    assert_eq!(instance.set(&[0, 1, 2, 3], &[1.0, -1.0, 1e3, 2.0]), OK);
    assert_eq!(instance.step(5.0 * STEP, 1.0), ERROR);
    assert_eq!(prefixes.map(|prefix| outputs(&instance, prefix)), before);
    let message = instance.message();
    assert!(message.contains("row[2]: the indentation would become"), "{message}");
}

#[test]
fn instances_of_ten_thousand_contacts_work_on_a_small_stack() {
    const COUNT: usize = 10_000;
    let unit = counted(COUNT);
    // an instance takes a megabyte
    let small = std::thread::Builder::new().stack_size(256 << 10);
    std::thread::scope(|scope| {
        let work = || {
            let (mut one, mut other) = (unit.ready(), unit.ready());
            let forces = run(&mut one, 0..4, COUNT);
            run(&mut other, 0..1, COUNT);
            let saved = one.save();
            let bytes = one.bytes(saved);
            one.reset();
            let state = one.deserialize(&bytes).expect("undamaged bytes");
            one.restore(state);
            let mut again = vec![f64::NAN; COUNT];
            assert_eq!(one.get(&references(COUNT, COUNT), &mut again), OK);
            assert_eq!(again, forces);
            one.free(state);
            one.free(saved);
        };
        small.spawn_scoped(scope, work).unwrap().join().unwrap();
    });
}

/// Parameters that contacts have for themselves, with the ranges of their values.
const RADIUS: (&str, f64, f64) = ("impactor.radius", 2e-3, 1e-1);
const STRENGTH: (&str, f64, f64) = ("target.yield_strength", 1e8, 1e9);
const GAP: (&str, f64, f64) = ("initial_gap", 1e-9, 1e-5);
const MASS: (&str, f64, f64) = ("effective_mass", 1e-6, 1e2);

/// The number with index `place` of a uniformly distributed sequence between 0 and 1 (multiples of the golden ratio).
fn part(place: usize) -> f64 {
    (place as f64 * 0.618_033_988_749_894_9).fract()
}

/// Log-uniform values of the parameters `own` for a contact, different for each contact.
fn values(own: &[(&str, f64, f64)], contact: usize) -> Vec<f64> {
    let value = |(place, (_, low, high)): (usize, &(&str, f64, f64))| {
        low * (high / low).powf(part(own.len() * contact + place + 1))
    };
    own.iter().enumerate().map(value).collect()
}

/// A table of `count` contacts with these parameters of their own.
fn row_of(name: &str, count: usize, own: &[(&str, f64, f64)]) -> String {
    let names: Vec<_> = own.iter().map(|(name, ..)| *name).collect();
    format!("[[contact]]\nname = \"{name}\"\ncount = {count}\nparameters_per_contact = {names:?}\n")
}

const COUPLING: &str = "[coupling]\neffective_mass = 4e-3\n";

/// One step contains the whole impact of each contact, as in a study.
#[test]
fn a_thousand_impacts_in_one_step_are_those_of_a_thousand_fmus() {
    const COUNT: usize = 1000;
    let own = [RADIUS, STRENGTH, MASS];
    let row = load("thousand_row", &format!("{COUPLING}{}", row_of("row", COUNT, &own)));
    let single = load("thousand_one", COUPLING);
    let mut all = row.instantiate();
    // the values of a parameter are consecutive, one parameter after the other
    let settable = all.real_of("row[1].impactor.radius");
    let columns = (0..own.len()).flat_map(|kind| (0..COUNT).map(move |contact| values(&own, contact)[kind]));
    let references: Vec<u32> = (settable..).take(own.len() * COUNT).collect();
    assert_eq!(all.set(&references, &columns.collect::<Vec<_>>()), OK, "{}", all.message());
    all.initialize();
    let speeds: Vec<f64> = (0..COUNT).map(|contact| 10f64.powf(2.0 * part(contact) - 1.0)).collect();
    assert_eq!(all.set(&(0..COUNT as u32).collect::<Vec<_>>(), &speeds), OK);
    assert_eq!(all.step(0.0, 1.0), OK, "{}", all.message());
    let mut one = single.instantiate();
    for (contact, speed) in speeds.iter().enumerate() {
        one.reset();
        for ((name, ..), value) in own.iter().zip(values(&own, contact)) {
            one.set_one(name, value);
        }
        one.initialize();
        one.set_one("indentation_rate", *speed);
        assert_eq!(one.step(0.0, 1.0), OK);
        assert_eq!(outputs(&all, &format!("row[{}].", contact + 1)), outputs(&one, ""), "contact {}", contact + 1);
        assert!(one.real("mean_force") > 0.0);
    }
}

/// Contacts with and without their own parameters in several tables.
fn mixed() -> Unit {
    load(
        "mixed",
        &format!(
            "{COUPLING}{}{}[[contact]]\nname = \"left\"\neffective_mass = 2e-3\n{}\
             [[contact]]\nname = \"right\"\nparameters_per_contact = [\"target.yield_strength\"]\n",
            "[[contact]]\nname = \"plain\"\ncount = 2\n",
            row_of("row", 3, &[STRENGTH, MASS, GAP]),
            row_of("last", 1, &[STRENGTH]),
        ),
    )
}

#[test]
fn every_table_of_a_scene_has_its_parameters_for_itself() {
    let (unit, single) = (mixed(), load("mixed_one", COUPLING));
    let prefixes = ["plain[1].", "plain[2].", "row[1].", "row[2].", "row[3].", "left.", "last[1].", "right."];
    let given = [
        ("target.yield_strength", 250e6),
        ("effective_mass", 1e-3),
        ("row[2].target.yield_strength", 400e6),
        ("row[3].effective_mass", 8e-3),
        ("row[1].initial_gap", 1e-4),
        ("left.effective_mass", 6e-3),
        ("last[1].target.yield_strength", 500e6),
        ("right.target.yield_strength", 600e6),
    ];
    let all = unit.ready_with(&given);
    let rates = [1.0; 8];
    assert_eq!(all.set(&[0, 1, 2, 3, 4, 5, 6, 7], &rates), OK);
    assert_eq!(all.step(0.0, 1e-3), OK);
    // strength, mass and gap of each contact: its own, or the common ones
    let expected = [
        (250e6, 1e-3, 0.0),
        (250e6, 1e-3, 0.0),
        (300e6, 4e-3, 1e-4),
        (400e6, 4e-3, 0.0),
        (300e6, 8e-3, 0.0),
        (250e6, 6e-3, 0.0),
        (500e6, 1e-3, 0.0),
        (600e6, 1e-3, 0.0),
    ];
    for (prefix, (strength, mass, gap)) in prefixes.iter().zip(expected) {
        let parameters = [("target.yield_strength", strength), ("effective_mass", mass), ("initial_gap", gap)];
        let mut one = single.ready_with(&parameters);
        one.set_one("indentation_rate", 1.0);
        assert_eq!(one.step(0.0, 1e-3), OK);
        assert_eq!(outputs(&all, prefix), outputs(&one, ""), "{prefix}");
    }
}

#[test]
fn a_value_that_is_refused_names_its_contact() {
    let unit = mixed();
    let mut instance = unit.instantiate();
    for (name, value, words) in [
        ("row[2].target.yield_strength", -1.0, "row[2]: target.yield_strength = -1"),
        ("row[3].effective_mass", 0.0, "row[3]: effective_mass = 0"),
        ("row[1].initial_gap", f64::NAN, "row[1]: initial_gap = NaN"),
        ("last[1].target.yield_strength", 1e99, "last[1].target.yield_strength = "),
        ("left.effective_mass", -2.0, "left.effective_mass = -2"),
        ("right.target.yield_strength", 0.0, "right.target.yield_strength = 0"),
    ] {
        let before = instance.real_of(name);
        assert_eq!(instance.set(&[before], &[value]), ERROR, "{name}");
        let message = instance.message();
        assert!(message.contains(words) && message.contains("allowed is"), "{message}");
        instance.reset();
    }
    // between steps only the masses can be set, one for each contact
    let mut instance = unit.ready();
    for name in ["effective_mass", "row[1].effective_mass", "row[3].effective_mass", "left.effective_mass"] {
        instance.set_one(name, 7e-3);
        assert_eq!(instance.real(name), 7e-3);
    }
    assert_eq!(instance.real("row[2].effective_mass"), 4e-3);
    assert_eq!(instance.set(&[instance.real_of("row[3].initial_gap")], &[0.0]), ERROR);
    let message = instance.message();
    assert!(
        message.contains("row[3]: initial_gap can't be set") || message.contains("row[3]: the parameter"),
        "{message}"
    );
}

#[test]
fn bodies_that_do_not_fit_name_their_contact() {
    let own = "parameters_per_contact = [\"impactor.radius\"]";
    let socket = "[[contact]]\nname = \"row\"\ncount = 4\ntarget = { radius = -6e-3 }\n";
    let unit = load("socket", &format!("{socket}{own}\n"));
    let mut instance = unit.instantiate();
    instance.set_one("row[3].impactor.radius", 7e-3);
    instance.enter_initialization();
    assert_eq!(instance.exit(), ERROR);
    let message = instance.message();
    assert!(message.contains("row[3]: impactor.radius = 0.007 m does not fit target.radius = -0.006 m"), "{message}");
}
