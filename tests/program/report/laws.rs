//! The laws in a report, beside each other.

use super::{DEFAULT, rows};
use crate::command::{empty_folder, run, scene};
use serde_json::Value;

/// The name of a loading law, without its unloading law.
fn name(row: &Value) -> &str {
    row["law"].as_str().expect("a name").split('/').next().expect("there is always a first part")
}

#[test]
fn the_spread_has_the_extremes_of_the_laws() {
    let scene = scene("steel_ball").display().to_string();
    let predicted = run(empty_folder().path(), ["predict", &scene, "--laws", "all", "--json"]).with_status(0).json();
    let laws: Vec<_> = rows(&predicted, "laws").iter().filter(|row| row["law"] != "hertz").collect();
    for row in rows(&DEFAULT.1, "spread") {
        let value = |law: &Value| {
            let number = |key: &str| law[key].as_f64().expect("a number");
            match row["quantity"].as_str().expect("a name") {
                "contact time" => number("loading_time") + number("unloading_time"),
                other => number(&other.replace(' ', "_")),
            }
        };
        let values = || laws.iter().map(|law| value(law));
        // both numbers have been written and read
        let is = |key: &str, expected: f64| (row[key].as_f64().expect("a number") / expected - 1.0).abs() < 1e-14;
        assert!(is("lowest", values().fold(f64::INFINITY, f64::min)), "{row}");
        assert!(is("highest", values().fold(f64::NEG_INFINITY, f64::max)), "{row}");
        for (by, extreme) in [("lowest_by", "lowest"), ("highest_by", "highest")] {
            let law = laws.iter().find(|law| row[by] == name(law)).expect("a law of the table");
            assert!(is(extreme, value(law)), "{row}");
        }
    }
    assert_eq!(rows(&DEFAULT.1, "spread").len(), 4);
}
