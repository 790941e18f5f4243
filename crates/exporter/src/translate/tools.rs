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
    pub ways: Vec<ToolNumbers>,
}

/// One set of numbers.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ToolNumbers {
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
    /// Whether the numbers are for targets that aren't spheres only.
    #[serde(default)]
    pub flat_only: bool,
    #[serde(default)]
    pub remarks: Vec<String>,
    #[serde(rename = "number")]
    pub numbers: Vec<Number>,
    /// What is pasted, with `{key}` for each number.
    pub block: String,
}

impl ToolNumbers {
    /// The lines of the block for a ball on a flat, or for two spheres.
    pub fn block_for(&self, two_spheres: bool) -> String {
        let lines = self.block.trim_matches('\n').lines().filter_map(|line| for_target(line, two_spheres));
        lines.collect::<Vec<_>>().join("\n")
    }

    /// The remarks that hold for a ball on a flat, or for two spheres.
    pub fn remarks_for(&self, two_spheres: bool) -> impl Iterator<Item = &str> {
        self.remarks.iter().filter_map(move |remark| for_target(remark, two_spheres))
    }
}

/// The text without its mark; `None` if it is for other targets.
fn for_target(text: &str, two_spheres: bool) -> Option<&str> {
    match (text.strip_prefix("@flat "), text.strip_prefix("@two ")) {
        (Some(flat), _) => (!two_spheres).then_some(flat),
        (_, Some(two)) => two_spheres.then_some(two),
        _ => Some(text),
    }
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
