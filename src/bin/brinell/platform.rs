//! The platform that the program runs on, which is the one that it makes units for.

use std::env;

/// What FMI 2.0 and the operating system call things here.
#[derive(Clone, Copy)]
pub struct Platform {
    /// Folder of the binaries in a unit.
    pub folder: &'static str,
    /// Ending of a library.
    pub extension: &'static str,
    /// What rustc calls it. Given to it, so that no other target is a default: not even that of a toolchain made for another
    /// C library.
    pub target: &'static str,
}

/// A platform that has no units.
#[derive(Debug, thiserror::Error)]
#[error("units for {os} on {arch} can't be made here: FMI 2.0 has no folder for this platform")]
pub struct NoPlatform {
    os: &'static str,
    arch: &'static str,
}

/// This platform.
///
/// # Errors
/// [`NoPlatform`]
pub fn here() -> Result<Platform, NoPlatform> {
    let (folder, extension, target) = match (env::consts::OS, env::consts::ARCH) {
        ("linux", "x86_64") => ("linux64", "so", "x86_64-unknown-linux-gnu"),
        ("linux", "aarch64") => ("aarch64-linux", "so", "aarch64-unknown-linux-gnu"),
        ("windows", "x86_64") => ("win64", "dll", "x86_64-pc-windows-msvc"),
        ("macos", "x86_64") => ("darwin64", "dylib", "x86_64-apple-darwin"),
        ("macos", "aarch64") => ("aarch64-darwin", "dylib", "aarch64-apple-darwin"),
        (os, arch) => return Err(NoPlatform { os, arch }),
    };
    Ok(Platform { folder, extension, target })
}
