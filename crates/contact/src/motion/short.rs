//! A short motion on one segment, which ends with the step, with the segment, or where the bodies turn.

use super::SMALLEST;
use super::curve::Curve;
use super::field::{Ended, Start, Stretch};
use super::line::{LONGEST, Line, POWERS};
use super::moments::{Moments, Point};
use crate::numerics::{quotient, root, smallest};
use crate::segment::Segment;
use libm::{fabs, sqrt};

/// Limits up to which the powers of the time fall fast: the square of the phase \[rad^2\], and the distance as a fraction of
/// the height above the origin of a power.
const LONGEST_CURVED: f64 = 0.5;
const FARTHEST: f64 = 0.25;

/// The square of slightly more than a right angle \[rad^2\].
const QUARTER: f64 = 2.6;

/// Distances below this fraction of the indentation are not split in two: rounding of the first part would be lost.
const SHORT: f64 = 1e-6;

/// Time to examine for an event, relative to the estimated time of the event.
const BEYOND: f64 = 1.1;

/// Largest number of iterations in search of an event; about three are usual.
const STEPS: u32 = 8;

/// A correction whose fourth power is negligible.
const CONVERGED: f64 = 4e-6;

/// The least speed at the end of a segment, relative to the largest speed. Slower motions are left to the general method, which
/// can tell a slow speed from zero.
const SLOWEST: f64 = 1e-6;

/// The shortest time \[s\] for this method: a distance over a shorter time may not be a finite speed.
const SHORTEST: f64 = 1e-100;

/// The event to find: the end of the segment at this distance, or zero speed.
#[derive(Clone, Copy)]
enum Event {
    Border(f64),
    Turn,
}

/// The fraction of the time to examine for an event: the distance `bound`, or a turning point. It is estimated from the two
/// powers `first` and `second` of the distance, and is either all of the time or slightly more than the event takes.
fn horizon(first: f64, second: f64, bound: f64) -> f64 {
    let sum = first + root(first * first + 4.0 * second * bound);
    let border = quotient(2.0 * bound, sum, bound < 1.0 && sum > bound, 1.0);
    let turn = quotient(first, -2.0 * second, -2.0 * second > first, 1.0);
    smallest(1.0, BEYOND * smallest(border, turn))
}

/// The stretch on a `segment` from `start` in the direction `sign`, where the segment ends at the distance `bound` \[m\], and
/// the number of powers used. If the bodies neither turn nor reach that end, the stretch may cover only a part of the time, but
/// only if it `may_stop`. `None` if the powers are not exact to rounding.
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
    // a straight line may begin anywhere
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
    let gained = point.gain * height / time;
    let (gain, speed) = if ended == Ended::Turned { (-speed, 0.0) } else { (gained, speed + gained) };
    Some((Stretch { way: height * point.way, speed, gain, time: passed, ended }, powers as u32))
}

/// The `event` of a `motion` with this initial speed. `time` is an estimate of its time.
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

/// The first event of a `motion` with the initial `speed`, in the direction `sign`, up to a boundary at that distance. `None`
/// if the order of events is uncertain.
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
    // if the stiffness is not negative and the bodies have not turned at the end, they have not turned before
    (is_first && point.stiffness >= 0.0).then_some((point, ended))
}
