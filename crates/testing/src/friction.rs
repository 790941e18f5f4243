//! Tables of friction, and oblique impacts of a ball.

use crate::places::root;
use brinell_contact::Segment;
use std::collections::HashMap;
use std::fs;

/// A row of a table, by the names of its columns; empty fields are NaN.
pub struct Row {
    pub case: String,
    values: HashMap<String, f64>,
}

impl Row {
    pub fn get(&self, column: &str) -> f64 {
        *self.values.get(column).unwrap_or_else(|| panic!("no column {column}"))
    }
}

/// The text of a file of the project.
pub fn file(name: &str) -> String {
    let path = root().join(name);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The rows of one table, in order. A line that begins with `table` names the columns of those behind it.
pub fn table(name: &str) -> Vec<Row> {
    let mut columns: Vec<String> = Vec::new();
    let mut rows = Vec::new();
    for line in file("data/truth/friction/tables.csv").lines().filter(|line| !line.starts_with('#')) {
        let fields: Vec<&str> = line.split(',').collect();
        if fields[0] == "table" {
            columns = fields.iter().map(|&field| field.to_string()).collect();
        } else if fields[0] == name {
            let numbers = columns.iter().zip(&fields).skip(2);
            let values = numbers.map(|(column, field)| (column.clone(), field.parse().unwrap_or(f64::NAN)));
            rows.push(Row { case: fields[1].to_string(), values: values.collect() });
        }
    }
    assert!(!rows.is_empty(), "the table {name} has rows");
    rows
}

/// Hertz's curve of these effective modulus \[Pa\] and radius \[m\].
pub fn hertz(modulus: f64, radius: f64) -> Segment {
    let power = 4.0 / 3.0 * modulus * radius.sqrt();
    Segment { upper: 1e100, power, ..Segment::NOTHING }
}

/// Panics unless `found` is `expected` to this part of `size`.
pub fn assert_close(what: &str, found: f64, expected: f64, size: f64, tolerance: f64) {
    let error = (found - expected).abs() / size.abs();
    assert!(error <= tolerance, "{what}: {found:e}, not {expected:e}, an error of {error:.1e}");
}

/// A solid ball that flies at a plane.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    /// \[kg\]
    pub mass: f64,
    /// \[m\]
    pub radius: f64,
    /// Closing speed along the normal \[m/s\].
    pub normal: f64,
    /// Tangential speed of the centre \[m/s\].
    pub tangential: f64,
    /// Spin \[rad/s\]; positive if it moves the contact point as a positive tangential speed does.
    pub spin: f64,
}

/// The ball after its impact.
#[derive(Clone, Copy, Debug)]
pub struct Rebound {
    pub ball: Ball,
    pub steps: u32,
    /// Normal and tangential restitution of the centre.
    pub restitution: (f64, f64),
    /// Tangential speed of the contact point \[m/s\].
    pub slip: f64,
    /// Rebound angle of the centre from the normal \[degrees\].
    pub angle: f64,
}

impl Ball {
    /// The impact in steps of `step` \[s\]: the contact moves first, then the ball. `contact` takes the way along the normal, the
    /// tangential one and whether the ball has left; it gives the forces \[N\], or `None` when the bodies have parted.
    pub fn impact(mut self, step: f64, mut contact: impl FnMut(f64, f64) -> Option<(f64, f64)>) -> Rebound {
        let before = self;
        let inertia = 0.4 * self.mass * self.radius * self.radius;
        for steps in 1..1_000_000 {
            let slip = self.tangential + self.spin * self.radius;
            let forces = contact(self.normal * step, slip * step);
            let (force, pull) = forces.unwrap_or((0.0, 0.0));
            self.normal -= step * force / self.mass;
            self.tangential -= step * pull / self.mass;
            self.spin -= step * pull * self.radius / inertia;
            if forces.is_none() {
                return Rebound {
                    ball: self,
                    steps,
                    restitution: (-self.normal / before.normal, self.tangential / before.tangential),
                    slip: self.tangential + self.spin * self.radius,
                    angle: (self.tangential / -self.normal).atan().to_degrees(),
                };
            }
        }
        panic!("the impact doesn't end");
    }
}
