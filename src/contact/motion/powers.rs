//! A short motion on one segment, by powers of the time.

use super::SMALLEST;
use super::field::Start;
use super::stretch::{Ended, Stretch};
use crate::contact::numbers::{quotient, root, smallest};
use crate::contact::segment::Segment;
use libm::{fabs, sqrt};

/// Powers that are taken at most.
const MOST: usize = 22;

/// What the last two powers may be of all, so that those that are left out are nothing.
const MISSED: f64 = 0.125 * f64::EPSILON;

/// The square of the phase \[rad\] up to which powers fall fast: on a straight line, and on others.
const LONGEST: f64 = 3.0;
const LONGEST_CURVED: f64 = 0.5;

/// The way for that, as a part of the height above the origin of a power.
const FARTHEST: f64 = 0.25;

/// How much longer than an event may take it is looked for.
const BEYOND: f64 = 1.1;

/// Steps in search of an event: it takes some three.
const STEPS: u32 = 8;

/// A step whose third power is nothing.
const CONVERGED: f64 = 4e-6;

/// The least speed at the end of a segment, as a part of the largest one, that isn't left to others to tell from none.
const SLOWEST: f64 = 1e-6;

/// The shortest time \[s\] that is looked at: a way over a shorter one may be no speed.
const SHORTEST: f64 = 1e-100;

/// `1/((k + 1) (k + 2))`, from `k = 1` on.
const INVERSE: [f64; MOST - 2] = {
    let mut inverse = [0.0; MOST - 2];
    let mut index = 0;
    while index < inverse.len() {
        inverse[index] = 1.0 / ((index + 2) * (index + 3)) as f64;
        index += 1;
    }
    inverse
};

/// What a power of the time adds.
#[derive(Clone, Copy)]
struct Power {
    /// To the height.
    way: f64,
    /// To its root.
    root: f64,
    /// To what the force over the way has beyond its first powers.
    bend: f64,
}

/// A motion from where the height is one, in a time that ends at one.
///
/// With the height `1 + y` and its root `1 + e`: `y = 2 e + e^2`, and
/// `y'' = net - p y - q ((1 + y) (1 + e) - 1) - r (2 y + y^2)`. So each power of the time follows from those before it.
struct Motion {
    /// Whether the force is a straight line: `q` and `r` are zero.
    straight: bool,
    /// `p`, `q` and `r`.
    force: [f64; 3],
    /// The speed at the start.
    speed: f64,
    powers: [Power; MOST],
    count: usize,
    /// Where it ends.
    end: Point,
}

/// A moment of a motion.
#[derive(Clone, Copy)]
struct Point {
    time: f64,
    /// Since the start, like the gain.
    way: f64,
    /// Of speed.
    gain: f64,
    net: f64,
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
    let bound = smallest(bound, 2.0 * reach);
    let phase = segment.linear * inverse_mass * left * left;
    let part = if may_stop {
        let slow = if straight { sqrt(quotient(LONGEST, phase, phase > LONGEST, 1.0)) } else { 1.0 };
        smallest(slow, horizon(sign * first / reach, sign * second / reach, bound / reach))
    } else {
        1.0
    };
    let (time, first, second) = (part * left, part * first, part * part * second);
    let reach = fabs(first) + fabs(second);
    // a straight line begins anywhere
    let height = if straight { reach } else { indentation - segment.origin };
    let top = root(height);
    let force =
        [phase, segment.power * top * inverse_mass * left * left, segment.square * height * inverse_mass * left * left];
    let force = force.map(|force| force * (part * part));
    let phase = force.iter().fold(0.0, |sum, force| sum + fabs(*force));
    let short = if straight { phase < 1.01 * LONGEST } else { phase < LONGEST_CURVED && reach < FARTHEST * height };
    if !(short && height > SMALLEST) {
        return None;
    }
    let motion = Motion::new(straight, first / height, second / height, force)?;
    let (point, ended) = motion.first_event(sign, bound / height)?;
    let (passed, ended) = match ended {
        Ended::WithStep if part < 1.0 => (time, Ended::Within),
        Ended::WithStep => (left, ended),
        _ => (time * point.time, ended),
    };
    let speed = if ended == Ended::Turned { 0.0 } else { speed + point.gain * height / time };
    Some((Stretch { way: height * point.way, speed, time: passed, ended }, motion.count as u32))
}

impl Motion {
    /// With these first two powers of the way. `None` if later ones don't fall fast enough.
    fn new(straight: bool, first: f64, second: f64, force: [f64; 3]) -> Option<Motion> {
        let [p, q, r] = force;
        let mut powers = [Power { way: 0.0, root: 0.0, bend: 0.0 }; MOST];
        let mut end = Point { time: 1.0, way: second, gain: 2.0 * second, net: 2.0 * second };
        let (mut way, mut next, mut last) = (first, second, fabs(2.0 * second));
        let mut size = fabs(first) + last;
        for (index, inverse) in INVERSE.into_iter().enumerate() {
            let (before, after) = powers.split_at_mut_checked(index)?;
            let (mut square, mut product) = (0.0, 0.0);
            if !straight {
                for (late, early) in before.iter().rev().zip(before.iter()) {
                    square += late.root * early.root;
                    product += late.way * early.bend;
                }
            }
            let root = 0.5 * (way - square);
            let bend = q * root + r * way;
            *after.first_mut()? = Power { way, root, bend };
            let net = -((p + q + r) * way + bend + product);
            let power = net * inverse;
            (way, next) = (next, power);
            let gain = (index + 3) as f64 * power;
            end.way += power;
            end.gain += gain;
            end.net += net;
            size += fabs(gain);
            if fabs(gain) + last <= MISSED * size {
                end.way += first;
                return Some(Motion { straight, force, speed: first, powers, count: index + 1, end });
            }
            last = fabs(gain);
        }
        None
    }

    /// The point at `time`.
    fn at(&self, time: f64) -> Point {
        let (mut way, mut gain, mut net) = (0.0, 0.0, 0.0);
        let powers = self.powers.iter().take(self.count);
        for (index, power) in powers.enumerate().skip(1).rev() {
            let order = (index + 1) as f64;
            way = (way + power.way) * time;
            gain = (gain + order * power.way) * time;
            net = net * time + order * index as f64 * power.way;
        }
        Point { time, way: (way + self.speed) * time, gain, net }
    }

    /// The event, from `time` on, which is near it.
    fn find(&self, event: Event, mut time: f64) -> Option<Point> {
        for _ in 0..STEPS {
            let point = self.at(time);
            let speed = self.speed + point.gain;
            let (miss, slope, bend) = match event {
                Event::Border(way) => (way - point.way, speed, point.net),
                Event::Turn => (-speed, point.net, 0.0),
            };
            let leads = fabs(miss) < fabs(slope);
            let step = quotient(miss, slope, leads, 1.0);
            let step = step * (1.0 - 0.5 * step * quotient(bend, slope, leads, 0.0));
            time += step;
            if !(leads && time > 0.0 && time <= 1.0) {
                return None;
            }
            if fabs(step) < CONVERGED {
                let (way, gain) = (step * (speed + 0.5 * point.net * step), step * point.net);
                return Some(Point { time, way: point.way + way, gain: point.gain + gain, net: point.net });
            }
        }
        None
    }

    /// The first event on the way in the direction `sign` up to a border at that distance. `None` if it isn't certain which it is.
    fn first_event(&self, sign: f64, distance: f64) -> Option<(Point, Ended)> {
        let Motion { force: [p, q, r], speed, end, .. } = *self;
        let (passes, turns) = (sign * end.way >= distance, sign * (speed + end.gain) <= 0.0);
        let (point, ended) = if passes {
            let near = quotient(distance, fabs(end.way), distance > 0.0, 0.0);
            (self.find(Event::Border(sign * distance), near)?, Ended::AtBorder)
        } else if turns {
            let near = quotient(speed, -end.gain, end.gain != 0.0, 0.0);
            (self.find(Event::Turn, near)?, Ended::Turned)
        } else {
            (end, Ended::WithStep)
        };
        let is_first = match ended {
            Ended::AtBorder => sign * (speed + point.gain) > SLOWEST * (fabs(speed) + fabs(point.gain)),
            _ => sign * point.way < distance,
        };
        // the force only grows on the way, so that bodies which have not turned at its end have not turned before
        let last = if self.straight { 1.0 } else { root(1.0 + point.way) };
        let grows = |root: f64| p + root * (1.5 * q + 2.0 * r * root) >= 0.0;
        (is_first && grows(1.0) && grows(last) && r <= 0.0).then_some((point, ended))
    }
}
