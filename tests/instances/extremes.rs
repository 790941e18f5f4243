//! A contact may begin at any gap and rate, down to the smallest numbers: every step is made and ends in numbers.

use crate::scenes::{
    Choice, Chosen, Damped, DampedMassive, Elastoplastic, Frictional, FrictionalPlane, Lossy, LossyMassive, Massive,
    OUTPUTS, Rated, choose, outputs, ready, set_rate, words,
};
use crate::{DampedOne, LOSSES, every_pairing, some_pairings};
use brinell_contact::damped::AnyDamped;
use brinell_fmu::instance::Fault;
use brinell_fmu::scene::{Absent, Coupled, Present, Real, Scene};

/// Gaps [m]: subnormal, at the border of the normal numbers, and small enough that their squares vanish.
const GAPS: [f64; 7] = [0.0, 5e-324, 1e-320, 1e-310, f64::MIN_POSITIVE, 1e-300, 1e-160];

/// Rates [m/s].
const RATES: [f64; 8] = [0.0, 5e-324, -5e-324, 1e-310, -1e-300, 1e-9, 0.3, -0.3];

/// Steps at constant rates of an importer that never answers, which a unit must follow as well as any other.
fn goes_on<S: Scene>(name: &str, choice: Choice) {
    for gap in GAPS.into_iter().flat_map(|gap| [gap, -gap]) {
        choose(Choice { initial_gap: gap, ..choice });
        for rate in RATES {
            let mut instance = ready::<S>();
            for acceleration in [0.0, 9.81, -5e-324] {
                let input = (Real::ExternalAcceleration, 0);
                if S::has_input(Real::ExternalAcceleration) {
                    instance.set_real(input, acceleration);
                } else if acceleration != 0.0 {
                    let slope = (Real::IndentationRate, 0);
                    if instance.check_input_derivative(slope, 1, acceleration).is_ok() {
                        instance.set_input_derivative(slope, 1, acceleration);
                    }
                }
                let allowed = instance.check_real((Real::IndentationRate, 0), rate);
                if let Err(refusal) = allowed {
                    // where the force begins with a jump, the pressure on next to no area is no number
                    let what = format!("{name} from {gap:e} m at {rate:e} m/s: {refusal:?}");
                    assert!(matches!(refusal, Fault::TooFast { .. }) && gap < 0.0 && gap > -1e-290, "{what}");
                    break;
                }
                instance.set_real((Real::IndentationRate, 0), rate);
                // before the first step, too, where the surface of some laws has no width; next to no numbers may have no slope
                let orders: &[i32] = if gap >= 0.0 && rate.abs() >= 1e-9 { &[1, 2] } else { &[] };
                for (output, order) in orders.iter().flat_map(|&order| OUTPUTS.map(|output| (output, order))) {
                    let slope = instance.output_derivative((output, 0), order);
                    let what = format!("{name}, {output:?} from {gap:e} m at {rate:e} m/s");
                    assert_ne!(slope, Err(Fault::DerivativeNotFinite), "{what}");
                }
                let (time, before) = (instance.time(), words(&instance));
                for step in [1e-9, 1e-4] {
                    let made = instance.do_step(instance.time(), step);
                    assert!(made.is_ok(), "{name} from {gap:e} m at {rate:e} m/s: {made:?}");
                }
                let shown = outputs(&instance);
                assert!(shown.iter().all(|number| number.is_finite()), "{name} from {gap:e} m: {shown:?}");
                assert!(instance.time() > time && words(&instance) != before);
            }
        }
    }
}

/// The same for every way to couple.
macro_rules! every_coupling {
    ($kind:ident, $name:expr, $choice:expr) => {
        goes_on::<Chosen<$kind, 1, Present>>(&format!("{}, serial", $name), $choice);
        goes_on::<Chosen<$kind<Coupled<Present>>, 1, Present>>(&format!("{}, parallel", $name), $choice);
        goes_on::<Chosen<$kind<Coupled<Absent, Present>>, 1, Present>>(&format!("{}, accelerated", $name), $choice);
        goes_on::<Chosen<$kind<Coupled<Present, Present, Present>>, 1, Present>>(&format!("{}, wired", $name), $choice);
    };
}

/// The law `kelvin-voigt` once refused a step of a coupled contact with a subnormal indentation.
#[test]
fn a_rate_dependent_contact_begins_at_any_gap() {
    for (name, damped) in AnyDamped::ALL {
        for restitution in [1e-3, 0.6, 1.0] {
            let choice = Choice { damped, restitution, ..every_pairing()[0].1 };
            goes_on::<Chosen<Damped, 1, Present>>(name, choice);
            every_coupling!(DampedMassive, name, choice);
        }
    }
}

#[test]
fn an_elastoplastic_contact_begins_at_any_gap() {
    for (name, choice) in every_pairing() {
        goes_on::<Chosen<Elastoplastic, 1, Present>>(&name, choice);
        every_coupling!(Massive, name, choice);
    }
    for (name, choice) in some_pairings() {
        every_coupling!(Rated, format!("{name}, rated"), choice);
        goes_on::<Chosen<Frictional, 1, Present>>(&format!("{name}, friction"), choice);
        goes_on::<Chosen<FrictionalPlane, 1, Present>>(&format!("{name}, friction in two directions"), choice);
    }
}

#[test]
fn a_contact_with_a_loss_begins_at_any_gap() {
    for (name, choice) in some_pairings() {
        for loss in LOSSES {
            let (name, choice) = (format!("{name}, {loss:?}"), Choice { loss, ..choice });
            goes_on::<Chosen<Lossy, 1, Present>>(&name, choice);
            every_coupling!(LossyMassive, name, choice);
        }
    }
}

/// A contact that was touched at almost zero speed once had an infinite damping.
#[test]
fn a_rate_dependent_contact_can_be_touched_at_next_to_no_speed() {
    for (name, damped) in AnyDamped::ALL {
        for rate in [1e-300, 1e-200, 1e-100, 1e-30] {
            choose(Choice { damped, ..some_pairings()[0].1 });
            let mut instance = ready::<DampedOne>();
            set_rate(&mut instance, 0, rate);
            // indentation of one micrometre
            instance.do_step(0.0, if rate > 1e-50 { 1e-6 / rate } else { 1e49 }).unwrap_or_else(|fault| {
                panic!("{name} at {rate} m/s: {fault:?}");
            });
            let shown = outputs(&instance);
            assert!(shown.iter().all(|number| number.is_finite()), "{name} at {rate} m/s: {shown:?}");
        }
    }
}
