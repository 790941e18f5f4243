//! The location of the prebuilt FMU libraries.

use crate::files::installed;
use brinell_exporter::platform::{Platform, Target};
use brinell_exporter::prebuilt::archive::LIST;
use std::env;
use std::path::PathBuf;

/// Environment variable that overrides the installed folder.
const VARIABLE: &str = "BRINELL_PREBUILT";

/// Its name among what is [installed](crate::files::installed).
const INSTALLED: &str = "prebuilt";

/// A folder with prebuilt libraries.
#[derive(Debug, PartialEq)]
pub struct PrebuiltFolder {
    pub path: PathBuf,
}

/// The folder named by `BRINELL_PREBUILT`, otherwise the one that was installed with the program; `None` if there is no such
/// folder.
pub fn find() -> Option<PrebuiltFolder> {
    if let Some(named) = env::var_os(VARIABLE).filter(|named| !named.is_empty()) {
        let path = PathBuf::from(named);
        return path.is_dir().then_some(PrebuiltFolder { path });
    }
    let path = installed(INSTALLED).filter(|path| path.is_dir())?;
    Some(PrebuiltFolder { path })
}

impl PrebuiltFolder {
    /// The file with this `ending` for `target`.
    pub fn file(&self, target: &Target, ending: &str) -> PathBuf {
        self.path.join(target.triple).with_extension(ending)
    }

    /// The platforms with libraries.
    pub fn platforms(&self) -> Vec<Platform> {
        let is_there = |target: &Target| self.file(target, LIST).is_file();
        let all = Platform::ALL.into_iter().chain([Platform::C_CODE]);
        all.filter(|platform| platform.targets.iter().all(is_there)).collect()
    }
}
