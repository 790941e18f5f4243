//! Oblique impacts of a ball that the importer moves and turns, through the C interface of FMUs with friction.

use crate::loaded::{Instance, OK, Unit};
use crate::unit;
use std::f64::consts::PI;

/// Sets both rates and makes a step.
fn go(instance: &mut Instance, time: &mut f64, (normal, tangential): (f64, f64), step: f64) {
    instance.set_one("indentation_rate", normal);
    instance.set_one("tangential_rate", tangential);
    assert_eq!(instance.step(*time, step), OK, "{}", instance.message());
    *time += step;
}

/// The ball after an impact at `degrees` from the normal, moved by the importer: tangential restitution and spin [rad/s].
fn rebound(instance: &mut Instance, degrees: f64, step: f64) -> (f64, f64) {
    let mass = 4.0 / 3.0 * PI * 2.5e-3_f64.powi(3) * 4000.0;
    let angle = degrees.to_radians();
    let (mut normal, mut tangential, mut spin) = (3.9 * angle.cos(), 3.9 * angle.sin(), 0.0);
    let (before, mut time) = (tangential, 0.0);
    loop {
        go(instance, &mut time, (normal, tangential + spin * 2.5e-3), step);
        let (force, pull) = (instance.real("force"), instance.real("tangential_force"));
        if force == 0.0 && normal < 0.0 {
            return (tangential / before, spin);
        }
        normal -= step * force / mass;
        tangential -= step * pull / mass;
        spin -= step * pull * 2.5e-3 / (0.4 * mass * 2.5e-3 * 2.5e-3);
    }
}

#[test]
fn rebounds_through_the_unit_agree_with_the_measurement() {
    let unit = Unit::load(&unit::scene("oblique"));
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/experiment/oblique_elastic.csv");
    let text = std::fs::read_to_string(path).expect("a table of the project");
    let (mut restitutions, mut spins) = (Vec::new(), Vec::new());
    for row in text.lines().skip(1).map(|line| line.rsplit(',').collect::<Vec<_>>()) {
        let number = |text: &str| text.parse::<f64>().expect("a number");
        let (value, degrees, quantity) = (number(row[0]), number(row[1]), row[2]);
        let of = match quantity {
            "e_t" => &mut restitutions,
            "omega" => &mut spins,
            _ => continue,
        };
        let (restitution, spin) = rebound(&mut unit.ready(), degrees, 3e-8);
        of.push(if quantity == "e_t" { restitution - value } else { -spin - value });
    }
    let rms = |errors: &[f64]| (errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64).sqrt();
    println!("e_t {:.4} ({}), spin {:.1} rad/s ({})", rms(&restitutions), restitutions.len(), rms(&spins), spins.len());
    assert!(restitutions.len() > 10 && rms(&restitutions) <= 0.02);
    assert!(spins.len() > 10 && rms(&spins) <= 30.0);
}
