//! The law of Big-Alabo, Harrison and Cartmell.

use crate::physics::{mild, model, pressed, unit};
use brinell_contact::Loading;
use brinell_contact::loading::BigAlabo;

const EPSILON: f64 = f64::EPSILON;

#[test]
fn the_curve_follows_its_constants_when_they_are_others() {
    let law = BigAlabo {
        yield_pressure_factor: 1.07,
        plastic_pressure_factor: 3.0,
        second_region: 10.0,
        fully_plastic: 50.0,
        plastic_slope: 4.0,
    };
    let pair = mild();
    let unit = law.yield_point(&pair);
    // computed by hand: k_l = 1.5 sqrt(9) = 4.5, f_tep = 9^1.5 + 1 = 28, f_p = 4.5 * 40 + 28 = 208
    for (x, force) in [(1.0, 1.0), (2.0, 2.0), (10.0, 28.0), (20.0, 73.0), (50.0, 208.0), (60.0, 248.0)] {
        let got = law.segment(&pair, x * unit.indentation).force(x * unit.indentation) / unit.force;
        // a few rounding errors
        assert!((got / force - 1.0).abs() <= 8.0 * EPSILON, "{got} at {x}, not {force}");
    }
    // the mean pressure at yield is 1.07 S by definition of the yield point, and 3 S once ln(2x - 1)/3 = 1.93
    for (x, pressure) in [(1.0, 1.07), (200.0, 3.0)] {
        let at = x * unit.indentation;
        let area = std::f64::consts::PI * law.contact_radius(&pair, at).powi(2);
        let got = law.segment(&pair, at).force(at) / area / pair.yield_strength;
        assert!((got / pressure - 1.0).abs() <= 16.0 * EPSILON, "{got} S at {x}, not {pressure} S");
    }
}

#[test]
fn the_stiffness_vanishes_just_after_yield() {
    let model = model("big-alabo", "contact-radius");
    let d_y = unit(&model.pair).indentation;
    assert_eq!(pressed(&model, d_y).stiffness(), 0.0);
    assert!(pressed(&model, d_y.next_down()).stiffness() > 0.0);
}
