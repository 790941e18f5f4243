//! `brinell report`, quickly: the page stands alone, and its numbers are those of the theory.

#[path = "support/command.rs"]
mod command;

use command::{contents, empty_folder, run, scene};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;
use tempfile::TempDir;

/// The quick report of a scene: its folder, and its data.
fn report(name: &str) -> (TempDir, Value) {
    let folder = empty_folder();
    let scene = scene(name).display().to_string();
    run(folder.path(), ["report", &scene, "--quick", "-o", "report"]).with_status(0);
    let text = fs::read_to_string(folder.path().join("report/report.json")).expect("the data stand beside the page");
    let data = serde_json::from_str(&text).expect("JSON");
    (folder, data)
}

/// That of the default scene, made once.
static DEFAULT: LazyLock<(TempDir, Value)> = LazyLock::new(|| report("steel_ball"));

fn rows<'a>(data: &'a Value, table: &str) -> &'a [Value] {
    data[table].as_array().unwrap_or_else(|| panic!("no table {table}"))
}

#[track_caller]
fn row<'a>(data: &'a Value, table: &str, way: &str) -> &'a Value {
    rows(data, table).iter().find(|row| row["way"] == way).unwrap_or_else(|| panic!("no way {way} in {table}"))
}

#[test]
fn fitted_orders_are_those_of_the_methods() {
    for (way, order) in [("late force", 1.0), ("predicted_force", 2.0), ("leap-frog", 2.0), ("input derivatives", 3.0)]
    {
        let fitted = row(&DEFAULT.1, "orders", way)["order"].as_f64().expect("a fitted order");
        assert!((fitted - order).abs() < 0.3, "{way}: order {fitted} instead of {order}");
    }
}

#[test]
fn a_unit_that_knows_the_mass_is_right_to_rounding_at_every_step() {
    let known = rows(&DEFAULT.1, "precision").iter().filter(|row| row["way"] == "mass known");
    let errors: Vec<f64> = known.map(|row| row["error_of_restitution"].as_f64().expect("an error")).collect();
    assert_eq!(errors.len(), 8, "2 to 256 steps per contact");
    assert!(errors.iter().all(|error| *error < 1e-11), "{errors:?}");
}

#[test]
fn the_stable_limit_of_an_elastic_scene_is_that_of_theory() {
    let (_folder, data) = report("elastic");
    let limit = data["use"]["stable_leap_frog"].as_f64().expect("a limit");
    assert!((limit / 2.0 - 1.0).abs() < 0.05, "h sqrt(K/m) = {limit} instead of 2");
    assert!(data["use"]["stable_late"].is_null(), "a late force is stable at no step: {}", data["use"]);
    let verdicts = rows(&data, "extremes").iter().map(|row| row["verdict"].as_str().expect("a verdict"));
    let wrong: Vec<_> = verdicts.filter(|verdict| *verdict != "right").collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn all_extreme_cases_are_judged_and_none_has_failed() {
    let cases = rows(&DEFAULT.1, "extremes");
    assert!(cases.len() >= 50, "some dozens of cases, not {}", cases.len());
    for case in cases {
        assert_eq!(case["verdict"], "right", "{case}");
        for error in ["error_of_force", "error_of_energy"] {
            let (error, tolerance) = (case[error].as_f64(), case["tolerance"].as_f64());
            assert!(error.is_some() && error <= tolerance, "{case}");
        }
        let wide = case["a/R"].as_f64().expect("a width") > 0.3;
        assert_eq!(wide, case["warning"] != "", "{case}");
    }
}

#[test]
fn the_page_needs_nothing_else_and_its_data_stand_beside_it() {
    let folder = DEFAULT.0.path().join("report");
    let page = fs::read_to_string(folder.join("index.html")).expect("a page");
    assert!(page.ends_with("</html>\n"), "the page is whole");
    for outside in ["<script", "<link", "<img", "@import", "src=", "url("] {
        assert!(!page.contains(outside), "the page has {outside}");
    }
    // an address of the web is the name of the vector format, nothing that is loaded
    let addresses = page.matches("http").count();
    assert_eq!(addresses, page.matches("xmlns=\"http://www.w3.org/2000/svg\"").count());
    let expected = [
        "error-against-calls.svg",
        "error-against-time.svg",
        "extremes.csv",
        "force-against-steps.svg",
        "index.html",
        "laws.csv",
        "laws.svg",
        "limits.csv",
        "orders.csv",
        "precision.csv",
        "report.json",
        "stability.csv",
        "stability.svg",
    ];
    assert_eq!(contents(&folder), expected);
    for file in expected {
        assert!(page.contains(file) || file == "index.html", "the page names {file}");
    }
}

#[test]
fn csv_and_json_have_the_same_rows() {
    let (folder, data) = &*DEFAULT;
    for table in ["precision", "orders", "limits", "stability", "extremes", "laws"] {
        let path = Path::new("report").join(table).with_extension("csv");
        let csv = fs::read_to_string(folder.path().join(path)).expect("a table");
        assert_eq!(csv.lines().count(), rows(data, table).len() + 1, "{table}");
    }
}

#[test]
fn a_scene_with_several_contacts_or_a_rate_dependent_law_has_a_report_too() {
    let (_folder, data) = report("two_contacts");
    assert!(data["summary"].to_string().contains("first contact"), "{}", data["summary"]);
    let (_folder, data) = report("damped");
    assert!(rows(&data, "orders").iter().all(|row| row["way"] != "mass known"), "{}", data["orders"]);
}
