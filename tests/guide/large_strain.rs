//! Large strain in the law `brinell`: what its constants say of a curve of finite elements that they are not fitted to.
//!
//! The correction is written here a second time, with the constants free (`crates/contact/src/material/large_strain.rs` has the formulas). The law
//! at small strain, to which it is applied, is that of bodies so stiff that there is no large strain.

use crate::comparisons::numbers;
use crate::physics::{self, AnyModel, unit};
use crate::tables::{heading, row, shows};
use brinell_contact::{Body, Loading, Pair, TwoBodies};

/// The planes: `E*/S`, the file, its columns of indentation, force and contact radius, and the largest contact radius over R.
const PLANES: [(f64, &str, [usize; 3], f64); 3] = [
    (100.0, "data/truth/loading_large_deformation_E100.csv", [0, 2, 3], 0.36),
    (200.0, "data/truth/pairs/loading_large_deformation_E200.csv", [0, 2, 3], 0.37),
    (1000.0, "data/truth/loading_large_deformation_E1000.csv", [0, 2, 3], 0.06),
];

/// The constants of force and area of a plane, as in the law.
const OF_THE_LAW: [f64; 2] = [1.83, 0.427];

/// `E*/S` at which all strain is small.
const STIFF: f64 = 1e9;

/// A plane under a rigid sphere.
fn plane(ratio: f64) -> AnyModel {
    let rigid = Body { radius: 1.0, youngs_modulus: f64::INFINITY, poissons_ratio: 0.3 };
    let metal = Body { radius: f64::INFINITY, youngs_modulus: 0.91e11, poissons_ratio: 0.3 };
    let pair = Pair::new(&rigid, &metal, 1e11 / ratio).expect("they touch").yielding_in(&metal, 1e11 / ratio);
    physics::brinell(pair, TwoBodies { curvature: metal.curvature(&rigid), ..TwoBodies::under_rigid(0.0) })
}

/// Force and contact radius in units of first yield at the depth `k`, by the law.
fn by_law(model: &AnyModel, k: f64) -> [f64; 2] {
    let unit = unit(&model.pair);
    let d = k * unit.indentation;
    let force = model.loading.segment(&model.pair, d).force(d) / unit.force;
    [force, model.loading.contact_radius(&model.pair, d) / (unit.indentation * model.pair.radius).sqrt()]
}

/// The same from the law at small strain, with these constants.
fn corrected(small: &AnyModel, ratio: f64, k: f64, [of_force, of_area]: [f64; 2]) -> [f64; 2] {
    let [force, radius] = by_law(small, k);
    let soft: f64 = 20.0 / ratio;
    let to_ball = (3.0 * std::f64::consts::PI * 1.1 / (4.0 * ratio)) / (1.0 + soft.powi(3));
    let u = (radius * to_ball).min(1.0);
    let lag = (1.0 - force / k.powf(1.5)).max(0.0);
    let z = (lag * u).min(0.5);
    let u = if lag * u > 0.5 { 0.5 / lag } else { u };
    let round = u * (1.0 - 1.0 / k);
    let area = (1.0 + of_area * lag * z) / (1.0 + 0.25 * round * round);
    let area = area.max(k / (radius * radius));
    [force * (1.0 + (of_force * z).powi(3)).powf(-1.0 / 3.0), radius * area.sqrt()]
}

/// A curve of finite elements beyond first yield, with the law at small strain.
struct Curve {
    ratio: f64,
    rows: Vec<[f64; 3]>,
}

impl Curve {
    fn read((ratio, file, columns, widest): (f64, &str, [usize; 3], f64)) -> Curve {
        let to_ball = 3.0 * std::f64::consts::PI * 1.1 / (4.0 * ratio);
        let rows = numbers(file, "").into_iter().map(|cells| columns.map(|column| cells[column]));
        let rows: Vec<_> = rows.filter(|[k, _, a]| *k > 1.5 && a * to_ball < widest).collect();
        assert!(rows.len() > 50, "{file}");
        Curve { ratio, rows }
    }

    /// The errors of force (0) or contact radius (1) with these constants.
    fn errors(&self, small: &AnyModel, constants: [f64; 2], which: usize) -> impl Iterator<Item = f64> {
        self.rows.iter().map(move |row| corrected(small, self.ratio, row[0], constants)[which] / row[1 + which] - 1.0)
    }

    fn largest(&self, small: &AnyModel, constants: [f64; 2], which: usize) -> f64 {
        self.errors(small, constants, which).fold(0.0, |worst, error| worst.max(error.abs()))
    }
}

/// The constants with the least sum of mean squares over these curves: of the force first, then of the radius, which leaves it as it is.
fn fitted(small: &AnyModel, curves: &[&Curve]) -> [f64; 2] {
    let mut constants = OF_THE_LAW;
    for which in 0..2 {
        let sum = |value: f64| {
            let mut constants = constants;
            constants[which] = value;
            let mean = |curve: &&Curve| {
                curve.errors(small, constants, which).map(|error| error * error).sum::<f64>() / curve.rows.len() as f64
            };
            curves.iter().map(mean).sum::<f64>()
        };
        let (mut low, mut high) = (0.0, 4.0);
        for _ in 0..60 {
            let third = (high - low) / 3.0;
            if sum(low + third) < sum(high - third) { high -= third } else { low += third }
        }
        constants[which] = 0.5 * (low + high);
    }
    constants
}

#[test]
fn the_errors_at_large_strain_are_also_those_of_curves_that_were_left_out() {
    let small = plane(STIFF);
    let curves = PLANES.map(Curve::read);
    let percent = |value: f64| format!("{:.1} %", 100.0 * value);
    let mut table = heading(&[
        "plane, `E*/S`",
        "force, contact radius by the law",
        "constants of all curves",
        "constants of the others",
        "force, contact radius with those of the others",
    ]);
    let all = fitted(&small, &curves.each_ref());
    for (at, curve) in curves.iter().enumerate() {
        let model = plane(curve.ratio);
        // what is written here is the law
        for row in &curve.rows {
            let [here, there] = [corrected(&small, curve.ratio, row[0], OF_THE_LAW), by_law(&model, row[0])];
            let off = [0, 1].map(|which| (here[which] / there[which] - 1.0).abs());
            assert!(off[0] < 1e-3 && off[1] < 2e-3, "E*/S = {}, {} d_y: {off:?}", curve.ratio, row[0]);
        }
        let others: Vec<_> = curves.iter().enumerate().filter(|(other, _)| *other != at).map(|(_, one)| one).collect();
        let left_out = fitted(&small, &others);
        let both = |constants| [0, 1].map(|which| percent(curve.largest(&small, constants, which))).join(", ");
        let words = |constants: [f64; 2]| constants.map(|constant| format!("{constant:.2}")).join(", ");
        table += &row(&[&curve.ratio.to_string(), &both(OF_THE_LAW), &words(all), &words(left_out), &both(left_out)]);
    }
    shows("validation.md", "large strain left out", &table);
}
