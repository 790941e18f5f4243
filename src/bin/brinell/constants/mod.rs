//! The scene as Rust: the file `src/scene/exported.rs` of the library.

mod groups;
pub mod kind;
mod model;
mod parameters;
mod variables;

use crate::plan::Plan;
use crate::scene::{Coupling, Scene};
use brinell::contact::damped::AnyDamped;
use std::fmt::Write;

pub use model::{MEMORY, PLANE_MEMORY};
pub use parameters::{parameters, start_value};

/// The scene of the planned FMU as Rust, with the identification `guid`.
pub fn write(plan: &Plan, guid: &str) -> String {
    let (scene, entries) = (plan.scene, plan.variables.as_slice());
    let mut file = File::default();
    file.add_item(&format!(
        "/// Identification that the model description and the binary share.\nconst GUID: &str = {guid:?};\n"
    ));
    file.add_method("guid() -> &'static [u8]", "GUID.as_bytes()");
    file.add_method("identity() -> u64", "const { identity_of(GUID) }");
    groups::add_groups(&mut file, scene);
    parameters::add_settable(&mut file, scene, entries);
    parameters::add_parameters(&mut file, scene);
    add_laws(&mut file, scene);
    model::add_rate(&mut file, scene);
    model::add_model(&mut file, scene);
    groups::add_density(&mut file, scene);
    if scene.watches {
        file.add_method("impact_mass() -> f64", &literal(scene.impact.mass));
    }
    variables::add_reals(&mut file, entries);
    variables::add_integers(&mut file, entries);
    file.text(plan)
}

/// The parts of the file: separate items, and the methods of the scene.
#[derive(Default)]
struct File {
    items: String,
    methods: String,
    /// The types of the model and of the contact.
    model: String,
    contact: String,
}

impl File {
    /// A constant or a table.
    fn add_item(&mut self, item: &str) {
        self.items.push('\n');
        self.items.push_str(item);
    }

    /// A method. `head` is its signature without `fn`.
    fn add_method(&mut self, head: &str, body: &str) {
        let body = body.trim_end().replace('\n', "\n        ");
        write!(self.methods, "\n    fn {head} {{\n        {body}\n    }}\n").expect("a String takes everything");
    }

    /// The whole file.
    fn text(&self, plan: &Plan) -> String {
        let scene = plan.scene;
        let forces = presence(scene.contact_count() > 1 && !scene.is_rate_dependent());
        let (parts, follow) = (parts(scene), follow(scene));
        let guard = match plan.guard.as_ref().map(|guard| format!("the passivity guard {}", guard.words())) {
            Some(words) => format!(
                "\n    const GUARD: Option<Guard<Self>> =\n        Some(Guard {{ words: {words:?}, acts: {}::History::is_held_back }});\n",
                history_module(scene)
            ),
            None => String::new(),
        };
        let values = value_count(&self.items);
        let Self { items, methods, model, contact } = self;
        let implementation = format!(
            "impl Scene for Exported {{
    type Model = {model};
    type Contact = {contact};

    type Contacts<T: Copy> = [T; CONTACTS];
    type Groups<T: Copy> = [T; GROUPS];
    type Values = [f64; {values}];

    type Forces = {forces};
{parts}{follow}{guard}{methods}}}
"
        );
        let text = format!("\n/// The scene of the FMU.\npub struct Exported;\n{items}\n{implementation}");
        format!("{HEAD}\n{}{text}", uses(&text))
    }
}

/// The number of settable values, as an expression.
fn value_count(items: &str) -> &'static str {
    if items.contains("const VALUES:") { "VALUES" } else { "SETTABLE.len()" }
}

fn presence(is: bool) -> &'static str {
    if is { "Present" } else { "Absent" }
}

/// The types that determine which parts of an instance the scene has.
fn parts(scene: &Scene) -> String {
    let chosen = |names: &[&str]| names.iter().any(|name| scene.outputs.iter().any(|output| output == name));
    let momentum = presence(chosen(&["impulse", "mean_force"]));
    let (course, prediction) =
        (presence(has_course(scene)), presence(chosen(&["predicted_force", "predicted_tangential_force"])));
    let coupling = match scene.coupling {
        Some(Coupling { parallel, acceleration_input, mass_input }) => {
            let [account, acceleration, mass] = [parallel, acceleration_input, mass_input].map(presence);
            format!("Coupled<{account}, {acceleration}, {mass}>")
        }
        None => "Absent".into(),
    };
    let watch = presence(scene.watches);
    format!(
        "    type Momentum = {momentum};
    type Course = {course};
    type Prediction = {prediction};
    type Coupling = {coupling};
    type Watch = {watch};
"
    )
}

/// Whether the input may have derivatives. In a scene that moves its bodies, its derivative is their acceleration.
pub fn has_course(scene: &Scene) -> bool {
    scene.input_derivatives && !scene.is_rate_dependent() || scene.coupling.is_some()
}

/// The function that moves the bodies, if the scene moves them.
fn follow(scene: &Scene) -> &'static str {
    match scene.coupling.is_some() {
        true => "\n    const FOLLOW: Option<Follow<Self::Contact, Self::Model>> = Some(follow);\n",
        false => "",
    }
}

/// The `use` declarations of the file.
fn uses(text: &str) -> String {
    let named = |names: &[&'static str]| -> Vec<&'static str> {
        names.iter().copied().filter(|name| text.contains(name.trim_end_matches(" as _"))).collect()
    };
    let mut contact = vec!["self", "Pair"];
    contact.extend(named(&["Surface", "damped", "loading", "losses"]));
    contact.extend(named(&["rate::"]).iter().map(|_| "rate"));
    contact.extend(named(&["tangential::"]).iter().map(|_| "tangential"));
    contact.extend(named(&["unloading"]));
    let follow = match text.contains("Some(follow)") {
        true if text.contains("losses::") => {
            "use crate::contact::losses::follow;\nuse crate::contact::motion::Follow;\n"
        }
        true if text.contains("damped::") => {
            "use crate::contact::damped::follow;\nuse crate::contact::motion::Follow;\n"
        }
        true if text.contains("rate::") => "use crate::contact::motion::Follow;\nuse crate::contact::rate::follow;\n",
        true => "use crate::contact::motion::{Follow, follow};\n",
        false => "",
    };
    let mut scene = named(&["Absent", "Coupled", "Guard", "Integer", "Parameter", "Present", "Real"]);
    scene.extend(["Scene", "Settable", "identity_of"]);
    scene.extend(named(&["with_friction"]));
    // without a contact law, the file does not use these names
    if !text.contains("contact::") {
        contact.remove(0);
    }
    let variable = named(&["Run {", "Source::", "name_in(", "run_of(", "spread("]);
    let variable = match variable.as_slice() {
        [] => "use crate::scene::variable::kind_and_contact;\n".to_string(),
        names => {
            // in the order of rustfmt
            let mut names: Vec<_> = names.iter().map(|name| name.trim_end_matches([' ', '{', ':', '('])).collect();
            let place = names.iter().take_while(|name| **name < "kind_and_contact").count();
            names.insert(place, "kind_and_contact");
            format!("use crate::scene::variable::{{{}}};\n", names.join(", "))
        }
    };
    format!(
        "use crate::contact::{{{}}};\n{follow}{variable}use crate::scene::{{{}}};\n",
        contact.join(", "),
        scene.join(", ")
    )
}

const HEAD: &str = "\
//! The scene of this library.
//!
//! `brinell export` writes this file for every scene that it builds. The file in the source tree is that
//! of `scenes/steel_ball.toml`, without identification; a test compares it with the output of the exporter.
";

/// Adds the laws with their constants.
fn add_laws(file: &mut File, scene: &Scene) {
    if let Some((_, law)) = &scene.damped {
        // the name of an enum inside a law is printed without its path
        let path = match law {
            AnyDamped::HuntCrossley(_) => "damped::hunt_crossley::DampingFactor::",
            _ => "damped::tsuji::TsujiDamping::",
        };
        let value = value_of(law).replace("damping_factor: ", &format!("damping_factor: {path}"));
        let kind = add_law(file, "LAW", "damped", &value);
        file.model = format!("damped::Model<{kind}>");
        file.contact = format!("damped::History<{kind}>");
        return;
    }
    let loading = add_law(file, "LOADING", "loading", &value_of(&scene.loading.1));
    // an elastic contact never unloads by another law; the compiler leaves out whatever is here
    let unloading = scene.unloading.map_or("ContactRadius".into(), |_| value_of(&scene.plain_unloading()));
    let unloading = add_law(file, "UNLOADING", "unloading", &unloading);
    let form = |kind: String, module: &str, has| if has { format!("{module}::Strengthened") } else { kind };
    let [of_loading, of_unloading] = model::strengthened_forms(scene);
    let (loading, unloading) = (form(loading, "loading", of_loading), form(unloading, "unloading", of_unloading));
    let model = format!("Model<{loading}, {unloading}>");
    (file.model, file.contact) = match (scene.has_friction(), scene.loss) {
        (true, _) => (format!("tangential::Rough{model}"), rough_contact(scene)),
        (false, Some(loss)) => {
            let kind = model::kind_of(loss);
            let model = format!("losses::Model<{loading}, {unloading}, losses::{kind}>");
            (model, format!("losses::History<losses::{kind}>"))
        }
        (false, None) => {
            let module = history_module(scene);
            (format!("{module}::{model}"), format!("{module}::History"))
        }
    };
}

/// The module of the library with the history of an elastoplastic contact of `scene`.
fn history_module(scene: &Scene) -> &'static str {
    match scene.loss {
        Some(_) => "losses",
        None if scene.finds_strength() => "rate",
        None => "contact",
    }
}

/// The type of a contact with friction. The mean tangential force is computed only if an output needs it.
fn rough_contact(scene: &Scene) -> String {
    let needs_mean = ["mean_tangential_force", "tangential_impulse", "friction_work"];
    let mean = scene.outputs.iter().any(|output| needs_mean.contains(&output.as_str()));
    let (kind, memory) = match scene.directions {
        2 => ("PlaneContact", PLANE_MEMORY),
        _ => ("RoughContact", MEMORY),
    };
    format!("tangential::{kind}<{memory}, {mean}>")
}

/// The Rust expression of a law: the Debug form of the enum that holds it, without the enum.
fn value_of(law: &impl std::fmt::Debug) -> String {
    let text = format!("{law:?}");
    let inner = text.split_once('(').and_then(|(_, rest)| rest.strip_suffix(')'));
    inner.map_or(text.clone(), str::to_string)
}

/// Adds a law as a constant and returns its type.
fn add_law(file: &mut File, constant: &str, module: &str, value: &str) -> String {
    let guarded = value.strip_prefix("Guarded(").and_then(|value| value.strip_suffix(')'));
    let value = guarded.unwrap_or(value);
    let name = value.split(' ').next().unwrap_or(value);
    // one field on each line, like rustfmt
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
    let (kind, value) = match guarded {
        Some(_) => (format!("{module}::Guarded<{module}::{name}>"), format!("{module}::Guarded({module}::{value})")),
        None => (format!("{module}::{name}"), format!("{module}::{value}")),
    };
    file.add_item(&format!("/// The {module} law with its constants.\nconst {constant}: {kind} = {value};\n"));
    kind
}

/// `value` as a Rust expression with the same bits.
fn literal(value: f64) -> String {
    match value {
        f64::INFINITY => "f64::INFINITY".into(),
        large if large.abs() >= 1e6 => format!("{large:e}"),
        _ => format!("{value:?}"),
    }
}

/// A list formatted like rustfmt: on one line, or with one entry on each line.
fn list(name: &str, kind: &str, length: &str, values: &[String]) -> String {
    let head = format!("static {name}: [{kind}; {length}] = [");
    let line = format!("{head}{}];\n", values.join(", "));
    if line.len() < 110 { line } else { format!("{head}\n    {},\n];\n", values.join(",\n    ")) }
}
