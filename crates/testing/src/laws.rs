//! The table of laws, `modelDescription/laws.toml`.

use crate::places::root;
use std::fs;
use std::sync::LazyLock;

static TABLE: LazyLock<toml::Table> = LazyLock::new(|| {
    let path = root().join("modelDescription/laws.toml");
    fs::read_to_string(path).expect("the table of laws").parse().expect("the table of laws is well-formed")
});

/// The entries of a kind of law, in their order.
pub fn entries(kind: &str) -> impl Iterator<Item = &'static toml::Table> {
    TABLE[kind].as_array().expect("a list of laws").iter().map(|law| law.as_table().expect("a law"))
}

/// The entry of the law `name`.
pub fn entry(kind: &str, name: &str) -> &'static toml::Table {
    entries(kind).find(|law| law["name"].as_str() == Some(name)).unwrap_or_else(|| panic!("no {kind} law {name}"))
}

/// Whether an entry contains `key = true`.
pub fn says(entry: &toml::Table, key: &str) -> bool {
    entry.get(key).is_some_and(|value| value.as_bool().expect("true or false"))
}

/// The text under `key`; empty if there is none.
pub fn text<'a>(entry: &'a toml::Table, key: &str) -> &'a str {
    entry.get(key).map_or("", |value| value.as_str().expect("a text"))
}
