//! Derivatives of outputs by time and by inputs, against differences of outputs.

use crate::physics::{self, Random, mild};
use crate::scenes::{Choice, Chosen, DampedMassive, LossyMassive, OUTPUTS, choose, ready, set_rate};
use crate::{DampedOne, DampedSeveral, MassiveOne, One, STEP, Several, every_pairing, some_pairings};
use brinell_contact::damped::AnyDamped;
use brinell_fmu::instance::{Fault, Instance};
use brinell_fmu::scene::{Present, Real, Scene};

/// Compares derivatives with respect to time with differences of the outputs over the following steps.
#[test]
fn derivatives_of_every_output_are_those_of_its_course() {
    for (name, choice) in every_pairing() {
        let d_y = physics::unit(&mild()).indentation;
        for (depth, back) in [(0.6, 0.0), (3.7, 0.0), (31.0, 0.0), (150.0, 0.0), (31.0, 0.3), (150.0, 0.02)] {
            choose(choice);
            let mut instance = ready::<One>();
            let mut go = |rate: f64, step: f64| {
                set_rate(&mut instance, 0, rate);
                let time = instance.time();
                instance.do_step(time, step).unwrap();
            };
            go(1.0, depth * d_y);
            if back > 0.0 {
                go(-1.0, back * d_y);
            }
            let rate = if back > 0.0 { -1.0 } else { 1.0 };
            let apart = instance.real((Real::Force, 0)) == 0.0;
            let width = if apart { 1e-9 } else { 1e-3 * if back > 0.0 { back } else { depth } } * d_y;
            // outputs at four times from here on
            let mut later = Vec::new();
            for place in 0..4 {
                let mut moved = ready::<One>();
                moved.copy(&instance);
                if place > 0 {
                    set_rate(&mut moved, 0, rate);
                    let time = moved.time();
                    moved.do_step(time, f64::from(place) * width).unwrap();
                }
                later.push(moved);
            }
            for output in OUTPUTS {
                let at = |place: usize| later[place].real((output, 0));
                let slow = (-11.0 * at(0) + 18.0 * at(1) - 9.0 * at(2) + 2.0 * at(3)) / (6.0 * width);
                let bend = (2.0 * at(0) - 5.0 * at(1) + 4.0 * at(2) - at(3)) / (width * width);
                let derivative = |order| instance.output_derivative((output, 0), order).unwrap();
                let whole_step = matches!(output, Real::MeanForce | Real::PredictedForce);
                if whole_step {
                    assert_eq!([derivative(1), derivative(2)], [0.0; 2], "{name}");
                    continue;
                }
                let size = (0..4).map(|place| at(place).abs()).fold(0.0, f64::max);
                let what = format!("{name}, {output:?} at {depth} d_y, {back} d_y back");
                let error = (derivative(1) - slow).abs();
                let scale = slow.abs() + 1e-4 * size / width;
                assert!(error <= 1e-4 * scale + 1e-13 * size / width, "{what}: {} for {slow}", derivative(1));
                let error = (derivative(2) - bend).abs();
                let scale = bend.abs() + 1e-3 * (slow.abs() / width + size / (width * width) * 1e-3);
                assert!(error <= 0.05 * scale, "{what}: {} for {bend}", derivative(2));
            }
        }
    }
}

/// This was once NaN for every law without segments: the surface has no width.
#[test]
fn derivatives_before_the_first_step_are_numbers() {
    for gap in [0.0, 1e-6, -1e-6, -5e-324, 5e-324] {
        for (name, choice) in every_pairing() {
            choose(Choice { initial_gap: gap, ..choice });
            let mut instance = ready::<One>();
            set_rate(&mut instance, 0, 1.0);
            for output in OUTPUTS {
                for order in [1, 2] {
                    let derivative = instance.output_derivative((output, 0), order);
                    assert!(
                        derivative.is_ok_and(f64::is_finite),
                        "{name}, {output:?} of order {order}: {derivative:?}"
                    );
                }
            }
            if gap == 0.0 {
                assert_eq!(instance.output_derivative((Real::Force, 0), 2), Ok(0.0), "{name}");
            }
        }
    }
}

/// The bodies that an instance moves have their own speed from the first step on. Before, it is the input.
#[test]
fn derivatives_by_the_input_during_initialization_are_those_of_the_outputs() {
    fn check<S: Scene>(name: &str) {
        let at = |rate: f64| {
            let mut instance = Instance::<S>::new().unwrap();
            instance.set_experiment(0.0, None).unwrap();
            instance.enter_initialization().unwrap();
            set_rate(&mut instance, 0, rate);
            instance
        };
        for rate in [-0.4, -1e-3, 1e-3, 0.5, 2.0] {
            let width = 1e-4 * f64::abs(rate);
            let (above, here, below) = (at(rate + width), at(rate), at(rate - width));
            for output in OUTPUTS {
                let exact = here.derivative_by_input((output, 0), (Real::IndentationRate, 0)).unwrap();
                let slope = (above.real((output, 0)) - below.real((output, 0))) / (2.0 * width);
                let size = here.real((output, 0)).abs() / rate.abs();
                let error = (exact - slope).abs();
                assert!(error <= 1e-6 * slope.abs() + 1e-9 * size, "{name}, {output:?} at {rate}: {exact} for {slope}");
            }
        }
    }
    for (name, choice) in some_pairings() {
        choose(Choice { initial_gap: -1e-6, ..choice });
        check::<One>(&name);
        check::<MassiveOne>(&name);
        check::<Chosen<LossyMassive, 1, Present>>(&name);
    }
    for (name, damped) in AnyDamped::ALL {
        choose(Choice { damped, initial_gap: -1e-6, ..some_pairings()[0].1 });
        check::<DampedOne>(name);
        check::<Chosen<DampedMassive, 1, Present>>(name);
    }
}

/// Compares derivatives such as dF/d(rate) with differences of outputs at two rates.
#[test]
fn derivatives_by_the_input_are_those_of_the_outputs() {
    fn check<S: Scene>(name: &str) {
        let mut instance = ready::<S>();
        let mut random = Random(11);
        for step in 0..30 {
            let rate = 3.0 * random.next() - 1.2;
            let time = instance.time();
            let at = |rate: f64| {
                let mut other = ready::<S>();
                other.copy(&instance);
                set_rate(&mut other, 0, rate);
                other
            };
            let width = 1e-4 * rate.abs();
            let (above, below) = (at(rate + width), at(rate - width));
            set_rate(&mut instance, 0, rate);
            for output in OUTPUTS {
                let input = (Real::IndentationRate, 0);
                let exact = instance.derivative_by_input((output, 0), input).unwrap();
                let differences = above.real((output, 0)) - below.real((output, 0));
                let slope = differences / (2.0 * width);
                // a corner of the law between the two is not an error
                let one_sided = (above.real((output, 0)) - instance.real((output, 0))) / width;
                let smooth = (one_sided - slope).abs() < 1e-3 * slope.abs();
                let size = instance.real((output, 0)).abs() / rate.abs();
                assert!(
                    !smooth && slope != 0.0 || (exact - slope).abs() <= 1e-3 * slope.abs() + 1e-9 * size,
                    "{name}, {output:?} in step {step}: {exact} for {slope}"
                );
                if S::contacts() > 1 {
                    let other = (Real::IndentationRate, 1);
                    assert_eq!(instance.derivative_by_input((output, 0), other), Ok(0.0));
                }
            }
            instance.do_step(time, STEP).unwrap();
        }
        assert_eq!(instance.derivative_by_input((Real::Force, 0), (Real::Parameter(0), 0)), Err(Fault::NotAnInput));
    }
    for (name, choice) in some_pairings() {
        choose(choice);
        check::<One>(&name);
        check::<Several>(&name);
    }
    for (name, damped) in AnyDamped::ALL {
        choose(Choice { damped, ..some_pairings()[0].1 });
        check::<DampedOne>(name);
        check::<DampedSeveral>(name);
    }
}
