//! Which compiler and which linker make the library for a target: the user's own, or those of the cross toolchain.

use super::error::ExportError;
use super::link::Linker;
use super::rustc::Rustc;
use super::toolchain::{Toolchain, help};
use crate::platform::{System, Target};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The compilers that are there.
pub struct Compilers {
    /// The cache, as [`Rustc::find`] takes it.
    cache: PathBuf,
    /// The user's, or why there is none.
    own: Result<Rustc, ExportError>,
    toolchain: Toolchain,
    /// That of the toolchain, asked for only when it is needed; or why it doesn't work.
    fetched: OnceLock<Result<Rustc, ExportError>>,
}

impl Compilers {
    /// Looks for the user's compiler.
    pub fn find(cache: &Path) -> Compilers {
        let own = Rustc::find(cache);
        Compilers { cache: cache.into(), own, toolchain: Toolchain::of(cache), fetched: OnceLock::new() }
    }

    /// The compiler and the linker for `target`: the user's, if they can compile for it.
    ///
    /// # Errors
    /// [`ExportError`] that says what is missing and how to get it.
    pub fn for_target(&self, target: &Target) -> Result<(&Rustc, Linker), ExportError> {
        if let Ok(own) = &self.own {
            if target.is_here() && target.system == System::Linux {
                return Ok((own, Linker::Driver));
            }
            if let (true, Some(lld)) = (own.has(target), own.lld()) {
                return Ok((own, Linker::Lld(lld)));
            }
        }
        if let Some(Ok(fetched)) = self.fetched()
            && let (true, Some(lld)) = (fetched.has(target), fetched.lld())
        {
            let linker = match target.system {
                System::Linux => Linker::DriverOf(self.toolchain.driver()),
                System::Windows | System::MacOs => Linker::Lld(lld),
            };
            return Ok((fetched, linker));
        }
        Err(self.missing(target))
    }

    fn fetched(&self) -> Option<&Result<Rustc, ExportError>> {
        let find = || Rustc::at(self.toolchain.rustc(), &self.cache);
        self.toolchain.is_whole().then(|| self.fetched.get_or_init(find))
    }

    /// What is missing for `target`.
    fn missing(&self, target: &Target) -> ExportError {
        let triple = target.triple;
        let reason = match (&self.own, self.fetched()) {
            (_, Some(Err(error))) => format!("that of {} fails: {error}", self.toolchain.folder.display()),
            (Err(error), _) => error.to_string(),
            (Ok(own), _) if own.has(target) => {
                "the Rust toolchain has no `rust-lld`, which links for other systems".into()
            }
            (Ok(_), _) => format!("the Rust toolchain has no target {triple}"),
        };
        match (&self.own, target.is_here()) {
            // for this machine the user's compiler is all that is needed
            (Err(_), true) => ExportError::Unusable { reason },
            _ => ExportError::NoTarget { triple, reason, help: help(target) },
        }
    }
}
