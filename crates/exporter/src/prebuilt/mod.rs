//! Prebuilt libraries: FMUs without a compiler.
//!
//! A prebuilt library contains all laws, and has a block of memory for the data of a scene (`brinell_fmu::scene::library`). Such
//! libraries are compiled once, one for each kind; an export copies the one of its scene and writes the data to the copy.

pub mod archive;
pub mod fill;
mod kinds;

pub use fill::FillError;
pub use kinds::{LIBRARIES, Library};

use crate::c_source;
use crate::library::{SceneData, guid_of};
use crate::plan::Plan;
use crate::scene::Scene;
use brinell_fmu::scene::identity_of;
use brinell_fmu::scene::library::block::{Block, POOL};

/// A scene that fits no prebuilt library.
#[derive(Debug, thiserror::Error)]
#[error("{key}: {reason}")]
pub struct NeedsCompiler {
    /// The part of the scene that is the reason.
    pub key: &'static str,
    pub reason: String,
}

/// An FMU from a prebuilt library.
pub struct PrebuiltUnit {
    pub guid: String,
    /// Its library.
    pub library: Library,
    block: Block,
    /// Its name, and the number of its variables.
    name: String,
    variable_count: usize,
}

impl PrebuiltUnit {
    /// The planned FMU, for libraries of these `sources`: a hash.
    ///
    /// # Errors
    /// [`NeedsCompiler`] if no prebuilt library fits the scene.
    pub fn of(plan: &Plan, sources: &str) -> Result<PrebuiltUnit, NeedsCompiler> {
        let scene = plan.scene;
        if scene.standalone {
            let reason = "prebuilt libraries take their memory from the process".into();
            return Err(NeedsCompiler { key: "fmu.standalone", reason });
        }
        let library = Library::of(scene);
        let (_, made_from) = library.source(sources);
        let guid = guid_of(plan, sources);
        let SceneData { data, lists } = SceneData::of(plan, &guid);
        let block = Block::filled(identity_of(&made_from), data, &lists).ok_or_else(|| too_long(scene, &lists))?;
        let variable_count = plan.variables.iter().map(|entry| entry.count).sum();
        Ok(PrebuiltUnit { guid, library, block, name: scene.name.clone(), variable_count })
    }

    /// Its data for the library with this `identity`.
    pub fn block(&self, identity: u64) -> Block {
        Block { library: identity, ..self.block }
    }

    /// Writes the data of the scene to a copy of its library.
    ///
    /// # Errors
    /// [`FillError`]; part of the data may then be written.
    pub fn fill(&self, library: &mut [u8]) -> Result<(), FillError> {
        fill::fill(library, &self.block)
    }

    /// The C source of its `library` with the data of the scene.
    ///
    /// # Errors
    /// [`FillError::NoSource`]
    pub fn fill_source(&self, library: &[u8]) -> Result<Vec<u8>, FillError> {
        c_source::with_scene(library, &self.block, &self.name, self.variable_count).ok_or(FillError::NoSource)
    }
}

/// The reason why the `lists` of a scene have no room in a library.
fn too_long(scene: &Scene, lists: &[u64]) -> NeedsCompiler {
    NeedsCompiler {
        key: if scene.inverse_masses().is_some() { "[[body]]" } else { "[[contact]]" },
        reason: format!(
            "the data of this scene take {} bytes, and prebuilt libraries have room for {}",
            8 * lists.len(),
            8 * POOL
        ),
    }
}
