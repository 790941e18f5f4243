//! An elastoplastic contact with friction.

use super::growth_steps::next_of_lattice;
use super::{Friction, Sliding, Stuck, Way};
use crate::contact::history::{History, TooDeep};
use crate::contact::loading::Loading;
use crate::contact::numbers::{quotient, smallest};
use crate::contact::segment::Segment;
use crate::contact::unloading::Unloading;
use crate::contact::{Model, Surface};

/// More pieces than a step can have. A law has a dozen corners. The [lattice](next_of_lattice) has fewer points than
/// this between the smallest and the largest indentation.
const MOST_PIECES: u32 = 10_000;

/// The parameters of a contact with friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughModel<L, U> {
    /// The bodies and the laws of the normal force.
    pub normal: Model<L, U>,
    /// Friction between the bodies.
    pub friction: Friction,
}

/// The tangential part of a contact with friction: its springs, in a list of `N` segments, and their
/// force-indentation curve. The normal contact is a separate value that does not know about friction.
///
/// With `LATTICE`, a growing dent is divided at fixed depths. The result then hardly depends on the time steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Springs<const N: usize, const LATTICE: bool = true> {
    stuck: Stuck<N>,
    /// The unloading path of the current dent, up to its largest indentation. Before yield: Hertz's curve up to the
    /// yield point.
    curve: Segment,
}

impl<L: Loading, U: Unloading> RoughModel<L, U> {
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
    /// The springs of a `contact` that has just started: no tangential displacement.
    pub fn start<L: Loading, U: Unloading>(model: &RoughModel<L, U>, contact: &History) -> Self {
        let curve = model.curve_below(contact.max_indentation());
        Springs { stuck: Stuck::pressed(&curve, contact.indentation()), curve }
    }

    /// Moves a `contact` and its springs by `increment` along the normal and by `slip` in the tangential direction
    /// \[m\]; `rates` are the two rates \[m/s\]. Returns the mean tangential force \[N\] if it `is_asked` for,
    /// otherwise 0.
    ///
    /// # Errors
    /// [`TooDeep`] as for [`History::advance`]; the contact and the springs are then unchanged.
    #[inline]
    pub fn advance<L: Loading, U: Unloading>(
        &mut self,
        contact: &mut History,
        model: &RoughModel<L, U>,
        (increment, slip): (f64, f64),
        rates: (f64, f64),
        is_asked: bool,
    ) -> Result<f64, TooDeep> {
        let from = contact.indentation();
        contact.advance(&model.normal, increment)?;
        let to = contact.indentation();
        let scale = model.friction.scale();
        let way = Way { from, to, shift: scale * slip, normal: rates.0, tangential: scale * rates.1 };
        let pull = self.follow(model, &way, is_asked);
        // a fresh surface forgets the dent once the bodies separate beyond the original surface
        if model.normal.surface == Surface::Fresh && from >= 0.0 && to < 0.0 {
            self.curve = model.curve_below(0.0);
        }
        Ok(model.friction.coefficient * pull)
    }

    /// Moves the springs along a `way` that the contact has completed: up to the growth of its dent, then over the
    /// pieces of the growth. Returns their mean force \[N\].
    fn follow<L: Loading, U: Unloading>(&mut self, model: &RoughModel<L, U>, way: &Way, is_asked: bool) -> f64 {
        if way.to <= self.curve.upper {
            return self.move_on_curve(way, is_asked);
        }
        let (mut here, mut sum) = (way.from, 0.0);
        let rise = way.rise();
        for _ in 0..MOST_PIECES {
            if here >= way.to {
                break;
            }
            let grows = here >= self.curve.upper;
            let end = if grows { smallest(self.next_border(model, here), way.to) } else { self.curve.upper };
            let part = (end - here) / rise;
            let piece = Way { from: here, to: end, shift: part * way.shift, ..*way };
            sum += part * if grows { self.grow(model, &piece, is_asked) } else { self.move_on_curve(&piece, is_asked) };
            here = end;
        }
        sum
    }

    /// The next corner of the loading law or lattice point above `indentation` \[m\].
    fn next_border<L: Loading, U: Unloading>(&self, model: &RoughModel<L, U>, indentation: f64) -> f64 {
        let corner = model.normal.loading.next_corner(&model.normal.pair, indentation);
        if LATTICE {
            smallest(next_of_lattice(indentation, model.normal.yield_point().indentation), corner)
        } else {
            corner
        }
    }

    /// Moves the springs on a `way` along the current curve. Returns their mean force \[N\].
    #[inline]
    fn move_on_curve(&mut self, way: &Way, is_asked: bool) -> f64 {
        let curve = self.curve;
        if !is_asked {
            self.stuck.settle(&curve, way);
            return 0.0;
        }
        if self.stuck.is_within_cones() {
            let mean = self.stuck.mean_pull(&curve, way);
            self.stuck.advance(&curve, way);
            return mean;
        }
        let part = way.part_above(curve.lower);
        let way_down = if way.to < curve.lower { way.first_part(part) } else { *way };
        let mean = self.by_simpson(&way_down, |springs, way| springs.stuck.settle(&curve, way));
        self.stuck.settle(&curve, way);
        part * mean
    }

    /// Moves the springs on a `way` with a growing dent. Returns their mean force \[N\].
    fn grow<L: Loading, U: Unloading>(&mut self, model: &RoughModel<L, U>, way: &Way, is_asked: bool) -> f64 {
        let step = |springs: &mut Self, way: &Way| {
            let new = model.curve_below(way.to);
            springs.stuck.grow(&springs.curve, &new, way);
            springs.curve = new;
        };
        let mean = if is_asked { self.by_simpson(way, step) } else { 0.0 };
        step(self, way);
        mean
    }

    /// Mean force \[N\] over a `way` taken by `step`, by Simpson's rule. The middle point results from a step over
    /// half of the way.
    fn by_simpson(&self, way: &Way, step: impl Fn(&mut Self, &Way)) -> f64 {
        let (mut middle, mut end) = (*self, *self);
        let half = way.first_part(0.5);
        step(&mut middle, &half);
        step(&mut end, way);
        (self.pull(way.from) + 4.0 * middle.pull(half.to) + end.pull(way.to)) / 6.0
    }

    /// Tangential force divided by the coefficient of friction \[N\].
    fn pull(&self, indentation: f64) -> f64 {
        self.stuck.pull(&self.curve, indentation)
    }

    /// Tangential force \[N\] at the current `indentation` \[m\].
    pub fn force(&self, friction: &Friction, indentation: f64) -> f64 {
        friction.coefficient * self.pull(indentation)
    }

    /// First and second time derivative of the tangential force \[N/s, N/s^2\] for these `rates` \[m/s\] and
    /// `accelerations` \[m/s^2\] along the normal and in the tangential direction, on the current curve. `None` if the
    /// dent grows.
    pub fn force_rates(
        &self,
        friction: &Friction,
        indentation: f64,
        rates: (f64, f64),
        accelerations: (f64, f64),
    ) -> Option<(f64, f64)> {
        if rates.0 > 0.0 && indentation >= self.curve.upper {
            return None;
        }
        let scale = friction.scale();
        let way = Way { from: indentation, to: indentation, shift: 0.0, normal: rates.0, tangential: scale * rates.1 };
        let accelerations = (accelerations.0, scale * accelerations.1);
        let (first, second) = self.stuck.pull_rates(&self.curve, &way, accelerations);
        Some((friction.coefficient * first, friction.coefficient * second))
    }

    /// Stored tangential energy \[J\] at `indentation` \[m\].
    pub fn energy(&self, friction: &Friction, indentation: f64) -> f64 {
        let scale = friction.scale();
        quotient(friction.coefficient, scale, scale > 0.0, 0.0) * self.stuck.energy(&self.curve, indentation)
    }

    /// Radius of the stick area \[m\] at `indentation` \[m\], for the effective modulus `modulus` \[Pa\].
    pub fn stick_radius(&self, modulus: f64, indentation: f64) -> f64 {
        match self.sliding() {
            Sliding::Apart => 0.0,
            _ => self.curve.stiffness(self.stuck.stick_height(indentation)) / (2.0 * modulus),
        }
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
    pub const WORDS: usize = Stuck::<N>::WORDS;

    /// Passes [`Springs::WORDS`] words to `store`.
    pub fn save(&self, store: &mut impl FnMut(u64)) {
        self.stuck.save(store);
    }

    /// The springs of a `contact` that [`Springs::save`] has stored; `None` if a word is not a finite number.
    pub fn load<L: Loading, U: Unloading>(
        words: &mut impl Iterator<Item = u64>,
        model: &RoughModel<L, U>,
        contact: &History,
    ) -> Option<Self> {
        let curve = model.curve_below(contact.max_indentation());
        Some(Springs { stuck: Stuck::load(words, &curve)?, curve })
    }
}
