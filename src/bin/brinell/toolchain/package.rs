//! The packages of the toolchain.

use serde_json::{Value, json};

/// A package of the index.
pub struct Package {
    pub name: String,
    pub version: String,
    /// Path on the mirror.
    pub path: String,
    /// Size [bytes].
    pub size: u64,
    pub sha256: String,
    pub part: Part,
}

/// The part of the toolchain for which a package is unpacked.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Part {
    Compiler,
    /// The libraries of the compiler, and LLVM.
    Libraries,
    Linker,
    Source,
    /// `std` for the host.
    Std,
}

impl Part {
    /// Whether the file at `path`, which begins with `usr/`, is needed.
    pub fn has(self, path: &str, std: bool) -> bool {
        match self {
            Part::Compiler => path == "usr/bin/rustc",
            Part::Libraries => path.starts_with("usr/lib/") && path.contains(".so"),
            Part::Linker => path.starts_with("usr/lib/llvm-") && path.ends_with("/bin/lld"),
            Part::Source => {
                let Some((_, inside)) = path.split_once("/library/") else {
                    return std && path.starts_with("usr/lib/rustlib/src/");
                };
                let folder = inside.split('/').next().unwrap_or_default();
                std || ["core", "compiler-builtins", "portable-simd", "stdarch"].contains(&folder)
            }
            Part::Std => path.starts_with("usr/lib/rustlib/"),
        }
    }
}

impl Package {
    pub fn json(&self) -> Value {
        json!({ "name": self.name, "version": self.version, "size": self.size, "sha256": self.sha256 })
    }
}
