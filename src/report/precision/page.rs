//! Error against run time as words, pictures and tables.

use super::{Line, Point};
use crate::plot::{Picture, Series, View};
use crate::report::data::{Table, number, text};
use crate::report::{Figure, Part};
use std::ops::Range;

impl Line {
    /// Its name in pictures.
    fn label(&self) -> String {
        match &self.peer {
            None => self.name().into(),
            Some(peer) => format!("{peer}: {}", self.name()),
        }
    }
}

/// All measurements.
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

/// The relevant decades of errors, and the error that most users accept.
const SHOWN: Range<f64> = 1e-6..2.0;
const BEARABLE: (f64, &str) = (0.01, "1 %");

/// Names of the picture files, with their contents.
const PICTURES: [(&str, &str); 6] = [
    ("error-against-steps", "Error of restitution over steps per contact"),
    ("error-against-time", "Error of restitution over run time"),
    ("error-against-calls", "Error of restitution over calls"),
    ("force-against-steps", "Error of the largest force over steps per contact"),
    ("dent-against-steps", "Error of the dent over steps per contact"),
    ("contact-time-against-steps", "Error of the contact time over steps per contact"),
];

/// Error of restitution against steps, run time and the number of calls; errors of the other quantities against steps.
fn pictures(lines: &[Line]) -> [Picture; 6] {
    let series = |line: &Line, at: &dyn Fn(&Point) -> (f64, f64)| {
        // a zero error is also below all decades
        let drawn = |(x, y): (f64, f64)| (x, if y == 0.0 { f64::MIN_POSITIVE } else { y });
        let points = line.points.iter().map(|point| drawn(at(point))).collect();
        Series { label: line.label(), points, dots: false }
    };
    let coupled = || lines.iter().filter(|line| line.way.is_some());
    let picture = |x: &str, y: &str, at: &dyn Fn(&Point) -> (f64, f64)| Picture {
        x_title: x.into(),
        y_title: y.into(),
        logarithmic: (true, true),
        series: coupled().map(|line| series(line, at)).collect(),
    };
    let steps = |point: &Point| f64::from(point.steps);
    [
        picture("steps per contact", "error of restitution", &|p| (steps(p), p.restitution)),
        picture("time per impact [us]", "error of restitution", &|p| (1e6 * p.run_time, p.restitution)),
        picture("calls per impact", "error of restitution", &|p| (p.calls, p.restitution)),
        picture("steps per contact", "error of largest force", &|p| (steps(p), p.max_force)),
        picture("steps per contact", "error of dent", &|p| (steps(p), p.dent)),
        picture("steps per contact", "error of contact time", &|p| (steps(p), p.contact_time)),
    ]
}

/// The figures; the first two are shown initially.
fn figures(lines: &[Line]) -> Vec<Figure> {
    // omit figures without lines
    let drawable =
        |picture: &Picture| picture.series.iter().flat_map(|series| &series.points).any(|point| point.1 > 0.0);
    let figure = |(index, ((name, caption), picture)): (usize, ((&'static str, &str), Picture))| {
        let view = View { values: Some(SHOWN), marks: vec![BEARABLE], ..View::default() };
        let svg = picture.labelled(480, 350, &view);
        Figure { name, caption: caption.into(), svg, folded: index > 1 }
    };
    let all = PICTURES.into_iter().zip(pictures(lines)).enumerate();
    all.filter(|(_, (_, picture))| drawable(picture)).map(figure).collect()
}

/// Error against run time.
pub fn part(scene: &str, lines: &[Line]) -> Part {
    let mut method = String::from(
        "Errors are relative to the energy balance. Each is the root mean square over several places within a step where \
         the bodies meet. The largest force is the largest at the ends of steps. The time per impact is that of this \
         machine, without the cost of the simulation tool.",
    );
    if lines.iter().any(|line| line.way.is_none()) {
        method.push_str(
            " Unit alone: a prescribed motion in and out, cut into steps of unequal length, compared with the same motion in \
             one step each way. The difference is rounding.",
        );
    }
    if lines.iter().any(|line| line.peer.is_some()) {
        method.push_str(
            " Other FMUs got the bodies of the scene, as far as they have such parameters. Their errors are also relative to \
             the law of the scene.",
        );
    }
    Part {
        title: "Error against run time",
        words:
            "Lines that end at the lower edge go on below it. A line along the lower edge is exact but for rounding."
                .into(),
        figures: figures(lines),
        switches: Vec::new(),
        method,
        tables: vec![orders(scene, lines), table(scene, lines)],
    }
}
