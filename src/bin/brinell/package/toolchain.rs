//! Where the cross toolchain is, which `brinell toolchain` fetches.
//!
//! # Layout
//! The folder is `toolchain` in the cache, or the one that `BRINELL_TOOLCHAIN` names. It can be moved.
//!
//! | path | what |
//! |---|---|
//! | `packages.json` | the packages that it was made of; written last: without this file the toolchain is not whole |
//! | `usr/bin/rustc` | the compiler: a script that tells `rustc-web`, beside it, where its libraries are |
//! | `usr/bin/cc-lld` | a script that takes the arguments of a C compiler and links ELF files |
//! | `usr/lib/rustlib/HOST/bin/rust-lld` | LLVM's linker for all systems, a script; the first argument is `-flavor` |
//! | `usr/lib/rustlib/TARGET/lib` | `core` and `compiler_builtins` for each target |
//! | `usr/src/rustc-VERSION/library` | with `--std`: the source of Rust's libraries, also as `usr/lib/rustlib/src/rust/library` |
//! | `packages/` | what has been downloaded, as long as the toolchain is not whole |
//!
//! `usr` is what the compiler calls its sysroot. With `--std` it also has `std` for the machine itself, so that cargo with
//! `RUSTC=usr/bin/rustc`, `RUSTC_BOOTSTRAP=1` and `-Zbuild-std` builds whole programs for other systems.

use crate::platform::Target;
use std::env;
use std::path::{Path, PathBuf};

/// A toolchain, which may still have to be fetched.
pub struct Toolchain {
    pub folder: PathBuf,
}

impl Toolchain {
    /// The toolchain in the folder that `BRINELL_TOOLCHAIN` names, or else in the `cache`.
    pub fn of(cache: &Path) -> Toolchain {
        let chosen = env::var_os("BRINELL_TOOLCHAIN").filter(|value| !value.is_empty());
        let chosen = chosen.map(|chosen| std::path::absolute(&chosen).unwrap_or(chosen.into()));
        Toolchain { folder: chosen.unwrap_or_else(|| cache.join("toolchain")) }
    }

    /// Whether all of it is there.
    pub fn is_whole(&self) -> bool {
        self.list().is_file()
    }

    /// The packages that it was made of.
    pub fn list(&self) -> PathBuf {
        self.folder.join("packages.json")
    }

    /// What the compiler calls its sysroot.
    pub fn usr(&self) -> PathBuf {
        self.folder.join("usr")
    }

    /// The compiler.
    pub fn rustc(&self) -> PathBuf {
        self.usr().join("bin/rustc")
    }

    /// What links ELF files: it takes the arguments of a C compiler.
    pub fn driver(&self) -> PathBuf {
        self.usr().join("bin/cc-lld")
    }

    /// The folder of what the compiler has for the target of this name.
    pub fn target(&self, triple: &str) -> PathBuf {
        self.usr().join("lib/rustlib").join(triple)
    }
}

/// How to get a compiler for `target`.
pub fn help(target: &Target) -> String {
    let rustup = format!("`rustup target add {}`", target.triple);
    match cfg!(target_os = "linux") {
        true => format!("{rustup} or, for all platforms at once, `brinell toolchain` installs it"),
        false => format!("{rustup} installs it"),
    }
}
