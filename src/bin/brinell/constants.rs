//! The scene as Rust: the file `src/scene.rs` of the library.

use crate::interface::Entry;
use crate::scene::Scene;
use crate::table::{Causality, Type};
use brinell::contact::Surface;
use brinell::contact::damped::AnyDamped;
use std::fmt::Write;

/// What the parameters stand for that a scene hasn't got: a rigid impactor, a flat target, a contact that never yields,
/// no damping.
const ABSENT: [(&str, f64); 6] = [
    ("impactor.youngs_modulus", f64::INFINITY),
    ("impactor.poissons_ratio", 0.0),
    ("target.radius", f64::INFINITY),
    ("target.yield_strength", f64::INFINITY),
    ("restitution", 1.0),
    ("effective_mass", f64::INFINITY),
];

/// The constants of `scene` with the variables `entries`, under the identification `guid`.
pub fn write(scene: &Scene, entries: &[Entry], guid: &str) -> String {
    let mut text = String::from(HEAD);
    let uses = if scene.damped.is_some() { "Pair, damped" } else { "self, Pair, Surface, loading, unloading" };
    add(&mut text, &format!("use crate::contact::{{{uses}}};\n{USES}"));
    let loading = value_of(&scene.loading.1);
    // an elastic contact never unloads by another law; the compiler leaves out whatever stands here
    let unloading = scene.unloading.map_or("ContactRadius".into(), |_| value_of(&scene.model().unloading));
    let surface = match scene.contacts[0].surface {
        Surface::Dented => "Dented",
        Surface::Fresh => "Fresh",
    };
    add(
        &mut text,
        &format!(
            "/// What the model description and the binary recognise each other by.\npub const GUID: &str = {guid:?};\n"
        ),
    );
    if let Some((_, law)) = &scene.damped {
        // an enum inside of a law is printed without its path
        let path = match law {
            AnyDamped::HuntCrossley(_) => "damped::hunt_crossley::DampingFactor::",
            _ => "damped::tsuji::TsujiDamping::",
        };
        let value = value_of(law).replace("damping_factor: ", &format!("damping_factor: {path}"));
        add_law(&mut text, "Law", "LAW", "damped", &value);
        add_guard(&mut text, scene);
        add(&mut text, DAMPED_MODEL);
    } else {
        add_law(&mut text, "Loading", "LOADING", "loading", &loading);
        add_law(&mut text, "Unloading", "UNLOADING", "unloading", &unloading);
        add_guard(&mut text, scene);
        add(&mut text, &format!("/// What a new contact meets.\npub const SURFACE: Surface = Surface::{surface};\n"));
        add(&mut text, MODEL);
    }
    add_settable(&mut text, entries);
    add_parameters(&mut text, scene);
    add_references(&mut text, entries, Type::Real);
    add_references(&mut text, entries, Type::Integer);
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
use crate::variable::{Integer, Parameter, Real, Settable};
";

const MODEL: &str = "\
/// What a contact remembers.
pub type History = contact::History;
/// What is in contact, and by which laws.
pub type Model = contact::Model<Loading, Unloading>;

/// These bodies with the laws of the scene.
pub fn model(pair: Pair, _settable: &Values) -> Model {
    Model { pair, loading: LOADING, unloading: UNLOADING, surface: SURFACE }
}
";

const DAMPED_MODEL: &str = "\
/// What a contact remembers.
pub type History = damped::History<Law>;
/// What is in contact, and by which law.
pub type Model = damped::Model<Law>;

/// These bodies with the law of the scene.
pub fn model(pair: Pair, settable: &Values) -> Model {
    let value = |which| parameter(which, settable);
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

fn add_guard(text: &mut String, scene: &Scene) {
    let guard = crate::guard::words(scene).map(|words| format!("the passivity guard {words}"));
    let guard = format!("pub const GUARD: Option<&str> = {guard:?};\n");
    add(text, &format!("/// Where the passivity guard acts, if there is one.\n{guard}"));
}

fn add_settable(text: &mut String, entries: &[Entry]) {
    let settable: Vec<_> = entries.iter().filter(|entry| entry.variable.causality == Causality::Parameter).collect();
    let mut table =
        format!("/// The parameters that can be set.\npub const SETTABLE: [Settable; {}] = [", settable.len());
    for Entry { variable, start, .. } in &settable {
        let unit = variable.unit.as_deref().unwrap_or("");
        let [start, minimum, maximum] = [*start, variable.minimum, variable.maximum]
            .map(|value| literal(value.expect("a parameter has a start value and limits")));
        write!(
            table,
            "\n    Settable {{ name: {:?}, unit: {unit:?}, start: {start}, minimum: {minimum}, maximum: {maximum} }},",
            variable.name
        )
        .expect("a String takes everything");
    }
    table.push_str(if settable.is_empty() { "];\n" } else { "\n];\n" });
    add(text, &table);
}

fn add_parameters(text: &mut String, scene: &Scene) {
    let mut arms = String::new();
    let mut index = 0;
    for variable in crate::table::VARIABLES.iter().filter(|variable| variable.causality == Causality::Parameter) {
        let own = scene.parameters.iter().find(|parameter| parameter.name == variable.name);
        let value = match own {
            Some(parameter) if parameter.settable => {
                index += 1;
                format!("settable[{}]", index - 1)
            }
            Some(parameter) => literal(parameter.value),
            None => {
                let absent = ABSENT.iter().find(|(name, _)| *name == variable.name);
                literal(absent.expect("only these can be absent").1)
            }
        };
        writeln!(arms, "        Parameter::{} => {value},", variable.rust).expect("a String takes everything");
    }
    let name = if index == 0 { "_settable" } else { "settable" };
    add(
        text,
        &format!(
            "/// The value of any parameter: set, or constant in this scene.\n\
             pub fn parameter(parameter: Parameter, {name}: &Values) -> f64 {{\n    match parameter {{\n{arms}    }}\n}}\n"
        ),
    );
}

fn add_references(text: &mut String, entries: &[Entry], kind: Type) {
    let (name, function, inline) = match kind {
        Type::Real => ("Real", "real", "#[inline]\n"),
        Type::Integer => ("Integer", "integer", ""),
    };
    let mut arms = String::new();
    let mut index = 0;
    for (reference, Entry { variable, .. }) in entries.iter().enumerate() {
        if variable.r#type != kind {
            continue;
        }
        let value = if variable.causality == Causality::Parameter {
            index += 1;
            format!("Parameter({})", index - 1)
        } else {
            variable.rust.clone()
        };
        writeln!(arms, "        {reference} => {name}::{value},").expect("a String takes everything");
    }
    let body = if arms.is_empty() {
        "    let _ = value_reference;\n    None\n".to_string()
    } else {
        format!("    Some(match value_reference {{\n{arms}        _ => return None,\n    }})\n")
    };
    add(
        text,
        &format!(
            "/// The {name} variable with this value reference.\n{inline}\
             pub fn {function}(value_reference: u32) -> Option<{name}> {{\n{body}}}\n"
        ),
    );
}

/// `value` as a Rust expression that gives the same bits.
fn literal(value: f64) -> String {
    match value {
        f64::INFINITY => "f64::INFINITY".into(),
        large if large.abs() >= 1e6 => format!("{large:e}"),
        _ => format!("{value:?}"),
    }
}
