//! Oblique impacts as words, pictures and tables.

use super::{Line, Oblique};
use crate::numbers::{quantity, significant};
use crate::plot::{Picture, Series};
use crate::report::data::{Table, number, text};
use crate::report::{Figure, Part};

/// The name of the prediction in pictures.
const PREDICTED: &str = "predicted";

impl Oblique {
    /// The section of the report.
    pub fn part(&self) -> Part {
        Part {
            title: "Oblique impacts",
            words: self.words(),
            figures: vec![self.errors(), self.restitutions()],
            switches: Vec::new(),
            method: format!(
                "A solid ball with the mass of the scene's impact hits the surface at {}, at {} degrees from the normal, without spin. \
                 The master steps the contact first, then the ball with its new forces. Errors are differences of the tangential \
                 restitution of the centre from <code>brinell predict --angle</code>, root mean square over the angles. A single \
                 spring has the stiffness 8 G* a and Coulomb's limit, as in discrete-element codes; rescaled, its force falls in \
                 unloading with the contact radius. Below some 1e-5 the bounded memory of the FMU limits its error. No measurement of friction with yield is known; for an elastic contact the \
                 guide compares both with measured rebounds.",
                quantity(self.speed, "m/s"),
                self.angles.map(|angle| significant(angle, 3)).join(", ")
            ),
            tables: vec![self.error_table(), self.angle_table()],
        }
    }

    /// The effect of friction on stable steps.
    pub fn sentence(&self) -> Option<String> {
        (self.frequency_ratio > 1.0).then(|| {
            format!(
                "These steps are for the normal motion. With friction the largest stable steps of a solid ball that sticks are {} \
                 times shorter.",
                significant(self.frequency_ratio, 2)
            )
        })
    }

    /// The finding: how far the methods are off.
    fn words(&self) -> String {
        let last = |line: &Line| line.errors.last().map_or(f64::NAN, |(_, error)| *error);
        let off = |line: &Line| {
            let pairs = line.restitutions.iter().zip(&self.predicted);
            pairs.map(|(one, other)| (one.1 - other.1).abs()).fold(0.0, f64::max)
        };
        let [unit, plain, rescaled] = self.lines.as_slice() else { return String::new() };
        format!(
            "Coefficient of friction {}. With the smallest steps the FMU is within {} of the predicted tangential restitution. \
             A single spring stays {} away, and {} if it is rescaled, whatever the step; at the worst angle {} and {}.",
            self.coefficient,
            significant(last(unit), 2),
            significant(last(plain), 2),
            significant(last(rescaled), 2),
            significant(off(plain), 2),
            significant(off(rescaled), 2),
        )
    }

    fn errors(&self) -> Figure {
        let line = |line: &Line| Series {
            label: line.name.into(),
            points: line.errors.iter().map(|(steps, error)| (f64::from(*steps), *error)).collect(),
            dots: false,
        };
        let picture = Picture {
            x_title: "steps per contact".into(),
            y_title: "error of tangential restitution".into(),
            logarithmic: (true, true),
            series: self.lines.iter().map(line).collect(),
        };
        let caption = "Error of the tangential restitution over steps per contact".into();
        Figure { name: "oblique-error", caption, svg: picture.svg(640, 350), folded: false }
    }

    fn restitutions(&self) -> Figure {
        let line =
            |name: &str, points: &[(f64, f64)]| Series { label: name.into(), points: points.to_vec(), dots: false };
        // the FMU would cover the prediction
        let springs = self.lines.iter().skip(1).map(|own| line(own.name, &own.restitutions));
        let picture = Picture {
            x_title: "angle of incidence [degrees]".into(),
            y_title: "tangential restitution".into(),
            logarithmic: (false, false),
            series: [line(PREDICTED, &self.predicted)].into_iter().chain(springs).collect(),
        };
        let caption = "Tangential restitution over the angle of incidence".into();
        Figure { name: "oblique-angle", caption, svg: picture.svg(640, 350), folded: false }
    }

    fn error_table(&self) -> Table {
        let columns = [("method", ""), ("steps per contact", ""), ("error of tangential restitution", "")];
        let mut table = Table::new("oblique-error", columns);
        table.rows = self
            .lines
            .iter()
            .flat_map(|line| {
                line.errors
                    .iter()
                    .map(|(steps, error)| vec![text(line.name), number(f64::from(*steps)), number(*error)])
            })
            .collect();
        table
    }

    fn angle_table(&self) -> Table {
        let mut table = Table::new("oblique-angle", [("method", ""), ("angle", "deg"), ("tangential restitution", "")]);
        table.on_page = false;
        let row =
            |name: &str, (angle, restitution): &(f64, f64)| vec![text(name), number(*angle), number(*restitution)];
        table.rows = self.predicted.iter().map(|point| row(PREDICTED, point)).collect();
        for line in &self.lines {
            table.rows.extend(line.restitutions.iter().map(|point| row(line.name, point)));
        }
        table
    }
}
