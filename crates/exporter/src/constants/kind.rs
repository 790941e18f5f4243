//! The kind of a prebuilt library as data in Rust: the file `crates/unit/src/kind.rs` of the library, a call of `kind!`.

use super::{File, laws, parts};
use crate::scene::Scene;
use crate::table::{Causality, VARIABLES, Variable};

const HEAD: &str = "\
//! The features of this library, if it is a prebuilt one.
//!
//! `brinell prebuild` writes this file for every library that it builds. The file in the source tree is that of the kind
//! `force` with the laws of `scenes/steel_ball.toml`; a test compares it with the output of the program.
";

/// The library with the laws, outputs and inputs of `scene`, as Rust. `made_from` identifies it.
pub fn write(scene: &Scene, made_from: &str) -> String {
    let mut file = File::new(HEAD, "kind");
    file.add("library", format_args!("{made_from:?}"));
    file.add("two_strengths", scene.has_two_strengths());
    file.add("laws", laws::of(scene));
    file.add("parts", format_args!("{{ {} }}", parts(scene)));
    file.add_places(VARIABLES.iter().enumerate().filter(|(_, variable)| is_shown(scene, variable)));
    file.text + "}\n"
}

/// Whether a library with all features of `scene` has `variable`.
fn is_shown(scene: &Scene, variable: &Variable) -> bool {
    match variable.causality {
        Causality::Input => variable.name == "indentation_rate" || scene.has_input(&variable.name),
        Causality::Output => variable.name == "force" || scene.outputs.contains(&variable.name),
        Causality::Parameter => false,
    }
}
