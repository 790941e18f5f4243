//! What a step of a box costs that falls on four feet and rattles on them, with friction.
//!
//! It needs only the physics: `cargo run --release --example rattling_box --no-default-features`.

use brinell_contact::loading::{self, Hertz};
use brinell_contact::losses::{self, RestitutionFitted};
use brinell_contact::shared::{InverseMasses, SharedContact, Work, follow};
use brinell_contact::tangential::{Friction, Frictional, FrictionalModel, Normal};
use brinell_contact::unloading::{self, ContactRadius};
use brinell_contact::{Body, Contact, History, Loading, Model, Pair, Surface, Unloading};
use std::time::Instant;

/// Length of a step \[s\].
const STEP: f64 = 1e-3;

/// Number of steps.
const STEPS: usize = 300;

/// Mass of the box \[kg\], and its moments of inertia \[kg.m^2\].
const MASS: f64 = 0.3;
const INERTIA: [f64; 3] = [2e-4, 3e-4, 4e-4];

/// Where the feet are, from the center of mass \[m\].
const FEET: [[f64; 3]; 4] = [[0.03, 0.02, -0.01], [-0.03, 0.02, -0.01], [0.03, -0.02, -0.01], [-0.03, -0.02, -0.01]];

/// The distances of the feet from the ground at the start \[m\].
const GAPS: [f64; 4] = [1e-3, 1.01e-3, 1.02e-3, 1.025e-3];

/// The upper triangle of the inverse masses of all feet, in the normal and `D` tangential directions \[1/kg\].
fn inverse_masses<const D: usize>() -> Vec<f64> {
    let cross =
        |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
    let axes = [[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let rows: Vec<_> = axes[..=D].iter().flat_map(|&axis| FEET.map(|foot| (axis, cross(foot, axis)))).collect();
    let entry = |one: &([f64; 3], [f64; 3]), other: &([f64; 3], [f64; 3])| -> f64 {
        (0..3).map(|i| one.0[i] * other.0[i] / MASS + one.1[i] * other.1[i] / INERTIA[i]).sum()
    };
    rows.iter().enumerate().flat_map(|(place, one)| rows[place..].iter().map(move |other| entry(one, other))).collect()
}

fn rattle<const D: usize, L, U, X: Copy, N>(name: &str, model: &FrictionalModel<L, U, X>)
where
    L: Loading + Copy,
    U: Unloading + Copy,
    N: Normal<Loss = X>,
    Frictional<D, 16, true, N>: Contact<FrictionalModel<L, U, X>> + SharedContact<FrictionalModel<L, U, X>>,
{
    let entries = inverse_masses::<D>();
    let masses = InverseMasses::new(4 * (1 + D), &entries).expect("a triangle");
    let mut contacts = GAPS.map(|gap| Frictional::<D, 16, true, N>::start(model, gap).expect("within range"));
    let mut work = contacts.map(Work::new);
    // on a slope, with a push along it
    let (mut accelerations, mut rates) = (vec![0.0; 4 * (1 + D)], vec![0.0; 4 * (1 + D)]);
    accelerations[..4].fill(9.81);
    accelerations[4..8].fill(1.0);
    rates[4..8].fill(0.05);
    let (mut whole, mut worst, mut evaluations) = (0.0, 0.0_f64, 0);
    for _ in 0..STEPS {
        let begin = Instant::now();
        let outcome = follow(&mut contacts, |_| model, &masses, &accelerations, &mut rates, &mut work, STEP);
        let time = 1e3 * begin.elapsed().as_secs_f64();
        (whole, worst) = (whole + time, worst.max(time));
        evaluations += outcome.expect("a box is followed").evaluations;
    }
    println!("{name:32} {:9.2} {worst:9.1} {evaluations:12}", whole / STEPS as f64);
}

fn main() {
    let [ball, flat] = [5e-3, f64::INFINITY].map(|radius| Body { radius, youngs_modulus: 206e9, poissons_ratio: 0.3 });
    let pair = Pair::new(&ball, &flat, 300e6).expect("a ball touches a plane in one point");
    let surface = Surface::Dented;
    let hertz = Model { pair, loading: Hertz, unloading: ContactRadius, surface };
    let (loading, unloading) = (loading::Brinell::REFERENCE, unloading::Brinell::REFERENCE);
    let brinell = Model { pair, loading, unloading, surface };
    let friction = Friction::between(&ball, &flat, pair.modulus, 0.5);
    println!("{:32} {:>9} {:>9} {:>12}", "directions, law", "mean [ms]", "worst", "evaluations");
    let elastic = FrictionalModel { normal: hertz, friction, loss: () };
    rattle::<1, _, _, _, History>("one, without dents", &elastic);
    rattle::<2, _, _, _, History>("two, without dents", &elastic);
    let plastic = FrictionalModel { normal: brinell, friction, loss: () };
    rattle::<1, _, _, _, History>("one, with dents", &plastic);
    rattle::<2, _, _, _, History>("two, with dents", &plastic);
    let lossy = FrictionalModel { normal: brinell, friction, loss: RestitutionFitted { restitution: 0.9 } };
    rattle::<1, _, _, _, losses::History<RestitutionFitted>>("one, with dents and a loss", &lossy);
    rattle::<2, _, _, _, losses::History<RestitutionFitted>>("two, with dents and a loss", &lossy);
}
