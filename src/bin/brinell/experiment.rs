//! The measurements of the folder `experiment/`: rebound hardness devices on steel.

use crate::model::{AnyModel, strengthened};
use crate::scene::{Rate, STEPS, TABOR};
use brinell::contact::impact::{Impact, Prediction};
use brinell::contact::loading::AnyLoading;
use brinell::contact::unloading::AnyUnloading;
use brinell::contact::{Body, Model, Pair, Surface};

const RESTITUTION: &str = include_str!("../../../experiment/leeb_restitution.csv");
const DENTS: &str = include_str!("../../../experiment/leeb_dents.csv");

/// The hardnesses at which laws are compared with the device D [HV].
pub const HARDNESSES: [f64; 3] = [300.0, 600.0, 800.0];

/// Impactor of the device D: radius of the ball [m], and its impact.
const BALL: f64 = 1.5e-3;
const IMPACT: Impact = Impact { mass: 5.45e-3, speed: 2.05 };

/// Tungsten carbide: Young's modulus [Pa] and Poisson's ratio.
const CARBIDE: (f64, f64) = (620e9, 0.22);

/// Steel: Young's modulus [Pa] and Poisson's ratio.
const STEEL: (f64, f64) = (210e9, 0.3);

/// A kilogram-force per square millimetre [Pa].
const KILOGRAM_FORCE_PER_SQUARE_MILLIMETRE: f64 = 9.80665e6;

/// The hardness of a fully plastic dent over the yield strength, by Tabor.
const HARDNESS_OVER_STRENGTH: f64 = 3.0;

/// The yield strength for a Vickers hardness: a third of it [Pa].
pub fn strength_of(vickers: f64) -> f64 {
    vickers * KILOGRAM_FORCE_PER_SQUARE_MILLIMETRE / HARDNESS_OVER_STRENGTH
}

/// The rows of a table as numbers; names are NaN.
fn rows(table: &str) -> impl Iterator<Item = Vec<f64>> {
    table.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect())
}

/// The measured restitution of the device D at a Vickers hardness; `None` outside of its range.
pub fn restitution(vickers: f64) -> Option<f64> {
    let points: Vec<(f64, f64)> = rows(RESTITUTION).map(|row| (row[1], row[0])).collect();
    let pair = points.windows(2).find(|pair| (pair[0].0..=pair[1].0).contains(&vickers))?;
    let [(from, low), (to, high)] = [pair[0], pair[1]];
    Some(low + (high - low) * (vickers - from) / (to - from))
}

/// A dent from a device.
pub struct Dent {
    pub device: &'static str,
    pub vickers: f64,
    radius: f64,
    impact: Impact,
    /// Published diameter [m].
    pub diameter: f64,
    /// Published depth, that of a spherical cap with this diameter [m].
    pub depth: f64,
}

/// The published dents.
pub fn dents() -> Vec<Dent> {
    let names = DENTS.lines().skip(1).map(|line| line.split(',').next().unwrap_or_default());
    let dent = |(device, row): (&'static str, Vec<f64>)| Dent {
        device,
        vickers: row[5],
        radius: 0.5e-3 * row[1],
        impact: Impact { mass: 1e-3 * row[2], speed: row[4] },
        diameter: 1e-3 * row[7],
        depth: 1e-6 * row[6],
    };
    names.zip(rows(DENTS)).map(dent).collect()
}

/// A carbide ball with this radius [m] on steel with this strength [Pa], for the two laws.
fn model(loading: AnyLoading, unloading: AnyUnloading, radius: f64, yield_strength: f64) -> AnyModel {
    let body = |radius, (youngs_modulus, poissons_ratio)| Body { radius, youngs_modulus, poissons_ratio };
    let pair = Pair::new(&body(radius, CARBIDE), &body(f64::INFINITY, STEEL), yield_strength);
    let pair = pair.expect("a ball on a plane touches in one point");
    AnyModel::Elastoplastic(strengthened(&Model { pair, loading, unloading, surface: Surface::Dented }, 0.0))
}

/// Result of two laws for the impact of the device D on steel with this strength [Pa].
pub fn restitution_by(loading: AnyLoading, unloading: AnyUnloading, yield_strength: f64) -> Option<f64> {
    model(loading, unloading, BALL, yield_strength).restitution(&IMPACT)
}

/// Result of two laws for a dent in steel with this strength [Pa].
pub fn dent_by(loading: AnyLoading, unloading: AnyUnloading, dent: &Dent, yield_strength: f64) -> Option<Prediction> {
    model(loading, unloading, dent.radius, yield_strength).predict(&dent.impact)
}

/// Restitution of the device D, and factor of the strength HV/3, for two laws with a strength that depends on the
/// strain rate: a fixed point as in a scene.
pub fn with_rate(loading: AnyLoading, unloading: AnyUnloading, rate: &Rate, vickers: f64) -> Option<(f64, f64)> {
    let mut factor = 1.0;
    for _ in 0..STEPS {
        let prediction = model(loading, unloading, BALL, factor * strength_of(vickers)).predict(&IMPACT)?;
        let strain = TABOR * prediction.max_contact_radius / BALL;
        let more = rate.factor(strain / prediction.loading_time);
        if (more / factor - 1.0).abs() < 1e-9 {
            return Some((prediction.restitution, more));
        }
        factor = more;
    }
    None
}

/// The factor of HV/3 with which two laws give the measured rebound at this hardness; `None` if no factor between a half
/// and four does.
pub fn factor_by(loading: AnyLoading, unloading: AnyUnloading, vickers: f64) -> Option<f64> {
    let goal = restitution(vickers)?;
    let excess = |factor: f64| Some(restitution_by(loading, unloading, factor * strength_of(vickers))? - goal);
    let (mut low, mut high) = (0.5, 4.0);
    if !(excess(low)? < 0.0 && excess(high)? > 0.0) {
        return None;
    }
    while high - low > 1e-6 {
        let middle = 0.5 * (low + high);
        *(if excess(middle)? < 0.0 { &mut low } else { &mut high }) = middle;
    }
    Some(0.5 * (low + high))
}
