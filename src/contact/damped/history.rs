//! The state of a contact with a rate-dependent law.

use super::{Damped, Factors, Model};
use crate::contact::history::{LARGEST_INDENTATION, Regime, TooDeep};
use crate::contact::path::{Course, Sum};
use crate::contact::quadrature::graded_integral;
use core::f64::consts::PI;
use libm::sqrt;

/// Everything a contact remembers, and the factors of its law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct History<D> {
    law: D,
    factors: Factors,
    indentation: Sum,
    max_indentation: f64,
    /// Closing speed at first touch [m/s]; zero until there was one.
    touch_speed: f64,
    dissipated: Sum,
}

/// Room for the factors of stiffness and pressure beside force over indentation: exponents, and a radius of 1e-12 m.
const ROOM: f64 = 1e14;

/// Halvings that find a number between two others to its last digit, whatever they are.
const HALVINGS: u32 = 1100;

impl<D: Damped + Copy> History<D> {
    /// Number of words that hold a history.
    pub const WORDS: usize = 8;

    /// Whether the force depends on the rate at the same instant.
    pub const FOLLOWS_RATE: bool = true;

    /// Up to which order there are derivatives of the force by time: the second needs the third one of the indentation.
    pub const DERIVATIVES: i32 = 1;

    /// A contact at `gap` [m] before any motion. One that starts pressed in has not been touched at any speed: the first
    /// closing rate then counts as that speed.
    ///
    /// # Errors
    /// [`TooDeep`] beyond [`LARGEST_INDENTATION`] on either side, and for NaN.
    pub fn start(model: &Model<D>, gap: f64) -> Result<History<D>, TooDeep> {
        // not -gap, so that no gap is 0.0 and not -0.0
        let indentation = within(0.0 - gap)?;
        Ok(History {
            law: model.law,
            factors: model.law.factors(&model.pair, model.restitution, model.mass),
            indentation: Sum::new(indentation),
            max_indentation: if indentation > 0.0 { indentation } else { 0.0 },
            touch_speed: 0.0,
            dissipated: Sum::new(0.0),
        })
    }

    /// Moves the contact with `rate` [m/s] over `step` [s].
    ///
    /// # Errors
    /// [`TooDeep`] as for [`History::start`], and where force or heat would be beyond all numbers; the history is left as it was.
    pub fn step(&mut self, rate: f64, step: f64, _model: impl FnOnce() -> Model<D>) -> Result<(), TooDeep> {
        let sum = self.indentation.plus(rate * step);
        let to = within(sum.total())?;
        let from = self.indentation.total();
        let mut next = *self;
        next.touch(to, rate);
        if from <= 0.0 && to > 0.0 {
            next.max_indentation = 0.0;
        }
        next.max_indentation = if to > next.max_indentation { to } else { next.max_indentation };
        let positive = |d: f64| if d > 0.0 { d } else { 0.0 };
        next.dissipated = self.dissipated.plus(next.dissipation(positive(from), positive(to), rate));
        next.indentation = sum;
        // written positively, so that a NaN fails
        let finite = next.is_finite_at_rate(rate) && next.stored() + next.dissipated.total() < f64::INFINITY;
        if !finite {
            return Err(TooDeep { indentation: to });
        }
        *self = next;
        Ok(())
    }

    /// Moves the contact on `course` over `step` [s]; the largest indentation on the way [m]. The rate must be held: inputs of
    /// these laws have no derivatives.
    ///
    /// # Errors
    /// As for [`History::step`].
    pub fn step_along(&mut self, course: &Course, step: f64, model: impl Fn() -> Model<D>) -> Result<f64, TooDeep> {
        debug_assert!(course.is_held());
        self.step(course.rate, step, model)?;
        Ok(self.max_indentation)
    }

    /// Mean force over a step on `course` over `step` [s] that is yet to be made [N]; the rate must be held.
    ///
    /// # Errors
    /// As for [`History::step`].
    pub fn mean_force_along(&self, course: &Course, step: f64, _model: &Model<D>) -> Result<f64, TooDeep> {
        debug_assert!(course.is_held());
        let rate = course.rate;
        let from = self.indentation.total();
        let mut moved = *self;
        moved.touch(from + rate * step, rate);
        let force = |time: f64| {
            let indentation = from + rate * time;
            let force = if indentation > 0.0 { moved.sum_of_forces(indentation, rate) } else { 0.0 };
            if force > 0.0 { force } else { 0.0 }
        };
        // the borders where the force begins, ends or has a corner
        let when = |indentation: f64| (indentation - from) / rate;
        let [first, second] = self.law.borders();
        let change = moved.sign_change(0.0, if from > 0.0 { from } else { 0.0 }, rate);
        let times = [when(0.0), when(first), when(second), when(change), step];
        let (mut start, mut impulse) = (0.0, 0.0);
        for _ in times {
            let next = times
                .into_iter()
                .filter(|&time| time > start)
                .fold(step, |next, time| if time < next { time } else { next });
            impulse += graded_integral(start, next, &force);
            start = next;
        }
        Ok(impulse / step)
    }

    /// There is no branch to come from: see [`History::mean_force_along`].
    pub fn mean_force_since(&self, _from: f64) -> f64 {
        f64::NAN
    }

    /// Derivative of the force by time with this `rate` held [N/s]; see [`History::DERIVATIVES`].
    pub fn force_derivative(&self, _order: i32, rate: f64, _slope: f64, _model: &Model<D>) -> f64 {
        self.stiffness_at_rate(rate) * rate
    }

    /// There are no plain steps here.
    pub fn plain_step(&mut self, _rate: f64, _step: f64) -> bool {
        false
    }

    /// Every step is looked at already.
    pub fn notice_at(&mut self, _indentation: f64) {}

    /// Notes the speed of a first touch on the way to `to` [m].
    fn touch(&mut self, to: f64, rate: f64) {
        let touches = if self.indentation.total() > 0.0 { self.touch_speed <= 0.0 } else { to > 0.0 };
        if touches && rate > 0.0 {
            self.touch_speed = rate;
        }
    }

    /// `C`, divided by the touch speed if the law wants it [N.s/m]; none before there was a touch.
    fn damping_factor(&self) -> f64 {
        match (self.law.scaled_by_touch(), self.touch_speed > 0.0) {
            (false, _) => self.factors.damping,
            (true, true) => self.factors.damping / self.touch_speed,
            (true, false) => 0.0,
        }
    }

    /// `K phi + C psi d'` at `indentation` > 0, which may be negative [N].
    fn sum_of_forces(&self, indentation: f64, rate: f64) -> f64 {
        self.factors.elastic * self.law.elastic(indentation).value
            + self.damping_factor() * rate * self.law.damping(indentation).value
    }

    /// Whether force, stiffness and pressure are numbers with `rate` [m/s]: a contact that was touched at next to no speed can
    /// have more damping than there are numbers.
    pub fn is_finite_at_rate(&self, rate: f64) -> bool {
        let indentation = self.indentation.total();
        // pressure and stiffness are forces over lengths, and these are their sizes
        indentation <= 0.0 || self.force_at_rate(rate) * ROOM / indentation < f64::INFINITY
    }

    /// Normal force with `rate` [m/s], [N]; zero while apart, and where the surface would have to pull.
    pub fn force_at_rate(&self, rate: f64) -> f64 {
        let indentation = self.indentation.total();
        let force = if indentation > 0.0 { self.sum_of_forces(indentation, rate) } else { 0.0 };
        if force > 0.0 { force } else { 0.0 }
    }

    /// The force with `rate` [m/s], [N].
    pub fn plain_force(&self, rate: f64, _squares: bool) -> f64 {
        self.force_at_rate(rate)
    }

    /// dF/d(indentation) with `rate` held [N/m]; zero where there is no force.
    pub fn stiffness_at_rate(&self, rate: f64) -> f64 {
        let indentation = self.indentation.total();
        if self.force_at_rate(rate) > 0.0 {
            self.factors.elastic * self.law.elastic(indentation).slope
                + self.damping_factor() * rate * self.law.damping(indentation).slope
        } else {
            0.0
        }
    }

    /// Work turned into heat on the way `from`..`to` [m], both >= 0, with `rate` [m/s], [J]: that of the damping, and where the
    /// surface would have to pull the elastic energy that nobody takes.
    fn dissipation(&self, from: f64, to: f64, rate: f64) -> f64 {
        let damping = |from: f64, to: f64| {
            let way = self.law.damping(to).integral - self.law.damping(from).integral;
            self.damping_factor() * rate * way
        };
        if rate >= 0.0 {
            return damping(from, to);
        }
        let elastic = |from: f64, to: f64| {
            self.factors.elastic * (self.law.elastic(from).integral - self.law.elastic(to).integral)
        };
        let mut energy = 0.0;
        let mut end = from;
        let [first, second] = self.law.borders();
        for border in [second, first, to] {
            // the pieces on the way back, from above to below
            let begin = end;
            end = if border > to { border } else { to };
            if end >= begin {
                end = begin;
                continue;
            }
            // inside a piece the force changes its sign at most once
            let change = self.sign_change(end, begin, rate);
            let (above, below) = (0.5 * (begin + change), 0.5 * (change + end));
            for (middle, high, low) in [(above, begin, change), (below, change, end)] {
                let pushes = self.sum_of_forces(middle, rate) > 0.0;
                energy += if pushes { damping(high, low) } else { elastic(high, low) };
            }
        }
        energy
    }

    /// Where in `low`..`high` [m] the force has another sign than at `high`; `low` if it has none other.
    fn sign_change(&self, mut low: f64, mut high: f64, rate: f64) -> f64 {
        let pushes = |d: f64| self.sum_of_forces(d, rate) > 0.0;
        let sign = pushes(high);
        // at zero indentation both forces may vanish: the sign just above counts
        if pushes(if low > 0.0 { low } else { f64::MIN_POSITIVE }) == sign {
            return low;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if !(middle > low && middle < high) {
                break;
            }
            if pushes(middle) == sign {
                high = middle;
            } else {
                low = middle;
            }
        }
        high
    }

    /// Indentation [m]; negative while apart.
    pub fn indentation(&self) -> f64 {
        self.indentation.total()
    }

    /// Largest indentation of the present contact, or of the last one [m].
    pub fn max_indentation(&self) -> f64 {
        self.max_indentation
    }

    /// Nothing remains [m].
    pub fn residual_indentation(&self, _model: &Model<D>) -> f64 {
        0.0
    }

    /// Elastic while the surface is pressed in.
    pub fn regime(&self) -> Regime {
        if self.indentation.total() > 0.0 { Regime::Elastic } else { Regime::Apart }
    }

    /// Contact radius of Hertz, `a^2 = R d` [m]; 0 while apart.
    pub fn contact_radius(&self, model: &Model<D>) -> f64 {
        let indentation = self.indentation.total();
        if indentation > 0.0 { sqrt(model.pair.radius * indentation) } else { 0.0 }
    }

    /// Force over contact area [Pa], 0 while apart.
    pub fn mean_pressure_at_rate(&self, model: &Model<D>, rate: f64) -> f64 {
        let radius = self.contact_radius(model);
        if radius > 0.0 { self.force_at_rate(rate) / (PI * radius * radius) } else { 0.0 }
    }

    /// What the elastic force would give back on a slow way out [J].
    pub fn elastic_energy(&self, _model: &Model<D>) -> f64 {
        self.stored()
    }

    fn stored(&self) -> f64 {
        let indentation = self.indentation.total();
        if indentation > 0.0 { self.factors.elastic * self.law.elastic(indentation).integral } else { 0.0 }
    }

    /// Work turned into heat since the start [J]: summed step by step, each exactly for its held rate.
    pub fn dissipated_energy(&self, _model: &Model<D>) -> f64 {
        self.dissipated.total()
    }

    /// Work done on the contact by the bodies since the start [J]. A contact that starts pressed in counts the way there
    /// as done.
    pub fn work(&self, model: &Model<D>) -> f64 {
        self.elastic_energy(model) + self.dissipated_energy(model)
    }

    /// Makes this history the same as `other`.
    #[inline(always)]
    pub fn copy_from(&mut self, other: &History<D>) {
        *self = *other;
    }

    /// The history as words, to be stored.
    pub fn to_words(&self) -> [u64; 8] {
        let Factors { elastic, damping } = self.factors;
        let (Sum { value, rest }, heat) = (self.indentation, self.dissipated);
        [value, rest, self.max_indentation, self.touch_speed, heat.value, heat.rest, elastic, damping].map(f64::to_bits)
    }

    /// The history of a contact by `model` that [`History::to_words`] stored; `None` if a word is not a finite number.
    pub fn from_words(words: &[u64; 8], model: &Model<D>) -> Option<History<D>> {
        let numbers = words.map(f64::from_bits);
        if numbers.iter().any(|number| !number.is_finite()) {
            return None;
        }
        let [value, rest, max_indentation, touch_speed, heat, heat_rest, elastic, damping] = numbers;
        Some(History {
            law: model.law,
            factors: Factors { elastic, damping },
            indentation: Sum { value, rest },
            max_indentation,
            touch_speed,
            dissipated: Sum { value: heat, rest: heat_rest },
        })
    }
}

fn within(indentation: f64) -> Result<f64, TooDeep> {
    let within = indentation > -LARGEST_INDENTATION && indentation < LARGEST_INDENTATION;
    if within { Ok(indentation) } else { Err(TooDeep { indentation }) }
}
