//! The map of rebound energies over steps and ways.

use super::limit::Limit;
use super::{Line, MATTERS, ROUNDING, Stability, makes_energy};
use crate::numbers::significant;
use crate::plot::{Class, Map, Row};

/// The map of the results.
pub fn of(stability: &Stability) -> Map {
    let row = |line: &Line| Row {
        name: line.way.name.into(),
        values: line.energies.iter().map(|energy| energy.worst(stability.predicted)).collect(),
        bar: if let Limit::Upto(limit) = line.limit { Some(limit) } else { None },
    };
    let columns = stability.lines.first().map(|line| line.energies.iter().map(|energy| energy.relative).collect());
    Map {
        x_title: "h sqrt(K/m)".into(),
        columns: columns.unwrap_or_default(),
        rows: stability.lines.iter().map(row).collect(),
        legend: format!("rebound energy over incoming energy; predicted: {}", significant(stability.predicted, 3)),
        classes: classes(stability.predicted),
        bar_legend: "largest stable step of a pressed body".into(),
    }
}

/// The classes around the `predicted` ratio: blue below, yellow to orange above, and red for an energy gain. In dark
/// mode a page turns dark red into pink; therefore no red is very dark.
fn classes(predicted: f64) -> Vec<Class> {
    // rounding does not count as an energy gain
    let most = 1.0 + ROUNDING;
    let mut classes = Vec::new();
    let mut add = |upto: f64, colour, meaning| {
        let crossed = makes_energy(upto);
        let ends = classes.last().map_or(0.0, |class: &Class| class.upto);
        if upto > ends {
            classes.push(Class { upto, colour, meaning, crossed });
        }
    };
    for (part, colour) in [(0.5, (33, 102, 172)), (0.9, (103, 169, 207)), (0.99, (205, 226, 240))] {
        add(part * predicted, colour, "too little");
    }
    add(f64::min(1.01 * predicted, most), (255, 255, 255), "right");
    // the middle of the remaining range, as a ratio
    let more = f64::min(1.1 * predicted, most);
    for (upto, colour) in [(more, (255, 243, 176)), (more.sqrt(), (254, 210, 90)), (most, (245, 155, 40))] {
        add(upto, colour, "too much");
    }
    for (upto, colour) in [(MATTERS, (245, 120, 110)), (2.0, (228, 60, 55)), (f64::INFINITY, (185, 5, 30))] {
        add(upto, colour, "more than came in");
    }
    classes
}
