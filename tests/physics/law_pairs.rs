//! The law `brinell` of two deformable bodies, compared with the finite-element curves in `data/truth/pairs/`.

use crate::law_materials::{WEAK, force, read};
use crate::physics::{AnyModel, brinell, unit};
use brinell_contact::impact::{Impact, Prediction, predict};
use brinell_contact::{Body, Loading, OtherBody, Pair, TwoBodies};

/// A finite-element curve: modulus and strength of the bodies relative to each other, `H/E`, the depths from which it unloads, and the
/// largest errors of the law \[%\]: force, contact radius, restitution, dent.
struct Case {
    name: &'static str,
    moduli: f64,
    strengths: f64,
    hardening: f64,
    depths: [&'static str; 3],
    allowed: [f64; 4],
}

const fn case(name: &'static str, moduli: f64, strengths: f64, hardening: f64, allowed: [f64; 4]) -> Case {
    Case { name, moduli, strengths, hardening, depths: ["10", "50", "150"], allowed }
}

const ELASTIC: f64 = f64::INFINITY;

/// What the guide says of such pairs.
const CASES: [Case; 10] = [
    case("elastic_E1overE2_0.333", 1.0 / 3.0, ELASTIC, 0.0, [0.6, 0.5, 0.4, 0.6]),
    case("elastic_E1overE2_1", 1.0, ELASTIC, 0.0, [1.2, 0.8, 0.9, 2.0]),
    case("elastic_E1overE2_3", 3.0, ELASTIC, 0.0, [1.7, 1.1, 1.1, 4.5]),
    case("both_S2overS1_1.0", 1.0, 1.0, 0.0, [0.4, 0.5, 0.3, 1.1]),
    case("both_S2overS1_1.2", 1.0, 1.2, 0.0, [1.1, 0.8, 0.6, 1.8]),
    case("both_S2overS1_1.5", 1.0, 1.5, 0.0, [1.1, 0.8, 0.6, 1.8]),
    case("both_S2overS1_2.0", 1.0, 2.0, 0.0, [1.1, 0.8, 0.6, 1.8]),
    case("both_E1overE2_3_S2overS1_1.5", 3.0, 1.5, 0.0, [1.1, 0.8, 0.6, 1.8]),
    case("elastic_E1overE2_1_H0.05", 1.0, ELASTIC, 0.05, [1.2, 1.4, 0.9, 2.0]),
    case("both_S2overS1_1.0_H0.05", 1.0, 1.0, 0.05, [0.4, 0.5, 0.3, 1.1]),
];

impl Case {
    /// A flat body under a sphere of 5 mm, so weak that the strain stays small.
    fn model(&self) -> AnyModel {
        let body = |radius, youngs_modulus| Body { radius, youngs_modulus, poissons_ratio: 0.3 };
        let (one, other) = (body(f64::INFINITY, 206e9), body(0.005, 206e9 / self.moduli));
        let pair = Pair::new(&other, &one, WEAK).expect("they touch");
        let harder = OtherBody {
            modulus: other.plane_strain_modulus(),
            poissons_ratio: 0.3,
            yield_strength: self.strengths * WEAK,
            hardening_modulus: self.hardening * other.youngs_modulus,
        };
        let hardening_modulus = self.hardening * one.youngs_modulus;
        brinell(pair, TwoBodies { hardening_modulus, curvature: one.curvature(&other), other: harder })
    }

    /// The columns of these names of a table.
    fn columns<const COLUMNS: usize>(file: &str, names: [&str; COLUMNS]) -> Vec<[f64; COLUMNS]> {
        let text = read(&format!("data/truth/pairs/{file}.csv"));
        let mut lines = text.lines().filter(|line| !line.starts_with('#'));
        let head: Vec<_> = lines.next().expect("a head").split(',').collect();
        let places = names.map(|name| head.iter().position(|column| *column == name).expect("a column of this name"));
        let number = |line: &str, place: usize| line.split(',').nth(place).and_then(|cell| cell.parse().ok());
        lines
            .filter_map(|line| places.map(|place| number(line, place)).into_iter().collect::<Option<Vec<_>>>())
            .map(|row| row.try_into().expect("as many columns"))
            .collect()
    }

    /// Indentation, force and contact radius, in units of first yield.
    fn loading(&self) -> Vec<[f64; 3]> {
        let rows = Case::columns(&format!("loading_{}", self.name), ["delta_over_dy", "F_over_Fy", "a_over_ay"]);
        assert!(rows.len() > 150, "{}: the curve is complete", self.name);
        rows
    }

    /// The impact with the energy of the finite elements up to this depth, as the law has it: prediction, and the numbers to compare.
    fn impact(&self, depth: &str) -> (Prediction, [f64; 4]) {
        let text = read("data/truth/pairs/summary_unloading.csv");
        let head = text.lines().find(|line| !line.starts_with('#')).expect("a head");
        let place = |name: &str| {
            head.split(',').position(|column| column == name).unwrap_or_else(|| panic!("{name} in {head}"))
        };
        let row: Vec<_> = text
            .lines()
            .map(|line| line.split(',').collect::<Vec<_>>())
            .filter(|row| row[0] == self.name && row[place("x_m")] == depth)
            .collect();
        let number = |name: &str| -> f64 { row[0][place(name)].parse().expect("a number") };
        let model = self.model();
        let unit = unit(&model.pair);
        let energy = number("W_load_smoothed") * unit.force * unit.indentation;
        let impact = Impact { mass: 1.0, speed: (2.0 * energy).sqrt() };
        let x_m: f64 = depth.parse().expect("a number");
        (predict(&model, &impact).expect("within range"), [number("e"), number("F_m"), x_m, number("x_f")])
    }
}

fn percent(value: f64, expected: f64) -> f64 {
    100.0 * (value / expected - 1.0)
}

#[test]
fn force_and_contact_radius_of_two_bodies_are_those_of_finite_elements() {
    let mut wrong = Vec::new();
    for case in &CASES {
        let model = case.model();
        let unit = unit(&model.pair);
        let (mut worst, mut worst_radius) = ((0.0f64, 0.0), (0.0f64, 0.0));
        for [x, expected, radius] in case.loading() {
            let depth = x * unit.indentation;
            let error = percent(force(&model, depth) / unit.force, expected);
            if x >= 1.2 && error.abs() > worst.0.abs() {
                worst = (error, x);
            }
            let size = (model.pair.radius * unit.indentation).sqrt();
            let error = percent(model.loading.contact_radius(&model.pair, depth) / size, radius);
            if x >= 3.0 && error.abs() > worst_radius.0.abs() {
                worst_radius = (error, x);
            }
        }
        println!(
            "{}: force {:+.2} % at {}, radius {:+.2} % at {}",
            case.name, worst.0, worst.1, worst_radius.0, worst_radius.1
        );
        if worst.0.abs() > case.allowed[0] || worst_radius.0.abs() > case.allowed[1] {
            wrong.push(case.name);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn impacts_of_two_bodies_are_those_of_finite_elements() {
    let mut wrong = Vec::new();
    for case in &CASES {
        for depth in case.depths {
            let (prediction, [e, f_m, x_m, x_f]) = case.impact(depth);
            let unit = unit(&case.model().pair);
            let restitution = percent(prediction.restitution, e);
            let force = percent(prediction.max_force / unit.force, f_m);
            let indentation = percent(prediction.max_indentation / unit.indentation, x_m);
            let dent = percent(prediction.residual_indentation / unit.indentation, x_f);
            println!(
                "{} {depth}: e {restitution:+.2} force {force:+.2} depth {indentation:+.2} dent {dent:+.2}",
                case.name
            );
            let [allowed_force, _, allowed_restitution, allowed_dent] = case.allowed;
            if restitution.abs() > allowed_restitution || force.abs() > allowed_force || dent.abs() > allowed_dent {
                wrong.push((case.name, depth));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}
