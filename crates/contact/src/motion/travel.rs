//! The time in which the bodies cover a distance, and the distance that they cover in a time.

use super::field::{Field, Mark, Place};
use super::turning::behind;
use super::{MOST_EVALUATIONS, NoMotion};
use crate::numerics::quadrature::{POINTS, SMOOTH, Sampled, sixteen};
use crate::numerics::{largest, quotient, root, smallest};
use libm::{fabs, sqrt};

/// A motion between two places, at one of which it is slow, on a scale `s` on which time is smooth.
///
/// From the slow end on, the bodies move roughly as under a constant force: the root is a parabola,
/// `t = length (2 k s + (1 - 2 k) s^2)`. If the bodies turn at the slow end, or turned just before it, `k` is zero and the
/// scale begins at the turning point.
pub struct Travel<'a, const N: usize> {
    field: Field<'a>,
    start: Place<N>,
    /// Where `s` is zero.
    slow: Place<N>,
    /// Length of the whole scale, in roots; negative is upwards.
    length: f64,
    /// `k`.
    first: f64,
    /// Position of the slow end on the scale; the fast end is at 1.
    from: f64,
    /// Whether the bodies move from the fast end to the slow one.
    slows: bool,
    /// Width of the first panel from the slow end on; it is infinite where one panel may cover the scale.
    grade: f64,
}

/// The narrowest panel, as a fraction of the scale: it resolves a speed that nearly vanishes at an end to rounding.
const NARROWEST: f64 = 1.0 / (1u64 << 40) as f64;

/// If the time changes its course closer to the slow end than this, on the scale, a panel over the whole scale may miss it.
const CLOSE: f64 = 0.1;

/// It is so close that its part of the time is below rounding.
const NEGLIGIBLE: f64 = 1e-17;

/// The least energy used as a divisor.
const LEAST: f64 = 1e-300;

/// Largest number of iterations in search of the end of a time; about two are usual.
const STEPS: u32 = 60;

impl<'a, const N: usize> Travel<'a, N> {
    /// The motion over `t` from `start` to the mark `to`. The bodies must not turn in between. If both ends are slow, they must
    /// not be faster in between.
    pub fn new(field: Field<'a>, start: Place<N>, t: f64, to: Mark) -> Travel<'a, N> {
        let slows = to.energy < start.mark.energy;
        let (slow, far, fast) = if slows { (field.around(&start, t, to), -t, start.mark) } else { (start, t, to) };
        if let Some((back, turned)) = behind(&field, &slow, far, fast.energy) {
            let length = far - back;
            // both are negative in the upward direction
            let from = sqrt(-back / length);
            let travel = Travel { field, start, slow: turned, length, first: 0.0, from, slows, grade: f64::INFINITY };
            return travel.graded(2.0 * turned.series.root);
        }
        let gain = field.slope(&slow, 0.0, slow.mark.net) * far;
        let (speed, end) = (sqrt(slow.mark.energy), sqrt(slow.mark.energy + largest(gain, 0.0)));
        let first = speed / (speed + end);
        let travel = Travel { field, start, slow, length: far, first, from: 0.0, slows, grade: f64::INFINITY };
        travel.graded(field.turn(&slow, far))
    }

    /// The same motion with panels that resolve a distance `near` from the slow end, in roots. This close to it is another root
    /// of the energy, where a power of the force begins.
    fn graded(self, near: f64) -> Travel<'a, N> {
        let near = smallest(near, fabs(self.length));
        let grade = self.scale(if self.length < 0.0 { -near } else { near });
        let matters = grade > NEGLIGIBLE && grade < CLOSE;
        Travel { grade: if matters { grade } else { f64::INFINITY }, ..self }
    }

    /// The root, measured from the slow end, at `s`, and its derivative with respect to `s`.
    fn at(&self, s: f64) -> (f64, f64) {
        let rest = 1.0 - 2.0 * self.first;
        (self.length * s * (2.0 * self.first + rest * s), 2.0 * self.length * (self.first + rest * s))
    }

    /// The position on the scale of `t` from the slow end.
    fn scale(&self, t: f64) -> f64 {
        let (first, part) = (self.first, t / self.length);
        let root = root(first * first + (1.0 - 2.0 * first) * part);
        quotient(part, first + root, part > 0.0, 0.0)
    }

    /// dt/ds \[s\].
    fn rate(&self, s: f64) -> f64 {
        let (t, slope) = self.at(s);
        let energy = self.field.energy(&self.slow, t);
        let rate = self.field.pace(&self.slow, t, slope) / sqrt(largest(energy, LEAST));
        if energy > 0.0 { rate } else { 0.0 }
    }

    /// The time between two points of the scale \[s\]. The width of the panels adapts to the smoothness of the rate.
    fn between(&self, from: f64, to: f64) -> Result<f64, NoMotion> {
        let (mut at, mut width, mut time) = (from, smallest(to - from, largest(from, self.grade)), 0.0);
        while at < to {
            let end = if width < to - at { at + width } else { to };
            let Sampled { integral, tail } = sixteen(at, end, |s| self.rate(s));
            self.field.count(POINTS as u32);
            if tail * (end - at) <= SMOOTH * integral || width <= NARROWEST {
                time += integral;
                at = end;
                width *= 2.0;
            } else {
                width *= 0.5;
            }
            if self.field.evaluations() > MOST_EVALUATIONS {
                return Err(NoMotion::TooLong);
            }
        }
        Ok(time)
    }

    /// The time of the whole motion \[s\].
    ///
    /// # Errors
    /// [`NoMotion::TooLong`].
    pub fn time(&self) -> Result<f64, NoMotion> {
        self.between(self.from, 1.0)
    }

    /// The position of the bodies after `time` \[s\] of a motion that takes `whole` \[s\] in total, or about that if it is not
    /// known.
    ///
    /// # Errors
    /// [`NoMotion::TooLong`].
    pub fn after(&self, time: f64, whole: f64) -> Result<Mark, NoMotion> {
        let (mut low, mut high) = (self.from, 1.0);
        let direction = if (self.length > 0.0) == self.slows { -1.0 } else { 1.0 };
        let mut s = self.guess(time, whole, direction);
        let mut mark = self.slow.mark;
        for _ in 0..STEPS {
            let (t, _) = self.at(s);
            mark = self.field.mark(&self.slow, t);
            let past = if self.slows { self.between(s, 1.0)? } else { self.between(self.from, s)? };
            let late = time - past;
            *(if (late < 0.0) == self.slows { &mut low } else { &mut high }) = s;
            // from there on, powers of the time are used as far as they are exact
            let (step, missed) = self.field.moment(&self.slow, t, &mark, direction).after(late);
            let way = mark.way + step;
            let end = self.field.roots(&self.slow, way - self.slow.mark.way);
            let next = self.scale(end);
            let inside = next > low && next < high;
            if missed <= f64::EPSILON * fabs(way - self.start.mark.way) && (inside || step == 0.0) {
                return Ok(Mark { way, ..self.field.mark(&self.slow, end) });
            }
            let next = if inside { next } else { 0.5 * (low + high) };
            if next == s {
                break;
            }
            s = next;
        }
        Ok(mark)
    }

    /// An estimate of the position on the scale after `time` \[s\].
    fn guess(&self, time: f64, whole: f64, direction: f64) -> f64 {
        let part = (1.0 - self.from) * quotient(time, whole, whole > 0.0, 0.5);
        let even = if self.slows { 1.0 - part } else { self.from + part };
        let (way, missed) = self.field.moment(&self.start, 0.0, &self.start.mark, direction).after(time);
        let way_from_slow = way + (self.start.mark.way - self.slow.mark.way);
        let next = self.scale(self.field.roots(&self.slow, way_from_slow));
        let known = missed < 0.01 * fabs(way) && next > self.from && next < 1.0;
        if known { next } else { even }
    }
}
