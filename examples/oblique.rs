//! Oblique impacts of an aluminium oxide ball on glass, as measured by Kharaz, Gorham and Salman in 2001. The example
//! prints the rebound over the angle of incidence as a table, which `docs/guide/pictures/oblique.py` draws.
//!
//! It needs only the physics: `cargo run --release --example oblique --no-default-features`.

use brinell::contact::tangential::{Friction, Stuck, Way};
use brinell::contact::{Body, Loading, Pair, loading};

/// Radius of the ball [m].
const RADIUS: f64 = 2.5e-3;
/// Its density [kg/m^3].
const DENSITY: f64 = 4000.0;
/// Speed of the impact [m/s].
const SPEED: f64 = 3.9;
/// Coefficient of friction.
const COEFFICIENT: f64 = 0.092;
/// Step of the leap-frog method [s]: about a thousand steps in a contact.
const STEP: f64 = 1.5e-8;

fn main() {
    let ball = Body { radius: RADIUS, youngs_modulus: 380e9, poissons_ratio: 0.23 };
    let glass = Body { radius: f64::INFINITY, youngs_modulus: 70e9, poissons_ratio: 0.25 };
    let pair = Pair::new(&ball, &glass, f64::INFINITY).expect("a ball touches a plane at one point");
    let friction = Friction::between(&ball, &glass, pair.modulus, COEFFICIENT);
    let curve = loading::Hertz.segment(&pair, 0.0);
    let mass = 4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3) * DENSITY;
    let inertia = 0.4 * mass * RADIUS * RADIUS;

    println!("angle_deg,e_t,omega,rebound_angle_centre");
    for degrees in 1..=88 {
        let angle = f64::from(degrees).to_radians();
        let (mut normal, mut tangential, mut spin) = (SPEED * angle.cos(), SPEED * angle.sin(), 0.0);
        let kinetic = |normal: f64, tangential: f64, spin: f64| {
            0.5 * mass * (normal * normal + tangential * tangential) + 0.5 * inertia * spin * spin
        };
        let (before, start) = (kinetic(normal, tangential, spin), tangential);
        let mut springs = Stuck::<12>::APART;
        let (mut indentation, mut lost) = (0.0, 0.0);
        while indentation > 0.0 || normal > 0.0 {
            // the contact moves with the relative speeds of the two contact points; its new force acts on the ball
            let slip = (tangential + spin * RADIUS) * STEP;
            let way = Way::straight(indentation, indentation + normal * STEP, friction.scale() * slip);
            let stored = springs.energy(&curve, indentation);
            let work = springs.mean_pull(&curve, &way) * way.shift;
            springs.advance(&curve, &way);
            indentation = way.to;
            lost += (work - springs.energy(&curve, indentation) + stored) * COEFFICIENT / friction.scale();
            let force = if indentation > 0.0 { curve.force(indentation) } else { 0.0 };
            let pull = COEFFICIENT * springs.pull(&curve, indentation);
            normal -= STEP * force / mass;
            tangential -= STEP * pull / mass;
            spin -= STEP * pull * RADIUS / inertia;
        }
        println!("{degrees},{:.5},{:.2},{:.3}", tangential / start, -spin, (tangential / -normal).atan().to_degrees());
        let balance = (kinetic(normal, tangential, spin) + lost) / before - 1.0;
        assert!(balance.abs() < 1e-4, "{degrees} degrees: the energies do not balance, {balance:e}");
    }
}
