//! A contact with friction as a [`Contact`].

use super::{Quantity, RoughContact, RoughModel, Sliding, Springs};
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

/// End times \[s\] of the parts of a step in which the contact either slips in one direction or sticks, as far as the
/// rates alone show it; unsorted. They are the times at which the rate of the indentation is zero or as large as the
/// tangential rate times `scale`. The last one is the end of the step.
fn ends_of_parts(normal: &Course, tangential: &Course, scale: f64, step: f64) -> [[f64; 3]; 3] {
    [0.0, scale, -scale].map(|scale| {
        let difference = Course {
            rate: normal.rate - scale * tangential.rate,
            slope: normal.slope - scale * tangential.slope,
            bend: normal.bend - scale * tangential.bend,
        };
        difference.monotone_ends(step)
    })
}

/// The earliest of `ends` after `time` \[s\].
fn next_of(ends: &[[f64; 3]; 3], time: f64) -> Option<f64> {
    let behind = ends.as_flattened().iter().copied().filter(|&end| end > time);
    behind.reduce(|one, other| if other < one { other } else { one })
}

impl<L: Loading, U: Unloading, const N: usize> Contact<RoughModel<L, U>> for RoughContact<N> {
    const FOLLOWS_RATE: bool = false;
    const DERIVATIVES: i32 = 2;
    const WORDS: usize = 13 + Springs::<N>::WORDS + 10;
    const HAS_FRICTION: bool = true;

    /// Where the contact begins to yield.
    type Kept = YieldPoint;

    fn kept(model: &RoughModel<L, U>) -> YieldPoint {
        model.normal.yield_point()
    }

    fn start(model: &RoughModel<L, U>, gap: f64) -> Result<Self, TooDeep> {
        let normal = History::start(&model.normal, gap)?;
        let springs = Springs::start(model, &normal);
        let (none, course) = (Sum::new(0.0), Course::held(0.0));
        Ok(RoughContact { normal, springs, course, end: course, mean_force: 0.0, impulse: none, work: none })
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
        let tangential = self.course;
        let is_held = course.is_held() && tangential.is_held();
        let ends = match is_held {
            true => [[step; 3]; 3],
            false => ends_of_parts(course, &tangential, model.friction.scale(), step),
        };
        let (mut moved, mut deepest, mut start) = (*self, 0.0, 0.0);
        let (mut impulse, mut work) = (0.0, 0.0);
        for _ in 0..ends.as_flattened().len() {
            let Some(end) = next_of(&ends, start) else { break };
            let [increment, slip] = [course, &tangential].map(|course| course.way(end) - course.way(start));
            // within a divided step the ratio of the held rates is the same to the last bit
            let rates = if is_held { (course.rate, tangential.rate) } else { (increment, slip) };
            let mean = moved.springs.advance(&mut moved.normal, model, (increment, slip), rates, true)?;
            impulse += mean * (end - start);
            work += mean * slip;
            deepest = largest(moved.normal.max_indentation(), deepest);
            start = end;
        }
        moved.mean_force = impulse / step;
        moved.impulse = moved.impulse.plus(impulse);
        moved.work = moved.work.plus(work);
        (moved.course, moved.end) = (Course::held(tangential.rate), Course { bend: 0.0, ..tangential.after(step) });
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

    fn tangential_course(&self) -> Course {
        self.course
    }

    fn set_tangential_course(&mut self, course: &Course) {
        self.course = *course;
    }

    fn tangential_end(&self) -> Course {
        self.end
    }

    fn tangential(&self, model: &RoughModel<L, U>, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Force => self.tangential_force(model),
            Quantity::MeanForce => self.mean_tangential_force(),
            Quantity::Impulse => self.tangential_impulse(),
            Quantity::Energy => self.tangential_energy(model),
            Quantity::FrictionWork => self.friction_work(model),
            Quantity::StickRadius => self.stick_radius(model),
        }
    }

    fn tangential_derivatives(
        &self,
        model: &RoughModel<L, U>,
        quantity: Quantity,
        courses: &[Course; 2],
    ) -> (f64, f64) {
        self.derivatives_of(model, quantity, courses)
    }

    fn sliding(&self) -> Sliding {
        RoughContact::sliding(self)
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
        let RoughContact { course, end, mean_force, impulse, work, .. } = self;
        // the bend of the end is that of the course, which is over
        let numbers = [course.rate, course.slope, course.bend, end.rate, end.slope, *mean_force];
        store_numbers(&numbers, store);
        store_numbers(&[impulse.value, impulse.rest, work.value, work.rest], store);
    }

    fn load(words: &mut impl Iterator<Item = u64>, model: &RoughModel<L, U>) -> Option<Self> {
        let normal = History::load(words, &model.normal)?;
        let springs = Springs::load(words, model, &normal)?;
        let [rate, slope, bend, end_rate, end_slope, mean_force] = load_numbers(words)?;
        let [impulse, lost_impulse, work, lost_work] = load_numbers(words)?;
        let course = Course { rate, slope, bend };
        let end = Course { rate: end_rate, slope: end_slope, bend: 0.0 };
        let (impulse, work) = (Sum { value: impulse, rest: lost_impulse }, Sum { value: work, rest: lost_work });
        Some(RoughContact { normal, springs, course, end, mean_force, impulse, work })
    }
}
