//! The scene file: the contacts, their laws, and the variables that the FMU has.

pub mod bodies;
mod checked;
mod checks;
mod contacts;
mod cylinders;
pub mod ellipses;
mod file;
mod fmu;
mod in_impact;
mod inverse_masses;
mod laws;
mod losses;
pub mod names;
mod own_materials;
mod parser_words;
pub mod plausible;
mod quantities;
pub mod rules;
mod shared_bodies;
pub mod strength;
mod tabulated;

use crate::mistake::{Mistake, SceneError, Spanned};
use std::path::Path;

pub use crate::body::{Body, Both};
pub use checked::{Coupling, Group, Masses, Parameter, Scene, SceneLaws};
pub use contacts::reserved_names;
pub use file::{FLAT, SceneFile, closed, files_named};
pub use fmu::INPUTS;
pub use in_impact::InImpact;
pub use inverse_masses::{InverseMasses, Meeting, place};
pub use losses::{Loss, WAVES};
pub use names::{IDENTIFIER, is_no_name};
pub use own_materials::{MaterialTable, OwnMaterial, ReferencedFiles};
pub use quantities::{PRODUCT, quantity_of};
pub use rules::{Closed, OF_ALL_CONTACTS};
pub use shared_bodies::GROUND;
pub use strength::{Flow, MODELS as RATE_MODELS, PowerLaw, Rate};

/// Whether an FMU can have this `name`: a C identifier that every operating system accepts as a file name.
///
/// # Errors
/// The reason in words.
pub fn check_name(name: &str) -> Result<(), String> {
    names::check_name(&Spanned::new(0..0, name.into())).map(drop).map_err(|Mistake(_, message)| message)
}

/// A commented scene to start from, with this `name`.
pub fn new_scene(name: &str) -> String {
    include_str!("new_scene.toml").replace("NAME", name)
}

/// The `text` of the scene file at `path` with all numbers in SI units, for readers of TOML that know no other, and with what it uses
/// of the files `referenced` by it.
///
/// # Errors
/// As for [`Scene::parse`], of text that is not TOML, and of wrong units.
pub fn in_si(text: &str, path: &Path, referenced: &ReferencedFiles) -> Result<String, SceneError> {
    let alone = file::SceneFile::read(text, referenced).map(|file| file.alone);
    // what is no scene may have numbers, too
    let alone = alone.unwrap_or_else(|_| text.into());
    file::in_si(&alone, &referenced.files).map_err(|mistake| mistake.in_file(text, path))
}
