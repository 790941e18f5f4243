//! The compiler for all platforms, if available.

use crate::places::{root, temporary};
use std::env;
use std::path::PathBuf;
use std::process::Command;

/// The folder of the toolchain: that of `BRINELL_TOOLCHAIN`, or one below `target`. With
/// `BRINELL_PLATFORMS=all`, it is downloaded if missing, about 100 MB. `None`, with a message that no test runner hides, if
/// there is none.
pub fn toolchain() -> Option<PathBuf> {
    let named = env::var_os("BRINELL_TOOLCHAIN").filter(|value| !value.is_empty()).map(PathBuf::from);
    let folder = named.unwrap_or_else(|| temporary().join("toolchain"));
    if env::var_os("BRINELL_PLATFORMS").is_some_and(|value| value == "all") {
        let script = root().join("packaging/toolchain.py");
        let status = Command::new("python3").arg(script).arg(&folder).status().expect("the tests need Python");
        assert!(status.success(), "the toolchain can't be fetched");
    }
    if folder.join("packages.json").is_file() {
        return Some(folder);
    }
    let why = format!("there is no toolchain in {}; BRINELL_PLATFORMS=all fetches it (100 MB)", folder.display());
    super::skips::skipped("libraries for other platforms", &why);
    None
}

/// The same, if it makes C source too.
pub fn toolchain_for_c() -> Option<PathBuf> {
    let folder = toolchain()?;
    if folder.join("usr/bin/wasm2c").is_file() {
        return Some(folder);
    }
    super::skips::skipped("C source", "the toolchain has no wasm2c; BRINELL_PLATFORMS=all fetches a new one (100 MB)");
    None
}
