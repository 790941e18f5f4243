//! The three FMUs that are compared: the export of the default scene, and two in C.

use super::build::{Exported, compile, export, export_text};
use super::instructions::{self, Work};
use super::paths::{self, CYCLE_STEP, STEP, STEPS_PER_CYCLE};
use super::unit::{FORCE, INPUT, Instance, Unit, ok};
use std::path::{Path, PathBuf};

pub struct Trio {
    /// Brinell's FMU, the contact written by hand in C, and the FMU without physics.
    pub units: [Unit; 3],
    pub libraries: [PathBuf; 3],
    pub exported: Exported,
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
        let text = include_str!("../../scenes/steel_ball.toml").replacen("outputs = [", "outputs = [\"regime\", ", 1);
        let regime = export_text("with_regime", &text, folder);
        let with_regime = (Unit::open(&regime.library, &regime.guid), regime.reference("regime"));
        Trio { units, libraries, exported, with_regime, folder: folder.to_owned() }
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
        let others = PARAMETERS.map(|(name, value)| (self.exported.reference(name), value));
        let [brinell, c] = [brinell, c].map(|unit| unit.instance_with(&others));
        check_along(&brinell, &c, &paths::impact(), STEP);
        let empty = empty.instance();
        ok(empty.set(INPUT, STEP) | empty.step(0.0, STEP));
        assert_eq!(empty.value(FORCE), STEP, "the empty unit gives back its input");
    }

    /// Number of instructions of `functions` during all of `work`, for each FMU; `None` without valgrind.
    pub fn count(&self, work: &Work, functions: &[&str]) -> [Option<f64>; 3] {
        let guid = self.exported.guid.to_str().expect("a GUID is plain text");
        self.libraries.each_ref().map(|library| {
            instructions::can_be_counted().then(|| instructions::count(work, functions, library, guid, &self.folder))
        })
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
