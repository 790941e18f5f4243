//! What goes elsewhere has the form that is asked for there: the data set of the finite elements, the entry of the FMI tools list.

use crate::root;
use brinell_testing::command::{empty_folder, output};
use brinell_testing::python;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

/// The lines of a table without remarks.
fn lines(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).expect("a table");
    text.lines().filter(|line| !line.starts_with('#')).map(String::from).collect()
}

/// The cells of a line. A cell in quotes may have commas, which are no separators.
fn cells(line: &str) -> Vec<String> {
    let part = |(index, part): (usize, &str)| if index % 2 == 1 { part.replace(',', ";") } else { part.into() };
    let plain: String = line.split('"').enumerate().map(part).collect();
    plain.split(',').map(String::from).collect()
}

#[test]
fn the_data_set_has_every_number_of_its_sources_and_says_what_each_column_is() {
    let folder = empty_folder();
    let mut make = Command::new(python::INSTALLED);
    output(make.arg(root().join("packaging/dataset.py")).arg("-o").arg(folder.path())).with_status(0);
    let text = fs::read_to_string(folder.path().join("datapackage.json")).unwrap();
    let package: Value = serde_json::from_str(&text).unwrap();
    // the rows of each case, in their order
    let mut rows: BTreeMap<String, Vec<Vec<String>>> = BTreeMap::new();
    let mut cases = BTreeSet::new();
    for resource in package["resources"].as_array().unwrap() {
        let path = folder.path().join(resource["path"].as_str().unwrap());
        assert_eq!(resource["bytes"], fs::metadata(&path).unwrap().len());
        let table = lines(&path);
        let fields = resource["schema"]["fields"].as_array().unwrap();
        let names: Vec<_> = fields.iter().map(|field| field["name"].as_str().unwrap()).collect();
        assert_eq!(names, cells(&table[0]), "{}", path.display());
        assert!(fields.iter().all(|field| field["description"].as_str().is_some_and(|text| text.len() > 8)));
        for row in table[1..].iter().map(|line| cells(line)) {
            for (field, cell) in fields.iter().zip(&row) {
                assert!(field["type"] == "string" || cell.is_empty() || cell.parse::<f64>().is_ok(), "{row:?}");
            }
            if resource["name"] == "cases" {
                cases.insert(row[0].clone());
            } else {
                rows.entry(row[0].clone()).or_default().push(row);
            }
        }
    }
    assert_eq!(
        rows.keys().collect::<Vec<_>>(),
        cases.iter().collect::<Vec<_>>(),
        "every case has curves, and no other"
    );
    // sources whose columns differ in their order stand in one table
    let numbers = |cells: &[String]| {
        let mut numbers: Vec<_> = cells.iter().filter(|cell| cell.parse::<f64>().is_ok()).cloned().collect();
        numbers.sort_unstable();
        numbers
    };
    let all: BTreeSet<Vec<String>> = rows.values().flatten().map(|row| numbers(row)).collect();
    let mut count = 0;
    for (path, peak) in sources(&root().join("data/truth")) {
        for line in &lines(&path)[1..] {
            let row = numbers(&peak.iter().cloned().chain(cells(line)).collect::<Vec<_>>());
            assert!(all.contains(&row), "{}: {line}", path.display());
            count += 1;
        }
    }
    assert!(count > 10_000, "{count}");
    assert_eq!(count, rows.values().map(Vec::len).sum::<usize>(), "and no other numbers");
}

/// The files of curves below a folder, each with the peak that its name says.
fn sources(folder: &Path) -> Vec<(std::path::PathBuf, Option<String>)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("the folder of the finite elements") {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        if path.is_dir() && !["bodies", "friction"].contains(&&*name) {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|is| is == "csv") {
            found.push((path, name.split_once("_from_").map(|(_, peak)| peak.into())));
        }
    }
    found
}

/// The format of the list: CONTRIBUTING.md of fmi-standard.org.
#[test]
fn the_entry_for_the_list_of_fmi_tools_has_the_form_that_the_list_asks_for() {
    let text = fs::read_to_string(root().join("docs/fmi-tools.json")).unwrap();
    let entry: BTreeMap<String, Value> = serde_json::from_str(&text).unwrap();
    const TEXTS: [&str; 7] = ["name", "license", "url", "vendor", "vendorURL", "examplesURL", "description"];
    let lists: [(&str, &[&str]); 6] = [
        ("features", &[]),
        ("platforms", &["macOS", "Linux", "Windows", "Source Code"]),
        ("interfaces", &["GUI", "CLI", "library"]),
        ("fmiVersions", &["1.0", "2.0", "3.0"]),
        ("fmuExport", &["CS", "ME", "SE"]),
        ("fmuImport", &["CS", "ME", "SE"]),
    ];
    let mut keys: Vec<_> = TEXTS.into_iter().chain(lists.iter().map(|(key, _)| *key)).collect();
    keys.sort_unstable();
    assert_eq!(entry.keys().collect::<Vec<_>>(), keys);
    for key in TEXTS {
        assert!(entry[key].as_str().is_some_and(|text| !text.is_empty()), "{key}");
    }
    for (key, allowed) in lists {
        let values = entry[key].as_array().unwrap_or_else(|| panic!("{key} is a list"));
        assert!(values.iter().all(|value| allowed.contains(&value.as_str().unwrap())), "{key}: {values:?}");
    }
    assert_eq!(
        (&entry["license"], &entry["fmiVersions"], &entry["fmuExport"]),
        (&"osi".into(), &["2.0"][..].into(), &["CS"][..].into())
    );
    let description = entry["description"].as_str().unwrap();
    assert!(!description.ends_with('.') && !description.contains("http"), "{description}");
    assert!(root().join("docs/importers.md").is_file(), "the compatibility information");
}
