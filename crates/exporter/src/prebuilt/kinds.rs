//! The prebuilt libraries: kinds and laws. This is the only list of them.

use crate::constants;
use crate::model::Dampings;
use crate::package::Hash;
use crate::pairing;
use crate::scene::{Coupling, Scene};
use crate::table::{Causality, VARIABLES, Variable};
use brinell_contact::damped::{AnyDamped, Damped};
use brinell_contact::loading::AnyLoading;
use std::path::Path;

/// Outputs of a library, and its co-simulation algorithm.
pub struct LibraryKind {
    pub name: &'static str,
    outputs: Outputs,
    /// `None` if the library doesn't know the mass.
    master: Option<Master>,
    /// Whether it can warn of unstable steps.
    watches: bool,
    /// Whether the impactor may yield.
    two_strengths: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Master {
    Serial,
    Parallel,
}

/// The outputs of a kind besides the force.
enum Outputs {
    These(&'static [&'static str]),
    AllBut(&'static [&'static str]),
}

/// The kinds, in ascending order of cost. `impulse` and `mean_force` are computed in every step; all other outputs
/// only when they are read. In the first, the impactor never yields.
pub const KINDS: [LibraryKind; 5] = [
    LibraryKind {
        name: "force",
        outputs: Outputs::These(&["indentation", "residual_indentation", "dissipated_energy"]),
        master: None,
        watches: false,
        two_strengths: false,
    },
    LibraryKind {
        name: "state",
        outputs: Outputs::AllBut(&["impulse", "mean_force", "closing_speed", "impulse_moment"]),
        master: None,
        watches: true,
        two_strengths: true,
    },
    LibraryKind {
        name: "everything",
        outputs: Outputs::AllBut(&["closing_speed", "impulse_moment"]),
        master: None,
        watches: true,
        two_strengths: true,
    },
    LibraryKind {
        name: "serial",
        outputs: Outputs::AllBut(&["impulse_moment"]),
        master: Some(Master::Serial),
        watches: false,
        two_strengths: true,
    },
    LibraryKind {
        name: "parallel",
        outputs: Outputs::AllBut(&["impulse_moment"]),
        master: Some(Master::Parallel),
        watches: false,
        two_strengths: true,
    },
];

impl LibraryKind {
    /// Whether this kind has libraries with rate-dependent laws. These laws don't support a known mass.
    fn goes_with_damped(&self) -> bool {
        self.master.is_none()
    }

    fn has_output(&self, name: &str) -> bool {
        match self.outputs {
            Outputs::These(names) => names.contains(&name),
            Outputs::AllBut(names) => !names.contains(&name),
        }
    }

    /// The outputs besides the force, in the order of the table.
    fn outputs(&self) -> impl Iterator<Item = &'static str> {
        let is_output = |variable: &&Variable| variable.causality == Causality::Output && !variable.friction;
        let outputs = VARIABLES.iter().filter(is_output);
        let names = outputs.map(|variable| variable.name.as_str());
        names.filter(|name| *name != "force" && self.has_output(name))
    }

    /// Whether a library of this kind has all that `scene` requests.
    fn takes(&self, scene: &Scene) -> bool {
        let master = scene.coupling.map(|Coupling { parallel, .. }| match parallel {
            true => Master::Parallel,
            false => Master::Serial,
        });
        let watches = self.watches || !scene.watches;
        let laws = !scene.is_rate_dependent() || self.goes_with_damped();
        let has_features = laws && master == self.master && watches;
        let bodies = self.two_strengths || !scene.has_two_strengths();
        has_features && bodies && scene.outputs.iter().all(|output| self.has_output(output))
    }
}

/// The laws of a library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LibraryLaws {
    pub loading: &'static str,
    /// The unloading law, or the damping of a rate-dependent law with several.
    pub partner: Option<&'static str>,
}

impl LibraryLaws {
    /// Every loading law with its default unloading law, and every rate-dependent law with each of its dampings. The law of
    /// scenes that name none comes first: the first laws of a kind say what compiling saves.
    pub fn all() -> Vec<LibraryLaws> {
        let loading = AnyLoading::ALL.into_iter().map(|(loading, _)| {
            let partner = (loading != "hertz").then(|| pairing::default_unloading(loading));
            LibraryLaws { loading, partner }
        });
        let damped = AnyDamped::ALL.into_iter().flat_map(|(loading, law)| {
            let dampings = law.dampings();
            let partners = if dampings.is_empty() { vec![None] } else { dampings.into_iter().map(Some).collect() };
            partners.into_iter().map(move |partner| LibraryLaws { loading, partner })
        });
        let mut all: Vec<_> = loading.chain(damped).collect();
        all.sort_by_key(|laws| laws.loading != pairing::DEFAULT_LOADING);
        all
    }

    /// The rate-dependent law, if there is one.
    fn damped(&self) -> Option<AnyDamped> {
        AnyDamped::ALL.into_iter().find(|(name, _)| *name == self.loading).map(|(_, law)| law)
    }

    /// Both names in one string.
    pub fn name(&self) -> String {
        self.partner.map_or(self.loading.into(), |partner| format!("{}/{partner}", self.loading))
    }

    /// The table `[law]` of a scene with these laws.
    fn table(&self) -> String {
        let mut text = format!("[law]\nloading = {:?}\n", self.loading);
        let damped = self.damped();
        if let Some(partner) = self.partner {
            text += &format!("{} = {partner:?}\n", if damped.is_some() { "damping" } else { "unloading" });
        }
        if damped.is_some_and(|law| law.needs_restitution()) {
            text += "restitution = 0.7\n";
        }
        text
    }
}

/// One prebuilt library.
pub struct Library {
    pub laws: LibraryLaws,
    pub kind: &'static LibraryKind,
    /// A scene with everything that the library has.
    pub scene: Scene,
}

impl Library {
    fn new(laws: LibraryLaws, kind: &'static LibraryKind) -> Library {
        let outputs = kind.outputs().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
        let strength = if kind.two_strengths { "material = \"mild steel\"\nyield_strength = 1e9\n" } else { "" };
        let mut text = format!(
            "name = \"prebuilt\"\n[impactor]\nradius = 5e-3\n{strength}[target]\nmaterial = \"mild steel\"\n[fmu]\n\
             outputs = [{outputs}]\n[impact]\nmass = 4e-3\nspeed = 1.0\nwatch = {}\n{}",
            kind.watches,
            laws.table()
        );
        if let Some(master) = kind.master {
            let master = if master == Master::Parallel { "parallel" } else { "serial" };
            text += &format!(
                "[coupling]\neffective_mass = 4e-3\nmaster = {master:?}\n\
                 inputs = [\"external_acceleration\", \"effective_mass\"]\n"
            );
        }
        let scene = Scene::parse(text, Path::new(kind.name));
        Library { laws, kind, scene: scene.expect("the scenes of the kinds are right with every law") }
    }

    /// All libraries, grouped by kind.
    pub fn all() -> Vec<Library> {
        let laws = LibraryLaws::all();
        let of_kind = |kind: &'static LibraryKind| {
            let fitting = laws.iter().filter(|laws| laws.damped().is_none() || kind.goes_with_damped());
            fitting.map(|laws| Library::new(*laws, kind)).collect::<Vec<_>>()
        };
        KINDS.iter().flat_map(of_kind).collect()
    }

    /// The smallest prebuilt library with these laws that has everything the scene needs; `None` for other laws.
    pub fn for_scene(laws: LibraryLaws, scene: &Scene) -> Option<Library> {
        KINDS.iter().find(|kind| kind.takes(scene)).map(|kind| Library::new(laws, kind))
    }

    pub fn name(&self) -> String {
        format!("{} {}", self.laws.name(), self.kind.name)
    }

    /// The library's own source file, and the hash of all its sources: of this file, and of the `sources` of all libraries, which are
    /// given as a hash.
    pub fn source(&self, sources: &str) -> (String, String) {
        let file = constants::kind::write(&self.scene, "");
        let made_from = Hash::default().with(&file).with(sources).digits();
        (constants::kind::write(&self.scene, &made_from), made_from)
    }
}

#[cfg(test)]
mod tests {
    use super::{KINDS, Library, LibraryLaws};
    use crate::scene::Scene;
    use std::collections::HashSet;
    use std::path::Path;

    #[test]
    fn every_law_is_prebuilt_in_every_kind_that_it_goes_with() {
        let all = Library::all();
        let names: HashSet<_> = all.iter().map(Library::name).collect();
        assert_eq!(names.len(), all.len(), "each has a name of its own");
        let damped = LibraryLaws::all().iter().filter(|laws| laws.damped().is_some()).count();
        assert_eq!(all.len(), (LibraryLaws::all().len() - damped) * KINDS.len() + damped * 3);
    }

    #[test]
    fn of_each_kind_the_library_of_a_scene_without_a_law_comes_first() {
        let text = "name = \"plain\"\nimpactor = { radius = 5e-3 }\ntarget = { material = \"mild steel\" }\n";
        let scene = Scene::parse(text.into(), Path::new("plain.toml")).expect("a scene");
        let laws = LibraryLaws { loading: scene.loading.0, partner: scene.unloading.map(|(name, _)| name) };
        let all = Library::all();
        for kind in &KINDS {
            let first = all.iter().find(|library| library.kind.name == kind.name).expect("no kind is empty");
            assert_eq!(first.laws, laws, "{}", kind.name);
        }
    }

    /// Otherwise the library of a later kind would never be used.
    #[test]
    fn the_scene_of_each_library_is_one_that_this_library_is_taken_for() {
        for library in Library::all() {
            let found = Library::for_scene(library.laws, &library.scene).expect("there is one");
            assert_eq!(found.name(), library.name());
        }
    }
}
