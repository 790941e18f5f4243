//! Work and heat of a motion at constant rate.

use super::{Damping, Form, Growth};
use crate::history::piece::Piece;
use crate::loading::Loading;
use crate::numerics::quadrature::{gauss, graded_integral};
use crate::numerics::{largest, quotient};
use crate::regime::TooDeep;
use crate::segment::Segment;
use crate::unloading::Unloading;
use crate::{History, Model, Surface};
use libm::{fabs, sqrt};

/// The work of a motion \[J\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spent {
    /// Work of the elastoplastic law.
    pub work: f64,
    /// Work of the damping; where the surface would have to pull, the energy that is released without force.
    pub heat: f64,
}

/// More pieces than any law has in one direction.
const MOST_PIECES: u32 = 100;

/// Enough bisections for every digit.
const HALVINGS: u32 = 1100;

/// A part of a motion, on one smooth piece of a law.
struct Part<'a> {
    force: &'a dyn Fn(f64) -> f64,
    stiffness: &'a dyn Fn(f64) -> f64,
    /// The segment of the whole part, if it is one.
    segment: Option<&'a Segment>,
}

impl Part<'_> {
    /// Work from one indentation to another \[J\].
    fn work(&self, from: f64, to: f64) -> f64 {
        match self.segment {
            Some(segment) => segment.mean_force(from, to) * (to - from),
            None => graded_integral(from, to, &self.force),
        }
    }

    /// Integral of the damping coefficient from one indentation to another \[N.s\].
    fn damped(&self, damping: &Damping, growth: Growth, from: f64, to: f64) -> f64 {
        let factor = damping.factor;
        let coefficient = |d: f64| growth.times(factor, d, || (self.stiffness)(d));
        let Some(segment) = self.segment else { return graded_integral(from, to, &coefficient) };
        let above = |d: f64| if d > segment.origin { d - segment.origin } else { 0.0 };
        let (p, q) = (sqrt(above(from)), sqrt(above(to)));
        // polynomials, for which Gauss's rule is a closed form
        match growth {
            Growth::Constant => factor * (to - from),
            Growth::Step { .. } => gauss(from, to, &coefficient),
            Growth::Root if segment.linear == 0.0 && segment.square == 0.0 => {
                let (p, q) = (sqrt(p), sqrt(q));
                let mean = gauss(0.0, 1.0, &|t: f64| {
                    let root = p + (q - p) * t;
                    4.0 * root * root * root * root
                });
                let change = quotient(to - from, (p + q) * (p * p + q * q), p + q > 0.0, 0.0);
                factor * sqrt(1.5 * segment.power) * mean * change
            }
            Growth::Root => graded_integral(from, to, &coefficient),
            _ if p + q == 0.0 => growth.times(factor, from, || segment.linear) * (to - from),
            _ => {
                // in the root of the height, of fifth degree at most
                let mean = gauss(0.0, 1.0, &|t: f64| {
                    let root = p + (q - p) * t;
                    let stiffness = segment.linear + root * (1.5 * segment.power + 2.0 * segment.square * root);
                    2.0 * root * growth.times(1.0, 0.0, || stiffness)
                });
                factor * (mean * quotient(to - from, p + q, p + q > 0.0, 0.0))
            }
        }
    }

    /// The indentation between `low` and `high` \[m\] at which the surface ceases to push at `rate` < 0 \[m/s\], or grips again; `low` if
    /// it does neither.
    fn parting(&self, damping: &Damping, (mut low, mut high): (f64, f64), rate: f64) -> f64 {
        let pushes = |d: f64| self.pushes(damping, d, rate);
        let sign = pushes(high);
        // at the surface all powers vanish
        let above = largest(low.next_up(), f64::EPSILON * high);
        if pushes(if above < high { above } else { high }) == sign {
            return low;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if !(middle > low && middle < high) {
                break;
            }
            *(if pushes(middle) == sign { &mut high } else { &mut low }) = middle;
        }
        high
    }

    fn pushes(&self, damping: &Damping, d: f64, rate: f64) -> bool {
        damping.force(d, (self.force)(d), (self.stiffness)(d), rate) > 0.0
    }

    /// Heat of a viscous damping that follows this `growth`, on a way back at `rate` < 0 \[m/s\].
    fn spent_on_the_way_back(&self, damping: &Damping, growth: Growth, (from, to): (f64, f64), rate: f64) -> f64 {
        let (mut heat, mut high) = (0.0, from);
        for border in growth.borders().into_iter().chain([to]) {
            let low = if border > to { border } else { to };
            if low >= high {
                continue;
            }
            // in between the force changes its sign at most once
            let change = self.parting(damping, (low, high), rate);
            for (high, low) in [(high, change), (change, low)] {
                if low < high {
                    heat += match self.pushes(damping, 0.5 * (high + low), rate) {
                        true => rate * self.damped(damping, growth, high, low),
                        false => self.work(low, high),
                    };
                }
            }
            high = low;
        }
        heat
    }

    /// Work and heat at `rate` \[m/s\], whose `damping` knows the largest speed.
    fn spent(&self, damping: &Damping, from: f64, to: f64, rate: f64) -> Spent {
        let work = self.work(from, to);
        let heat = match damping.form {
            Form::Mobility => 0.0,
            Form::Proportional => (damping.gain(rate) - 1.0) * work,
            Form::Viscous(growth) if rate < 0.0 => self.spent_on_the_way_back(damping, growth, (from, to), rate),
            Form::Viscous(growth) => {
                let [depth, _] = growth.borders();
                // the coefficient of a step is no polynomial across its depth
                let border = if from < depth && depth < to { depth } else { to };
                rate * (self.damped(damping, growth, from, border) + self.damped(damping, growth, border, to))
            }
        };
        Spent { work, heat }
    }
}

/// Work and heat on the `segment` of a contact that stays on it, from one indentation to another \[m\].
pub(super) fn on_segment(segment: &Segment, damping: &Damping, (from, to): (f64, f64), rate: f64) -> Spent {
    let (force, stiffness) = (|d: f64| segment.force(d), |d: f64| segment.stiffness(d));
    Part { force: &force, stiffness: &stiffness, segment: Some(segment) }.spent(damping, from, to, rate)
}

/// Work and heat of the motion of `history` at constant `rate` \[m/s\] to the indentation `to` \[m\].
///
/// # Errors
/// [`TooDeep`] outside the range of the law.
pub(super) fn on_the_way<L: Loading, U: Unloading>(
    history: &History,
    model: &Model<L, U>,
    damping: &Damping,
    to: f64,
    rate: f64,
) -> Result<Spent, TooDeep> {
    let (mut contact, mut sum) = (*history, Spent::default());
    for _ in 0..MOST_PIECES {
        let from = contact.indentation();
        if from == to {
            return Ok(sum);
        }
        let rising = to > from;
        let goal = match Piece::ahead(&contact, model, rising) {
            Ok(piece) => {
                let piece = piece.part(from, rising);
                let goal = if rising { limited(to, piece.upper, true) } else { limited(to, piece.lower, false) };
                let (force, stiffness) = (|d: f64| piece.force(d), |d: f64| piece.stiffness(d));
                let part = Part { force: &force, stiffness: &stiffness, segment: piece.whole() };
                let Spent { work, heat } = part.spent(damping, from, goal, rate);
                (sum.work, sum.heat) = (sum.work + work, sum.heat + heat);
                goal
            }
            Err(surface) if rising => limited(to, surface, true),
            // a fresh surface forgets the dent at zero
            Err(_) if model.surface == Surface::Fresh && from > 0.0 && to < 0.0 => 0.0,
            Err(_) => to,
        };
        contact.go_to(model, goal, rising)?;
    }
    Err(TooDeep { indentation: fabs(to) })
}

/// `goal`, or the `border` if that comes first.
fn limited(goal: f64, border: f64, rising: bool) -> f64 {
    if (goal > border) == rising { border } else { goal }
}
