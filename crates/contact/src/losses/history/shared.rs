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
        &mut self.plastic
    }

    fn damping(&self) -> Option<Damping> {
        Some(self.damping_for(0.0))
    }

    fn lose(&mut self, model: &Model<L, U, K>, swiftest: f64, heat: f64) -> Result<(), TooDeep> {
        self.swiftest = swiftest;
        self.take(model, heat)
    }
}
