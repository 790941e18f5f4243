//! Oblique impacts compared with measurements, finite elements and the limit of full sliding.

use crate::friction::{Ball, Rebound, file, hertz};
use brinell_contact::tangential::{Friction, Motion, PlayOperator};
use brinell_contact::{Body, Pair, Segment};
use std::f64::consts::PI;

/// A thousandth of the duration of an impact with Hertz's law [s].
fn step_of(ball: &Ball, modulus: f64) -> f64 {
    let speed_and_stiffness = (ball.mass * ball.mass / (ball.radius * modulus * modulus * ball.normal)).powf(0.2);
    2.87 * speed_and_stiffness * (15.0_f64 / 16.0).powf(0.4) / 1000.0
}

/// The impact of `ball` with an elastic contact.
fn impact(ball: Ball, curve: &Segment, modulus: f64, friction: &Friction) -> Rebound {
    let step = step_of(&ball, modulus);
    let mut stuck = PlayOperator::<1, 12>::APART;
    let mut indentation = 0.0;
    ball.impact(step, |rise, shift| {
        stuck.advance(curve, &Motion::straight(indentation, indentation + rise, [friction.scale() * shift]));
        indentation += rise;
        let forces = (curve.force(indentation), friction.coefficient * stuck.pull(curve, indentation)[0]);
        (indentation > 0.0).then_some(forces)
    })
}

/// The same with a single tangential spring, as in discrete-element codes: Mindlin's stiffness `8 G* a` and Coulomb's
/// limit. If it `rescales`, the force is reduced in unloading by the ratio of the contact radii.
fn impact_with_one_spring(ball: Ball, curve: &Segment, modulus: f64, friction: &Friction, rescales: bool) -> Rebound {
    let step = step_of(&ball, modulus);
    let (mut indentation, mut pull) = (0.0, 0.0);
    ball.impact(step, |rise, shift| {
        let (before, after) = (curve.stiffness(indentation), curve.stiffness(indentation + rise));
        if rescales && rise < 0.0 {
            pull *= after / before;
        }
        indentation += rise;
        let limit = friction.coefficient * curve.force(indentation);
        pull = (pull + friction.stiffness_ratio * 0.5 * (before + after) * shift).clamp(-limit, limit);
        (indentation > 0.0).then_some((curve.force(indentation), pull))
    })
}

/// A method to compute an impact from the ball, the curve of the normal force, the effective modulus and friction.
type Computation = fn(Ball, &Segment, f64, &Friction) -> Rebound;

/// The impact of Kharaz, Gorham and Salman at `degrees` from the normal.
fn kharaz(degrees: f64) -> Rebound {
    kharaz_with(impact, degrees)
}

/// The same with another method.
fn kharaz_with(impact: Computation, degrees: f64) -> Rebound {
    let alumina = Body { radius: 2.5e-3, youngs_modulus: 380e9, poissons_ratio: 0.23 };
    let glass = Body { radius: f64::INFINITY, youngs_modulus: 70e9, poissons_ratio: 0.25 };
    let pair = Pair::new(&alumina, &glass, f64::INFINITY).expect("a ball on a plane");
    let friction = Friction::between(&alumina, &glass, pair.modulus, 0.092);
    let mass = 4.0 / 3.0 * PI * 2.5e-3_f64.powi(3) * 4000.0;
    let angle = degrees.to_radians();
    let ball = Ball { mass, radius: 2.5e-3, normal: 3.9 * angle.cos(), tangential: 3.9 * angle.sin(), spin: 0.0 };
    impact(ball, &hertz(pair.modulus, pair.radius), pair.modulus, &friction)
}

/// Root-mean-square difference between `computed` and measured values of a `quantity`, over all digitisations.
fn rms(name: &str, quantity: &str, computed: impl Fn(f64) -> f64) -> f64 {
    let text = file(name);
    // value, place and name of the quantity are the last three fields
    let rows = text.lines().skip(1).map(|line| line.rsplit(',').collect::<Vec<_>>());
    let mut errors = Vec::new();
    for row in rows.filter(|row| row[2] == quantity) {
        let number = |text: &str| text.parse::<f64>().expect("a number");
        errors.push(computed(number(row[1])) - number(row[0]));
    }
    assert!(errors.len() > 10, "{} values of {quantity}", errors.len());
    (errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64).sqrt()
}

const MEASURED: &str = "data/experiment/oblique_elastic.csv";

#[test]
fn rebounds_of_aluminium_oxide_from_glass_agree_with_the_measurement() {
    let restitution = rms(MEASURED, "e_t", |degrees| kharaz(degrees).restitution.1);
    let spin = rms(MEASURED, "omega", |degrees| -kharaz(degrees).ball.spin);
    let angle = rms(MEASURED, "rebound_angle_centre", |degrees| kharaz(degrees).angle);
    println!("rms of e_t {restitution:.4}, of the spin {spin:.1} rad/s, of the rebound angle {angle:.2} degrees");
    assert!(restitution <= 0.02, "{restitution}");
    assert!(spin <= 30.0, "{spin}");
    assert!(angle <= 1.0, "{angle}");
}

#[test]
fn a_single_spring_for_the_contact_has_a_far_larger_error() {
    let rescaled: Computation =
        |ball, curve, modulus, friction| impact_with_one_spring(ball, curve, modulus, friction, true);
    let plain: Computation =
        |ball, curve, modulus, friction| impact_with_one_spring(ball, curve, modulus, friction, false);
    let [rescaled, plain] =
        [rescaled, plain].map(|way| rms(MEASURED, "e_t", |degrees| kharaz_with(way, degrees).restitution.1));
    println!("rms of e_t with one spring: {plain:.4}, rescaled {rescaled:.4}");
    assert!(rescaled > 0.05 && plain > 0.08, "{rescaled} {plain}");
}

/// The impact of Chung and Ooi's test 5: equal bodies, `psi1 = tan(angle)/mu`.
fn chung_and_ooi(psi: f64) -> Rebound {
    let body = Body { radius: 0.01, youngs_modulus: 208e9, poissons_ratio: 0.3 };
    let flat = Body { radius: f64::INFINITY, ..body };
    let pair = Pair::new(&body, &flat, f64::INFINITY).expect("a ball on a plane");
    let friction = Friction::between(&body, &flat, pair.modulus, 0.3);
    let ball = Ball { mass: 0.0033, radius: 0.01, normal: 1.0, tangential: 0.3 * psi, spin: 0.0 };
    impact(ball, &hertz(pair.modulus, pair.radius), pair.modulus, &friction)
}

#[test]
fn rebounds_of_equal_bodies_agree_with_finite_elements() {
    let elements = "data/experiment/oblique_elastic_finite_elements.csv";
    let slip = rms(elements, "psi2", |psi| chung_and_ooi(psi).slip / 0.3);
    let spin = rms(elements, "omega_n", |psi| chung_and_ooi(psi).ball.spin * 0.01 / 0.3);
    println!("rms of psi2 {slip:.4}, of the spin {spin:.4}");
    assert!(slip <= 0.07, "{slip}");
    assert!(spin <= 0.1, "{spin}");
}
