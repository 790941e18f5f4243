//! Elastic oblique impacts: of an aluminium oxide ball on glass, as measured by Kharaz, Gorham and Salman in 2001, and of
//! equal bodies, as computed by Chung and Ooi in 2011 with finite elements. The example prints the rebounds as two tables,
//! which `docs/guide/pictures/oblique.py` draws.
//!
//! It needs only the physics: `cargo run --release --example oblique --no-default-features`.

use brinell_contact::tangential::{Friction, Motion, PlayOperator};
use brinell_contact::{Body, Loading, Pair, Segment, loading};

/// Steps of the leap-frog method in a contact, about.
const STEPS: f64 = 1000.0;

/// A ball that hits a flat body.
struct Impact {
    curve: Segment,
    friction: Friction,
    /// [kg]
    mass: f64,
    /// [m]
    radius: f64,
    /// Step [s].
    step: f64,
}

/// A ball: closing speed along the normal, tangential speed of the centre [m/s], and spin times radius [m/s].
#[derive(Clone, Copy)]
struct Ball {
    normal: f64,
    tangential: f64,
    spin: f64,
}

impl Impact {
    /// The impact of a ball with this density [kg/m^3] at about this speed [m/s].
    fn new(ball: Body, flat: Body, coefficient: f64, density: f64, speed: f64) -> Impact {
        let pair = Pair::new(&ball, &flat, f64::INFINITY).expect("a ball touches a plane at one point");
        let friction = Friction::between(&ball, &flat, pair.modulus, coefficient);
        let mass = 4.0 / 3.0 * std::f64::consts::PI * ball.radius.powi(3) * density;
        // Hertz's contact time
        let time = 2.87 * (mass * mass / (ball.radius * pair.modulus * pair.modulus * speed)).powf(0.2);
        let curve = loading::Hertz.segment(&pair, 0.0);
        Impact { curve, friction, mass, radius: ball.radius, step: time / STEPS }
    }

    fn kinetic_energy(&self, ball: Ball) -> f64 {
        let squares = ball.normal * ball.normal + ball.tangential * ball.tangential + 0.4 * ball.spin * ball.spin;
        0.5 * self.mass * squares
    }

    /// The ball after its impact.
    fn rebound(&self, start: Ball) -> Ball {
        let Impact { curve, friction, mass, step, .. } = self;
        let coefficient = friction.coefficient;
        let (mut ball, mut springs) = (start, PlayOperator::<1, 12>::APART);
        let (mut indentation, mut lost) = (0.0, 0.0);
        while indentation > 0.0 || ball.normal > 0.0 {
            // the contact moves with the relative speeds of the two contact points; its new force acts on the ball
            let slip = (ball.tangential + ball.spin) * step;
            let way = Motion::straight(indentation, indentation + ball.normal * step, [friction.scale() * slip]);
            let stored = springs.energy(curve, indentation);
            let work = springs.mean_pull(curve, &way)[0] * way.shift[0];
            springs.advance(curve, &way);
            indentation = way.to;
            lost += (work - springs.energy(curve, indentation) + stored) * coefficient / friction.scale();
            let force = if indentation > 0.0 { curve.force(indentation) } else { 0.0 };
            let pull = coefficient * springs.pull(curve, indentation)[0];
            ball.normal -= step * force / mass;
            ball.tangential -= step * pull / mass;
            ball.spin -= 2.5 * step * pull / mass;
        }
        let balance = (self.kinetic_energy(ball) + lost) / self.kinetic_energy(start) - 1.0;
        assert!(balance.abs() < 1e-4, "the energies do not balance, {balance:e}");
        ball
    }
}

fn main() {
    let alumina = Body { radius: 2.5e-3, youngs_modulus: 380e9, poissons_ratio: 0.23 };
    let glass = Body { radius: f64::INFINITY, youngs_modulus: 70e9, poissons_ratio: 0.25 };
    let measured = Impact::new(alumina, glass, 0.092, 4000.0, 3.9);
    println!("angle_deg,e_t,omega,rebound_angle_centre");
    for degrees in 1..=88 {
        let angle = f64::from(degrees).to_radians();
        let start = Ball { normal: 3.9 * angle.cos(), tangential: 3.9 * angle.sin(), spin: 0.0 };
        let Ball { normal, tangential, spin } = measured.rebound(start);
        let back = (tangential / -normal).atan().to_degrees();
        println!("{degrees},{:.5},{:.2},{back:.3}", tangential / start.tangential, -spin / measured.radius);
    }
    // Maw's numbers: tan(angle)/mu, and the slip speed after the impact over mu times the normal speed
    let steel = Body { radius: 0.01, youngs_modulus: 208e9, poissons_ratio: 0.3 };
    let flat = Body { radius: f64::INFINITY, ..steel };
    let coefficient = 0.3;
    let elements = Impact::new(steel, flat, coefficient, 7850.0, 1.0);
    println!("\npsi_1,psi_2");
    for part in 1..=65 {
        let psi = 0.2 * f64::from(part);
        let ball = elements.rebound(Ball { normal: 1.0, tangential: coefficient * psi, spin: 0.0 });
        println!("{psi:.1},{:.4}", (ball.tangential + ball.spin) / coefficient);
    }
}
