//! The state of a contact whose strength depends on the impact.

use super::{Factors, Model};
use crate::history;
use crate::loading::Loading;
use crate::regime::TooDeep;
use crate::unloading::Unloading;

/// The state of an elastoplastic contact, and the strength that its dent or its present impact has.
///
/// Before the first impact the target has its quasi-static strength; a contact that starts indented was pressed in slowly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct History {
    pub(super) plastic: history::History,
    /// Strengths relative to the quasi-static ones.
    pub(super) factors: Factors,
    /// The closing speed \[m/s\] and the mass \[kg\] that the factors belong to; zero before the first impact.
    pub(super) speed: f64,
    pub(super) mass: f64,
}

impl History {
    /// A contact at `gap` \[m\] before any motion.
    ///
    /// # Errors
    /// [`TooDeep`] as for the [elastoplastic](history::History::start) contact.
    pub fn start<L: Loading + Copy, U: Unloading + Copy>(model: &Model<L, U>, gap: f64) -> Result<History, TooDeep> {
        let plastic = history::History::start(&model.slow, gap)?;
        Ok(History { plastic, factors: Factors::SLOW, speed: 0.0, mass: 0.0 })
    }

    /// The contact with constant strength.
    pub fn plastic(&self) -> &history::History {
        &self.plastic
    }

    /// Strengths relative to the quasi-static ones.
    pub fn factors(&self) -> Factors {
        self.factors
    }

    /// Whether the passivity guard shortens the unloading path of the present dent.
    pub fn is_held_back<L: Loading + Copy, U: Unloading + Copy>(&self, model: &Model<L, U>) -> bool {
        self.plastic.is_held_back(&model.at(self.factors))
    }
}
