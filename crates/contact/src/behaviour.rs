//! The interface of every kind of contact: it starts, moves, returns its force and energies, and can be saved.

use super::regime::{Regime, TooDeep};
use super::tangential::{Quantity, Sliding};
use super::validity::largest_radius;
use crate::history::path::RatePolynomial;
use crate::numerics::quotient;
use core::borrow::Borrow;
use core::f64::consts::PI;

/// The state of a contact between the bodies of a model `M`. The model holds the bodies and the laws; the state holds
/// everything that depends on the past motion.
///
/// Units: indentations in m, rates in m/s, forces in N, energies in J, times in s.
pub trait Contact<M>: Copy {
    /// Whether the force depends on the rate at the same instant.
    const FOLLOWS_RATE: bool;

    /// The highest order of the time derivative of the force that the contact provides.
    const DERIVATIVES: i32;

    /// The number of words in a saved contact.
    const WORDS: usize;

    /// The number of tangential directions, zero without friction. The tangential rates are inputs, which the contact itself
    /// keeps.
    const DIRECTIONS: usize = 0;

    /// Whether the contact has friction.
    const HAS_FRICTION: bool = Self::DIRECTIONS > 0;

    /// Whether the contact finds its strength at the first touch of each impact.
    const FINDS_STRENGTH: bool = false;

    /// The part of the model that is worth caching while the bodies stay the same, because steps that leave their branch need
    /// it.
    type Kept: Copy + Default;

    /// The part of `model` to cache.
    fn kept(model: &M) -> Self::Kept;

    /// The `model` with all that depends on the bodies alone computed in advance, where that is slow. It is taken from the model `before`
    /// where the bodies are the same.
    fn prepared(model: M, before: Option<&M>) -> M;

    /// A contact at `gap` \[m\] before any motion. A negative gap is an initial indentation.
    ///
    /// # Errors
    /// [`TooDeep`] beyond [`LARGEST_INDENTATION`](super::regime::LARGEST_INDENTATION) on either side, and for NaN.
    fn start(model: &M, gap: f64) -> Result<Self, TooDeep>;

    /// Moves the contact by `increment` \[m\] if that takes only a few comparisons: along its present branch, or through the
    /// air. Otherwise it changes nothing and returns false.
    ///
    /// Such a step gives the same result as [`Contact::step`] with a constant rate, to the last bit.
    fn short_step(&mut self, increment: f64) -> bool;

    /// Mean force \[N\] of the last step. That step was a [short step](Contact::short_step) and began at the indentation `from`
    /// \[m\].
    fn mean_force_of_short_step(&self, from: f64) -> f64;

    /// Moves the contact along `course` for `step` \[s\]. It calls `model` only if it needs the law. Returns the largest
    /// indentation of the step \[m\], which a fresh surface forgets.
    ///
    /// # Errors
    /// [`TooDeep`] outside the range of the law; the contact is then unchanged.
    fn step<B: Borrow<M>>(&mut self, course: &RatePolynomial, step: f64, model: impl Fn() -> B)
    -> Result<f64, TooDeep>;

    /// Like [`Contact::step`], but returns two results: the largest indentation of the step \[m\] and its mean force \[N\]. A
    /// contact whose force depends on the rate takes the rate as constant.
    ///
    /// # Errors
    /// As for [`Contact::step`].
    fn step_with_mean_force<B: Borrow<M>>(
        &mut self,
        course: &RatePolynomial,
        step: f64,
        model: impl Fn() -> B,
    ) -> Result<(f64, f64), TooDeep> {
        let mean_force = self.mean_force(model().borrow(), course.rate, step)?;
        Ok((self.step(course, step, model)?, mean_force))
    }

    /// [`Contact::step`] with a constant `rate` \[m/s\], mostly for a step that is not a [short step](Contact::short_step).
    /// `kept` is the cached part of the model; `model` is called only if the law is needed.
    ///
    /// # Errors
    /// As for [`Contact::step`].
    fn step_held<B: Borrow<M>>(
        &mut self,
        rate: f64,
        step: f64,
        kept: &Self::Kept,
        model: impl Fn() -> B,
    ) -> Result<(), TooDeep>;

    /// Mean force \[N\] of a step at a constant `rate` \[m/s\] that has not been taken yet.
    ///
    /// # Errors
    /// As for [`Contact::step`].
    fn mean_force(&self, model: &M, rate: f64, step: f64) -> Result<f64, TooDeep>;

    /// Whether the contact has always been shallower than `depth` \[m\]. If so, no [short step](Contact::short_step) reaches
    /// that depth.
    fn stays_within(&mut self, depth: f64) -> bool;

    /// Indentation \[m\]; negative while apart.
    fn indentation(&self) -> f64;

    /// Largest indentation of the present dent or contact \[m\].
    fn max_indentation(&self) -> f64;

    /// Depth of the dent that would remain if the load were removed now \[m\].
    fn residual_indentation(&self, model: &M) -> f64;

    /// The part of the law that the contact is on.
    fn regime(&self) -> Regime;

    /// Normal force at this `rate` \[N\], compressive positive; zero while apart.
    fn force(&self, rate: f64) -> f64;

    /// dF/d(rate) \[N.s/m\].
    fn damping(&self, rate: f64) -> f64;

    /// dF/d(indentation) at constant `rate` \[N/m\], in the direction of the last motion.
    fn stiffness(&self, rate: f64) -> f64;

    /// d2F/d(indentation)^2 at constant `rate` \[N/m^2\].
    fn curvature(&self, model: &M, rate: f64) -> f64;

    /// Contact radius \[m\]; 0 while apart.
    fn contact_radius(&self, model: &M) -> f64;

    /// Area of the contact \[m^2\]; 0 while apart.
    fn contact_area(&self, model: &M) -> f64 {
        let radius = self.contact_radius(model);
        PI * radius * radius
    }

    /// Force over contact area \[Pa\]; 0 while apart.
    fn mean_pressure(&self, model: &M, rate: f64) -> f64 {
        let area = self.contact_area(model);
        quotient(self.force(rate), area, area > 0.0, 0.0)
    }

    /// Energy that unloading would return \[J\].
    fn elastic_energy(&self, model: &M) -> f64;

    /// Energy dissipated by plastic deformation or damping since the start \[J\].
    fn dissipated_energy(&self, model: &M) -> f64;

    /// Work done on the contact by the bodies since the start \[J\]. For a contact that starts indented, this includes the work
    /// of reaching the initial indentation.
    fn work(&self, model: &M) -> f64 {
        self.elastic_energy(model) + self.dissipated_energy(model)
    }

    /// The bounds of the smooth piece of the law that the contact is on \[m\].
    fn smooth_piece(&self, model: &M) -> (f64, f64);

    /// The contact as it would be at another `indentation` \[m\] on its [smooth piece](Contact::smooth_piece). It serves to
    /// differentiate the outputs.
    fn moved_to(&self, model: &M, indentation: f64) -> Self;

    /// Prepares a contact that may be touched in a step at constant `rate` \[m/s\], by bodies of this effective `mass` \[kg\]. It
    /// has no effect on contacts of constant strength.
    fn meet(&mut self, _model: &M, _mass: f64, _rate: f64) {}

    /// The course of the tangential rate in this direction over the next step \[m/s\]; zero without friction.
    fn tangential_course(&self, _direction: usize) -> RatePolynomial {
        RatePolynomial::held(0.0)
    }

    /// Sets the course of the tangential rate in this direction. Its derivatives apply to the next step, its rate until it is set again. It has
    /// no effect without friction.
    fn set_tangential_course(&mut self, _direction: usize, _course: &RatePolynomial) {}

    /// The course on which the tangential rate in this direction ended the last step \[m/s\].
    fn tangential_end(&self, _direction: usize) -> RatePolynomial {
        RatePolynomial::held(0.0)
    }

    /// Sets the course on which the tangential rate in this direction ended the last step, of a contact that others have moved. Its
    /// derivatives for the next step are those of no course. It has no effect without friction.
    fn set_tangential_end(&mut self, _direction: usize, _end: &RatePolynomial) {}

    /// A quantity of the friction of bodies that close at this `rate` \[m/s\]; NaN without friction.
    fn tangential(&self, _model: &M, _quantity: Quantity, _rate: f64) -> f64 {
        f64::NAN
    }

    /// First and second time derivative of a quantity of the friction, for motions that continue on these courses along the
    /// normal and in the tangential directions.
    fn tangential_derivatives(
        &self,
        _model: &M,
        _quantity: Quantity,
        _normal: &RatePolynomial,
        _tangential: &[RatePolynomial; 2],
    ) -> (f64, f64) {
        (f64::NAN, f64::NAN)
    }

    /// How much of the contact slips.
    fn sliding(&self) -> Sliding {
        Sliding::Apart
    }

    /// The contact radii \[m\] up to which the law of `model` is valid, and from which on there is no contact at all, for bodies of this effective
    /// `radius` \[m\], of which the smaller one has this `size` \[m\].
    #[inline(always)]
    fn widths<B: Borrow<M>>(_model: impl FnOnce() -> B, radius: f64, size: f64) -> [f64; 2] {
        [largest_radius(radius, size), size]
    }

    /// The indentation at which the loading law of `model` has this `contact_radius` \[m\].
    fn depth_of(model: &M, contact_radius: f64) -> f64;

    /// Whether a law of `model` may reject an indentation below the [limit](super::regime::LARGEST_INDENTATION). A fitted law
    /// may end earlier.
    fn may_refuse(model: &M) -> bool;

    /// Makes this contact equal to `other`.
    #[inline(always)]
    fn copy_from(&mut self, other: &Self) {
        *self = *other;
    }

    /// Passes the [`Contact::WORDS`] words of the contact to `store`.
    fn save(&self, store: &mut impl FnMut(u64));

    /// The contact of `model` that [`Contact::save`] has stored. `None` if a number is not finite or a regime does not exist.
    fn load(words: &mut impl Iterator<Item = u64>, model: &M) -> Option<Self>;
}

/// The largest ratio of force to indentation \[N/m\]. It leaves room for the factors that stiffness and pressure add:
/// exponents, and a radius of 1e-12 m.
const STIFFEST: f64 = 1e294;

/// Whether force, stiffness and pressure of `contact` are finite at `rate` \[m/s\]. A contact first touched at almost zero
/// speed can have a damping that overflows.
#[inline(always)]
pub fn is_finite_at<M, C: Contact<M>>(contact: &C, rate: f64) -> bool {
    if !C::FOLLOWS_RATE {
        return true;
    }
    let indentation = contact.indentation();
    // pressure and stiffness have the size of a force over a length; there is no division here, because it would raise a
    // floating-point exception wherever a compiler evaluates it before the comparison
    let length = if indentation < 1.0 { indentation } else { 1.0 };
    indentation <= 0.0 || contact.force(rate) < STIFFEST * length
}

/// First and second derivative of the output `of` a contact by the indentation \[1/m, 1/m^2\], on the smooth piece that the
/// contact is on.
///
/// Uses four points on the side where the piece extends farther. The relative errors are about 1e-10 (first) and 1e-6 (second
/// derivative).
#[inline(never)]
pub fn slopes<M, C: Contact<M>>(contact: &C, model: &M, of: impl Fn(&C) -> f64) -> (f64, f64) {
    /// Distance between the points, as a fraction of the indentation.
    const WIDTH: f64 = 1.0 / 8192.0;
    let (lower, upper) = contact.smooth_piece(model);
    let indentation = contact.indentation();
    let (below, above) = (indentation - lower, upper - indentation);
    let (room, sign) = if above >= below { (above, 1.0) } else { (below, -1.0) };
    let width = if WIDTH * indentation < room / 3.0 { WIDTH * indentation } else { room / 3.0 };
    let near = indentation + sign * width;
    // the width after rounding
    let width = near - indentation;
    if width == 0.0 {
        return (0.0, 0.0);
    }
    let here = of(contact);
    let (mut first, mut second) = (0.0, 0.0);
    for (places, of_first, of_second) in [(1.0, 18.0, -5.0), (2.0, -9.0, 4.0), (3.0, 2.0, -1.0)] {
        let rise = of(&contact.moved_to(model, indentation + places * width)) - here;
        first += of_first * rise;
        second += of_second * rise;
    }
    // the square of a width below some 1e-160 is zero, as are the numbers to be divided by it
    let square = width * width;
    (first / (6.0 * width), quotient(second, square, square > 0.0, 0.0))
}
