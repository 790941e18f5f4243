//! Prediction of an impact on a contact with losses.

use super::bodies::{Bodies, short_time};
use super::history::History;
use super::{Loss, Model};
use crate::impact::{Impact, Prediction};
use crate::loading::Loading;
use crate::unloading::Unloading;
use libm::pow;

/// An instant of the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Time since first contact \[s\].
    pub time: f64,
    /// Indentation \[m\].
    pub indentation: f64,
    /// Closing speed \[m/s\].
    pub speed: f64,
}

/// More stretches than an impact has.
const MOST_STRETCHES: u32 = 1000;

/// The time after which an impact is given up, relative to that of an elastic one.
const LONGEST: f64 = 1e9;

/// The impact `impact` on an untouched contact: the motion `m d'' = -F` is integrated until the bodies separate. The results
/// are accurate to about 1e-9; the largest force is that at the steps of the integration.
///
/// `None` if the mass or the speed is not positive and finite, if the energy is below the smallest normal number, if the
/// motion leaves the range of the law, or if it never ends.
pub fn predict<L: Loading, U: Unloading, K: Loss>(model: &Model<L, U, K>, impact: &Impact) -> Option<Prediction> {
    follow(model, impact, |_, _| {})
}

/// [`predict`] that also passes every instant of the integration, from first contact to the end, to `watch`, together with
/// the force \[N\].
pub fn follow<L: Loading, U: Unloading, K: Loss>(
    model: &Model<L, U, K>,
    impact: &Impact,
    mut watch: impl FnMut(&State, f64),
) -> Option<Prediction> {
    let Impact { mass, speed } = *impact;
    let positive = |value: f64| value > 0.0 && value < f64::INFINITY;
    let energy = 0.5 * mass * speed * speed;
    if !positive(mass) || !positive(speed) || !positive(energy) || energy < f64::MIN_POSITIVE {
        return None;
    }
    let contact = History::start(model, 0.0).ok()?;
    let hertz = pow(energy / (0.4 * model.plastic.pair.hertz_stiffness()), 0.4);
    let scale = short_time(hertz, speed);
    let longest = 1e3 * LONGEST * scale;
    let mut bodies = Bodies::new(&contact, model, (1.0 / mass, 0.0, speed), longest).ok()?;
    bodies.guess = scale;
    bodies.contact.swiftest = speed;
    let (mut time, mut largest, mut turning) = (0.0, 0.0, 0.0);
    // the time up to which the force lasted, and whether it lasts; a surface that lags behind the bodies has none
    let (mut force_end, mut pushes) = (0.0, true);
    watch(&State { time, indentation: 0.0, speed }, bodies.contact.force(speed));
    for _ in 0..MOST_STRETCHES {
        let start = bodies.contact.plastic().indentation();
        let (mut last, mut deepest) = (0.0, (0.0, start));
        bodies
            .press(&mut |state, force| {
                let indentation = start + (state.way - state.retreat);
                largest = if force > largest { force } else { largest };
                deepest = if indentation > deepest.1 { (state.time, indentation) } else { deepest };
                last = state.time;
                force_end = if pushes { time + last } else { force_end };
                pushes = force > 0.0;
                watch(&State { time: time + state.time, indentation, speed: state.speed }, force);
            })
            .ok()?;
        if deepest.1 >= bodies.deepest() && deepest.0 > 0.0 {
            turning = time + deepest.0;
        }
        time += last;
        if bodies.is_apart() {
            return Some(prediction(model, impact, &bodies, (largest, turning, force_end)));
        }
    }
    None
}

/// The prediction from the bodies after their separation, with the largest force \[N\], and the times of the turning point
/// and of the end of the force \[s\].
fn prediction<L: Loading, U: Unloading, K: Loss>(
    model: &Model<L, U, K>,
    impact: &Impact,
    bodies: &Bodies<L, U, K>,
    (max_force, turning, force_end): (f64, f64, f64),
) -> Prediction {
    // the contact of a fresh surface has forgotten the impact
    let (plastic, max_indentation) = (&model.plastic, bodies.deepest());
    let end = bodies.speed;
    Prediction {
        max_indentation,
        max_force,
        max_contact_radius: plastic.loading.contact_radius(&plastic.pair, max_indentation),
        regime: plastic.loading.regime(&plastic.pair, max_indentation),
        residual_indentation: plastic.residual_indentation(max_indentation),
        energy: impact.energy(),
        rebound_energy: 0.5 * impact.mass * end * end,
        restitution: -end / impact.speed,
        loading_time: turning,
        unloading_time: force_end - turning,
    }
}
