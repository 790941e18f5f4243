//! FMUs whose contacts have their own parameters: each contact equals that of an FMU of one contact with these parameters, to
//! the last bit.

use crate::loaded::{ERROR, Instance, OK, Unit};
use crate::unit::write_scene;

const BODIES: &str = "impactor = { radius = 5e-3 }\ntarget = { material = \"mild steel\" }\n";
const OUTPUTS: [&str; 4] = ["force", "indentation", "dissipated_energy", "mean_force"];

/// Step size of the simulations [s].
const STEP: f64 = 1e-5;

/// The parameters that contacts of these tests have for themselves, with the ranges of their values. None of them makes the
/// indentations of [`rate`] negligible, or a contact as wide as its ball.
const OWN: [(&str, f64, f64); 5] = [
    ("impactor.radius", 2e-3, 1e-1),
    ("target.youngs_modulus", 1e10, 1e12),
    ("target.poissons_ratio", 0.01, 0.49),
    ("target.yield_strength", 1e8, 1e9),
    ("initial_gap", 1e-9, 1e-5),
];
const MASS: (&str, f64, f64) = ("effective_mass", 1e-6, 1e2);
const RESTITUTION: (&str, f64, f64) = ("restitution", 0.1, 1.0);

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

/// The rate of a contact in a step [m/s]: of either sign.
fn rate(contact: usize, step: usize) -> f64 {
    let size = 10f64.powf(3.0 * part(37 * contact + step) - 2.0);
    if part(11 * contact + 3 * step) < 0.55 { size } else { -size }
}

/// A scene with `more` appended.
fn load(name: &str, more: &str) -> Unit {
    let (top, tables) = more.split_once("[[").map_or((more, String::new()), |(top, rest)| (top, format!("[[{rest}")));
    let outputs = "[fmu]\noutputs = [\"indentation\", \"dissipated_energy\", \"mean_force\"]\n";
    Unit::load(&write_scene(name, &format!("name = \"{name}\"\n{BODIES}{outputs}{top}{tables}")))
}

/// A table of `count` contacts with these parameters of their own.
fn table(name: &str, count: usize, own: &[(&str, f64, f64)]) -> String {
    let names: Vec<_> = own.iter().map(|(name, ..)| *name).collect();
    format!("[[contact]]\nname = \"{name}\"\ncount = {count}\nparameters_per_contact = {names:?}\n")
}

/// Every output of the contact whose variables begin with `prefix`, as bits.
fn outputs(instance: &Instance, prefix: &str) -> [u64; 4] {
    OUTPUTS.map(|name| instance.real(&format!("{prefix}{name}")).to_bits())
}

/// Compares the contacts `row[1]` to `row[count]`, each with its values of `own` and its rates, step by step with the FMU
/// `single` of one contact.
fn beside(row: &Unit, single: &Unit, count: usize, own: &[(&str, f64, f64)], steps: usize) {
    let mut all = row.instantiate();
    for contact in 0..count {
        for ((name, ..), value) in own.iter().zip(values(own, contact)) {
            all.set_one(&format!("row[{}].{name}", contact + 1), value);
        }
    }
    all.initialize();
    let given = |contact| own.iter().map(|(name, ..)| *name).zip(values(own, contact)).collect::<Vec<_>>();
    let mut singles: Vec<_> = (0..count).map(|contact| single.ready_with(&given(contact))).collect();
    for step in 0..steps {
        for (contact, single) in singles.iter_mut().enumerate() {
            all.set_one(&format!("row[{}].indentation_rate", contact + 1), rate(contact, step));
            single.set_one("indentation_rate", rate(contact, step));
            assert_eq!(single.step(step as f64 * STEP, STEP), OK);
        }
        assert_eq!(all.step(step as f64 * STEP, STEP), OK);
        for (contact, single) in singles.iter().enumerate() {
            let found = outputs(&all, &format!("row[{}].", contact + 1));
            assert_eq!(found, outputs(single, ""), "contact {} in step {step}", contact + 1);
        }
    }
    assert!(singles.iter().any(|single| single.real("dissipated_energy") > 0.0), "nothing has happened");
}

#[test]
fn contacts_with_parameters_of_their_own_are_fmus_of_one_contact_to_the_last_bit() {
    let damped = "[law]\nloading = \"hunt-crossley\"\nrestitution = 0.6\n";
    let with_mass = "[law]\nloading = \"tsuji\"\nrestitution = 0.6\n[impact]\nmass = 4e-3\nspeed = 1.0\n";
    let fit = "[law]\nloading = \"brinell\"\nunloading = \"brinell\"\n";
    let [elastic, plastic] = [&OWN[..3], &OWN[..]];
    let rate_dependent = [elastic, &[RESTITUTION], &OWN[4..]].concat();
    for (name, law, own) in [
        ("segments", "", plastic.to_vec()),
        ("fit", fit, plastic.to_vec()),
        ("damped", damped, rate_dependent.clone()),
        ("damped_mass", with_mass, [&rate_dependent[..4], &[MASS], &OWN[4..]].concat()),
        ("mass_known", "[coupling]\neffective_mass = 4e-3\n", [&OWN[..4], &[MASS], &OWN[4..]].concat()),
        ("parallel", "[coupling]\neffective_mass = 4e-3\nmaster = \"parallel\"\n", [&OWN[..4], &[MASS]].concat()),
    ] {
        println!("{name}");
        let row = load(&format!("{name}_row"), &format!("{law}{}", table("row", 5, &own)));
        beside(&row, &load(&format!("{name}_one"), law), 5, &own, 60);
    }
}

const COUPLING: &str = "[coupling]\neffective_mass = 4e-3\n";

/// One step contains the whole impact of each contact, as in a study.
#[test]
fn a_thousand_impacts_in_one_step_are_those_of_a_thousand_fmus() {
    const COUNT: usize = 1000;
    let own = [OWN[0], OWN[3], MASS];
    let row = load("thousand_row", &format!("{COUPLING}{}", table("row", COUNT, &own)));
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
    let strength = &OWN[3..4];
    load(
        "mixed",
        &format!(
            "{COUPLING}{}{}[[contact]]\nname = \"left\"\neffective_mass = 2e-3\n{}\
             [[contact]]\nname = \"right\"\nparameters_per_contact = [\"target.yield_strength\"]\n",
            "[[contact]]\nname = \"plain\"\ncount = 2\n",
            table("row", 3, &[OWN[3], MASS, OWN[4]]),
            table("last", 1, strength),
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

#[test]
fn states_hold_the_parameters_of_each_contact_and_a_reset_forgets_them() {
    const COUNT: usize = 40;
    let own = [OWN[0], OWN[3], MASS];
    let unit = load("states", &format!("{COUPLING}{}", table("row", COUNT, &own)));

    let mut instance = unit.instantiate();
    let start = instance.real_of("row[1].impactor.radius");
    let references: Vec<u32> = (start..).take(own.len() * COUNT).collect();
    let columns = |shift| {
        let of = move |kind: usize| (0..COUNT).map(move |contact| values(&own, contact + shift)[kind]);
        (0..own.len()).flat_map(of).collect::<Vec<f64>>()
    };
    let run = |instance: &mut Instance, steps: std::ops::Range<usize>| {
        for step in steps {
            let rates: Vec<f64> = (0..COUNT).map(|contact| rate(contact, step)).collect();
            assert_eq!(instance.set(&(0..COUNT as u32).collect::<Vec<_>>(), &rates), OK);
            assert_eq!(instance.step(step as f64 * STEP, STEP), OK);
        }
        (1..=COUNT).map(|contact| outputs(instance, &format!("row[{contact}]."))).collect::<Vec<_>>()
    };
    let mut starts = vec![f64::NAN; references.len()];
    assert_eq!(instance.set(&references, &columns(0)), OK);
    instance.initialize();
    run(&mut instance, 0..20);
    let saved = instance.save();
    let bytes = instance.bytes(saved);
    let first = run(&mut instance, 20..50);
    // in an instance with other parameters, from memory and from bytes
    let mut other = unit.instantiate();
    assert_eq!(other.set(&references, &columns(500)), OK);
    other.initialize();
    run(&mut other, 0..3);
    other.restore(saved);
    assert_eq!(run(&mut other, 20..50), first);
    let state = other.deserialize(&bytes).expect("undamaged bytes");
    instance.reset();
    instance.restore(state);
    assert_eq!(instance.bytes(state), bytes);
    let mut found = vec![f64::NAN; references.len()];
    assert_eq!(instance.get(&references, &mut found), OK);
    assert_eq!(found, columns(0));
    assert_eq!(run(&mut instance, 20..50), first);
    // a reset restores the values of the scene
    instance.reset();
    instance.enter_initialization();
    assert_eq!(instance.get(&references, &mut starts), OK);
    let expected = [5e-3, 300e6, 4e-3].into_iter().flat_map(|value| [value; COUNT]).collect::<Vec<_>>();
    assert_eq!(starts, expected);
    other.free(state);
    instance.free(saved);
}
