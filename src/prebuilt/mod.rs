//! The folder of prebuilt libraries, and the FMUs that are made from it.

pub mod folder;
mod store;

pub use folder::{PrebuiltFolder, find};
pub use store::{StoreError, write};

use crate::sources;
use brinell_exporter::package::join;
use brinell_exporter::plan::Plan;
use brinell_exporter::platform::{Platform, System, Target};
use brinell_exporter::prebuilt::{self, FillError, NeedsCompiler};
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
}

/// The platforms with prebuilt libraries.
pub fn platforms() -> Vec<Platform> {
    Store::find().map(|store| store.platforms().to_vec()).unwrap_or_default()
}

/// An FMU from a library of the folder.
pub struct StoredUnit {
    unit: prebuilt::PrebuiltUnit,
    store: Store,
}

impl StoredUnit {
    /// The planned FMU.
    ///
    /// # Errors
    /// [`PrebuiltError`] if there are no prebuilt libraries, or none that fits the scene.
    pub fn of(plan: &Plan) -> Result<StoredUnit, PrebuiltError> {
        let unit = prebuilt::PrebuiltUnit::of(plan, sources::hash())?;
        Ok(StoredUnit { unit, store: Store::find()? })
    }

    /// Its GUID, and the name of its library.
    pub fn named(&self) -> (String, String) {
        (self.unit.guid.clone(), self.unit.library.name.into())
    }

    /// The library of the FMU for `platform`.
    ///
    /// # Errors
    /// [`PrebuiltError`] if it is missing or damaged.
    pub fn library(&self, platform: &Platform) -> Result<Vec<u8>, PrebuiltError> {
        let slices = platform.targets.iter().map(|target| self.slice(target)).collect::<Result<Vec<_>, _>>()?;
        Ok(join(&slices.iter().map(Vec::as_slice).collect::<Vec<_>>()))
    }

    fn slice(&self, target: &Target) -> Result<Vec<u8>, PrebuiltError> {
        let mut library = self.store.library(&self.unit.library, target)?;
        let unfilled =
            |reason| PrebuiltError::Fill { name: self.unit.library.name.into(), target: target.triple, reason };
        if target.system == System::WebAssembly {
            return self.unit.fill_source(&library).map_err(unfilled);
        }
        self.unit.fill(&mut library).map_err(unfilled)?;
        Ok(library)
    }
}
