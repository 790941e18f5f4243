//! Which compiler and which linker make the library for a target: the user's own, or those of the cross toolchain.

use super::error::ExportError;
use super::folder::Cache;
use super::link::Linker;
use super::rustc::Rustc;
use crate::platform::{System, Target};
use crate::toolchain::Toolchain;

/// The compilers that are there.
pub struct Compilers {
    /// The user's, or why there is none.
    own: Result<Rustc, ExportError>,
    /// That of the toolchain which `brinell toolchain` has fetched.
    fetched: Option<(Toolchain, Rustc)>,
}

impl Compilers {
    /// Looks for compilers.
    ///
    /// # Errors
    /// [`ExportError`] if the toolchain that was fetched doesn't work.
    pub fn find(cache: &Cache) -> Result<Compilers, ExportError> {
        let own = Rustc::find(&cache.folder);
        let fetched = match Toolchain::existing(&cache.folder) {
            None => None,
            Some(toolchain) => {
                let rustc = Rustc::at(toolchain.rustc(), &cache.folder)?;
                Some((toolchain, rustc))
            }
        };
        Ok(Compilers { own, fetched })
    }

    /// The compiler and the linker for `target`: the user's, if they can compile for it.
    ///
    /// # Errors
    /// [`ExportError`] that says what is missing and how to get it.
    pub fn for_target(self: &Compilers, target: &Target) -> Result<(&Rustc, Linker), ExportError> {
        if let Ok(own) = &self.own {
            if target.is_here() && target.system == System::Linux {
                return Ok((own, Linker::Driver));
            }
            if let (true, Some(lld)) = (own.has(target), own.lld()) {
                return Ok((own, Linker::Lld(lld)));
            }
        }
        if let Some((toolchain, rustc)) = &self.fetched
            && let (true, Some(lld)) = (rustc.has(target), rustc.lld())
        {
            let linker = match target.system {
                System::Linux => Linker::DriverOf(toolchain.driver()),
                System::Windows | System::MacOs => Linker::Lld(lld),
            };
            return Ok((rustc, linker));
        }
        Err(self.missing(target))
    }

    /// What is missing for `target`.
    fn missing(&self, target: &Target) -> ExportError {
        let has_target = self.own.as_ref().is_ok_and(|own| own.has(target));
        let triple = target.triple;
        let reason = match &self.own {
            Ok(_) if has_target => "the Rust toolchain has no `rust-lld`, which links for other systems".into(),
            Ok(_) => format!("the Rust toolchain has no target {triple}"),
            Err(error) => error.to_string(),
        };
        ExportError::NoTarget { triple, reason, help: crate::toolchain::help(triple) }
    }
}
