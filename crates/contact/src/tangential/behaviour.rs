//! A contact with friction as a [`Contact`].

use super::contact::is_share;
use super::parts::{MOST_PARTS, ends_of_parts, next_of};
use super::vector::{add, dot};
use super::{Frictional, FrictionalModel, Mean, Normal, Quantity, Sliding, SpringsOf};
use crate::Model;
use crate::behaviour::{Contact, slopes};
use crate::history::History;
use crate::history::path::{RatePolynomial, Sum};
use crate::loading::Loading;
use crate::material::YieldPoint;
use crate::numerics::largest;
use crate::numerics::words::{load_numbers, store_numbers};
use crate::regime::{Regime, TooDeep};
use crate::unloading::Unloading;
use core::borrow::Borrow;

impl<L: Loading + Copy, U: Unloading + Copy, const D: usize, const M: usize, const MEAN: bool, N: Normal>
    Contact<FrictionalModel<L, U, N::Loss>> for Frictional<D, M, MEAN, N>
{
    const FOLLOWS_RATE: bool = N::FOLLOWS_RATE;
    const DERIVATIVES: i32 = N::DERIVATIVES;
    // a state fits the library that computes the mean and the one that doesn't, which store the same numbers
    const WORDS: usize = N::WORDS + SpringsOf::<D, M, true>::WORDS + 8 * D + 3 + N::LOSES as usize;
    const DIRECTIONS: usize = D;

    /// Where the contact begins to yield.
    type Kept = YieldPoint;

    fn kept(model: &FrictionalModel<L, U, N::Loss>) -> YieldPoint {
        model.normal.yield_point()
    }

    fn prepared(
        model: FrictionalModel<L, U, N::Loss>,
        before: Option<&FrictionalModel<L, U, N::Loss>>,
    ) -> FrictionalModel<L, U, N::Loss> {
        FrictionalModel { normal: model.normal.prepared_after(before.map(|before| &before.normal)), ..model }
    }

    fn start(model: &FrictionalModel<L, U, N::Loss>, gap: f64) -> Result<Self, TooDeep> {
        let normal = N::start(&model.normal, &model.loss, gap)?;
        let springs = SpringsOf::start(model, normal.plastic());
        let (none, courses) = (Sum::new(0.0), [RatePolynomial::held(0.0); D]);
        let (mean_force, impulse) = ([0.0; D], [none; D]);
        Ok(Frictional {
            normal,
            springs,
            share: 1.0,
            courses,
            ends: courses,
            mean_force,
            impulse,
            work: none,
            lost: 0.0,
        })
    }

    /// Always false: the springs follow each step.
    #[inline(always)]
    fn short_step(&mut self, _increment: f64) -> bool {
        false
    }

    fn mean_force_of_short_step(&self, from: f64) -> f64 {
        Contact::<Model<L, U>>::mean_force_of_short_step(self.normal.plastic(), from)
    }

    /// With a loss the contact moves on one straight way, as a short part of the motion of bodies that share contacts.
    ///
    /// A course with a changing rate is divided where springs may begin to stick or to slip. Each part counts as
    /// straight. Slip is then exact at the end of a part; stick is of second order in the length of the part.
    fn step<B: Borrow<FrictionalModel<L, U, N::Loss>>>(
        &mut self,
        course: &RatePolynomial,
        step: f64,
        model: impl Fn() -> B,
    ) -> Result<f64, TooDeep> {
        let model = model();
        let model = model.borrow();
        let tangential = self.courses;
        let is_held = course.is_held() && tangential.iter().all(RatePolynomial::is_held);
        let ends = match is_held {
            true => [step; MOST_PARTS],
            false => ends_of_parts(course, &tangential, model.friction.scale(), step),
        };
        let (mut moved, mut deepest, mut start) = (*self, 0.0, 0.0);
        if MEAN && !(is_held && self.springs.is_exact_to(self.normal().indentation() + course.rate * step)) {
            moved.lost = self.friction_work(model);
        }
        let asked = if MEAN { Mean::Exact } else { Mean::Skipped };
        let (mut impulse, mut work) = ([0.0; D], 0.0);
        for _ in 0..MOST_PARTS {
            let Some(end) = next_of(&ends, start) else { break };
            let way = |course: &RatePolynomial| course.way(end) - course.way(start);
            let (increment, slip) = (way(course), tangential.map(|course| way(&course)));
            // within a divided step the ratio of the held rates is the same to the last bit
            let rates = if is_held { (course.rate, tangential.map(|course| course.rate)) } else { (increment, slip) };
            let mean = match moved.normal.loss() {
                None => {
                    moved.springs.advance_along(moved.normal.plastic_mut(), model, (increment, slip), rates, asked)?
                }
                Some(_) => {
                    let (force, time) = (moved.normal.force(course.rate), end - start);
                    moved.go_with_loss(model, (increment, slip), (0.0, [0.0; D]), (force, time), None)?.tangential
                }
            };
            impulse = add(impulse, end - start, mean);
            work += dot(mean, slip);
            deepest = largest(moved.normal().max_indentation(), deepest);
            start = end;
        }
        if MEAN {
            moved.mean_force = impulse.map(|impulse| impulse / step);
            for (sum, impulse) in moved.impulse.iter_mut().zip(impulse) {
                *sum = sum.plus(impulse);
            }
            moved.work = moved.work.plus(work);
        }
        moved.courses = tangential.map(|course| RatePolynomial::held(course.rate));
        moved.ends = tangential.map(|course| RatePolynomial { bend: 0.0, ..course.after(step) });
        *self = moved;
        Ok(deepest)
    }

    fn step_with_mean_force<B: Borrow<FrictionalModel<L, U, N::Loss>>>(
        &mut self,
        course: &RatePolynomial,
        step: f64,
        model: impl Fn() -> B,
    ) -> Result<(f64, f64), TooDeep> {
        let of_normal = model();
        let mean = { *self.normal.plastic() }.step_with_mean_force(course, step, || &of_normal.borrow().normal)?.1;
        Ok((self.step(course, step, model)?, mean))
    }

    fn step_held<B: Borrow<FrictionalModel<L, U, N::Loss>>>(
        &mut self,
        rate: f64,
        step: f64,
        _kept: &YieldPoint,
        model: impl Fn() -> B,
    ) -> Result<(), TooDeep> {
        self.step(&RatePolynomial::held(rate), step, model).map(|_| ())
    }

    fn mean_force(&self, model: &FrictionalModel<L, U, N::Loss>, rate: f64, step: f64) -> Result<f64, TooDeep> {
        self.normal().mean_force(&model.normal, rate, step)
    }

    fn stays_within(&mut self, depth: f64) -> bool {
        Contact::<Model<L, U>>::stays_within(self.normal.plastic_mut(), depth)
    }

    fn indentation(&self) -> f64 {
        self.normal().indentation()
    }

    fn max_indentation(&self) -> f64 {
        self.normal().max_indentation()
    }

    fn residual_indentation(&self, model: &FrictionalModel<L, U, N::Loss>) -> f64 {
        self.normal().residual_indentation(&model.normal)
    }

    fn regime(&self) -> Regime {
        self.normal().regime()
    }

    fn force(&self, rate: f64) -> f64 {
        self.normal.force(rate)
    }

    fn damping(&self, rate: f64) -> f64 {
        self.normal.damping(rate)
    }

    fn stiffness(&self, rate: f64) -> f64 {
        self.normal.stiffness(rate)
    }

    fn curvature(&self, model: &FrictionalModel<L, U, N::Loss>, rate: f64) -> f64 {
        match N::FOLLOWS_RATE {
            true => {
                slopes(self, model, |contact: &Self| {
                    Contact::<FrictionalModel<L, U, N::Loss>>::stiffness(contact, rate)
                })
                .0
            }
            false => self.normal().curvature(&model.normal),
        }
    }

    fn contact_radius(&self, model: &FrictionalModel<L, U, N::Loss>) -> f64 {
        self.normal().contact_radius(&model.normal)
    }

    fn elastic_energy(&self, model: &FrictionalModel<L, U, N::Loss>) -> f64 {
        self.normal().elastic_energy(&model.normal)
    }

    fn dissipated_energy(&self, model: &FrictionalModel<L, U, N::Loss>) -> f64 {
        self.normal().dissipated_energy(&model.normal) + self.normal.heat()
    }

    fn smooth_piece(&self, model: &FrictionalModel<L, U, N::Loss>) -> (f64, f64) {
        self.normal().smooth_piece(&model.normal)
    }

    /// The springs stay as they are.
    fn moved_to(&self, model: &FrictionalModel<L, U, N::Loss>, indentation: f64) -> Self {
        Frictional { normal: self.normal.moved_to(&model.normal, &model.loss, indentation), ..*self }
    }

    fn tangential_course(&self, direction: usize) -> RatePolynomial {
        self.courses.get(direction).copied().unwrap_or_default()
    }

    fn set_tangential_course(&mut self, direction: usize, course: &RatePolynomial) {
        if let Some(slot) = self.courses.get_mut(direction) {
            *slot = *course;
        }
    }

    fn tangential_end(&self, direction: usize) -> RatePolynomial {
        self.ends.get(direction).copied().unwrap_or_default()
    }

    fn set_tangential_end(&mut self, direction: usize, end: &RatePolynomial) {
        for (course, slot) in self.courses.iter_mut().zip(&mut self.ends).skip(direction).take(1) {
            (*course, *slot) = (RatePolynomial::held(course.rate), *end);
        }
    }

    fn tangential(&self, model: &FrictionalModel<L, U, N::Loss>, quantity: Quantity, rate: f64) -> f64 {
        let of = |values: [f64; D], direction: usize| values.get(direction).copied().unwrap_or(f64::NAN);
        match quantity {
            Quantity::Force(direction) => of(self.tangential_forces(model, rate), direction),
            Quantity::MeanForce(direction) => of(self.mean_force, direction),
            Quantity::Impulse(direction) => of(self.tangential_impulses(), direction),
            Quantity::Energy => self.tangential_energy(model),
            Quantity::FrictionWork => self.friction_work(model),
            Quantity::StickRadius => self.stick_radius(model),
        }
    }

    fn tangential_derivatives(
        &self,
        model: &FrictionalModel<L, U, N::Loss>,
        quantity: Quantity,
        normal: &RatePolynomial,
        tangential: &[RatePolynomial; 2],
    ) -> (f64, f64) {
        let of = |direction: usize| tangential.get(direction).copied().unwrap_or_default();
        self.derivatives_of(model, quantity, normal, &core::array::from_fn(of))
    }

    fn sliding(&self) -> Sliding {
        Frictional::sliding(self)
    }

    fn depth_of(model: &FrictionalModel<L, U, N::Loss>, contact_radius: f64) -> f64 {
        model.normal.depth_of(contact_radius)
    }

    fn may_refuse(model: &FrictionalModel<L, U, N::Loss>) -> bool {
        N::FOLLOWS_RATE || <History as Contact<Model<L, U>>>::may_refuse(&model.normal)
    }

    fn save(&self, store: &mut impl FnMut(u64)) {
        self.normal.save(store);
        self.springs.save(store);
        let Frictional { courses, ends, mean_force, impulse, work, lost, share, .. } = self;
        for (course, end) in courses.iter().zip(ends) {
            // the bend of the end is that of the course, which is over
            store_numbers(&[course.rate, course.slope, course.bend, end.rate, end.slope], store);
        }
        store_numbers(mean_force, store);
        for sum in impulse.iter().chain([work]) {
            store_numbers(&[sum.value, sum.rest], store);
        }
        store_numbers(&[*lost], store);
        if N::LOSES {
            store_numbers(&[*share], store);
        }
    }

    fn load(words: &mut impl Iterator<Item = u64>, model: &FrictionalModel<L, U, N::Loss>) -> Option<Self> {
        let normal = N::load(words, &model.normal, &model.loss)?;
        let springs = SpringsOf::load(words, model, normal.plastic())?;
        let mut courses = [RatePolynomial::default(); D];
        let mut ends = courses;
        for (course, end) in courses.iter_mut().zip(&mut ends) {
            let [rate, slope, bend, end_rate, end_slope] = load_numbers(words)?;
            *course = RatePolynomial { rate, slope, bend };
            *end = RatePolynomial { rate: end_rate, slope: end_slope, bend: 0.0 };
        }
        let none = Sum::new(0.0);
        let mut loaded = Frictional {
            normal,
            springs,
            share: 1.0,
            courses,
            ends,
            mean_force: [0.0; D],
            impulse: [none; D],
            work: none,
            lost: 0.0,
        };
        loaded.mean_force = load_numbers(words)?;
        for sum in loaded.impulse.iter_mut().chain([&mut loaded.work]) {
            let [value, rest] = load_numbers(words)?;
            *sum = Sum { value, rest };
        }
        [loaded.lost] = load_numbers(words)?;
        if N::LOSES {
            [loaded.share] = load_numbers(words)?;
            if !is_share(loaded.share) {
                return None;
            }
        }
        Some(loaded)
    }
}
