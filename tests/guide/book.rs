//! The book, built by a pinned version of mdBook, which the first run compiles into the target folder. That takes as long as a
//! tenth of all tests, so it is not part of a usual run.

use crate::python::target_folder;
use crate::root;
use std::env;
use std::fs::{self, File};
use std::path::PathBuf;
use std::process::Command;

const VERSION: &str = "0.5.4";

/// Runs `command` to its end.
fn succeed(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?} can't be started: {error}"));
    let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?} failed:\n{text}");
    text.into_owned()
}

/// The program mdbook.
fn mdbook() -> PathBuf {
    let folder = target_folder().join("tools").join(format!("mdbook-{VERSION}"));
    let program = folder.join("bin").join(format!("mdbook{}", env::consts::EXE_SUFFIX));
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    // two runs of the tests must not build it at the same time
    let lock = File::create(folder.join("lock")).expect("the target folder can be written to");
    lock.lock().expect("the target folder is on a file system with locks");
    if !program.exists() {
        let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo.args(["install", "mdbook", "--version", VERSION, "--locked", "--no-default-features", "--root"]);
        cargo.arg(&folder).arg("--target-dir").arg(folder.join("build"));
        // without optimization and debug information it compiles in less than a minute
        succeed(cargo.args(["--profile", "dev"]).env("CARGO_PROFILE_DEV_DEBUG", "0"));
        // only the program is needed
        let _ = fs::remove_dir_all(folder.join("build"));
    }
    program
}

#[test]
#[ignore = "compiles mdBook: cargo test --release --test guide -- --ignored"]
fn the_book_builds_without_a_warning() {
    let book = tempfile::tempdir().expect("a folder for the book");
    let text = succeed(Command::new(mdbook()).arg("build").arg(root().join("docs")).arg("--dest-dir").arg(book.path()));
    let complaints: Vec<_> = text.lines().filter(|line| line.contains("WARN") || line.contains("ERROR")).collect();
    // this mdBook is built without the search
    let complaints: Vec<_> = complaints.into_iter().filter(|line| !line.contains("without search support")).collect();
    assert!(complaints.is_empty(), "{text}");
    for page in ["guide/introduction.html", "guide/tools/fmpy.html", "report/index.html", "laws.svg"] {
        assert!(book.path().join(page).is_file(), "the book has no {page}:\n{text}");
    }
}
