//! How long the bodies take for a stretch, and how far they come on it in a time.

use super::field::{Field, Mark, Place};
use super::turning::{End, behind, end, fastest};
use super::{MOST_EVALUATIONS, NoMotion};
use crate::contact::TooDeep;
use crate::contact::numbers::{largest, quotient, root};
use crate::contact::quadrature::{SMOOTH, Sampled, sixteen};
use libm::{fabs, sqrt};

/// A way on which the speed grows from one end to the other, on a scale `s` in which time is smooth.
///
/// From the slow end on, bodies move about as under a constant force: the root is a parabola, `t = length (2 k s + (1 - 2 k) s^2)`.
/// Where they turn, or turned just before, `k` is zero and the scale begins there.
pub struct Travel<'a, const N: usize> {
    field: Field<'a>,
    /// Where `s` is zero.
    slow: Place<N>,
    /// Of the whole scale, in roots; negative is upwards.
    length: f64,
    /// `k`.
    first: f64,
    /// Where on the scale the way begins; it ends at 1.
    from: f64,
    /// Whether the bodies go from the fast end to the slow one.
    slows: bool,
    /// Of the whole way \[s\].
    pub time: f64,
}

/// What a stretch has come to.
#[derive(Clone, Copy, Debug)]
pub struct Passage {
    /// From its start \[m\]; positive is deeper.
    pub way: f64,
    /// In its direction \[m/s\].
    pub speed: f64,
    /// \[s\]
    pub time: f64,
    /// Whether the bodies turned at its end.
    pub turned: bool,
}

/// Goes from `place` to `limit` \[m\] or to where the bodies turn, and no longer than `left` \[s\].
///
/// # Errors
/// [`NoMotion`].
pub fn pass<const N: usize>(field: Field, place: &Place<N>, limit: f64, left: f64) -> Result<Passage, NoMotion> {
    let (t, mut last, passed) = match end(&field, place, limit) {
        End::Turns(t, mark) => (t, mark, false),
        End::Passes(t, mark) => (t, mark, true),
    };
    let mut turned = !passed;
    if !last.net.is_finite() {
        return Err(TooDeep { indentation: last.net }.into());
    }
    let middle = fastest(&field, place, t, &last);
    // what rounding leaves of the speed, where the bodies turn just at the end, would be a flight that there isn't
    if middle.is_some_and(|(_, mark)| last.energy <= ROUNDING * mark.energy) {
        (last.energy, turned) = (0.0, true);
    }
    let way = if passed { limit } else { last.way };
    let (mut time, mut at, mut from) = (0.0, 0.0, *place);
    for (to, mark) in [middle, Some((t, last))].into_iter().flatten() {
        if to == at {
            continue;
        }
        let travel = Travel::new(field, &from, to - at, &mark)?;
        if travel.time > left - time {
            let mark = travel.after(left - time)?;
            return Ok(Passage { way: mark.way, speed: field.speed(mark.energy), time: left, turned: false });
        }
        time += travel.time;
        from = field.around(&from, to - at, mark);
        at = to;
    }
    Ok(Passage { way, speed: field.speed(last.energy), time, turned })
}

/// What rounding makes of an energy, as a part of the largest one, at the end of a stretch.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The narrowest panel, as a part of the scale: a speed that nearly vanishes at an end is resolved to rounding by then.
const NARROWEST: f64 = 1.0 / (1u64 << 40) as f64;

/// The least energy that is divided by.
const LEAST: f64 = 1e-300;

/// Steps in search of the end of a time: it takes some three.
const STEPS: u32 = 60;

impl<'a, const N: usize> Travel<'a, N> {
    /// The way over `t` from `place` to the mark `to`. Between them the bodies don't turn, nor get faster and slower again if both
    /// are slow.
    ///
    /// # Errors
    /// [`NoMotion::TooLong`].
    pub fn new(field: Field<'a>, place: &Place<N>, t: f64, to: &Mark) -> Result<Travel<'a, N>, NoMotion> {
        let slows = to.energy < place.mark.energy;
        let (slow, far, fast) = if slows { (field.around(place, t, *to), -t, place.mark) } else { (*place, t, *to) };
        let mut travel = Travel { field, slow, length: far, first: 0.0, from: 0.0, slows, time: 0.0 };
        match behind(&field, &slow, far, fast.energy) {
            Some((back, turned)) => {
                (travel.slow, travel.length) = (turned, far - back);
                // both are negative upwards
                travel.from = sqrt(-back / travel.length);
            }
            None => {
                let gain = field.slope(&slow, 0.0, slow.mark.net) * far;
                let (speed, end) =
                    (sqrt(slow.mark.energy), sqrt(slow.mark.energy + if gain > 0.0 { gain } else { 0.0 }));
                travel.first = speed / (speed + end);
            }
        }
        travel.time = travel.between(travel.from, 1.0)?;
        Ok(travel)
    }

    /// The roots from the slow end at `s`, and their derivative by it.
    fn at(&self, s: f64) -> (f64, f64) {
        let rest = 1.0 - 2.0 * self.first;
        (self.length * s * (2.0 * self.first + rest * s), 2.0 * self.length * (self.first + rest * s))
    }

    /// dt/ds \[s\].
    fn rate(&self, s: f64) -> f64 {
        let (t, slope) = self.at(s);
        let energy = self.field.energy(&self.slow, t);
        let rate = self.field.pace(&self.slow, t, slope) / sqrt(largest(energy, LEAST));
        if energy > 0.0 { rate } else { 0.0 }
    }

    /// The time from one point of the scale to another \[s\]: on panels as wide as the rate is smooth.
    fn between(&self, from: f64, to: f64) -> Result<f64, NoMotion> {
        let (mut at, mut width, mut time) = (from, to - from, 0.0);
        while at < to {
            let end = if width < to - at { at + width } else { to };
            let Sampled { integral, tail } = sixteen(at, end, |s| self.rate(s));
            self.field.count(16);
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

    /// Where the bodies are after `time` \[s\], which is less than that of the whole way.
    ///
    /// # Errors
    /// [`NoMotion::TooLong`].
    pub fn after(&self, time: f64) -> Result<Mark, NoMotion> {
        // from the slow end on
        let goal = if self.slows { self.time - time } else { time };
        let outwards = if self.length > 0.0 { 1.0 } else { -1.0 };
        let (mut low, mut high) = (self.from, 1.0);
        let mut s = low + (high - low) * (goal / self.time);
        let mut mark = self.slow.mark;
        for _ in 0..STEPS {
            let (t, _) = self.at(s);
            mark = self.field.mark(&self.slow, t);
            let late = goal - self.between(self.from, s)?;
            *(if late < 0.0 { &mut high } else { &mut low }) = s;
            let place = self.field.around(&self.slow, t, mark);
            let (step, missed) = self.field.onwards(&place, outwards, late);
            let next = self.scale(t + self.field.roots(&place, step));
            let inside = next > low && next < high;
            let small = missed <= f64::EPSILON * fabs(mark.way - self.slow.mark.way);
            if small && (inside || step == 0.0) {
                return Ok(self.field.mark(&place, self.field.roots(&place, step)));
            }
            let next = if inside { next } else { 0.5 * (low + high) };
            if next == s {
                break;
            }
            s = next;
        }
        Ok(mark)
    }

    /// Where on the scale `t` is.
    fn scale(&self, t: f64) -> f64 {
        let (first, part) = (self.first, t / self.length);
        let root = root(first * first + (1.0 - 2.0 * first) * part);
        quotient(part, first + root, part > 0.0, 0.0)
    }
}
