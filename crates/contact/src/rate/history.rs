//! The state of a contact whose strength depends on the impact.

use super::{Factors, Model, Slow, are_factors};
use crate::history;
use crate::impact::Impact;
use crate::losses::Damping;
use crate::motion::PlasticContact;
use crate::numerics::largest;
use crate::regime::TooDeep;
use crate::shared::SharedContact;
use libm::fabs;

/// The number of evaluations that a prediction of an impact counts for.
const PREDICTION: u32 = 200;

/// Speeds that differ by less, as a fraction, have the same strength: an elastic rebound returns with its speed but for
/// rounding.
const SAME: f64 = 1e-12;

/// The state of a contact `C`, and the strength that its dent or its present impact has.
///
/// Before the first impact the target has its quasi-static strength; a contact that starts indented was pressed in slowly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct History<C = history::History> {
    /// The contact with constant strength.
    pub(super) contact: C,
    /// Strengths relative to the quasi-static ones.
    pub(super) factors: Factors,
    /// The closing speed \[m/s\] and the mass \[kg\] that the factors belong to; zero before the first impact.
    pub(super) speed: f64,
    pub(super) mass: f64,
}

impl<C> History<C> {
    /// The contact with constant strength.
    pub fn contact(&self) -> &C {
        &self.contact
    }

    /// Strengths relative to the quasi-static ones.
    pub fn factors(&self) -> Factors {
        self.factors
    }

    /// Whether the passivity guard shortens the unloading path of the present dent.
    pub fn is_held_back<M: Slow>(&self, model: &Model<M>) -> bool
    where
        C: PlasticContact<M>,
    {
        self.contact.plastic().is_held_back(&model.plastic_at(self.factors))
    }
}

impl<M: Slow, C: PlasticContact<M>> PlasticContact<Model<M>> for History<C> {
    type Loading = M::Loading;
    type Unloading = M::Unloading;
    type PlasticModel<'a>
        = crate::Model<M::Loading, M::Unloading>
    where
        Model<M>: 'a;

    fn plastic_model(&self, model: &Model<M>) -> crate::Model<M::Loading, M::Unloading> {
        model.plastic_at(self.factors)
    }

    fn plastic(&self) -> &history::History {
        self.contact.plastic()
    }

    fn plastic_mut(&mut self) -> &mut history::History {
        self.contact.plastic_mut()
    }

    fn is_new(&self, impact: &Impact) -> bool {
        impact.mass != self.mass || fabs(impact.speed - self.speed) > SAME * largest(impact.speed, self.speed)
    }

    /// The strength is that of a free impact.
    fn strengthen(
        &mut self,
        model: &Model<M>,
        impact: &Impact,
    ) -> Result<(crate::Model<M::Loading, M::Unloading>, u32), TooDeep> {
        let energy = impact.energy();
        let (factors, predictions) = match model.in_impact(impact) {
            Some(found) => (found.factors, found.steps),
            // an energy without its full precision: the impact is slower than any reference rate
            None if energy < f64::MIN_POSITIVE => (Factors::SLOW, 1),
            None => return Err(TooDeep { indentation: f64::INFINITY }),
        };
        if !are_factors(factors) {
            return Err(TooDeep { indentation: f64::INFINITY });
        }
        (self.factors, self.speed, self.mass) = (factors, impact.speed, impact.mass);
        // what another strength took elastically may be beyond the yield point of this one
        self.contact.plastic_mut().forget_elastic();
        // most impacts are free
        Ok((model.plastic_at(factors).prepared_for(energy), PREDICTION * predictions))
    }
}

impl<M: Slow, C: SharedContact<M>> SharedContact<Model<M>> for History<C> {
    const HAS_CLOSED_FORM: bool = C::HAS_CLOSED_FORM;

    fn damping(&self) -> Option<Damping> {
        self.contact.damping()
    }

    fn lose(&mut self, model: &Model<M>, swiftest: f64, heat: f64) -> Result<(), TooDeep> {
        self.contact.lose(&model.at(self.factors), swiftest, heat)
    }
}
