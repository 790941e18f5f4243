//! `brinell curve --tangential`: loops of the tangential force at a held normal force.

use brinell_contact::History;
use brinell_contact::TooDeep;
use brinell_contact::loading::AnyLoading;
use brinell_contact::tangential::{Mean, RoughModel, Springs};
use brinell_contact::unloading::AnyUnloading;
use brinell_exporter::columns::{Column, Columns};
use brinell_exporter::laws::Choice;
use brinell_exporter::library::MEMORY;
use brinell_exporter::numbers::in_message;
use brinell_exporter::predict::{PredictError, oblique, positive};
use brinell_exporter::scene::Scene;

/// Number of points on each branch of a loop.
const POINTS: u32 = 200;

/// Number of rows of the table in a terminal: four for each branch, and the end.
const ROWS: usize = 13;

/// Default amplitudes, relative to the displacement at which the whole contact slides: three loops, and one that slides.
const AMPLITUDES: [f64; 4] = [0.3, 0.6, 0.9, 1.2];

/// What the loops are drawn for.
#[derive(Clone, Copy)]
pub struct Wanted<'a> {
    /// Coefficient of friction.
    pub coefficient: f64,
    /// Held indentation [m].
    pub indentation: f64,
    /// Amplitudes [m]; the default ones if there are none.
    pub amplitudes: &'a [f64],
}

/// An error of a loop.
#[derive(Debug, thiserror::Error)]
pub enum LoopError {
    #[error("{0}")]
    Refused(#[from] PredictError),
    #[error("to = {} m is too deep for the law", in_message(*.0))]
    TooDeep(f64),
}

/// The contact at a point of a loop, in SI units.
struct LoopPoint {
    displacement: f64,
    force: f64,
    energy: f64,
    work: f64,
    stick_radius: f64,
    sliding: f64,
}

/// A loop of a law.
struct Loop {
    law: String,
    amplitude: f64,
    points: Vec<LoopPoint>,
}

/// All loops.
pub struct Loops {
    loops: Vec<Loop>,
    /// The names of the laws with the held normal force [N], and the displacement at which the whole contact slides [m].
    held: Vec<(String, f64, f64)>,
}

impl Loops {
    /// The loops of `choices`.
    ///
    /// # Errors
    /// [`LoopError`] for a law without friction, an impossible number, or an indentation beyond the range of a law.
    pub fn of(scene: &Scene, choices: &[Choice], wanted: Wanted) -> Result<Loops, LoopError> {
        let Wanted { coefficient, indentation, amplitudes } = wanted;
        oblique::check_coefficient(coefficient)?;
        // without friction there is no loop
        positive("friction", coefficient)?;
        for amplitude in amplitudes {
            positive("amplitude", *amplitude)?;
        }
        let (mut loops, mut held) = (Vec::new(), Vec::new());
        for choice in choices {
            let model = oblique::rough(scene, choice, coefficient, &[])?;
            let pressed = Pressed::to(&model, indentation).map_err(|_| LoopError::TooDeep(indentation))?;
            let slides = pressed.slides_at();
            held.push((choice.laws.clone(), pressed.contact.force(), slides));
            let usual = AMPLITUDES.map(|part| part * slides);
            for amplitude in if amplitudes.is_empty() { &usual[..] } else { amplitudes } {
                loops.push(Loop {
                    law: choice.laws.clone(),
                    amplitude: *amplitude,
                    points: pressed.clone().around(*amplitude),
                });
            }
        }
        Ok(Loops { loops, held })
    }

    /// The loops as columns.
    pub fn columns(&self) -> Columns {
        let names = [
            ("amplitude", "m"),
            ("tangential displacement", "m"),
            ("tangential force", "N"),
            ("tangential energy", "J"),
            ("friction work", "J"),
            ("stick radius", "m"),
            ("sliding", ""),
        ];
        let row = |amplitude: f64, point: &LoopPoint| {
            let LoopPoint { displacement, force, energy, work, stick_radius, sliding } = *point;
            vec![amplitude, displacement, force, energy, work, stick_radius, sliding]
        };
        let law = |(law, ..): &(String, f64, f64)| {
            let own = self.loops.iter().filter(|own| own.law == *law);
            let rows = own.flat_map(|own| own.points.iter().map(|point| row(own.amplitude, point)));
            (law.clone(), rows.collect())
        };
        Columns {
            columns: names.into_iter().map(|(name, unit)| Column::new(name, unit)).collect(),
            laws: self.held.iter().map(law).collect(),
        }
    }

    /// A short table for a terminal.
    pub fn text(&self) -> String {
        let names = ["tangential displacement", "tangential force", "friction work", "stick radius"];
        let mut text = String::new();
        for (law, force, slides) in &self.held {
            text += &format!(
                "{law}: normal force held at {}; the whole contact slides from a displacement of {} on\n",
                brinell_exporter::numbers::quantity(*force, "N"),
                brinell_exporter::numbers::quantity(*slides, "m")
            );
        }
        let count = self.loops.iter().map(|one| one.points.len()).max().unwrap_or(0);
        for one in &self.loops {
            let columns = self.columns();
            let own = columns.laws.iter().filter(|(law, _)| *law == one.law).flat_map(|(_, rows)| rows);
            let rows = own.filter(|row| row[0] == one.amplitude).cloned().collect();
            let name = format!("{}, amplitude {}", one.law, brinell_exporter::numbers::quantity(one.amplitude, "m"));
            text += &format!(
                "\n{}",
                Columns { columns: columns.columns.clone(), laws: vec![(name, rows)] }.text(&names, ROWS)
            );
        }
        text + &format!("\n{ROWS} of {count} points of each loop; -o FILE.csv writes all of them with all digits\n")
    }
}

/// A contact that is pressed along the normal.
#[derive(Clone)]
struct Pressed<'a> {
    model: &'a RoughModel<AnyLoading, AnyUnloading>,
    contact: History,
    springs: Springs<MEMORY>,
    displacement: f64,
    work: f64,
}

impl<'a> Pressed<'a> {
    /// The contact at `indentation` [m].
    fn to(model: &'a RoughModel<AnyLoading, AnyUnloading>, indentation: f64) -> Result<Self, TooDeep> {
        let mut contact = History::start(&model.normal, 0.0)?;
        let mut springs = Springs::start(model, &contact);
        springs.advance(&mut contact, model, (indentation, 0.0), (1.0, 0.0), Mean::Skipped)?;
        Ok(Pressed { model, contact, springs, displacement: 0.0, work: 0.0 })
    }

    /// The tangential displacement at which the whole contact slides [m]: the spring that touched first is compressed
    /// the most.
    fn slides_at(&self) -> f64 {
        let depth = self.contact.indentation();
        (depth - self.contact.residual_indentation(&self.model.normal)) / self.model.friction.scale()
    }

    /// Moves the contact to the displacement `goal` [m]; the points of the way.
    fn go(&mut self, goal: f64, points: &mut Vec<LoopPoint>) {
        let from = self.displacement;
        for point in 1..=POINTS {
            let to = from + (goal - from) * f64::from(point) / f64::from(POINTS);
            let slip = to - self.displacement;
            let way = (0.0, slip);
            // the normal motion is zero, which every law allows
            let mean = self.springs.advance(&mut self.contact, self.model, way, way, Mean::Exact).unwrap_or_default();
            self.work += mean * slip;
            self.displacement = to;
            points.push(self.point());
        }
    }

    fn point(&self) -> LoopPoint {
        let (friction, depth) = (&self.model.friction, self.contact.indentation());
        let energy = self.springs.energy(friction, depth);
        LoopPoint {
            displacement: self.displacement,
            force: self.springs.force(friction, depth),
            energy,
            work: self.work - energy,
            stick_radius: self.springs.stick_radius(self.contact.contact_radius(&self.model.normal), depth),
            sliding: f64::from(self.springs.sliding() as i32),
        }
    }

    /// To the displacement `amplitude` [m], back to the opposite one, and to `amplitude` again.
    fn around(mut self, amplitude: f64) -> Vec<LoopPoint> {
        let mut points = vec![self.point()];
        for goal in [amplitude, -amplitude, amplitude] {
            self.go(goal, &mut points);
        }
        points
    }
}
