//! The FMUs that are compared: exports of one contact with several laws, and two in C.

use super::build::{Exported, compile, export, export_text};
use super::instructions::{self, Work};
use super::paths::{self, CYCLE_STEP, STEP, STEPS_PER_CYCLE};
use super::unit::{FORCE, INPUT, Instance, Unit, ok};
use std::path::{Path, PathBuf};

/// The scene that is written by hand in C.
pub const SCENE: &str = include_str!("../../scenes/steel_ball.toml");

/// The same bodies with the law of a scene that names none.
pub fn default_law() -> String {
    let (before, law) = SCENE.split_once("[law]").expect("a table of laws");
    let (_, after) = law.split_once("\n\n").expect("a table behind it");
    format!("{before}{after}")
}

/// The same where the ball is elastic and can yield, a little later than the block.
pub fn both_yield() -> String {
    let ball = "[impactor]\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 310e6\n";
    default_law().replacen("[impactor]\n", ball, 1)
}

pub struct Trio {
    /// Brinell's FMU, the contact written by hand in C, and the FMU without physics.
    pub units: [Unit; 3],
    pub libraries: [PathBuf; 3],
    pub exported: Exported,
    /// FMUs of the same contact with the default law: a rigid ball, and one that can yield, too.
    pub by_default: [(Unit, Exported); 2],
    /// Brinell's FMU with the output `regime`, which the default scene does not have, and its reference.
    pub with_regime: (Unit, u32),
    pub folder: PathBuf,
}

impl Trio {
    pub fn build(folder: &Path) -> Trio {
        let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/steel_ball.toml");
        let exported = export(&scene, folder);
        let c = ["contact", "empty"].map(|name| compile(name, 1, &exported, folder));
        let [contact, empty] = c;
        let libraries = [exported.library.clone(), contact, empty];
        let units = libraries.each_ref().map(|library| Unit::open(library, &exported.guid));
        let text = SCENE.replacen("outputs = [", "outputs = [\"regime\", ", 1);
        let regime = export_text("with_regime", &text, folder);
        let by_default = [("by_default", default_law()), ("both_yield", both_yield())].map(|(name, text)| {
            let exported = export_text(name, &text, folder);
            (Unit::open(&exported.library, &exported.guid), exported)
        });
        let with_regime = (Unit::open(&regime.library, &regime.guid), regime.reference("regime"));
        Trio { units, libraries, exported, by_default, with_regime, folder: folder.to_owned() }
    }

    /// Checks that all calls succeed and that both contacts behave the same; otherwise the comparison is meaningless.
    pub fn check(&self) {
        // full plasticity begins at 128 N
        const PLASTIC: f64 = 200.0;
        let [brinell, c, empty] = &self.units;
        let paths = STEPS_PER_CYCLE.map(|steps_per_cycle| (paths::cycles(steps_per_cycle), CYCLE_STEP));
        for (rates, step) in paths.iter().chain(&[(paths::impact(), STEP)]) {
            let peak = check_along(&brinell.instance(), &c.instance(), rates, *step);
            assert!(peak > PLASTIC, "the contact hardly touched: {peak} N");
        }
        for (unit, _) in &self.by_default {
            for (rates, step) in &paths {
                let peak = check_along(&unit.instance(), &unit.instance(), rates, *step);
                assert!(peak > PLASTIC, "the contact hardly touched: {peak} N");
            }
        }
        let others = PARAMETERS.map(|(name, value)| (self.exported.reference(name), value));
        let [brinell, c] = [brinell, c].map(|unit| unit.instance_with(&others));
        check_along(&brinell, &c, &paths::impact(), STEP);
        let empty = empty.instance();
        ok(empty.set(INPUT, STEP) | empty.step(0.0, STEP));
        assert_eq!(empty.value(FORCE), STEP, "the empty unit gives back its input");
    }

    /// Number of instructions of `functions` during all of `work`, for each FMU; `None` without valgrind.
    pub fn count(&self, work: &Work, functions: &[&str]) -> [Option<f64>; 3] {
        self.libraries.each_ref().map(|library| self.count_of(work, functions, library, &self.exported))
    }

    /// The same for the FMUs with the default law.
    pub fn count_by_default(&self, work: &Work, functions: &[&str]) -> [Option<f64>; 2] {
        self.by_default.each_ref().map(|(_, unit)| self.count_of(work, functions, &unit.library, unit))
    }

    fn count_of(&self, work: &Work, functions: &[&str], library: &Path, unit: &Exported) -> Option<f64> {
        let guid = unit.guid.to_str().expect("a GUID is plain text");
        instructions::can_be_counted().then(|| instructions::count(work, functions, library, guid, &self.folder))
    }
}

/// Parameters that differ from those of the scene; the contact begins indented.
const PARAMETERS: [(&str, f64); 5] = [
    ("impactor.radius", 4e-3),
    ("target.youngs_modulus", 180e9),
    ("target.poissons_ratio", 0.28),
    ("target.yield_strength", 250e6),
    ("initial_gap", -1e-6),
];

/// Checks that two instances have the same force after each step. Returns the largest force [N].
fn check_along(instance: &Instance, other: &Instance, rates: &[f64], step: f64) -> f64 {
    let mut peak: f64 = 0.0;
    for (index, &rate) in rates.iter().enumerate() {
        let [force, expected] = [instance, other].map(|instance| {
            ok(instance.set(INPUT, rate) | instance.step(index as f64 * step, step));
            instance.value(FORCE)
        });
        peak = peak.max(force);
        check_force(index, force, expected, peak);
    }
    peak
}

/// Checks that two contacts have the same force [N]. `peak` [N] is the largest force so far.
pub fn check_force(step: usize, force: f64, expected: f64, peak: f64) {
    const AGREEMENT: f64 = 1e-12;
    /// Of the depth of the dent.
    const ROUNDING: f64 = 4.0 * f64::EPSILON;
    // a contact about to separate follows F ~ z^1.5: the last digit of the dent determines the digits of the force
    let larger = force.max(expected);
    let allowed = AGREEMENT * larger + ROUNDING * (peak * peak * larger).cbrt();
    assert!((force - expected).abs() <= allowed, "step {step}: {force} N, and not {expected} N");
}
