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

/// Either one of some texts or nothing.
fn perhaps(random: &mut Random, probability: f64, texts: &[&str]) -> String {
    if random.next() < probability { one(random, texts).into() } else { String::new() }
}

/// What contacts of a scene touch with.
#[derive(Clone, Copy, PartialEq)]
enum Shape {
    Ball,
    Ellipse,
    Roller,
}

/// The features of a scene.
struct Features {
    shape: Shape,
    /// A rate-dependent law.
    damped: bool,
    /// A loading curve of one's own.
    own_curve: bool,
    /// Nothing yields.
    elastic: bool,
    friction: bool,
    lossy: bool,
    /// The FMU knows a mass for each contact, or the bodies that contacts share.
    moved: bool,
    shared: bool,
    loading: &'static str,
}

impl Features {
    fn any(random: &mut Random) -> Features {
        let mut is = |probability: f64| random.next() < probability;
        let (roller, ellipse, damped, own_curve, elastic) = (is(0.08), is(0.12), is(0.15), is(0.06), is(0.07));
        let (friction, lossy, moved, shared) = (is(0.35), is(0.3), is(0.5), is(0.3));
        let shape = if roller { Shape::Roller } else { Shape::Ball };
        let shape = if ellipse { Shape::Ellipse } else { shape };
        let round = shape == Shape::Ball;
        let names: Vec<&'static str> = match () {
            () if roller && !ellipse => vec!["line"],
            () if damped => AnyDamped::ALL.map(|law| law.0).into(),
            () if own_curve => vec!["own"],
            () if elastic => vec!["hertz"],
            () if ellipse => vec!["brinell", "hertz"],
            () => AnyLoading::of_balls().map(|law| law.0).collect(),
        };
        let own = names[(random.next() * names.len() as f64) as usize];
        // the usual law has most features
        let loading = if names.contains(&"brinell") && random.next() < 0.2 { "brinell" } else { own };
        let (damped, own_curve) = (is_rate_dependent(loading), loading == "own");
        // friction goes with a loss or a mass only where contacts share bodies
        let friction = friction && round && !damped;
        let (lossy, moved) = (lossy && (!friction || shared), moved && !friction);
        Features { shape, damped, own_curve, elastic, friction, lossy, moved, shared, loading }
    }

    /// The strength of a body and what goes with it.
    fn strength(&self, random: &mut Random, body: &str) -> String {
        let power_law = "power_law = { coefficient = 700e6, exponent = 0.2 }\n";
        if self.elastic || self.damped || self.own_curve {
            return String::new();
        }
        let mut text = match self.loading == "brinell" && random.next() < 0.1 {
            true => power_law.to_string(),
            false => format!("yield_strength = {:e}\n", random.log_uniform(1e8, 1e9)),
        };
        if ["brinell", "line"].contains(&self.loading) && !text.starts_with("power") && random.next() < 0.5 {
            let key = one(random, &["hardening_modulus", "tangent_modulus"]);
            text += &format!("{key} = {:e}\n", random.log_uniform(1e8, 1e10));
        }
        let rates = [
            "rate = { model = \"cowper-symonds\", d = 40.4, q = 5 }\n",
            "rate = { model = \"johnson-cook\", c = 0.014, reference_rate = 1.0 }\n",
        ];
        if self.shape != Shape::Roller && random.next() < if body == "target" { 0.25 } else { 0.1 } {
            text += one(random, &rates);
        }
        text
    }

    fn bodies(&self, random: &mut Random) -> String {
        let size = random.log_uniform(1e-3, 2e-2);
        let mut text = String::from("[impactor]\n");
        text += &match self.shape {
            Shape::Ball => format!("radius = {size:e}\n"),
            Shape::Ellipse => format!("radius = [{size:e}, {:e}]\n", size * random.log_uniform(0.2, 5.0)),
            Shape::Roller => format!("shape = \"cylinder\"\nradius = {size:e}\nlength = 0.02\n"),
        };
        if random.next() < 0.5 {
            text += one(
                random,
                &["youngs_modulus = 210e9\npoissons_ratio = 0.29\n", "youngs_modulus = 70e9\npoissons_ratio = 0.22\n"],
            );
            if random.next() < 0.5 {
                text += &self.strength(random, "impactor");
            }
        }
        text += &format!(
            "[target]\nyoungs_modulus = 206e9\npoissons_ratio = {}\ndensity = 7850.0\n",
            one(random, &["0.3", "0.2", "0.45"])
        );
        text += &self.strength(random, "target");
        if self.lossy && !self.damped && random.next() < 0.3 {
            text += "plate_thickness = 0.01\n";
        } else {
            text += &match self.shape {
                Shape::Ball => perhaps(random, 0.25, &["radius = -0.05\n", "radius = 0.03\n"]),
                Shape::Ellipse => perhaps(random, 0.3, &["radius = [-0.2, \"flat\"]\n", "radius = 0.03\n"]),
                Shape::Roller => perhaps(
                    random,
                    0.6,
                    &["thickness = 0.04\nbase = \"bonded\"\n", "radius = -0.05\nthickness = 0.01\n"],
                ),
            };
        }
        text + &perhaps(random, 0.3, &["surface = \"fresh\"\n"])
    }

    fn law(&self, random: &mut Random) -> String {
        let mut text = match self.loading {
            "own" => format!("[law]\nloading = {{ table = {OWN_CURVE} }}\n"),
            "line" => String::from("[law]\n") + &perhaps(random, 0.3, &["size_constant = 11.5\n"]),
            loading => format!("[law]\nloading = {loading:?}\n"),
        };
        match self.loading {
            "hunt-crossley" | "kelvin-voigt" | "tsuji" => {
                text += &format!("restitution = {:.3}\n", 0.3 + 0.6 * random.next());
                text += match self.loading {
                    "hunt-crossley" => one(random, &["", "damping = \"flores\"\n", "damping = \"hunt-crossley\"\n"]),
                    "tsuji" => one(random, &["", "damping = \"original\"\n", "damping = \"lammps\"\n"]),
                    _ => "",
                };
            }
            "own" | "line" | "hertz" => {}
            _ if self.damped => {}
            _ if random.next() < 0.7 => {
                text += &format!("unloading = {:?}\n", one(random, &AnyUnloading::ALL.map(|law| law.0)));
            }
            _ => {}
        }
        if !self.damped && !self.own_curve && !self.friction {
            text += &perhaps(random, 0.25, &["passivity_guard = true\n"]);
        }
        if ["big-alabo", "brinell", "power", "johnson"].contains(&self.loading) {
            text += &perhaps(random, 0.2, &["loading_parameters = { yield_pressure_factor = 1.07 }\n"]);
        }
        if self.lossy && !self.damped {
            text += one(random, &["", "elastic_restitution = \"waves\"\n", "elastic_restitution = 0.87\n"]);
        }
        text
    }

    /// What can be set.
    fn parameters(&self, random: &mut Random) -> Vec<&'static str> {
        let mut all = vec!["initial_gap", "impactor.radius", "target.youngs_modulus", "target.poissons_ratio"];
        all.extend((!self.elastic && !self.damped).then_some("target.yield_strength"));
        all.extend(self.friction.then_some("friction.coefficient"));
        all.extend((self.moved && !self.shared).then_some("effective_mass"));
        all.extend(["hunt-crossley", "kelvin-voigt", "tsuji"].contains(&self.loading).then_some("restitution"));
        let losses = ["elastic_restitution", "target.plate_thickness"];
        all.extend((self.lossy && !self.damped).then(|| one(random, &losses)));
        all.retain(|_| random.next() < 0.35);
        all
    }

    fn fmu(&self, random: &mut Random) -> String {
        let more = ["contact_area", "regime_number", "impulse", "mean_force"];
        let mut outputs: Vec<&str> = STATE.into_iter().chain(more).collect();
        outputs.extend((self.moved || self.shared).then_some("closing_speed"));
        outputs.extend(self.shared.then_some("impulse_moment"));
        if self.friction {
            outputs.extend(["friction_work", "tangential_energy", "sliding", "sliding_number", "stick_radius"]);
            outputs.extend(["mean_tangential_force", "tangential_impulse", "predicted_tangential_force"]);
            outputs
                .extend(self.shared.then_some(["tangential_speed", "tangential_impulse_moment"]).into_iter().flatten());
        }
        outputs.retain(|name| *name == "closing_speed" || random.next() < 0.5);
        let mut text = format!("[fmu]\noutputs = {outputs:?}\n");
        text += &perhaps(random, 0.2, &["input_derivatives = false\n"]);
        text += &perhaps(random, 0.2, &["initial_gap = -1e-7\n"]);
        if random.next() < 0.7 {
            text += &format!("parameters = {:?}\n", self.parameters(random));
        }
        text
    }

    /// The bodies that the FMU moves, or the contacts that it has.
    fn rest(&self, random: &mut Random) -> String {
        let mut text = format!("[impact]\nmass = 4e-3\nspeed = {:.3}\n", 0.2 + random.next());
        text += &perhaps(random, 0.5, &["watch = false\n"]);
        if self.friction {
            text += &format!("[friction]\ncoefficient = {:.3}\n", random.next());
            text += one(random, &["", "directions = 2\n"]);
        }
        let master = one(random, &["", "master = \"parallel\"\n"]);
        if self.shared {
            let by_inputs = random.next() < 0.4;
            let inverse = if by_inputs { "inverse_masses = \"input\"\n" } else { "" };
            text += &format!("[coupling]\n{inverse}{master}inputs = [\"external_acceleration\"]\n");
            return match by_inputs {
                true => text + "[[contact]]\nname = \"foot\"\ncount = 3\n",
                // bodies say the masses
                false => text.replace("mass = 4e-3\n", "") + if self.friction { CRATE } else { STACK },
            };
        }
        if self.moved {
            let inputs = [
                "",
                "inputs = [\"external_acceleration\"]\n",
                "inputs = [\"external_acceleration\", \"effective_mass\"]\n",
            ];
            text += &format!("[coupling]\neffective_mass = 4e-3\n{master}{}", one(random, &inputs));
        }
        if random.next() < 0.35 {
            text += "[[contact]]\nname = \"left\"\ninitial_gap = 1e-7\n";
            let own = [
                "",
                "",
                "parameters_per_contact = [\"initial_gap\"]\n",
                "parameters_per_contact = [\"impactor.radius\"]\n",
            ];
            text += one(random, &["", "count = 3\n"]);
            text += one(random, &own);
            text += "[[contact]]\nname = \"right\"\n";
            text += one(
                random,
                &["", "target = { youngs_modulus = 190e9, density = 5e3 }\n", "impactor = { radius = 4e-3 }\n"],
            );
        }
        text
    }
}

/// A curve that begins as Hertz's of 5 mm on steel and falls behind, up to 20 um.
const OWN_CURVE: &str = "{ depth = [1e-7, 3e-7, 6e-7, 1e-6, 2e-6, 4e-6, 7e-6, 1e-5, 1.4e-5, 2e-5], force = [\
                         0.582, 2.75, 7.16, 14.2, 35.4, 85.3, 170.1, 261.4, 389.9, 590.0] }";

/// A scene of random features, over all that is offered. Not every one is valid: some features exclude others.
pub fn any_scene(random: &mut Random) -> String {
    let features = Features::any(random);
    let parts = [Features::bodies, Features::law, Features::fmu, Features::rest];
    String::from("name = \"any\"\n") + &parts.map(|part| part(&features, random)).concat()
}
