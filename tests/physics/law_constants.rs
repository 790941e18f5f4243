//! The constants of the laws: the table of laws has each of them, within its limits.

use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use brinell_testing::laws::{self, text};
use serde_json::Value;
use std::collections::BTreeSet;

/// The entry of each law of a kind in the file, and the names and values of the law's fields.
fn told_and_own(kind: &str) -> Vec<(toml::Table, serde_json::Map<String, Value>)> {
    let fields =
        |law: Value| law.as_object().unwrap().values().next().unwrap().as_object().cloned().unwrap_or_default();
    let own: Vec<(&str, Value)> = if kind == "loading" {
        AnyLoading::ALL.iter().map(|(name, law)| (*name, serde_json::to_value(law).unwrap())).collect()
    } else {
        AnyUnloading::ALL.iter().map(|(name, law)| (*name, serde_json::to_value(law).unwrap())).collect()
    };
    own.into_iter().map(|(name, law)| (laws::entry(kind, name).clone(), fields(law))).collect()
}

fn parameters(told: &toml::Table) -> Vec<toml::Table> {
    let all = told.get("parameters").and_then(|all| all.as_array()).cloned().unwrap_or_default();
    all.iter().map(|parameter| parameter.as_table().unwrap().clone()).collect()
}

fn number(table: &toml::Table, key: &str) -> f64 {
    table[key].as_float().unwrap_or_else(|| panic!("{key} of {table} is no number"))
}

#[test]
fn the_data_names_every_constant_of_every_law_and_no_other() {
    for kind in ["loading", "unloading"] {
        for (told, own) in told_and_own(kind) {
            let law = text(&told, "name");
            let fixed = told.get("fixed").and_then(|all| all.as_array()).cloned().unwrap_or_default();
            let fixed = fixed.iter().map(|name| name.as_str().unwrap().to_string());
            let named: Vec<String> =
                parameters(&told).iter().map(|parameter| text(parameter, "name").to_string()).chain(fixed).collect();
            let different: BTreeSet<_> = named.iter().collect();
            assert_eq!(different.len(), named.len(), "{law}: a constant is named twice");
            assert_eq!(different, own.keys().collect(), "{law}");
        }
    }
}

#[test]
fn every_reference_constant_is_a_number_within_its_limits() {
    for kind in ["loading", "unloading"] {
        for (told, own) in told_and_own(kind) {
            for parameter in parameters(&told) {
                let name = text(&parameter, "name");
                let value = own[name].as_f64().unwrap_or_else(|| panic!("{name} is a list"));
                let range = number(&parameter, "minimum")..=number(&parameter, "maximum");
                assert!(range.contains(&value), "{}: {name} = {value}", text(&told, "name"));
                assert!(!text(&parameter, "description").is_empty(), "{name}");
                if let Some(below) = parameter.get("below") {
                    assert!(value < own[below.as_str().unwrap()].as_f64().unwrap(), "{name}");
                }
            }
        }
    }
}
