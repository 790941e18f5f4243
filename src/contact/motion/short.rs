//! A short motion on one segment: whether it ends with the step, with the segment, or where the bodies turn.

use super::SMALLEST;
use super::curve::Curve;
use super::field::Start;
use super::line::{LONGEST, Line, POWERS};
use super::stretch::{Ended, Stretch};
use crate::contact::numbers::{quotient, root, smallest};
use crate::contact::segment::Segment;
use libm::{fabs, sqrt};

/// The square of the phase \[rad\], and the way as a part of the height above the origin of a power, up to which the powers of the
/// time fall fast.
const LONGEST_CURVED: f64 = 0.5;
const FARTHEST: f64 = 0.25;

/// The square of somewhat more than a right angle \[rad\].
const QUARTER: f64 = 2.6;

/// A way, as a part of the indentation, that isn't made in two: what the first leaves of it when it is added would be missing.
const SHORT: f64 = 1e-6;

/// How much longer than an event may take it is looked for.
const BEYOND: f64 = 1.1;

/// Steps in search of an event: it takes some three.
const STEPS: u32 = 8;

/// A step of which the fourth power is nothing.
const CONVERGED: f64 = 4e-6;

/// The least speed at the end of a segment, as a part of the largest one, that isn't left to others to tell from none.
const SLOWEST: f64 = 1e-6;

/// The shortest time \[s\] that is looked at: a way over a shorter one may be no speed.
const SHORTEST: f64 = 1e-100;

/// A moment of a motion whose time ends at one.
#[derive(Clone, Copy)]
pub struct Point {
    pub time: f64,
    /// Since the start, like the gain.
    pub way: f64,
    /// Of speed.
    pub gain: f64,
    /// The acceleration, and what a longer way takes from it.
    pub net: f64,
    pub stiffness: f64,
}

/// A motion that is known at any time up to one.
pub trait Moments {
    /// The moment at `time`.
    fn at(&self, time: f64) -> Point;
}

/// What is looked for: the end of the segment, so far away, or none of the speed.
#[derive(Clone, Copy)]
enum Event {
    Border(f64),
    Turn,
}

/// How much of the time to look at for an event at the distance `bound`, or where the bodies turn, by the two powers `first` and
/// `second` of the way, which is the unit of all: all of it, or not much more than that takes.
fn horizon(first: f64, second: f64, bound: f64) -> f64 {
    let sum = first + root(first * first + 4.0 * second * bound);
    let border = quotient(2.0 * bound, sum, bound < 1.0 && sum > bound, 1.0);
    let turn = quotient(first, -2.0 * second, -2.0 * second > first, 1.0);
    smallest(1.0, BEYOND * smallest(border, turn))
}

/// The stretch on a `segment` from `start` in the direction `sign`, where the segment ends at the distance `bound` \[m\]; and how
/// many powers it took. Bodies that don't turn, nor come to that end, may be looked at for a part of the time only if it `may_stop`.
/// `None` if the powers don't say it to rounding.
pub fn stretch(segment: &Segment, start: &Start, sign: f64, bound: f64, may_stop: bool) -> Option<(Stretch, u32)> {
    let Start { indentation, speed, net, inverse_mass, time: left, .. } = *start;
    let straight = segment.power == 0.0 && segment.square == 0.0;
    let (first, second) = (speed * left, 0.5 * net * left * left);
    let reach = fabs(first) + fabs(second);
    let moves = reach > SMALLEST && left > SHORTEST;
    if !moves {
        return None;
    }
    let per_mass = inverse_mass * left * left;
    let phase = segment.linear * per_mass;
    let part = if may_stop {
        // bodies that a straight line slows down turn within a quarter of a period
        let slows = straight && sign * second <= 0.0 && phase > QUARTER;
        let slow = sqrt(quotient(QUARTER, phase, slows, 1.0));
        let [first, second, bound] = [sign * first, sign * second, smallest(bound, 2.0 * reach)].map(|way| way / reach);
        smallest(slow, horizon(first, second, bound))
    } else {
        1.0
    };
    let time = part * left;
    let (first, second, square) = (part * first, part * part * second, part * part);
    // a straight line begins anywhere
    let height = if straight { 1.0 } else { indentation - segment.origin };
    let (point, ended, powers) = if straight {
        let line = Line { first, second, phase: square * phase };
        let known = fabs(line.phase) <= LONGEST;
        if !known {
            return None;
        }
        let (point, ended) = first_event(&line, first, sign, bound)?;
        (point, ended, POWERS)
    } else {
        let force = [phase, segment.power * root(height) * per_mass, segment.square * height * per_mass];
        let force = force.map(|force| force * square);
        let phase = force.iter().fold(0.0, |sum, force| sum + fabs(*force));
        let short = phase < LONGEST_CURVED && fabs(first) + fabs(second) < FARTHEST * height && height > SMALLEST;
        if !short {
            return None;
        }
        let inverse = 1.0 / height;
        let curve = Curve::new(first * inverse, second * inverse, force)?;
        let distance = smallest(bound, 2.0 * reach) * inverse;
        let (point, ended) = first_event(&curve, first * inverse, sign, distance)?;
        (point, ended, curve.count)
    };
    let (passed, ended) = match ended {
        Ended::WithStep if part < 1.0 => {
            let goes_on = fabs(height * point.way) > SHORT * indentation;
            (goes_on.then_some(time)?, Ended::Within)
        }
        Ended::WithStep => (left, ended),
        _ => (time * point.time, ended),
    };
    let speed = if ended == Ended::Turned { 0.0 } else { speed + point.gain * height / time };
    Some((Stretch { way: height * point.way, speed, time: passed, ended }, powers as u32))
}

/// The event of a `motion` with that speed at its start, from `time` on, which is near it.
fn find(motion: &impl Moments, speed: f64, event: Event, mut time: f64) -> Option<Point> {
    for _ in 0..STEPS {
        let point = motion.at(time);
        let speed = speed + point.gain;
        let bend = -point.stiffness * speed;
        let (miss, slope, more) = match event {
            Event::Border(way) => (way - point.way, speed, point.net),
            Event::Turn => (-speed, point.net, bend),
        };
        let leads = fabs(miss) < fabs(slope);
        let step = quotient(miss, slope, leads, 1.0);
        let step = step * (1.0 - 0.5 * step * quotient(more, slope, leads, 0.0));
        time += step;
        let inside = leads && time > 0.0 && time <= 1.0;
        if !inside {
            return None;
        }
        if fabs(step) < CONVERGED {
            let way = point.way + step * (speed + 0.5 * step * (point.net + step * bend / 3.0));
            let gain = point.gain + step * (point.net + 0.5 * step * bend);
            return Some(Point { time, way, gain, ..point });
        }
    }
    None
}

/// The first event of a `motion` with that `speed` at its start, in the direction `sign` up to a border at that distance. `None` if
/// it isn't certain which one it is.
fn first_event(motion: &impl Moments, speed: f64, sign: f64, distance: f64) -> Option<(Point, Ended)> {
    let end = motion.at(1.0);
    let (passes, turns) = (sign * end.way >= distance, sign * (speed + end.gain) <= 0.0);
    let (point, ended) = if passes {
        let near = quotient(distance, fabs(end.way), distance > 0.0, 0.0);
        (find(motion, speed, Event::Border(sign * distance), near)?, Ended::AtBorder)
    } else if turns {
        let near = quotient(speed, -end.gain, end.gain != 0.0, 0.0);
        (find(motion, speed, Event::Turn, near)?, Ended::Turned)
    } else {
        (end, Ended::WithStep)
    };
    let is_first = match ended {
        Ended::AtBorder => sign * (speed + point.gain) > SLOWEST * (fabs(speed) + fabs(point.gain)),
        _ => sign * point.way < distance,
    };
    // where the force only grows on the way, bodies that have not turned at its end have not turned before
    (is_first && point.stiffness >= 0.0).then_some((point, ended))
}
