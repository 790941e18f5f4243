//! FMUs whose contacts share bodies, called like by an importer: the bodies move as their forces say, all of them or none.

use crate::loaded::{ERROR, Instance, OK, Unit};
use crate::unit::write_scene;

/// Mass of a ball [kg].
const MASS: f64 = 0.033;

/// A cradle of `balls` with this gap \[m\] and law, and more lines.
fn cradle(name: &str, balls: usize, gap: f64, law: &str, more: &str) -> String {
    let mut text = format!(
        "name = {name:?}\n[impactor]\nradius = 10e-3\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\n\
         [target]\nradius = 10e-3\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 300e6\n\
         [law]\nloading = {law:?}\n[fmu]\ninitial_gap = {gap:e}\n\
         outputs = [\"indentation\", \"impulse\", \"elastic_energy\", \"dissipated_energy\", \"closing_speed\"]\n{more}"
    );
    for ball in 0..balls {
        text += &format!("[[body]]\nname = \"ball{ball}\"\nmass = {MASS}\n");
    }
    for contact in 1..balls {
        text +=
            &format!("[[contact]]\nname = \"c{contact}\"\nbetween = [\"ball{}\", \"ball{contact}\"]\n", contact - 1);
    }
    text
}

/// A step of the FMU with these rates \[m/s\].
fn step(instance: &mut Instance, rates: &[f64], time: f64, length: f64) {
    for (contact, rate) in rates.iter().enumerate() {
        instance.set_one(&format!("c{}.indentation_rate", contact + 1), *rate);
    }
    assert_eq!(instance.step(time, length), OK, "{}", instance.message());
}

fn values(instance: &Instance, name: &str, contacts: usize) -> Vec<f64> {
    (1..=contacts).map(|contact| instance.real(&format!("c{contact}.{name}"))).collect()
}

#[test]
fn bodies_are_displaced_by_the_moments_of_the_impulses() {
    let unit = Unit::load(&write_scene("cradle_three", &cradle("cradle_three", 3, 1e-6, "thornton", "")));
    let mut instance = unit.ready();
    let (mut places, mut speeds, mut time) = ([0.0, 1e-6, 2e-6], [1.0, 0.0, 0.0], 0.0);
    for length in [1e-5, 3e-5, 1e-4, 1e-6, 1e-3, 2e-3] {
        let rates: Vec<_> = speeds.windows(2).map(|pair| pair[0] - pair[1]).collect();
        step(&mut instance, &rates, time, length);
        time += length;
        let (forces, moments) = (values(&instance, "mean_force", 2), values(&instance, "impulse_moment", 2));
        places.iter_mut().zip(speeds).for_each(|(place, speed)| *place += length * speed);
        for contact in 0..2 {
            places[contact] -= moments[contact] / MASS;
            places[contact + 1] += moments[contact] / MASS;
            speeds[contact] -= forces[contact] * length / MASS;
            speeds[contact + 1] += forces[contact] * length / MASS;
        }
        for (contact, depth) in values(&instance, "indentation", 2).into_iter().enumerate() {
            let distance = places[contact] - places[contact + 1];
            assert!(
                (distance - depth).abs() < 1e-15 * (1.0 + 1e4 * time),
                "c{contact} after {time}: {distance:e} {depth:e}"
            );
        }
    }
}

#[test]
fn contacts_that_share_no_body_move_as_separate_units_bit_for_bit() {
    let law =
        "[law]\nloading = \"thornton\"\n[fmu]\noutputs = [\"indentation\", \"closing_speed\", \"dissipated_energy\"]\n";
    let ball = "[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n";
    let mut both = format!("name = \"apart\"\n{ball}{law}");
    for (body, mass) in [("one", 0.1), ("two", 0.004)] {
        both += &format!("[[body]]\nname = \"{body}\"\nmass = {mass}\n");
    }
    for (contact, body) in [("c1", "one"), ("c2", "two")] {
        both += &format!("[[contact]]\nname = \"{contact}\"\nbetween = [\"{body}\", \"ground\"]\n");
    }
    let single = format!("name = \"single\"\n{ball}{law}[coupling]\neffective_mass = 0.1\n");
    let (both, single) = (Unit::load(&write_scene("apart", &both)), Unit::load(&write_scene("single", &single)));
    let mut together = both.ready();
    // the masses are 1/W of the matrix, which may round
    let mut alone = [0.1, 0.004].map(|mass: f64| single.ready_with(&[("effective_mass", 1.0 / (1.0 / mass))]));
    let (mut time, mut rates) = (0.0, [2.0, 0.7]);
    for length in [3e-6, 4e-5, 1e-3, 2e-4, 1e-3] {
        step(&mut together, &rates, time, length);
        for (contact, alone) in alone.iter_mut().enumerate() {
            alone.set_one("indentation_rate", rates[contact]);
            assert_eq!(alone.step(time, length), OK);
            for name in ["force", "mean_force", "indentation", "closing_speed", "dissipated_energy"] {
                let (one, other) = (alone.real(name), together.real(&format!("c{}.{name}", contact + 1)));
                assert_eq!(
                    one.to_bits(),
                    other.to_bits(),
                    "{name} of c{} after {time}: {one:e} {other:e}",
                    contact + 1
                );
            }
            rates[contact] = alone.real("closing_speed").abs();
        }
        time += length;
    }
}

/// Importers that connect FMUs, such as containers, pass on a zero during initialization before another FMU knows the bodies.
#[test]
fn masses_of_zero_during_initialization_are_refused_by_the_first_step_only() {
    let masses = [("c1.effective_mass", 0.1), ("c2.effective_mass", 0.1)];
    let inverse = [("inverse_mass[1,1]", 10.0), ("inverse_mass[1,2]", 0.0), ("inverse_mass[2,2]", 10.0)];
    for (coupling, inputs, words) in [
        (
            "effective_mass = 0.1\ninputs = [\"effective_mass\"]",
            &masses[..],
            "c1: effective_mass = 0 kg: it isn't known yet",
        ),
        ("inverse_masses = \"input\"", &inverse[..], "inverse_mass[1,1] = 0 1/kg: it isn't known yet"),
    ] {
        let text = format!(
            "name = \"late\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n[impact]\nmass = 0.1\nspeed = 1.0\n\
             [fmu]\noutputs = [\"indentation\"]\n[coupling]\n{coupling}\n[[contact]]\nname = \"c1\"\n[[contact]]\nname = \"c2\"\n"
        );
        let unit = Unit::load(&write_scene("late", &text));
        for are_known in [false, true] {
            let mut instance = unit.instantiate();
            inputs.iter().for_each(|(name, _)| instance.set_one(name, 0.0));
            instance.enter_initialization();
            inputs.iter().for_each(|(name, _)| instance.set_one(name, 0.0));
            assert_eq!(instance.exit(), OK, "{}", instance.message());
            if are_known {
                inputs.iter().for_each(|(name, value)| instance.set_one(name, *value));
            }
            instance.set_one("c1.indentation_rate", 1.0);
            let (status, expected) = (instance.step(0.0, 1e-6), if are_known { OK } else { ERROR });
            let message = instance.message();
            assert!(status == expected && message.contains(words) != are_known, "{coupling}: {status} {message}");
        }
    }
}

#[test]
fn a_matrix_of_no_bodies_is_refused_before_anything_moves() {
    let text = "name = \"inputs\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n[impact]\nmass = 0.1\n\
                speed = 1.0\n[fmu]\noutputs = [\"indentation\"]\n[coupling]\ninverse_masses = \"input\"\n\
                [[contact]]\nname = \"c1\"\n[[contact]]\nname = \"c2\"\n";
    let unit = Unit::load(&write_scene("inputs", text));
    let names = ["inverse_mass[1,1]", "inverse_mass[1,2]", "inverse_mass[2,2]"];
    let set = |instance: &mut Instance, entries: [f64; 3]| {
        names.iter().zip(entries).for_each(|(name, entry)| instance.set_one(name, entry));
    };
    for (entries, words) in [
        // an importer may pass on a zero before the bodies are known
        ([0.0, 0.0, 10.0], "inverse_mass[1,1] = 0 1/kg: it isn't known yet"),
        ([10.0, 20.0, 10.0], "those of no bodies"),
        ([10.0, -11.0, 10.0], "positive semidefinite"),
    ] {
        let mut instance = unit.ready();
        set(&mut instance, entries);
        instance.set_one("c1.indentation_rate", 1.0);
        assert_eq!(instance.step(0.0, 1e-3), ERROR, "{entries:?}");
        let message = instance.take_message();
        assert!(message.contains(words), "{entries:?}: {message}");
        assert_eq!(instance.real("c1.indentation"), 0.0);
    }
    // no bodies have such a mass, whatever the other entries are
    for (name, entry) in
        [(names[2], -1.0), (names[0], 5e-324), (names[0], 1e31), (names[1], -1e31), (names[1], f64::NAN)]
    {
        let instance = unit.ready();
        assert_eq!(instance.set(&[instance.real_of(name)], &[entry]), ERROR, "{name} = {entry}");
        let (message, allowed) =
            (instance.message(), "is out of range: allowed is 1e-30 to 1e30 1/kg if both indices are");
        assert!(message.contains(name) && message.contains(allowed), "{message}");
    }
    // as strongly coupled as two contacts of one body between two walls: singular
    let mut instance = unit.ready();
    instance.set_one("c1.indentation_rate", 1.0);
    set(&mut instance, [10.0, -10.0, 10.0]);
    assert_eq!(instance.step(0.0, 1e-6), OK, "{}", instance.message());
    let depths = values(&instance, "indentation", 2);
    assert!(depths[0] > 0.0 && (depths[0] - 1e-6).abs() < 1e-8, "{depths:?}");
    set(&mut instance, [10.0, -10.001, 10.0]);
    assert_eq!(instance.step(1e-6, 1e-6), ERROR);
}

#[test]
fn a_step_with_too_many_events_is_refused_with_the_step_that_would_do() {
    let unit = Unit::load(&write_scene("cradle_bounces", &cradle("cradle_bounces", 3, 0.0, "hertz", "")));
    let mut instance = unit.ready();
    // a light ball between two others would be needed for many events; here the two outer ones press for long
    let derivatives = ["c1.indentation_rate", "c2.indentation_rate"].map(|name| instance.real_of(name));
    assert_eq!(instance.set_derivatives(&derivatives, 1, &[1e6, 1e6]), OK);
    assert_eq!(instance.step(0.0, 10.0), ERROR);
    let message = instance.take_message();
    assert!(message.contains("too often to be followed within communicationStepSize = 10 s: a step of"), "{message}");
    assert_eq!(values(&instance, "indentation", 2), [0.0, 0.0]);
    let possible: f64 = message.split("a step of ").nth(1).unwrap().split(" s").next().unwrap().parse().unwrap();
    let mut instance = unit.ready();
    assert_eq!(instance.set_derivatives(&derivatives, 1, &[1e6, 1e6]), OK);
    assert_eq!(instance.step(0.0, possible), OK, "{}", instance.message());
}

/// A ball between two walls, in a unit that knows one mass for each of the two contacts.
#[test]
fn a_body_that_two_contacts_share_is_told_where_each_moves_it_alone() {
    for master in ["", "master = \"parallel\"\n"] {
        let text = format!(
            "name = \"walls\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n[coupling]\n\
             effective_mass = 4e-3\n{master}[fmu]\noutputs = [\"indentation\"]\n\
             [[contact]]\nname = \"c1\"\n[[contact]]\nname = \"c2\"\ninitial_gap = 1e-4\n"
        );
        let unit = Unit::load(&write_scene("walls", &text));
        for is_shared in [true, false] {
            let mut instance = unit.ready();
            let (mut first, mut second, mut before, mut time) = (1.0, -1.0, 0.0, 0.0);
            for _ in 0..12 {
                step(&mut instance, &[first, second], time, 1e-6);
                time += 1e-6;
                let force = instance.real("c1.mean_force");
                let applied = if master.is_empty() { force } else { before };
                before = force;
                first -= applied * 1e-6 / 4e-3;
                second += if is_shared { applied * 1e-6 / 4e-3 } else { 0.0 };
            }
            let said = instance.message();
            assert_eq!(said.contains("c2"), is_shared, "{master}: {said}");
            assert_eq!(
                said.contains("the force of contact number 1 moves a body of this one, too"),
                is_shared,
                "{said}"
            );
        }
    }
}

/// A ball between two walls whose inverse masses nobody has set.
#[test]
fn inverse_masses_that_are_not_those_of_the_bodies_are_told() {
    let text = "name = \"walls\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n[impact]\nmass = 4e-3\n\
                speed = 1.0\n[fmu]\noutputs = [\"indentation\"]\n[coupling]\ninverse_masses = \"input\"\n\
                [[contact]]\nname = \"c1\"\n[[contact]]\nname = \"c2\"\ninitial_gap = 1e-4\n";
    let unit = Unit::load(&write_scene("walls_by_inputs", text));
    for are_set in [false, true] {
        let mut instance = unit.ready();
        if are_set {
            instance.set_one("inverse_mass[1,2]", -250.0);
        }
        let (mut speed, mut time) = (1.0, 0.0);
        for _ in 0..12 {
            step(&mut instance, &[speed, -speed], time, 1e-6);
            time += 1e-6;
            speed -= instance.real("c1.mean_force") * 1e-6 / 4e-3;
        }
        let said = instance.message();
        let words = "the force of contact number 1 moves a body of this one otherwise than the inputs inverse_mass say";
        assert_eq!(said.contains(words), !are_set, "{are_set}: {said}");
    }
}
