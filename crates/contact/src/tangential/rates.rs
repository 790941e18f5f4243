//! Time derivatives of the quantities of friction.

use super::{Frictional, FrictionalModel, Normal, Quantity};
use crate::behaviour::Contact;
use crate::history::path::RatePolynomial;
use crate::loading::Loading;
use crate::numerics::quotient;
use crate::unloading::Unloading;
use libm::fabs;

/// Length of a trial step: the fraction of the indentation that the contact moves, along the normal and in the (scaled)
/// tangential direction together.
const WIDTH: f64 = 1.0 / 8192.0;

/// The longest trial step \[s\], for motions that are slower than any physical one.
const LONGEST: f64 = 1e50;

impl<const D: usize, const M: usize, const MEAN: bool, N: Normal> Frictional<D, M, MEAN, N> {
    /// First and second time derivative of `quantity`, for motions that continue on these courses along the normal and in
    /// the tangential directions.
    ///
    /// Those of the force are exact, except with a loss, on a dent that grows, and the second one in two directions. All others result from
    /// three trial steps, as in [`slopes`](crate::behaviour::slopes): their relative errors are about 1e-9 (first) and 1e-5 (second
    /// derivative), if the branch of the law and the segments that slip remain the same.
    pub(super) fn derivatives_of<L: Loading + Copy, U: Unloading + Copy>(
        &self,
        model: &FrictionalModel<L, U, N::Loss>,
        quantity: Quantity,
        normal: &RatePolynomial,
        tangential: &[RatePolynomial; D],
    ) -> (f64, f64) {
        let rates = (normal.rate, tangential.map(|course| course.rate));
        let accelerations = (normal.slope, tangential.map(|course| course.slope));
        let indentation = self.normal().indentation();
        let of = |values: [f64; D], direction: usize| values.get(direction).copied().unwrap_or(f64::NAN);
        let exact = match N::LOSES {
            true => None,
            false => self.springs.force_rates(&model.friction, indentation, rates, accelerations),
        };
        let force = |direction| match exact {
            Some([first, second]) => (of(first, direction), of(second, direction)),
            None => self.by_trial(model, Quantity::Force(direction), normal, tangential),
        };
        match quantity {
            Quantity::MeanForce(_) => (0.0, 0.0),
            Quantity::Force(direction) => force(direction),
            Quantity::Impulse(direction) => {
                (of(self.tangential_forces(model, normal.rate), direction), force(direction).0)
            }
            Quantity::Energy | Quantity::FrictionWork | Quantity::StickRadius => {
                self.by_trial(model, quantity, normal, tangential)
            }
        }
    }

    /// The derivatives from trial steps.
    fn by_trial<L: Loading + Copy, U: Unloading + Copy>(
        &self,
        model: &FrictionalModel<L, U, N::Loss>,
        quantity: Quantity,
        normal: &RatePolynomial,
        tangential: &[RatePolynomial; D],
    ) -> (f64, f64) {
        let indentation = self.normal().indentation();
        let scale = model.friction.scale();
        let speed = tangential.iter().fold(fabs(normal.rate), |sum, course| sum + fabs(scale * course.rate));
        if indentation <= 0.0 || speed == 0.0 {
            return (0.0, 0.0);
        }
        // the square of the longest step exists
        let fast = WIDTH * indentation < LONGEST * speed;
        let width = quotient(WIDTH * indentation, speed, fast, LONGEST);
        if width == 0.0 {
            return (0.0, 0.0);
        }
        let here = self.tangential(model, quantity, normal.rate);
        let (mut first, mut second) = (0.0, 0.0);
        for (steps, of_first, of_second) in [(1.0, 18.0, -5.0), (2.0, -9.0, 4.0), (3.0, 2.0, -1.0)] {
            let mut moved = *self;
            moved.courses = *tangential;
            if moved.step(normal, steps * width, || model).is_err() {
                return (f64::NAN, f64::NAN);
            }
            let rise = moved.tangential(model, quantity, normal.rate) - here;
            first += of_first * rise;
            second += of_second * rise;
        }
        // a step this short exists only for rates far beyond any that are physical
        let square = width * width;
        (first / (6.0 * width), quotient(second, square, square > 0.0, f64::NAN))
    }
}
