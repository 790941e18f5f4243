//! The scene as Rust: the file `src/scene.rs` of the library.

use crate::interface::Entry;
use crate::scene::{Group, Parameter, Scene};
use crate::table::{self, Causality, Type, Variable};
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
    let uses = if scene.damped.is_some() { "self, Pair, damped" } else { "self, Pair, Surface, loading, unloading" };
    let several = differing(scene).next().is_some();
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
    add_groups(&mut text, scene);
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
        add_surface(&mut text, scene);
        add(&mut text, MODEL);
    }
    add_density(&mut text, scene);
    add_coupling(&mut text, scene);
    add_settable(&mut text, entries);
    add_parameters(&mut text, scene);
    add_reals(&mut text, entries);
    add_integers(&mut text, entries);
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

fn add_guard(text: &mut String, scene: &Scene) {
    let guard = crate::guard::words(scene).map(|words| format!("the passivity guard {words}"));
    let guard = format!("pub const GUARD: Option<&str> = {guard:?};\n");
    add(text, &format!("/// Where the passivity guard acts, if there is one.\n{guard}"));
}

fn add_settable(text: &mut String, entries: &[Entry]) {
    let settable: Vec<_> = entries.iter().filter(|entry| entry.variable.causality == Causality::Parameter).collect();
    let mut table =
        format!("/// The parameters that can be set.\npub const SETTABLE: [Settable; {}] = [", settable.len());
    for entry in &settable {
        let Entry { variable, start, .. } = entry;
        let unit = variable.unit.as_deref().unwrap_or("");
        let [start, minimum, maximum] = [*start, variable.minimum, variable.maximum]
            .map(|value| literal(value.expect("a parameter has a start value and limits")));
        write!(
            table,
            "\n    Settable {{ name: {:?}, unit: {unit:?}, start: {start}, minimum: {minimum}, maximum: {maximum} }},",
            entry.name(0)
        )
        .expect("a String takes everything");
    }
    table.push_str(if settable.is_empty() { "];\n" } else { "\n];\n" });
    add(text, &table);
}

/// How many contacts there are, in which groups.
fn add_groups(text: &mut String, scene: &Scene) {
    let (contacts, groups) = (scene.contact_count(), scene.contacts.len());
    let names = scene.contacts.iter();
    let names = names.map(|group| format!("({:?}, {})", group.name.as_deref().unwrap_or(""), group.count.is_some()));
    let names = list("GROUP_NAMES", "(&str, bool)", "GROUPS", &names.collect::<Vec<_>>());
    add(
        text,
        &format!(
            "/// How many contacts there are.\npub const CONTACTS: usize = {contacts};\n\
             /// How many groups of equal contacts they form.\npub const GROUPS: usize = {groups};\n\
             /// The name of each group, and whether its contacts are counted.\npub {names}"
        ),
    );
    let (group, end) = if groups == 1 {
        ("pub fn group(_contact: usize) -> usize {\n    0\n", "pub fn end(_group: usize) -> usize {\n    CONTACTS\n")
    } else if groups == contacts {
        (
            "pub fn group(contact: usize) -> usize {\n    contact\n",
            "pub fn end(group: usize) -> usize {\n    group + 1\n",
        )
    } else {
        let mut end = 0;
        let ends = scene.contacts.iter().map(|group| {
            end += group.len();
            end.to_string()
        });
        let ends = list("ENDS", "usize", "GROUPS", &ends.collect::<Vec<_>>());
        add(text, &format!("/// The contact behind the last one of each group.\n{ends}"));
        (
            "pub fn group(contact: usize) -> usize {\n    ENDS.partition_point(|&end| end <= contact)\n",
            "pub fn end(group: usize) -> usize {\n    ENDS.get(group).copied().unwrap_or(CONTACTS)\n",
        )
    };
    add(text, &format!("/// The group of a contact.\n{group}}}\n"));
    add(text, &format!("/// The contact behind the last one of a group.\n{end}}}\n"));
}

/// A table as rustfmt has it: in one line, or one entry a line.
fn list(name: &str, kind: &str, length: &str, values: &[String]) -> String {
    let head = format!("static {name}: [{kind}; {length}] = [");
    let line = format!("{head}{}];\n", values.join(", "));
    if line.len() < 110 { line } else { format!("{head}\n    {},\n];\n", values.join(",\n    ")) }
}

fn add_surface(text: &mut String, scene: &Scene) {
    let name = |group: &Group| match group.surface {
        Surface::Dented => "Surface::Dented".to_string(),
        Surface::Fresh => "Surface::Fresh".to_string(),
    };
    let head = "/// What a new contact of a group meets.\npub fn surface";
    let names: Vec<_> = scene.contacts.iter().map(name).collect();
    add_by_group(text, head, "Surface", ("SURFACES", "What a new contact meets, by group."), &names);
}

fn add_density(text: &mut String, scene: &Scene) {
    let value = |group: &Group| group.density.map_or("None".into(), |density| format!("Some({})", literal(density)));
    let head = "/// Density of the target of a group [kg/m^3], if it is known.\npub fn density";
    let values: Vec<_> = scene.contacts.iter().map(value).collect();
    add_by_group(text, head, "Option<f64>", ("DENSITIES", "Density of the target [kg/m^3], by group."), &values);
}

/// A function of the group that begins with `head`: one value for all, or a table with its name and what it says.
fn add_by_group(text: &mut String, head: &str, kind: &str, (name, says): (&str, &str), values: &[String]) {
    let (argument, body) = if values.iter().all(|value| *value == values[0]) {
        ("_group", values[0].clone())
    } else {
        add(text, &format!("/// {says}\n{}", list(name, kind, "GROUPS", values)));
        ("group", format!("{name}.get(group).copied().unwrap_or_default()"))
    };
    add(text, &format!("{head}({argument}: usize) -> {kind} {{\n    {body}\n}}\n"));
}

/// The variables that a scene can have as parameters.
fn parameters() -> impl Iterator<Item = &'static Variable> {
    table::VARIABLES.iter().filter(|variable| variable.causality == Causality::Parameter)
}

/// Those of them that not all groups have from the same source.
fn differing(scene: &Scene) -> impl Iterator<Item = &'static Variable> {
    let own = |variable: &&Variable, group: &Group| group.own.iter().any(|own| own.name == variable.name);
    parameters()
        .filter(move |variable| scene.contacts.len() > 1 && scene.contacts.iter().any(|group| own(variable, group)))
}

fn add_parameters(text: &mut String, scene: &Scene) {
    // where each group has its own parameters among those that can be set
    let mut first = scene.settable().count();
    let firsts = scene.contacts.iter().map(|group| {
        let own = group.own.iter().filter(|own| own.settable).count();
        first += own;
        first - own
    });
    let firsts: Vec<usize> = firsts.collect();
    let place = |list: &[Parameter], name: &str| {
        let parameter = list.iter().find(|parameter| parameter.name == name)?;
        let place = list.iter().filter(|other| other.settable).position(|other| other.name == name);
        Some((parameter.value, place))
    };
    let source = |group: usize, name: &str| match place(&scene.contacts[group].own, name) {
        Some((_, Some(place))) => Value::Settable(firsts[group] + place),
        Some((value, None)) => Value::Constant(value),
        None => match place(&scene.parameters, name) {
            Some((_, Some(place))) => Value::Settable(place),
            Some((value, None)) => Value::Constant(value),
            None => {
                let absent = ABSENT.iter().find(|(absent, _)| *absent == name);
                Value::Constant(absent.map_or(f64::NAN, |(_, value)| *value))
            }
        },
    };
    let differing: Vec<_> = differing(scene).map(|variable| variable.rust.as_str()).collect();
    let (mut arms, mut tables) = (String::new(), String::new());
    let mut uses_settable = !differing.is_empty();
    for variable in parameters() {
        let value = if differing.contains(&variable.rust.as_str()) {
            let constant = variable.name.replace('.', "_").to_uppercase();
            let sources = (0..scene.contacts.len()).map(|group| match source(group, &variable.name) {
                Value::Settable(place) => format!("Source::Settable({place})"),
                Value::Constant(value) => format!("Source::Constant({})", literal(value)),
            });
            let sources = list(&constant, "Source", "GROUPS", &sources.collect::<Vec<_>>());
            tables.push_str(&format!("\n/// `{}` by group.\n{sources}", variable.name));
            format!("Source::value({constant}.get(group), settable)")
        } else {
            match source(0, &variable.name) {
                Value::Settable(place) => {
                    uses_settable = true;
                    format!("settable[{place}]")
                }
                Value::Constant(value) => literal(value),
            }
        };
        writeln!(arms, "        Parameter::{} => {value},", variable.rust).expect("a String takes everything");
    }
    text.push_str(&tables);
    let group = if differing.is_empty() { "_group" } else { "group" };
    let settable = if uses_settable { "settable" } else { "_settable" };
    add(
        text,
        &format!(
            "/// The value of any parameter for the contacts of a group: set, or constant in this scene.\n\
             pub fn parameter(parameter: Parameter, {group}: usize, {settable}: &Values) -> f64 {{\n    match parameter {{\n{arms}    }}\n}}\n"
        ),
    );
}

/// Where a parameter has its value from.
enum Value {
    /// Place among those that can be set.
    Settable(usize),
    Constant(f64),
}

/// The kinds of variables that a contact has, those of type `kind` as arms of a match.
fn arms(entries: &[Entry], kind: Type) -> (usize, String) {
    let mut kinds: Vec<&Variable> = entries.iter().map(|entry| entry.variable).collect();
    kinds.retain(|variable| variable.causality != Causality::Parameter);
    kinds.dedup_by_key(|variable| variable.name.as_str());
    let arm = |(place, variable): (usize, &&Variable)| {
        (variable.r#type == kind).then(|| format!("        {place} => {kind:?}::{},\n", variable.rust))
    };
    (kinds.len(), kinds.iter().enumerate().filter_map(arm).collect())
}

fn add_reals(text: &mut String, entries: &[Entry]) {
    let (kinds, arms) = arms(entries, Type::Real);
    let settable = entries.iter().any(|entry| entry.variable.causality == Causality::Parameter);
    if settable {
        let count =
            format!("/// How many variables a contact has, beside the parameters.\nconst KINDS: u32 = {kinds};\n");
        add(text, &count);
    }
    let parameter = "        KINDS.. => {
            let index = (kind - KINDS) as usize * CONTACTS + contact;
            return (index < SETTABLE.len()).then_some((Real::Parameter(index), 0));
        }
";
    let parameter = if settable { parameter } else { "" };
    // if all kinds are Real and whatever comes behind them is a parameter nothing is left
    let nothing = if settable && arms.lines().count() == kinds { "" } else { "        _ => return None,\n" };
    add(
        text,
        &format!(
            "/// The Real variable with this value reference, and its contact.\n#[inline]\n\
             pub fn real(value_reference: u32) -> Option<(Real, usize)> {{\n    \
             let (kind, contact) = kind_and_contact(value_reference, CONTACTS);\n    \
             let variable = match kind {{\n{arms}{parameter}{nothing}    }};\n    \
             Some((variable, contact))\n}}\n"
        ),
    );
}

fn add_integers(text: &mut String, entries: &[Entry]) {
    let (_, arms) = arms(entries, Type::Integer);
    let body = if arms.is_empty() {
        "    let _ = value_reference;\n    None\n".to_string()
    } else {
        format!(
            "    let (kind, contact) = kind_and_contact(value_reference, CONTACTS);\n    \
             let variable = match kind {{\n{arms}        _ => return None,\n    }};\n    Some((variable, contact))\n"
        )
    };
    add(
        text,
        &format!(
            "/// The Integer variable with this value reference, and its contact.\n\
             pub fn integer(value_reference: u32) -> Option<(Integer, usize)> {{\n{body}}}\n"
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
