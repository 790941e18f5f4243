//! Scenes for prebuilt libraries of every kind: chosen ones, and random ones of all features.

use super::physics::Random;
use brinell_contact::damped::AnyDamped;
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;

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
/// Two balls on top of each other.
const STACK: &str = "[[body]]\nname = \"lower\"\nmass = 0.033\n[[body]]\nname = \"upper\"\nmass = 0.02\n\
                     [[contact]]\nname = \"floor\"\nbetween = [\"lower\", \"ground\"]\n\
                     [[contact]]\nname = \"pair\"\nbetween = [\"upper\", \"lower\"]\ntarget = { radius = 10e-3 }\n";
/// A crate on two feet.
const CRATE: &str = "[[body]]\nname = \"crate\"\nmass = 0.3\ninertia = [2e-4, 3e-4, 4e-4]\n\
                     [[contact]]\nname = \"left\"\nbetween = [\"crate\", \"ground\"]\nnormal = [0, 0, -1]\ntangent = [1, 0, 0]\n\
                     arms = [[0.03, 0.02, -0.015], []]\n\
                     [[contact]]\nname = \"right\"\nbetween = [\"crate\", \"ground\"]\nnormal = [0, 0, -1]\ntangent = [1, 0, 0]\n\
                     arms = [[0.03, -0.02, -0.015], []]\n";
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

/// Scenes for each kind of library, with the name of the kind.
pub fn of_each_kind() -> Vec<(&'static str, String)> {
    let law = "big-alabo";
    let momentum: Vec<_> = STATE.into_iter().chain(["impulse", "mean_force"]).collect();
    let known: Vec<_> = momentum.iter().copied().chain(["closing_speed"]).collect();
    let inputs = "master = \"parallel\"\ninputs = [\"external_acceleration\", \"effective_mass\"]\n";
    let rate = "[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n\
                rate = { model = \"cowper-symonds\", d = 40.4, q = 5 }\n";
    let with = |text: String, line: &str| text.replacen("[law]\n", &format!("[law]\n{line}\n"), 1);
    let friction = |more: &str| format!("[friction]\ncoefficient = 0.3\n{more}");
    let slides =
        ["tangential_energy", "friction_work", "mean_tangential_force", "predicted_tangential_force", "sliding"];
    let bodies = |tables: &str, more: &str| format!("[coupling]\ninputs = [\"external_acceleration\"]\n{tables}{more}");
    vec![
        ("state", scene(law, &["indentation"], "")),
        ("state", scene(law, &STATE, IMPACT)),
        ("state", scene("brinell", &STATE, SOFT_IMPACTOR)),
        ("momentum", scene(law, &momentum, &format!("{BODIES}[fmu]\ninitial_gap = 1e-6\n{IMPACT}watch = false\n"))),
        ("moved", coupled(law, &known, SOFT_IMPACTOR.replace("hardening_modulus = 0.0\n", "").as_str())),
        ("moved", coupled(law, &known, inputs)),
        ("moved", scene(law, &["indentation", "closing_speed", "impulse_moment"], &bodies(STACK, ""))),
        ("lossy", with(coupled(law, &["indentation", "work", "closing_speed"], ""), "elastic_restitution = 0.9")),
        ("lossy", with(scene(law, &momentum[..], ""), "elastic_restitution = \"waves\"")),
        ("rate", scene(law, &["indentation", "closing_speed"], &format!("{rate}[coupling]\neffective_mass = 4e-3\n"))),
        ("rate", scene(law, &["indentation", "closing_speed"], &format!("{rate}{}", bodies(STACK, "")))),
        (
            "lossy-rate",
            with(coupled(law, &["indentation", "work", "closing_speed"], rate), "elastic_restitution = 0.9"),
        ),
        ("lossy", scene("kuwabara-kono", &["closing_speed", "impulse_moment"], &bodies(STACK, ""))),
        ("lossy", scene("hunt-crossley/flores", &momentum, IMPACT)),
        ("lossy", coupled("tsuji/original", &["closing_speed"], "")),
        ("friction", scene(law, &slides, &friction(""))),
        ("friction-2", scene(law, &slides, &friction("directions = 2\n"))),
        (
            "lossy-friction",
            with(
                scene(law, &["mean_force", "tangential_speed"], &bodies(CRATE, &friction(""))),
                "elastic_restitution = 0.9",
            ),
        ),
        (
            "lossy-friction-2",
            with(
                scene(law, &["friction_work"], &bodies(CRATE, &friction("directions = 2\n"))),
                "elastic_restitution = 0.9",
            ),
        ),
        (
            "lossy-friction-2",
            with(
                scene(law, &["friction_work"], &bodies(CRATE, &friction("directions = 2\n"))),
                "elastic_restitution = \"waves\"",
            ),
        ),
    ]
}

/// A scene with every output of every law, with its name.
pub fn of_every_law() -> Vec<(&'static str, String)> {
    let outputs: Vec<_> = STATE.into_iter().chain(["impulse", "mean_force"]).collect();
    let laws = AnyLoading::of_balls().map(|(name, _)| name).chain(AnyDamped::ALL.map(|(name, _)| name));
    laws.map(|law| (law, scene(law, &outputs, IMPACT))).collect()
}

/// One of some texts.
fn one<'a>(random: &mut Random, texts: &[&'a str]) -> &'a str {
    texts[(random.next() * texts.len() as f64) as usize]
}

/// A scene of random features. Not every one is valid: some features exclude others.
pub fn any_scene(random: &mut Random) -> String {
    let mut is = |probability: f64| random.next() < probability;
    let (damped, moved, frictional, lossy, shared) = (is(0.12), is(0.5), is(0.3), is(0.3), is(0.3));
    let (elastic, socket, fresh, guard, rated, hardens) = (is(0.5), is(0.2), is(0.3), is(0.3), is(0.3), is(0.5));
    let (several, counted, own, constants, held, yields) = (is(0.3), is(0.3), is(0.3), is(0.3), is(0.2), is(0.3));
    let mut text = String::from("name = \"any\"\n[impactor]\n");
    text += &format!("radius = {:e}\n", random.log_uniform(1e-3, 2e-2));
    if elastic || yields {
        text += "youngs_modulus = 210e9\npoissons_ratio = 0.29\n";
    }
    if yields {
        text += &format!("yield_strength = {:e}\n", random.log_uniform(1e8, 1e9));
    }
    text += &format!("[target]\nmaterial = \"mild steel\"\nyield_strength = {:e}\n", random.log_uniform(1e8, 1e9));
    if socket {
        text += "radius = -0.05\n";
    }
    if fresh {
        text += "surface = \"fresh\"\n";
    }
    if rated {
        text += one(
            random,
            &[
                "rate = { model = \"cowper-symonds\", d = 40.4, q = 5 }\n",
                "rate = { model = \"johnson-cook\", c = 0.014, reference_rate = 1.0 }\n",
            ],
        );
    }
    let (plate, pick) = (lossy && random.next() < 0.3, random.next());
    if plate {
        text += "plate_thickness = 0.01\n";
    }
    let name = |all: &[&'static str]| all[(pick * all.len() as f64) as usize];
    let loading = if damped {
        name(&AnyDamped::ALL.map(|law| law.0))
    } else {
        name(&AnyLoading::of_balls().map(|law| law.0).collect::<Vec<_>>())
    };
    if hardens && loading == "brinell" {
        text += &format!("hardening_modulus = {:e}\n", random.log_uniform(1e8, 1e10));
    }
    text += &format!("[law]\nloading = {loading:?}\n");
    if ["hunt-crossley", "kelvin-voigt", "tsuji"].contains(&loading) {
        text += &format!("restitution = {:.3}\n", 0.3 + 0.6 * random.next());
    } else if !damped && loading != "hertz" && random.next() < 0.7 {
        text += &format!("unloading = {:?}\n", one(random, &AnyUnloading::ALL.map(|law| law.0)));
    }
    if guard && !damped {
        text += "passivity_guard = true\n";
    }
    if constants && !damped && ["big-alabo", "brinell", "power", "johnson"].contains(&loading) {
        text += "loading_parameters = { yield_pressure_factor = 1.07 }\n";
    }
    if lossy && !plate && !damped {
        text += one(random, &["elastic_restitution = \"waves\"\n", "elastic_restitution = 0.87\n"]);
    }
    let mut outputs: Vec<&str> = STATE.into_iter().chain(["impulse", "mean_force"]).collect();
    outputs.retain(|_| random.next() < 0.5);
    if moved || shared {
        outputs.push("closing_speed");
    }
    if frictional {
        outputs.extend(["friction_work", "tangential_energy", "sliding", "mean_tangential_force"]);
    }
    text += &format!("[fmu]\noutputs = {outputs:?}\n");
    if held {
        text += "input_derivatives = false\n";
    }
    if own {
        text += "parameters_per_contact = [\"initial_gap\"]\n";
    } else if random.next() < 0.5 {
        text += "parameters = [\"initial_gap\", \"impactor.radius\"]\n";
    }
    text += &format!("[impact]\nmass = 4e-3\nspeed = {:.3}\n", 0.2 + random.next());
    if random.next() < 0.5 {
        text += "watch = false\n";
    }
    if frictional {
        text += &format!("[friction]\ncoefficient = {:.3}\n", random.next());
        text += one(random, &["", "directions = 2\n"]);
    }
    let master = one(random, &["", "master = \"parallel\"\n"]);
    if shared {
        let by_inputs = random.next() < 0.4;
        let inverse = if by_inputs { "inverse_masses = \"input\"\n" } else { "" };
        text += &format!("[coupling]\n{inverse}{master}inputs = [\"external_acceleration\"]\n");
        if by_inputs {
            return text + "[[contact]]\nname = \"foot\"\ncount = 3\n";
        }
        return text + if frictional { CRATE } else { STACK };
    }
    if moved {
        let inputs = one(
            random,
            &[
                "",
                "inputs = [\"external_acceleration\"]\n",
                "inputs = [\"external_acceleration\", \"effective_mass\"]\n",
            ],
        );
        text += &format!("[coupling]\neffective_mass = 4e-3\n{master}{inputs}");
    }
    if several || own {
        text += "[[contact]]\nname = \"left\"\ninitial_gap = 1e-7\n";
        if counted || own {
            text += "count = 3\n";
        }
        text += "[[contact]]\nname = \"right\"\ntarget = { yield_strength = 4e8, density = 5e3 }\n";
    }
    text
}
