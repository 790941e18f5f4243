//! The kind of a prebuilt library as Rust: the file `src/scene/kind.rs` of the library.

use super::model::{DAMPED_MODEL, model_of};
use super::{File, add_laws, follow, parts};
use crate::scene::Scene;
use crate::table::{Causality, Type, VARIABLES, Variable};
use std::fmt::Write;

const HEAD: &str = "\
//! The features of this library, if it is a prebuilt one.
//!
//! `brinell prebuild` writes this file for every library that it builds. The file in the source tree is that of the kind
//! `force` with the laws of `scenes/steel_ball.toml`; a test compares it with the output of the program.
";

/// The library with the laws, outputs and inputs of `scene`, as Rust. `made_from` identifies it.
pub fn write(scene: &Scene, made_from: &str) -> String {
    let mut file = File::default();
    file.add_item(&format!("/// Hash of the source files of the library.\nconst MADE_FROM: &str = {made_from:?};\n"));
    add_laws(&mut file, scene);
    if scene.damped.is_some() {
        file.add_method(
            "model(pair: Pair, _surface: Surface, value: impl Fn(Parameter) -> f64) -> Self::Model",
            DAMPED_MODEL,
        );
    } else {
        let value = if scene.is_strengthened() { "value" } else { "_value" };
        file.add_method(
            &format!("model(pair: Pair, surface: Surface, {value}: impl Fn(Parameter) -> f64) -> Self::Model"),
            &model_of(scene, "value(Parameter::TargetHardeningModulus)", "surface"),
        );
    }
    add_places(&mut file, scene, Type::Real);
    add_places(&mut file, scene, Type::Enumeration);
    text(&file, scene)
}

/// Whether a library with all features of `scene` has `variable`.
fn is_shown(scene: &Scene, variable: &Variable) -> bool {
    match variable.causality {
        Causality::Input => variable.name == "indentation_rate" || scene.has_input(&variable.name),
        Causality::Output => variable.name == "force" || scene.outputs.contains(&variable.name),
        Causality::Parameter => false,
    }
}

/// Adds the meaning of the indices in the table of variables, for the type `kind`.
fn add_places(file: &mut File, scene: &Scene, kind: Type) {
    let (method, name) = match kind {
        Type::Real => ("real", "Real"),
        Type::Enumeration => ("integer", "Integer"),
    };
    let mut arms = String::new();
    for (place, variable) in VARIABLES.iter().enumerate() {
        if variable.r#type == kind && is_shown(scene, variable) {
            writeln!(arms, "    {place} => {name}::{},", variable.rust).expect("a String takes everything");
        }
    }
    let (argument, body) = match arms.is_empty() {
        true => ("_place", "None".to_string()),
        false => ("place", format!("Some(match place {{\n{arms}    _ => return None,\n}})")),
    };
    file.add_method(&format!("{method}({argument}: u8) -> Option<{name}>"), &body);
}

/// The whole file.
fn text(file: &File, scene: &Scene) -> String {
    let File { items, methods, model, contact } = file;
    let (parts, follow, two) = (parts(scene), follow(scene), scene.has_two_strengths());
    let laws = if scene.damped.is_some() { "damped" } else { "loading, unloading" };
    let contact_itself = if model.starts_with("contact::") { "self, " } else { "" };
    let uses_follow = if follow.is_empty() { "" } else { "use crate::contact::motion::{Follow, follow};\n" };
    let named = |name: &&str| parts.contains(*name);
    let mut scene_names: Vec<_> = ["Absent", "Coupled"].into_iter().filter(named).collect();
    scene_names.extend(["Integer", "Parameter"]);
    scene_names.extend(["Present"].into_iter().filter(named));
    let scene_names = scene_names.join(", ");
    format!(
        "{HEAD}
use crate::contact::{{{contact_itself}Pair, Surface, {laws}}};
{uses_follow}use crate::scene::prebuilt::Kind;
use crate::scene::{{{scene_names}, Real, identity_of}};

/// A library that the exporter fills in with a scene.
pub struct Library;
{items}
impl Kind for Library {{
    type Model = {model};
    type Contact = {contact};

{parts}{follow}
    const TWO_STRENGTHS: bool = {two};
    const LIBRARY: u64 = identity_of(MADE_FROM);
{methods}}}
"
    )
}
