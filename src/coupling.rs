//! What a contact has beside its history for masters that couple it well: the course of its input inside of a step, and the
//! momentum of the last one.

use crate::contact::path::{Course, Sum};

/// The course of the input over the next step, and how the last one ended.
#[derive(Clone, Copy, Debug, Default)]
pub struct Curve {
    /// First derivative of the rate over the next step [m/s^2].
    pub slope: f64,
    /// Second derivative [m/s^3].
    pub bend: f64,
    /// Rate at the end of the last step, if that had derivatives or a mass of its own [m/s].
    pub end_rate: f64,
    /// Its derivative there [m/s^2].
    pub end_slope: f64,
}

/// Number of words that hold a curve.
pub const CURVE_WORDS: usize = 4;

impl Curve {
    /// The course over the next step of a contact with this `rate` [m/s].
    pub fn course(&self, rate: f64) -> Course {
        Course { rate, slope: self.slope, bend: self.bend }
    }

    /// Notes the end of a step of length `step` [s] on `course`; derivatives hold for one step.
    pub fn end_of(&mut self, course: &Course, step: f64) {
        *self = Curve {
            end_rate: course.rate_after(step),
            end_slope: course.slope + course.bend * step,
            ..Curve::default()
        };
    }

    /// The curve as words, to be stored.
    pub fn to_words(self) -> [u64; CURVE_WORDS] {
        [self.slope, self.bend, self.end_rate, self.end_slope].map(f64::to_bits)
    }

    /// The curve that [`Curve::to_words`] stored; `None` if a word is not a finite number.
    pub fn from_words(words: [u64; CURVE_WORDS]) -> Option<Curve> {
        let [slope, bend, end_rate, end_slope] = words.map(f64::from_bits);
        let finite = slope.is_finite() && bend.is_finite() && end_rate.is_finite() && end_slope.is_finite();
        finite.then_some(Curve { slope, bend, end_rate, end_slope })
    }
}

/// The integral of the force over time.
#[derive(Clone, Copy, Debug, Default)]
pub struct Momentum {
    impulse: Sum,
    /// Impulse of the last step over its length [N].
    pub mean_force: f64,
}

/// Number of words that hold a momentum.
pub const MOMENTUM_WORDS: usize = 3;

impl Momentum {
    /// A contact before any motion, with this `force` [N].
    pub fn start(force: f64) -> Momentum {
        Momentum { impulse: Sum::new(0.0), mean_force: force }
    }

    /// Adds a step of length `step` [s] with this mean force [N].
    #[inline]
    pub fn add(&mut self, mean_force: f64, step: f64) {
        self.impulse = self.impulse.plus(mean_force * step);
        self.mean_force = mean_force;
    }

    /// Since the start [N.s].
    pub fn impulse(&self) -> f64 {
        self.impulse.total()
    }

    /// The momentum as words, to be stored.
    pub fn to_words(self) -> [u64; MOMENTUM_WORDS] {
        [self.impulse.value, self.impulse.rest, self.mean_force].map(f64::to_bits)
    }

    /// The momentum that [`Momentum::to_words`] stored; `None` if a word is not a finite number.
    pub fn from_words(words: [u64; MOMENTUM_WORDS]) -> Option<Momentum> {
        let [value, rest, mean_force] = words.map(f64::from_bits);
        let finite = value.is_finite() && rest.is_finite() && mean_force.is_finite();
        finite.then_some(Momentum { impulse: Sum { value, rest }, mean_force })
    }
}
