//! A contact with losses as a [`Contact`].

use super::{History, Regime, Sum, TooDeep};
use crate::Model as Plastic;
use crate::behaviour::{Contact, slopes};
use crate::history::path::RatePolynomial;
use crate::loading::Loading;
use crate::losses::{Loss, Model};
use crate::numerics::words::{load_numbers, store_numbers};
use crate::unloading::Unloading;
use crate::validity::largest_radius;
use core::borrow::Borrow;

impl<L: Loading, U: Unloading, K: Loss> Contact<Model<L, U, K>> for History<K> {
    const FOLLOWS_RATE: bool = K::FOLLOWS_RATE;
    /// The second derivative would need the third derivative of the indentation. The rate of indentation on a plate is not
    /// the input, and so no derivative follows from the input.
    const DERIVATIVES: i32 = if K::FOLLOWS_RATE { 1 } else { 0 };
    const WORDS: usize = <crate::History as Contact<Plastic<L, U>>>::WORDS + 4;

    /// Nothing: the history contains the factor.
    type Kept = ();

    fn kept(_model: &Model<L, U, K>) {}

    fn prepared(model: Model<L, U, K>, before: Option<&Model<L, U, K>>) -> Model<L, U, K> {
        Model { plastic: model.plastic.prepared_after(before.map(|before| &before.plastic)), ..model }
    }

    fn start(model: &Model<L, U, K>, gap: f64) -> Result<History<K>, TooDeep> {
        History::start(model, gap)
    }

    /// Motion without contact, from one position apart to another.
    #[inline]
    fn short_step(&mut self, increment: f64) -> bool {
        self.is_apart() && self.plastic.advance_on_branch(increment)
    }

    /// Zero: a short step has no contact.
    fn mean_force_of_short_step(&self, _from: f64) -> f64 {
        0.0
    }

    /// The rate must be constant: the inputs of these contacts have no derivatives.
    fn step<B: Borrow<Model<L, U, K>>>(
        &mut self,
        course: &RatePolynomial,
        step: f64,
        model: impl Fn() -> B,
    ) -> Result<f64, TooDeep> {
        debug_assert!(course.is_held());
        self.advance(model().borrow(), course.rate, step)?;
        Ok(self.plastic.max_indentation())
    }

    fn step_held<B: Borrow<Model<L, U, K>>>(
        &mut self,
        rate: f64,
        step: f64,
        (): &(),
        model: impl Fn() -> B,
    ) -> Result<(), TooDeep> {
        self.advance(model().borrow(), rate, step)
    }

    fn mean_force(&self, model: &Model<L, U, K>, rate: f64, step: f64) -> Result<f64, TooDeep> {
        let (_, impulse) = self.moved(model, rate, step)?;
        Ok(impulse / step)
    }

    fn stays_within(&mut self, depth: f64) -> bool {
        self.plastic.max_indentation() < depth
    }

    fn indentation(&self) -> f64 {
        self.plastic.indentation()
    }

    fn max_indentation(&self) -> f64 {
        self.plastic.max_indentation()
    }

    fn residual_indentation(&self, model: &Model<L, U, K>) -> f64 {
        self.plastic.residual_indentation(&model.plastic)
    }

    fn regime(&self) -> Regime {
        self.plastic.regime()
    }

    fn force(&self, rate: f64) -> f64 {
        History::force(self, rate)
    }

    fn damping(&self, rate: f64) -> f64 {
        History::damping(self, rate)
    }

    fn stiffness(&self, rate: f64) -> f64 {
        History::stiffness(self, rate)
    }

    fn curvature(&self, model: &Model<L, U, K>, rate: f64) -> f64 {
        slopes(self, model, |contact| contact.stiffness(rate)).0
    }

    fn contact_radius(&self, model: &Model<L, U, K>) -> f64 {
        self.plastic.contact_radius(&model.plastic)
    }

    fn contact_area(&self, model: &Model<L, U, K>) -> f64 {
        model.plastic.loading.area(&model.plastic.pair, self.plastic.contact_radius(&model.plastic))
    }

    fn elastic_energy(&self, model: &Model<L, U, K>) -> f64 {
        self.plastic.elastic_energy(&model.plastic)
    }

    /// By yield and by the loss. The latter is summed over the steps; each step is exact for its constant rate.
    fn dissipated_energy(&self, model: &Model<L, U, K>) -> f64 {
        self.plastic.dissipated_energy(&model.plastic) + self.heat.total()
    }

    fn smooth_piece(&self, model: &Model<L, U, K>) -> (f64, f64) {
        self.plastic.smooth_piece(&model.plastic)
    }

    fn moved_to(&self, model: &Model<L, U, K>, indentation: f64) -> History<K> {
        let mut moved = History { plastic: self.plastic.moved_to(&model.plastic, indentation), ..*self };
        moved.note_bend(model);
        moved
    }

    #[inline(always)]
    fn widths<B: Borrow<Model<L, U, K>>>(model: impl FnOnce() -> B, radius: f64, size: f64) -> [f64; 2] {
        if !L::has_own_widths() {
            return [largest_radius(radius, size), size];
        }
        let model = model();
        let plastic = &model.borrow().plastic;
        plastic.loading.widths(&plastic.pair, size)
    }

    fn depth_of(model: &Model<L, U, K>, contact_radius: f64) -> f64 {
        model.plastic.depth_of(contact_radius)
    }

    /// True: a heat may overflow.
    fn may_refuse(_model: &Model<L, U, K>) -> bool {
        true
    }

    fn save(&self, store: &mut impl FnMut(u64)) {
        Contact::<Plastic<L, U>>::save(&self.plastic, store);
        // the bend follows from the position
        store_numbers(&[self.factor, self.swiftest, self.heat.value, self.heat.rest], store);
    }

    fn load(words: &mut impl Iterator<Item = u64>, model: &Model<L, U, K>) -> Option<History<K>> {
        let plastic = <crate::History as Contact<Plastic<L, U>>>::load(words, &model.plastic)?;
        let [factor, swiftest, heat, rest] = load_numbers(words)?;
        let heat = Sum { value: heat, rest };
        let mut history = History { plastic, loss: model.loss, factor, swiftest, bend: 0.0, heat };
        history.note_bend(model);
        history.bend.is_finite().then_some(history)
    }
}
