//! Oblique impacts over a quantity, as pictures.

use super::{Outcome, Sweep};
use crate::plot::{Picture, Series, side_by_side};

/// The titles of the panels with their values.
type Panel = (&'static str, fn(&Outcome) -> f64);

const PANELS: [Panel; 4] = [
    ("tangential restitution of the centre", Outcome::tangential_restitution),
    ("rebound angle [deg]", Outcome::angle),
    ("rebound spin [rad/s]", |outcome| outcome.rebound.ball.spin),
    ("slip speed after the impact [m/s]", |outcome| outcome.rebound.ball.slip()),
];

impl Sweep {
    /// Tangential restitution, rebound angle, spin and slip over the quantity.
    pub fn panels(&self) -> [Picture; 4] {
        PANELS.map(|(title, value)| {
            let line = |(law, points): &(String, Vec<(f64, Outcome)>)| Series {
                label: law.clone(),
                points: points.iter().map(|(at, outcome)| (*at, value(outcome))).collect(),
                dots: false,
            };
            Picture {
                x_title: self.axis.title(),
                y_title: title.into(),
                logarithmic: (self.axis.is_logarithmic(), false),
                series: self.laws.iter().map(line).collect(),
            }
        })
    }

    /// The panels as one picture.
    pub fn svg(&self) -> String {
        side_by_side(&self.panels(), 1440, 360)
    }
}
