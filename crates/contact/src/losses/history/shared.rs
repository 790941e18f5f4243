//! A contact with losses that shares bodies with others.

use super::History;
use crate::loading::Loading;
use crate::losses::{Damping, Loss, Model};
use crate::motion::PlasticContact;
use crate::regime::TooDeep;
use crate::shared::SharedContact;
use crate::unloading::Unloading;

impl<L: Loading, U: Unloading, K: Loss> PlasticContact<Model<L, U, K>> for History<K> {
    type Loading = L;
    type Unloading = U;
    type PlasticModel<'a>
        = &'a crate::Model<L, U>
    where
        Model<L, U, K>: 'a;

    fn plastic_model<'a>(&self, model: &'a Model<L, U, K>) -> &'a crate::Model<L, U> {
        &model.plastic
    }

    fn plastic(&self) -> &crate::History {
        &self.plastic
    }

    fn plastic_mut(&mut self) -> &mut crate::History {
        self.elastoplastic_mut()
    }
}

impl<L: Loading, U: Unloading, K: Loss> SharedContact<Model<L, U, K>> for History<K> {
    fn damping(&self) -> Option<Damping> {
        Some(self.loss_at_present())
    }

    fn lose(&mut self, model: &Model<L, U, K>, swiftest: f64, heat: f64) -> Result<(), TooDeep> {
        self.add_heat(model, swiftest, heat)
    }
}
