//! The record of an indentation: a carbide ball that a machine presses into a steel, to the end of the first unloading.

use crate::comparisons::numbers;
use crate::devices::on_steel;
use crate::physics::AnyModel;
use brinell_contact::{Body, Loading};

/// Root mean square.
pub fn rms(errors: &[f64]) -> f64 {
    (errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64).sqrt()
}

/// The least of a function between two places, which has one, by golden-section search.
pub fn least(function: impl Fn(f64) -> f64, (mut low, mut high): (f64, f64)) -> f64 {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let places = |low: f64, high: f64| (high - golden * (high - low), low + golden * (high - low));
    let (mut one, mut other) = places(low, high);
    let (mut of_one, mut of_other) = (function(one), function(other));
    while high - low > 1e-4 * (1.0 + low.abs()) {
        if of_one < of_other {
            (high, other, of_other) = (other, one, of_one);
            one = places(low, high).0;
            of_one = function(one);
        } else {
            (low, one, of_one) = (one, other, of_other);
            other = places(low, high).1;
            of_other = function(other);
        }
    }
    0.5 * (low + high)
}

/// A fit of the record of an indentation: strength, zero point and compliance are free.
pub struct Fit {
    /// \[Pa\].
    pub strength: f64,
    /// \[m/N\].
    pub compliance: f64,
    /// Of the depth \[m\].
    pub rms: f64,
}

impl Fit {
    /// The best fit by a law.
    pub fn by(law: &str) -> Fit {
        let record = record();
        let step = |index: i32| 19.0 + 0.2 * f64::from(index);
        let of = |logarithm: f64| Fit::with(law, logarithm.exp(), &record);
        let first = (1..16).min_by(|one, other| of(step(*one)).rms.total_cmp(&of(step(*other)).rms)).expect("some");
        of(least(|logarithm| of(logarithm).rms, (step(first - 1), step(first + 1))))
    }

    /// The best zero point and compliance for this strength: the recorded depth is that of the law, less the zero point, and the
    /// compliance times the force; a straight line.
    fn with(law: &str, strength: f64, record: &[(f64, f64)]) -> Fit {
        let ball = Body { radius: 0.5e-3, youngs_modulus: 630e9, poissons_ratio: 0.21 };
        let model = on_steel(law, &ball, strength);
        let last = record.iter().enumerate().max_by(|one, other| one.1.1.total_cmp(&other.1.1)).expect("some").0;
        let largest = depth_under(&model, record[last].1);
        let path = model.unloading_path(largest);
        let of = |place: usize, force: f64| match place <= last {
            true => depth_under(&model, force),
            false => root((path.lower, largest), |depth| path.force(depth) < force),
        };
        let rest = record.iter().enumerate().map(|(place, &(depth, force))| (force, depth - of(place, force)));
        let rest: Vec<_> = rest.collect();
        let mean = |of: &dyn Fn(&(f64, f64)) -> f64| rest.iter().map(of).sum::<f64>() / rest.len() as f64;
        let (force, depth) = (mean(&|point| point.0), mean(&|point| point.1));
        let compliance =
            mean(&|point| (point.0 - force) * (point.1 - depth)) / mean(&|point| (point.0 - force).powi(2));
        let errors: Vec<f64> = rest.iter().map(|point| point.1 - depth - compliance * (point.0 - force)).collect();
        Fit { strength, compliance, rms: rms(&errors) }
    }
}

/// Points of the record up to the end of its first unloading.
const FIRST: usize = 44;

/// Depth \[m\] and force \[N\] to the end of the first unloading.
fn record() -> Vec<(f64, f64)> {
    let rows = numbers("data/experiment/indentation_record.csv", "");
    rows.iter().take(FIRST).map(|row| (1e-6 * row[0], row[1])).collect()
}

/// The indentation \[m\] under this force \[N\], on the loading curve.
fn depth_under(model: &AnyModel, force: f64) -> f64 {
    root((0.0, 1e-4), |depth| model.loading.segment(&model.pair, depth).force(depth) < force)
}

/// The place between two up to which something holds.
fn root((mut low, mut high): (f64, f64), is_below: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..36 {
        let middle = 0.5 * (low + high);
        *(if is_below(middle) { &mut low } else { &mut high }) = middle;
    }
    0.5 * (low + high)
}

/// An independent fit, with another choice of points, has 865 to 874 MPa.
#[test]
fn the_record_of_an_indentation_gives_the_strength_of_an_independent_fit_within_8_percent() {
    let fit = Fit::by("brinell");
    assert!((fit.strength / 870e6 - 1.0).abs() < 0.08, "{} Pa", fit.strength);
    // the depth has steps of 0.0625 um
    assert!(fit.rms < 0.08e-6 && (0.0..20e-9).contains(&fit.compliance), "{} m, {} m/N", fit.rms, fit.compliance);
}
