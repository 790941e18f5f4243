//! Derivatives of outputs by inputs before the first step. All others: `tests/conformance/checks/derivatives.rs`.

use crate::scenes::{Choice, Chosen, DampedMassive, LossyMassive, OUTPUTS, choose, set_rate};
use crate::{DampedOne, MassiveOne, One, some_pairings};
use brinell_contact::damped::AnyDamped;
use brinell_fmu::instance::Instance;
use brinell_fmu::scene::{Present, Real, Scene};

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
