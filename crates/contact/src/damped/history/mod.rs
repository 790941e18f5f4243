//! The state of a contact with a rate-dependent law.

mod behaviour;
mod energy;
mod impulse;
mod motion;

pub use motion::follow;

use super::{Damped, Factors, Model};
use crate::behaviour::is_finite_at;
use crate::numbers::largest;
use crate::path::Sum;
use crate::regime::{LARGEST_INDENTATION, Regime, TooDeep};
use libm::sqrt;

/// The whole state of a rate-dependent contact, and the factors of its law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct History<D> {
    law: D,
    factors: Factors,
    indentation: Sum,
    max_indentation: f64,
    /// Closing speed at first touch \[m/s\]; infinite before the first touch, so that the ratio of a rate to it is zero.
    touch_speed: f64,
    dissipated: Sum,
}

/// Enough bisections to find a number between any two others to its last digit.
const HALVINGS: u32 = 1100;

impl<D: Damped + Copy> History<D> {
    /// A contact at `gap` \[m\] before any motion. A contact that starts indented has no touch speed yet: the first closing
    /// rate then counts as the touch speed.
    ///
    /// # Errors
    /// [`TooDeep`] beyond [`LARGEST_INDENTATION`] on either side, and for NaN.
    pub fn start(model: &Model<D>, gap: f64) -> Result<History<D>, TooDeep> {
        // not -gap: a gap of zero must give 0.0 and not -0.0
        let indentation = within(0.0 - gap)?;
        Ok(History {
            law: model.law,
            factors: model.law.factors(&model.pair, model.restitution, model.mass),
            indentation: Sum::new(indentation),
            max_indentation: if indentation > 0.0 { indentation } else { 0.0 },
            touch_speed: f64::INFINITY,
            dissipated: Sum::new(0.0),
        })
    }

    /// Moves the contact at `rate` \[m/s\] for `step` \[s\].
    ///
    /// # Errors
    /// [`TooDeep`] as for [`History::start`], and where force or heat would overflow; the history is then unchanged.
    pub fn advance(&mut self, rate: f64, step: f64) -> Result<(), TooDeep> {
        let sum = self.indentation.plus(rate * step);
        let to = within(sum.total())?;
        let from = self.indentation.total();
        let mut next = *self;
        next.touch(to, rate);
        if from <= 0.0 && to > 0.0 {
            next.max_indentation = 0.0;
        }
        next.max_indentation = if to > next.max_indentation { to } else { next.max_indentation };
        let positive = |d: f64| if d > 0.0 { d } else { 0.0 };
        next.dissipated = self.dissipated.plus(next.dissipation(positive(from), positive(to), rate));
        next.indentation = sum;
        // written positively to reject NaN
        let finite = is_finite_at(&next, rate) && next.stored() + next.dissipated.total() < f64::INFINITY;
        if !finite {
            return Err(TooDeep { indentation: to });
        }
        *self = next;
        Ok(())
    }

    /// Records the speed of a first touch during the motion to `to` \[m\].
    fn touch(&mut self, to: f64, rate: f64) {
        let touches = if self.indentation.total() > 0.0 { self.touch_speed == f64::INFINITY } else { to > 0.0 };
        if touches && rate > 0.0 {
            self.touch_speed = rate;
        }
    }

    /// The contact with a motion at `rate` \[m/s\]: one that starts indented then knows its touch speed.
    fn moving(&self, rate: f64) -> History<D> {
        let mut moving = *self;
        moving.touch(self.indentation.total(), rate);
        moving
    }

    /// `C d'`, where laws that scale by the touch speed use `d'` over that speed \[N\]; zero before the first touch.
    fn damping_force(&self, rate: f64) -> f64 {
        // the ratio comes first: a tiny touch speed must not divide the factor
        let rate = if self.law.scaled_by_touch() { rate / self.touch_speed } else { rate };
        self.factors.damping * rate
    }

    /// `K phi + C psi d'` at `indentation` > 0 \[N\]; may be negative.
    fn sum_of_forces(&self, indentation: f64, rate: f64) -> f64 {
        self.factors.elastic * self.law.elastic(indentation).value
            + self.damping_force(rate) * self.law.damping(indentation).value
    }

    /// Whether the surface pushes at `rate` \[m/s\]; it never pulls.
    fn pushes(&self, rate: f64) -> bool {
        let indentation = self.indentation.total();
        indentation > 0.0 && self.moving(rate).sum_of_forces(indentation, rate) > 0.0
    }

    /// The position between `low` and `high` \[m\] below which the force has another sign than at `high`; `low` if the sign
    /// does not change.
    fn sign_change(&self, mut low: f64, mut high: f64, rate: f64) -> f64 {
        let pushes = |d: f64| self.sum_of_forces(d, rate) > 0.0;
        let sign = pushes(high);
        // at zero indentation both forces may vanish; the sign just above counts, where none of their powers does
        let [border, _] = self.law.borders();
        let just_above = largest(f64::MIN_POSITIVE, f64::EPSILON * border);
        if pushes(if low > 0.0 { low } else { just_above }) == sign {
            return low;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if !(middle > low && middle < high) {
                break;
            }
            if pushes(middle) == sign {
                high = middle;
            } else {
                low = middle;
            }
        }
        high
    }

    /// Normal force at `rate` \[m/s\], in N; zero while apart, and where the surface would have to pull.
    pub fn force(&self, rate: f64) -> f64 {
        let indentation = self.indentation.total();
        let force = if indentation > 0.0 { self.moving(rate).sum_of_forces(indentation, rate) } else { 0.0 };
        if force > 0.0 { force } else { 0.0 }
    }

    /// dF/d(indentation) at constant `rate` \[N/m\]; zero where there is no force.
    pub fn stiffness(&self, rate: f64) -> f64 {
        if !self.pushes(rate) {
            return 0.0;
        }
        let indentation = self.indentation.total();
        self.factors.elastic * self.law.elastic(indentation).slope
            + self.moving(rate).damping_force(rate) * self.law.damping(indentation).slope
    }

    /// Indentation \[m\]; negative while apart.
    pub fn indentation(&self) -> f64 {
        self.indentation.total()
    }

    /// Largest indentation of the present or the last contact \[m\].
    pub fn max_indentation(&self) -> f64 {
        self.max_indentation
    }

    /// Elastic while in contact, otherwise apart.
    pub fn regime(&self) -> Regime {
        if self.indentation.total() > 0.0 { Regime::Elastic } else { Regime::Apart }
    }

    /// Contact radius of Hertz, `a^2 = R d` \[m\]; 0 while apart.
    pub fn contact_radius(&self, model: &Model<D>) -> f64 {
        let indentation = self.indentation.total();
        if indentation > 0.0 { sqrt(model.pair.radius * indentation) } else { 0.0 }
    }
}

fn within(indentation: f64) -> Result<f64, TooDeep> {
    let within = indentation > -LARGEST_INDENTATION && indentation < LARGEST_INDENTATION;
    if within { Ok(indentation) } else { Err(TooDeep { indentation }) }
}
