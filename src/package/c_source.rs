//! From a module for WebAssembly to C: `wasm2c` of the toolchain, otherwise the one on PATH.

use super::compiler::Toolchain;
use super::error::ExportError;
use super::rustc::command;
use crate::files::FileError;
use crate::temporary::PrivateFolder;
use brinell_exporter::c_source::{WASM2C, c_text};
use std::fs;

/// The C source of a prebuilt library of this `kind`, which was compiled to `module`.
///
/// # Errors
/// [`ExportError::NoWasm2c`], [`ExportError::Wasm2c`]
pub fn made(module: &[u8], kind: &str) -> Result<Vec<u8>, ExportError> {
    let program = Toolchain::find().map(|toolchain| toolchain.wasm2c()).filter(|path| path.is_file());
    let program = program.unwrap_or_else(|| "wasm2c".into());
    let missing = |reason: String| ExportError::NoWasm2c { reason };
    let asked = command(&program).arg("--version").output().map_err(|error| missing(error.to_string()))?;
    let version = String::from_utf8_lossy(&asked.stdout).trim().to_string();
    if version != WASM2C {
        return Err(missing(format!("its version is {version}")));
    }
    let folder = PrivateFolder::new("brinell-source-", &std::env::temp_dir())?;
    let [input, output] = ["unit.wasm", "unit.c"].map(|name| folder.path().join(name));
    fs::write(&input, module).map_err(FileError::at(&input))?;
    let ran = command(&program).args(["-n", "unit"]).arg(&input).arg("-o").arg(&output).output();
    let ran = ran.map_err(|error| missing(error.to_string()))?;
    let failed = |reason: String| ExportError::Wasm2c { kind: kind.into(), reason };
    if !ran.status.success() {
        return Err(failed(String::from_utf8_lossy(&ran.stderr).trim().into()));
    }
    let text = fs::read_to_string(&output).map_err(FileError::at(&output))?;
    Ok(c_text(&text, kind).map_err(|error| failed(error.to_string()))?.into_bytes())
}
