//! Contacts with friction as instances.

use crate::physics::Random;
use crate::scenes::{OUTPUTS, choose, ready, set_rate, set_tangential_rate};
use crate::{FrictionalOne, One, RoughPlaneOne, STEP, some_pairings};
use brinell_fmu::scene::{Real, Scene};

/// Friction changes nothing along the normal.
#[test]
fn a_contact_with_friction_has_the_normal_outputs_of_one_without() {
    fn check<S: Scene>(name: &str) {
        let (mut frictional, mut smooth) = (ready::<S>(), ready::<One>());
        let mut random = Random(17);
        let input = (Real::IndentationRate, 0);
        for step in 0..60 {
            let rate = 4.0 * random.next() - 1.9;
            set_rate(&mut frictional, 0, rate);
            set_rate(&mut smooth, 0, rate);
            set_tangential_rate(&mut frictional, 0, 2.0 * random.next() - 0.9);
            let time = frictional.time();
            frictional.do_step(time, STEP).unwrap();
            smooth.do_step(time, STEP).unwrap();
            for output in OUTPUTS {
                let of_rough = [
                    Ok(frictional.real((output, 0))),
                    frictional.output_derivative((output, 0), 1),
                    frictional.output_derivative((output, 0), 2),
                    frictional.derivative_by_input((output, 0), input),
                ];
                let of_smooth = [
                    Ok(smooth.real((output, 0))),
                    smooth.output_derivative((output, 0), 1),
                    smooth.output_derivative((output, 0), 2),
                    smooth.derivative_by_input((output, 0), input),
                ];
                let what = format!("{name}, {output:?} in step {step}: {of_rough:?} and {of_smooth:?}");
                for (one, other) in of_rough.into_iter().zip(of_smooth) {
                    let same = match (&one, &other) {
                        (Ok(one), Ok(other)) => (one - other).abs() <= 1e-13 * other.abs(),
                        _ => one == other,
                    };
                    assert!(same, "{what}");
                }
            }
        }
    }
    for (name, choice) in some_pairings() {
        choose(choice);
        check::<FrictionalOne>(&name);
        check::<RoughPlaneOne>(&format!("{name}, two directions"));
    }
}
