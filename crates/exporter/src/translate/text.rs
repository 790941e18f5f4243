//! The answer for a terminal.

use super::motion::{Outcome, Promise};
use super::{Translated, Translation};
use crate::layout::{paragraph, table};
use crate::numbers::{prefixed, quantity, significant};

/// The whole answer.
pub fn of(translation: &Translation) -> String {
    let Translation { title, versions, reference, law, mass, speed, units, .. } = translation;
    let heading = format!(
        "numbers for {title}: the law {law}, {} at {}{}",
        quantity(*mass, "kg"),
        quantity(*speed, "m/s"),
        if *units == "si" { "" } else { ", in mm, tonnes and seconds" }
    );
    let mut text = paragraph("", &heading);
    text += &paragraph("  holds for:  ", versions);
    text += &paragraph("  reference:  ", reference);
    for way in &translation.ways {
        text.push('\n');
        text += &of_way(translation, way);
    }
    for why in &translation.left_out {
        text.push('\n');
        text += &paragraph("left out: ", why);
    }
    text.push('\n');
    for note in &translation.notes {
        text += &paragraph("note: ", note);
    }
    text
}

fn of_way(translation: &Translation, way: &Translated) -> String {
    let mut text = paragraph(&format!("{}: ", way.title), way.law);
    text.push('\n');
    for line in way.block.lines() {
        text += format!("    {line}").trim_end();
        text.push('\n');
    }
    text.push('\n');
    let rows = way.numbers.iter().map(|number| {
        let value = if number.value.is_finite() { significant(number.value, 7) } else { "none".into() };
        let unit = if number.unit == "1" { "" } else { number.unit };
        vec![value, unit.into(), number.means.into()]
    });
    text += &table(&rows.collect::<Vec<_>>(), 3, 2);
    text.push('\n');
    text += &errors(translation, way);
    text.push('\n');
    for note in &way.notes {
        text += &paragraph("  - ", note);
    }
    text
}

/// The law and the tool at each speed.
fn errors(translation: &Translation, way: &Translated) -> String {
    let defined = way.promised.iter().any(|one| !one.mean.contact_time.is_nan());
    let spread = |one: &Promise| one.most_restitution - one.least_restitution > 5e-4;
    let spreads = way.promised.iter().any(spread);
    let mut rows = vec![vec!["speed".to_string(), "law's".into(), "tool's".into()]];
    if spreads {
        rows[0].push("spread".into());
    }
    if defined {
        rows[0].extend(["largest force", "contact time", "depth"].map(String::from));
    }
    for ((speed, law), tool) in translation.speeds.iter().zip(&translation.wanted).zip(&way.promised) {
        let mut row =
            vec![quantity(*speed, "m/s"), significant(law.restitution, 3), significant(tool.mean.restitution, 3)];
        if spreads {
            row.push(format!("{}..{}", significant(tool.least_restitution, 3), significant(tool.most_restitution, 3)));
        }
        if defined {
            row.extend(compared(law, &tool.mean));
        }
        rows.push(row);
    }
    let mut text = "  restitution by the law, and the tool's".to_string();
    if defined {
        text += "; what else the tool does, and how far that is from the law";
    }
    text.push('\n');
    text += &table(&rows, 0, 2);
    if !defined {
        text += "  largest force, contact time and depth: not defined\n";
    }
    text
}

/// A ratio to what is wanted as a difference in percent, or as a factor where it is far off.
pub fn change(ratio: f64) -> String {
    if (0.1..10.0).contains(&ratio) {
        format!("{:+.0} %", 100.0 * (ratio - 1.0)).replace("-0 %", "+0 %")
    } else {
        format!("x {}", significant(ratio, 2))
    }
}

/// Force, time and depth of the tool, with their difference from the law's.
fn compared(law: &Outcome, tool: &Outcome) -> [String; 3] {
    let of = |law: f64, tool: f64, unit: &'static str| {
        let size = prefixed(tool, unit);
        format!("{} {} ({})", significant(tool / size.size, 3), size.unit, change(tool / law))
    };
    [
        of(law.largest_force, tool.largest_force, "N"),
        of(law.contact_time, tool.contact_time, "s"),
        of(law.depth, tool.depth, "m"),
    ]
}
