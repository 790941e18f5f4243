//! The field of forces on a stretch: a way in one direction on one smooth piece of the law.
//!
//! With the other forces held, kinetic energy is a function of the place alone, `v^2 = v0^2 + 2 (a d - W/m)`: a polynomial in
//! `sqrt(z)` where the law has a segment, and fitted by one elsewhere. So no motion is followed in time: where the bodies turn
//! is a root of it ([`super::turning`]), and the time is an integral ([`super::travel`]).

use super::COSTLY;
use super::series::Series;
use crate::contact::TooDeep;
use crate::contact::loading::Loading;
use crate::contact::numbers::{largest, power_of_two, quotient, root, smallest};
use crate::contact::piece::Piece;
use crate::contact::quadrature::{POINTS, powers};
use crate::contact::segment::Segment;
use crate::contact::unloading::Unloading;
use core::cell::Cell;
use libm::fabs;

/// What moves the bodies, over their mass.
#[derive(Clone, Copy, Debug)]
pub struct Forces {
    /// One over the effective mass \[1/kg\].
    pub inverse_mass: f64,
    /// Acceleration by all other forces \[m/s^2\].
    pub acceleration: f64,
}

/// The motion at the start of a stretch.
#[derive(Clone, Copy, Debug)]
pub struct Start {
    /// Where it begins \[m\].
    pub indentation: f64,
    /// \[m/s\]
    pub speed: f64,
    /// Acceleration there \[m/s^2\].
    pub net: f64,
    /// Time left \[s\].
    pub time: f64,
}

impl Start {
    /// A unit of speed \[m/s\] in which the square of no speed overflows or vanishes: a power of two.
    fn unit(&self) -> f64 {
        power_of_two(largest(fabs(self.speed), fabs(self.net) * largest(self.time, SHORTEST)))
    }
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

/// The units of a stretch, and the work that it takes.
#[derive(Clone, Copy)]
pub struct Field<'a> {
    /// The unit of speed \[m/s\], a power of two: its square neither overflows nor vanishes.
    unit: f64,
    inverse_unit: f64,
    /// The square of the unit of roots \[m\].
    square: f64,
    evaluations: &'a Cell<u32>,
}

/// Powers of a segment: its force is a polynomial of fourth degree in the root.
pub const SEGMENT: usize = 5;

/// Shorter times \[s\] make no difference to the unit of speed.
const SHORTEST: f64 = 1e-100;

/// More than any ratio of ways, and not so much that a product of it overflows.
const WITHOUT_LIMIT: f64 = 1e150;

/// What a fit may miss of the energy, as a part of it.
const MISSED: f64 = 1e-15;

/// What rounding makes of a force and of an indentation, in parts of them, and more.
const NOISE: f64 = 16.0 * f64::EPSILON;

/// How much deeper than before a law is fitted at once.
const DEEPER: f64 = 3.0;

/// How often a way is halved that is too long for a fit.
const HALVINGS: u32 = 60;

/// How far bodies come before they turn \[m\] that are slowed down by a spring, and pulled in their direction by `pull` \[m/s^2\].
fn elastic_way(start: &Start, stiffness: f64, pull: f64) -> f64 {
    let unit = start.unit();
    let (speed, pull) = (start.speed / unit, pull / unit);
    unit * elastic(pull, speed * speed, stiffness)
}

/// The same for the square of the speed `energy`; the largest number if nothing slows them down.
pub fn elastic(pull: f64, energy: f64, stiffness: f64) -> f64 {
    let root = root(pull * pull + stiffness * energy);
    let (way, slowed) = if pull > 0.0 { (root + pull, stiffness) } else { (energy, root - pull) };
    quotient(way, slowed, slowed > way * 1e-300, f64::INFINITY)
}

impl<'a> Field<'a> {
    /// The field on a `segment`, to go towards `limit` \[m\].
    pub fn on_segment(
        segment: &Segment,
        forces: &Forces,
        start: &Start,
        limit: f64,
        evaluations: &'a Cell<u32>,
    ) -> (Field<'a>, Place<SEGMENT>) {
        let Forces { inverse_mass, .. } = *forces;
        let straight = segment.power == 0.0 && segment.square == 0.0;
        // a straight line begins anywhere: far off, so that the root is as smooth as the way
        let height = if straight { 4.0 * fabs(limit) } else { start.indentation - segment.origin };
        let root = root(height);
        let [linear, power, square] = [segment.linear, segment.power, segment.square].map(|c| c * inverse_mass);
        // of c1 r^2 + c2 r^3 + c3 r^4 around the start
        let first = root * (2.0 * linear + root * (3.0 * power + 4.0 * square * root));
        let second = linear + root * (3.0 * power + 6.0 * square * root);
        let third = power + 4.0 * square * root;
        let series = Series::new(root, [start.net, -first, -second, -third, -square]);
        Field::new(start, series, 1.0, evaluations)
    }

    /// The field on a `piece` that is no segment: fitted as far towards `limit` \[m\] as one polynomial is exact, and how far that is.
    ///
    /// # Errors
    /// [`TooDeep`] where the law can't be evaluated.
    pub fn fitted<L: Loading, U: Unloading>(
        piece: &Piece<L, U>,
        forces: &Forces,
        start: &Start,
        limit: f64,
        evaluations: &'a Cell<u32>,
    ) -> Result<(Field<'a>, Place<POINTS>, f64), TooDeep> {
        let height = start.indentation - piece.origin();
        let first = root(height);
        let Forces { inverse_mass, acceleration } = *forces;
        // the law is not asked for what is far beyond the turning point
        let stiffness = piece.stiffness(start.indentation) * inverse_mass;
        let guess = elastic_way(start, stiffness, if limit > 0.0 { start.net } else { -start.net });
        let farthest = smallest(2.0 * guess, DEEPER * start.indentation);
        let mut limit = largest(smallest(limit, farthest), -farthest);
        for _ in 0..HALVINGS {
            let roots = limit / (first + root(height + limit));
            let (length, sign) = (fabs(roots), if roots > 0.0 { 1.0 } else { -1.0 });
            let (mut net, missed) = powers(|part| {
                let way = part * roots * (2.0 * first + part * roots);
                acceleration - piece.force(start.indentation + way) * inverse_mass
            });
            let mut power = 1.0;
            for slot in &mut net {
                *slot *= power;
                power *= sign;
            }
            let series = Series::new(first / length, net);
            let (field, place) = Field::new(start, series, length * length, evaluations);
            field.count(COSTLY * POINTS as u32);
            // half of what bodies have of speed, of what they gain, and of what rounding makes of it
            let way = fabs(limit);
            let rounded = NOISE * (fabs(acceleration) + fabs(acceleration - start.net) + stiffness * start.indentation);
            let allowed = MISSED * (0.5 * start.speed * start.speed + fabs(start.net) * way) + rounded * way;
            // written so that a NaN is refused
            if missed * way <= allowed {
                return Ok((field, place, limit));
            }
            limit *= if missed * way > 1e4 * allowed { 0.25 } else { 0.5 };
        }
        Err(TooDeep { indentation: start.indentation + limit })
    }

    fn new<const N: usize>(
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

    /// dF/d(indentation) over the mass at a place \[1/s^2\].
    pub fn stiffness<const N: usize>(&self, place: &Place<N>) -> f64 {
        place.series.stiffness() / self.square
    }

    /// Energy at `t` from `place`.
    pub fn energy<const N: usize>(&self, place: &Place<N>, t: f64) -> f64 {
        let mean = place.series.gain(t) * self.inverse_unit * self.square;
        place.mark.energy + 2.0 * mean * (t * self.inverse_unit)
    }

    /// Change of the energy by `t` at `t` from `place`, where the acceleration is `net` \[m/s^2\].
    pub fn slope<const N: usize>(&self, place: &Place<N>, t: f64, net: f64) -> f64 {
        4.0 * (net * self.inverse_unit) * ((place.series.root() + t) * self.square * self.inverse_unit)
    }

    /// `|dz/ds|` at `t` from `place` [s times the unit of speed], for `dt/ds = slope`.
    pub fn pace<const N: usize>(&self, place: &Place<N>, t: f64, slope: f64) -> f64 {
        fabs(2.0 * (place.series.root() + t) * (slope * self.inverse_unit)) * self.square
    }

    /// The way from a place outwards (1 deeper, -1 upwards) in `time` \[s\], which may be negative \[m\]: four powers of the time, and
    /// how much the fourth is.
    pub fn onwards<const N: usize>(&self, place: &Place<N>, outwards: f64, time: f64) -> (f64, f64) {
        let Place { mark, series } = place;
        let (speed, stiffness) = (outwards * self.speed(mark.energy), self.stiffness(place));
        let (phase, straight, fall) = (stiffness * time * time, speed * time, mark.net * time * time);
        // the stiffness grows at most as from the origin of a power, and there without limit
        let height = series.root() * series.root() * self.square;
        let bend = quotient(straight, height, height > 0.0, WITHOUT_LIMIT) * straight;
        let way = straight * (1.0 - phase / 6.0) + fall * (0.5 - phase / 24.0);
        (way, fabs(phase) * (bend + fabs(fall)) / 24.0)
    }

    /// How the root changes from `place` on `way` \[m\].
    pub fn roots<const N: usize>(&self, place: &Place<N>, way: f64) -> f64 {
        let (between, from) = (way / self.square, place.series.root());
        let sum = from + root(from * from + between);
        quotient(between, sum, sum > 0.0, 0.0)
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
}
