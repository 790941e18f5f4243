//! A contact with friction: a normal contact, its springs, and the tangential rates.

use super::vector::within;
use super::{Friction, FrictionalModel, Normal, Sliding, SpringsOf};
use crate::behaviour::Contact;
use crate::history::History;
use crate::history::path::{RatePolynomial, Sum};
use crate::loading::Loading;
use crate::numerics::{largest, quotient};
use crate::regime::TooDeep;
use crate::unloading::Unloading;

/// The least part of the elastic force that is a limit of springs: with less, they are as good as relaxed.
const LEAST_SHARE: f64 = 1e-9;

/// The largest multiple: where a contact begins, a damping without elastic force would be any.
const MOST_SHARE: f64 = 1e3;

/// The normal `force` \[N\] as a part of the `elastic` one, within the limits of what springs can have.
pub(super) fn share_of(force: f64, elastic: f64) -> f64 {
    let share = quotient(force, elastic, force < MOST_SHARE * elastic, MOST_SHARE);
    if elastic > 0.0 { largest(share, LEAST_SHARE) } else { 1.0 }
}

/// Whether springs can have this share.
pub(super) fn is_share(share: f64) -> bool {
    (LEAST_SHARE..=MOST_SHARE).contains(&share)
}

/// An elastoplastic contact with friction in `D` tangential directions, whose springs form a list of `M` segments; sixteen are
/// recommended.
///
/// The tangential rates are inputs that hold until they are set again; derivatives apply to one step. Every step follows all
/// rates. There is no [short step](Contact::short_step). Without `MEAN`, the mean force, the impulse and the work of friction
/// are not computed and stay zero. The normal part `N` may have a loss, for bodies that [move together](crate::shared).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frictional<const D: usize, const M: usize, const MEAN: bool, N = History> {
    pub(super) normal: N,
    pub(super) springs: SpringsOf<D, M, true>,
    /// The normal force as a part of the elastic one, by which the springs have their limits; 1 without a loss.
    pub(super) share: f64,
    /// Tangential rates over the next step \[m/s\].
    pub(super) courses: [RatePolynomial; D],
    /// Tangential rates at the end of the last step \[m/s\].
    pub(super) ends: [RatePolynomial; D],
    /// Mean tangential force of the last step \[N\].
    pub(super) mean_force: [f64; D],
    /// \[N.s\]
    pub(super) impulse: [Sum; D],
    /// Work of the tangential force \[J\].
    pub(super) work: Sum,
    /// Energy lost by slip before the last step that is not exact \[J\].
    pub(super) lost: f64,
}

/// A contact with friction in one direction.
pub type FrictionalContact<const M: usize, const MEAN: bool = true, N = History> = Frictional<1, M, MEAN, N>;

/// A contact with friction in two directions.
pub type PlaneContact<const M: usize, const MEAN: bool = true, N = History> = Frictional<2, M, MEAN, N>;

impl<const D: usize, const M: usize, const MEAN: bool, N: Normal> Frictional<D, M, MEAN, N> {
    /// The elastoplastic normal contact.
    pub fn normal(&self) -> &History {
        self.normal.plastic()
    }

    /// Relative tangential speeds of the two contact points \[m/s\].
    pub fn tangential_rates(&self) -> [f64; D] {
        self.courses.map(|course| course.rate)
    }

    /// Sets the tangential rates \[m/s\] for the next steps; finite numbers.
    pub fn set_tangential_rates(&mut self, rates: [f64; D]) {
        self.courses = rates.map(RatePolynomial::held);
    }

    /// Tangential forces \[N\] of bodies that close at this `rate` \[m/s\]; positive against positive rates.
    pub fn tangential_forces<L: Loading + Copy, U: Unloading + Copy>(
        &self,
        model: &FrictionalModel<L, U, N::Loss>,
        rate: f64,
    ) -> [f64; D] {
        let indentation = self.normal().indentation();
        if !N::LOSES {
            return self.springs.forces(&model.friction, indentation);
        }
        let mut now = *self;
        let force = self.normal.force(rate);
        now.share_limits(indentation, share_of(force, self.normal().force()));
        within(now.springs.forces(&now.friction(model), indentation), model.friction.coefficient * force)
    }

    /// The friction by which the springs have their limits.
    pub(super) fn friction<L, U>(&self, model: &FrictionalModel<L, U, N::Loss>) -> Friction {
        Friction { coefficient: self.share * model.friction.coefficient, ..model.friction }
    }

    /// Gives the springs at this `indentation` \[m\] limits that are this share of those by the elastic force. Those beyond their new
    /// limits slip.
    pub(super) fn share_limits(&mut self, indentation: f64, share: f64) {
        self.springs.scale_limits(indentation, share / self.share);
        self.share = share;
    }

    /// Mean tangential forces of the last step \[N\].
    pub fn mean_tangential_forces(&self) -> [f64; D] {
        self.mean_force
    }

    /// Integrals of the tangential forces since the start \[N.s\].
    pub fn tangential_impulses(&self) -> [f64; D] {
        self.impulse.map(Sum::total)
    }

    /// Tangential forces \[N\] at the end of a step that is yet to come, with this `rate` of the indentation \[m/s\]
    /// and the current tangential rates.
    ///
    /// # Errors
    /// As for [`Contact::step`].
    pub fn predicted_tangential_forces<L: Loading + Copy, U: Unloading + Copy>(
        &self,
        model: &FrictionalModel<L, U, N::Loss>,
        rate: f64,
        step: f64,
    ) -> Result<[f64; D], TooDeep> {
        let mut moved = *self;
        moved.step(&RatePolynomial::held(rate), step, || model)?;
        Ok(moved.tangential_forces(model, rate))
    }

    /// Elastic energy of the tangential strain \[J\].
    pub fn tangential_energy<L: Loading + Copy, U: Unloading + Copy>(
        &self,
        model: &FrictionalModel<L, U, N::Loss>,
    ) -> f64 {
        self.springs.energy(&self.friction(model), self.normal().indentation())
    }

    /// Energy lost by slip since the start \[J\]: the work of the tangential force that is not stored.
    ///
    /// It never falls. Where the springs of a growing dent or of a full list move approximately, they may store more than the
    /// work; the energy lost then stays until slip has lost as much as was stored too much.
    pub fn friction_work<L: Loading + Copy, U: Unloading + Copy>(&self, model: &FrictionalModel<L, U, N::Loss>) -> f64 {
        largest(self.lost, self.work.total() - self.tangential_energy(model))
    }

    /// Radius of the stick area \[m\].
    pub fn stick_radius<L: Loading + Copy, U: Unloading + Copy>(&self, model: &FrictionalModel<L, U, N::Loss>) -> f64 {
        self.springs.stick_radius(self.normal().contact_radius(&model.normal), self.normal().indentation())
    }

    /// How much of the contact slips.
    pub fn sliding(&self) -> Sliding {
        self.springs.sliding()
    }
}

impl<const N: usize, const MEAN: bool> FrictionalContact<N, MEAN> {
    /// Relative tangential speed of the two contact points \[m/s\], for a ball `v + omega R`.
    pub fn tangential_rate(&self) -> f64 {
        let [rate] = self.tangential_rates();
        rate
    }

    /// Sets the tangential rate \[m/s\] for the next steps; a finite number.
    pub fn set_tangential_rate(&mut self, rate: f64) {
        self.set_tangential_rates([rate]);
    }

    /// Tangential force \[N\]; positive against a positive rate.
    pub fn tangential_force<L: Loading + Copy, U: Unloading + Copy>(&self, model: &FrictionalModel<L, U>) -> f64 {
        let [force] = self.tangential_forces(model, 0.0);
        force
    }

    /// Mean tangential force of the last step \[N\].
    pub fn mean_tangential_force(&self) -> f64 {
        let [force] = self.mean_force;
        force
    }

    /// Integral of the tangential force since the start \[N.s\].
    pub fn tangential_impulse(&self) -> f64 {
        let [impulse] = self.tangential_impulses();
        impulse
    }

    /// [`Frictional::predicted_tangential_forces`] in one direction \[N\].
    ///
    /// # Errors
    /// As for [`Contact::step`].
    pub fn predicted_tangential_force<L: Loading + Copy, U: Unloading + Copy>(
        &self,
        model: &FrictionalModel<L, U>,
        rate: f64,
        step: f64,
    ) -> Result<f64, TooDeep> {
        let [force] = self.predicted_tangential_forces(model, rate, step)?;
        Ok(force)
    }
}
