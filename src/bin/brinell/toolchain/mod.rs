//! A compiler that builds for every platform, in a folder of its own: `brinell toolchain` fetches it.

use std::env;
use std::path::{Path, PathBuf};

/// A toolchain that was fetched.
pub struct Toolchain {
    folder: PathBuf,
}

/// Written last: the toolchain is whole if this file is there. It lists the packages.
const LIST: &str = "packages.json";

impl Toolchain {
    /// The toolchain in the folder that `BRINELL_TOOLCHAIN` names, or else in the `cache`, if one is there.
    pub fn existing(cache: &Path) -> Option<Toolchain> {
        let toolchain = Toolchain { folder: folder(cache) };
        toolchain.folder.join(LIST).is_file().then_some(toolchain)
    }

    /// The compiler.
    pub fn rustc(&self) -> PathBuf {
        self.folder.join("usr/bin/rustc")
    }

    /// What links ELF files: it takes the arguments of a C compiler.
    pub fn driver(&self) -> PathBuf {
        self.folder.join("usr/bin/cc-lld")
    }
}

/// Where the toolchain is or will be.
fn folder(cache: &Path) -> PathBuf {
    let chosen = env::var_os("BRINELL_TOOLCHAIN").filter(|value| !value.is_empty());
    let chosen = chosen.map(|chosen| std::path::absolute(&chosen).unwrap_or(chosen.into()));
    chosen.unwrap_or_else(|| cache.join("toolchain"))
}

/// How to get what the target needs.
pub fn help(triple: &str) -> String {
    let rustup = format!("`rustup target add {triple}` gets it");
    match cfg!(target_os = "linux") {
        true => format!("{rustup}, or `brinell toolchain` a compiler for all platforms"),
        false => rustup,
    }
}
