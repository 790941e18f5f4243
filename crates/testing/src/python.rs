//! Python for tests: a virtual environment in the target folder. It is created from `tests/requirements.txt` on first use, and
//! again when that file changes.

use crate::command::settled;
use crate::long;
use crate::places::{root, temporary};
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

/// The installed interpreter. On Windows, `python3` may be a program that opens a shop.
pub const INSTALLED: &str = if cfg!(windows) { "python" } else { "python3" };

const REQUIREMENTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/requirements.txt");

/// The target folder of cargo, which contains its folder for tests.
pub fn target_folder() -> PathBuf {
    let temporary = temporary();
    temporary.parent().expect("cargo's folder for tests lies in the target folder").to_path_buf()
}

/// The environment that others are beside.
const COMMON: &str = "test-venv";

/// The interpreter with fmpy, pytest and libclang.
pub fn python() -> PathBuf {
    static PYTHON: OnceLock<PathBuf> = OnceLock::new();
    PYTHON.get_or_init(|| environment_of(COMMON, Path::new(REQUIREMENTS)).unwrap_or_else(|why| panic!("{why}"))).clone()
}

/// The interpreter with MuJoCo and the packages for studies, or with the large engines also.
pub fn engines(large: bool) -> PathBuf {
    static ENVIRONMENTS: [OnceLock<PathBuf>; 2] = [const { OnceLock::new() }; 2];
    let name = if large { "engines-large" } else { "engines" };
    let list = |name: &str| root().join(format!("tests/requirements-{name}.txt"));
    let made = || {
        let file = match (large, long::is_asked()) {
            (false, true) => joined(&[list("engines"), list("engines-long")]),
            _ => list(name),
        };
        environment_beside(&format!("{name}-venv"), &file, None).unwrap_or_else(|why| panic!("{why}"))
    };
    ENVIRONMENTS[usize::from(large)].get_or_init(made).clone()
}

/// A file in the target folder with the lines of these.
fn joined(files: &[PathBuf]) -> PathBuf {
    let joined = temporary().join("requirements.txt");
    let texts: Vec<_> = files.iter().map(|file| read(file).unwrap_or_else(|why| panic!("{why}"))).collect();
    fs::write(&joined, texts.concat()).expect("the target folder can be written to");
    joined
}

/// `command` of Python, which keeps compiled modules in the target folder: the source tree stays clean, and no process
/// compiles what another one has compiled. Temporary files and settings are there, too: fmpy leaves unpacked FMUs behind. Our program
/// has nothing of the user's.
pub fn keeping_modules(command: &mut Command) -> &mut Command {
    let [modules, temporary, settings] =
        ["python-modules", "python-temporary", "python-settings"].map(|name| target_folder().join(name));
    fs::create_dir_all(&temporary).expect("the target folder can be written to");
    command.env_remove("PYTHONDONTWRITEBYTECODE").env("PYTHONPYCACHEPREFIX", modules);
    settled(command).env("TMPDIR", temporary).env("MPLCONFIGDIR", settings)
}

/// The path of a file of the installed packages, such as `fmpy/c-code` with the official C headers and `fmpy/schema/fmi2` with
/// the official XML schema.
pub fn site_packages_file(path: &str) -> PathBuf {
    // requested from Python, because the folder's name depends on platform and version
    let mut command = Command::new(python());
    command.args(["-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]);
    let output = run(&mut command, "the virtual environment is broken; delete it");
    let file = Path::new(String::from_utf8_lossy(&output.stdout).trim()).join(path);
    assert!(file.exists(), "{} is missing, although {REQUIREMENTS} is installed", file.display());
    file
}

/// The interpreter of the virtual environment `name` in the target folder, created according to `requirements` if it does not
/// exist.
///
/// # Errors
/// The reason why it cannot be created.
pub fn environment_of(name: &str, requirements: &Path) -> Result<PathBuf, String> {
    environment(name, &read(requirements)?, &[], |interpreter| {
        let hint =
            format!("{} can't be installed; the first run needs the Python Package Index", requirements.display());
        let mut command = pip(interpreter, interpreter);
        // the list is complete
        command.args((name == COMMON).then_some("--no-deps")).arg("-r").arg(requirements);
        succeed(&mut command, &hint).map(|_| true)
    })
}

/// The same with the packages of tests/requirements.txt, which are not installed again. Some of `more` have no package for some
/// platforms: if they cannot be installed together, each line of the file is installed separately. What Python has no packages of,
/// the script `rest` installs in the environment, whose folder it gets.
///
/// # Errors
/// The reason why the environment cannot be created.
pub fn environment_beside(name: &str, more: &Path, rest: Option<&Path>) -> Result<PathBuf, String> {
    let common = python();
    let script = rest.map_or_else(|| Ok(Vec::new()), read)?;
    let wanted = [read(Path::new(REQUIREMENTS))?, read(more)?, script].concat();
    // the installer of the common environment installs here, too
    environment(name, &wanted, &["--without-pip"], |interpreter| {
        // a path file: its lines are added to those where Python looks for packages; it reads them in the language of the user, who
        // may know only ASCII, and both environments are beside each other
        let packages = packages_of(interpreter)?;
        let up = "../".repeat(1 + Path::new(&packages).components().count());
        let link = target_folder().join(name).join(&packages).join("of_the_tests.pth");
        fs::write(link, format!("{up}{COMMON}/{packages}\n")).expect("the target folder can be written to");
        let complete = install_what_can_be(&common, interpreter, more);
        if let Some(script) = rest {
            let hint = format!("{} can't install its part; the first run needs its registry", script.display());
            succeed(Command::new(interpreter).arg(script).arg(target_folder().join(name)), &hint)?;
        }
        Ok(complete)
    })
}

/// The folder with the packages of `interpreter`, in its environment.
fn packages_of(interpreter: &Path) -> Result<String, String> {
    let mut command = Command::new(interpreter);
    command
        .args(["-c", "import os, sys, sysconfig; print(os.path.relpath(sysconfig.get_path('purelib'), sys.prefix))"]);
    let output = succeed(&mut command, "the virtual environment is broken; delete it")?;
    Ok(String::from_utf8_lossy(&output.stdout).trim().into())
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    fs::read(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// The interpreter of the virtual environment `name`. If it does not exist, or was made for something other than `wanted`, it is created
/// with these `options`, and filled by `install`, which returns whether it is complete.
fn environment(
    name: &str,
    wanted: &[u8],
    options: &[&str],
    install: impl FnOnce(&Path) -> Result<bool, String>,
) -> Result<PathBuf, String> {
    let folder = target_folder().join(name);
    let interpreter = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    // test programs may run at the same time with one common environment; the lock ends with the process
    let lock = File::create(folder.with_extension("lock")).expect("the target folder can be written to");
    lock.lock().expect("the target folder is on a file system with locks");
    let hint = "the tests in Python need Python 3.11 or newer with venv (Debian and Ubuntu: apt install python3-venv)";
    // another version doesn't find the packages
    let version = succeed(Command::new(INSTALLED).arg("--version"), hint)?.stdout;
    let wanted = [b"# ", &*version, wanted].concat();
    // the copy of the requirements is written last: an environment without it is incomplete
    let marker = folder.join("requirements.txt");
    if fs::read(&marker).is_ok_and(|made| made == wanted) && interpreter.exists() {
        return Ok(interpreter);
    }
    let _ = fs::remove_dir_all(&folder);
    succeed(Command::new(INSTALLED).args(["-m", "venv"]).args(options).arg(&folder), hint)?;
    if install(&interpreter)? {
        fs::write(&marker, wanted).expect("the target folder can be written to");
    }
    Ok(interpreter)
}

/// The installer of the environment of `common`, for that of `interpreter`.
fn pip(common: &Path, interpreter: &Path) -> Command {
    let mut command = Command::new(common);
    command.args(["-m", "pip", "--python"]).arg(interpreter).arg("install");
    // modules are compiled when a test imports them; most never are
    command.args(["--quiet", "--disable-pip-version-check", "--no-compile"]);
    command
}

/// Installs all of `file`, or each of its lines that can be installed, with the installer of `common`. Returns whether all could.
fn install_what_can_be(common: &Path, interpreter: &Path, file: &Path) -> bool {
    let installs = |command: &mut Command| command.output().is_ok_and(|output| output.status.success());
    // nothing is compiled here
    let ready = || {
        let mut command = pip(common, interpreter);
        command.args(["--only-binary", ":all:"]);
        command
    };
    if installs(ready().arg("-r").arg(file)) {
        return true;
    }
    let lines = fs::read_to_string(file).expect("a file that was read before");
    for line in lines.lines().filter(|line| !line.starts_with('#') && !line.is_empty()) {
        if !installs(ready().arg("--no-deps").arg(line)) {
            // past the harness, which hides the output of a test that passes
            let _ = writeln!(std::io::stderr(), "NOT INSTALLED: {line}");
        }
    }
    false
}

/// Runs `command`; if it fails, the test fails with `hint` and the output of the command.
fn run(command: &mut Command, hint: &str) -> Output {
    succeed(command, hint).unwrap_or_else(|reason| panic!("{reason}"))
}

/// Runs `command`.
///
/// # Errors
/// `hint` and the output of the command.
fn succeed(command: &mut Command, hint: &str) -> Result<Output, String> {
    let output = command.output().map_err(|error| format!("{command:?} can't be started ({error}): {hint}"))?;
    if output.status.success() {
        return Ok(output);
    }
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    Err(format!("{command:?} failed: {hint}\n{out}{err}"))
}
