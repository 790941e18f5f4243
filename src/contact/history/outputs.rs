//! What a contact shows: force, stiffness, radius, pressure, energies, and the derivatives of the force by time.

use super::{History, Regime, Sum};
use crate::contact::Model;
use crate::contact::loading::Loading;
use crate::contact::unloading::Unloading;
use core::f64::consts::PI;

impl History {
    /// Indentation [m]; negative while apart.
    #[inline]
    pub fn indentation(&self) -> f64 {
        self.indentation.total()
    }

    /// Largest indentation of the present dent [m].
    pub fn max_indentation(&self) -> f64 {
        let indentation = self.indentation();
        if indentation > self.max_indentation { indentation } else { self.max_indentation }
    }

    /// The part of the law the contact is on.
    pub fn regime(&self) -> Regime {
        self.regime
    }

    /// Normal force [N], compressive positive; exactly zero while apart.
    #[inline]
    pub fn force(&self) -> f64 {
        self.segment.force_inside(self.indentation.total())
    }

    /// The force [N] by laws whose branches have a quadratic term only if `squares` says so.
    #[inline(always)]
    pub fn plain_force(&self, _rate: f64, squares: bool) -> f64 {
        if squares { self.force() } else { self.segment.force_without_square(self.indentation.total()) }
    }

    /// The force, which doesn't depend on the rate [N].
    #[inline]
    pub fn force_at_rate(&self, _rate: f64) -> f64 {
        self.force()
    }

    /// Always: the force doesn't depend on the rate.
    #[inline(always)]
    pub fn is_finite_at_rate(&self, _rate: f64) -> bool {
        true
    }

    /// dF/d(indentation) on the present branch [N/m]; at a corner the one in the direction of the last motion.
    pub fn stiffness(&self) -> f64 {
        self.segment.stiffness(self.indentation.total())
    }

    /// The stiffness, which doesn't depend on the rate [N/m].
    pub fn stiffness_at_rate(&self, _rate: f64) -> f64 {
        self.stiffness()
    }

    /// Depth of the dent that would remain if the load were taken off now [m].
    pub fn residual_indentation<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        if model.is_elastic_at(self.max_indentation()) {
            0.0
        } else {
            model.unloading_path(self.max_indentation()).lower
        }
    }

    /// Contact radius [m], 0 while apart: that of the loading law up to the largest indentation, and from there down
    /// that of the unloading law.
    pub fn contact_radius<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        let indentation = self.indentation.total();
        match self.regime {
            Regime::Apart => 0.0,
            Regime::Unloaded if model.loading.can_yield() => {
                let path = model.unloading_path(self.max_indentation());
                let peak = model.peak(self.max_indentation());
                model.unloading.contact_radius(&model.pair, &peak, &path, indentation)
            }
            _ => model.loading.contact_radius(&model.pair, indentation),
        }
    }

    /// Force over contact area [Pa], 0 while apart.
    pub fn mean_pressure<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        let radius = self.contact_radius(model);
        if radius > 0.0 { self.force() / (PI * radius * radius) } else { 0.0 }
    }

    /// The mean pressure, which doesn't depend on the rate [Pa].
    pub fn mean_pressure_at_rate<L: Loading, U: Unloading>(&self, model: &Model<L, U>, _rate: f64) -> f64 {
        self.mean_pressure(model)
    }

    /// What unloading would give back [J].
    pub fn elastic_energy<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        match self.regime {
            Regime::Apart => 0.0,
            Regime::Elastic => model.loading.work(&model.pair, self.indentation.total()),
            _ => model.recovered_work(self.max_indentation(), self.indentation.total()),
        }
    }

    /// Work turned into plastic deformation since the start [J].
    pub fn dissipated_energy<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        self.left_behind + self.dissipated_in_dent(model)
    }

    /// Loading work up to the largest indentation, less what unloading from there gives back [J].
    pub(super) fn dissipated_in_dent<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        let largest = self.max_indentation();
        if model.is_elastic_at(largest) {
            return 0.0;
        }
        model.loading.work(&model.pair, largest) - model.recovered_work(largest, largest)
    }

    /// Work done on the contact by the bodies since the start [J]: the sum of the other two energies, and so a function
    /// of the state, not of the steps that led there. A contact that starts pressed in counts the way there as done.
    pub fn work<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        self.elastic_energy(model) + self.dissipated_energy(model)
    }

    /// Derivative of the force by time [N/s], or of second `order` [N/s^2], with this `rate` [m/s] and its derivative `slope`
    /// [m/s^2], on the branch that the contact is on.
    pub fn force_derivative<L: Loading, U: Unloading>(
        &self,
        order: i32,
        rate: f64,
        slope: f64,
        model: &Model<L, U>,
    ) -> f64 {
        let stiffness = self.stiffness();
        if order == 1 { stiffness * rate } else { self.curvature(model) * rate * rate + stiffness * slope }
    }

    /// d2F/d(indentation)^2 on the present branch [N/m^2]; of a law without segments from its stiffness near by.
    fn curvature<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        let indentation = self.indentation();
        let segmented = model.loading.is_segmented() && U::SEGMENTED;
        if segmented || self.segment.upper > indentation.next_up() {
            return self.segment.curvature(indentation);
        }
        let width = 1e-5 * indentation;
        let slope_at = |indentation: f64| {
            let mut near = *self;
            // at the end of the range there is no neighbour
            let rising = self.least_increment == 0.0;
            near.max_indentation = if rising { 0.0 } else { self.max_indentation };
            near.indentation = Sum::new(0.0);
            near.go_to(model, indentation, rising).map_or(0.0, |()| near.stiffness())
        };
        (slope_at(indentation + width) - slope_at(indentation - width)) / (2.0 * width)
    }
}
