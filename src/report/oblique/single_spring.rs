//! The usual contact of discrete-element codes: a single tangential spring with Coulomb's limit. For comparison only.

use super::Rough;
use crate::importer::ImportError;
use brinell_contact::History;
use brinell_contact::loading::AnyLoading;
use brinell_contact::tangential::RoughModel;
use brinell_contact::unloading::AnyUnloading;

/// A contact whose tangential force grows by Mindlin's stiffness `8 G* a` times the slip and is cut at Coulomb's limit. If it
/// `rescales`, the force falls in unloading with the contact radius `a`.
///
/// Reference: O. R. Walton, R. L. Braun, *J. Rheology* 30 (1986) 949-980, in the form of C. Thornton, S. J. Cummins,
/// P. W. Cleary, *Powder Technology* 233 (2013) 30-46.
pub struct SingleSpring {
    model: RoughModel<AnyLoading, AnyUnloading>,
    rescales: bool,
    normal: Option<History>,
    /// \[N\]
    pull: f64,
}

impl SingleSpring {
    /// A contact that has not started.
    pub fn new(model: RoughModel<AnyLoading, AnyUnloading>, rescales: bool) -> SingleSpring {
        SingleSpring { model, rescales, normal: None, pull: 0.0 }
    }
}

impl Rough for SingleSpring {
    fn start(&mut self, gap: f64, _step: f64) -> Result<(), ImportError> {
        (self.normal, self.pull) = (History::start(&self.model.normal, -gap).ok(), 0.0);
        Ok(())
    }

    /// A law that can't be evaluated as deep as this has no force.
    fn step(&mut self, (rate, slip): (f64, f64), step: f64) -> Result<(f64, f64), ImportError> {
        let RoughModel { normal: model, friction } = &self.model;
        let Some(normal) = &mut self.normal else { return Ok((0.0, 0.0)) };
        let before = normal.contact_radius(model);
        if normal.advance(model, rate * step).is_err() {
            return Ok((0.0, 0.0));
        }
        let after = normal.contact_radius(model);
        if self.rescales && rate < 0.0 && before > 0.0 {
            self.pull *= after / before;
        }
        // 4 G* = stiffness_ratio E*
        let stiffness = 2.0 * friction.stiffness_ratio * model.pair.modulus * 0.5 * (before + after);
        let limit = friction.coefficient * normal.force();
        self.pull = (self.pull + stiffness * slip * step).clamp(-limit, limit);
        Ok((normal.force(), self.pull))
    }
}
