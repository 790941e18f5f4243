//! The table of platforms in docs/platforms.md.

use serde_json::Value;
use std::fmt::Write as _;
use std::io::{Write as _, stderr};
use std::path::Path;
use std::process::Command;
use std::{fs, iter};

/// What was run on a system.
pub struct Row {
    pub platform: &'static str,
    pub tested_by: String,
    /// Of units, and of laws.
    pub results: [Result<String, String>; 2],
}

#[derive(Default)]
pub struct Table {
    pub rows: Vec<Row>,
    /// What could not be run, and why.
    not_run: Vec<(String, String)>,
    /// What the program says of the libraries of the default scene.
    libraries: Value,
    /// Size of its unit for all platforms [bytes].
    size: usize,
}

impl Table {
    pub fn of(libraries: &Value, size: usize) -> Table {
        Table { libraries: libraries.clone(), size, ..Table::default() }
    }

    pub fn missing(&mut self, what: &str, why: &str) {
        self.not_run.push((what.into(), why.into()));
    }

    pub fn is_complete(&self) -> bool {
        self.not_run.is_empty()
    }

    pub fn wrong(&self) -> Vec<String> {
        let failures = |row: &Row| {
            let why = row.results.iter().filter_map(|result| result.as_ref().err());
            why.map(|why| format!("{} by {}: {why}", row.platform, row.tested_by)).collect::<Vec<_>>()
        };
        self.rows.iter().flat_map(failures).collect()
    }

    /// What the libraries are, and what they take from the system.
    fn libraries(&self) -> String {
        let mut text =
            String::from("| platform | library of the default scene | takes from the system |\n|---|---|---|\n");
        for (platform, library) in self.libraries.as_object().into_iter().flatten() {
            let names = library["imports"].as_array().map(Vec::as_slice).unwrap_or_default();
            let names: Vec<_> = names.iter().filter_map(Value::as_str).map(|name| format!("`{name}`")).collect();
            let _ = writeln!(text, "| `{platform}` | {} bytes | {} |", library["size"], names.join(", "));
        }
        let _ = writeln!(text, "\nThe FMU with all of them has {} bytes.", self.size);
        text
    }

    fn runs(&self) -> String {
        let mut text = String::from("| platform | tested by | FMUs | laws |\n|---|---|---|---|\n");
        for Row { platform, tested_by, results } in &self.rows {
            let [units, laws] = results.each_ref().map(|result| result.as_ref().unwrap_or_else(|why| why));
            let _ = writeln!(text, "| `{platform}` | {tested_by} | {units} | {laws} |");
        }
        for (what, why) in &self.not_run {
            let _ = writeln!(text, "| {what} | not run: {why} | - | - |");
        }
        text
    }

    /// To where also a test that passes shows it.
    pub fn print(&self) {
        let _ = stderr().write_all(format!("\n{}\n{}\n", self.libraries(), self.runs()).as_bytes());
    }

    /// Writes the page of the documentation; the other platforms were compiled by this `compiler`.
    pub fn write(&self, compiler: &str) {
        let date = Command::new("date").arg("+%F").output().expect("every Linux has date");
        let date = String::from_utf8_lossy(&date.stdout).trim().to_string();
        let about = include_str!("../platforms/about.md");
        let measured = format!("Measured on {date}. The compiler for other platforms was {}.\n", compiler.trim());
        let parts: Vec<_> = iter::once(about.to_string()).chain([measured, self.libraries(), self.runs()]).collect();
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/platforms.md");
        fs::write(path, parts.join("\n")).expect("the folder of the documentation can be written to");
    }
}
