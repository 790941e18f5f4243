//! The outputs of a contact: force, stiffness, curvature, radius, energies.

use super::{History, Regime};
use crate::Model;
use crate::behaviour::{Contact, slopes};
use crate::loading::Loading;
use crate::numerics::next_above;
use crate::unloading::Unloading;

impl History {
    /// Indentation \[m\]; negative while apart.
    #[inline]
    pub fn indentation(&self) -> f64 {
        self.indentation.total()
    }

    /// Largest indentation of the present dent \[m\].
    pub fn max_indentation(&self) -> f64 {
        let indentation = self.indentation();
        if indentation > self.max_indentation { indentation } else { self.max_indentation }
    }

    /// The part of the law that the contact is on.
    pub fn regime(&self) -> Regime {
        self.regime
    }

    /// Whether the passivity guard shortens the unloading path of the present dent.
    pub fn is_held_back<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> bool {
        matches!(self.regime, Regime::Unloaded | Regime::Apart) && model.is_held_back_at(self.max_indentation())
    }

    /// Normal force \[N\], compressive positive; exactly zero while apart.
    #[inline]
    pub fn force(&self) -> f64 {
        self.segment.force(self.indentation.total())
    }

    /// dF/d(indentation) on the present branch \[N/m\]; at a corner, the slope in the direction of the last motion.
    pub fn stiffness(&self) -> f64 {
        match self.regime {
            Regime::Apart => 0.0,
            _ => self.segment.stiffness(self.indentation.total()),
        }
    }

    /// Depth of the dent that would remain if the load were removed now \[m\].
    pub fn residual_indentation<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        model.residual_indentation(self.max_indentation())
    }

    /// Contact radius \[m\], 0 while apart. While loading it follows the loading law, below the largest indentation the
    /// unloading law.
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

    /// Force over contact area \[Pa\], 0 while apart.
    pub fn mean_pressure<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        Contact::mean_pressure(self, model, 0.0)
    }

    /// Work done on the contact by the bodies since the start \[J\]. It is the sum of the two energies, and so a function of
    /// the state, not of the steps that led there. For a contact that starts indented, it includes the work of reaching the
    /// initial indentation.
    pub fn work<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        Contact::work(self, model)
    }

    /// Energy that unloading would return \[J\].
    pub fn elastic_energy<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        match self.regime {
            Regime::Apart => 0.0,
            Regime::Elastic => model.loading.work(&model.pair, self.indentation.total()),
            _ => model.recovered_work(self.max_indentation(), self.indentation.total()),
        }
    }

    /// Energy dissipated by plastic deformation since the start \[J\].
    pub fn dissipated_energy<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        self.left_behind + self.dissipated_in_dent(model)
    }

    /// Work of loading up to the largest indentation, minus the energy that unloading from there returns \[J\].
    pub(super) fn dissipated_in_dent<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        let largest = self.max_indentation();
        if model.is_elastic_at(largest) {
            return 0.0;
        }
        model.loading.work(&model.pair, largest) - model.recovered_work(largest, largest)
    }

    /// Whether the branch is a segment of a chain, and no tangent.
    pub(super) fn is_in_chain<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> bool {
        model.has_chain() && self.segment.upper > next_above(self.segment.lower)
    }

    /// d2F/d(indentation)^2 on the present branch \[N/m^2\]. For a law without segments it is computed from the stiffness at
    /// neighbouring points.
    pub fn curvature<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        let indentation = self.indentation();
        let segmented = match self.regime {
            Regime::Apart => return 0.0,
            Regime::Elastic => model.has_elastic_segment() || self.is_in_chain(model),
            Regime::Unloaded => model.unloading.is_segmented(),
            _ => model.loading.is_segmented(),
        };
        match segmented {
            true => self.segment.curvature(indentation),
            false => slopes(self, model, History::stiffness).0,
        }
    }
}
