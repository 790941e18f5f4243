//! A contact with losses that shares bodies with others.

use super::History;
use crate::loading::Loading;
use crate::losses::{Damping, Loss, Model};
use crate::regime::TooDeep;
use crate::shared::SharedContact;
use crate::unloading::Unloading;

impl<L: Loading, U: Unloading, K: Loss> SharedContact<Model<L, U, K>> for History<K> {
    type Loading = L;
    type Unloading = U;

    fn plastic_model(model: &Model<L, U, K>) -> &crate::Model<L, U> {
        &model.plastic
    }

    fn plastic(&self) -> &crate::History {
        &self.plastic
    }

    fn plastic_mut(&mut self) -> &mut crate::History {
        self.elastoplastic_mut()
    }

    fn damping(&self) -> Option<Damping> {
        Some(self.loss_at_present())
    }

    fn lose(&mut self, model: &Model<L, U, K>, swiftest: f64, heat: f64) -> Result<(), TooDeep> {
        self.add_heat(model, swiftest, heat)
    }
}
