//! The tools, from `tools.toml`.

use super::law::Form;
use super::motion::Stepping;
use serde::Deserialize;
use std::sync::LazyLock;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tool {
    /// As it is typed.
    pub name: String,
    #[serde(default)]
    pub aliases: Vec<String>,
    pub title: String,
    pub versions: String,
    /// Where the tool documents its numbers.
    pub reference: String,
    /// The system of units that it may have beside SI.
    pub units: Option<String>,
    #[serde(rename = "way")]
    pub ways: Vec<Way>,
}

/// One set of numbers.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Way {
    pub name: String,
    pub title: String,
    /// `None` if a restitution is all that is typed.
    pub form: Option<Form>,
    pub stepping: Stepping,
    /// The force in words.
    pub law: String,
    /// Whether the tool scales the damping by the speed at touch, so that the restitution is the same at every speed.
    #[serde(default)]
    pub at_touch: bool,
    #[serde(default)]
    pub remarks: Vec<String>,
    #[serde(rename = "number")]
    pub numbers: Vec<Number>,
    /// What is pasted, with `{key}` for each number.
    pub block: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Number {
    pub key: String,
    pub unit: String,
    pub means: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    #[serde(rename = "tool")]
    tools: Vec<Tool>,
}

/// All tools, in the order of the table.
pub static TOOLS: LazyLock<Vec<Tool>> = LazyLock::new(|| {
    let table: Table = toml::from_str(include_str!("tools.toml")).expect("the table is part of the program");
    table.tools
});

/// The tool of this name, in any spelling of it.
///
/// # Errors
/// The list of tools, in words.
pub fn named(name: &str) -> Result<&'static Tool, String> {
    let plain = |name: &str| name.trim().to_lowercase().replace(['-', '_', ' '], "");
    let asked = plain(name);
    let is_it = |tool: &&Tool| {
        let all = tool.aliases.iter().chain([&tool.name, &tool.title]);
        all.into_iter().any(|known| plain(known) == asked)
    };
    let names = || TOOLS.iter().map(|tool| tool.name.as_str());
    TOOLS.iter().find(is_it).ok_or_else(|| crate::nearest::unknown("tool", name, names()))
}
