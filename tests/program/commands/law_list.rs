//! `brinell laws`: the list, and one law.

use crate::laws;
use brinell_testing::folder::{Folder, close, number, words};
use serde_json::Value;
use std::sync::LazyLock;

/// Every law as JSON.
static LAWS: LazyLock<Value> = LazyLock::new(|| Folder::with(&[]).json("laws"));

/// Every law in words.
static LIST: LazyLock<String> = LazyLock::new(|| Folder::with(&[]).call("laws").with_status(0).out);

#[test]
fn laws_says_what_the_table_of_laws_says_of_accuracy_and_energy() {
    for law in LAWS["loading"].as_array().unwrap() {
        let entry = laws::entry("loading", law["name"].as_str().unwrap());
        let accuracy = laws::text(entry, "accuracy");
        assert!(!accuracy.is_empty() && law["accuracy"] == accuracy, "{law}");
        assert_eq!(law["jumps"], laws::says(entry, "jumps"), "{law}");
        let line = LIST.lines().find(|line| line.starts_with(&format!("{} ", law["name"].as_str().unwrap())));
        assert!(line.is_some_and(|line| line.contains(accuracy)), "{line:?} has no {accuracy}");
    }
    let law = |name: &str| LAWS["loading"].as_array().unwrap().iter().find(|law| law["name"] == name).unwrap().clone();
    assert_eq!((&law("brinell")["passive"], &law("brinell")["largest_restitution"]), (&true.into(), &Value::Null));
    close(number(&law("stronge"), "largest_restitution"), 1.154, 1e-3);
    close(number(&law("jackson-green"), "passive_from_poissons_ratio"), 0.02, 1e-12);
    assert!(LIST.contains("e up to 1.154") && LIST.contains("e up to 1.002 (nu < 0.02)") && LIST.contains("passive"));
}

#[test]
fn laws_lists_constants_validity_and_reference_of_every_law() {
    let laws = &*LAWS;
    let words = words(&LIST);
    let said = |value: &Value| value.as_str().unwrap().to_string();
    for kind in ["loading", "unloading"] {
        for law in laws[kind].as_array().unwrap() {
            assert!(words.contains(&format!("{}: {}", said(&law["name"]), said(&law["title"]))), "{law}");
            assert!(words.contains(&said(&law["reference"])) && words.contains(&said(&law["notes"])), "{law}");
            for parameter in law["parameters"].as_array().unwrap() {
                let (name, value) = (said(&parameter["name"]), number(parameter, "value"));
                let shown = format!("{name} = {value} {}", said(&parameter["unit"]));
                assert!(words.contains(shown.trim_end()), "nothing of {shown} in {words}");
                assert!(number(parameter, "minimum") <= value && value <= number(parameter, "maximum"), "{law}");
            }
        }
    }
    for law in laws["loading"].as_array().unwrap() {
        let validity = said(&law["validity"]);
        assert!(validity.len() > 20 && words.contains(&format!("validity {validity}")), "{law}");
    }
    assert!(words.contains("exponent = 1.2") && words.contains("coefficient = 1.5 F_y"));
}

#[test]
fn one_law_is_shown_with_formulas_constants_validity_and_accuracy() {
    let folder = Folder::with(&[]);
    for kind in ["loading", "unloading", "damped"] {
        for law in laws::entries(kind) {
            let name = laws::text(law, "name");
            let words = folder.words(&format!("laws {name}"));
            let parameters = law.get("parameters").and_then(|all| all.as_array()).cloned().unwrap_or_default();
            for parameter in parameters {
                assert!(words.contains(parameter["name"].as_str().unwrap()), "{parameter} in {words}");
            }
            for part in ["formulas", laws::text(law, "title"), laws::text(law, "reference")] {
                assert!(words.contains(part), "nothing of {part} in {words}");
            }
            let accuracy = words.contains("docs/guide/laws.md and docs/guide/validation.md");
            let loads = laws::entries("loading").any(|other| other["name"] == law["name"]);
            assert_eq!(accuracy, loads, "{words}");
        }
        let name = laws::entries(kind).map(|law| laws::text(law, "name")).last().expect("there are some of each kind");
        let json = folder.json(&format!("laws {name}"));
        assert!(!json[kind].is_null() && json[kind] != Value::Array(Vec::new()), "{json}");
    }
}
