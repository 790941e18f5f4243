//! A contact with friction: a normal contact, its springs, and the tangential rate.

use super::{RoughModel, Sliding, Springs};
use crate::contact::behaviour::Contact;
use crate::contact::history::{History, TooDeep};
use crate::contact::loading::Loading;
use crate::contact::path::{Course, Sum};
use crate::contact::unloading::Unloading;

/// An elastoplastic contact with friction, whose springs form a list of `N` segments.
///
/// The tangential rate is an input that holds until it is set again; derivatives apply to one step. Every step follows both
/// rates. There is no [short step](Contact::short_step).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughContact<const N: usize> {
    pub(super) normal: History,
    pub(super) springs: Springs<N>,
    /// Tangential rate over the next step \[m/s\].
    pub(super) course: Course,
    /// Tangential rate at the end of the last step \[m/s\].
    pub(super) end: Course,
    /// Mean tangential force of the last step \[N\].
    pub(super) mean_force: f64,
    /// \[N.s\]
    pub(super) impulse: Sum,
    /// Work of the tangential force \[J\].
    pub(super) work: Sum,
}

impl<const N: usize> RoughContact<N> {
    /// The normal contact.
    pub fn normal(&self) -> &History {
        &self.normal
    }

    /// Relative tangential speed of the two contact points \[m/s\], for a ball `v + omega R`.
    pub fn tangential_rate(&self) -> f64 {
        self.course.rate
    }

    /// Sets the tangential rate \[m/s\] for the next steps; a finite number.
    pub fn set_tangential_rate(&mut self, rate: f64) {
        self.course = Course::held(rate);
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
