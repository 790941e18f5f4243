//! Prediction of an impact on a contact with losses.

use super::bodies::alone;
use super::history::History;
use super::{Form, Loss, Model};
use crate::impact::{Impact, Prediction};
use crate::loading::Loading;
use crate::numerics::largest;
use crate::unloading::Unloading;
use libm::{fabs, pow, sqrt};

/// An instant of the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<K> {
    /// Time since first contact \[s\].
    pub time: f64,
    /// Indentation \[m\].
    pub indentation: f64,
    /// Closing speed \[m/s\].
    pub speed: f64,
    /// The contact.
    pub contact: History<K>,
}

/// Parts in which the bodies would cover the depth of an elastic impact with their first speed.
const PARTS: f64 = 64.0;

/// The number of such parts after which they grow, by this factor. Most impacts last some hundred.
const MANY: (u32, f64) = (2000, 1.05);

/// More parts than an impact has.
const MOST_PARTS: u32 = 3000;

/// The part of the first speed and of the largest force of which nothing is left.
const FADED: f64 = 1e-12;

/// Halvings that find an instant in a part to its last digit.
const HALVINGS: u32 = 60;

/// Thirds that find the largest force in two parts.
const THIRDS: u32 = 40;

/// The impact `impact` on an untouched contact: the motion `m d'' = -F` is followed until the bodies separate. The results are
/// accurate to about 1e-11.
///
/// `None` if the mass or the speed is not positive and finite, if the energy is below the smallest normal number, if the
/// motion leaves the range of the law, or if it never ends: a plate may take the body along.
pub fn predict<L: Loading, U: Unloading, K: Loss>(model: &Model<L, U, K>, impact: &Impact) -> Option<Prediction> {
    follow(model, impact, |_, _| {})
}

/// [`predict`] that also passes instants of the motion, from first contact to the end, to `watch`, together with the force \[N\].
pub fn follow<L: Loading, U: Unloading, K: Loss>(
    model: &Model<L, U, K>,
    impact: &Impact,
    mut watch: impl FnMut(&State<K>, f64),
) -> Option<Prediction> {
    let Impact { mass, speed } = *impact;
    let positive = |value: f64| value > 0.0 && value < f64::INFINITY;
    let energy = impact.energy();
    if !positive(mass) || !positive(speed) || !positive(energy) || energy < f64::MIN_POSITIVE {
        return None;
    }
    let mut contact = History::start(model, 0.0).ok()?;
    contact.swiftest = speed;
    let mut bodies = DampedImpact { contact, model, inverse_mass: 1.0 / mass, speed, time: 0.0, deepest: 0.0 };
    let depth = depth_of(model, energy);
    let mut part = depth / speed / PARTS;
    let (many, growth) = MANY;
    let (mut strongest, mut turning, mut force_end) = ((bodies.force(), bodies, part), 0.0, None);
    watch(&bodies.state(), bodies.force());
    for number in 0..MOST_PARTS {
        let before = bodies;
        bodies = before.after(part)?;
        if bodies.deepest > before.deepest && bodies.rate() <= 0.0 {
            let turn = before.after(before.part_until(part, |bodies| bodies.rate() <= 0.0)?)?;
            turning = turn.time;
            watch(&turn.state(), turn.force());
        }
        let force = bodies.force();
        // on a target that gives way easily, force and speed may fade out
        let faded = FADED * strongest.0;
        let least = if model.loss.form() == Form::Mobility { faded } else { 0.0 };
        if force > least {
            force_end = None;
        } else if force_end.is_none() {
            let end = before.after(before.part_until(part, |bodies| bodies.force() <= least)?)?;
            watch(&end.state(), end.force());
            force_end = Some(end.time);
        }
        if force > strongest.0 {
            strongest = (force, before, part * (1.0 + growth));
        }
        let is_over = force <= faded && fabs(bodies.speed) <= FADED * speed;
        if is_over && bodies.speed > 0.0 {
            // the target has taken it all
            return None;
        }
        if is_over || bodies.contact.is_apart() && bodies.speed < 0.0 {
            let end = if is_over { part } else { before.part_until(part, |bodies| bodies.contact.is_apart())? };
            let end = before.after(end)?;
            watch(&end.state(), 0.0);
            let (_, from, length) = strongest;
            let max_force = from.largest_force(length)?;
            // a second force may be shorter than a part
            let grips = matches!(model.loss.form(), Form::Viscous(growth) if growth.grips_again());
            let force_end = force_end.filter(|_| !grips).unwrap_or(end.time);
            return Some(end.prediction(impact, max_force, turning, force_end));
        }
        watch(&bodies.state(), force);
        part *= if number > many { growth } else { 1.0 };
    }
    None
}

/// The depth \[m\] at which the elastic part would have taken up this `energy` \[J\].
fn depth_of<L: Loading, U, K>(model: &Model<L, U, K>, energy: f64) -> f64 {
    let Model { plastic: crate::Model { loading, pair, .. }, .. } = model;
    let (scale, exponent) = (loading.scale(pair), 1.0 + loading.elastic_exponent());
    if scale.power > 0.0 {
        pow(exponent * energy / scale.power, 1.0 / exponent)
    } else {
        sqrt(2.0 * energy / scale.linear)
    }
}

/// The bodies at an instant of their impact.
struct DampedImpact<'a, L, U, K> {
    contact: History<K>,
    model: &'a Model<L, U, K>,
    inverse_mass: f64,
    /// Closing speed \[m/s\].
    speed: f64,
    /// Time since first contact \[s\].
    time: f64,
    /// The largest indentation so far \[m\], which a fresh surface forgets.
    deepest: f64,
}

impl<L, U, K: Copy> Clone for DampedImpact<'_, L, U, K> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<L, U, K: Copy> Copy for DampedImpact<'_, L, U, K> {}

impl<L: Loading, U: Unloading, K: Loss> DampedImpact<'_, L, U, K> {
    /// The bodies `time` \[s\] later; `None` beyond the range of the law.
    fn after(&self, time: f64) -> Option<Self> {
        let mut next = *self;
        if time > 0.0 {
            let (speed, _, work) =
                alone(&mut next.contact, self.model, (self.inverse_mass, 0.0, self.speed), time).ok()?;
            (next.speed, next.time, next.deepest) = (speed, self.time + time, largest(self.deepest, work.deepest()));
        }
        Some(next)
    }

    fn state(&self) -> State<K> {
        let DampedImpact { time, speed, contact, .. } = *self;
        State { time, indentation: contact.plastic.indentation(), speed, contact }
    }

    fn force(&self) -> f64 {
        self.contact.force(self.speed)
    }

    /// Rate of indentation \[m/s\].
    fn rate(&self) -> f64 {
        self.speed - self.contact.damping_for(0.0).retreat(self.force())
    }

    /// The time within `part` \[s\] at which something `happens`; the whole part if it doesn't.
    fn part_until(&self, part: f64, happens: impl Fn(&Self) -> bool) -> Option<f64> {
        let (mut low, mut high) = (0.0, part);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if happens(&self.after(middle)?) { &mut high } else { &mut low }) = middle;
        }
        Some(high)
    }

    /// The largest force in the next `time` \[s\], by section search.
    fn largest_force(&self, time: f64) -> Option<f64> {
        let (mut low, mut high) = (0.0, time);
        let force = |time: f64| Some(self.after(time)?.force());
        let mut most = largest(force(low)?, force(high)?);
        for _ in 0..THIRDS {
            let third = (high - low) / 3.0;
            let [one, other] = [force(low + third)?, force(high - third)?];
            most = largest(most, largest(one, other));
            if one < other {
                low += third;
            } else {
                high -= third;
            }
        }
        Some(most)
    }

    /// The prediction from the bodies at their separation, with the largest force \[N\], and the times of the turning point and of
    /// the end of the force \[s\]. A surface that lags behind the bodies has none.
    fn prediction(&self, impact: &Impact, max_force: f64, turning: f64, force_end: f64) -> Prediction {
        let (plastic, max_indentation) = (&self.model.plastic, self.deepest);
        Prediction {
            max_indentation,
            max_force,
            max_contact_radius: plastic.loading.contact_radius(&plastic.pair, max_indentation),
            regime: plastic.loading.regime(&plastic.pair, max_indentation),
            residual_indentation: plastic.residual_indentation(max_indentation),
            energy: impact.energy(),
            rebound_energy: 0.5 * impact.mass * self.speed * self.speed,
            restitution: -self.speed / impact.speed,
            loading_time: turning,
            unloading_time: force_end - turning,
        }
    }
}
