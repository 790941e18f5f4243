//! Errors of the law `brinell` relative to finite elements of other materials.

use crate::layout::{paragraph, table};
use crate::model::strengthened;
use crate::numbers::significant;
use crate::truth::{self, MATERIALS, Material, Point};
use brinell::contact::loading::AnyLoading;
use brinell::contact::unloading::AnyUnloading;
use brinell::contact::{Loading, Model, Pair};
use serde::Serialize;

/// The range of indentations for the comparison of forces [yield indentations].
const COMPARED: std::ops::RangeInclusive<f64> = 1.2..=500.0;

/// Errors relative to the curves of one material.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Errors {
    pub poissons_ratio: f64,
    /// Hardening modulus over Young's modulus.
    pub hardening: f64,
    /// Largest relative error of the loading force.
    pub worst_force: f64,
    /// Its position [yield indentations].
    pub worst_at: f64,
    /// Root mean square of that error.
    pub rms_force: f64,
    /// Largest error of an unloading, relative to its largest force.
    pub worst_unloading: f64,
    /// Largest relative error of a restitution.
    pub worst_restitution: f64,
    /// Largest relative error of a dent.
    pub worst_dent: f64,
}

/// The errors of `model`, a law with a form for other materials, for each of them. The bodies are those of the model,
/// except for the material.
pub fn errors(model: &Model<AnyLoading, AnyUnloading>) -> Vec<Errors> {
    MATERIALS.iter().map(|material| compare(model, material)).collect()
}

fn compare(model: &Model<AnyLoading, AnyUnloading>, material: &Material) -> Errors {
    let Material { poissons_ratio, hardening, .. } = *material;
    let youngs_modulus = model.pair.modulus * (1.0 - poissons_ratio * poissons_ratio);
    let pair = Pair { poissons_ratio, youngs_modulus, ..model.pair };
    let model = strengthened(&Model { pair, ..*model }, hardening * youngs_modulus);
    let unit = pair.yield_point(truth::YIELD_PRESSURE_FACTOR);
    let force = |d: f64| model.loading.segment(&pair, d).force(d);
    let points: Vec<Point> = material.loading().into_iter().filter(|point| COMPARED.contains(&point.x)).collect();
    let error = |point: &Point| (force(point.x * unit.indentation) / (point.f * unit.force) - 1.0, point.x);
    let all: Vec<(f64, f64)> = points.iter().map(error).collect();
    let (worst_force, worst_at) = all
        .iter()
        .copied()
        .fold((0.0, 0.0), |worst: (f64, f64), next| if next.0.abs() > worst.0.abs() { next } else { worst });
    let squares: f64 = all.iter().map(|(error, _)| error * error).sum();
    let mut errors = Errors {
        poissons_ratio,
        hardening,
        worst_force,
        worst_at,
        rms_force: (squares / all.len() as f64).sqrt(),
        worst_unloading: 0.0,
        worst_restitution: 0.0,
        worst_dent: 0.0,
    };
    let larger = |one: f64, other: f64| if other.abs() > one.abs() { other } else { one };
    for (impact, path) in material.impacts() {
        let largest = impact.largest.x * unit.indentation;
        let back = model.unloading_path(largest);
        for point in &path {
            let d = (point.x * unit.indentation).max(back.lower);
            let error = (back.force(d) / unit.force - point.f) / impact.largest.f;
            errors.worst_unloading = larger(errors.worst_unloading, error);
        }
        let Some(rebound) = impact.rebound else { continue };
        let restitution = (model.recovered_work(largest, largest) / model.loading.work(&pair, largest)).sqrt();
        errors.worst_restitution = larger(errors.worst_restitution, restitution / rebound.restitution - 1.0);
        errors.worst_dent = larger(errors.worst_dent, back.lower / (rebound.dent * unit.indentation) - 1.0);
    }
    errors
}

/// The errors as a table.
pub fn text(all: &[Errors]) -> String {
    let percent = |value: f64| format!("{:+.2} %", 100.0 * value);
    let head = ["target", "force: worst", "at d_y", "rms", "unloading, of F_m", "restitution", "dent"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for errors in all {
        let target = match errors.hardening {
            0.0 => format!("nu = {}", errors.poissons_ratio),
            hardening => format!("nu = {}, H = {hardening} E", errors.poissons_ratio),
        };
        rows.push(vec![
            target,
            percent(errors.worst_force),
            significant(errors.worst_at, 3),
            format!("{:.2} %", 100.0 * errors.rms_force),
            percent(errors.worst_unloading),
            percent(errors.worst_restitution),
            percent(errors.worst_dent),
        ]);
    }
    let heading = "The law brinell on targets that harden, and with other Poisson's ratios: largest errors against finite \
                   elements from 1.2 to 500 d_y, and from up to 5 depths from which the load comes off \
                   (truth/materials/README.md).";
    format!("{}\n{}", paragraph("", heading), table(&rows, 1, 0))
}
