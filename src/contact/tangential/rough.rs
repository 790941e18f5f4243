//! An elastoplastic contact with friction.

use super::growth_steps::next_of_lattice;
use super::{Friction, Sliding, Stuck, Way};
use crate::contact::history::{History, TooDeep};
use crate::contact::loading::Loading;
use crate::contact::numbers::smallest;
use crate::contact::segment::Segment;
use crate::contact::unloading::Unloading;
use crate::contact::{Model, Surface};

/// More pieces than a step can have: a law has a dozen corners, and the [lattice](next_of_lattice) fewer points than this between
/// the smallest indentation and the largest.
const MOST_PIECES: u32 = 10_000;

/// What is in contact, with friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughModel<L, U> {
    /// The bodies and the laws of the normal force.
    pub normal: Model<L, U>,
    /// Friction between the bodies.
    pub friction: Friction,
}

/// The tangential part of a contact with friction: its springs, of which the list has `N` segments, and the curve that they are
/// strained along. The normal contact is another value, which doesn't know of friction.
///
/// With `LATTICE` a growing dent is stepped over fixed depths, so that the result hardly depends on how its growth is divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Springs<const N: usize, const LATTICE: bool = true> {
    stuck: Stuck<N>,
    /// The unloading path of the present dent, which ends at its largest indentation; before yield Hertz's curve up to yield.
    curve: Segment,
}

impl<L: Loading, U: Unloading> RoughModel<L, U> {
    /// The curve on which the load of a contact comes off that was never deeper than `largest` \[m\].
    fn curve_below(&self, largest: f64) -> Segment {
        let yields_at = self.normal.yield_point().indentation;
        if !self.normal.loading.can_yield() || largest <= yields_at {
            return Segment { upper: yields_at, ..self.normal.loading.segment(&self.normal.pair, 0.0) };
        }
        self.normal.unloading_path(largest)
    }
}

impl<const N: usize, const LATTICE: bool> Springs<N, LATTICE> {
    /// The springs of a `contact` that has just been started: without tangential displacement.
    pub fn start<L: Loading, U: Unloading>(model: &RoughModel<L, U>, contact: &History) -> Self {
        let curve = model.curve_below(contact.max_indentation());
        Springs { stuck: Stuck::pressed(&curve, contact.indentation()), curve }
    }

    /// Moves a `contact` and its springs by `increment` along the normal and by `slip` in the tangential direction \[m\]; `rates` are
    /// the two rates \[m/s\]. The result is the mean tangential force \[N\] if it `is_asked` for, and otherwise 0.
    ///
    /// # Errors
    /// [`TooDeep`] as for [`History::advance`]; both are then as they were.
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
        // a fresh surface forgets the dent where the bodies part beyond the original surface
        if model.normal.surface == Surface::Fresh && from >= 0.0 && to < 0.0 {
            self.curve = model.curve_below(0.0);
        }
        Ok(model.friction.coefficient * pull)
    }

    /// Moves the springs on a `way` that the contact has gone: up to where its dent grows, and from there over the pieces of the
    /// growth. The result is their mean pull \[N\].
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

    /// The next corner of the loading law or point of the lattice above `indentation` \[m\].
    fn next_border<L: Loading, U: Unloading>(&self, model: &RoughModel<L, U>, indentation: f64) -> f64 {
        let corner = model.normal.loading.next_corner(&model.normal.pair, indentation);
        if LATTICE {
            smallest(next_of_lattice(indentation, model.normal.yield_point().indentation), corner)
        } else {
            corner
        }
    }

    /// Moves the springs on a `way` along the present curve, and gives their mean pull \[N\].
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

    /// Moves the springs on a `way` on which the dent grows, and gives their mean pull \[N\].
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

    /// Mean pull \[N\] over a `way` that is gone by `step`, by Simpson's rule: its middle is where a step over half of it leads.
    fn by_simpson(&self, way: &Way, step: impl Fn(&mut Self, &Way)) -> f64 {
        let (mut middle, mut end) = (*self, *self);
        let half = way.first_part(0.5);
        step(&mut middle, &half);
        step(&mut end, way);
        (self.pull(way.from) + 4.0 * middle.pull(half.to) + end.pull(way.to)) / 6.0
    }

    /// Tangential force over the coefficient of friction \[N\].
    fn pull(&self, indentation: f64) -> f64 {
        self.stuck.pull(&self.curve, indentation)
    }

    /// Tangential force \[N\] at `indentation` \[m\], where the contact is.
    pub fn force(&self, friction: &Friction, indentation: f64) -> f64 {
        friction.coefficient * self.pull(indentation)
    }

    /// Derivative of the tangential force by time \[N/s\] with these `rates` along the normal and in the tangential direction \[m/s\],
    /// on the present curve: on the loading curve of a contact that yields only in stick.
    pub fn force_rate(&self, friction: &Friction, indentation: f64, rates: (f64, f64)) -> f64 {
        let (normal, tangential) = (rates.0, friction.scale() * rates.1);
        let way = Way { from: indentation, to: indentation, shift: 0.0, normal, tangential };
        friction.coefficient * self.stuck.pull_rate(&self.curve, &way)
    }

    /// Stored tangential energy \[J\] at `indentation` \[m\].
    pub fn energy(&self, friction: &Friction, indentation: f64) -> f64 {
        friction.coefficient / friction.scale() * self.stuck.energy(&self.curve, indentation)
    }

    /// Radius of the area that doesn't slip \[m\] at `indentation` \[m\], of bodies with the effective modulus `modulus` \[Pa\].
    pub fn stick_radius(&self, modulus: f64, indentation: f64) -> f64 {
        match self.sliding() {
            Sliding::Apart => 0.0,
            _ => self.curve.stiffness(self.stuck.stick_height(indentation)) / (2.0 * modulus),
        }
    }

    /// How much of the contact slips.
    pub fn sliding(&self) -> Sliding {
        self.stuck.sliding()
    }

    /// How many segments the list has.
    pub fn segments(&self) -> usize {
        self.stuck.segments()
    }

    /// How many words the springs have.
    pub const WORDS: usize = Stuck::<N>::WORDS;

    /// Hands [`Springs::WORDS`] words to `store`.
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
