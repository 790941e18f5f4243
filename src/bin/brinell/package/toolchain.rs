//! The location of the cross toolchain, which `brinell toolchain` downloads.
//!
//! # Layout
//! The folder is `toolchain` in the cache, or that of `BRINELL_TOOLCHAIN`. It can be moved.
//!
//! | path | what |
//! |---|---|
//! | `packages.json` | the packages of the toolchain; written last: without this file the toolchain is incomplete |
//! | `usr/bin/rustc` | the compiler: a script that passes the location of the libraries to `rustc-web` beside it |
//! | `usr/bin/cc-lld` | a script that takes the arguments of a C compiler and links ELF files |
//! | `usr/lib/rustlib/HOST/bin/rust-lld` | LLVM's linker for all systems, a script; the first argument is `-flavor` |
//! | `usr/lib/rustlib/TARGET/lib` | `core` and `compiler_builtins` for each target |
//! | `usr/src/rustc-VERSION/library` | with `--std`: the source of Rust's libraries, also as `usr/lib/rustlib/src/rust/library` |
//! | `packages/` | downloads, until the toolchain is complete |
//!
//! The compiler calls `usr` its sysroot. With `--std` it also has `std` for the host. Cargo then builds whole
//! programs for other systems with `RUSTC=usr/bin/rustc`, `RUSTC_BOOTSTRAP=1` and `-Zbuild-std`.

use crate::platform::Target;
use std::env;
use std::path::{Path, PathBuf};

/// A toolchain, possibly not downloaded yet.
pub struct Toolchain {
    pub folder: PathBuf,
}

impl Toolchain {
    /// The toolchain in the folder of `BRINELL_TOOLCHAIN`, otherwise the one in the `cache`.
    pub fn of(cache: &Path) -> Toolchain {
        let chosen = env::var_os("BRINELL_TOOLCHAIN").filter(|value| !value.is_empty());
        let chosen = chosen.map(|chosen| std::path::absolute(&chosen).unwrap_or(chosen.into()));
        Toolchain { folder: chosen.unwrap_or_else(|| cache.join("toolchain")) }
    }

    /// Whether it is complete.
    pub fn is_whole(&self) -> bool {
        self.list().is_file()
    }

    /// The packages of the toolchain.
    pub fn list(&self) -> PathBuf {
        self.folder.join("packages.json")
    }

    /// The sysroot of the compiler.
    pub fn usr(&self) -> PathBuf {
        self.folder.join("usr")
    }

    /// The compiler.
    pub fn rustc(&self) -> PathBuf {
        self.usr().join("bin/rustc")
    }

    /// The linker for ELF files: it takes the arguments of a C compiler.
    pub fn driver(&self) -> PathBuf {
        self.usr().join("bin/cc-lld")
    }

    /// The folder of the compiler's files for this target.
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
