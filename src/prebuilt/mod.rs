//! Prebuilt libraries: FMUs without a compiler.
//!
//! Scenes with the same laws differ almost only in data. A prebuilt library has a block of memory for these data
//! (`brinell_fmu::scene::prebuilt`). `brinell prebuild` compiles such libraries once. An export copies the library that
//! fits and writes the data of its scene to the copy.

pub mod command;
mod fill;
mod fit;
mod kinds;
#[cfg(test)]
mod macho_tests;
mod store;

pub use fit::NeedsCompiler;
pub use kinds::Library;
pub use store::StoreError;

use crate::model_description;
use crate::package::{self, GUID_TO_COME, Hash};
use crate::plan::Plan;
use crate::platform::{Platform, Target};
use brinell_fmu::scene::identity_of;
use brinell_fmu::scene::prebuilt::block::{Block, Data};
use fill::FillError;
use std::io;
use store::Store;

/// Why an FMU can't be made from a prebuilt library.
#[derive(Debug, thiserror::Error)]
pub enum PrebuiltError {
    #[error("{0}")]
    Store(#[from] StoreError),
    #[error("this scene needs a compiler, which no prebuilt library has room for: {0}")]
    NeedsCompiler(#[from] NeedsCompiler),
    #[error("the prebuilt library `{name}` for {target} can't be filled in: {reason}")]
    Fill { name: String, target: &'static str, reason: FillError },
    #[error("the model description can't be written: {0}")]
    Description(io::Error),
}

/// The platforms with prebuilt libraries.
pub fn platforms() -> Vec<Platform> {
    Store::find().map(|store| store.platforms().to_vec()).unwrap_or_default()
}

/// An FMU from a prebuilt library.
pub struct Unit {
    pub guid: String,
    /// Its library.
    pub library: Library,
    made_from: String,
    data: Data,
    store: Store,
}

impl Unit {
    /// The planned FMU.
    ///
    /// # Errors
    /// [`PrebuiltError`] if there are no prebuilt libraries, or none that fits the scene.
    pub fn of(plan: &Plan) -> Result<Unit, PrebuiltError> {
        let library = Library::of(plan.scene)?;
        let store = Store::find()?;
        let (source, made_from) = library.source();
        // the size of the data does not depend on the value of the GUID
        let block = Block::filled(0, fit::data_of(plan, GUID_TO_COME)?);
        let words: String = block.words().map(|word| format!("{word:016x}")).collect();
        let description = Hash::new().with_written(|to| model_description::write(plan, GUID_TO_COME, to));
        let made_of = description.map_err(PrebuiltError::Description)?.with(&words).with(&source);
        let guid = made_of.with_all(package::sources()).digits();
        let data = fit::data_of(plan, &guid)?;
        Ok(Unit { guid, library, made_from, data, store })
    }

    /// The library of the FMU for `platform`.
    ///
    /// # Errors
    /// [`PrebuiltError`] if it is missing or damaged.
    pub fn library(&self, platform: &Platform) -> Result<Vec<u8>, PrebuiltError> {
        let slices = platform.targets.iter().map(|target| self.slice(target)).collect::<Result<Vec<_>, _>>()?;
        Ok(package::join(&slices.iter().map(Vec::as_slice).collect::<Vec<_>>()))
    }

    fn slice(&self, target: &Target) -> Result<Vec<u8>, PrebuiltError> {
        let mut library = self.store.library(&self.library, target)?;
        fill::fill(&mut library, identity_of(&self.made_from), self.data).map_err(|reason| PrebuiltError::Fill {
            name: self.library.name(),
            target: target.triple,
            reason,
        })?;
        Ok(library)
    }
}
