//! An elastoplastic contact with friction.

use super::growth_steps::next_of_lattice;
use super::trial::{TOLERANCE, mean_over};
use super::vector::{add, times};
use super::{Friction, Motion, PlayOperator, Sliding};
use crate::history::History;
use crate::loading::Loading;
use crate::numerics::{largest, next_above, quotient, smallest};
use crate::regime::TooDeep;
use crate::segment::Segment;
use crate::unloading::Unloading;
use crate::{Model, Surface};

/// More pieces than a step can have. A law has a dozen corners. The [lattice](next_of_lattice) has fewer points than
/// this between the smallest and the largest indentation.
const MOST_PIECES: u32 = 40_000;

/// How the mean tangential force of a way is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mean {
    /// Not at all: it is zero.
    Skipped,
    /// As exactly as the springs move.
    Exact,
    /// For short ways: where there is no closed form, and while a dent grows, as the mean of both ends.
    OfEnds,
}

/// The mean of two vectors.
fn middle<const D: usize>(one: [f64; D], other: [f64; D]) -> [f64; D] {
    times(0.5, add(one, 1.0, other))
}

/// The parameters of a contact with friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionalModel<L, U, X = ()> {
    /// The bodies and the laws of the normal force.
    pub normal: Model<L, U>,
    /// Friction between the bodies.
    pub friction: Friction,
    /// The [loss](crate::losses::Loss) without yield of bodies that move together; `()` without one.
    pub loss: X,
}

/// The tangential part of a contact with friction: its springs in `D` directions, and their force-indentation curve. The
/// normal contact is a separate value that does not know about friction.
///
/// With `LATTICE`, a growing dent is divided at fixed depths. The result then hardly depends on the time steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringsOf<const D: usize, const N: usize, const LATTICE: bool> {
    stuck: PlayOperator<D, N>,
    /// The unloading path of the current dent, up to its largest indentation. Before yield: Hertz's curve up to the
    /// yield point.
    curve: Segment,
}

/// The springs of a contact in one direction, in a list of `N` segments.
pub type Springs<const N: usize, const LATTICE: bool = true> = SpringsOf<1, N, LATTICE>;

/// The springs of a contact in two directions, in a list of `N` segments.
pub type PlaneSprings<const N: usize, const LATTICE: bool = true> = SpringsOf<2, N, LATTICE>;

impl<L: Loading, U: Unloading, X> FrictionalModel<L, U, X> {
    /// The unloading curve of a contact whose largest indentation was `largest` \[m\].
    fn curve_below(&self, largest: f64) -> Segment {
        let yields_at = self.normal.yield_point().indentation;
        if !self.normal.loading.can_yield() || largest <= yields_at {
            return Segment { upper: yields_at, ..self.normal.loading.segment(&self.normal.pair, 0.0) };
        }
        self.normal.unloading_path(largest)
    }
}

impl<const N: usize, const LATTICE: bool> Springs<N, LATTICE> {
    /// [`SpringsOf::advance_along`] in one direction. Returns the mean tangential force \[N\] as
    /// `asked` for.
    ///
    /// # Errors
    /// [`TooDeep`] as for [`History::advance`]; the contact and the springs are then unchanged.
    #[inline]
    pub fn advance<L: Loading, U: Unloading, X>(
        &mut self,
        contact: &mut History,
        model: &FrictionalModel<L, U, X>,
        (increment, slip): (f64, f64),
        rates: (f64, f64),
        asked: Mean,
    ) -> Result<f64, TooDeep> {
        let [mean] = self.advance_along(contact, model, (increment, [slip]), (rates.0, [rates.1]), asked)?;
        Ok(mean)
    }

    /// Tangential force \[N\] at the current `indentation` \[m\].
    pub fn force(&self, friction: &Friction, indentation: f64) -> f64 {
        let [force] = self.forces(friction, indentation);
        force
    }
}

impl<const D: usize, const N: usize, const LATTICE: bool> SpringsOf<D, N, LATTICE> {
    /// The springs of a `contact` that has just started: no tangential displacement.
    pub fn start<L: Loading, U: Unloading, X>(model: &FrictionalModel<L, U, X>, contact: &History) -> Self {
        let curve = model.curve_below(contact.max_indentation());
        SpringsOf { stuck: PlayOperator::pressed(&curve, contact.indentation()), curve }
    }

    /// Moves a `contact` and its springs by `increment` along the normal and by `slip` in the tangential directions
    /// \[m\]; `rates` are these rates \[m/s\]. Returns the mean tangential force \[N\] as `asked` for.
    ///
    /// # Errors
    /// [`TooDeep`] as for [`History::advance`]; the contact and the springs are then unchanged.
    #[inline]
    pub fn advance_along<L: Loading, U: Unloading, X>(
        &mut self,
        contact: &mut History,
        model: &FrictionalModel<L, U, X>,
        (increment, slip): (f64, [f64; D]),
        rates: (f64, [f64; D]),
        asked: Mean,
    ) -> Result<[f64; D], TooDeep> {
        let from = contact.indentation();
        contact.advance(&model.normal, increment)?;
        Ok(self.follow(model, (from, contact.indentation()), (slip, [0.0; D]), rates, asked))
    }

    /// Moves the springs as [`SpringsOf::advance_along`] does, of a contact that has completed its way between these indentations \[m\].
    /// Where half of it is done, the slip is beside the straight line by `bend` \[m\].
    #[inline]
    pub(super) fn follow<L: Loading, U: Unloading, X>(
        &mut self,
        model: &FrictionalModel<L, U, X>,
        (from, to): (f64, f64),
        (slip, bend): ([f64; D], [f64; D]),
        rates: (f64, [f64; D]),
        asked: Mean,
    ) -> [f64; D] {
        let scale = model.friction.scale();
        let scaled = |lengths| times(scale, lengths);
        let way = Motion { from, to, shift: scaled(slip), normal: rates.0, tangential: scaled(rates.1) };
        let pull = self.go_along(model, (&way, scaled(bend)), asked);
        // a fresh surface forgets the dent as soon as the bodies have parted and are not below the original surface
        if model.normal.surface == Surface::Fresh && to <= 0.0 && to <= self.curve.lower {
            self.curve = model.curve_below(0.0);
        }
        times(model.friction.coefficient, pull)
    }

    /// Multiplies the limits of all springs of a contact at `indentation` \[m\] by a positive `factor`.
    pub(super) fn scale_limits(&mut self, indentation: f64, factor: f64) {
        self.stuck.scale_limits(&self.curve, indentation, factor);
    }

    /// Moves the springs along a `way` that the contact has completed: up to the growth of its dent, then over the
    /// pieces of the growth. Returns their mean force \[N\].
    fn go_along<L: Loading, U: Unloading, X>(
        &mut self,
        model: &FrictionalModel<L, U, X>,
        (way, bend): (&Motion<D>, [f64; D]),
        asked: Mean,
    ) -> [f64; D] {
        if way.to <= self.curve.upper {
            return self.move_on_curve(way, bend, asked);
        }
        let (mut here, mut sum) = (way.from, [0.0; D]);
        let rise = way.rise();
        let unit = model.normal.yield_point().indentation;
        let mut corner = unit;
        for _ in 0..MOST_PIECES {
            if here >= way.to {
                break;
            }
            let grows = here >= self.curve.upper;
            let mut end = self.curve.upper;
            if grows {
                if LATTICE && here == corner {
                    self.jump(model, here, way.to);
                }
                corner = model.normal.loading.next_corner(&model.normal.pair, here);
                let lattice = if LATTICE { next_of_lattice(here, unit) } else { f64::INFINITY };
                end = smallest(smallest(lattice, corner), way.to);
            }
            let part = (end - here) / rise;
            let piece = Motion { from: here, to: end, shift: times(part, way.shift), ..*way };
            let mean = if grows {
                self.grow(model, &piece, asked)
            } else {
                self.move_on_curve(&piece, times(part * part, bend), asked)
            };
            sum = add(sum, part, mean);
            here = end;
        }
        sum
    }

    /// Moves the springs to the path that begins at the indentation `here` \[m\]: that of the old dent may end there with another
    /// one, at yield and at corners of some laws.
    fn jump<L: Loading, U: Unloading, X>(&mut self, model: &FrictionalModel<L, U, X>, here: f64, to: f64) {
        let way = Motion::straight(here, largest(next_above(here), f64::EPSILON * to), [0.0; D]);
        let curve = model.curve_below(way.to);
        self.stuck.grow(&self.curve, &curve, &way);
        self.curve = curve;
    }

    /// Moves the springs on a `way` along the current curve. Returns their mean force \[N\].
    #[inline]
    fn move_on_curve(&mut self, way: &Motion<D>, bend: [f64; D], asked: Mean) -> [f64; D] {
        let curve = self.curve;
        let exact = asked == Mean::Exact || asked == Mean::OfEnds && self.stuck.slips_from_edge();
        let mean = if exact { self.stuck.mean_pull(&curve, way) } else { [0.0; D] };
        let before = self.stuck;
        self.stuck.advance_bent(&curve, way, bend);
        if asked == Mean::OfEnds && !exact {
            return middle(before.pull(&curve, way.from), self.stuck.pull(&curve, way.to));
        }
        mean
    }

    /// Moves the springs on a `way` with a growing dent. Returns their mean force \[N\].
    fn grow<L: Loading, U: Unloading, X>(
        &mut self,
        model: &FrictionalModel<L, U, X>,
        way: &Motion<D>,
        asked: Mean,
    ) -> [f64; D] {
        let before = *self;
        self.curve = model.curve_below(way.to);
        self.stuck.grow(&before.curve, &self.curve, way);
        match asked {
            Mean::Skipped => return [0.0; D],
            Mean::OfEnds => return middle(before.pull(way.from), self.pull(way.to)),
            Mean::Exact => (),
        }
        let tolerance = TOLERANCE * largest(before.curve.force(way.from), self.curve.force(way.to));
        mean_over(before.pull(way.from), self.pull(way.to), tolerance, |part| {
            let begun = way.first_part(part);
            before.stuck.pull_after(&before.curve, &model.curve_below(begun.to), &begun)
        })
    }

    /// The unloading path of the present dent; before yield, Hertz's curve.
    pub(super) fn curve(&self) -> Segment {
        self.curve
    }

    /// Whether springs slip only from the edge inwards, in closed form.
    pub(super) fn slips_from_edge(&self) -> bool {
        self.stuck.slips_from_edge()
    }

    /// Whether a step with held rates to this `indentation` \[m\] has an exact result.
    pub(super) fn is_exact_to(&self, indentation: f64) -> bool {
        indentation <= self.curve.upper && self.stuck.is_exact()
    }

    /// Tangential force divided by the coefficient of friction \[N\].
    fn pull(&self, indentation: f64) -> [f64; D] {
        self.stuck.pull(&self.curve, indentation)
    }

    /// Tangential force \[N\] at the current `indentation` \[m\].
    pub fn forces(&self, friction: &Friction, indentation: f64) -> [f64; D] {
        times(friction.coefficient, self.pull(indentation))
    }

    /// First and second time derivative of the tangential force \[N/s, N/s^2\] for these `rates` \[m/s\] and
    /// `accelerations` \[m/s^2\] along the normal and in the tangential directions, on the current curve. `None` if the
    /// dent grows.
    pub fn force_rates(
        &self,
        friction: &Friction,
        indentation: f64,
        rates: (f64, [f64; D]),
        accelerations: (f64, [f64; D]),
    ) -> Option<[[f64; D]; 2]> {
        if rates.0 > 0.0 && indentation >= self.curve.upper {
            return None;
        }
        let scale = friction.scale();
        let scaled = |lengths| times(scale, lengths);
        let tangential = scaled(rates.1);
        let way = Motion { from: indentation, to: indentation, shift: [0.0; D], normal: rates.0, tangential };
        let accelerations = (accelerations.0, scaled(accelerations.1));
        let rates = self.stuck.pull_rates(&self.curve, &way, accelerations);
        Some(rates.map(|pull| times(friction.coefficient, pull)))
    }

    /// Stored tangential energy \[J\] at `indentation` \[m\].
    pub fn energy(&self, friction: &Friction, indentation: f64) -> f64 {
        let scale = friction.scale();
        quotient(friction.coefficient, scale, scale > 0.0, 0.0) * self.stuck.energy(&self.curve, indentation)
    }

    /// Radius of the stick area \[m\] at `indentation` \[m\], where the law has the radius `contact_radius` \[m\]. The radius of a
    /// spring is proportional to the stiffness at its height.
    pub fn stick_radius(&self, contact_radius: f64, indentation: f64) -> f64 {
        let [stick, whole] = [self.stuck.stick_height(indentation), indentation].map(|h| self.curve.stiffness(h));
        match self.sliding() {
            Sliding::Apart | Sliding::Sliding => 0.0,
            _ => contact_radius * quotient(stick, whole, stick < whole, 1.0),
        }
    }

    /// Stiffness of the springs that stick \[N/m\], divided by the ratio of the stiffnesses; and how the tangential force grows with
    /// the indentation where those at the edge slip, divided by the coefficient of friction \[N/m\].
    pub(super) fn stiffnesses(&self, indentation: f64) -> (f64, [f64; D]) {
        let [stick, whole] = [self.stuck.stick_height(indentation), indentation].map(|h| self.curve.stiffness(h));
        (stick, times(whole - stick, self.stuck.edge()))
    }

    /// Slip state of the contact.
    pub fn sliding(&self) -> Sliding {
        self.stuck.sliding()
    }

    /// Number of segments in the list.
    pub fn segments(&self) -> usize {
        self.stuck.segments()
    }

    /// Number of words in the saved springs.
    pub const WORDS: usize = PlayOperator::<D, N>::WORDS;

    /// Passes [`SpringsOf::WORDS`] words to `store`.
    pub fn save(&self, store: &mut impl FnMut(u64)) {
        self.stuck.save(store);
    }

    /// The springs of a `contact` that [`SpringsOf::save`] has stored; `None` if a word is not a finite number.
    pub fn load<L: Loading, U: Unloading, X>(
        words: &mut impl Iterator<Item = u64>,
        model: &FrictionalModel<L, U, X>,
        contact: &History,
    ) -> Option<Self> {
        let curve = model.curve_below(contact.max_indentation());
        Some(SpringsOf { stuck: PlayOperator::load(words, &curve)?, curve })
    }
}
