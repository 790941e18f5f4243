//! A discrete-element loop in forty lines: a row of steel balls, of which the first hits the others.
//!
//! It needs the physics alone: `cargo run --release --example chain --no-default-features`.

use brinell_contact::loading::Brinell as Loading;
use brinell_contact::unloading::Brinell as Unloading;
use brinell_contact::{Body, History, Model, Pair, Surface};

/// Radius of the balls [m].
const RADIUS: f64 = 10e-3;
/// Density of steel [kg/m^3].
const DENSITY: f64 = 7850.0;
/// Step of the leap-frog [s]: some hundred of them in a contact.
const STEP: f64 = 2e-7;

fn main() {
    let ball = Body { radius: RADIUS, youngs_modulus: 206e9, poissons_ratio: 0.3 };
    // the laws let one of two equal balls yield: the strength is that of the softer one
    let pair = Pair::new(&ball, &ball, 300e6).expect("two balls touch at one point");
    let model = Model { pair, loading: Loading::REFERENCE, unloading: Unloading::REFERENCE, surface: Surface::Dented };
    let mass = 4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3) * DENSITY;

    let mut speeds = [1.0, 0.0, 0.0, 0.0, 0.0];
    let mut contacts = [History::start(&model, 0.0).expect("a gap of zero is within range"); 4];
    let kinetic = |speeds: &[f64]| speeds.iter().map(|speed| 0.5 * mass * speed * speed).sum::<f64>();
    let before = kinetic(&speeds);
    for _ in 0..2000 {
        // each contact advances with the closing speed of its two balls, and its new force acts on both
        for (index, contact) in contacts.iter_mut().enumerate() {
            let closing = speeds[index] - speeds[index + 1];
            contact.advance(&model, closing * STEP).expect("the indentation is within range");
        }
        for (index, contact) in contacts.iter().enumerate() {
            let change = contact.force() * STEP / mass;
            speeds[index] -= change;
            speeds[index + 1] += change;
        }
    }
    let dissipated: f64 = contacts.iter().map(|contact| contact.dissipated_energy(&model)).sum();
    println!("speeds {speeds:.4?} m/s");
    for (index, contact) in contacts.iter().enumerate() {
        println!("contact {index}: dent {:.2} um", 1e6 * contact.residual_indentation(&model));
    }
    let balance = (kinetic(&speeds) + dissipated) / before - 1.0;
    println!("dissipated {:.1} %, balance of energies {balance:.1e}", 100.0 * dissipated / before);
    assert!(balance.abs() < 1e-3, "the energies do not balance");
}
