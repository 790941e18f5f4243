//! A contact with friction as a [`Contact`]: a normal contact, its springs, and the tangential rate.

use super::{RoughModel, Sliding, Springs};
use crate::contact::Model;
use crate::contact::behaviour::Contact;
use crate::contact::history::{History, Regime, TooDeep};
use crate::contact::loading::Loading;
use crate::contact::material::YieldPoint;
use crate::contact::numbers::largest;
use crate::contact::path::{Course, Sum};
use crate::contact::unloading::Unloading;
use crate::contact::words::{load_numbers, store_numbers};
use core::borrow::Borrow;

/// An elastoplastic contact with friction, whose springs form a list of `N` segments.
///
/// The tangential rate is an input that holds until it is set again. Every step follows both rates. There is no
/// [short step](Contact::short_step).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughContact<const N: usize> {
    normal: History,
    springs: Springs<N>,
    /// \[m/s\]
    tangential_rate: f64,
    /// Mean tangential force of the last step \[N\].
    mean_force: f64,
    /// \[N.s\]
    impulse: Sum,
    /// Work of the tangential force \[J\].
    work: Sum,
}

impl<const N: usize> RoughContact<N> {
    /// The normal contact.
    pub fn normal(&self) -> &History {
        &self.normal
    }

    /// Relative tangential speed of the two contact points \[m/s\], for a ball `v + omega R`.
    pub fn tangential_rate(&self) -> f64 {
        self.tangential_rate
    }

    /// Sets the tangential rate \[m/s\] for the next steps; a finite number.
    pub fn set_tangential_rate(&mut self, rate: f64) {
        self.tangential_rate = rate;
    }

    /// Tangential force \[N\]; positive against a positive rate.
    pub fn tangential_force<L: Loading, U: Unloading>(&self, model: &RoughModel<L, U>) -> f64 {
        self.springs.force(&model.friction, self.normal.indentation())
    }

    /// Mean tangential force of the last step \[N\].
    pub fn mean_tangential_force(&self) -> f64 {
        self.mean_force
    }

    /// Integral of the tangential force since the start \[N.s\].
    pub fn tangential_impulse(&self) -> f64 {
        self.impulse.total()
    }

    /// Tangential force \[N\] at the end of a step that is yet to come, with this `rate` of the indentation \[m/s\]
    /// and the current tangential rate.
    ///
    /// # Errors
    /// As for [`Contact::step`].
    pub fn predicted_tangential_force<L: Loading, U: Unloading>(
        &self,
        model: &RoughModel<L, U>,
        rate: f64,
        step: f64,
    ) -> Result<f64, TooDeep> {
        let mut moved = *self;
        moved.step(&Course::held(rate), step, || model)?;
        Ok(moved.tangential_force(model))
    }

    /// Elastic energy of the tangential strain \[J\].
    pub fn tangential_energy<L: Loading, U: Unloading>(&self, model: &RoughModel<L, U>) -> f64 {
        self.springs.energy(&model.friction, self.normal.indentation())
    }

    /// Energy lost by slip since the start \[J\].
    pub fn friction_work<L: Loading, U: Unloading>(&self, model: &RoughModel<L, U>) -> f64 {
        self.work.total() - self.tangential_energy(model)
    }

    /// Radius of the stick area \[m\].
    pub fn stick_radius<L: Loading, U: Unloading>(&self, model: &RoughModel<L, U>) -> f64 {
        self.springs.stick_radius(model.normal.pair.modulus, self.normal.indentation())
    }

    /// How much of the contact slips.
    pub fn sliding(&self) -> Sliding {
        self.springs.sliding()
    }
}

/// End times \[s\] of the parts of a step in which the contact either slips in one direction or sticks, as far as the
/// rates alone show it; unsorted. They are the times at which the rate of the indentation is zero or as large as the
/// `scaled` tangential rate \[m/s\]. The last one is the end of the step.
fn ends_of_parts(course: &Course, scaled: f64, step: f64) -> [[f64; 3]; 3] {
    [0.0, scaled, -scaled].map(|rate| Course { rate: course.rate - rate, ..*course }.monotone_ends(step))
}

/// The earliest of `ends` after `time` \[s\].
fn next_of(ends: &[[f64; 3]; 3], time: f64) -> Option<f64> {
    let behind = ends.as_flattened().iter().copied().filter(|&end| end > time);
    behind.reduce(|one, other| if other < one { other } else { one })
}

impl<L: Loading, U: Unloading, const N: usize> Contact<RoughModel<L, U>> for RoughContact<N> {
    const FOLLOWS_RATE: bool = false;
    const DERIVATIVES: i32 = 2;
    const WORDS: usize = 13 + Springs::<N>::WORDS + 6;

    /// Where the contact begins to yield.
    type Kept = YieldPoint;

    fn kept(model: &RoughModel<L, U>) -> YieldPoint {
        model.normal.yield_point()
    }

    fn start(model: &RoughModel<L, U>, gap: f64) -> Result<Self, TooDeep> {
        let normal = History::start(&model.normal, gap)?;
        let springs = Springs::start(model, &normal);
        let none = Sum::new(0.0);
        Ok(RoughContact { normal, springs, tangential_rate: 0.0, mean_force: 0.0, impulse: none, work: none })
    }

    /// Always false: the springs follow each step.
    #[inline(always)]
    fn short_step(&mut self, _increment: f64) -> bool {
        false
    }

    fn mean_force_of_short_step(&self, from: f64) -> f64 {
        Contact::<Model<L, U>>::mean_force_of_short_step(&self.normal, from)
    }

    /// A course with a changing rate is divided where springs may begin to stick or to slip. Each part counts as
    /// straight. Slip is then exact at the end of a part; stick is of second order in the length of the part.
    fn step<B: Borrow<RoughModel<L, U>>>(
        &mut self,
        course: &Course,
        step: f64,
        model: impl Fn() -> B,
    ) -> Result<f64, TooDeep> {
        let model = model();
        let model = model.borrow();
        let (mut moved, mut deepest, mut start) = (*self, 0.0, 0.0);
        let (mut impulse, mut work) = (0.0, 0.0);
        let ends = ends_of_parts(course, model.friction.scale() * self.tangential_rate, step);
        for _ in 0..ends.as_flattened().len() {
            let Some(end) = next_of(&ends, start) else { break };
            let (increment, slip) = (course.way(end) - course.way(start), self.tangential_rate * (end - start));
            // within a divided step the ratio of the held rates is the same to the last bit
            let rates = if course.is_held() { (course.rate, self.tangential_rate) } else { (increment, slip) };
            let mean = moved.springs.advance(&mut moved.normal, model, (increment, slip), rates, true)?;
            impulse += mean * (end - start);
            work += mean * slip;
            deepest = largest(moved.normal.max_indentation(), deepest);
            start = end;
        }
        moved.mean_force = impulse / step;
        moved.impulse = moved.impulse.plus(impulse);
        moved.work = moved.work.plus(work);
        *self = moved;
        Ok(deepest)
    }

    fn step_with_mean_force<B: Borrow<RoughModel<L, U>>>(
        &mut self,
        course: &Course,
        step: f64,
        model: impl Fn() -> B,
    ) -> Result<(f64, f64), TooDeep> {
        let of_normal = model();
        let mean = { self.normal }.step_with_mean_force(course, step, || &of_normal.borrow().normal)?.1;
        Ok((self.step(course, step, model)?, mean))
    }

    fn mean_force_of_short_course(&self, from: f64, course: &Course, step: f64) -> f64 {
        Contact::<Model<L, U>>::mean_force_of_short_course(&self.normal, from, course, step)
    }

    fn step_held(
        &mut self,
        rate: f64,
        step: f64,
        _kept: &YieldPoint,
        model: impl Fn() -> RoughModel<L, U>,
    ) -> Result<(), TooDeep> {
        self.step(&Course::held(rate), step, model).map(|_| ())
    }

    fn mean_force(&self, model: &RoughModel<L, U>, rate: f64, step: f64) -> Result<f64, TooDeep> {
        self.normal.mean_force(&model.normal, rate, step)
    }

    fn stays_within(&mut self, depth: f64) -> bool {
        Contact::<Model<L, U>>::stays_within(&mut self.normal, depth)
    }

    fn indentation(&self) -> f64 {
        self.normal.indentation()
    }

    fn max_indentation(&self) -> f64 {
        self.normal.max_indentation()
    }

    fn residual_indentation(&self, model: &RoughModel<L, U>) -> f64 {
        self.normal.residual_indentation(&model.normal)
    }

    fn regime(&self) -> Regime {
        self.normal.regime()
    }

    fn force(&self, _rate: f64) -> f64 {
        self.normal.force()
    }

    fn damping(&self, _rate: f64) -> f64 {
        0.0
    }

    fn stiffness(&self, _rate: f64) -> f64 {
        self.normal.stiffness()
    }

    fn curvature(&self, model: &RoughModel<L, U>, _rate: f64) -> f64 {
        self.normal.curvature(&model.normal)
    }

    fn contact_radius(&self, model: &RoughModel<L, U>) -> f64 {
        self.normal.contact_radius(&model.normal)
    }

    fn elastic_energy(&self, model: &RoughModel<L, U>) -> f64 {
        self.normal.elastic_energy(&model.normal)
    }

    fn dissipated_energy(&self, model: &RoughModel<L, U>) -> f64 {
        self.normal.dissipated_energy(&model.normal)
    }

    fn smooth_piece(&self, model: &RoughModel<L, U>) -> (f64, f64) {
        self.normal.smooth_piece(&model.normal)
    }

    /// The springs stay as they are.
    fn moved_to(&self, model: &RoughModel<L, U>, indentation: f64) -> Self {
        RoughContact { normal: self.normal.moved_to(&model.normal, indentation), ..*self }
    }

    fn valid_depth(model: &RoughModel<L, U>) -> f64 {
        model.normal.valid_depth()
    }

    fn may_refuse(model: &RoughModel<L, U>) -> bool {
        <History as Contact<Model<L, U>>>::may_refuse(&model.normal)
    }

    fn save(&self, store: &mut impl FnMut(u64)) {
        Contact::<Model<L, U>>::save(&self.normal, store);
        self.springs.save(store);
        let (impulse, work) = (self.impulse, self.work);
        let numbers = [self.tangential_rate, self.mean_force, impulse.value, impulse.rest, work.value, work.rest];
        store_numbers(&numbers, store);
    }

    fn load(words: &mut impl Iterator<Item = u64>, model: &RoughModel<L, U>) -> Option<Self> {
        let normal = History::load(words, &model.normal)?;
        let springs = Springs::load(words, model, &normal)?;
        let [tangential_rate, mean_force, impulse, lost_impulse, work, lost_work] = load_numbers(words)?;
        let (impulse, work) = (Sum { value: impulse, rest: lost_impulse }, Sum { value: work, rest: lost_work });
        Some(RoughContact { normal, springs, tangential_rate, mean_force, impulse, work })
    }
}
