//! `brinell report` in quick mode: the page is self-contained, and its numbers agree with theory.

mod coupling;
mod extremes;

use crate::command::{contents, empty_folder, run, scene};
use brinell_testing::long;
use serde_json::Value;
use std::fs;
use std::sync::LazyLock;
use tempfile::TempDir;

/// The quick report of a scene: its folder and its data.
fn report(name: &str) -> (TempDir, Value) {
    let folder = empty_folder();
    let scene = scene(name).display().to_string();
    run(folder.path(), ["report", &scene, "--quick", "-o", "report"]).with_status(0);
    let text = fs::read_to_string(folder.path().join("report/report.json")).expect("the data stand beside the page");
    let data = serde_json::from_str(&text).expect("JSON");
    (folder, data)
}

/// The report of the default scene, made once.
static DEFAULT: LazyLock<(TempDir, Value)> = LazyLock::new(|| report("steel_ball"));

fn rows<'a>(data: &'a Value, table: &str) -> &'a [Value] {
    data[table].as_array().unwrap_or_else(|| panic!("no table {table}"))
}

#[track_caller]
fn row<'a>(data: &'a Value, table: &str, way: &str) -> &'a Value {
    rows(data, table).iter().find(|row| row["way"] == way).unwrap_or_else(|| panic!("no way {way} in {table}"))
}

/// The data of the elastic scene, made once.
static ELASTIC: LazyLock<Value> = LazyLock::new(|| report("elastic").1);

#[test]
fn the_page_is_self_contained_with_its_data_beside_it() {
    let folder = DEFAULT.0.path().join("report");
    let page = fs::read_to_string(folder.join("index.html")).expect("a page");
    assert!(page.ends_with("</html>\n"), "the page is whole");
    for outside in ["<link", "<img", "@import", "src=", "url(", "fetch(", "import(", "XMLHttpRequest"] {
        assert!(!page.contains(outside), "the page has {outside}");
    }
    // the only web address is the name of the vector format, which is not loaded
    let addresses = page.matches("http").count();
    assert_eq!(addresses, page.matches("xmlns=\"http://www.w3.org/2000/svg\"").count());
    let expected = [
        "contact-time-against-steps.svg",
        "dent-against-steps.svg",
        "error-against-calls.svg",
        "error-against-steps.svg",
        "error-against-time.svg",
        "force-against-steps.svg",
        "force-over-indentation.svg",
        "force-over-time.svg",
        "index.html",
        "report.json",
        "stability.svg",
    ];
    assert_eq!(contents(&folder), expected);
    for file in expected {
        assert!(page.contains(file) || file == "index.html", "the page names {file}");
    }
}

#[test]
fn the_cells_of_the_page_have_four_digits_and_units_with_the_signs_of_print() {
    let (folder, _) = &*DEFAULT;
    let page = fs::read_to_string(folder.path().join("report/index.html")).expect("a page");
    let cells = page.split("<td").skip(1).filter_map(|rest| rest.split("</td>").next()?.split_once('>'));
    let mut numbers = 0;
    for (_, cell) in cells {
        let words: Vec<&str> = cell.split([' ', '<', '\u{b7}']).collect();
        assert!(!words.iter().any(|word| ["um", "us", "uJ"].contains(word)), "{cell}");
        for word in words.iter().filter(|word| word.parse::<f64>().is_ok()) {
            let digits = word.replace(['.', '-'], "");
            assert!(digits.trim_matches('0').len() <= 4 && !word.contains('e'), "{cell}");
            numbers += 1;
        }
    }
    assert!(numbers > 500 && page.contains(" \u{b5}s</td>") && page.contains(" \u{b5}m</td>"), "{numbers} numbers");
}

#[test]
fn the_page_has_every_row_of_the_data() {
    let (folder, data) = &*DEFAULT;
    let page = fs::read_to_string(folder.path().join("report/index.html")).expect("a page");
    let shown = page.matches("<tr>").count() + page.matches("<tr class=\"best\">").count();
    // five tables have a head, and the scene and the outcome a row for each fact
    let tables = ["precision", "orders", "limits", "stability", "extremes"];
    let facts = ["bodies", "outcome"].map(|facts| data["summary"][facts].as_array().expect("a list").len());
    let ways = data["use"]["ways"].as_array().expect("a list").len() + 1;
    let expected: usize = tables.map(|table| rows(data, table).len() + 1).into_iter().chain(facts).sum();
    assert_eq!(shown, expected + ways);
}

#[test]
fn a_scene_with_several_contacts_or_a_rate_dependent_law_has_a_report_too() {
    if long::leaves_out("reports of other scenes") {
        return;
    }
    let (_folder, data) = report("two_contacts");
    assert!(data["summary"].to_string().contains("measures the first contact"), "{}", data["summary"]);
    let (_folder, data) = report("damped");
    assert!(rows(&data, "orders").iter().all(|row| row["way"] != "mass known"), "{}", data["orders"]);
}
