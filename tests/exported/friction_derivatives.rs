//! Derivatives of the inputs and outputs of FMUs with friction, and states with them.

use crate::loaded::{ERROR, Instance, OK, Unit};
use crate::unit;

const STEP: f64 = 1e-6;

fn oblique() -> Unit {
    Unit::load(&unit::scene("oblique"))
}

/// A contact pressed in by 2 um that has slipped to and fro, at the end of a step with these rates [m/s], with its time.
fn worked<'a>(unit: &'a Unit, last: (f64, f64)) -> (Instance<'a>, f64) {
    let mut instance = unit.ready_with(&[("initial_gap", -2e-6)]);
    let mut time = 0.0;
    for (normal, tangential) in [(0.5, 0.2), (-0.3, -0.1), (0.2, 0.05), last] {
        instance.set_one("indentation_rate", normal);
        instance.set_one("tangential_rate", tangential);
        assert_eq!(instance.step(time, STEP), OK);
        time += STEP;
    }
    (instance, time)
}

/// Sets the derivatives of both rates over the next step: first and second derivative of each.
fn bend(instance: &mut Instance, slopes: [f64; 2], bends: [f64; 2]) {
    let references = ["indentation_rate", "tangential_rate"].map(|name| instance.real_of(name));
    for (order, values) in [(1, slopes), (2, bends)] {
        assert_eq!(instance.set_derivatives(&references, order, &values), OK, "{}", instance.message());
    }
}

/// Ends of steps in full stick, partial slip in both directions, sliding, and a reversal [m/s].
const MOTIONS: [(f64, f64); 7] =
    [(0.5, 0.002), (0.1, 0.05), (0.1, -0.05), (-0.2, 0.01), (0.0, 0.02), (0.01, 3.0), (-0.1, -3.0)];

#[test]
fn derivatives_of_the_tangential_force_are_those_of_its_course() {
    let unit = oblique();
    for last in MOTIONS {
        let (mut instance, time) = worked(&unit, last);
        let reference = instance.real_of("tangential_force");
        let mut given = [[0.0]; 2];
        for order in [1, 2] {
            assert_eq!(instance.output_derivatives(&[reference], order, &mut given[order as usize - 1]), OK);
        }
        let state = instance.save();
        let mut after = |part: f64| {
            instance.restore(state);
            assert_eq!(instance.step(time, part), OK);
            instance.real("tangential_force")
        };
        let here = after(1e-40);
        let width = 2e-11;
        let [one, two, three] = [1.0, 2.0, 3.0].map(|parts| after(parts * width) - here);
        let first = (18.0 * one - 9.0 * two + 2.0 * three) / (6.0 * width);
        let second = (-5.0 * one + 4.0 * two - three) / (width * width);
        let scale = (first.abs() / STEP).max(second.abs());
        assert!((given[0][0] - first).abs() <= 1e-7 * first.abs().max(1.0), "{last:?}: {:e} {first:e}", given[0][0]);
        assert!((given[1][0] - second).abs() <= 1e-3 * scale, "{last:?}: {:e} {second:e}", given[1][0]);
        instance.free(state);
    }
}

#[test]
fn derivatives_of_all_outputs_of_friction_are_finite_and_those_of_the_impulse_are_the_force() {
    let unit = oblique();
    let names = ["tangential_impulse", "mean_tangential_force", "tangential_energy", "friction_work", "stick_radius"];
    for last in MOTIONS {
        let (instance, _) = worked(&unit, last);
        let references = names.map(|name| instance.real_of(name));
        let mut values = [0.0; 5];
        assert_eq!(instance.output_derivatives(&references, 1, &mut values), OK, "{}", instance.message());
        assert_eq!((values[0], values[1]), (instance.real("tangential_force"), 0.0));
        // what the tangential force does is stored or lost
        let power = instance.real("tangential_force") * last.1;
        let scale = instance.real("tangential_force").abs() * (last.0.abs() + last.1.abs());
        assert!((values[2] + values[3] - power).abs() <= 1e-6 * scale, "{last:?}: {values:?} {power:e}");
        assert!(values[3] >= -1e-9 * scale, "{last:?}: friction makes no energy");
        assert_eq!(instance.output_derivatives(&references, 2, &mut values), OK);
        assert!(values.iter().all(|value| value.is_finite()));
    }
}

#[test]
fn the_predicted_tangential_force_comes_true_and_follows_both_inputs() {
    let unit = oblique();
    for last in MOTIONS {
        let (mut instance, time) = worked(&unit, last);
        let predicted = instance.real("predicted_tangential_force");
        let [own, normal, tangential] =
            ["predicted_tangential_force", "indentation_rate", "tangential_rate"].map(|name| instance.real_of(name));
        let state = instance.save();
        for (input, rate, other) in [(normal, last.0, tangential), (tangential, last.1, normal)] {
            let mut slope = [0.0];
            assert_eq!(instance.directional(&[own], input, &mut slope), OK);
            let width = 1e-4 * rate.abs().max(1e-3);
            let mut at = |rate: f64| {
                assert_eq!(instance.set(&[input], &[rate]), OK);
                instance.real("predicted_tangential_force")
            };
            let [up, down] = [rate + width, rate - width].map(&mut at);
            let expected = (up - down) / (2.0 * width);
            let scale = expected.abs().max(1e-3 * predicted.abs() / rate.abs().max(1e-3));
            assert!((slope[0] - expected).abs() <= 1e-2 * scale, "{last:?}: {:e} {expected:e}", slope[0]);
            at(rate);
            // the present force follows no input
            let force = [instance.real_of("tangential_force")];
            assert_eq!((instance.directional(&force, other, &mut slope), slope[0]), (OK, 0.0));
        }
        instance.restore(state);
        instance.free(state);
        assert_eq!(instance.step(time, STEP), OK);
        assert_eq!(instance.real("tangential_force").to_bits(), predicted.to_bits());
    }
}

/// The tangential force relative to Coulomb's limit after curved motions of both rates, in this number of steps. `size` is
/// that of the tangential rate [m/s].
fn curved(unit: &Unit, size: f64, parts: u32) -> f64 {
    let mut instance = unit.ready();
    let total = 4e-6;
    let part = total / f64::from(parts);
    // rates over the fraction of the whole time: in and out along the normal, to and fro in the tangential direction
    let normal = |t: f64| [2.0 * (1.0 - 1.6 * t), -3.2 / total, 0.0];
    let tangential =
        |t: f64| [size * (1.0 - 4.0 * t + 3.0 * t * t), size * (-4.0 + 6.0 * t) / total, 6.0 * size / (total * total)];
    for step in 0..parts {
        let fraction = f64::from(step) / f64::from(parts);
        let ([rate, slope, bend_of], [slip, slip_slope, slip_bend]) = (normal(fraction), tangential(fraction));
        instance.set_one("indentation_rate", rate);
        instance.set_one("tangential_rate", slip);
        bend(&mut instance, [slope, slip_slope], [bend_of, slip_bend]);
        assert_eq!(instance.step(f64::from(step) * part, part), OK, "{}", instance.message());
    }
    instance.real("tangential_force") / (0.092 * instance.real("force"))
}

#[test]
fn curved_motions_of_both_rates_are_exact_in_slip_and_of_second_order_in_stick() {
    let unit = oblique();
    for size in [0.02, 0.06, 0.1, 0.3] {
        let exact = curved(&unit, size, 2048);
        let errors = [1, 4, 16, 64, 256].map(|parts| (curved(&unit, size, parts) - exact).abs());
        println!("{size} m/s: {exact:.4}; errors in 1, 4, 16, 64, 256 steps: {errors:?}");
        if size == 0.3 {
            // the contact slips from the first touch on
            assert!(errors.iter().all(|error| *error < 1e-13), "{errors:?}");
            continue;
        }
        assert!(errors[0] < 0.1 && errors[1] < 0.03 && errors[2] < 3e-3 && errors[4] < 1e-4, "{errors:?}");
        // a factor of 16 each, down to the error of merged segments
        assert!(errors[2] < 0.15 * errors[1] && errors[3] < 0.15 * errors[2], "{errors:?}");
    }
}

#[test]
fn derivatives_that_cannot_be_set_are_refused_in_words() {
    let unit = oblique();
    let refused = |set: &dyn Fn(&mut Instance) -> i32, said: &str| {
        let mut instance = unit.ready();
        instance.take_message();
        assert_eq!(set(&mut instance), ERROR);
        let message = instance.take_message();
        assert!(message.contains(said), "{message}");
    };
    let tangential = unit.ready().real_of("tangential_rate");
    let force = unit.ready().real_of("tangential_force");
    refused(&|instance| instance.set_derivatives(&[tangential], 3, &[1.0]), "order 3: allowed is 1 or 2");
    refused(
        &|instance| instance.set_derivatives(&[tangential], 1, &[f64::NAN]),
        "a derivative of tangential_rate = NaN is not finite",
    );
    refused(
        &|instance| instance.set_derivatives(&[force], 1, &[1.0]),
        "only derivatives of indentation_rate and tangential_rate exist",
    );
    refused(
        &|instance| instance.set_derivatives(&[tangential], 1, &[1e50]),
        "a derivative of tangential_rate = 1e50 is out of range: allowed is -1e40 to 1e40 m/s^2",
    );
    refused(
        &|instance| {
            assert_eq!(instance.set_derivatives(&[tangential], 1, &[1e40]), OK);
            instance.step(0.0, 10.0)
        },
        "tangential_rate = 1e41 is out of range: allowed is -1e40 to 1e40 m/s, also within a step",
    );
    refused(
        &|instance| instance.directional(&[force], force, &mut [0.0]),
        "only derivatives by indentation_rate and tangential_rate exist",
    );
}
