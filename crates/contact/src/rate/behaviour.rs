//! A contact whose strength depends on the impact as a [`Contact`].

use super::{Factors, History, Model, are_factors};
use crate::behaviour::Contact;
use crate::history;
use crate::impact::Impact;
use crate::loading::Loading;
use crate::path::Course;
use crate::regime::{Regime, TooDeep};
use crate::unloading::Unloading;
use crate::words::{load_numbers, store_numbers};
use core::borrow::Borrow;

/// The contact with constant strength has this model.
type Plastic<L, U> = crate::Model<L, U>;

impl<L: Loading + Copy, U: Unloading + Copy> Contact<Model<L, U>> for History {
    const FOLLOWS_RATE: bool = false;
    const DERIVATIVES: i32 = <history::History as Contact<Plastic<L, U>>>::DERIVATIVES;
    const WORDS: usize = <history::History as Contact<Plastic<L, U>>>::WORDS + 4;

    const FINDS_STRENGTH: bool = true;

    /// Nothing: the motion finds what it needs.
    type Kept = ();

    fn kept(_model: &Model<L, U>) {}

    /// Each impact has bodies of its own.
    fn prepared(model: Model<L, U>, _before: Option<&Model<L, U>>) -> Model<L, U> {
        model
    }

    fn start(model: &Model<L, U>, gap: f64) -> Result<History, TooDeep> {
        History::start(model, gap)
    }

    #[inline]
    fn short_step(&mut self, increment: f64) -> bool {
        Contact::<Plastic<L, U>>::short_step(&mut self.plastic, increment)
    }

    fn mean_force_of_short_step(&self, from: f64) -> f64 {
        Contact::<Plastic<L, U>>::mean_force_of_short_step(&self.plastic, from)
    }

    fn step<B: Borrow<Model<L, U>>>(
        &mut self,
        course: &Course,
        step: f64,
        model: impl Fn() -> B,
    ) -> Result<f64, TooDeep> {
        let factors = self.factors;
        self.plastic.step(course, step, || model().borrow().at(factors))
    }

    fn step_held<B: Borrow<Model<L, U>>>(
        &mut self,
        rate: f64,
        step: f64,
        (): &(),
        model: impl Fn() -> B,
    ) -> Result<(), TooDeep> {
        self.plastic.advance(&model().borrow().at(self.factors), rate * step)
    }

    fn mean_force(&self, model: &Model<L, U>, rate: f64, step: f64) -> Result<f64, TooDeep> {
        self.plastic.mean_force(&model.at(self.factors), rate, step)
    }

    fn stays_within(&mut self, depth: f64) -> bool {
        Contact::<Plastic<L, U>>::stays_within(&mut self.plastic, depth)
    }

    fn indentation(&self) -> f64 {
        self.plastic.indentation()
    }

    fn max_indentation(&self) -> f64 {
        self.plastic.max_indentation()
    }

    fn residual_indentation(&self, model: &Model<L, U>) -> f64 {
        self.plastic.residual_indentation(&model.at(self.factors))
    }

    fn regime(&self) -> Regime {
        self.plastic.regime()
    }

    fn force(&self, rate: f64) -> f64 {
        Contact::<Plastic<L, U>>::force(&self.plastic, rate)
    }

    fn damping(&self, _rate: f64) -> f64 {
        0.0
    }

    fn stiffness(&self, _rate: f64) -> f64 {
        self.plastic.stiffness()
    }

    fn curvature(&self, model: &Model<L, U>, _rate: f64) -> f64 {
        self.plastic.curvature(&model.at(self.factors))
    }

    fn contact_radius(&self, model: &Model<L, U>) -> f64 {
        self.plastic.contact_radius(&model.at(self.factors))
    }

    fn elastic_energy(&self, model: &Model<L, U>) -> f64 {
        self.plastic.elastic_energy(&model.at(self.factors))
    }

    fn dissipated_energy(&self, model: &Model<L, U>) -> f64 {
        self.plastic.dissipated_energy(&model.at(self.factors))
    }

    fn smooth_piece(&self, model: &Model<L, U>) -> (f64, f64) {
        self.plastic.smooth_piece(&model.at(self.factors))
    }

    fn moved_to(&self, model: &Model<L, U>, indentation: f64) -> History {
        History { plastic: self.plastic.moved_to(&model.at(self.factors), indentation), ..*self }
    }

    fn meet(&mut self, model: &Model<L, U>, mass: f64, rate: f64) {
        History::meet(self, model, &Impact { mass, speed: rate });
    }

    /// That of the target under a slow load, which is the smaller one.
    fn depth_of(model: &Model<L, U>, contact_radius: f64) -> f64 {
        model.slow.depth_of(contact_radius)
    }

    fn may_refuse(model: &Model<L, U>) -> bool {
        <history::History as Contact<Plastic<L, U>>>::may_refuse(&model.slow)
    }

    fn save(&self, store: &mut impl FnMut(u64)) {
        Contact::<Plastic<L, U>>::save(&self.plastic, store);
        store_numbers(&[self.factors.softer, self.factors.harder, self.speed, self.mass], store);
    }

    fn load(words: &mut impl Iterator<Item = u64>, model: &Model<L, U>) -> Option<History> {
        let plastic = <history::History as Contact<Plastic<L, U>>>::load(words, &model.slow)?;
        let [softer, harder, speed, mass] = load_numbers(words)?;
        let factors = Factors { softer, harder };
        are_factors(factors).then_some(History { plastic, factors, speed, mass })
    }
}
