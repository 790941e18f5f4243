//! Bodies have no mass of their own scale: heavier ones go the same way, slower.
//!
//! With `k^2` times the mass and `k` times the time, each term of `m d'' = -F + m a` is the same, if the waves and rates of the
//! law are as much slower. With a power of two as `k` the numbers differ in their exponents only.

use crate::physics::{MASS, mild, model};
use brinell_contact::damped::{Adams, AnyDamped, Damped, KelvinVoigt, KuwabaraKono};
use brinell_contact::losses::{self, AnyLoss, HalfSpaceRadiation, Plate, RestitutionFitted, Solid};
use brinell_contact::motion::{self, ExternalLoad, Follow};
use brinell_contact::{Contact, History, rate};

/// Length of the steps, about that of an impact [s].
const STEP: f64 = 1e-4;

/// The indentation [m], the force [N] and the speed [m/s] of a ball after each step, and the force of its weight at the end.
/// It falls, bounces, and rests. The results are those of a ball of `MASS`.
fn course<M, C: Contact<M>>(name: &str, model: &M, follow: Follow<C, M>, k: f64) -> Vec<[f64; 3]> {
    let mut contact = C::start(model, 1e-5).expect("within range");
    let drive = ExternalLoad { mass: MASS * k * k, acceleration: 9.81 / (k * k) };
    let mut speed = 0.3 / k;
    let step = |step: usize| {
        let before = (contact.indentation(), speed * k);
        let outcome = follow(&mut contact, model, &drive, speed, STEP * k)
            .unwrap_or_else(|reason| panic!("{name}, {k} times as slow, step {step} from {before:?}: {reason:?}"));
        speed = outcome.speed;
        [contact.indentation(), contact.force(speed), speed * k]
    };
    (0..4000).map(step).collect()
}

/// A ball of any mass goes the way of a ball of `MASS`.
fn check<M, C: Contact<M>>(name: &str, of: impl Fn(f64) -> M, follow: Follow<C, M>) {
    let expected = course(name, &of(1.0), follow, 1.0);
    for k in [-20, -1, 10].map(|power| 2f64.powi(power)) {
        let found = course(name, &of(k), follow, k);
        for (step, (found, expected)) in found.iter().zip(&expected).enumerate() {
            assert_eq!(found, expected, "{name}, {} times the mass, step {step}", k * k);
        }
    }
}

const LAWS: [(&str, &str); 4] =
    [("big-alabo", "contact-radius"), ("brinell", "brinell"), ("jackson-green", "jackson"), ("luding", "luding")];

#[test]
fn a_ball_of_any_mass_goes_the_same_way() {
    for (loading, unloading) in LAWS {
        check(loading, |_| model(loading, unloading), motion::follow::<History, _>);
    }
}

#[test]
fn a_ball_of_any_mass_has_the_same_losses_and_comes_to_the_same_rest() {
    let losses = |k: f64| {
        let target = Solid { density: 7850.0 * k * k, youngs_modulus: mild().youngs_modulus, poissons_ratio: 0.3 };
        [
            AnyLoss::RestitutionFitted(RestitutionFitted { restitution: 0.9 }),
            AnyLoss::HalfSpaceRadiation(HalfSpaceRadiation { target }),
            AnyLoss::Plate(Plate { target, thickness: 0.01 }),
        ]
    };
    for (loading, unloading) in LAWS {
        let plastic = model(loading, unloading);
        for (index, loss) in losses(1.0).into_iter().enumerate() {
            let of = |k: f64| losses::Model { plastic, loss: losses(k)[index] };
            check(&format!("{loading} with {loss:?}"), of, losses::follow::<losses::History<_>, _>);
        }
    }
}

#[test]
fn a_ball_of_any_mass_meets_the_same_strength_if_the_rates_are_as_much_slower() {
    for (loading, unloading) in LAWS {
        let slow = model(loading, unloading);
        let of = |k: f64| rate::Model {
            slow,
            rate: rate::Rate::CowperSymonds { d: 40.4 / k, q: 5.0 },
            harder: rate::Rate::NONE,
        };
        check(loading, of, motion::follow::<rate::History, _>);
    }
}

#[test]
fn a_ball_of_any_mass_is_damped_alike() {
    for (name, law) in AnyDamped::ALL {
        // some laws have a speed or a time among their constants
        let scaled = |k: f64| match law {
            AnyDamped::KelvinVoigt(law) => {
                AnyDamped::KelvinVoigt(KelvinVoigt { characteristic_speed: law.characteristic_speed / k })
            }
            AnyDamped::KuwabaraKono(law) => {
                AnyDamped::KuwabaraKono(KuwabaraKono { relaxation_time: law.relaxation_time * k })
            }
            AnyDamped::Adams(law) => AnyDamped::Adams(Adams { full_damping: law.full_damping * k, ..law }),
            law => law,
        };
        let of = |k: f64| scaled(k).model(mild(), 0.6, MASS * k * k);
        check(name, of, losses::follow::<losses::History<_>, _>);
    }
}
