//! Errors of the export: the reason in one line, and a remedy.

use crate::files::FileError;
use crate::prebuilt::PrebuiltError;
use brinell_exporter::c_source::WASM2C;
use brinell_exporter::layout::shown;
use brinell_exporter::package::PackError;
use brinell_exporter::platform::NoPlatform;
use std::io;
use std::path::PathBuf;

/// An error of making an FMU.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    #[error("{0}")]
    File(#[from] FileError),
    #[error("{0}")]
    Platform(#[from] NoPlatform),
    #[error("{0}")]
    Folder(#[from] FolderError),
    #[error("{0}")]
    Prebuilt(#[from] PrebuiltError),
    #[error("there is no Rust toolchain on PATH (see rustup.rs), and without one: {0}")]
    NoCompiler(PrebuiltError),
    #[error("C source needs wasm2c {WASM2C} (Debian's package wabt, or that of packaging/toolchain.py): {reason}")]
    NoWasm2c { reason: String },
    #[error("no C source can be made of the prebuilt library `{kind}`: {reason}")]
    Wasm2c { kind: String, reason: String },
    #[error("rustc can't be started ({0}): exporting needs a Rust toolchain on PATH, see rustup.rs")]
    NoRustc(io::Error),
    #[error("rustc is there and doesn't work: {0}")]
    BrokenRustc(String),
    #[error("rustc {found} is too old: units need {needed} or newer (`rustup update`)")]
    OldRustc { found: String, needed: &'static str },
    #[error("{reason}")]
    Unusable { reason: String },
    #[error("no library can be built for {triple}: {reason}; {help}")]
    NoTarget { triple: &'static str, reason: String, help: String },
    #[error("there is no C linker `{linker}`, which rustc makes the library with: {install}")]
    NoLinker { linker: String, install: &'static str },
    #[error("the C linker `{linker}` fails ({status}): {said}")]
    Linker { linker: String, status: String, said: String },
    #[error("there is no space left to build in {} ({said}): BRINELL_CACHE names another folder", shown(folder))]
    NoSpace { folder: PathBuf, said: String },
    #[error("rustc doesn't build the library: {0}")]
    Compiler(String),
    #[error("{0}")]
    Pack(#[from] PackError),
}

/// A folder that can't serve as a build folder.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    #[error("there is no folder to build units in: {0} is no absolute path; BRINELL_CACHE names one")]
    None(&'static str),
    #[error("units are not built in {}, which {reason}: BRINELL_CACHE names another folder", shown(folder))]
    NotOurs { folder: PathBuf, reason: &'static str },
    #[error(
        "the cache {}, where units are built, can't be used ({source}): BRINELL_CACHE names another folder",
        shown(folder)
    )]
    Unusable { folder: PathBuf, source: io::Error },
}

/// How to install a C linker on an operating system.
pub fn how_to_install(os: &str) -> &'static str {
    match os {
        "macos" => "`xcode-select --install` installs it",
        "windows" => "the Build Tools for Visual Studio, with \"Desktop development with C++\", have it",
        _ => "`apt install gcc` (Debian, Ubuntu), `dnf install gcc` (Fedora) or the gcc of your system installs it",
    }
}
