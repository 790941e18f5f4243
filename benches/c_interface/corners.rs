//! Positions on the branches of the law and before its corners.

use super::exchange::follow;
use super::paths::yield_indentation;
use super::trio::Trio;
use super::unit::{Instance, Status, ok};

/// Length of the steps that lead to a position, and of the step from it [s].
pub const STEP: f64 = 1e-6;

/// Number of steps that lead to each position.
pub const STEPS_BEFORE: usize = 2;

/// A position, and a step from it.
pub struct Place {
    pub name: &'static str,
    /// The steps that lead to it [m].
    pub before: [f64; STEPS_BEFORE],
    /// The step from it [m].
    pub step: f64,
    /// `regime` before and after that step, according to the law.
    regimes: [i32; 2],
}

/// Positions whose steps stay on their branch.
pub fn on_branches() -> Vec<Place> {
    const WAY: f64 = 0.1;
    place_all([
        ("elastic", [0.3, 0.2], WAY, [1, 1]),
        ("first region", [3.0, 2.0], WAY, [2, 2]),
        ("second region", [30.0, 10.0], WAY, [3, 3]),
        ("fully plastic", [130.0, 20.0], WAY, [4, 4]),
        ("unloading", [150.0, -10.0], -WAY, [5, 5]),
        ("reloading", [150.0, -10.0], WAY, [5, 5]),
        ("apart", [150.0, -100.0], -WAY, [0, 0]),
    ])
}

/// Positions whose steps end on another branch. The dent is that of 150 yield indentations, according to `trio`.
pub fn before_corners(trio: &Trio) -> Vec<Place> {
    const DEPTH: f64 = 150.0;
    let instance = trio.units[0].instance();
    follow(&instance, &[DEPTH * yield_indentation()], STEP);
    let recovery = DEPTH - instance.value(trio.exported.reference("residual_indentation")) / yield_indentation();
    place_all([
        ("touch", [-0.5, -0.5], 1.5, [0, 1]),
        ("yield", [0.3, 0.2], 2.0, [1, 2]),
        ("second region", [10.0, 3.0], 2.0, [2, 3]),
        ("full plasticity", [60.0, 22.0], 2.0, [3, 4]),
        ("reversal", [130.0, 20.0], -2.0, [4, 5]),
        ("reloading to the loading curve", [DEPTH, -1.0], 2.0, [5, 4]),
        ("separation", [DEPTH, 1.0 - recovery], -2.0, [5, 0]),
        ("touch again", [DEPTH, -1.0 - recovery], 2.0, [0, 5]),
    ])
}

/// The arguments are in yield indentations.
fn place_all<const N: usize>(places: [(&'static str, [f64; STEPS_BEFORE], f64, [i32; 2]); N]) -> Vec<Place> {
    let unit = yield_indentation();
    let place = |(name, before, step, regimes): (_, [f64; STEPS_BEFORE], f64, _)| Place {
        name,
        before: before.map(|increment| increment * unit),
        step: step * unit,
        regimes,
    };
    places.map(place).into_iter().collect()
}

impl Place {
    /// Whether the step leaves the loading curve by unloading.
    pub fn turns_back(&self) -> bool {
        self.step < 0.0 && self.regimes == [4, 5]
    }
}

/// Checks that each position and its step are as described; `step` makes the step.
pub fn check(trio: &Trio, places: &[Place], step: impl Fn(&Instance, &Place) -> Status) {
    let (unit, regime) = (&trio.with_regime.0, trio.with_regime.1);
    for place in places {
        let instance = unit.instance();
        follow(&instance, &place.before, STEP);
        let before = instance.integer(regime);
        ok(step(&instance, place));
        assert_eq!([before, instance.integer(regime)], place.regimes, "{}", place.name);
    }
}
