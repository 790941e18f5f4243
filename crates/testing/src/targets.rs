//! The FMUs that the conformance suite and the random calls are made of: every kind that there is.

use super::{kinds, long, prebuilt, unit};
use std::path::PathBuf;

/// Scenes of laws and keys that the project's own scenes lack: name, loading law, unloading law, additional lines of the
/// target and of the law.
const FURTHER: [(&str, &str, &str, &str, &str); 5] = [
    ("crossed", "brinell", "brinell", "radius = [8e-3, \"flat\"]\n", ""),
    ("lossy", "brinell", "brinell", "", "elastic_restitution = 0.98\n"),
    ("fresh", "brinell", "brinell", "surface = \"fresh\"\n", ""),
    ("guarded", "jackson-green", "contact-radius", "", "passivity_guard = true\n"),
    ("thornton", "thornton", "thornton", "", ""),
];

const BODIES: &str = "[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n";

/// Outputs that every law has.
const OUTPUTS: &str = "[fmu]\noutputs = [\"indentation\", \"residual_indentation\", \"work\", \"elastic_energy\", \"dissipated_energy\", \
                       \"impulse\", \"predicted_force\", \"regime\", \"regime_number\"]\n";

/// Memory from the importer, parameters of each contact of a group, a hardening target with friction, and bodies that the unit moves:
/// with a mass from outside, and with a law that depends on the rate.
const MORE: [(&str, &str); 5] = [
    (
        "mass_input",
        "[law]\nloading = \"brinell\"\n[coupling]\neffective_mass = 4e-3\ninputs = [\"effective_mass\"]\n[fmu]\noutputs = \
         [\"indentation\", \"contact_radius\", \"elastic_energy\", \"mean_force\", \"predicted_force\", \"closing_speed\"]\n",
    ),
    (
        "moved_and_damped",
        "[law]\nloading = \"hunt-crossley\"\nrestitution = 0.7\n[coupling]\neffective_mass = 4e-3\nmaster = \"parallel\"\n\
         [fmu]\noutputs = [\"stiffness\", \"dissipated_energy\", \"mean_force\", \"predicted_force\", \"closing_speed\"]\n",
    ),
    (
        "hardened",
        "hardening_modulus = 2e9\n[law]\nloading = \"brinell\"\n[friction]\ncoefficient = 0.3\n[fmu]\noutputs = \
         [\"residual_indentation\", \"contact_radius\", \"mean_pressure\", \"elastic_energy\", \"stick_radius\", \"sliding\", \"sliding_number\"]\n",
    ),
    ("standalone", "[fmu]\nstandalone = true\noutputs = [\"indentation\", \"work\"]\n"),
    (
        "own_parameters",
        "[fmu]\noutputs = [\"indentation\", \"regime\"]\n[[contact]]\nname = \"bead\"\ncount = 3\n\
         parameters_per_contact = [\"target.yield_strength\"]\n",
    ),
];

/// The scenes of the project, and the further ones.
pub fn scenes() -> Vec<PathBuf> {
    unit::scenes().into_iter().chain(further()).collect()
}

/// Those whose libraries this run compiles: in a usual one some of the project's, and one that needs it.
pub fn compiled() -> Vec<PathBuf> {
    if long::is_asked() {
        return scenes();
    }
    let standalone = further().into_iter().filter(|scene| scene.ends_with("standalone.toml"));
    unit::scenes_to_compile().into_iter().chain(standalone).collect()
}

/// What this run takes from prebuilt libraries: an FMU of each kind, and in a usual run half of the further scenes.
pub fn from_prebuilt() -> Vec<(String, PathBuf)> {
    let further = if long::is_asked() { Vec::new() } else { further() };
    let further = further.into_iter().skip(1).step_by(2);
    let named = further.filter(|scene| !scene.ends_with("standalone.toml")).map(|scene| {
        (scene.file_stem().expect("a scene file has a name").to_string_lossy().into_owned(), unit::export(&scene))
    });
    prebuilt().into_iter().chain(named).collect()
}

/// The scenes of [`FURTHER`] and [`MORE`].
fn further() -> Vec<PathBuf> {
    let further = FURTHER.map(|(name, loading, unloading, target, law)| {
        let law = format!("[law]\nloading = \"{loading}\"\nunloading = \"{unloading}\"\n{law}");
        unit::write_scene(name, &format!("name = \"{name}\"\n{BODIES}{target}{law}{OUTPUTS}"))
    });
    let more = MORE.map(|(name, text)| unit::write_scene(name, &format!("name = \"{name}\"\n{BODIES}{text}")));
    further.into_iter().chain(more).collect()
}

/// An FMU of each kind of prebuilt library, by the name of the kind.
pub fn prebuilt() -> Vec<(String, PathBuf)> {
    let mut scenes = kinds::of_each_kind();
    scenes.dedup_by_key(|(kind, _)| *kind);
    let fmu = |(kind, text): (&str, String)| {
        // slow contacts must reach the surface
        let text = text.replace("initial_gap = 1e-6", "initial_gap = 0.0");
        (kind.into(), prebuilt::export(&text, Some(prebuilt::store())))
    };
    scenes.into_iter().map(fmu).collect()
}

/// The scene of an FMU of the law `loading`, or of the rate-dependent law `LAW/DAMPING`; `unloading` is the law that it was
/// published with.
pub fn scene_of_law(loading: &str, unloading: Option<&str>) -> PathBuf {
    let (law, damping) = loading.split_once('/').map_or((loading, None), |(law, damping)| (law, Some(damping)));
    let mut text = format!("name = \"law\"\n{BODIES}[law]\nloading = \"{law}\"\n");
    if ["hunt-crossley", "kelvin-voigt", "tsuji"].contains(&law) {
        text += "restitution = 0.7\n";
    }
    // hertz unloads along its loading curve
    let unloading = unloading.filter(|_| law != "hertz").map(|name| format!("unloading = \"{name}\"\n"));
    text += &unloading.unwrap_or_default();
    text += &damping.map(|name| format!("damping = \"{name}\"\n")).unwrap_or_default();
    unit::write_scene(&loading.replace(['/', '-'], "_"), &(text + OUTPUTS))
}
