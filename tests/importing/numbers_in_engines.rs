//! The numbers of `brinell translate` in engines that are no Python packages: Yade from Debian, Jolt and PhysX for Node.js. They run with
//! `BRINELL_ENGINES=all`.

use crate::debian;
use crate::engines::{all, with_scipy};
use crate::python;
use crate::skips;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

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
    with_scipy("BRINELL_TEST_DEBIAN", &packages.folder, "test_translate_yade.py");
}

/// Runs the tests in `file` with this release of a package for Node.js.
fn with_npm(what: &str, size: &str, package: &str, file: &str) {
    if !all() {
        return skips::skipped(what, &format!("{size} of npm; BRINELL_ENGINES=all adds them"));
    }
    match npm(package) {
        Ok(folder) => with_scipy("BRINELL_TEST_NPM", &folder, file),
        Err(why) => skips::skipped(what, &why),
    }
}

#[test]
fn numbers_for_jolt_do_what_is_promised_in_it() {
    with_npm("numbers for jolt", "45 MB", "jolt-physics@1.1.0", "test_translate_jolt.py");
}

#[test]
fn numbers_for_physx_do_what_is_promised_in_it() {
    with_npm("numbers for physx", "10 MB", "physx-js-webidl@2.7.3", "test_translate_physx.py");
}

/// The folder in which Node.js finds the package.
///
/// # Errors
/// The reason why it is not available.
fn npm(package: &str) -> Result<PathBuf, String> {
    let folder = python::target_folder().join("npm").join(package);
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut npm = Command::new("npm");
    npm.args(["install", "--no-audit", "--no-fund", "--ignore-scripts", "--prefix"]).arg(&folder).arg(package);
    let output = npm.output().map_err(|error| format!("npm can't be started: {error}"))?;
    match output.status.success() {
        true => Ok(folder),
        false => Err(format!("npm can't install {package}: {}", String::from_utf8_lossy(&output.stderr))),
    }
}
