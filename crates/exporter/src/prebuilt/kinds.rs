//! The kinds of prebuilt libraries. This is the only list of them.

use crate::library;
use crate::package::Hash;
use crate::scene::Scene;

/// A prebuilt library: what costs in a step or in an instance is its kind, all else is data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Library {
    pub name: &'static str,
    /// Its type in `brinell_fmu::scene::library::kinds`.
    kind: &'static str,
    /// What it is for.
    pub says: &'static str,
}

/// All libraries, in ascending order of cost.
pub const LIBRARIES: [Library; 10] = [
    Library { name: "state", kind: "State", says: "one contact with plastic laws" },
    Library {
        name: "momentum",
        kind: "Momentum",
        says: "plastic laws with `impulse` or `mean_force`, and several contacts",
    },
    Library { name: "moved", kind: "Moved", says: "plastic laws with `[coupling]`, and with `[[body]]`" },
    Library { name: "lossy", kind: "Losses", says: "plastic laws with losses below yield, and rate-dependent laws" },
    Library { name: "rate", kind: "Strengths", says: "plastic laws with `rate`, and `[coupling]` or `[[body]]`" },
    Library { name: "lossy-rate", kind: "LossyStrengths", says: "the same with losses below yield" },
    Library { name: "friction", kind: "Friction", says: "`[friction]` in one direction" },
    Library { name: "friction-2", kind: "Friction2", says: "`[friction]` in two directions" },
    Library {
        name: "lossy-friction",
        kind: "LossyFriction",
        says: "`[friction]` in one direction with losses below yield",
    },
    Library {
        name: "lossy-friction-2",
        kind: "LossyFriction2",
        says: "`[friction]` in two directions with losses below yield",
    },
];

impl Library {
    /// The library that takes `scene`.
    pub fn of(scene: &Scene) -> Library {
        let outputs = |names: &[&str]| scene.outputs.iter().any(|output| names.contains(&output.as_str()));
        let name = match () {
            () if scene.has_friction() && scene.is_rate_dependent() && scene.directions > 1 => "lossy-friction-2",
            () if scene.has_friction() && scene.is_rate_dependent() => "lossy-friction",
            () if scene.has_friction() && scene.directions > 1 => "friction-2",
            () if scene.has_friction() => "friction",
            () if scene.finds_strength() && scene.laws.loss().is_some() => "lossy-rate",
            () if scene.finds_strength() => "rate",
            () if scene.is_rate_dependent() => "lossy",
            () if scene.coupling.is_some() => "moved",
            () if outputs(&["impulse", "mean_force"]) || scene.contact_count() > 1 => "momentum",
            () => "state",
        };
        *LIBRARIES.iter().find(|library| library.name == name).expect("every name is in the list")
    }

    /// The library's own source file, and the hash of all its sources: of this file, and of the `sources` of all libraries, which are
    /// given as a hash.
    pub fn source(&self, sources: &str) -> (String, String) {
        let made_from = Hash::default().with(&self.source_with("")).with(sources).digits();
        (self.source_with(&made_from), made_from)
    }

    /// The source file with this identification.
    pub fn source_with(&self, made_from: &str) -> String {
        library::kind(self.kind, made_from)
    }
}
