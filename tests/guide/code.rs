//! The code in README and guide runs, page by page from top to bottom, each page in its own folder.
//!
//! - `toml` blocks are scenes, or parts of one: `brinell predict` reads them. "Save this as `x.toml`" writes a file for what follows.
//! - `sh` and `python` blocks run in the folder with the files of earlier blocks.
//! - A `text` block after the comment `<!-- output -->` is the complete output of the block before it; after `<!-- check -->`,
//!   it is a part of it.
//! - `<!-- not run: why -->` before a block excludes it.
//! - `rust` blocks are tests of the documentation; see the end of crates/contact/src/lib.rs.

use crate::markdown::{Block, Page};
use crate::{is_writing, pages, parallel, python, read, root, skips};
use brinell_testing::{prebuilt, schema};
use std::convert::Infallible;
use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// Packages of engines that a block may import.
const ENGINES: [&str; 3] = ["mujoco", "exudyn", "pydrake"];

/// Pages whose code is not run, because it is about internals.
const NOT_RUN: [&str; 4] = ["CONTRIBUTING.md", "DESIGN.md", "CHANGELOG.md", "data/truth/README.md"];

/// A page in a folder of its own.
struct Run {
    page: PathBuf,
    folder: TempDir,
    /// The output of the last block.
    printed: String,
    mistakes: Vec<String>,
    /// Outputs that have changed, with their new text.
    changes: Vec<(std::ops::Range<usize>, String)>,
}

impl Run {
    fn new(page: &Path) -> Run {
        let folder = tempfile::tempdir().expect("a folder for a page");
        for name in ["scenes", "examples"] {
            fs::create_dir(folder.path().join(name)).expect("an empty folder");
            for entry in fs::read_dir(root().join(name)).expect("the repository has it").map(Result::unwrap) {
                if entry.path().is_file() {
                    fs::copy(entry.path(), folder.path().join(name).join(entry.file_name())).expect("room for a file");
                }
            }
        }
        Run { page: page.into(), folder, printed: String::new(), mistakes: Vec::new(), changes: Vec::new() }
    }

    fn run(&mut self, block: &Block) {
        let place = format!("{} ```{}", self.page.display(), block.language);
        if let Some(why) = block.comment.as_deref().and_then(|comment| comment.strip_prefix("not run:")) {
            self.printed.clear();
            return println!("{place}: not run:{why}");
        }
        match (block.language.as_str(), block.comment.as_deref()) {
            ("toml", _) => self.scene(block),
            ("sh", _) => self.shell(&block.text),
            ("python", _) => self.python(&block.text),
            ("text", Some("output")) if block.text.trim() != self.printed.trim() => {
                self.changes.push((block.range.clone(), self.printed.trim().to_string()));
            }
            ("text", Some("check")) if !self.printed.contains(block.text.trim_end()) => {
                self.mistakes.push(format!("{place} isn't in what is printed:\n{}", self.printed));
            }
            ("text" | "rust", _) => {}
            (other, _) => self.mistakes.push(format!("{place}: nobody knows how to run {other:?}")),
        }
    }

    /// A scene. Name and bodies may be missing if only another part is shown.
    fn scene(&mut self, block: &Block) {
        let mut text = block.text.clone();
        if let Some(file) = &block.file {
            fs::write(self.folder.path().join(file), &text).expect("room for a scene");
        } else {
            let missing =
                |key: &str, text: &str| toml::from_str::<toml::Table>(text).is_ok_and(|it| !it.contains_key(key));
            if missing("name", &text) {
                text = format!("name = \"part\"\n{text}");
            }
            if missing("impactor", &text) && missing("target", &text) {
                text += "\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n";
            }
        }
        let found = schema::mistakes(&text);
        if found.as_ref().is_none_or(|found| !found.is_empty()) {
            self.mistakes.push(format!("{}: the schema says {found:?} of\n{text}", self.page.display()));
        }
        let path = self.folder.path().join("part_of_a_scene.toml");
        fs::write(&path, text).expect("room for a scene");
        let mut program = Command::new(env!("CARGO_BIN_EXE_brinell"));
        program.arg("predict").arg(&path);
        self.call(program);
        // it would be another scene beside the one that the page saves
        fs::remove_file(&path).expect("it was written");
    }

    fn shell(&mut self, text: &str) {
        match text.trim() {
            // the program that cargo has built for the tests, and the tests themselves
            "cargo run --release" | "cargo run --release\ncargo test --release" => {
                self.call(Command::new(env!("CARGO_BIN_EXE_brinell")))
            }
            text => {
                let mut bash = Command::new("bash");
                bash.args(["-euo", "pipefail", "-c", text]);
                self.call(bash);
            }
        }
    }

    fn python(&mut self, text: &str) {
        let engine = ENGINES.iter().find(|engine| text.contains(&format!("import {engine}")));
        let interpreter = if engine.is_some() { python::engines(false) } else { python::python() };
        if let Some(engine) = engine {
            let output = Command::new(&interpreter).args(["-c", &format!("import {engine}")]).output();
            if !output.is_ok_and(|output| output.status.success()) {
                let why = format!("{engine} can't be installed here");
                return skips::skipped(&self.page.display().to_string(), &why);
            }
        }
        let mut command = Command::new(interpreter);
        command.args(["-c", text]);
        self.call(command);
    }

    /// Runs `command` in the folder of the page, with the program and the Python module available.
    fn call(&mut self, mut command: Command) {
        let program = Path::new(env!("CARGO_BIN_EXE_brinell"));
        let mut path = vec![program.parent().unwrap().to_path_buf(), python::python().parent().unwrap().to_path_buf()];
        path.extend(env::split_paths(&prebuilt::path_without_rust()));
        let path: OsString = env::join_paths(path).expect("folders without colons");
        prebuilt::finding_no_compiler(python::keeping_modules(&mut command))
            .current_dir(self.folder.path())
            .env("PATH", path)
            .env("PYTHONPATH", root().join("python"))
            .env("BRINELL", program)
            .env("MPLBACKEND", "Agg");
        let output = command.output().unwrap_or_else(|error| panic!("{command:?} can't be started: {error}"));
        self.printed = String::from_utf8_lossy(&output.stdout).into_owned();
        if !output.status.success() {
            let told = String::from_utf8_lossy(&output.stderr);
            self.mistakes.push(format!("{}: {command:?} failed:\n{}{told}", self.page.display(), self.printed));
        }
    }

    /// Writes the outputs to the page, or reports those that differ.
    fn finish(mut self) -> Vec<String> {
        if is_writing() && !self.changes.is_empty() {
            let mut text = read(&self.page);
            // from the end, so that earlier positions remain valid
            for (range, output) in self.changes.into_iter().rev() {
                text.replace_range(range, &format!("```text\n{output}\n```"));
            }
            fs::write(root().join(&self.page), text).expect("the page can be written");
        } else {
            let wrong = |(_, output)| format!("{}: BRINELL_WRITE=1 would write\n{output}", self.page.display());
            self.mistakes.extend(self.changes.into_iter().map(wrong));
        }
        self.mistakes
    }
}

#[test]
fn the_code_runs_and_prints_what_is_shown() {
    let mut pages = pages();
    pages.retain(|page| !NOT_RUN.iter().any(|name| page == Path::new(name)));
    // a missing environment is created once, before other threads wait for it
    python::python();
    let mistakes_of = |page: &PathBuf| {
        let blocks = Page::parse(&read(page)).blocks;
        let mut run = Run::new(page);
        blocks.iter().for_each(|block| run.run(block));
        Ok::<_, Infallible>(run.finish())
    };
    let Ok(mistakes) = parallel::each(&pages, mistakes_of);
    let mistakes = mistakes.concat();
    assert!(mistakes.is_empty(), "{}", mistakes.join("\n\n"));
}
