//! The compiler. It is called directly and not through cargo: only its arguments determine the result.

use super::diagnostics;
use super::error::ExportError;
use crate::files::FileError;
use brinell_exporter::platform::Target;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::OnceLock;
use std::{env, fs};

/// An available compiler.
#[derive(Clone)]
pub struct Rustc {
    program: PathBuf,
    /// The folder with its libraries in `lib/rustlib/TARGET`.
    sysroot: PathBuf,
    /// Its host target.
    host: String,
    /// Its version output and the time of its file, which identify it.
    pub identity: String,
}

/// The oldest version that the library compiles with.
const NEEDED: &str = env!("CARGO_PKG_RUST_VERSION");

/// Environment variables that compiler and linker may see: the paths of programs, and on some systems those of the
/// operating system's libraries. Any other variable, such as `LD_RUN_PATH` or `LINK`, could change the result.
const KEPT: &[&str] = match cfg!(windows) {
    false => &["PATH", "HOME", "DEVELOPER_DIR", "SDKROOT"],
    true => &[
        "PATH",
        "PATHEXT",
        "SystemRoot",
        "SystemDrive",
        "ComSpec",
        "ProgramData",
        "ProgramFiles",
        "ProgramFiles(x86)",
        "ProgramW6432",
        "CommonProgramFiles",
        "USERPROFILE",
        "APPDATA",
        "LOCALAPPDATA",
        "VCINSTALLDIR",
        "VSINSTALLDIR",
        "VCToolsInstallDir",
        "VSCMD_ARG_TGT_ARCH",
        "WindowsSdkDir",
        "WindowsSDKVersion",
        "UniversalCRTSdkDir",
        "UCRTVersion",
        "LIB",
        "LIBPATH",
    ],
};

impl Rustc {
    /// The compiler that belongs to the cargo that runs this program, otherwise the one on PATH. Only the root of the
    /// file system, the last of the folders above `cache`, is searched for a `rust-toolchain.toml`.
    ///
    /// # Errors
    /// [`ExportError::NoRustc`], [`ExportError::BrokenRustc`], [`ExportError::OldRustc`]
    pub fn find(cache: &Path) -> Result<Rustc, ExportError> {
        // an export needs it several times, and each query starts two processes
        static FOUND: OnceLock<Rustc> = OnceLock::new();
        if let Some(found) = FOUND.get() {
            return Ok(found.clone());
        }
        let beside_cargo = env::var_os("CARGO").map(|cargo| Path::new(&cargo).with_file_name(name()));
        let found = beside_cargo.filter(|path| path.is_absolute() && path.is_file()).unwrap_or_else(|| "rustc".into());
        Rustc::at(found, cache).map(|found| FOUND.get_or_init(|| found).clone())
    }

    /// The compiler `found`.
    ///
    /// # Errors
    /// As for [`Rustc::find`].
    pub fn at(found: PathBuf, cache: &Path) -> Result<Rustc, ExportError> {
        let root = cache.ancestors().last().unwrap_or(cache);
        // with the user's environment, in which rustup finds its toolchains
        let asked = Command::new(&found).args(["--print", "sysroot"]).current_dir(root).stdin(Stdio::null()).output();
        let sysroot = PathBuf::from(answer(&asked.map_err(ExportError::NoRustc)?)?);
        // the compiler itself, if rustup has answered
        let itself = sysroot.join("bin").join(name());
        let program = if itself.is_file() { itself } else { found };
        let asked = command(&program).arg("-vV").current_dir(root).output();
        let says = answer(&asked.map_err(ExportError::NoRustc)?)?;
        let line = |key: &str| says.lines().find_map(|line| line.strip_prefix(key)).unwrap_or_default();
        let (version, host) = (line("release: "), line("host: ").into());
        if number(version) < number(NEEDED) {
            return Err(ExportError::OldRustc { found: version.into(), needed: NEEDED });
        }
        // none for a compiler on PATH
        let modified = fs::metadata(&program).and_then(|metadata| metadata.modified()).ok();
        Ok(Rustc { identity: format!("{} {modified:?} {says}", program.display()), program, sysroot, host })
    }

    /// The folder of the compiler's files for this target.
    fn target_folder(&self, triple: &str) -> PathBuf {
        self.sysroot.join("lib").join("rustlib").join(triple)
    }

    /// Whether it has the library `core` for `target`.
    pub fn has(&self, target: &Target) -> bool {
        let Ok(files) = fs::read_dir(self.target_folder(target.triple).join("lib")) else { return false };
        files.flatten().any(|file| file.file_name().to_string_lossy().starts_with("libcore"))
    }

    /// LLVM's linker, if it is included.
    pub fn lld(&self) -> Option<PathBuf> {
        let name = format!("rust-lld{}", env::consts::EXE_SUFFIX);
        Some(self.target_folder(&self.host).join("bin").join(name)).filter(|lld| lld.is_file())
    }

    /// Compiles in `folder`, with these arguments and environment variables.
    ///
    /// # Errors
    /// [`ExportError`] with the reason.
    pub fn run<A: AsRef<OsStr>>(
        &self,
        folder: &Path,
        arguments: impl IntoIterator<Item = A>,
        variables: &[(&str, OsString)],
    ) -> Result<(), ExportError> {
        let temporary = folder.join("tmp");
        fs::create_dir_all(&temporary).map_err(FileError::at(&temporary))?;
        let mut command = command(&self.program);
        command.args(arguments).arg("--error-format=json").current_dir(folder).envs(variables.iter().cloned());
        for name in ["TMPDIR", "TEMP", "TMP"] {
            command.env(name, &temporary);
        }
        let output = command.output().map_err(ExportError::NoRustc)?;
        if output.status.success() { Ok(()) } else { Err(diagnostics::cause(&output, folder)) }
    }
}

/// The file name of a compiler.
fn name() -> String {
    format!("rustc{}", env::consts::EXE_SUFFIX)
}

/// A call of `program` without the user's settings and in English.
pub fn command(program: &Path) -> Command {
    let mut command = Command::new(program);
    let kept = |name: &&'static str| Some((*name, env::var_os(name)?));
    let kept: Vec<(&str, OsString)> = KEPT.iter().filter_map(kept).collect();
    command
        .stdin(Stdio::null())
        .env_clear()
        .envs(kept)
        .env("LC_ALL", "C")
        .env("CARGO_PKG_VERSION", env!("CARGO_PKG_VERSION"));
    command
}

/// The output of a query to the compiler.
fn answer(output: &Output) -> Result<String, ExportError> {
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).trim_end().into());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let first = said.lines().find(|line| !line.trim().is_empty()).unwrap_or("it says nothing");
    Err(ExportError::BrokenRustc(format!("{} ({})", first.trim(), output.status)))
}

/// The first two numbers of a version.
fn number(version: &str) -> (u32, u32) {
    let mut parts = version.split(['.', '-']).map(|part| part.parse().unwrap_or(0));
    (parts.next().unwrap_or(0), parts.next().unwrap_or(0))
}
