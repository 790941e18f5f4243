//! Scenes of one law that fit prebuilt libraries of every kind.

/// Every output of a scene without a known mass, and the additional ones with a known mass.
const STATE: [&str; 11] = [
    "indentation",
    "max_indentation",
    "residual_indentation",
    "contact_radius",
    "mean_pressure",
    "stiffness",
    "work",
    "elastic_energy",
    "dissipated_energy",
    "predicted_force",
    "regime",
];

const RATE_DEPENDENT: [&str; 5] = ["hunt-crossley", "kelvin-voigt", "tsuji", "kuwabara-kono", "adams-impact"];

/// Lines with all the data in which scenes can differ.
const BODIES: &str = "[impactor]\nradius = 10e-3\nyoungs_modulus = 210e9\npoissons_ratio = 0.3\n\
                      [target]\nmaterial = \"aluminium 6061-T6\"\nradius = -50e-3\nsurface = \"fresh\"\n";
/// Two strengths: that of the impactor is the lower one.
const SOFT_IMPACTOR: &str = "[impactor]\nradius = 5e-3\nmaterial = \"aluminium 6061-T6\"\nhardening_modulus = 0.0\n\
                             [target]\nmaterial = \"mild steel\"\n";
const NAMED: &str =
    "[[contact]]\nname = \"left\"\ntarget = { yield_strength = 9e8, density = 5e3 }\ninitial_gap = 1e-6\n";
const COUNTED: &str = "[[contact]]\nname = \"bead\"\ncount = 1\n";
pub const IMPACT: &str = "[impact]\nmass = 4e-3\nspeed = 1.0\n";

/// Whether a law, given by its name or both its names, is rate-dependent.
pub fn is_rate_dependent(law: &str) -> bool {
    RATE_DEPENDENT.contains(&law.split('/').next().unwrap_or(law))
}

/// A scene of `law` (`LOADING` or `LOADING/PARTNER`) with these outputs and these additional lines.
pub fn scene(law: &str, outputs: &[&str], more: &str) -> String {
    let (loading, partner) = law.split_once('/').map_or((law, None), |(loading, partner)| (loading, Some(partner)));
    let mut table = format!("[law]\nloading = {loading:?}\n");
    if let Some(partner) = partner {
        table += &format!("{} = {partner:?}\n", if is_rate_dependent(law) { "damping" } else { "unloading" });
    }
    if ["hunt-crossley", "kelvin-voigt", "tsuji"].contains(&loading) {
        table += "restitution = 0.6\n";
    }
    // the bodies of a test come first
    let bodies = match more.contains("[impactor]") {
        true => "",
        false => "[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n",
    };
    let fmu = match more.contains("[fmu]") {
        true => more.replacen("[fmu]", &format!("[fmu]\noutputs = {outputs:?}"), 1),
        false => format!("[fmu]\noutputs = {outputs:?}\n{more}"),
    };
    format!("name = \"unit\"\n{bodies}{table}{fmu}")
}

fn coupled(law: &str, outputs: &[&str], more: &str) -> String {
    scene(law, outputs, &format!("[coupling]\neffective_mass = 4e-3\n{more}"))
}

/// The lines of a softer impactor; only some laws harden.
fn soft_impactor(law: &str) -> String {
    if law.starts_with("brinell") {
        SOFT_IMPACTOR.into()
    } else {
        SOFT_IMPACTOR.replace("hardening_modulus = 0.0\n", "")
    }
}

/// A scene for each kind of library that supports `law`, with the name of the kind.
pub fn one_of_each_kind(law: &str) -> Vec<(&'static str, String)> {
    let momentum: Vec<_> = STATE.into_iter().chain(["impulse", "mean_force"]).collect();
    let known: Vec<_> = momentum.iter().copied().chain(["closing_speed"]).collect();
    let mut scenes = vec![
        ("force", scene(law, &["indentation"], "")),
        ("state", scene(law, &STATE, IMPACT)),
        ("everything", scene(law, &momentum, &format!("{BODIES}[fmu]\ninitial_gap = 1e-6\n{IMPACT}watch = false\n"))),
    ];
    if !is_rate_dependent(law) {
        let inputs = "master = \"parallel\"\ninputs = [\"external_acceleration\", \"effective_mass\"]\n";
        scenes.push(("serial", coupled(law, &known, &soft_impactor(law))));
        scenes.push(("parallel", coupled(law, &known, inputs)));
    }
    scenes
}

/// Additional scenes of `law`, if it isn't rate-dependent: names, one contact of a group, and the other ways to couple.
pub fn further(law: &str) -> Vec<(&'static str, String)> {
    vec![
        ("state", scene(law, &["indentation", "regime"], NAMED)),
        ("state", scene(law, &["work"], &format!("[fmu]\nparameters = [\"target.yield_strength\"]\n{COUNTED}"))),
        ("parallel", coupled(law, &["closing_speed"], "master = \"parallel\"\n")),
        ("serial", coupled(law, &["work"], "inputs = [\"effective_mass\"]\n")),
        ("serial", coupled(law, &["work"], "inputs = [\"external_acceleration\"]\n")),
    ]
}
