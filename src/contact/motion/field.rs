//! The forces on a stretch: a motion in one direction on one smooth piece of the law.
//!
//! With the other forces held, the kinetic energy is a function of the position alone, `v^2 = v0^2 + 2 (a d - W/m)`: a polynomial
//! in `sqrt(z)` where the law has a segment, and approximated by one elsewhere. The turning point of the bodies is a root of it,
//! and the time is an integral.

use super::moment::Moment;
use super::series::{SEGMENT, Series};
use crate::contact::numbers::{largest, power_of_two, root};
use crate::contact::segment::Segment;
use core::cell::Cell;
use libm::fabs;

/// The motion at the start of a stretch, and what moves the bodies.
#[derive(Clone, Copy, Debug)]
pub struct Start {
    /// Where it begins \[m\].
    pub indentation: f64,
    /// \[m/s\]
    pub speed: f64,
    /// Acceleration there \[m/s^2\].
    pub net: f64,
    /// Acceleration by all other forces than that of the contact \[m/s^2\].
    pub acceleration: f64,
    /// One over the effective mass \[1/kg\].
    pub inverse_mass: f64,
    /// Time left \[s\].
    pub time: f64,
}

/// A point of a stretch.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    /// From the start \[m\]; positive is deeper.
    pub way: f64,
    /// Acceleration \[m/s^2\]; positive is into the contact.
    pub net: f64,
    /// Square of the speed, in squares of the field's unit of it.
    pub energy: f64,
}

/// A mark, and the forces around it.
#[derive(Clone, Copy, Debug)]
pub struct Place<const N: usize> {
    pub mark: Mark,
    pub series: Series<N>,
}

/// The units of a stretch, and a count of the work.
#[derive(Clone, Copy)]
pub struct Field<'a> {
    /// The unit of speed \[m/s\], a power of two: its square neither overflows nor vanishes.
    unit: f64,
    inverse_unit: f64,
    /// The square of the unit of roots \[m\].
    square: f64,
    evaluations: &'a Cell<u32>,
}

/// Shorter times \[s\] make no difference to the unit of speed.
const SHORTEST: f64 = 1e-100;

impl Start {
    /// A unit of speed \[m/s\] in which the square of no speed of the stretch overflows or vanishes: a power of two.
    pub fn unit(&self) -> f64 {
        power_of_two(largest(fabs(self.speed), fabs(self.net) * largest(self.time, SHORTEST)))
    }
}

impl<'a> Field<'a> {
    /// The field on a `segment`, to go over the way `limit` \[m\].
    pub fn on_segment(
        segment: &Segment,
        start: &Start,
        limit: f64,
        evaluations: &'a Cell<u32>,
    ) -> (Field<'a>, Place<SEGMENT>) {
        let straight = segment.power == 0.0 && segment.square == 0.0;
        // a straight line begins anywhere: far off, so that the root is as smooth as the way
        let height = if straight { 4.0 * fabs(limit) } else { start.indentation - segment.origin };
        let series = Series::on_segment(segment, height, start.net, start.inverse_mass);
        Field::new(start, series, 1.0, evaluations)
    }

    /// The field with these forces around the start, and roots in units of which the square is `square` \[m\].
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

    /// Counts so many evaluations of the force or its work.
    pub fn count(&self, evaluations: u32) {
        self.evaluations.set(self.evaluations.get().saturating_add(evaluations));
    }

    /// Evaluations so far.
    pub fn evaluations(&self) -> u32 {
        self.evaluations.get()
    }

    /// The speed of bodies with that energy \[m/s\]; with less than none none.
    pub fn speed(&self, energy: f64) -> f64 {
        self.unit * root(energy)
    }

    /// A way \[m\] or an acceleration \[m/s^2\] in units of speed, and of seconds.
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

    /// Change of the energy by `t` at `t` from `place`, where the acceleration is `net` \[m/s^2\].
    pub fn slope<const N: usize>(&self, place: &Place<N>, t: f64, net: f64) -> f64 {
        4.0 * (net * self.inverse_unit) * ((place.series.root + t) * self.square * self.inverse_unit)
    }

    /// `|dz/ds|` at `t` from `place` [s times the unit of speed], for `dt/ds = slope`.
    pub fn pace<const N: usize>(&self, place: &Place<N>, t: f64, slope: f64) -> f64 {
        fabs(2.0 * (place.series.root + t) * (slope * self.inverse_unit)) * self.square
    }

    /// dF/d(indentation) over the mass at `t` from `place` \[1/s^2\].
    pub fn stiffness<const N: usize>(&self, place: &Place<N>, t: f64) -> f64 {
        place.series.stiffness(t) / self.square
    }

    /// How far a place is above the origin of its piece \[m\].
    pub fn height<const N: usize>(&self, place: &Place<N>) -> f64 {
        place.series.root * place.series.root * self.square
    }

    /// How the root changes from `place` on `way` \[m\].
    pub fn roots<const N: usize>(&self, place: &Place<N>, way: f64) -> f64 {
        place.series.roots(way / self.square)
    }

    /// The mark at `t` from `place`.
    pub fn mark<const N: usize>(&self, place: &Place<N>, t: f64) -> Mark {
        self.count(1);
        let Place { mark, series } = place;
        Mark { way: mark.way + self.square * series.way(t), net: series.net(t), energy: self.energy(place, t) }
    }

    /// A mark at `t` from `place`, with the forces around it.
    pub fn around<const N: usize>(&self, place: &Place<N>, t: f64, mark: Mark) -> Place<N> {
        Place { mark, series: place.series.around(t) }
    }

    /// The moment in which the bodies pass a mark at `t` from `place` with `direction` (1 deeper, -1 upwards).
    pub fn moment<const N: usize>(&self, place: &Place<N>, t: f64, mark: &Mark, direction: f64) -> Moment {
        let root = place.series.root + t;
        let (speed, height) = (direction * self.speed(mark.energy), root * root * self.square);
        Moment { speed, net: mark.net, stiffness: self.stiffness(place, t), height }
    }
}
