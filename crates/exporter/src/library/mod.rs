//! The library of a scene: its kind as types, and its data as words.
//!
//! A compiled library is made from a file with both. A prebuilt one has a kind that many scenes fit, and its data are filled in.

mod data;
mod laws;
mod parameters;

pub use brinell_fmu::scene::library::kinds::MEMORY;
pub use data::SceneData;
pub use parameters::{parameters, start_value};

use crate::package::{GUID_TO_COME, guid};
use crate::plan::Plan;
use crate::scene::Scene;
use brinell_fmu::scene::library::block::{Data, Flag};
use std::fmt::Write;

const HEAD: &str = "\
//! The scene of this library: its kind as types, and its data as words.
//!
//! `brinell export` writes this file for every scene that it builds. The file in the source tree is that
//! of `scenes/steel_ball.toml`, without identification; a test compares it with the output of the exporter.

use brinell_fmu::scene::library::{Kind, kinds};
use brinell_fmu::{contact, scene};
";

/// The GUID of the planned FMU, whose library is made from these `sources`: a hash. It is the same however the library is made.
pub fn guid_of(plan: &Plan, sources: &str) -> String {
    // the size of the data does not depend on the value of the GUID
    let words: String = SceneData::of(plan, GUID_TO_COME).words().map(|word| format!("{word:016x}")).collect();
    guid(plan, &words, sources)
}

/// The library of the planned FMU as Rust, with the identification `guid`: the file `crates/unit/src/exported.rs`.
pub fn write(plan: &Plan, guid: &str) -> String {
    let mut text =
        format!("{HEAD}\n/// The contents of the library.\npub struct Library;\n\nimpl Kind for Library {{\n");
    let data = SceneData::of(plan, guid);
    for (name, what) in kind_of(plan.scene, &data.data) {
        writeln!(text, "    type {name} = {what};").expect("a String takes everything");
    }
    let words: Vec<_> = data.words().collect();
    let count = words.len();
    write!(text, "}}\n\n/// The data.\n#[rustfmt::skip]\npub const WORDS: [u64; {count}] = [")
        .expect("a String takes everything");
    for (place, word) in words.iter().enumerate() {
        let before = if place % 6 == 0 { "\n    " } else { " " };
        write!(text, "{before}{word:#x},").expect("a String takes everything");
    }
    text + "\n];\n"
}

/// The types of the library of a scene with these `data`.
fn kind_of(scene: &Scene, data: &Data) -> [(&'static str, String); 10] {
    let presence = |is| format!("scene::{}", if is { "Present" } else { "Absent" });
    let has = |flag| presence(data.has(flag));
    let Data { contacts, groups, values, .. } = data;
    let rows = if data.has(Flag::Shared) { scene.rows() } else { scene.contact_count() };
    let entries = if data.has(Flag::InverseMassInputs) { rows * (rows + 1) / 2 } else { 0 };
    let coupling = match data.has(Flag::Moves) {
        true => {
            let [account, acceleration, mass] = [Flag::Parallel, Flag::Acceleration, Flag::Mass].map(has);
            format!("scene::Coupled<{account}, {acceleration}, {mass}>")
        }
        false => presence(false),
    };
    [
        ("Laws", laws::of(scene)),
        ("Sizes", format!("kinds::Fixed<{contacts}, {rows}, {groups}, {values}, {entries}>")),
        ("Forces", has(Flag::Forces)),
        ("Momentum", has(Flag::Momentum)),
        ("InputDerivatives", has(Flag::InputDerivatives)),
        ("Prediction", has(Flag::Predicts)),
        ("Coupling", coupling),
        ("Watch", presence(scene.watches)),
        ("Shared", has(Flag::Shared)),
        // a strength that each impact finds makes other bodies of the two
        (
            "Prepared",
            presence(data.has(Flag::Paired) && !scene.finds_strength() || scene.laws.loading().1.table().is_some()),
        ),
    ]
}

/// The kind of a prebuilt library as Rust: the file `crates/unit/src/kind.rs` of the library. `made_from` identifies it.
pub fn kind(kind: &str, made_from: &str) -> String {
    format!(
        "{HEAD_OF_KIND}\n/// The kind.\npub type Library = brinell_fmu::scene::library::kinds::{kind};\n\n\
         /// A hash of the sources of the library.\npub const MADE_FROM: &str = {made_from:?};\n"
    )
}

const HEAD_OF_KIND: &str = "\
//! The kind of this library, if it is a prebuilt one.
//!
//! `brinell prebuild` writes this file for every library that it builds. The file in the source tree is that of the kind `state`,
//! without identification; a test compares it with the output of the program.
";
