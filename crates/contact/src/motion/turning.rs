//! The turning point of the bodies: the root of their kinetic energy.

use super::field::{Field, Mark, Place};
use super::fit::elastic_way;
use super::series::SEGMENT;
use crate::numerics::{largest, quotient, smallest};
use libm::{fabs, sqrt};

/// The end of a stretch, with the change of the root from its start.
#[derive(Clone, Copy, Debug)]
pub enum End {
    /// The bodies turn: the energy is zero at this mark.
    Turns(f64, Mark),
    /// They pass this mark, the limit that was given.
    Passes(f64, Mark),
}

/// Largest number of iterations in search of a turning point: Newton's method takes about five, bisection about fifty.
const STEPS: u32 = 100;

/// Newton's correction, relative to the distance, after which another one would change nothing.
const CONVERGED: f64 = 1e-8;

/// The least coefficient of a power \[1/(m^0.5 s^2)\] used as a divisor.
const WEAKEST: f64 = 1e-100;

/// One end is slow compared with another if it has less than this fraction of its energy.
const SLOW: f64 = 0.25;

/// `value^(numerator/denominator)` of a positive number, within a tenth: the bits of a number approximate its logarithm.
fn rough_power(value: f64, numerator: i64, denominator: i64) -> f64 {
    let one = 1f64.to_bits() as i64;
    f64::from_bits((one + (value.to_bits() as i64 - one) / denominator * numerator) as u64)
}

/// The end of the stretch from `place` over `limit` \[m\]; a negative limit is upwards.
///
/// The root is found in `t`, in which the energy is a polynomial. The polynomial is concave where the force grows with the
/// indentation.
pub fn end<const N: usize>(field: &Field, place: &Place<N>, limit: f64) -> End {
    let sign = if limit > 0.0 { 1.0 } else { -1.0 };
    let whole = field.roots(place, limit);
    let guess = field.roots(place, sign * smallest(guess(field, place, sign), fabs(limit)));
    let (mut near, mut far, mut turns, mut t) = (0.0, whole, false, guess);
    for _ in 0..STEPS {
        let mark = field.mark(place, t);
        if mark.energy > 0.0 {
            if t == far && !turns {
                return End::Passes(t, mark);
            }
            near = t;
        } else {
            (far, turns) = (t, true);
        }
        // Newton's step, if it stays in the bracket
        let slope = field.slope(place, t, mark.net);
        let leads = fabs(mark.energy) < fabs(slope * whole);
        let step = quotient(-mark.energy, slope, leads, f64::MAX);
        let next = t + step;
        let inside = (next > near && next < far) || (next < near && next > far);
        let downhill = slope * sign < 0.0;
        if downhill && fabs(step) <= CONVERGED * fabs(t) {
            t = next;
            break;
        }
        let instead = if turns { 0.5 * (near + far) } else { far };
        t = if downhill && inside { next } else { instead };
    }
    End::Turns(t, Mark { energy: 0.0, ..field.mark(place, t) })
}

/// An estimate of the distance from `place` to the turning point \[m\]. Where the force stiffens, it is an upper bound.
fn guess<const N: usize>(field: &Field, place: &Place<N>, sign: f64) -> f64 {
    let (pull, energy, stiffness) =
        (sign * field.scaled(place.mark.net), place.mark.energy, field.stiffness(place, 0.0));
    let elastic = field.unscaled(elastic_way(pull, energy, stiffness));
    let power = if N == SEGMENT && sign > 0.0 { place.series.power() } else { 0.0 };
    let root = place.series.root;
    let begins = power > 0.0 && root * root < elastic;
    if !begins {
        return elastic;
    }
    // energy + 2 pull d = 4/5 power d^2.5 where a power begins; the two terms on the left are used one at a time
    let power = 0.8 * largest(power, WEAKEST) * sqrt(field.unscaled(1.0));
    let (thrown, pulled) = (rough_power(energy / power, 2, 5), rough_power(4.0 * largest(pull, 0.0) / power, 2, 3));
    smallest(elastic, field.unscaled(if pull > 0.0 { largest(1.4 * thrown, pulled) } else { thrown }))
}

/// The turning point just before the place `slow`, through which the bodies passed at low speed: its change of the root from
/// `slow`, and the place itself. `None` if it is far away. `far` and `energy` are the change of the root and the energy at the
/// other end; the powers used are those that hold between the two.
///
/// At a turning point time is a square root, and not smooth nearby.
pub fn behind<const N: usize>(field: &Field, slow: &Place<N>, far: f64, energy: f64) -> Option<(f64, Place<N>)> {
    if slow.mark.energy == 0.0 {
        return Some((0.0, *slow));
    }
    let sign = if far > 0.0 { 1.0 } else { -1.0 };
    let pull = sign * field.scaled(slow.mark.net);
    if !(slow.mark.energy < SLOW * energy && pull > 0.0) {
        return None;
    }
    // it is at most as far as with the constant force of the slow mark, and not beyond the origin
    let limit = -sign * field.unscaled(0.51 * slow.mark.energy / pull);
    match end(field, slow, largest(limit, -field.height(slow))) {
        End::Turns(t, mark) => Some((t, field.around(slow, t, mark))),
        End::Passes(..) => None,
    }
}

/// An estimate of where the bodies are fastest over `t` from `place` to the mark `last`, if they are slow at both ends.
pub fn fastest<const N: usize>(field: &Field, place: &Place<N>, t: f64, last: &Mark) -> Option<(f64, Mark)> {
    let sign = if t > 0.0 { 1.0 } else { -1.0 };
    let (pulled, held) = (sign * place.mark.net, -sign * last.net);
    if !(pulled > 0.0 && held > 0.0) {
        return None;
    }
    let middle = t * (pulled / (pulled + held));
    let mark = field.mark(place, middle);
    (SLOW * mark.energy > largest(place.mark.energy, last.energy)).then_some((middle, mark))
}
