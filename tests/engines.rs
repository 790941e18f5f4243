//! Examples with multibody engines, and studies: each example judges itself. What needs a package that can't be installed
//! here is skipped, and says so.

#[path = "support/python.rs"]
mod python;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The interpreter of the engines with the module of the project and the program.
fn interpreter() -> Command {
    let mut command = Command::new(python::engines());
    command
        .env("PYTHONPATH", root().join("python"))
        .env("BRINELL", env!("CARGO_BIN_EXE_brinell"))
        .env("BRINELL_CACHE", Path::new(env!("CARGO_TARGET_TMPDIR")).join("cache"))
        // nothing is left behind in the source tree
        .env("PYTHONDONTWRITEBYTECODE", "1");
    command
}

fn text(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

/// Past the harness, which keeps what a test prints unless it fails.
fn tell(what: &str) {
    writeln!(std::io::stderr(), "{what}").expect("somebody reads");
}

/// Whether these packages are there; if not, says what is skipped.
fn have(packages: &[&str], skipped: &str) -> bool {
    let missing: Vec<_> = packages
        .iter()
        .filter(|package| {
            let output = interpreter().args(["-c", &format!("import {package}")]).output();
            !output.expect("the environment has an interpreter").status.success()
        })
        .collect();
    if !missing.is_empty() {
        tell(&format!("NOT RUN: {skipped}, since {missing:?} can't be installed here"));
    }
    missing.is_empty()
}

/// Runs examples/`name`.py, which ends with an error if something isn't right, and looks at its picture.
fn example(name: &str, packages: &[&str]) {
    if !have(packages, name) {
        return;
    }
    let picture = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.svg"));
    let _ = std::fs::remove_file(&picture);
    let script: PathBuf = root().join("examples").join(format!("{name}.py"));
    let output = interpreter().arg(script).arg(&picture).output().expect("the environment has an interpreter");
    let text = text(&output);
    assert!(output.status.success(), "{name} failed:\n{text}");
    assert!(text.contains("balance of energy"), "{name} doesn't judge itself:\n{text}");
    let drawn = std::fs::read_to_string(&picture).unwrap_or_else(|error| panic!("{}: {error}", picture.display()));
    assert!(drawn.contains("</svg>"), "{name} draws no picture");
    println!("{name}:\n{text}");
}

#[test]
fn a_ball_bounces_to_rest_in_mujoco() {
    example("mujoco_ball", &["mujoco"]);
}

#[test]
fn an_arm_hits_a_stop_in_mujoco() {
    example("mujoco_arm", &["mujoco"]);
}

#[test]
fn a_ball_bounces_to_rest_in_exudyn() {
    example("exudyn_ball", &["exudyn"]);
}

#[test]
fn a_ball_bounces_to_rest_in_drake() {
    example("drake_ball", &["pydrake.all"]);
}

#[test]
fn a_hammer_pendulum_rebounds() {
    example("pendulum", &[]);
}

#[test]
fn a_ball_flies_through_a_box() {
    example("ball_in_box", &[]);
}

#[test]
fn the_module_installs_by_pip() {
    if !have(&["setuptools"], "the installation of the module") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder for the installation");
    let [source, site] = ["source", "site"].map(|name| folder.path().join(name));
    // a build leaves its traces in the folder that it builds
    copy(&root().join("python"), &source);
    let output = interpreter()
        .args(["-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation", "--target"])
        .args([&site, &source])
        .output()
        .expect("the environment has an interpreter");
    assert!(output.status.success(), "{}", text(&output));
    let output = interpreter()
        .env("PYTHONPATH", &site)
        .current_dir(folder.path())
        .args(["-c", "import brinell, brinell.studies.study; print(brinell.__file__)"])
        .output()
        .expect("the environment has an interpreter");
    assert!(output.status.success(), "{}", text(&output));
    assert!(text(&output).contains("site"), "the installed module is used: {}", text(&output));
    assert!(site.join("brinell/py.typed").is_file(), "the module says that it is typed");
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("a folder that can be written to");
    for entry in std::fs::read_dir(from).expect("a readable folder") {
        let (path, name) = entry.map(|entry| (entry.path(), entry.file_name())).expect("a readable folder");
        if path.is_dir() {
            copy(&path, &to.join(name));
        } else {
            std::fs::copy(&path, to.join(name)).expect("a file that can be read");
        }
    }
}

#[test]
fn studies_are_run_whole_and_resumed() {
    if !have(&["scipy", "pyarrow", "tqdm", "matplotlib"], "studies") {
        return;
    }
    let output = interpreter()
        .args(["-m", "pytest", "-q", "--tb=short", "-p", "no:cacheprovider", "test_study.py"])
        .current_dir(root().join("tests/python"))
        .env("BRINELL_TEST_SCENES", root().join("scenes"))
        .output()
        .expect("the environment has an interpreter");
    assert!(output.status.success(), "{}", text(&output));
    println!("{}", text(&output));
}
