//! The compiler and the linker for a target: the user's own, or those of the cross toolchain.

use super::error::ExportError;
use super::link::Linker;
use super::rustc::Rustc;
use brinell_exporter::platform::{System, Target};
use std::env;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The available compilers.
pub struct Compilers {
    /// The cache, as for [`Rustc::find`].
    cache: PathBuf,
    /// The user's compiler, or the reason why there is none.
    own: Result<Rustc, ExportError>,
    toolchain: Option<Toolchain>,
    /// The compiler of the toolchain, started only when needed; or the reason why it fails.
    fetched: OnceLock<Result<Rustc, ExportError>>,
}

impl Compilers {
    /// Looks for the user's compiler.
    pub fn find(cache: &Path) -> Compilers {
        let own = Rustc::find(cache);
        Compilers { cache: cache.into(), own, toolchain: Toolchain::find(), fetched: OnceLock::new() }
    }

    /// The compiler and the linker for `target`: the user's, if they support it.
    ///
    /// # Errors
    /// [`ExportError`] with the missing part and how to get it.
    pub fn for_target(&self, target: &Target) -> Result<(&Rustc, Linker), ExportError> {
        if let Ok(own) = &self.own {
            if target.is_here() && target.system == System::Linux {
                return Ok((own, Linker::Driver));
            }
            if let (true, Some(lld)) = (own.has(target), own.lld()) {
                return Ok((own, Linker::Lld(lld)));
            }
        }
        if let (Some(toolchain), Some(Ok(fetched))) = (&self.toolchain, self.fetched())
            && let (true, Some(lld)) = (fetched.has(target), fetched.lld())
        {
            let linker = match target.system {
                System::Linux => Linker::DriverOf(toolchain.driver()),
                System::Windows | System::MacOs | System::WebAssembly => Linker::Lld(lld),
            };
            return Ok((fetched, linker));
        }
        Err(self.missing(target))
    }

    fn fetched(&self) -> Option<&Result<Rustc, ExportError>> {
        let toolchain = self.toolchain.as_ref()?;
        Some(self.fetched.get_or_init(|| Rustc::at(toolchain.rustc(), &self.cache)))
    }

    /// The missing part for `target`.
    fn missing(&self, target: &Target) -> ExportError {
        let triple = target.triple;
        let reason = match (&self.own, self.fetched()) {
            (_, Some(Err(error))) => format!("that of BRINELL_TOOLCHAIN fails: {error}"),
            (Err(error), _) => error.to_string(),
            (Ok(own), _) if own.has(target) => {
                "the Rust toolchain has no `rust-lld`, which links for other systems".into()
            }
            (Ok(_), _) => format!("the Rust toolchain has no target {triple}"),
        };
        match (&self.own, target.is_here()) {
            // for the host the user's compiler is sufficient
            (Err(_), true) => ExportError::Unusable { reason },
            _ => ExportError::NoTarget { triple, reason, help: help(target) },
        }
    }
}

/// The cross toolchain in the folder that `BRINELL_TOOLCHAIN` names: a compiler for all platforms. `packaging/toolchain.py` makes it
/// and has its layout.
pub struct Toolchain {
    folder: PathBuf,
}

impl Toolchain {
    /// The toolchain in the folder of `BRINELL_TOOLCHAIN`, if it is complete.
    pub fn find() -> Option<Toolchain> {
        let chosen = env::var_os("BRINELL_TOOLCHAIN").filter(|value| !value.is_empty())?;
        let folder = std::path::absolute(&chosen).unwrap_or(chosen.into());
        folder.join("packages.json").is_file().then_some(Toolchain { folder })
    }

    /// The compiler.
    fn rustc(&self) -> PathBuf {
        self.folder.join("usr/bin/rustc")
    }

    /// The program that makes C of modules for WebAssembly.
    pub fn wasm2c(&self) -> PathBuf {
        self.folder.join("usr/bin/wasm2c")
    }

    /// The linker for ELF files: it takes the arguments of a C compiler.
    fn driver(&self) -> PathBuf {
        self.folder.join("usr/bin/cc-lld")
    }
}

/// How to get a compiler for `target`.
fn help(target: &Target) -> String {
    format!("`rustup target add {}` installs it", target.triple)
}
