//! The cross toolchain in the folder that `BRINELL_TOOLCHAIN` names. `packaging/toolchain.py` makes it and has its layout.

use brinell_exporter::platform::Target;
use std::env;
use std::path::PathBuf;

/// A compiler for all platforms.
pub struct Toolchain {
    pub folder: PathBuf,
}

impl Toolchain {
    /// The toolchain in the folder of `BRINELL_TOOLCHAIN`, if it is complete.
    pub fn find() -> Option<Toolchain> {
        let chosen = env::var_os("BRINELL_TOOLCHAIN").filter(|value| !value.is_empty())?;
        let folder = std::path::absolute(&chosen).unwrap_or(chosen.into());
        folder.join("packages.json").is_file().then_some(Toolchain { folder })
    }

    /// The compiler.
    pub fn rustc(&self) -> PathBuf {
        self.folder.join("usr/bin/rustc")
    }

    /// The linker for ELF files: it takes the arguments of a C compiler.
    pub fn driver(&self) -> PathBuf {
        self.folder.join("usr/bin/cc-lld")
    }
}

/// How to get a compiler for `target`.
pub fn help(target: &Target) -> String {
    format!("`rustup target add {}` installs it", target.triple)
}
