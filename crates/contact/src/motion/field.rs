//! The forces on a stretch, which is a motion in one direction on one smooth piece of the law.
//!
//! With the other forces constant, the kinetic energy is a function of the position alone: `v^2 = v0^2 + 2 (a d - W/m)`. It is
//! a polynomial in `sqrt(z)` where the law has a segment, and is approximated by one elsewhere. Its root is the turning point
//! of the bodies. The time is an integral.

use super::moment::Moment;
use super::series::{SEGMENT, Series};
use crate::numerics::{largest, power_of_two, quotient, root};
use crate::segment::Segment;
use core::cell::Cell;
use libm::fabs;

/// The motion at the start of a stretch, and the forces.
#[derive(Clone, Copy, Debug)]
pub struct Start {
    /// Indentation at the start \[m\].
    pub indentation: f64,
    /// Closing speed at the start \[m/s\].
    pub speed: f64,
    /// Total acceleration at the start \[m/s^2\].
    pub net: f64,
    /// Acceleration by all forces except the contact force \[m/s^2\].
    pub acceleration: f64,
    /// Inverse of the effective mass \[1/kg\].
    pub inverse_mass: f64,
    /// Time left \[s\].
    pub time: f64,
}

/// The result of a stretch.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// Distance from its start \[m\]; positive is deeper.
    pub way: f64,
    /// Closing speed at its end \[m/s\].
    pub speed: f64,
    /// Change of the closing speed \[m/s\]. Over a short time it has more digits than the difference of the speeds.
    pub gain: f64,
    /// Duration \[s\].
    pub time: f64,
    /// The reason why it ended.
    pub ended: Ended,
}

/// The reason why a stretch ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ended {
    /// The bodies have turned.
    Turned,
    /// It reached the end of the piece.
    AtBorder,
    /// It stopped within the piece, as far as could be computed at once.
    Within,
    /// The step ended.
    WithStep,
}

/// A point of a stretch.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    /// Distance from the start \[m\]; positive is deeper.
    pub way: f64,
    /// Acceleration \[m/s^2\]; positive is into the contact.
    pub net: f64,
    /// Square of the speed, in squares of the field's unit of speed.
    pub energy: f64,
}

/// A mark with the forces around it.
#[derive(Clone, Copy, Debug)]
pub struct Place<const N: usize> {
    pub mark: Mark,
    pub series: Series<N>,
}

/// The units of a stretch, and a counter of evaluations.
#[derive(Clone, Copy)]
pub struct Field<'a> {
    /// The unit of speed \[m/s\], a power of two. Its square neither overflows nor underflows.
    unit: f64,
    inverse_unit: f64,
    /// The square of the unit of roots \[m\].
    square: f64,
    evaluations: &'a Cell<u32>,
}

/// Times shorter than this \[s\] do not change the unit of speed.
const SHORTEST: f64 = 1e-100;

impl Start {
    /// The unit of speed \[m/s\], a power of two: the square of no speed on the stretch overflows or underflows in this unit.
    pub fn unit(&self) -> f64 {
        power_of_two(largest(fabs(self.speed), fabs(self.net) * largest(self.time, SHORTEST)))
    }
}

impl<'a> Field<'a> {
    /// The field on a `segment`, for a distance of `limit` \[m\].
    pub fn on_segment(
        segment: &Segment,
        start: &Start,
        limit: f64,
        evaluations: &'a Cell<u32>,
    ) -> (Field<'a>, Place<SEGMENT>) {
        let straight = segment.power == 0.0 && segment.square == 0.0;
        // a straight line may begin anywhere: its origin is put far away, so that the root is as smooth as the distance
        let height = if straight { 4.0 * fabs(limit) } else { start.indentation - segment.origin };
        let series = Series::on_segment(segment, height, start.net, start.inverse_mass);
        Field::new(start, series, 1.0, evaluations)
    }

    /// The field with these forces around the start; `square` \[m\] is the square of the unit of roots.
    pub fn new<const N: usize>(
        start: &Start,
        series: Series<N>,
        square: f64,
        evaluations: &'a Cell<u32>,
    ) -> (Field<'a>, Place<N>) {
        let unit = start.unit();
        let inverse_unit = 1.0 / unit;
        let speed = start.speed * inverse_unit;
        let mark = Mark { way: 0.0, net: start.net, energy: speed * speed };
        (Field { unit, inverse_unit, square, evaluations }, Place { mark, series })
    }

    /// Adds to the number of evaluations of the force or its work.
    pub fn count(&self, evaluations: u32) {
        self.evaluations.set(self.evaluations.get().saturating_add(evaluations));
    }

    /// Number of evaluations so far.
    pub fn evaluations(&self) -> u32 {
        self.evaluations.get()
    }

    /// The speed of the bodies at this energy \[m/s\]; zero for a negative energy.
    pub fn speed(&self, energy: f64) -> f64 {
        self.unit * root(energy)
    }

    /// A distance \[m\] or an acceleration \[m/s^2\], divided by the unit of speed.
    pub fn scaled(&self, value: f64) -> f64 {
        value * self.inverse_unit
    }

    /// The inverse of [`Field::scaled`].
    pub fn unscaled(&self, value: f64) -> f64 {
        value * self.unit
    }

    /// Energy at `t` from `place`.
    pub fn energy<const N: usize>(&self, place: &Place<N>, t: f64) -> f64 {
        let mean = place.series.gain(t) * self.inverse_unit * self.square;
        place.mark.energy + 2.0 * mean * (t * self.inverse_unit)
    }

    /// Derivative of the energy with respect to `t` at `t` from `place`, where the acceleration is `net` \[m/s^2\].
    pub fn slope<const N: usize>(&self, place: &Place<N>, t: f64, net: f64) -> f64 {
        4.0 * (net * self.inverse_unit) * ((place.series.root + t) * self.square * self.inverse_unit)
    }

    /// `|dz/ds|` at `t` from `place`, for `dt/ds = slope`, in seconds times the unit of speed.
    pub fn pace<const N: usize>(&self, place: &Place<N>, t: f64, slope: f64) -> f64 {
        fabs(2.0 * (place.series.root + t) * (slope * self.inverse_unit)) * self.square
    }

    /// dF/d(indentation) over the mass at `t` from `place` \[1/s^2\].
    pub fn stiffness<const N: usize>(&self, place: &Place<N>, t: f64) -> f64 {
        place.series.stiffness(t) / self.square
    }

    /// The distance in roots over which the acceleration at `place` alone would give the bodies the energy that they have there,
    /// if it is shorter than `longest`; otherwise that.
    pub fn turn<const N: usize>(&self, place: &Place<N>, longest: f64) -> f64 {
        let pull = 2.0 * fabs(self.scaled(place.mark.net)) * self.scaled(self.square);
        let energy = place.mark.energy;
        let is_near = energy < pull * longest * longest;
        root(quotient(energy, pull, is_near, longest * longest))
    }

    /// Height of a place above the origin of its piece \[m\].
    pub fn height<const N: usize>(&self, place: &Place<N>) -> f64 {
        place.series.root * place.series.root * self.square
    }

    /// Change of the root over the distance `way` \[m\] from `place`.
    pub fn roots<const N: usize>(&self, place: &Place<N>, way: f64) -> f64 {
        place.series.roots(way / self.square)
    }

    /// The mark at `t` from `place`.
    pub fn mark<const N: usize>(&self, place: &Place<N>, t: f64) -> Mark {
        self.count(1);
        let Place { mark, series } = place;
        Mark { way: mark.way + self.square * series.way(t), net: series.net(t), energy: self.energy(place, t) }
    }

    /// The place of a mark at `t` from `place`.
    pub fn around<const N: usize>(&self, place: &Place<N>, t: f64, mark: Mark) -> Place<N> {
        Place { mark, series: place.series.around(t) }
    }

    /// The moment at which the bodies pass a mark at `t` from `place` in `direction` (1 deeper, -1 upwards).
    pub fn moment<const N: usize>(&self, place: &Place<N>, t: f64, mark: &Mark, direction: f64) -> Moment {
        let root = place.series.root + t;
        let (speed, height) = (direction * self.speed(mark.energy), root * root * self.square);
        Moment { speed, net: mark.net, stiffness: self.stiffness(place, t), height }
    }
}
