//! `core` and `compiler_builtins`, compiled for each target from the sources of the compiler.

use super::ToolchainError;
use crate::files::FileError;
use crate::package::{Rustc, Toolchain};
use crate::parallel;
use crate::platform::Target;
use indicatif::{ProgressBar, ProgressStyle};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Settings for crates of the standard library: their unstable features remain unstable for their users.
const SETTINGS: [&str; 6] = [
    "--crate-type=rlib",
    "-Copt-level=3",
    "-Cpanic=abort",
    "-Ccodegen-units=1",
    "-Zforce-unstable-if-unmarked",
    "--cap-lints=allow",
];

/// The configuration by the build script of `compiler_builtins` for 64-bit processors. The functions over bytes are the
/// exporter's own.
const BUILTINS: [&str; 6] = [
    "--cfg=feature=\"compiler-builtins\"",
    "--cfg=feature=\"mem-unaligned\"",
    "--cfg=feature=\"unstable-intrinsics\"",
    "--cfg=intrinsics_enabled",
    "--cfg=arch_enabled",
    "--cfg=optimizations_enabled",
];

/// Compiles both libraries for all targets that do not have them.
///
/// # Errors
/// [`ToolchainError`]
pub fn build(toolchain: &Toolchain, cache: &Path) -> Result<(), ToolchainError> {
    let rustc = Rustc::at(toolchain.rustc(), cache).map_err(|error| ToolchainError::Unusable(error.to_string()))?;
    let library = library(toolchain)?;
    let style = ProgressStyle::with_template("{bar:30} {pos} of {len} targets, {elapsed}  {wide_msg}");
    let bar = ProgressBar::new(Target::ALL.len() as u64).with_style(style.expect("a good template"));
    bar.set_message("compiling core");
    bar.enable_steady_tick(Duration::from_millis(200));
    parallel::each(&Target::ALL, |target| {
        if bar.is_hidden() {
            crate::layout::tell(&format!("compiling core for {} ...", target.triple));
        }
        let compiled = compile(toolchain, &rustc, &library, target);
        bar.inc(1);
        compiled
    })?;
    bar.finish_and_clear();
    Ok(())
}

/// The folder of the sources.
fn library(toolchain: &Toolchain) -> Result<PathBuf, ToolchainError> {
    let sources = toolchain.usr().join("src");
    let entries = fs::read_dir(&sources).map_err(FileError::at(&sources))?;
    let mut folders = entries.flatten().map(|entry| entry.path().join("library"));
    folders.find(|folder| folder.is_dir()).ok_or_else(|| ToolchainError::Package {
        package: "rust-web-src".into(),
        reason: "it has no folder `library`".into(),
    })
}

fn compile(toolchain: &Toolchain, rustc: &Rustc, library: &Path, target: &Target) -> Result<(), ToolchainError> {
    let (folder, whole) = (toolchain.target(target.triple).join("new"), toolchain.target(target.triple).join("lib"));
    if rustc.has(target) {
        return Ok(());
    }
    fs::create_dir_all(&folder).map_err(FileError::at(&folder))?;
    let unstable = [("RUSTC_BOOTSTRAP", OsString::from("1"))];
    let build = |name: &str, crate_folder: PathBuf, more: &[&str]| {
        let edition = format!("--edition={}", edition(&crate_folder)?);
        let named = [format!("--crate-name={name}"), edition, "--target".into(), target.triple.into()];
        let paths = [crate_folder.join("src/lib.rs"), "-o".into(), folder.join(format!("lib{name}.rlib"))];
        let arguments = SETTINGS.iter().chain(more).map(OsString::from).chain(named.map(OsString::from));
        rustc.run(&folder, arguments.chain(paths.map(PathBuf::into_os_string)), &unstable).map_err(ToolchainError::from)
    };
    // bitcode only, because it is optimized together with the FMU library
    build("core", library.join("core"), &["-Clinker-plugin-lto"])?;
    let builtins = [BUILTINS.as_slice(), &["--extern=core=libcore.rlib"]].concat();
    build("compiler_builtins", library.join("compiler-builtins/compiler-builtins"), &builtins)?;
    let temporary = folder.join("tmp");
    fs::remove_dir_all(&temporary).map_err(FileError::at(&temporary))?;
    move_into(&folder, &whole).map_err(FileError::at(&whole))?;
    Ok(())
}

/// Moves the files of `new` to `whole`, which may contain others (`std` of the host).
fn move_into(new: &Path, whole: &Path) -> std::io::Result<()> {
    fs::create_dir_all(whole)?;
    // `core` comes last: a target that has it is complete
    for name in ["libcompiler_builtins.rlib", "libcore.rlib"] {
        fs::rename(new.join(name), whole.join(name))?;
    }
    fs::remove_dir(new)
}

/// The edition in the manifest of a crate.
fn edition(crate_folder: &Path) -> Result<String, FileError> {
    let path = crate_folder.join("Cargo.toml");
    let text = fs::read_to_string(&path).map_err(FileError::at(&path))?;
    let edition = text.lines().find_map(|line| line.strip_prefix("edition = \"")?.strip_suffix('"'));
    Ok(edition.unwrap_or("2024").into())
}
