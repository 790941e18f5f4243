//! What every kind of contact does: it starts, moves, shows its force and its energies, and can be saved.

use super::history::{Regime, TooDeep};
use super::path::Course;
use core::borrow::Borrow;
use core::f64::consts::PI;

/// The state of a contact between the bodies of a model `M`. The model says what is in contact and by which laws; the state
/// is everything that the past has left behind.
///
/// All indentations are in m, rates in m/s, forces in N, energies in J, times in s.
pub trait Contact<M>: Copy {
    /// Whether the force depends on the rate at the same instant.
    const FOLLOWS_RATE: bool;

    /// The highest order of a derivative of the force by time that the contact knows.
    const DERIVATIVES: i32;

    /// How many words a saved contact has.
    const WORDS: usize;

    /// What of a model is worth keeping while its bodies stay as they are, because steps that leave their branch ask for it.
    type Kept: Copy + Default;

    /// What is kept of this `model`.
    fn kept(model: &M) -> Self::Kept;

    /// A contact at `gap` \[m\] before any motion; a negative gap is an indentation that is already there.
    ///
    /// # Errors
    /// [`TooDeep`] beyond [`LARGEST_INDENTATION`](super::history::LARGEST_INDENTATION) on either side, and for NaN.
    fn start(model: &M, gap: f64) -> Result<Self, TooDeep>;

    /// Moves the contact by `increment` \[m\] if that takes no more than a few comparisons: on the branch that it is on, or
    /// through the air. Otherwise nothing is done, and the result is false.
    ///
    /// Such a step does the same as [`Contact::step`] with the rate held, to the last bit.
    fn short_step(&mut self, increment: f64) -> bool;

    /// Mean force \[N\] of the last step, which was a [short](Contact::short_step) one and began at the indentation `from` \[m\].
    fn mean_force_of_short_step(&self, from: f64) -> f64;

    /// Moves the contact on `course` over `step` \[s\], and asks for the model only if it needs the law. The result is the largest
    /// indentation on the way \[m\], which a fresh surface forgets.
    ///
    /// # Errors
    /// [`TooDeep`] beyond the range of the law; the contact is then where it was.
    fn step<B: Borrow<M>>(&mut self, course: &Course, step: f64, model: impl Fn() -> B) -> Result<f64, TooDeep>;

    /// [`Contact::step`], with two results: the largest indentation on the way \[m\], and the mean force of the step \[N\]. A contact
    /// that follows the rate has it held.
    ///
    /// # Errors
    /// As for [`Contact::step`].
    fn step_with_mean_force<B: Borrow<M>>(
        &mut self,
        course: &Course,
        step: f64,
        model: impl Fn() -> B,
    ) -> Result<(f64, f64), TooDeep> {
        let mean_force = self.mean_force(model().borrow(), course.rate, step)?;
        Ok((self.step(course, step, model)?, mean_force))
    }

    /// Mean force \[N\] of the last step, which was a [short](Contact::short_step) one along `course`, whose rate keeps its sign,
    /// and began at the indentation `from` \[m\].
    fn mean_force_of_short_course(&self, from: f64, course: &Course, step: f64) -> f64;

    /// [`Contact::step`] with `rate` \[m/s\] held, mostly for a step that is not a [short](Contact::short_step) one. It asks for the
    /// model, of which this much is `kept`, only if it needs the law.
    ///
    /// # Errors
    /// As for [`Contact::step`].
    fn step_held(&mut self, rate: f64, step: f64, kept: &Self::Kept, model: impl Fn() -> M) -> Result<(), TooDeep>;

    /// Mean force \[N\] of a step with `rate` \[m/s\] held that has not been made yet.
    ///
    /// # Errors
    /// As for [`Contact::step`].
    fn mean_force(&self, model: &M, rate: f64, step: f64) -> Result<f64, TooDeep>;

    /// Whether the contact has always been less deep than `depth` \[m\]. If so no [short step](Contact::short_step) reaches it.
    fn stays_within(&mut self, depth: f64) -> bool;

    /// Indentation \[m\]; negative while apart.
    fn indentation(&self) -> f64;

    /// Largest indentation of the present dent or contact \[m\].
    fn max_indentation(&self) -> f64;

    /// Depth of the dent that would remain if the load came off now \[m\].
    fn residual_indentation(&self, model: &M) -> f64;

    /// The part of the law that the contact is on.
    fn regime(&self) -> Regime;

    /// Normal force with this `rate` \[N\], compressive positive; zero while apart.
    fn force(&self, rate: f64) -> f64;

    /// dF/d(rate) \[N.s/m\].
    fn damping(&self, rate: f64) -> f64;

    /// dF/d(indentation) with `rate` held \[N/m\], in the direction of the last motion.
    fn stiffness(&self, rate: f64) -> f64;

    /// d2F/d(indentation)^2 with `rate` held \[N/m^2\].
    fn curvature(&self, model: &M, rate: f64) -> f64;

    /// Contact radius \[m\]; 0 while apart.
    fn contact_radius(&self, model: &M) -> f64;

    /// Force over contact area \[Pa\]; 0 while apart.
    fn mean_pressure(&self, model: &M, rate: f64) -> f64 {
        let radius = self.contact_radius(model);
        // a compiler may divide before it compares: then by one
        let area = if radius > 0.0 { PI * radius * radius } else { 1.0 };
        if radius > 0.0 { self.force(rate) / area } else { 0.0 }
    }

    /// What unloading would give back \[J\].
    fn elastic_energy(&self, model: &M) -> f64;

    /// Work turned into plastic deformation or heat since the start \[J\].
    fn dissipated_energy(&self, model: &M) -> f64;

    /// Work done on the contact by the bodies since the start \[J\]. A contact that starts pressed in counts the way there as
    /// done.
    fn work(&self, model: &M) -> f64 {
        self.elastic_energy(model) + self.dissipated_energy(model)
    }

    /// The ends of the smooth piece of the law that the contact is on \[m\].
    fn smooth_piece(&self, model: &M) -> (f64, f64);

    /// The contact as it would be at another `indentation` \[m\] of its [smooth piece](Contact::smooth_piece), for the slopes of
    /// what it shows.
    fn moved_to(&self, model: &M, indentation: f64) -> Self;

    /// Up to which indentation the law of `model` is valid \[m\].
    fn valid_depth(model: &M) -> f64;

    /// Whether a law of `model` may refuse an indentation below the
    /// [largest](super::history::LARGEST_INDENTATION), as a fit may that ends before.
    fn may_refuse(model: &M) -> bool;

    /// Makes this contact the same as `other`.
    #[inline(always)]
    fn copy_from(&mut self, other: &Self) {
        *self = *other;
    }

    /// Hands the [`Contact::WORDS`] words of the contact to `store`.
    fn save(&self, store: &mut impl FnMut(u64));

    /// The contact of `model` that [`Contact::save`] has stored. `None` if a word is no finite number or no regime.
    fn load(words: &mut impl Iterator<Item = u64>, model: &M) -> Option<Self>;
}

/// The largest force over indentation \[N/m\], with room for the factors of stiffness and pressure beside it: exponents, and a
/// radius of 1e-12 m.
const STIFFEST: f64 = 1e294;

/// Whether force, stiffness and pressure of `contact` are numbers with `rate` \[m/s\]. A contact that was touched at next to no
/// speed can have more damping than there are numbers.
#[inline(always)]
pub fn is_finite_at<M, C: Contact<M>>(contact: &C, rate: f64) -> bool {
    if !C::FOLLOWS_RATE {
        return true;
    }
    let indentation = contact.indentation();
    // pressure and stiffness are forces over lengths, and these are their sizes; no division, which would raise an exception
    // wherever a compiler makes it before the comparison
    let length = if indentation < 1.0 { indentation } else { 1.0 };
    indentation <= 0.0 || contact.force(rate) < STIFFEST * length
}

/// First and second derivative of `of` a contact by the indentation \[1/m, 1/m^2\], on the smooth piece that the contact is on.
///
/// Four points on the side where the piece goes on are enough for some 1e-10 of the first and 1e-6 of the second.
#[inline(never)]
pub fn slopes<M, C: Contact<M>>(contact: &C, model: &M, of: impl Fn(&C) -> f64) -> (f64, f64) {
    /// Distance of the points, as a part of the indentation.
    const WIDTH: f64 = 1.0 / 8192.0;
    let (lower, upper) = contact.smooth_piece(model);
    let indentation = contact.indentation();
    let (below, above) = (indentation - lower, upper - indentation);
    let (room, sign) = if above >= below { (above, 1.0) } else { (below, -1.0) };
    let width = if WIDTH * indentation < room / 3.0 { WIDTH * indentation } else { room / 3.0 };
    let near = indentation + sign * width;
    // the width that the numbers have
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
    (first / (6.0 * width), second / (width * width))
}
