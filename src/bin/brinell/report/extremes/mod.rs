//! Stiff and extreme cases: impacts far from the scene's, and motions that no sane master would make, each judged.

mod impacts;
mod motions;

use super::Part;
use super::data::{Table, number, text};
use super::progress::Progress;
use super::unit::Contact;
use crate::scene::Scene;
use crate::validity::Beyond;
use brinell::contact::validity::{LARGEST_RADIUS_RATIO, LARGEST_SPEED_RATIO};
use impacts::{Bodies, Change};

/// Largest error of an impact by leap-frog: of the energy relative to the incoming one, of the force relative to itself.
const TOLERANCE: f64 = 0.01;

/// Largest error of the dissipated energy of a motion that is prescribed, relative to the work of its loading.
const EXACT: f64 = 1e-9;

/// What came out of a case.
pub struct Case {
    pub name: String,
    /// Of the case [m], [s].
    pub indentation: f64,
    pub step: f64,
    /// Contact radius over the effective radius.
    pub width: f64,
    /// Of force and energy.
    pub errors: (f64, f64),
    pub tolerance: f64,
    /// How many warnings the unit gave.
    told: usize,
    /// What leaves the validity of the law.
    pub beyond: Vec<Beyond>,
    /// Whether the law itself gives back more than it took.
    makes_energy: bool,
    pub verdict: Verdict,
}

/// What a case was found to be.
pub enum Verdict {
    Right,
    /// The unit was right to refuse it, and said why.
    Refused(String),
    /// There is nothing to judge it by.
    NotJudged(&'static str),
    Failed(String),
}

/// How many cases there are, to a few that a law may leave out.
pub fn count(scene: &Scene, quick: bool) -> usize {
    let motions = if scene.damped.is_some() { 0 } else { motions::count(quick) };
    impacts::count(scene) + motions
}

/// Runs all cases.
pub fn measure(contact: &mut Contact, scene: &Scene, quick: bool, progress: &Progress) -> Vec<Case> {
    let mut cases = impacts::run(contact, scene, quick, progress);
    if let (None, Some(bodies)) = (scene.damped, Bodies::of(scene, Change::default())) {
        cases.extend(motions::run(contact, &bodies, quick, progress));
    }
    cases
}

impl Case {
    /// Whether it was judged.
    fn is_judged(&self) -> bool {
        !matches!(self.verdict, Verdict::NotJudged(_))
    }

    /// Whether it has failed.
    pub fn has_failed(&self) -> bool {
        matches!(self.verdict, Verdict::Failed(_))
    }

    /// A case that is yet to be run.
    fn new(name: &str, tolerance: f64) -> Case {
        let errors = (f64::NAN, f64::NAN);
        Case {
            name: name.into(),
            indentation: f64::NAN,
            step: f64::NAN,
            width: f64::NAN,
            told: 0,
            beyond: Vec::new(),
            errors,
            tolerance,
            makes_energy: false,
            verdict: Verdict::NotJudged("not run"),
        }
    }

    /// Notes what was left of the validity, at this contact `radius` [m], and how much of that the unit has told.
    fn note_validity(&mut self, contact: &mut Contact, bodies: &Bodies, radius: f64) {
        self.width = radius / bodies.model.pair().radius;
        self.beyond = bodies.beyond(radius, contact.fastest);
        self.told = contact.warnings().len();
    }

    /// Fails the case if it isn't right to its tolerance, if `passive` is false, or if the unit was silent or cried wolf.
    fn judge(&mut self, passive: bool) {
        let (force, energy) = self.errors;
        // NaN is not right
        let right = |error: f64| error <= self.tolerance;
        let failure = if !right(force) {
            format!("the force is off by {force:e}")
        } else if !right(energy) {
            format!("the energy is off by {energy:e}")
        } else if !passive {
            "it gains energy".into()
        } else if self.told != self.beyond.len() {
            format!("{} limits of validity were left, and the FMU logged {}", self.beyond.len(), self.told)
        } else {
            self.verdict = Verdict::Right;
            return;
        };
        self.verdict = Verdict::Failed(failure);
    }
}

/// The cases as a table.
fn table(cases: &[Case]) -> Table {
    let mut table = Table::new(
        "extremes",
        [
            ("case", ""),
            ("largest indentation", "m"),
            ("step", "s"),
            ("a/R", ""),
            ("error of force", ""),
            ("error of energy", ""),
            ("tolerance", ""),
            ("verdict", ""),
            ("beyond validity", ""),
        ],
    );
    for case in cases {
        let verdict = match &case.verdict {
            Verdict::Right => "right".into(),
            Verdict::Refused(message) => format!("rejected, correctly: {message}"),
            Verdict::NotJudged(why) => format!("not judged: {why}"),
            Verdict::Failed(why) => format!("FAILED: {why}"),
        };
        let warning = |beyond: &Beyond| match beyond {
            Beyond::Width(_) => format!("a/R above {LARGEST_RADIUS_RATIO}"),
            Beyond::Speed { .. } => format!("speed above {LARGEST_SPEED_RATIO} of the wave speed"),
        };
        let mut warnings: Vec<_> = case.beyond.iter().map(warning).collect();
        if case.makes_energy {
            warnings.push("the law gains energy".into());
        }
        table.rows.push(vec![
            text(&case.name),
            number(case.indentation),
            number(case.step),
            number(case.width),
            number(case.errors.0),
            number(case.errors.1),
            number(case.tolerance),
            text(verdict),
            text(warnings.join(", ")),
        ]);
    }
    table
}

/// Stiff and extreme cases.
pub fn part(cases: &[Case]) -> Part {
    let judged = cases.iter().filter(|case| case.is_judged()).count();
    let failed: Vec<_> = cases.iter().filter(|case| case.has_failed()).collect();
    let mut words = format!("{} of {judged} stiff and extreme cases are correct.", judged - failed.len());
    for case in &failed {
        words.push_str(&format!(" Failed: {}.", case.name));
    }
    Part {
        title: "Stiff and extreme cases",
        words,
        figures: Vec::new(),
        switches: Vec::new(),
        method: format!(
            "Each case is stepped through the FMU. It must be correct, log a warning outside the law's validity, or be rejected \
             with a named error where the law can't be evaluated. Impacts by leap-frog must agree with the energy balance within \
             {TOLERANCE}; their mass grows with the volume of the sphere, and the yield strength with E. Prescribed motions in \
             and out must dissipate what the law says within {EXACT:e} of the work, and end with the force that it says.",
        ),
        tables: vec![table(cases)],
    }
}
