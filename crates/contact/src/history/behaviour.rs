//! An elastoplastic contact as a [`Contact`].

use super::momentum;
use super::{History, LARGEST_INDENTATION, Regime, Sum, TooDeep};
use crate::Model;
use crate::behaviour::Contact;
use crate::history::path::RatePolynomial;
use crate::loading::Loading;
use crate::material::YieldPoint;
use crate::numerics::largest;
use crate::segment::Segment;
use crate::unloading::Unloading;
use crate::validity::largest_radius;
use core::borrow::Borrow;

impl<L: Loading, U: Unloading> Contact<Model<L, U>> for History {
    const FOLLOWS_RATE: bool = false;
    const DERIVATIVES: i32 = 2;
    const WORDS: usize = 13;

    /// The yield point.
    type Kept = YieldPoint;

    fn kept(model: &Model<L, U>) -> YieldPoint {
        model.yield_point()
    }

    fn prepared(model: Model<L, U>, before: Option<&Model<L, U>>) -> Model<L, U> {
        model.prepared_after(before)
    }

    fn start(model: &Model<L, U>, gap: f64) -> Result<History, TooDeep> {
        History::start(model, gap)
    }

    #[inline(always)]
    fn short_step(&mut self, increment: f64) -> bool {
        self.advance_on_branch(increment)
    }

    #[inline]
    fn mean_force_of_short_step(&self, from: f64) -> f64 {
        self.segment.mean_force(from, self.indentation())
    }

    #[inline]
    fn step<B: Borrow<Model<L, U>>>(
        &mut self,
        course: &RatePolynomial,
        step: f64,
        model: impl Fn() -> B,
    ) -> Result<f64, TooDeep> {
        let (mut moved, mut deepest) = (*self, 0.0);
        for increment in course.motions(step) {
            if !moved.advance_on_branch(increment) {
                moved.find_branch(model().borrow(), increment)?;
            }
            deepest = largest(moved.max_indentation(), deepest);
        }
        *self = moved;
        Ok(deepest)
    }

    fn step_with_mean_force<B: Borrow<Model<L, U>>>(
        &mut self,
        course: &RatePolynomial,
        step: f64,
        model: impl Fn() -> B,
    ) -> Result<(f64, f64), TooDeep> {
        if model().borrow().is_segmented() {
            let (deepest, impulse) = self.advance_along(course, step, model)?;
            return Ok((deepest, impulse / step));
        }
        let impulse = momentum::impulse_by_pieces(self, model().borrow(), course, step)?;
        Ok((self.step(course, step, model)?, impulse / step))
    }

    #[inline(always)]
    fn step_held<B: Borrow<Model<L, U>>>(
        &mut self,
        rate: f64,
        step: f64,
        kept: &YieldPoint,
        model: impl Fn() -> B,
    ) -> Result<(), TooDeep> {
        let increment = rate * step;
        // this step may also stay on its branch, where `go_to_next_branch` finds nothing
        if self.go_to_next_branch(increment, kept, &model) { Ok(()) } else { self.advance(model().borrow(), increment) }
    }

    fn mean_force(&self, model: &Model<L, U>, rate: f64, step: f64) -> Result<f64, TooDeep> {
        Ok(momentum::impulse_by_pieces(self, model, &RatePolynomial::held(rate), step)? / step)
    }

    /// Ends the present branch at `depth` if it extends beyond. A step that reaches this depth then evaluates its branch again.
    /// It finds the same one, and nothing else changes.
    #[inline]
    fn stays_within(&mut self, depth: f64) -> bool {
        let within = self.max_indentation() < depth;
        if within && depth < self.segment.upper {
            self.segment.upper = depth;
        }
        within
    }

    #[inline]
    fn indentation(&self) -> f64 {
        self.indentation.total()
    }

    fn max_indentation(&self) -> f64 {
        History::max_indentation(self)
    }

    fn residual_indentation(&self, model: &Model<L, U>) -> f64 {
        History::residual_indentation(self, model)
    }

    fn regime(&self) -> Regime {
        self.regime
    }

    #[inline(always)]
    fn force(&self, _rate: f64) -> f64 {
        self.force_at::<L, U>(self.indentation.total())
    }

    fn damping(&self, _rate: f64) -> f64 {
        0.0
    }

    fn stiffness(&self, _rate: f64) -> f64 {
        History::stiffness(self)
    }

    fn curvature(&self, model: &Model<L, U>, _rate: f64) -> f64 {
        History::curvature(self, model)
    }

    fn contact_radius(&self, model: &Model<L, U>) -> f64 {
        History::contact_radius(self, model)
    }

    fn contact_area(&self, model: &Model<L, U>) -> f64 {
        model.loading.area(&model.pair, History::contact_radius(self, model))
    }

    fn elastic_energy(&self, model: &Model<L, U>) -> f64 {
        History::elastic_energy(self, model)
    }

    fn dissipated_energy(&self, model: &Model<L, U>) -> f64 {
        History::dissipated_energy(self, model)
    }

    fn smooth_piece(&self, model: &Model<L, U>) -> (f64, f64) {
        let indentation = self.indentation.total();
        match self.regime {
            _ if self.is_loading() => (indentation, model.loading.next_corner(&model.pair, indentation)),
            // a chain is smooth on each of its segments
            Regime::Unloaded | Regime::Elastic if self.is_in_chain(model) => (self.segment.lower, self.segment.upper),
            Regime::Unloaded => (model.unloading_path(self.max_indentation).lower, self.max_indentation),
            _ if !model.has_elastic_segment() => (0.0, LARGEST_INDENTATION),
            _ => (0.0, self.segment.upper),
        }
    }

    fn moved_to(&self, model: &Model<L, U>, indentation: f64) -> History {
        let mut moved = *self;
        if self.is_loading() {
            // on the loading curve the new indentation may also be smaller
            moved.max_indentation = 0.0;
            moved.indentation = Sum::new(0.0);
        }
        // where the law has ended there is no neighbour
        if moved.enter(model, indentation, self.is_loading()).is_err() {
            return *self;
        }
        moved.indentation = Sum::new(indentation);
        moved
    }

    #[inline(always)]
    fn widths<B: Borrow<Model<L, U>>>(model: impl FnOnce() -> B, radius: f64, size: f64) -> [f64; 2] {
        if !L::has_own_widths() {
            return [largest_radius(radius, size), size];
        }
        let model = model();
        let Model { loading, pair, .. } = model.borrow();
        loading.widths(pair, size)
    }

    fn depth_of(model: &Model<L, U>, contact_radius: f64) -> f64 {
        model.depth_of(contact_radius)
    }

    fn may_refuse(model: &Model<L, U>) -> bool {
        !model.loading.is_segmented()
    }

    /// Copied number by number, in memory order. A compiler that optimizes for size would otherwise choose the slowest
    /// instruction for the copy.
    #[inline(always)]
    fn copy_from(&mut self, other: &History) {
        let Sum { value, rest } = other.indentation;
        let Segment { lower, upper, origin, constant, linear, power, square } = other.segment;
        let (least_increment, max_indentation) = (other.least_increment, other.max_indentation);
        let (left_behind, regime) = (other.left_behind, other.regime);
        (self.indentation.value, self.indentation.rest, self.least_increment) = (value, rest, least_increment);
        (self.segment.lower, self.segment.upper, self.segment.origin) = (lower, upper, origin);
        (self.segment.constant, self.segment.linear) = (constant, linear);
        (self.segment.power, self.segment.square, self.max_indentation) = (power, square, max_indentation);
        (self.left_behind, self.regime) = (left_behind, regime);
    }

    fn save(&self, store: &mut impl FnMut(u64)) {
        self.save_words(store);
    }

    fn load(words: &mut impl Iterator<Item = u64>, _model: &Model<L, U>) -> Option<History> {
        History::of_words(words)
    }
}
