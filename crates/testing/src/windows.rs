//! Programs for Windows on this system: compiled with mingw-w64, and run with Wine.

use super::command::output;
use super::debian::{Packages, packages};
use super::systems::{executable, quoted, wine};
use crate::places::{root, temporary};
use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The target whose programs these are.
pub const TARGET: &str = "x86_64-pc-windows-gnu";

/// What the programs of mingw-w64 begin with.
const MINGW: &str = "x86_64-w64-mingw32-";

/// Those that the compiler calls, with their names in Debian's packages.
const PROGRAMS: [(&str, &str); 2] = [("gcc", "gcc-win32"), ("dlltool", "dlltool")];

/// Wine, with a folder of its own for what it keeps.
pub struct Wine {
    start: PathBuf,
    prefix: PathBuf,
    /// The compiler and its tools.
    mingw: Mingw,
}

/// The folder of the programs of mingw-w64, if they are not installed.
struct Mingw(Option<PathBuf>);

impl Mingw {
    /// The installed programs, otherwise Debian's.
    fn find() -> Result<Mingw, String> {
        if Command::new(format!("{MINGW}gcc")).arg("--version").output().is_ok() {
            return Ok(Mingw(None));
        }
        let Packages { folder, .. } = packages("mingw", "bookworm", &["gcc-mingw-w64-x86-64-win32"], true)?;
        let programs = folder.join("programs");
        let script = |name: &str| {
            let usr = folder.join("usr");
            let libraries = usr.join("lib/x86_64-linux-gnu");
            let program = usr.join(format!("bin/{MINGW}{name}"));
            format!("#!/bin/sh\nLD_LIBRARY_PATH={} exec {} \"$@\"\n", quoted(&libraries), quoted(&program))
        };
        let written = fs::create_dir_all(&programs).and_then(|()| {
            PROGRAMS
                .iter()
                .try_for_each(|(name, debians)| executable(&programs.join(format!("{MINGW}{name}")), &script(debians)))
        });
        written.map_err(|error| format!("{}: {error}", programs.display()))?;
        Ok(Mingw(Some(programs)))
    }

    /// A search path that has them.
    fn path(&self) -> OsString {
        let path = env::var_os("PATH").unwrap_or_default();
        let all = self.0.iter().cloned().chain(env::split_paths(&path));
        env::join_paths(all).expect("the folder has no separator in its name")
    }
}

impl Wine {
    /// The program in the variable WINE, otherwise Debian's.
    ///
    /// # Errors
    /// The reason why it is not available.
    pub fn find() -> Result<Wine, String> {
        let start = env::var_os("WINE").map_or_else(|| wine().map(|(start, _)| start), |named| Ok(named.into()))?;
        let found = Wine { start, prefix: temporary().join("wine"), mingw: Mingw::find()? };
        // on the drive of the project: a path in a test has none, and is then on the drive of the folder where it runs
        let files = temporary().join("wine-temporary");
        fs::create_dir_all(&files).map_err(|error| format!("{}: {error}", files.display()))?;
        let windows_path = format!("Z:{}", files.display()).replace('/', "\\");
        for name in ["TEMP", "TMP"] {
            let mut register = found.command(Path::new("reg"));
            let done = register.args(["add", r"HKCU\Environment", "/f", "/v", name, "/d", &windows_path]).output();
            let done = done.map_err(|error| format!("{}: {error}", found.start.display()))?;
            if !done.status.success() {
                return Err(format!("Wine can't be started: {}", String::from_utf8_lossy(&done.stderr)));
            }
        }
        Ok(found)
    }

    /// A call of the program at `path`.
    pub fn command(&self, path: &Path) -> Command {
        let mut command = Command::new(&self.start);
        command.arg(path).env("WINEPREFIX", &self.prefix).env("WINEDEBUG", "-all");
        command.env("WINEDLLOVERRIDES", "mscoree,mshtml=").env_remove("DISPLAY");
        command
    }

    /// `cargo` with the linker for Windows.
    pub fn linking<'a>(&self, cargo: &'a mut Command) -> &'a mut Command {
        let variable = format!("CARGO_TARGET_{}_LINKER", TARGET.to_uppercase().replace('-', "_"));
        cargo.env("PATH", self.mingw.path()).env(variable, format!("{MINGW}gcc"))
    }

    /// Makes programs in `folder` start in this Wine. Below version 9 it has no bcryptprimitives.dll, and gets a replacement.
    pub fn settle(&self, folder: &Path) {
        let mut compile = Command::new(format!("{MINGW}gcc"));
        // the search path of a command is also that in which it is looked for
        compile.env("PATH", self.mingw.path()).args(["-shared", "-O1"]);
        compile.arg(root().join("tests/c/bcryptprimitives.c")).arg("-ladvapi32");
        output(compile.arg("-o").arg(folder.join("bcryptprimitives.dll"))).with_status(0);
    }
}
