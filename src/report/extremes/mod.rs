//! Stiff and extreme cases, each judged: impacts far from the scene's, and extreme prescribed motions.

mod impacts;
mod motions;

use super::Part;
use super::contact::Contact;
use super::data::{Table, number, text};
use super::progress::Progress;
use crate::scene::Scene;
use crate::validity::Beyond;
use brinell_contact::validity::{LARGEST_RADIUS_RATIO, LARGEST_SPEED_RATIO};
use impacts::{Bodies, Change};

/// Tolerances of an impact with leap-frog: energy relative to the incoming energy, force relative to itself.
const TOLERANCE: f64 = 0.01;

/// Tolerance of the dissipated energy of a prescribed motion, relative to the work of its loading.
const EXACT: f64 = 1e-9;

/// The result of a case.
pub struct Case {
    pub name: String,
    /// Data of the case [m], [s].
    pub indentation: f64,
    pub step: f64,
    /// Contact radius over the effective radius.
    pub width: f64,
    /// Errors of force and energy.
    pub errors: (f64, f64),
    pub tolerance: f64,
    /// Number of warnings from the FMU.
    told: usize,
    /// The exceeded limits of the law's validity.
    pub beyond: Vec<Beyond>,
    /// Whether the law itself returns more energy than it received.
    makes_energy: bool,
    pub verdict: Verdict,
}

/// The verdict on a case.
pub enum Verdict {
    Right,
    /// The FMU rejected it, correctly and with the reason.
    Refused(String),
    /// There is no reference to judge it.
    NotJudged(&'static str),
    Failed(String),
}

/// Approximate number of cases; a law may omit a few.
pub fn count(scene: &Scene, quick: bool) -> usize {
    let motions = if scene.is_rate_dependent() { 0 } else { motions::count(quick) };
    impacts::count(scene) + motions
}

/// Runs all cases.
pub fn measure(contact: &mut Contact, scene: &Scene, quick: bool, progress: &Progress) -> Vec<Case> {
    let mut cases = impacts::run(contact, scene, quick, progress);
    if let (false, Some(bodies)) = (scene.is_rate_dependent(), Bodies::of(scene, Change::default())) {
        cases.extend(motions::run(contact, &bodies, quick, progress));
    }
    cases
}

impl Case {
    /// Whether it was judged.
    fn is_judged(&self) -> bool {
        !matches!(self.verdict, Verdict::NotJudged(_))
    }

    /// Whether it failed.
    pub fn has_failed(&self) -> bool {
        matches!(self.verdict, Verdict::Failed(_))
    }

    /// A case before its run.
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

    /// Records the exceeded limits at this contact `radius` [m], and how many of them the FMU reported.
    fn note_validity(&mut self, contact: &mut Contact, bodies: &Bodies, radius: f64) {
        self.width = radius / bodies.model.pair().radius;
        self.beyond = bodies.beyond(radius, contact.fastest);
        self.told = contact.warnings().len();
    }

    /// Fails the case if an error exceeds its tolerance, if `passive` is false, or if a warning is missing or wrong.
    fn judge(&mut self, passive: bool) {
        let (force, energy) = self.errors;
        // NaN counts as wrong
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

/// The title of the section.
pub const TITLE: &str = "Stiff and extreme cases";

/// Stiff and extreme cases.
pub fn part(cases: &[Case]) -> Part {
    let judged = cases.iter().filter(|case| case.is_judged()).count();
    let failed: Vec<_> = cases.iter().filter(|case| case.has_failed()).collect();
    let mut words = format!("{} of {judged} stiff and extreme cases are correct.", judged - failed.len());
    for case in &failed {
        words.push_str(&format!(" Failed: {}.", case.name));
    }
    Part {
        title: TITLE,
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
