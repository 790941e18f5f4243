//! The scene as data in Rust: the file `crates/unit/src/exported.rs` of the library, a call of `scene!`.

mod laws;
mod parameters;

use crate::interface::{Entry, INVERSE_MASS, inverse_mass_inputs};
use crate::plan::Plan;
use crate::scene::{Coupling, Group, InverseMasses, Scene};
use crate::table::{Causality, Symbol, Variable};
use std::fmt::{Display, Write};

pub use brinell_fmu::scene::prebuilt::kinds::MEMORY;
pub use parameters::{Sources, Value, first_contact, parameters, start_value};

const HEAD: &str = "\
//! The scene of this library.
//!
//! `brinell export` writes this file for every scene that it builds. The file in the source tree is that
//! of `scenes/steel_ball.toml`, without identification; a test compares it with the output of the exporter.
";

/// The scene of the planned FMU as Rust, with the identification `guid`.
pub fn write(plan: &Plan, guid: &str) -> String {
    let (scene, entries) = (plan.scene, plan.variables.as_slice());
    let mut file = File::new(HEAD, "scene");
    file.add("guid", format_args!("{guid:?}"));
    add_groups(&mut file, scene);
    file.add("laws", laws::of(scene));
    if let Some(guard) = &plan.guard {
        file.add("guard", format_args!("{:?}", format!("the passivity guard {}", guard.words())));
    }
    if scene.watches {
        file.add("impact_mass", literal(scene.impact.mass));
    }
    let forces = presence(keeps_forces(scene));
    let starts = plan.variables.iter().filter(|entry| entry.variable.name == INVERSE_MASS);
    let starts = starts.flat_map(|entry| vec![entry.start.unwrap_or(0.0); entry.count]);
    match &scene.inverse_masses {
        Some(InverseMasses::Constant(entries)) => {
            file.add("inverse_masses", list(entries.iter().copied().map(literal)))
        }
        Some(InverseMasses::Inputs) => file.add("inverse_masses", list(starts.map(literal))),
        None => {}
    }
    let shared = presence(scene.inverse_masses.is_some());
    let inputs = inverse_mass_inputs(scene);
    // a strength that each impact finds makes other bodies of the two
    let prepared = presence(scene.is_paired() && !scene.finds_strength());
    let bodies = format!("Shared = {shared}, InverseMasses = [f64; {inputs}], Prepared = {prepared}");
    file.add("parts", format_args!("{{ Forces = {forces}, {}, {bodies} }}", parts(scene)));
    parameters::add_settable(&mut file, scene, entries);
    parameters::add_sources(&mut file, scene);
    let kinds = kinds_of(entries);
    file.add("kinds", kinds.len());
    file.add_places(kinds.into_iter().enumerate());
    file.text + "}\n"
}

/// The kinds of variables of a contact without parameters, in the order of their references.
fn kinds_of<'a>(entries: &'a [Entry]) -> Vec<&'a Variable> {
    let mut kinds: Vec<&Variable> = entries.iter().map(|entry| entry.variable).collect();
    kinds.retain(|variable| variable.causality != Causality::Parameter && variable.name != INVERSE_MASS);
    kinds.dedup_by_key(|variable| variable.name.as_str());
    kinds
}

/// Their names.
pub fn kinds<'a>(plan: &'a Plan) -> Vec<&'a str> {
    kinds_of(&plan.variables).into_iter().map(|variable| variable.name.as_str()).collect()
}

/// The kind of a prebuilt library as Rust: the file `crates/unit/src/kind.rs` of the library. `made_from` identifies it.
pub fn kind(kind: &str, made_from: &str) -> String {
    format!(
        "{HEAD_OF_KIND}\n/// The kind.\npub type Library = brinell_fmu::scene::prebuilt::kinds::{kind};\n\n\
         /// A hash of the sources of the library.\npub const MADE_FROM: &str = {made_from:?};\n"
    )
}

const HEAD_OF_KIND: &str = "\
//! The kind of this library, if it is a prebuilt one.
//!
//! `brinell prebuild` writes this file for every library that it builds. The file in the source tree is that of the kind `state`,
//! without identification; a test compares it with the output of the program.
";

/// Whether the forces of contacts are stored. A single contact, or one whose force depends on the rate, computes its own on request.
pub fn keeps_forces(scene: &Scene) -> bool {
    scene.contact_count() > 1 && !scene.is_rate_dependent()
}

/// A file with one call of a macro.
struct File {
    text: String,
}

impl File {
    fn new(head: &str, name: &str) -> File {
        File { text: format!("{head}\nbrinell_fmu::scene::{name}! {{\n") }
    }

    /// Adds an entry.
    fn add(&mut self, key: &str, value: impl Display) {
        writeln!(self.text, "    {key}: {value},").expect("a String takes everything");
    }

    /// Adds an entry with a line for each row.
    fn add_rows(&mut self, key: &str, rows: impl IntoIterator<Item = String>) {
        let rows: String = rows.into_iter().map(|row| format!("        {row},\n")).collect();
        self.add(key, if rows.is_empty() { "{}".into() } else { format!("{{\n{rows}    }}") });
    }

    /// Adds the variables, those of each type apart, by their places.
    fn add_places<'a>(&mut self, variables: impl Iterator<Item = (usize, &'a Variable)>) {
        let symbols: Vec<_> = variables.map(|(place, variable)| (place, variable.symbol())).collect();
        let listed = |wanted: fn(&Symbol) -> bool| {
            let listed = symbols.iter().filter(|(_, symbol)| wanted(symbol));
            let listed: Vec<_> = listed.map(|(place, symbol)| format!("{place}: {symbol}")).collect();
            if listed.is_empty() { "{}".into() } else { format!("{{ {} }}", listed.join(", ")) }
        };
        self.add("reals", listed(|symbol| matches!(symbol, Symbol::Real(_))));
        self.add("integers", listed(|symbol| matches!(symbol, Symbol::Integer(_))));
    }
}

/// Adds the contacts, their groups, and what differs between the tables of the scene.
fn add_groups(file: &mut File, scene: &Scene) {
    let contacts = scene.contact_count();
    file.add("contacts", format_args!("{contacts} in {}", scene.group_count()));
    let mut end = 0;
    let table = |group: &Group| {
        end += group.size();
        format!("({:?}, {}, {end})", group.name.as_deref().unwrap_or_default(), group.count.is_some())
    };
    file.add("tables", list(scene.contacts.iter().map(table)));
    file.add("surface", by_table(scene, |group| format!("{:?}", group.surface)));
    let density = |group: &Group| group.density.map_or("None".into(), |density| format!("Some({})", literal(density)));
    file.add("density", by_table(scene, density));
}

/// A property of each table of the scene, or once if it is the same in all.
fn by_table(scene: &Scene, of: impl Fn(&Group) -> String) -> String {
    let mut values: Vec<_> = scene.contacts.iter().map(of).collect();
    if values.iter().all(|value| *value == values[0]) {
        values.truncate(1);
    }
    list(values)
}

/// The types that determine which parts of an instance the scene has.
fn parts(scene: &Scene) -> String {
    let chosen = |names: &[&str]| presence(names.iter().any(|name| scene.outputs.iter().any(|output| output == name)));
    let momentum = chosen(&["impulse", "mean_force"]);
    let prediction = chosen(&["predicted_force", "predicted_tangential_force"]);
    let coupling = match scene.coupling {
        Some(Coupling { parallel, acceleration_input, mass_input }) => {
            let [account, acceleration, mass] = [parallel, acceleration_input, mass_input].map(presence);
            format!("Coupled<{account}, {acceleration}, {mass}>")
        }
        None => "Absent".into(),
    };
    let (course, watch) = (presence(has_course(scene)), presence(scene.watches));
    format!(
        "Momentum = {momentum}, Course = {course}, Prediction = {prediction}, Coupling = {coupling}, Watch = {watch}"
    )
}

/// Whether the input may have derivatives. In a scene that moves its bodies, its derivative is their acceleration.
pub fn has_course(scene: &Scene) -> bool {
    scene.input_derivatives && !scene.is_rate_dependent() || scene.coupling.is_some()
}

fn presence(is: bool) -> &'static str {
    if is { "Present" } else { "Absent" }
}

fn list(values: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", values.into_iter().collect::<Vec<_>>().join(", "))
}

/// `value` as a Rust expression with the same bits.
fn literal(value: f64) -> String {
    match value {
        f64::INFINITY => "f64::INFINITY".into(),
        large if large.abs() >= 1e6 => format!("{large:e}"),
        _ => format!("{value:?}"),
    }
}
