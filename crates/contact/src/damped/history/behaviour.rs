//! A rate-dependent contact as a [`Contact`].

use super::{Damped, Factors, History, Model, Regime, Sum, TooDeep, within};
use crate::behaviour::{Contact, slopes};
use crate::path::Course;
use crate::regime::LARGEST_INDENTATION;
use crate::words::{load_numbers, store_numbers};
use core::borrow::Borrow;

impl<D: Damped + Copy> Contact<Model<D>> for History<D> {
    const FOLLOWS_RATE: bool = true;
    /// The second derivative would need the third derivative of the indentation.
    const DERIVATIVES: i32 = 1;
    const WORDS: usize = 8;

    /// Nothing: the history contains the factors.
    type Kept = ();

    fn kept(_model: &Model<D>) {}

    fn prepared(model: Model<D>, _before: Option<&Model<D>>) -> Model<D> {
        model
    }

    fn start(model: &Model<D>, gap: f64) -> Result<History<D>, TooDeep> {
        History::start(model, gap)
    }

    /// Motion without contact, from one position apart to another.
    #[inline]
    fn short_step(&mut self, increment: f64) -> bool {
        let sum = self.indentation.plus(increment);
        let flies = self.indentation.total() <= 0.0 && sum.total() <= 0.0 && within(sum.total()).is_ok();
        if flies {
            self.indentation = sum;
        }
        flies
    }

    /// Zero: a short step has no contact.
    fn mean_force_of_short_step(&self, _from: f64) -> f64 {
        0.0
    }

    /// The rate must be constant: the inputs of these laws have no derivatives.
    fn step<B: Borrow<Model<D>>>(
        &mut self,
        course: &Course,
        step: f64,
        _model: impl Fn() -> B,
    ) -> Result<f64, TooDeep> {
        debug_assert!(course.is_held());
        self.advance(course.rate, step)?;
        Ok(self.max_indentation)
    }

    fn step_held<B: Borrow<Model<D>>>(
        &mut self,
        rate: f64,
        step: f64,
        (): &(),
        _model: impl Fn() -> B,
    ) -> Result<(), TooDeep> {
        self.advance(rate, step)
    }

    fn mean_force(&self, _model: &Model<D>, rate: f64, step: f64) -> Result<f64, TooDeep> {
        let mean = History::mean_force(self, rate, step);
        // a step that cannot be taken has no mean force
        within(self.indentation.total() + rate * step)?;
        Ok(mean)
    }

    /// True: short steps have no contact and reach no depth.
    fn stays_within(&mut self, depth: f64) -> bool {
        self.max_indentation < depth
    }

    fn indentation(&self) -> f64 {
        self.indentation.total()
    }

    fn max_indentation(&self) -> f64 {
        self.max_indentation
    }

    /// Zero: these laws leave no dent.
    fn residual_indentation(&self, _model: &Model<D>) -> f64 {
        0.0
    }

    fn regime(&self) -> Regime {
        History::regime(self)
    }

    fn force(&self, rate: f64) -> f64 {
        History::force(self, rate)
    }

    fn damping(&self, rate: f64) -> f64 {
        if !self.pushes(rate) {
            return 0.0;
        }
        // without a touch speed, any closing rate gives the same force
        self.damping_force(1.0) * self.law.damping(self.indentation.total()).value
    }

    fn stiffness(&self, rate: f64) -> f64 {
        History::stiffness(self, rate)
    }

    fn curvature(&self, model: &Model<D>, rate: f64) -> f64 {
        slopes(self, model, |contact| contact.stiffness(rate)).0
    }

    fn contact_radius(&self, model: &Model<D>) -> f64 {
        History::contact_radius(self, model)
    }

    fn elastic_energy(&self, _model: &Model<D>) -> f64 {
        self.stored()
    }

    /// Summed over the steps. Each step is exact for its constant rate.
    fn dissipated_energy(&self, _model: &Model<D>) -> f64 {
        self.dissipated.total()
    }

    /// The interval between two borders of the law that contains the indentation. The surface also counts as a border.
    fn smooth_piece(&self, _model: &Model<D>) -> (f64, f64) {
        let indentation = self.indentation.total();
        let borders = self.law.borders();
        let below = borders.into_iter().rfind(|&border| border <= indentation).unwrap_or(0.0);
        let above = borders.into_iter().find(|&border| border > indentation).unwrap_or(LARGEST_INDENTATION);
        (below, above)
    }

    fn moved_to(&self, _model: &Model<D>, indentation: f64) -> History<D> {
        History { indentation: Sum::new(indentation), ..*self }
    }

    fn depth_of(model: &Model<D>, contact_radius: f64) -> f64 {
        model.depth_of(contact_radius)
    }

    /// True: a large damping or heat may overflow.
    fn may_refuse(_model: &Model<D>) -> bool {
        true
    }

    fn save(&self, store: &mut impl FnMut(u64)) {
        let Factors { elastic, damping } = self.factors;
        let (Sum { value, rest }, heat) = (self.indentation, self.dissipated);
        // saved numbers must be finite; no touch speed is zero, so zero means that there was no touch
        let touch_speed = if self.touch_speed < f64::INFINITY { self.touch_speed } else { 0.0 };
        let numbers = [value, rest, self.max_indentation, touch_speed, heat.value, heat.rest, elastic, damping];
        store_numbers(&numbers, store);
    }

    fn load(words: &mut impl Iterator<Item = u64>, model: &Model<D>) -> Option<History<D>> {
        let [value, rest, max_indentation, touch_speed, heat, heat_rest, elastic, damping] = load_numbers(words)?;
        Some(History {
            law: model.law,
            indentation: Sum { value, rest },
            max_indentation,
            touch_speed: if touch_speed == 0.0 { f64::INFINITY } else { touch_speed },
            dissipated: Sum { value: heat, rest: heat_rest },
            factors: Factors { elastic, damping },
        })
    }
}
