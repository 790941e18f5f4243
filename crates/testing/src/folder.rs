//! A folder in which the program is called by lines, as a user types them, and what is in its answers.

use crate::command::{Run, contents, empty_folder, run, scene};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

pub struct Folder(TempDir);

impl Folder {
    /// One with these files, whose names may have folders.
    pub fn with(files: &[(&str, &str)]) -> Folder {
        let folder = Folder(empty_folder());
        files.iter().for_each(|(name, text)| folder.write(name, text));
        folder
    }

    /// One with this text as `scene.toml`.
    pub fn of(text: &str) -> Folder {
        Folder::with(&[("scene.toml", text)])
    }

    /// One with a scene of the project as `scene.toml`.
    pub fn of_scene(name: &str) -> Folder {
        Folder::of(&fs::read_to_string(scene(name)).expect("a scene of the project"))
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }

    pub fn at(&self, name: &str) -> PathBuf {
        self.path().join(name)
    }

    pub fn write(&self, name: &str, text: &str) {
        let path = self.at(name);
        fs::create_dir_all(path.parent().expect("a file has a folder")).expect("a folder for temporary files");
        fs::write(path, text).expect("a folder for temporary files");
    }

    #[track_caller]
    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.at(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Its files, also those that the program has written.
    pub fn names(&self) -> Vec<String> {
        contents(self.path())
    }

    /// Calls the program.
    #[track_caller]
    pub fn call(&self, line: &str) -> Run {
        run(self.path(), arguments(line))
    }

    /// Its answer in JSON.
    #[track_caller]
    pub fn json(&self, line: &str) -> Value {
        self.call(&format!("{line} --json")).with_status(0).json()
    }

    /// What it prints, with single blanks.
    #[track_caller]
    pub fn words(&self, line: &str) -> String {
        let Run { out, err, .. } = self.call(line).with_status(0);
        words(&format!("{out} {err}"))
    }
}

/// The arguments in a line, of which those with spaces are in quotes.
pub fn arguments(line: &str) -> Vec<&str> {
    let parts = line.split('"').enumerate();
    parts
        .flat_map(|(place, part)| if place % 2 == 1 { vec![part] } else { part.split_whitespace().collect() })
        .collect()
}

/// `text` with single blanks between its words.
pub fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What is in an answer at a path, such as `laws/0/dent`.
#[track_caller]
pub fn at<'a>(answer: &'a Value, path: &str) -> &'a Value {
    answer.pointer(&format!("/{path}")).unwrap_or_else(|| panic!("no {path} in {answer}"))
}

/// The number at a path of an answer.
#[track_caller]
pub fn number(answer: &Value, path: &str) -> f64 {
    at(answer, path).as_f64().unwrap_or_else(|| panic!("{path} is no number in {answer}"))
}

/// The numbers at a path of an answer.
#[track_caller]
pub fn numbers(answer: &Value, path: &str) -> Vec<f64> {
    let all = at(answer, path).as_array().unwrap_or_else(|| panic!("{path} is no list in {answer}"));
    all.iter().map(|value| value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))).collect()
}

/// The numbers of a table in CSV, in the column of this name.
#[track_caller]
pub fn column(table: &str, name: &str) -> Vec<f64> {
    let place = table.lines().next().and_then(|head| head.split(',').position(|column| column == name));
    let place = place.unwrap_or_else(|| panic!("no {name} in {table}"));
    table.lines().skip(1).map(|line| line.split(',').nth(place).unwrap().parse().unwrap()).collect()
}

/// Two numbers differ by less than this part.
#[track_caller]
pub fn close(got: f64, expected: f64, tolerance: f64) {
    assert!((got / expected - 1.0).abs() < tolerance, "{got} instead of {expected}");
}
