//! The numbers of `brinell translate` in engines that are no Python packages: Yade from Debian, Jolt for Node.js. They run with
//! `BRINELL_ENGINES=all`.

use crate::debian;
use crate::engines::{all, interpreter, pytest_with};
use crate::python;
use crate::skips;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// The release of Jolt for JavaScript.
const JOLT: &str = "jolt-physics@1.1.0";

#[test]
fn numbers_for_yade_do_what_is_promised_in_it() {
    let what = "numbers for yade";
    if !all() {
        return skips::skipped(what, "240 MB of Debian; BRINELL_ENGINES=all adds them");
    }
    let packages = match debian::packages("yade", "bookworm", &["yade"], true) {
        Ok(packages) => packages,
        Err(why) => return skips::skipped(what, &why),
    };
    // as large as the one that runs, each
    for precision in ["longdouble", "float128", "mpfr150"] {
        let _ = fs::remove_dir_all(packages.folder.join(format!("usr/lib/x86_64-linux-gnu/yade-{precision}")));
    }
    pytest_with(interpreter(&["scipy"]).env("BRINELL_TEST_DEBIAN", packages.folder), &["test_translate_yade.py"]);
}

#[test]
fn numbers_for_jolt_do_what_is_promised_in_it() {
    let what = "numbers for jolt";
    if !all() {
        return skips::skipped(what, "45 MB of npm; BRINELL_ENGINES=all adds them");
    }
    match jolt() {
        Ok(folder) => {
            pytest_with(interpreter(&["scipy"]).env("BRINELL_TEST_NPM", folder), &["test_translate_jolt.py"]);
        }
        Err(why) => skips::skipped(what, &why),
    }
}

/// The folder in which Node.js finds Jolt.
///
/// # Errors
/// The reason why it is not available.
fn jolt() -> Result<PathBuf, String> {
    let folder = python::target_folder().join("npm");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut npm = Command::new("npm");
    npm.args(["install", "--no-audit", "--no-fund", "--ignore-scripts", "--prefix"]).arg(&folder).arg(JOLT);
    let output = npm.output().map_err(|error| format!("npm can't be started: {error}"))?;
    match output.status.success() {
        true => Ok(folder),
        false => Err(format!("npm can't install {JOLT}: {}", String::from_utf8_lossy(&output.stderr))),
    }
}
