//! Several instances of an FMU, each with a position on its path to which it can be restored.

use super::unit::{Instance, State, Unit, ok};
use std::ptr::null_mut;

pub struct Fleet<'unit> {
    pub instances: Vec<Instance<'unit>>,
    /// The positions: one for all instances, or one for each.
    places: Vec<State>,
}

impl<'unit> Fleet<'unit> {
    /// Instances with an untouched surface.
    pub fn of(unit: &'unit Unit, size: usize) -> Fleet<'unit> {
        let instances: Vec<_> = (0..size).map(|_| unit.instance()).collect();
        let places = instances.iter().take(1).map(saved).collect();
        Fleet { instances, places }
    }

    /// Instances that `prepare` has moved to their positions.
    pub fn placed(unit: &'unit Unit, size: usize, prepare: impl Fn(usize, &Instance)) -> Fleet<'unit> {
        let instances: Vec<_> = (0..size).map(|_| unit.instance()).collect();
        for (index, instance) in instances.iter().enumerate() {
            prepare(index, instance);
        }
        let places = instances.iter().map(saved).collect();
        Fleet { instances, places }
    }

    /// Restores all instances to their positions.
    pub fn restore(&self) {
        for (instance, &place) in self.instances.iter().zip(self.places.iter().cycle()) {
            ok(instance.restore(place));
        }
    }
}

fn saved(instance: &Instance) -> State {
    let mut state = null_mut();
    ok(instance.save(&mut state));
    state
}

impl Drop for Fleet<'_> {
    fn drop(&mut self) {
        for (instance, place) in self.instances.iter().zip(&mut self.places) {
            instance.free(place);
        }
    }
}
