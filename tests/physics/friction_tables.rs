//! The tangential force on elastic curves compared with tables from another program: histories, and impacts in steps.

use crate::friction::{self, Ball, Rebound, assert_close, hertz, table};
use brinell_contact::tangential::{Friction, Motion, PlayOperator};
use brinell_contact::{Body, Pair, Segment};
use std::f64::consts::PI;

/// One material, 4 G*/E* = 2 (1 - nu)/(2 - nu).
const RATIO: f64 = 1.4 / 1.7;
const COEFFICIENT: f64 = 0.3;

/// A list that is never full.
const UNBOUNDED: usize = 512;

#[test]
fn histories_on_hertz_curve_have_the_forces_and_energies_of_the_table() {
    let curve = hertz(2e11, 5e-3);
    let kappa = RATIO / COEFFICIENT;
    let mut stuck = PlayOperator::<1, UNBOUNDED>::APART;
    let (mut case, mut indentation, mut energy) = (String::new(), 0.0, 0.0);
    let mut worst = 0.0_f64;
    for row in table("elastic") {
        if row.case != case {
            (case, indentation, energy) = (row.case.clone(), 0.0, 0.0);
            stuck = PlayOperator::APART;
        }
        let (rise, shift) = (row.get("d_delta"), kappa * row.get("d_s"));
        // the table begins at the touch
        let way = Motion { normal: rise, ..Motion::straight(indentation, indentation + rise, [shift]) };
        let mean = COEFFICIENT * stuck.mean_pull(&curve, &way)[0];
        stuck.advance(&curve, &way);
        indentation += rise;
        let what = format!("{case}, row {}", row.get("row"));
        let force = curve.force(indentation);
        let size = COEFFICIENT * 600.0;
        assert_close(&format!("{what}, force"), force, row.get("F"), 600.0, 1e-13);
        let pull = COEFFICIENT * stuck.pull(&curve, indentation)[0];
        assert_close(&format!("{what}, tangential force"), pull, row.get("T"), size, 1e-12);
        assert_close(&format!("{what}, mean"), mean, row.get("mean_T"), size, 1e-12);
        let stored = COEFFICIENT / kappa * stuck.energy(&curve, indentation);
        assert_close(&format!("{what}, energy"), stored, row.get("energy"), 1e-4, 1e-12);
        let lost = mean * shift / kappa - (stored - energy);
        assert_close(&format!("{what}, friction work"), lost, row.get("friction_work"), 1e-4, 1e-12);
        assert_eq!(stuck.segments(), row.get("segments") as usize, "{what}");
        energy = stored;
        worst = worst.max((pull - row.get("T")).abs() / size);
    }
    println!("worst error of T: {worst:.1e} of the largest");
}

/// The impact of `ball` with an elastic contact, in steps of `step` [s].
fn impact<const N: usize>(ball: Ball, curve: &Segment, friction: &Friction, step: f64) -> Rebound {
    let mut stuck = PlayOperator::<1, N>::APART;
    let mut indentation = 0.0;
    let kappa = friction.scale();
    ball.impact(step, |rise, shift| {
        stuck.advance(curve, &Motion::straight(indentation, indentation + rise, [kappa * shift]));
        indentation += rise;
        let forces = (curve.force(indentation), friction.coefficient * stuck.pull(curve, indentation)[0]);
        (indentation > 0.0).then_some(forces)
    })
}

fn assert_rebound(what: &str, found: &Rebound, row: &friction::Row, tolerance: f64) {
    assert_eq!(found.steps, row.get("steps") as u32, "{what}");
    assert_close(&format!("{what}, e_n"), found.restitution.0, row.get("e_n"), 1.0, tolerance);
    let spin = row.get("omega");
    assert_close(&format!("{what}, spin"), found.ball.spin, spin, spin.abs().max(0.02), tolerance);
    assert_close(&format!("{what}, slip"), found.slip, row.get("slip_after"), 1.0, tolerance);
    assert_close(&format!("{what}, angle"), found.angle, row.get("rebound_deg"), 90.0, tolerance);
    if !row.get("e_t").is_nan() {
        assert_close(&format!("{what}, e_t"), found.restitution.1, row.get("e_t"), 1.0, tolerance);
    }
}

#[test]
fn impacts_of_a_ball_of_aluminium_oxide_on_glass_have_the_rebounds_of_the_table() {
    let alumina = Body { radius: 2.5e-3, youngs_modulus: 380e9, poissons_ratio: 0.23 };
    let glass = Body { radius: f64::INFINITY, youngs_modulus: 70e9, poissons_ratio: 0.25 };
    let pair = Pair::new(&alumina, &glass, f64::INFINITY).expect("a ball on a plane");
    let friction = Friction::between(&alumina, &glass, pair.modulus, 0.092);
    let curve = hertz(pair.modulus, pair.radius);
    let mass = 4.0 / 3.0 * PI * 2.5e-3_f64.powi(3) * 4000.0;
    for row in table("impact").iter().filter(|row| row.case == "kharaz") {
        let angle = row.get("angle_deg_or_psi1").to_radians();
        let (normal, tangential) = (3.9 * angle.cos(), 3.9 * angle.sin());
        let ball = Ball { mass, radius: 2.5e-3, normal, tangential, spin: 0.0 };
        let found = match row.get("limit") {
            0.0 => impact::<UNBOUNDED>(ball, &curve, &friction, row.get("h")),
            _ => impact::<12>(ball, &curve, &friction, row.get("h")),
        };
        let what = format!("{} degrees, limit {}", row.get("angle_deg_or_psi1"), row.get("limit"));
        assert_rebound(&what, &found, row, 1e-9);
    }
}

#[test]
fn impacts_of_equal_bodies_have_the_rebounds_of_maw_barber_and_fawcett() {
    let friction = Friction { coefficient: 0.1, stiffness_ratio: RATIO };
    let curve = hertz(1.0, 1.0);
    for row in table("impact").iter().filter(|row| row.case == "maw") {
        let tangential = row.get("angle_deg_or_psi1") / friction.scale();
        let ball = Ball { mass: 1.0, radius: 1.0, normal: 1.0, tangential, spin: 0.0 };
        let found = impact::<12>(ball, &curve, &friction, row.get("h"));
        assert_rebound(&format!("psi1 = {}", row.get("angle_deg_or_psi1")), &found, row, 1e-9);
    }
}
