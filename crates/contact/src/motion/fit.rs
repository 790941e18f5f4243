//! A law without segments, approximated by one polynomial on a part of its smooth piece.

use super::COSTLY;
use super::field::{Field, Place, Start};
use super::series::Series;
use crate::TooDeep;
use crate::history::piece::Piece;
use crate::loading::Loading;
use crate::numerics::quadrature::{POINTS, powers};
use crate::numerics::{quotient, root, smallest};
use crate::unloading::Unloading;
use core::cell::Cell;
use libm::fabs;

/// Largest relative error of the energy of a fit.
const MISSED: f64 = 1e-15;

/// Upper bound for the relative rounding errors of a force and of an indentation.
const NOISE: f64 = 16.0 * f64::EPSILON;

/// Largest factor by which one fit goes deeper.
const DEEPER: f64 = 3.0;

/// Largest number of times that a distance is shortened if it is too long for a fit.
const ATTEMPTS: u32 = 60;

/// The distance that the bodies move before they turn, for a squared speed of `energy`, a spring with this `stiffness` over the
/// mass, and an acceleration `pull` in the direction of motion. It is infinite if nothing slows them down.
pub fn elastic_way(pull: f64, energy: f64, stiffness: f64) -> f64 {
    let root = root(pull * pull + stiffness * energy);
    let (way, slowed) = if pull > 0.0 { (root + pull, stiffness) } else { (energy, root - pull) };
    quotient(way, slowed, slowed > way * 1e-300, f64::INFINITY)
}

/// The field on a `piece` that is not a segment, as far towards `limit` \[m\] as one polynomial is exact, and that distance.
///
/// # Errors
/// [`TooDeep`] where the law cannot be evaluated.
pub fn fitted<'a, L: Loading, U: Unloading>(
    piece: &Piece<L, U>,
    start: &Start,
    limit: f64,
    evaluations: &'a Cell<u32>,
) -> Result<(Field<'a>, Place<POINTS>, f64), TooDeep> {
    let Start { indentation, speed, net, acceleration, inverse_mass, .. } = *start;
    let (stiffness, unit) = (piece.stiffness(indentation) * inverse_mass, start.unit());
    let sign = if limit > 0.0 { 1.0 } else { -1.0 };
    // the law is not evaluated far beyond the turning point
    let guess = unit * elastic_way(sign * net / unit, (speed / unit) * (speed / unit), stiffness);
    let mut way = smallest(fabs(limit), smallest(2.0 * guess, DEEPER * indentation));
    let first = root(indentation - piece.origin());
    let rounded = NOISE * (fabs(acceleration) + fabs(acceleration - net) + stiffness * indentation);
    for _ in 0..ATTEMPTS {
        let roots = sign * way / (first + root(first * first + sign * way));
        let (mut powers, missed) = powers(|part| {
            let way = part * roots * (2.0 * first + part * roots);
            acceleration - piece.force(indentation + way) * inverse_mass
        });
        // in the upward direction, the root decreases
        powers.iter_mut().fold(1.0, |power, slot| {
            *slot *= power;
            power * sign
        });
        let length = fabs(roots);
        let (field, place) = Field::new(start, Series::new(first / length, powers), length * length, evaluations);
        field.count(COSTLY * POINTS as u32);
        // half of the squared speed, half of its gain, and the part due to rounding
        let allowed = MISSED * (0.5 * speed * speed + fabs(net) * way) + rounded * way;
        // written positively to reject NaN
        if missed * way <= allowed {
            return Ok((field, place, sign * way));
        }
        way *= if missed * way > 1e4 * allowed { 0.25 } else { 0.5 };
    }
    Err(TooDeep { indentation: indentation + sign * way })
}
