//! Scenes to start from, by trade: those of `scenes/trades/`, each of which begins with its title and a line of what to look at.

use serde_json::{Value, json};

/// The text of each; the first one is that with which the page opens.
pub const TEXTS: [&str; 9] = [
    include_str!("../../../scenes/trades/drop_test.toml"),
    include_str!("../../../scenes/trades/valve_seat.toml"),
    include_str!("../../../scenes/trades/end_stop.toml"),
    include_str!("../../../scenes/trades/hammer_blow.toml"),
    include_str!("../../../scenes/trades/shot_peening.toml"),
    include_str!("../../../scenes/trades/newtons_cradle.toml"),
    include_str!("../../../scenes/trades/box_on_feet.toml"),
    include_str!("../../../scenes/trades/hammer_drill.toml"),
    include_str!("../../../scenes/trades/hardness_test.toml"),
];

/// All of them: title, what to look at, text.
pub fn all() -> Value {
    TEXTS
        .iter()
        .map(|text| {
            let mut remarks = text.lines().map_while(|line| line.strip_prefix("# "));
            let title = remarks.next().unwrap_or_default();
            json!({ "title": title, "look": remarks.collect::<Vec<_>>().join(" "), "text": text })
        })
        .collect()
}
