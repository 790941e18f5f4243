//! `brinell toolchain`: downloads a compiler for all platforms into a folder of its own, without root privileges.
//!
//! For building browsers, Debian has a Rust compiler with the sources of Rust's libraries, and LLVM's linker. The packages are
//! unpacked but not installed. `core` is then compiled for each target. [`crate::package::Toolchain`] describes the layout of
//! the folder.

mod deb;
mod download;
mod index;
mod package;
mod scripts;
mod targets;

use crate::files::{FileError, write_whole};
use crate::layout::shown;
use crate::package::{Cache, ExportError, Toolchain};
use download::Source;
use package::Package;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

/// The reason why the toolchain is not available.
#[derive(Debug, thiserror::Error)]
pub enum ToolchainError {
    #[error("{0}")]
    File(#[from] FileError),
    #[error("{0}")]
    Export(#[from] ExportError),
    #[error(
        "there is no toolchain to fetch for {0}, only for Linux on x86-64 and arm64: \
         `rustup target add TARGET` installs what a platform needs"
    )]
    System(String),
    #[error("curl can't be started ({0}): the toolchain is downloaded by curl, which your system has a package of")]
    NoCurl(std::io::Error),
    #[error("{url} can't be downloaded ({said}); {progress}the same command goes on where this one stopped")]
    Download { url: String, said: String, progress: String },
    #[error("{url} is damaged: {found}, where the index of the packages has {wanted}; it was removed")]
    Damaged { url: String, found: String, wanted: String },
    #[error("the index of the packages has no {0}: the project's page may have a newer version of this program")]
    NoPackage(String),
    #[error("the package {package} can't be unpacked: {reason}")]
    Package { package: String, reason: String },
    #[error(
        "the compiler that was fetched doesn't run here ({0}): it needs glibc 2.36 or newer (Debian 12, Ubuntu 24.04, Fedora 38) \
         and libz3, libedit, libxml2, libzstd; `rustup target add TARGET` installs what a platform needs otherwise"
    )]
    Unusable(String),
}

/// The arguments of the command.
pub struct Wanted<'a> {
    pub folder: Option<&'a Path>,
    /// Also the parts needed to build complete programs.
    pub std: bool,
    pub mirror: &'a str,
}

/// The command: downloads the missing parts.
///
/// # Errors
/// [`ToolchainError`]; complete downloads are kept, and the next call continues with them.
pub fn run(wanted: &Wanted, as_json: bool) -> Result<(), ToolchainError> {
    let cache = Cache::open()?;
    let toolchain = match wanted.folder {
        Some(folder) => Toolchain { folder: std::path::absolute(folder).map_err(FileError::at(folder))? },
        None => Toolchain::of(&cache.folder),
    };
    fs::create_dir_all(&toolchain.folder).map_err(FileError::at(&toolchain.folder))?;
    let _alone = lock(&toolchain)?;
    if !is_complete(&toolchain, wanted.std) {
        fetch(&toolchain, wanted, &cache)?;
    }
    tell(&toolchain, wanted, as_json)
}

/// Waits for another process that downloads to the same folder.
fn lock(toolchain: &Toolchain) -> Result<fs::File, FileError> {
    let path = toolchain.folder.join("lock");
    let file = fs::File::create(&path).map_err(FileError::at(&path))?;
    file.lock().map_err(FileError::at(&path))?;
    Ok(file)
}

/// Whether the toolchain is available with all required parts.
fn is_complete(toolchain: &Toolchain, std: bool) -> bool {
    toolchain.is_whole() && (!std || list(toolchain)["std"] == true)
}

fn list(toolchain: &Toolchain) -> Value {
    let text = fs::read_to_string(toolchain.list()).unwrap_or_default();
    serde_json::from_str(&text).unwrap_or_default()
}

fn fetch(toolchain: &Toolchain, wanted: &Wanted, cache: &Cache) -> Result<(), ToolchainError> {
    let folder = toolchain.folder.join("packages");
    fs::create_dir_all(&folder).map_err(FileError::at(&folder))?;
    let source = Source { mirror: wanted.mirror, folder: &folder };
    let packages = index::packages(&source, wanted.std)?;
    let archives = source.packages(&packages)?;
    unpack(toolchain, &packages, &archives, wanted.std)?;
    targets::build(toolchain, &cache.folder)?;
    if !wanted.std {
        let sources = toolchain.usr().join("src");
        fs::remove_dir_all(&sources).map_err(FileError::at(&sources))?;
    }
    let packages: Vec<_> = packages.iter().map(Package::json).collect();
    let list = json!({ "std": wanted.std, "mirror": wanted.mirror, "packages": packages });
    write_whole(&toolchain.list(), format!("{list:#}\n").as_bytes())?;
    // if it cannot be removed, it only takes space
    let _ = fs::remove_dir_all(&folder);
    Ok(())
}

/// Unpacks the packages, unless an interrupted call has done so.
fn unpack(toolchain: &Toolchain, packages: &[Package], archives: &[PathBuf], std: bool) -> Result<(), ToolchainError> {
    let done = toolchain.folder.join("packages/unpacked");
    let hashes: String = packages.iter().map(|package| format!("{}\n", package.sha256)).collect();
    if fs::read_to_string(&done).is_ok_and(|text| text == hashes) {
        return Ok(());
    }
    // the existing files belong to other packages, or are incomplete
    for path in [toolchain.list(), done.clone()] {
        let _ = fs::remove_file(path);
    }
    let usr = toolchain.usr();
    if usr.exists() {
        fs::remove_dir_all(&usr).map_err(FileError::at(&usr))?;
    }
    for (package, archive) in packages.iter().zip(archives) {
        crate::layout::tell(&format!("unpacking {} ...", package.name));
        let wanted = |path: &str| package.part.has(path, std);
        deb::unpack(archive, &toolchain.folder, wanted)
            .map_err(|reason| ToolchainError::Package { package: package.name.clone(), reason })?;
    }
    scripts::write(toolchain)?;
    Ok(write_whole(&done, hashes.as_bytes())?)
}

/// Prints what is available.
fn tell(toolchain: &Toolchain, wanted: &Wanted, as_json: bool) -> Result<(), ToolchainError> {
    let size = size(&toolchain.folder).map_err(FileError::at(&toolchain.folder))?;
    let folder = shown(&toolchain.folder);
    if as_json {
        let mut object = list(toolchain);
        object["folder"] = json!(toolchain.folder.to_string_lossy());
        object["size"] = json!(size);
        println!("{object}");
        return Ok(());
    }
    println!("{folder}: a compiler for all platforms, {} MB", size / 1_000_000);
    for package in list(toolchain)["packages"].as_array().into_iter().flatten() {
        println!(
            "  {:<24}{}",
            package["name"].as_str().unwrap_or_default(),
            package["version"].as_str().unwrap_or_default()
        );
    }
    if wanted.folder.is_some() {
        println!("BRINELL_TOOLCHAIN={folder} brinell export SCENE --platforms all uses it.");
    }
    println!("To remove or renew it, delete the folder.");
    Ok(())
}

/// Size of the files below `folder` [bytes].
fn size(folder: &Path) -> std::io::Result<u64> {
    let mut sum = 0;
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let metadata = entry.metadata()?;
        sum += if metadata.is_dir() { size(&entry.path())? } else { metadata.len() };
    }
    Ok(sum)
}
