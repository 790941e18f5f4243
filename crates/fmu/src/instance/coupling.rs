//! The data for accurate coupling that a contact stores in addition to its state: the course of its input within a step, and
//! the momentum of the last step.

use brinell_contact::history::path::{RatePolynomial, Sum};
use brinell_contact::numerics::words::{load_kept, store_kept};

/// The course of the input over the next step, and the end of the last step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Curve {
    /// First derivative of the rate over the next step \[m/s^2\].
    pub slope: f64,
    /// Second derivative \[m/s^3\].
    pub bend: f64,
    /// Rate at the end of the last step \[m/s\], if that step had derivatives or the bodies have a mass.
    pub end_rate: f64,
    /// Its derivative at the end of the last step \[m/s^2\].
    pub end_slope: f64,
}

impl Curve {
    /// Whether the rate changes during the next step.
    #[inline]
    pub fn is_curved(&self) -> bool {
        self.slope != 0.0 || self.bend != 0.0
    }

    /// The course of the next step, for a contact with this `rate` \[m/s\].
    pub fn course(&self, rate: f64) -> RatePolynomial {
        RatePolynomial { rate, slope: self.slope, bend: self.bend }
    }

    /// Records the end of a step of length `step` \[s\] along `course`. Derivatives apply to one step only.
    pub fn end_of(&mut self, course: &RatePolynomial, step: f64) {
        *self = Curve {
            end_rate: course.rate_after(step),
            end_slope: course.slope + course.bend * step,
            ..Curve::default()
        };
    }

    /// Passes the numbers that are `kept` to `store`: those that the scene needs.
    pub fn save(&self, kept: [bool; 4], store: &mut impl FnMut(u64)) {
        store_kept([self.slope, self.bend, self.end_rate, self.end_slope], kept, store);
    }

    /// The curve that [`Curve::save`] has stored; `None` if a word is not a finite number.
    pub fn load(kept: [bool; 4], words: &mut impl Iterator<Item = u64>) -> Option<Curve> {
        let [slope, bend, end_rate, end_slope] = load_kept(kept, words)?;
        Some(Curve { slope, bend, end_rate, end_slope })
    }
}

/// The integral of the force over time.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Momentum {
    impulse: Sum,
    /// Mean force of the last step \[N\]: impulse over length.
    pub mean_force: f64,
}

impl Momentum {
    /// A contact before any motion, with this `force` \[N\].
    pub fn start(force: f64) -> Momentum {
        Momentum { impulse: Sum::new(0.0), mean_force: force }
    }

    /// Adds a step of length `step` \[s\] with this mean force \[N\].
    #[inline]
    pub fn add(&mut self, mean_force: f64, step: f64) {
        self.impulse = self.impulse.plus(mean_force * step);
        self.mean_force = mean_force;
    }

    /// Impulse since the start \[N.s\].
    pub fn impulse(&self) -> f64 {
        self.impulse.total()
    }

    /// Passes the numbers that are `kept` to `store`: those that the scene needs.
    pub fn save(&self, kept: [bool; 3], store: &mut impl FnMut(u64)) {
        store_kept([self.impulse.value, self.impulse.rest, self.mean_force], kept, store);
    }

    /// The momentum that [`Momentum::save`] has stored; `None` if a word is not a finite number.
    pub fn load(kept: [bool; 3], words: &mut impl Iterator<Item = u64>) -> Option<Momentum> {
        let [value, rest, mean_force] = load_kept(kept, words)?;
        Some(Momentum { impulse: Sum { value, rest }, mean_force })
    }
}
