//! A host may trap floating-point exceptions: a successful call raises none except inexact and underflow.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

use crate::LOSSES;
use crate::physics::{Random, all_models, mild};
use crate::scenes::{
    Choice, Chosen, Damped, DampedMassive, Elastoplastic, Frictional, FrictionalPlane, Lossy, LossyMassive, Massive,
    OUTPUTS, Rated, choose, frictions, words,
};
use brinell_contact::damped::AnyDamped;
use brinell_contact::rate::Rate;
use brinell_contact::{Contact, Surface};
use brinell_fmu::instance::{Fault, Instance};
use brinell_fmu::scene::{Present, Real, Scene};
use brinell_testing::long::some;

type One = Chosen<Elastoplastic, 1, Present>;
type Several = Chosen<Elastoplastic, 3, Present>;
type MassiveOne = Chosen<Massive, 1, Present>;
type FrictionalOne = Chosen<Frictional, 1, Present>;
type RoughPlaneOne = Chosen<FrictionalPlane, 1, Present>;
type RatedOne = Chosen<Rated, 1, Present>;
type DampedMassiveOne = Chosen<DampedMassive, 1, Present>;
type DampedOne = Chosen<Damped, 1, Present>;
type LossyOne = Chosen<Lossy, 1, Present>;
type LossyMassiveOne = Chosen<LossyMassive, 1, Present>;

const RATES: [Rate; 2] = [Rate::JohnsonCook { c: 0.014, reference_rate: 1.0 }, Rate::CowperSymonds { d: 40.4, q: 5.0 }];

const INVALID: i32 = 1;
const DIVISION_BY_ZERO: i32 = 4;
const OVERFLOW: i32 = 8;

#[link(name = "m")]
unsafe extern "C" {
    fn feclearexcept(exceptions: i32) -> i32;
    fn fetestexcept(exceptions: i32) -> i32;
}

/// The result of `call`, and the exceptions that it raised.
#[inline(never)]
fn raised<T>(call: impl FnOnce() -> T) -> (T, i32) {
    let all = INVALID | DIVISION_BY_ZERO | OVERFLOW;
    // SAFETY: functions of the C library that read and clear the processor's flags.
    unsafe {
        feclearexcept(all);
        let result = std::hint::black_box(call());
        (result, fetestexcept(all))
    }
}

/// Fails if a successful call raised an exception.
#[track_caller]
fn quiet<T, E>(what: impl Fn() -> String, call: impl FnOnce() -> Result<T, E>) {
    let (result, flags) = raised(call);
    assert!(result.is_err() || flags == 0, "{}: exceptions {flags}", what());
}

/// Reads every output and its derivatives.
fn read<S: Scene>(instance: &Instance<S>, what: impl Fn(&str) -> String) {
    for output in OUTPUTS.into_iter().chain(frictions::<S>()) {
        for contact in 0..S::contacts() {
            let (_, flags) = raised(|| instance.real((output, contact)));
            assert_eq!(flags, 0, "{}", what(&format!("{output:?}")));
            for order in [1, 2] {
                let derivative = || instance.output_derivative((output, contact), order);
                quiet(|| what(&format!("derivative {order} of {output:?}")), derivative);
            }
            let by_input = || instance.derivative_by_input((output, contact), (Real::IndentationRate, 0));
            quiet(|| what(&format!("{output:?} by the input")), by_input);
        }
    }
}

/// Steps with speeds from 1e-6 to 1e3 m/s into the target and out of it, a rest at every depth and at the surface, and steps
/// without length, which are refused.
fn sweep<S: Scene>(name: &str) {
    let mut instance = begun::<S>(name);
    let mut random = Random(5);
    for place in 0..48 {
        let sign = [1.0, 1.0, -1.0, 0.0][place % 4];
        let speed = 10f64.powf(9.0 * random.next() - 6.0);
        let way = 2e-5 * random.next().powi(3);
        let (rate, length) = (sign * speed, way / speed);
        let what = |call: &str| format!("{name}: {call} in step {place} at {rate} m/s for {length} s");
        let accepted = raised(|| instance.check_real((Real::IndentationRate, 0), rate));
        assert_eq!(accepted, (Ok(()), 0), "{}", what("set"));
        instance.set_real((Real::IndentationRate, 0), rate);
        for length in [0.0, length, 1e-49] {
            let time = instance.time();
            let (stepped, flags) = raised(|| instance.do_step(time, length));
            // the motion of bodies of known mass on a very thin plate is stiff: long steps need too many evaluations
            let is_stiff = name.contains("thickness: 0.001") && name.ends_with("moved");
            let good = match &stepped {
                Ok(()) => length > 0.0 && flags == 0,
                Err(Fault::TooLong { .. }) => is_stiff,
                Err(_) => length == 0.0,
            };
            assert!(good, "{}: {stepped:?}, {flags}", what("step"));
        }
        read(&instance, what);
        // out to the surface, where the body rests
        let surface = instance.real((Real::ResidualIndentation, 0));
        let height = instance.real((Real::Indentation, 0)) - surface;
        if place % 16 == 15 && height > 0.0 {
            for (rate, length) in [(-height, 1.0), (0.0, 1e-3), (1e-6, 1e-9), (0.0, 1e-3)] {
                instance.set_real((Real::IndentationRate, 0), rate);
                let time = instance.time();
                quiet(|| what("rest at the surface"), || instance.do_step(time, length));
                read(&instance, what);
            }
        }
    }
}

/// An instance after its initialization, which raises no flags.
fn begun<S: Scene>(name: &str) -> Instance<S> {
    let (made, flags) = raised(Instance::<S>::new);
    assert_eq!(flags, 0, "{name}: made");
    let mut instance = made.unwrap();
    instance.set_experiment(0.0, None).unwrap();
    quiet(
        || format!("{name}: initialization"),
        || {
            instance.enter_initialization()?;
            instance.exit_initialization()
        },
    );
    instance
}

/// Creates an instance, uses it, and checks the flags after every call.
fn live<S: Scene>(name: &str) {
    let mut instance = begun::<S>(name);
    let mut random = Random(17);
    let special = [0.0, -0.0, 1.0, 1.0, -0.3, -8.0, -1e-300, 1e-300, 0.0, 1e-9, 5.0, -1.0, 0.0, 0.0, -50.0, -0.0];
    for step in 0..80 {
        let rate = if step < special.len() { special[step] } else { 6.0 * random.next() - 3.0 };
        let length = [1e-6, 1e-7, 3e-6, 1e-9][step % 4];
        let what = |call: &str| format!("{name}: {call} in step {step} at {rate} m/s");
        for contact in 0..S::contacts() {
            let variable = (Real::IndentationRate, contact);
            quiet(|| what("set"), || instance.check_real(variable, rate));
            instance.set_real(variable, rate);
            if instance.check_input_derivative(variable, 1, -9.81).is_ok() && step % 3 == 0 {
                let acceleration = [0.0, -9.81, 3e4, -1e-3][step / 3 % 4];
                quiet(|| what("derivative"), || instance.check_input_derivative(variable, 1, acceleration));
                instance.set_input_derivative((Real::IndentationRate, contact), 1, acceleration);
            }
            for (direction, input) in [Real::TangentialRate, Real::SecondTangentialRate].into_iter().enumerate() {
                if direction >= S::Contact::DIRECTIONS {
                    break;
                }
                let slip = special[((3 + 2 * direction) * step + 1) % special.len()];
                let variable = (input, contact);
                quiet(|| what("tangential set"), || instance.check_real(variable, slip));
                instance.set_real(variable, slip);
                if step % 5 == 0 {
                    instance.set_input_derivative(variable, 2, 1e9 * slip.clamp(-1.0, 1.0));
                }
            }
        }
        let time = instance.time();
        quiet(|| what("step"), || instance.do_step(time, length));
        read(&instance, what);
        let (_, flags) = raised(|| words(&instance));
        assert_eq!(flags, 0, "{}", what("saved"));
    }
}

#[test]
fn the_flags_are_seen() {
    let division = |by: f64| raised(|| std::hint::black_box(1.0) / std::hint::black_box(by)).1;
    assert_eq!((division(0.0), division(2.0)), (DIVISION_BY_ZERO, 0));
}

#[test]
fn elastoplastic_instances_raise_none() {
    for (name, model) in some(all_models(mild()), 3) {
        for surface in [Surface::Dented, Surface::Fresh] {
            for initial_gap in [0.0, 1e-6, -3e-5] {
                choose(Choice { surface, initial_gap, ..Choice::of(model.loading, model.unloading) });
                live::<One>(&name);
            }
        }
        choose(Choice { target_radius: f64::INFINITY, ..Choice::of(model.loading, model.unloading) });
        live::<Several>(&name);
    }
}

#[test]
fn rate_dependent_instances_raise_none() {
    let (_, model) = all_models(mild()).swap_remove(0);
    for (name, damped) in AnyDamped::ALL {
        for restitution in [1e-3, 0.5, 1.0] {
            for initial_gap in [0.0, 1e-6, -3e-5] {
                choose(Choice { damped, restitution, initial_gap, ..Choice::of(model.loading, model.unloading) });
                live::<DampedOne>(name);
                live::<DampedMassiveOne>(&format!("{name}, moved"));
            }
        }
    }
}

#[test]
fn instances_with_friction_raise_none() {
    for (name, model) in some(all_models(mild()), 3) {
        // the laws without a tangential force
        if ["hertz-shift", "etsion", "vu-quoc-zhang"].iter().any(|law| name.ends_with(law)) {
            continue;
        }
        for friction in [0.0, 1e-200, 0.3] {
            let choice = Choice { friction, ..Choice::of(model.loading, model.unloading) };
            choose(choice);
            live::<FrictionalOne>(&format!("{name}, friction {friction:e}"));
            // each unloading law once: it has the springs
            if ["hertz ", "big-alabo ", "luding "].iter().any(|law| name.starts_with(law)) {
                live::<RoughPlaneOne>(&format!("{name}, friction {friction:e} in two directions"));
            }
            choose(Choice { surface: Surface::Fresh, initial_gap: -3e-5, ..choice });
            live::<FrictionalOne>(&format!("{name}, friction {friction:e}, fresh"));
        }
    }
}

#[test]
fn instances_that_know_the_mass_raise_none() {
    for (name, model) in some(all_models(mild()), 3) {
        for surface in [Surface::Dented, Surface::Fresh] {
            choose(Choice { surface, ..Choice::of(model.loading, model.unloading) });
            live::<MassiveOne>(&name);
            for rate in RATES {
                choose(Choice { surface, rate, ..Choice::of(model.loading, model.unloading) });
                live::<RatedOne>(&format!("{name}, {rate:?}"));
            }
        }
    }
}

#[test]
fn instances_with_losses_raise_none() {
    let starts = [(Surface::Dented, 0.0), (Surface::Dented, -3e-5), (Surface::Fresh, 1e-6)];
    for (place, (name, model)) in some(all_models(mild()), 3).enumerate() {
        for (turn, loss) in LOSSES.into_iter().enumerate() {
            // every start with each law and with each loss
            let (surface, initial_gap) = starts[(place + turn) % 3];
            choose(Choice { loss, surface, initial_gap, ..Choice::of(model.loading, model.unloading) });
            let (name, moved) = (format!("{name}, {loss:?}"), format!("{name}, {loss:?}, moved"));
            live::<LossyOne>(&name);
            live::<LossyMassiveOne>(&moved);
            if initial_gap == 0.0 {
                sweep::<LossyOne>(&name);
                sweep::<LossyMassiveOne>(&moved);
            }
        }
    }
}
