//! The scene as Rust: the file `src/scene.rs` of the library.

mod groups;
mod parameters;
mod variables;

use crate::plan::Plan;
use crate::scene::Scene;
use brinell::contact::damped::AnyDamped;

/// The constants of the planned unit, under the identification `guid`.
pub fn write(plan: &Plan, guid: &str) -> String {
    let (scene, entries) = (plan.scene, plan.variables.as_slice());
    let mut text = String::from(HEAD);
    let uses = if scene.damped.is_some() { "self, Pair, damped" } else { "self, Pair, Surface, loading, unloading" };
    let several = parameters::differing(scene).next().is_some();
    let uses_variable = if several { USES.into() } else { USES.replace("Source, ", "") };
    add(&mut text, &format!("use crate::contact::{{{uses}}};\n{uses_variable}"));
    let loading = value_of(&scene.loading.1);
    // an elastic contact never unloads by another law; the compiler leaves out whatever stands here
    let unloading = scene.unloading.map_or("ContactRadius".into(), |_| value_of(&scene.model().unloading));
    add(
        &mut text,
        &format!(
            "/// What the model description and the binary recognise each other by.\npub const GUID: &str = {guid:?};\n"
        ),
    );
    groups::add_groups(&mut text, scene);
    if let Some((_, law)) = &scene.damped {
        // an enum inside of a law is printed without its path
        let path = match law {
            AnyDamped::HuntCrossley(_) => "damped::hunt_crossley::DampingFactor::",
            _ => "damped::tsuji::TsujiDamping::",
        };
        let value = value_of(law).replace("damping_factor: ", &format!("damping_factor: {path}"));
        add_law(&mut text, "Law", "LAW", "damped", &value);
        add_guard(&mut text, plan);
        add(&mut text, DAMPED_MODEL);
    } else {
        add_law(&mut text, "Loading", "LOADING", "loading", &loading);
        add_law(&mut text, "Unloading", "UNLOADING", "unloading", &unloading);
        add_guard(&mut text, plan);
        groups::add_surface(&mut text, scene);
        add(&mut text, MODEL);
    }
    groups::add_density(&mut text, scene);
    add_coupling(&mut text, scene);
    parameters::add_settable(&mut text, entries);
    parameters::add_parameters(&mut text, scene);
    variables::add_reals(&mut text, entries);
    variables::add_integers(&mut text, entries);
    text
}

const HEAD: &str = "\
//! The scene: which laws, which variables, which start values.
//!
//! `brinell export` writes this file for every scene that it builds. The one in the source tree is that of
//! `scenes/steel_ball.toml`, without identification; a test compares it with what the exporter writes.
";

const USES: &str = "\
use crate::instance::Values;
use crate::variable::{Integer, Parameter, Real, Settable, Source, kind_and_contact};
";

const MODEL: &str = "\
/// What a contact remembers.
pub type History = contact::History;
/// What is in contact, and by which laws.
pub type Model = contact::Model<Loading, Unloading>;

/// What moves a contact through a step by its mass.
pub type Follow = contact::motion::Follow<History, Model>;

/// These bodies with the laws of the scene.
pub fn model(pair: Pair, group: usize, _settable: &Values) -> Model {
    Model { pair, loading: LOADING, unloading: UNLOADING, surface: surface(group) }
}
";

const DAMPED_MODEL: &str = "\
/// What a contact remembers.
pub type History = damped::History<Law>;
/// What is in contact, and by which law.
pub type Model = damped::Model<Law>;

/// What moves a contact through a step by its mass.
pub type Follow = contact::motion::Follow<History, Model>;

/// These bodies with the law of the scene.
pub fn model(pair: Pair, group: usize, settable: &Values) -> Model {
    let value = |which| parameter(which, group, settable);
    damped::Model { pair, law: LAW, restitution: value(Parameter::Restitution), mass: value(Parameter::EffectiveMass) }
}
";

fn add(text: &mut String, paragraph: &str) {
    text.push('\n');
    text.push_str(paragraph);
}

/// The Rust expression of a law: the Debug form of the enum that holds it, without the enum.
fn value_of(law: &impl std::fmt::Debug) -> String {
    let text = format!("{law:?}");
    let inner = text.split_once('(').and_then(|(_, rest)| rest.strip_suffix(')'));
    inner.map_or(text.clone(), str::to_string)
}

fn add_law(text: &mut String, kind: &str, constant: &str, module: &str, value: &str) {
    let guarded = value.strip_prefix("Guarded(").and_then(|value| value.strip_suffix(')'));
    let value = guarded.unwrap_or(value);
    let name = value.split(' ').next().unwrap_or(value);
    // one field a line, as rustfmt has it
    let value = match value.split_once(" { ") {
        Some((name, fields)) => {
            // a comma inside brackets belongs to the field
            let mut depth = 0;
            let fields = fields.trim_end_matches(" }").split(|c| {
                depth += i32::from(c == '[') - i32::from(c == ']');
                c == ',' && depth == 0
            });
            format!("{name} {{\n{}}}", fields.map(|field| format!("    {},\n", field.trim())).collect::<String>())
        }
        None => value.to_string(),
    };
    let (name, value) = match guarded {
        Some(_) => (format!("Guarded<{module}::{name}>"), format!("Guarded({module}::{value})")),
        None => (name.to_string(), value),
    };
    add(
        text,
        &format!(
            "/// The {module} law.\npub type {kind} = {module}::{name};\n\
             /// The {module} law with its constants.\npub const {constant}: {kind} = {module}::{value};\n"
        ),
    );
}

fn add_coupling(text: &mut String, scene: &Scene) {
    let chosen = |names: &[&str]| names.iter().any(|name| scene.outputs.iter().any(|output| output == name));
    let (momentum, predicts) = (chosen(&["impulse", "mean_force"]), chosen(&["predicted_force"]));
    let follow = if scene.knows_mass { "Some(contact::motion::follow)" } else { "None" };
    add(
        text,
        &format!(
            "/// Whether an output tells the momentum of a step.\npub const MOMENTUM: bool = {momentum};\n\
             /// Whether an output predicts the force of the next step.\npub const PREDICTS: bool = {predicts};\n\
             /// How the bodies move through a step, if the unit knows their mass.\npub const FOLLOW: Option<Follow> = {follow};\n"
        ),
    );
}

fn add_guard(text: &mut String, plan: &Plan) {
    let guard = plan.guard.as_ref().map(|guard| format!("the passivity guard {}", guard.words()));
    let guard = format!("pub const GUARD: Option<&str> = {guard:?};\n");
    add(text, &format!("/// Where the passivity guard acts, if there is one.\n{guard}"));
}

/// `value` as a Rust expression that gives the same bits.
fn literal(value: f64) -> String {
    match value {
        f64::INFINITY => "f64::INFINITY".into(),
        large if large.abs() >= 1e6 => format!("{large:e}"),
        _ => format!("{value:?}"),
    }
}

/// A table as rustfmt has it: in one line, or one entry a line.
fn list(name: &str, kind: &str, length: &str, values: &[String]) -> String {
    let head = format!("static {name}: [{kind}; {length}] = [");
    let line = format!("{head}{}];\n", values.join(", "));
    if line.len() < 110 { line } else { format!("{head}\n    {},\n];\n", values.join(",\n    ")) }
}
