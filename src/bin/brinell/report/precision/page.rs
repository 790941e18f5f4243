//! Error against run time as words, pictures and tables.

use super::{Line, Point};
use crate::plot::{Picture, Series};
use crate::report::Part;
use crate::report::data::{Table, number, text};

/// What errors of the unit alone are drawn at that are smaller, zero among them: half a unit in the last place.
const LAST_PLACE: f64 = 0.5 * f64::EPSILON;

impl Line {
    /// What it is called in pictures.
    fn label(&self) -> String {
        match &self.peer {
            None => self.name().into(),
            Some(peer) => format!("{peer}: {}", self.name()),
        }
    }
}

/// All that was measured.
fn table(scene: &str, lines: &[Line]) -> Table {
    let mut table = Table::new(
        "precision",
        [
            ("unit", ""),
            ("way", ""),
            ("steps per contact", ""),
            ("step", "s"),
            ("error of restitution", ""),
            ("error of largest force", ""),
            ("error of dent", ""),
            ("error of contact time", ""),
            ("calls per impact", ""),
            ("time per impact", "s"),
        ],
    );
    for line in lines {
        table.rows.extend(line.points.iter().map(|point| {
            vec![
                text(line.peer.as_deref().unwrap_or(scene)),
                text(line.name()),
                number(f64::from(point.steps)),
                number(point.step),
                number(point.restitution),
                number(point.max_force),
                number(point.dent),
                number(point.contact_time),
                number(point.calls),
                number(point.run_time),
            ]
        }));
    }
    table
}

/// The fitted orders.
fn orders(scene: &str, lines: &[Line]) -> Table {
    let mut table = Table::new("orders", [("unit", ""), ("way", ""), ("order", "")]);
    let coupled = lines.iter().filter(|line| line.way.is_some());
    let row = |line: &Line| {
        let unit = line.peer.as_deref().unwrap_or(scene);
        vec![text(unit), text(line.name()), number(line.order.unwrap_or(f64::NAN))]
    };
    table.rows = coupled.map(row).collect();
    table
}

/// Error of restitution against run time and against the number of calls, and of the other quantities against steps.
fn pictures(lines: &[Line]) -> [Picture; 5] {
    let series = |line: &Line, at: &dyn Fn(&Point) -> (f64, f64)| {
        let least = if line.way.is_none() { LAST_PLACE } else { 0.0 };
        // max would make a number of NaN
        let drawn = |(x, y): (f64, f64)| (x, if y < least { least } else { y });
        let points = line.points.iter().map(|point| drawn(at(point))).collect();
        Series { label: line.label(), points, dots: false }
    };
    let picture = |x: &str, y: &str, at: &dyn Fn(&Point) -> (f64, f64)| Picture {
        x_title: x.into(),
        y_title: y.into(),
        logarithmic: (true, true),
        series: lines.iter().map(|line| series(line, at)).collect(),
    };
    let steps = |point: &Point| f64::from(point.steps);
    [
        picture("time per impact [us]", "error of restitution", &|p| (1e6 * p.run_time, p.restitution)),
        picture("calls per impact", "error of restitution", &|p| (p.calls, p.restitution)),
        picture("steps per contact", "error of largest force", &|p| (steps(p), p.max_force)),
        picture("steps per contact", "error of dent", &|p| (steps(p), p.dent)),
        picture("steps per contact", "error of contact time", &|p| (steps(p), p.contact_time)),
    ]
}

/// Error against run time.
pub fn part(scene: &str, lines: &[Line]) -> Part {
    let names = [
        "error-against-time",
        "error-against-calls",
        "force-against-steps",
        "dent-against-steps",
        "contact-time-against-steps",
    ];
    let mut words = String::from(
        "Errors are relative to the energy balance, root mean squares over the places within a step where the bodies \
         meet. The largest force is that at the ends of steps, and the time per impact that of this machine. Where two \
         lines coincide the lower one is wider.",
    );
    if lines.iter().any(|line| line.way.is_none()) {
        words.push_str(
            " Unit alone: a given way in and out, split into steps of unequal length, beside the same in one step each; \
             what differs is rounding, drawn at 1.1e-16 where it is less.",
        );
    }
    if lines.iter().any(|line| line.peer.is_some()) {
        words.push_str(
            " Other units were given the bodies of the scene, as far as they have such parameters; their errors are relative \
             to the law of the scene too.",
        );
    }
    // nothing to draw of what no line has
    let drawable =
        |picture: &Picture| picture.series.iter().flat_map(|series| &series.points).any(|point| point.1 > 0.0);
    let pictures = names.into_iter().zip(pictures(lines)).filter(|(_, picture)| drawable(picture));
    Part {
        title: "Error against run time",
        words,
        pictures: pictures.map(|(name, picture)| (name, picture.svg(520, 360))).collect(),
        tables: vec![orders(scene, lines), table(scene, lines)],
    }
}
