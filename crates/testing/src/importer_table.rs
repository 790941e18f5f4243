//! The table of importers: the results of their drivers, compared with the right ones.

use serde_json::Value;
use std::fmt::Write as _;
use std::fs;
use std::io::{Write as _, stderr};
use std::path::Path;
use std::process::Command;

/// Largest error of the force, over the largest force.
const AGREEMENT: f64 = 1e-12;
/// Largest relative error of the restitution.
const RESTITUTION: f64 = 1e-9;

/// The results of one tool with one method.
#[derive(Debug, Default)]
pub struct Row {
    pub name: String,
    pub version: String,
    pub order: String,
    /// Largest difference between the force and that of the C interface, over the largest force.
    pub agreement: Option<f64>,
    /// Relative error of the restitution at each step size of the ball.
    pub errors: Vec<f64>,
    /// Largest error of the speed of the ball under gravity, over the restitution.
    pub heavy: Option<f64>,
    /// Steps per second of the history, or of the ball if there is none.
    pub steps_per_second: Option<f64>,
    /// Whether the user of the tool reads the warning about the wrong order of execution, at each step size of the ball.
    pub told: Vec<bool>,
    /// The reason why there are no other results.
    pub failure: Option<String>,
}

impl Row {
    pub fn named(name: &str, version: &str, order: &str) -> Row {
        Row { name: name.into(), version: version.into(), order: order.into(), ..Row::default() }
    }

    /// A description of what is wrong.
    fn wrong(&self) -> Option<String> {
        let told = |what: String| Some(format!("{}: {what}", self.name));
        if let Some(failure) = &self.failure {
            return told(failure.clone());
        }
        if let Some(agreement) = self.agreement.filter(|agreement| agreement.is_nan() || *agreement > AGREEMENT) {
            return told(format!("forces differ by {agreement:e} of the largest"));
        }
        if let Some(error) = self.heavy.filter(|error| error.is_nan() || *error > RESTITUTION) {
            return told(format!("with gravity the speed is off by {error:e} of the restitution"));
        }
        let error = self.errors.iter().find(|error| error.is_nan() || error.abs() > RESTITUTION)?;
        told(format!("restitution is off by {error:e}"))
    }
}

/// The largest difference of two force histories, over the largest force; infinite if their lengths differ.
pub fn difference(found: &[f64], forces: &[f64]) -> f64 {
    if found.len() != forces.len() {
        return f64::INFINITY;
    }
    let largest = forces.iter().copied().fold(0.0, f64::max);
    // NaN must not be ignored
    let differences = found.iter().zip(forces).map(|(found, force)| (found - force).abs());
    differences.fold(0.0, |sum: f64, next| if next <= sum { sum } else { next }) / largest
}

/// A row for each way in the result of a driver; `speeds` are those of the heavy ball in the end.
pub fn rows<'a>(
    result: &'a Value,
    forces: &'a [f64],
    restitution: f64,
    speeds: &'a [f64],
) -> impl Iterator<Item = Row> + 'a {
    let version = result["version"].as_str().unwrap_or_default();
    let ways = result["ways"].as_array().map(Vec::as_slice).unwrap_or_default();
    ways.iter().map(move |way| {
        let text = |key: &str| way[key].as_str().unwrap_or_default();
        let mut row = Row::named(text("name"), version, text("order"));
        let list = |key: &str| way[key].as_array().map(Vec::as_slice).unwrap_or_default();
        let (history, ball, heavy) = (&way["history"], list("ball"), list("heavy"));
        row.failure = [history]
            .into_iter()
            .chain(ball)
            .chain(heavy)
            .find_map(|answer| answer["error"].as_str())
            .map(String::from);
        if row.failure.is_some() {
            return row;
        }
        if let Some(found) = history["value"].as_array() {
            let found: Vec<_> = found.iter().map(|force| force.as_f64().unwrap_or(f64::NAN)).collect();
            row.agreement = Some(difference(&found, forces));
        }
        row.told = ball.iter().map(|at| at["told"] == true).collect();
        row.errors = ball.iter().map(|at| -at["value"].as_f64().unwrap_or(f64::NAN) / restitution - 1.0).collect();
        let error =
            |(at, speed): (&Value, &f64)| (at["value"].as_f64().unwrap_or(f64::NAN) - speed).abs() / restitution;
        // NaN must not be passed over
        row.heavy = heavy.iter().zip(speeds).map(error).reduce(|worst, next| if next <= worst { worst } else { next });
        let speed = |answer: &Value| answer["steps_per_second"].as_f64();
        row.steps_per_second = speed(history).or_else(|| ball.first().and_then(speed));
        row
    })
}

#[derive(Default)]
pub struct Table {
    pub rows: Vec<Row>,
    /// Tools that did not run, and the reason.
    pub not_run: Vec<(String, String)>,
}

impl Table {
    pub fn wrong(&self) -> Vec<String> {
        self.rows.iter().filter_map(Row::wrong).collect()
    }

    fn markdown(&self) -> String {
        let mut text = String::from(
            "| importer | version | order | difference of force | restitution at 1 us | 100 us | 2 ms | with gravity | steps/s | \
             wrong order |\n|---|---|---|---|---|---|---|---|---|---|\n",
        );
        for row in &self.rows {
            let agreement = row.agreement.map_or_else(|| "-".into(), number);
            let mut errors = [const { String::new() }; 3].map(|_| "-".to_string());
            for (place, error) in errors.iter_mut().zip(&row.errors) {
                *place = number(error.abs());
            }
            let speed = row.steps_per_second.map_or_else(|| "-".into(), |speed| format!("{speed:.1e}"));
            let told = match &*row.told {
                [] => "-",
                told if told.contains(&true) => "shown",
                _ => "not shown",
            };
            let cells = match &row.failure {
                Some(failure) => format!("{failure} | | | | | | "),
                None => {
                    let heavy = row.heavy.map_or_else(|| "-".into(), number);
                    format!("{agreement} | {} | {heavy} | {speed} | {told}", errors.join(" | "))
                }
            };
            let _ = writeln!(text, "| {} | {} | {} | {cells} |", row.name, row.version, row.order);
        }
        text.push_str("\n| not run | why |\n|---|---|\n");
        for (tool, reason) in &self.not_run {
            let _ = writeln!(text, "| {tool} | {reason} |");
        }
        text
    }

    /// Prints where the output of a passing test is also visible.
    pub fn print(&self) {
        let _ = stderr().write_all(format!("\n{}\n", self.markdown()).as_bytes());
    }

    /// Writes the page of the documentation.
    pub fn write(&self, path: &Path) {
        let date = Command::new("date").arg("+%F").output().expect("every Linux has date");
        let date = String::from_utf8_lossy(&date.stdout).trim().to_string();
        let text =
            format!("{}Measured on {date}:\n\n{}", include_str!("../../../tests/importers/about.md"), self.markdown());
        fs::write(path, text).expect("the folder of the documentation can be written to");
    }
}

fn number(value: f64) -> String {
    if value == 0.0 { "0".into() } else { format!("{value:.0e}") }
}
