//! Python for tests: a virtual environment inside the target folder, made from `tests/requirements.txt` when it is first
//! needed and again when that file changes.
#![allow(dead_code, reason = "each test file uses what it needs")]

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

const REQUIREMENTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/requirements.txt");

/// The target folder of cargo: its folder for tests lies in it.
pub fn target_folder() -> PathBuf {
    let temporary = Path::new(env!("CARGO_TARGET_TMPDIR"));
    temporary.parent().expect("cargo's folder for tests lies in the target folder").to_path_buf()
}

/// The interpreter that has fmpy, pytest and libclang.
pub fn python() -> PathBuf {
    static PYTHON: OnceLock<PathBuf> = OnceLock::new();
    PYTHON.get_or_init(environment).clone()
}

/// What the virtual environment has at `path` below its packages, such as `fmpy/c-code` with the official C headers and
/// `fmpy/schema/fmi2` with the official XML schema.
pub fn site_packages_file(path: &str) -> PathBuf {
    // asked for, since the folder's name depends on platform and version
    let mut command = Command::new(python());
    command.args(["-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]);
    let output = run(&mut command, "the virtual environment is broken; delete it");
    let file = Path::new(String::from_utf8_lossy(&output.stdout).trim()).join(path);
    assert!(file.exists(), "{} is missing, although {REQUIREMENTS} is installed", file.display());
    file
}

/// Makes the virtual environment if it isn't there as tests/requirements.txt wants it.
fn environment() -> PathBuf {
    environment_of("test-venv", Path::new(REQUIREMENTS)).unwrap_or_else(|reason| panic!("{reason}"))
}

/// The interpreter of the virtual environment `name` in the target folder, made if it isn't there as `requirements` wants it.
///
/// # Errors
/// Why it can't be made.
pub fn environment_of(name: &str, requirements: &Path) -> Result<PathBuf, String> {
    let folder = target_folder().join(name);
    let interpreter = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let wanted = fs::read(requirements).map_err(|error| format!("{}: {error}", requirements.display()))?;
    // test programs may run at the same time, and one environment serves all of them. The lock ends with the process.
    let lock = File::create(folder.with_extension("lock")).expect("the target folder can be written to");
    lock.lock().expect("the target folder is on a file system with locks");
    // the copy of the requirements is written last: an environment without it is unfinished
    let marker = folder.join("requirements.txt");
    if fs::read(&marker).is_ok_and(|made| made == wanted) && interpreter.exists() {
        return Ok(interpreter);
    }
    let _ = fs::remove_dir_all(&folder);
    let hint = "the tests in Python need Python 3.11 or newer with venv (Debian and Ubuntu: apt install python3-venv)";
    succeed(Command::new("python3").args(["-m", "venv"]).arg(&folder), hint)?;
    succeed(
        Command::new(&interpreter)
            .args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r"])
            .arg(requirements),
        &format!("{} can't be installed; the first run needs the Python Package Index", requirements.display()),
    )?;
    fs::write(&marker, wanted).expect("the target folder can be written to");
    Ok(interpreter)
}

/// Runs `command`; if it fails the test fails with `hint` and what the command wrote.
fn run(command: &mut Command, hint: &str) -> Output {
    succeed(command, hint).unwrap_or_else(|reason| panic!("{reason}"))
}

/// Runs `command`.
///
/// # Errors
/// `hint` and what the command wrote.
fn succeed(command: &mut Command, hint: &str) -> Result<Output, String> {
    let output = command.output().map_err(|error| format!("{command:?} can't be started ({error}): {hint}"))?;
    if output.status.success() {
        return Ok(output);
    }
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    Err(format!("{command:?} failed: {hint}\n{out}{err}"))
}
