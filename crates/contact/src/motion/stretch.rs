//! A stretch: a motion in one direction on one smooth piece of the law, until the bodies turn, or the piece or the step ends.

use super::field::{Ended, Field, Place, Start, Stretch};
use super::fit::fitted;
use super::travel::Travel;
use super::turning::{End, end, fastest};
use super::{NoMotion, SMALLEST, short};
use crate::TooDeep;
use crate::history::piece::Piece;
use crate::loading::Loading;
use crate::numerics::{largest, smallest};
use crate::unloading::Unloading;
use core::cell::Cell;
use libm::fabs;

/// A distance, as a fraction of the indentation, over which a law without segments equals its tangent: the error of the change
/// of force is then as small as the rounding error of the force.
const SHORT: f64 = 1e-8;

/// Slower speeds count as zero, relative to the speed that the forces produce in the remaining time.
const NOTHING: f64 = 1e-100;

/// The rounding error of the energy at the end of a stretch, relative to the largest energy.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

impl Stretch {
    /// The stretch from `start` on `piece`; it goes deeper if `rising`.
    ///
    /// # Errors
    /// [`NoMotion`].
    pub fn new<L: Loading, U: Unloading>(
        piece: &Piece<'_, L, U>,
        start: &Start,
        rising: bool,
        evaluations: &Cell<u32>,
    ) -> Result<Stretch, NoMotion> {
        let Start { indentation, net, time, .. } = *start;
        let sign = if rising { 1.0 } else { -1.0 };
        let pull = sign * net;
        // the square of a smaller speed would be negligible
        let speed = if fabs(start.speed) > NOTHING * fabs(net) * time { start.speed } else { 0.0 };
        let bound = if rising { piece.upper - indentation } else { indentation - piece.lower };
        let moves = bound > 0.0 && (speed != 0.0 || pull > 0.0);
        if !moves {
            return Ok(Stretch { way: 0.0, speed: 0.0, gain: -start.speed, time: 0.0, ended: Ended::Turned });
        }
        if bound < SMALLEST {
            return Ok(Stretch {
                way: sign * bound,
                speed,
                gain: speed - start.speed,
                time: 0.0,
                ended: Ended::AtBorder,
            });
        }
        // no farther than with a force that does not grow
        let reach = time * (fabs(speed) + 0.5 * largest(pull, 0.0) * time) * (1.0 + ROUNDING);
        if reach < SMALLEST {
            let gain = net * time;
            return Ok(Stretch { way: sign * reach, speed: speed + gain, gain, time, ended: Ended::WithStep });
        }
        let limit = sign * smallest(bound, reach);
        let farthest = if bound < reach { Ended::AtBorder } else { Ended::WithStep };
        let start = Start { speed, ..*start };
        let tangent = || (fabs(limit) <= SHORT * indentation).then(|| piece.tangent(indentation));
        if let Some(segment) = piece.whole().copied().or_else(tangent) {
            if let Some((stretch, powers)) = short::stretch(&segment, &start, sign, bound, true) {
                evaluations.set(evaluations.get().saturating_add(powers));
                return Ok(stretch);
            }
            let (field, place) = Field::on_segment(&segment, &start, limit, evaluations);
            return Stretch::over(field, place, limit, farthest, &start);
        }
        let (field, place, smooth) = fitted(piece, &start, limit, evaluations)?;
        let farthest = if smooth == limit { farthest } else { Ended::Within };
        Stretch::over(field, place, smooth, farthest, &start)
    }

    /// The stretch from `start`, which is at `place`, over `limit` \[m\]. `farthest` is the reason to return if it reaches the
    /// limit.
    fn over<const N: usize>(
        field: Field,
        place: Place<N>,
        limit: f64,
        farthest: Ended,
        start: &Start,
    ) -> Result<Stretch, NoMotion> {
        let sign = if limit > 0.0 { 1.0 } else { -1.0 };
        let left = start.time;
        let (t, mut last, mut ended) = match end(&field, &place, limit) {
            End::Turns(t, mark) => (t, mark, Ended::Turned),
            End::Passes(t, mark) => (t, mark, farthest),
        };
        if !last.net.is_finite() {
            return Err(TooDeep { indentation: last.net }.into());
        }
        let middle = fastest(&field, &place, t, &last);
        let way = if ended == Ended::Turned { last.way } else { limit };
        // the bodies turn exactly at the end; the rounding error of the speed would cause a flight that does not exist
        if ended != Ended::Turned && middle.is_some_and(|(_, mark)| last.energy <= ROUNDING * mark.energy) {
            (last.energy, ended) = (0.0, Ended::Turned);
        }
        let (mut past, mut at, mut from) = (0.0, 0.0, place);
        for (to, mark) in [middle, Some((t, last))].into_iter().flatten() {
            if to == at {
                continue;
            }
            let travel = Travel::new(field, from, to - at, mark);
            // a distance that cannot be covered in the time left needs no time of its own
            let (unknown, time) = (to == t && ended == Ended::WithStep, left - past);
            let whole = if unknown { time } else { travel.time()? };
            if unknown || whole > time {
                let mark = travel.after(time, whole)?;
                let speed = sign * field.speed(mark.energy);
                let gain = speed - start.speed;
                return Ok(Stretch { way: mark.way, speed, gain, time: left, ended: Ended::WithStep });
            }
            past += whole;
            from = field.around(&from, to - at, mark);
            at = to;
        }
        // avoids the negative zero
        let speed = field.speed(last.energy);
        let speed = if speed > 0.0 { sign * speed } else { 0.0 };
        Ok(Stretch { way, speed, gain: speed - start.speed, time: past, ended })
    }
}
