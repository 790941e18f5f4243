//! Long bodies: the largest force with which the end of a rod can push.

use crate::numbers::{quantity, significant};
use crate::scene::Scene;
use brinell_contact::impact::Prediction;
use brinell_contact::validity::wave_speed;
use serde::Serialize;

/// What the plane waves in the rods of a contact allow in an impact.
///
/// A force F at the end of a rod sends a wave into it, and the end gives way at the speed `F/Z`, with the impedance
/// `Z = rho c A` and the wave speed `c = sqrt(E/rho)`. A contact of two rods that meet at `v` is therefore pressed in at the
/// rate `v - F/Z1 - F/Z2`, and the force ends its rise at the latest at `F = v/(1/Z1 + 1/Z2)`: for two equal rods
/// `rho c A v/2`. A body that is no rod counts as heavy and rigid, with `1/Z = 0`.
///
/// It holds until a wave has come back from a far end, after `2 L/c`. From a free end a pull comes back, under which the near
/// end gives way still more: the force then never exceeds the bound. An end that is held, or a wider body behind it, pushes
/// back, and the force may rise further.
///
/// Reference: W. Goldsmith, *Impact*, 1960, chapter 3; K. L. Johnson, *Contact Mechanics*, 1985, chapter 11.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Waves {
    /// Largest force until a wave returns \[N\].
    pub largest_force: f64,
    /// Time until the first wave returns \[s\].
    pub first_return: f64,
    /// Time until a wave has returned in every rod \[s\].
    pub last_return: f64,
}

/// Contact time over the time of the last return from which on a rod counts as compact: at this ratio the largest force of a
/// compact body is 3 % too high in an elastic impact, and at 2 it is 15 %, for a rod with a free end.
pub const COMPACT: f64 = 5.0;

impl Waves {
    /// The waves in the rods of the first contact of `scene` at this closing `speed` \[m/s\]. `None` without rods.
    pub fn of(scene: &Scene, speed: f64) -> Option<Waves> {
        let rods = scene.contacts[0].rods;
        let bodies = [rods.impactor, rods.target].into_iter().zip(scene.bodies(0));
        let rods = bodies.filter_map(|(rod, body)| Some((rod?, wave_speed(body.youngs_modulus, rod?.density))));
        let rods: Vec<_> = rods.collect();
        let mobility: f64 = rods.iter().map(|(rod, wave)| 1.0 / (rod.density * wave * rod.area)).sum();
        let returns = || rods.iter().map(|(rod, wave)| 2.0 * rod.length / wave);
        (!rods.is_empty()).then(|| Waves {
            largest_force: speed / mobility,
            first_return: returns().fold(f64::INFINITY, f64::min),
            last_return: returns().fold(0.0, f64::max),
        })
    }

    /// A line about the bound, if none of these `predictions` exceeds it.
    pub fn note(&self, predictions: &[Prediction]) -> Option<String> {
        let within = predictions.iter().all(|prediction| prediction.max_force <= self.largest_force);
        within.then(|| format!("{}; the predicted force stays below that.", self.bound("The wave in a rod")))
    }

    /// The bound in words, which begin with the name of `what` limits the force.
    fn bound(&self, what: &str) -> String {
        format!(
            "{what} limits the force to {} while it takes {} to return from the far end",
            quantity(self.largest_force, "N"),
            quantity(self.first_return, "s")
        )
    }
}

/// A warning about `waves` whose bound a prediction exceeds.
pub fn too_strong(waves: &Waves) -> String {
    format!("{}; the prediction takes the body as compact, and exceeds that", waves.bound("the wave in a rod"))
}

/// A warning about a contact that lasts `travels` times as long as the last wave needs to return \[s\].
pub fn too_short(travels: f64, last_return: f64) -> String {
    format!(
        "the contact lasts {} times as long as the wave in a rod takes to its far end and back, {}; below {COMPACT} not all of \
         the rod's mass takes part at once, and the predicted force is too high: by 3 % at 5 and 15 % at 2 in an elastic impact",
        significant(travels, 2),
        quantity(last_return, "s")
    )
}
