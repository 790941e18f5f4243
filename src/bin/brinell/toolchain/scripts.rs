//! The programs of the toolchain for the exporter: scripts that set the paths of the libraries.

use crate::files::FileError;
use crate::package::Toolchain;
use std::env;
use std::fs;
use std::path::Path;

/// The compiler.
const RUSTC: &str = r#"#!/bin/sh
here=${0%/*}
LD_LIBRARY_PATH=$here/../lib/LIBRARIES exec "$here/rustc-web" "$@"
"#;

/// LLVM's linker, as called from `lib/rustlib/HOST/bin`.
const LLD: &str = r#"#!/bin/sh
usr=${0%/*}/../../../..
LD_LIBRARY_PATH=$usr/lib/LIBRARIES exec "$usr"/lib/llvm-*/bin/lld "$@"
"#;

/// A C compiler driver that can only link. Debian's rustc has no other way to link ELF files.
const DRIVER: &str = r#"#!/bin/sh
# Takes the arguments of a C compiler, and gives those for the linker to LLVM's.
set -f
here=${0%/*}
count=$#
while [ $count -gt 0 ]; do
  argument=$1
  shift
  count=$((count - 1))
  case $argument in
    -Wl,*) IFS=,; set -- "$@" ${argument#-Wl,}; unset IFS ;;
    -nostartfiles|-nodefaultlibs|-nostdlib|-m64) ;;
    *) set -- "$@" "$argument" ;;
  esac
done
exec "$here/../lib/rustlib/HOST/bin/rust-lld" -flavor gnu "$@"
"#;

/// Writes the scripts.
///
/// # Errors
/// [`FileError`]
pub fn write(toolchain: &Toolchain) -> Result<(), FileError> {
    let libraries = format!("{}-linux-gnu", env::consts::ARCH);
    let host = format!("{}-unknown-linux-gnu", env::consts::ARCH);
    let bin = toolchain.target(&host).join("bin");
    fs::create_dir_all(&bin).map_err(FileError::at(&bin))?;
    let scripts = [(toolchain.rustc(), RUSTC), (toolchain.driver(), DRIVER), (bin.join("rust-lld"), LLD)];
    for (path, text) in scripts {
        let text = text.replace("LIBRARIES", &libraries).replace("HOST", &host);
        fs::write(&path, text).and_then(|()| make_executable(&path)).map_err(FileError::at(&path))?;
    }
    Ok(())
}

#[cfg(unix)]
fn make_executable(path: &Path) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(path, fs::Permissions::from_mode(0o755))
}

/// No toolchain can be downloaded on such a system.
#[cfg(not(unix))]
fn make_executable(_path: &Path) -> std::io::Result<()> {
    Ok(())
}
