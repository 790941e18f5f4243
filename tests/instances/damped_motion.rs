//! The force of bodies that an instance of a rate-dependent law moves.

use crate::physics;
use crate::scenes::{Choice, Chosen, DampedMassive, choose, ready, set_rate};
use brinell_contact::damped::AnyDamped;
use brinell_fmu::instance::Instance;
use brinell_fmu::scene::{Present, Real};

type One = Chosen<DampedMassive, 1, Present>;

#[test]
fn the_force_of_an_instance_is_that_at_the_own_speed_of_its_bodies() {
    for (name, damped) in AnyDamped::ALL {
        let laws = physics::model("hertz", "contact-radius");
        let choice = Choice { damped, ..Choice::of(laws.loading, laws.unloading) };
        choose(choice);
        let mut instance = ready::<One>();
        let (step, mut speed, mut before, mut largest) = (2e-8, 1.0, 0.0, 0.0f64);
        for place in 0..1500 {
            set_rate(&mut instance, 0, speed);
            instance.do_step(instance.time(), step).unwrap();
            let force = instance.real((Real::Force, 0));
            let end = instance.real((Real::ClosingSpeed, 0));
            largest = largest.max(force);
            // the momentum says the same as the forces at both ends of the step, if the force is smooth within it
            let taken = choice.effective_mass * (speed - end) / step;
            if place > 100 && before > 0.0 && force > 0.0 {
                let error = (0.5 * (before + force) - taken).abs() / largest;
                assert!(error < 1e-5, "{name} in step {place}: {error:e}");
            }
            (before, speed) = (force, end);
            // an input for the next step changes neither the force nor any other output of the last step
            let outputs = [Real::Force, Real::MeanPressure, Real::Stiffness, Real::PredictedForce];
            let all = |instance: &Instance<One>| outputs.map(|output| instance.real((output, 0)));
            let shown = all(&instance);
            set_rate(&mut instance, 0, 0.5 * end + 0.1);
            assert_eq!(all(&instance).map(f64::to_bits), shown.map(f64::to_bits), "{name} in step {place}");
            for output in outputs {
                let slope = instance.derivative_by_input((output, 0), (Real::IndentationRate, 0));
                assert_eq!(slope.unwrap(), 0.0, "{name}, {output:?}");
            }
        }
        assert!(speed < 0.0 && largest > 100.0, "{name}: {speed} m/s after {largest} N");
    }
}
