//! The first test program, because cargo runs them in alphabetical order: this machine has what the tests need, and the list of
//! what is skipped begins anew. docs/project/tests.md lists the packages for each system.

use brinell_testing::places::WORKER;
use brinell_testing::python::{self, INSTALLED};
use brinell_testing::skips;
use std::env;
use std::process::{Command, Output, Stdio};

/// Oldest version of Python that the tests support: their packages have no files for older ones.
const OLDEST_PYTHON: (u32, u32) = (3, 11);

/// The output of `command`, if it can be started.
fn run(command: &str, arguments: &[&str]) -> Option<Output> {
    Command::new(command).args(arguments).stdin(Stdio::null()).output().ok()
}

/// What is wrong with the C compiler, which links FMUs and compiles importers for tests. On Windows cargo names the linker if there
/// is none, and the importers are left out.
fn c_compiler() -> Option<String> {
    if cfg!(windows) {
        return None;
    }
    match run("cc", &["--version"]) {
        Some(output) if output.status.success() => None,
        _ => Some(
            "there is no C compiler `cc` (Debian and Ubuntu: apt install gcc libc6-dev; macOS: xcode-select --install)"
                .into(),
        ),
    }
}

/// What is wrong with a Python that says this version.
fn too_old(version: &str) -> Option<String> {
    let mut numbers = version.trim().split('.').map(|number| number.parse::<u32>().ok());
    let (major, minor) = (numbers.next().flatten()?, numbers.next().flatten()?);
    let (least_major, least_minor) = OLDEST_PYTHON;
    ((major, minor) < OLDEST_PYTHON).then(|| {
        format!(
            "`{INSTALLED}` is Python {major}.{minor}; the tests need Python {least_major}.{least_minor} or newer first on the PATH \
             (such as from https://www.python.org or with pyenv)"
        )
    })
}

fn python() -> Option<String> {
    let missing = || format!("there is no `{INSTALLED}` (Debian and Ubuntu: apt install python3 python3-venv)");
    let version = "import sys; print('%d.%d' % sys.version_info[:2])";
    let Some(output) = run(INSTALLED, &["-c", version]).filter(|output| output.status.success()) else {
        return Some(missing());
    };
    if let Some(old) = too_old(&String::from_utf8_lossy(&output.stdout)) {
        return Some(old);
    }
    // Debian has the modules that make an environment in a package of their own
    let venv = run(INSTALLED, &["-c", "import venv, ensurepip"]);
    let has = venv.is_some_and(|output| output.status.success());
    (!has).then(|| format!("`{INSTALLED} -m venv` doesn't work (Debian and Ubuntu: apt install python3-venv)"))
}

#[test]
fn this_machine_has_what_the_tests_need() {
    let missing: Vec<_> = [c_compiler(), python()].into_iter().flatten().collect();
    assert!(missing.is_empty(), "the tests can't run here:\n- {}", missing.join("\n- "));
}

/// They are downloaded while the next test programs run, by a process of its own: whoever needs them waits for it, and says what fails.
#[test]
#[allow(clippy::zombie_processes, reason = "it outlives this program")]
fn the_packages_of_python_begin_to_be_installed() {
    if env::var_os(WORKER).is_some() {
        python::python();
        python::engines(false);
        return;
    }
    let mut own = Command::new(env::current_exe().expect("a test knows where it is"));
    own.args(["--exact", "the_packages_of_python_begin_to_be_installed"]).env(WORKER, "1");
    own.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("this program can be started");
}

#[test]
fn an_old_python_is_named_with_the_version_that_is_needed() {
    for version in ["3.9\n", "3.10\n", "2.7\n"] {
        let message = too_old(version).expect("too old");
        assert!(message.contains(version.trim()) && message.contains("3.11 or newer"), "{message}");
    }
    for version in ["3.11\n", "3.14\n", "4.0\n"] {
        assert_eq!(too_old(version), None);
    }
}

#[test]
fn the_list_of_what_is_skipped_begins_anew() {
    skips::begin();
}
