//! Prebuilt libraries: FMUs without a compiler.
//!
//! A prebuilt library contains all laws, and has a block of memory for the data of a scene (`brinell_fmu::scene::prebuilt`). Such
//! libraries are compiled once, one for each kind; an export copies the one of its scene and writes the data to the copy.

pub mod archive;
mod fill;
mod fit;
mod kinds;
#[cfg(test)]
mod macho_tests;

pub use fill::FillError;
pub use fit::NeedsCompiler;
pub use kinds::{LIBRARIES, Library};

use crate::c_source;
use crate::package::{GUID_TO_COME, guid};
use crate::plan::Plan;
use brinell_fmu::scene::identity_of;
use brinell_fmu::scene::prebuilt::block::{Block, Data};

/// An FMU from a prebuilt library.
pub struct PrebuiltUnit {
    pub guid: String,
    /// Its library.
    pub library: Library,
    made_from: String,
    data: Data,
    /// Its name, and the number of its variables.
    face: (String, usize),
}

impl PrebuiltUnit {
    /// The planned FMU, for libraries of these `sources`: a hash.
    ///
    /// # Errors
    /// [`NeedsCompiler`] if no prebuilt library fits the scene.
    pub fn of(plan: &Plan, sources: &str) -> Result<PrebuiltUnit, NeedsCompiler> {
        let library = Library::of(plan.scene);
        let (source, made_from) = library.source(sources);
        // the size of the data does not depend on the value of the GUID
        let block = Block::filled(0, fit::data_of(plan, GUID_TO_COME)?);
        let words: String = block.words().map(|word| format!("{word:016x}")).collect();
        let guid = guid(plan, &[&words, &source], sources);
        let data = fit::data_of(plan, &guid)?;
        let face = (plan.scene.name.clone(), plan.variables.iter().map(|entry| entry.count).sum());
        Ok(PrebuiltUnit { guid, library, made_from, data, face })
    }

    /// Its data for the library with this `identity`.
    pub fn block(&self, identity: u64) -> Block {
        Block::filled(identity, self.data)
    }

    /// Writes the data of the scene to a copy of its library.
    ///
    /// # Errors
    /// [`FillError`]; part of the data may then be written.
    pub fn fill(&self, library: &mut [u8]) -> Result<(), FillError> {
        fill::fill(library, identity_of(&self.made_from), self.data)
    }

    /// The C source of its `library` with the data of the scene.
    ///
    /// # Errors
    /// [`FillError::NoSource`]
    pub fn fill_source(&self, library: &[u8]) -> Result<Vec<u8>, FillError> {
        let block = Block::filled(identity_of(&self.made_from), self.data);
        let (name, variables) = &self.face;
        c_source::with_scene(library, &block, name, *variables).ok_or(FillError::NoSource)
    }
}
