//! A contact whose strength depends on the impact as a [`Contact`].

use super::{Factors, History, Model, Slow, are_factors};
use crate::behaviour::Contact;
use crate::history::path::RatePolynomial;
use crate::impact::Impact;
use crate::motion::PlasticContact;
use crate::numerics::words::{load_numbers, store_numbers};
use crate::regime::{Regime, TooDeep};
use core::borrow::Borrow;

/// Functions of the contact with constant strength, whatever it is.
macro_rules! of_contact {
    ($(fn $name:ident(&self $(, $number:ident: f64)?) -> $out:ty;)*) => {$(
        fn $name(&self $(, $number: f64)?) -> $out {
            Contact::<M>::$name(&self.contact $(, $number)?)
        }
    )*};
}

/// Functions of the contact and its model, with the strength that it has.
macro_rules! at_strength {
    ($(fn $name:ident(&self, $model:ident: &Model<M> $(, $number:ident: f64)*) -> $out:ty;)*) => {$(
        fn $name(&self, $model: &Model<M> $(, $number: f64)*) -> $out {
            self.contact.$name(&$model.at(self.factors) $(, $number)*)
        }
    )*};
}

impl<M: Slow, C: Contact<M> + PlasticContact<M>> Contact<Model<M>> for History<C> {
    const FOLLOWS_RATE: bool = C::FOLLOWS_RATE;
    const DERIVATIVES: i32 = C::DERIVATIVES;
    const WORDS: usize = C::WORDS + 4;

    const FINDS_STRENGTH: bool = true;

    /// Nothing: the motion finds what it needs.
    type Kept = ();

    fn kept(_model: &Model<M>) {}

    /// Each impact has bodies of its own.
    fn prepared(model: Model<M>, _before: Option<&Model<M>>) -> Model<M> {
        model
    }

    fn start(model: &Model<M>, gap: f64) -> Result<History<C>, TooDeep> {
        let contact = C::start(&model.slow, gap)?;
        Ok(History { contact, factors: Factors::SLOW, speed: 0.0, mass: 0.0 })
    }

    #[inline]
    fn short_step(&mut self, increment: f64) -> bool {
        Contact::<M>::short_step(&mut self.contact, increment)
    }

    fn step<B: Borrow<Model<M>>>(
        &mut self,
        course: &RatePolynomial,
        step: f64,
        model: impl Fn() -> B,
    ) -> Result<f64, TooDeep> {
        let factors = self.factors;
        self.contact.step(course, step, || model().borrow().at(factors))
    }

    fn step_held<B: Borrow<Model<M>>>(
        &mut self,
        rate: f64,
        step: f64,
        (): &(),
        model: impl Fn() -> B,
    ) -> Result<(), TooDeep> {
        let model = model().borrow().at(self.factors);
        self.contact.step_held(rate, step, &C::kept(&model), || model)
    }

    fn stays_within(&mut self, depth: f64) -> bool {
        Contact::<M>::stays_within(&mut self.contact, depth)
    }

    of_contact! {
        fn mean_force_of_short_step(&self, from: f64) -> f64;
        fn indentation(&self) -> f64;
        fn max_indentation(&self) -> f64;
        fn regime(&self) -> Regime;
        fn force(&self, rate: f64) -> f64;
        fn damping(&self, rate: f64) -> f64;
        fn stiffness(&self, rate: f64) -> f64;
    }

    at_strength! {
        fn mean_force(&self, model: &Model<M>, rate: f64, step: f64) -> Result<f64, TooDeep>;
        fn residual_indentation(&self, model: &Model<M>) -> f64;
        fn curvature(&self, model: &Model<M>, rate: f64) -> f64;
        fn contact_radius(&self, model: &Model<M>) -> f64;
        fn elastic_energy(&self, model: &Model<M>) -> f64;
        fn dissipated_energy(&self, model: &Model<M>) -> f64;
        fn work(&self, model: &Model<M>) -> f64;
        fn smooth_piece(&self, model: &Model<M>) -> (f64, f64);
    }

    fn moved_to(&self, model: &Model<M>, indentation: f64) -> History<C> {
        History { contact: self.contact.moved_to(&model.at(self.factors), indentation), ..*self }
    }

    fn meet(&mut self, model: &Model<M>, mass: f64, rate: f64) {
        let plastic = self.contact.plastic();
        let may_touch = plastic.regime() == Regime::Apart && rate > 0.0;
        if may_touch && self.plastic_model(model).is_elastic_at(plastic.max_indentation()) {
            // where it can't be found, the strength does not change
            let _ = self.strengthen(model, &Impact { mass, speed: rate });
        }
    }

    /// That of the target under a slow load, which is the smaller one.
    fn depth_of(model: &Model<M>, contact_radius: f64) -> f64 {
        C::depth_of(&model.slow, contact_radius)
    }

    fn may_refuse(model: &Model<M>) -> bool {
        C::may_refuse(&model.slow)
    }

    fn save(&self, store: &mut impl FnMut(u64)) {
        store_numbers(&[self.factors.softer, self.factors.harder, self.speed, self.mass], store);
        Contact::<M>::save(&self.contact, store);
    }

    fn load(words: &mut impl Iterator<Item = u64>, model: &Model<M>) -> Option<History<C>> {
        let [softer, harder, speed, mass] = load_numbers(words)?;
        let factors = Factors { softer, harder };
        let contact = are_factors(factors).then(|| C::load(words, &model.at(factors)))??;
        Some(History { contact, factors, speed, mass })
    }
}
