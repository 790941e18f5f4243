//! A short motion on one branch of the law, by powers of the time.

use super::{Drive, Outcome, SMALLEST};
use crate::contact::history::{History, Regime};
use crate::contact::numbers::{largest, quotient, root};
use crate::contact::segment::Segment;
use core::array::from_fn;
use libm::fabs;

/// Powers of the time that are taken at most.
const MOST: usize = 20;

/// A way, as a part of the height above the origin of a power, from which on the powers of the time fall too slowly.
const LONG: f64 = 0.35;

/// The square of the phase \[rad\] from which on they grow before they fall.
const MOST_PHASE: f64 = 4.0;

/// What the last two powers may be of all, so that those that are left out are nothing.
const MISSED: f64 = 0.25 * f64::EPSILON;

/// The shortest time \[s\]: a way over a shorter one may be no speed.
const SHORTEST: f64 = 1e-100;

/// `1/((k + 1) (k + 2))` from `k = 1` on.
const INVERSE: [f64; MOST - 2] = {
    let mut inverse = [0.0; MOST - 2];
    let mut index = 0;
    while index < inverse.len() {
        inverse[index] = 1.0 / ((index + 2) * (index + 3)) as f64;
        index += 1;
    }
    inverse
};

/// A motion, as far as it has been followed by powers of the time.
#[derive(Clone, Copy, Debug)]
pub struct Short {
    /// \[m\]; positive is deeper.
    pub way: f64,
    /// What the speed has changed by \[m/s\].
    pub gain: f64,
    /// More than the distance from the start has been on the way \[m\].
    pub span: f64,
    /// Whether the bodies have gone in one direction.
    pub one_way: bool,
    /// Powers that it took.
    pub powers: u32,
}

/// A power of the time in the change of the height `z`, of its root, and of the force that a product with the way is left of; in
/// units of the height, of its root, and of what makes it a way.
type Power = [f64; 3];

impl Short {
    /// The motion in `time` \[s\] on a `segment` from `indentation` \[m\] with `speed` \[m/s\], where the acceleration is `net`
    /// \[m/s^2\]; `None` if the powers of the time don't fall fast enough to say it to rounding.
    ///
    /// With `z = z_0 (1 + y)` and `sqrt(z) = sqrt(z_0) (1 + e)`, `y = 2 e + e^2` and
    /// `y'' = net/z_0 - p y - q (y + e + y e) - r (2 y + y^2)`: each power follows from those before it.
    pub fn new(
        segment: &Segment,
        indentation: f64,
        speed: f64,
        net: f64,
        inverse_mass: f64,
        time: f64,
    ) -> Option<Short> {
        let (first, second) = (speed * time, 0.5 * net * time * time);
        let reach = fabs(first) + fabs(second);
        // a straight line begins anywhere
        let straight = segment.power == 0.0 && segment.square == 0.0;
        let height = if straight { reach } else { indentation - segment.origin };
        let unit = inverse_mass * time * time;
        let (p, q, r) = (segment.linear * unit, segment.power * unit * root(height), segment.square * unit * height);
        let phase = fabs(p) + fabs(q) + fabs(r);
        let is_short = (straight || reach < LONG * height) && phase < MOST_PHASE && height > SMALLEST && time > SHORTEST;
        if !is_short {
            return None;
        }
        let inverse = quotient(1.0, height, is_short, 0.0);
        let mut powers: [Power; MOST] = from_fn(|_| [0.0; 3]);
        let (mut way, mut gain, mut rest) = (second * inverse, 2.0 * second * inverse, 2.0 * fabs(second) * inverse);
        let (start, mut last, mut next) = (first * inverse, rest, second * inverse);
        let mut now = start;
        for (index, factor) in INVERSE.into_iter().enumerate() {
            let (mut squared, mut product) = (0.0, 0.0);
            if !straight {
                let before = powers.get(..index)?;
                for ([y, e, _], [_, root, force]) in before.iter().rev().zip(before) {
                    squared += e * root;
                    product += y * force;
                }
            }
            let e = 0.5 * (now - squared);
            let force = q * e + r * now;
            *powers.get_mut(index)? = [now, e, force];
            let power = -factor * ((p + q + r) * now + force + product);
            (now, next) = (next, power);
            let change = (index + 3) as f64 * power;
            way += power;
            gain += change;
            rest += fabs(change);
            if fabs(change) + last <= MISSED * (fabs(start) + rest) {
                let powers = index as u32 + 3;
                let one_way = rest < fabs(start);
                let span = height * (fabs(start) + rest);
                let gain = gain * height / time;
                return Some(Short { way: first + way * height, gain, span, one_way, powers });
            }
            last = fabs(change);
        }
        None
    }
}

/// The step of bodies that stay in flight, or on one branch of the law, if it is short; otherwise nothing is done.
pub fn step(history: &mut History, drive: &Drive, speed: f64, time: f64) -> Option<Outcome> {
    let Drive { mass, acceleration } = *drive;
    let indentation = history.indentation();
    let (segment, is_loading) = (history.branch(), history.is_loading());
    let is_apart = history.regime() == Regime::Apart;
    let inverse_mass = 1.0 / mass;
    let short = if is_apart {
        let (first, second) = (speed * time, 0.5 * acceleration * time * time);
        let (way, span) = (first + second, fabs(first) + fabs(second));
        Short { way, gain: acceleration * time, span, one_way: false, powers: 0 }
    } else {
        let net = acceleration - segment.force(indentation) * inverse_mass;
        // a rough answer is enough where there is no branch to speak of
        let is_near = segment.contains(indentation + time * (speed + 0.5 * net * time));
        if !is_near {
            return None;
        }
        Short::new(segment, indentation, speed, net, inverse_mass, time)?
    };
    let Short { way, gain, span, one_way, powers } = short;
    // nor on the way did they leave the branch
    let stays = one_way || !is_loading && indentation - span > segment.lower && indentation + span < segment.upper;
    if !(stays && history.advance_on_branch(way)) {
        return None;
    }
    let taken = if is_apart { 0.0 } else { largest(acceleration * time - gain, 0.0) };
    Some(Outcome { speed: speed + gain, taken, evaluations: powers, deepest: history.max_indentation() })
}
