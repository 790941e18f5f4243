//! FMUs with several contacts, called like by an importer: each contact equals that of a separate FMU to the last bit, however
//! it is addressed; either all of them move or none.

use crate::loaded::{ERROR, Instance, OK, Unit};
use crate::unit::write_scene;
use std::fmt::Write;

/// Step size of the simulations [s].
const STEP: f64 = 1e-6;

/// Rates [m/s] of steps of 1 us: through all branches of the law, apart, and in again.
const RATES: [f64; 12] = [1.3, 2.0, 0.7, -0.4, 0.3, -5.0, -1.0, 4.0, 5.0, -0.1, -9.0, 3.0];

/// The bodies of contacts in these tests, as lines of a scene file.
const PLAIN: &str = "impactor = { radius = 5e-3 }\ntarget = { material = \"mild steel\" }\n";
const OTHER: &str = "impactor = { radius = 4e-3, youngs_modulus = 210e9, poissons_ratio = 0.3 }\n\
                     target = { material = \"mild steel\", yield_strength = 420e6, surface = \"fresh\" }\n";

const OUTPUTS: &str = "[fmu]\noutputs = [\"indentation\", \"dissipated_energy\", \"regime\"]\n";

/// An FMU of one contact with the `bodies` and an additional `gap` [m].
fn single(name: &str, bodies: &str, gap: f64) -> Unit {
    let outputs = OUTPUTS.replace("[fmu]", &format!("[fmu]\ninitial_gap = {gap:e}"));
    Unit::load(&write_scene(name, &format!("name = \"{name}\"\n{bodies}{outputs}")))
}

/// An FMU with `groups` of contacts: lines of `[[contact]]`.
fn several(name: &str, groups: &[String]) -> Unit {
    let mut text = format!("name = \"{name}\"\n{PLAIN}{OUTPUTS}");
    for group in groups {
        write!(text, "[[contact]]\n{group}").unwrap();
    }
    Unit::load(&write_scene(name, &text))
}

fn two() -> Unit {
    several("two", &["name = \"left\"\n".into(), format!("name = \"right\"\n{OTHER}initial_gap = 2e-6\n")])
}

fn counted(count: usize) -> Unit {
    several(&format!("counted_{count}"), &[format!("name = \"contact\"\ncount = {count}\n")])
}

/// The rate of a contact in a step [m/s]: different for each contact.
fn rate(contact: usize, step: usize) -> f64 {
    RATES[(step + contact) % RATES.len()] * (1.0 + 0.001 * contact as f64)
}

/// Every output of the contact whose variables begin with `prefix`, as bits.
fn outputs(instance: &Instance, prefix: &str) -> [u64; 4] {
    let real = |name| instance.real(&format!("{prefix}{name}")).to_bits();
    let regime = instance.integer(&format!("{prefix}regime"));
    [real("force"), real("indentation"), real("dissipated_energy"), regime as u64]
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
fn two_different_contacts_are_two_fmus_to_the_last_bit() {
    let (both, left, right) = (two(), single("left", PLAIN, 0.0), single("right", OTHER, 2e-6));
    let (mut both, mut left, mut right) = (both.ready(), left.ready(), right.ready());
    for step in 0..200 {
        let (one, other) = (rate(0, step), rate(5, step));
        both.set_one("left.indentation_rate", one);
        both.set_one("right.indentation_rate", other);
        left.set_one("indentation_rate", one);
        right.set_one("indentation_rate", other);
        for instance in [&mut both, &mut left, &mut right] {
            assert_eq!(instance.step(step as f64 * STEP, STEP), OK);
        }
        assert_eq!(outputs(&both, "left."), outputs(&left, ""), "step {step}");
        assert_eq!(outputs(&both, "right."), outputs(&right, ""), "step {step}");
    }
}

#[test]
fn a_thousand_contacts_are_a_thousand_fmus_to_the_last_bit() {
    const COUNT: usize = 1000;
    let (all, one) = (counted(COUNT), single("one_of_many", PLAIN, 0.0));
    let mut all = all.ready();
    let forces = run(&mut all, 0..30, COUNT);
    for (contact, force) in forces.iter().enumerate() {
        let mut one = one.ready();
        for step in 0..30 {
            one.set_one("indentation_rate", rate(contact, step));
            assert_eq!(one.step(step as f64 * STEP, STEP), OK);
        }
        assert_eq!(force.to_bits(), one.real("force").to_bits(), "contact {contact}");
        if contact % 100 == 0 {
            assert_eq!(outputs(&all, &format!("contact[{}].", contact + 1)), outputs(&one, ""), "contact {contact}");
        }
    }
}

#[test]
fn however_inputs_and_forces_are_addressed_they_are_the_same() {
    const COUNT: usize = 40;
    let unit = counted(COUNT);
    let mut expected = vec![f64::NAN; COUNT];
    let plain = unit.ready();
    let rates: Vec<_> = (0..COUNT).map(|contact| rate(contact, 3).abs()).collect();
    assert_eq!(plain.set(&references(0, COUNT), &rates), OK);
    assert_eq!(plain.step(0.0, STEP), OK);
    assert_eq!(plain.get(&references(COUNT, COUNT), &mut expected), OK);
    let reversed: Vec<usize> = (0..COUNT).rev().collect();
    // consecutive references from the middle on, repeated references, one at a time
    let middle: Vec<usize> = (COUNT / 2..COUNT).chain(0..COUNT / 2).collect();
    let repeated: Vec<usize> = (0..COUNT).chain([7, 7, 8]).collect();
    for order in [reversed, middle, repeated] {
        let other = unit.ready();
        let inputs: Vec<_> = order.iter().map(|&contact| contact as u32).collect();
        let values: Vec<_> = order.iter().map(|&contact| rates[contact]).collect();
        assert_eq!(other.set(&inputs, &values), OK);
        assert_eq!(other.step(0.0, STEP), OK);
        let outputs: Vec<_> = order.iter().map(|&contact| (COUNT + contact) as u32).collect();
        let mut forces = vec![f64::NAN; order.len()];
        assert_eq!(other.get(&outputs, &mut forces), OK);
        assert!(order.iter().zip(&forces).all(|(&contact, force)| force.to_bits() == expected[contact].to_bits()));
        // inputs and outputs of all kinds in one call
        let mixed: Vec<u32> = inputs.iter().chain(&outputs).copied().collect();
        let mut both = vec![f64::NAN; mixed.len()];
        assert_eq!(other.get(&mixed, &mut both), OK);
        assert_eq!((&both[..order.len()], &both[order.len()..]), (&values[..], &forces[..]));
    }
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
    let mut text =
        format!("name = \"mixed\"\n{PLAIN}{OUTPUTS}[law]\nloading = \"jackson-green\"\nunloading = \"jackson\"\n");
    for group in groups {
        write!(text, "[[contact]]\n{group}").unwrap();
    }
    let unit = Unit::load(&write_scene("mixed", &text));
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
fn contacts_that_start_pressed_in_have_their_force_before_the_first_step() {
    let unit = several("pressed", &["name = \"a\"\n".into(), "name = \"b\"\ninitial_gap = -1e-6\n".into()]);
    let instance = unit.ready();
    assert_eq!(instance.real("a.force"), 0.0);
    let pressed = single("pressed_alone", PLAIN, -1e-6);
    assert_eq!(outputs(&instance, "b."), outputs(&pressed.ready(), ""));
}

#[test]
fn a_parameter_of_a_contact_is_its_own_and_one_of_all_is_everyones() {
    let unit =
        several("owners", &["name = \"a\"\n".into(), "name = \"b\"\ntarget = { yield_strength = 400e6 }\n".into()]);
    let force = |parameters: &[(&str, f64)]| {
        let instance = unit.ready_with(parameters);
        assert_eq!(instance.set(&[0, 1], &[3.0, 3.0]), OK);
        assert_eq!(instance.step(0.0, STEP), OK);
        [instance.real("a.force"), instance.real("b.force")]
    };
    let plain = force(&[]);
    assert!(plain[0] < plain[1]);
    let own = force(&[("b.target.yield_strength", 300e6)]);
    assert_eq!(own, [plain[0], plain[0]]);
    let shared = force(&[("target.yield_strength", 400e6)]);
    assert_eq!(shared, [plain[1], plain[1]]);
    let radius = force(&[("impactor.radius", 6e-3)]);
    assert!(radius[0] != plain[0] && radius[1] != plain[1]);
}

#[test]
fn a_state_of_many_contacts_is_restored_from_memory_and_from_bytes() {
    const COUNT: usize = 300;
    let unit = counted(COUNT);
    let mut instance = unit.ready();
    run(&mut instance, 0..7, COUNT);
    let saved = instance.save();
    let bytes = instance.bytes(saved);
    let first = run(&mut instance, 7..20, COUNT);
    instance.restore(saved);
    assert_eq!(run(&mut instance, 7..20, COUNT), first);
    // to an instance that was never initialized
    let mut other = unit.instantiate();
    let mut state = other.deserialize(&bytes).expect("undamaged bytes");
    other.restore(state);
    assert_eq!(other.bytes(state), bytes);
    assert_eq!(run(&mut other, 7..20, COUNT), first);
    // a damaged word is rejected, and the state that was to be overwritten does not change
    let mut damaged = bytes.clone();
    let middle = damaged.len() / 2;
    damaged[middle] ^= 1;
    assert_eq!(other.overwrite(&mut state, &damaged), ERROR);
    assert_eq!(other.bytes(state), bytes);
    other.free(state);
    instance.free(saved);
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
