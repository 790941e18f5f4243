//! Johnson's loading curve: his mean pressures, the geometry in between, and his limit of the restitution.

use crate::physics::{AnyModel, MASS, mild, model, pair_of, unit};
use crate::printed::{agrees, agrees_in_digits};
use brinell_contact::impact::{Impact, predict};
use brinell_contact::loading::{AnyLoading, Johnson};
use brinell_contact::{Loading, Pair, Regime};
use std::f64::consts::PI;

/// Mean pressure over the yield strength, and `E* a/(S R)`, at `x` yield indentations.
fn pressure_and_strain(law: &Johnson, pair: &Pair, x: f64) -> (f64, f64) {
    let at = x * law.yield_point(pair).indentation;
    let radius = law.contact_radius(pair, at);
    let pressure = law.segment(pair, at).force(at) / (PI * radius * radius) / pair.yield_strength;
    (pressure, pair.modulus * radius / (pair.yield_strength * pair.radius))
}

#[test]
fn the_mean_pressure_is_that_of_the_expanding_cavity_between_yield_and_full_plasticity() {
    let johnsons = Johnson { yield_pressure_factor: 1.07, plastic_pressure_factor: 3.0 };
    for (pair, law) in [(mild(), Johnson::REFERENCE), (pair_of(0.03, 16e9, 8e6), johnsons)] {
        for x in [1.0, 1.5, 2.9, 3.0, 5.0, 30.0, 100.0, 400.0, 410.0, 800.0, 1e4] {
            let (pressure, strain) = pressure_and_strain(&law, &pair, x);
            let cavity = 2.0 / 3.0 * (1.0 + (strain / 3.0).ln());
            let expected = cavity.clamp(law.yield_pressure_factor, law.plastic_pressure_factor);
            assert!((pressure / expected - 1.0).abs() < 1e-14, "{pressure} S at {x}, not {expected} S");
        }
    }
}

#[test]
fn the_contact_is_fully_plastic_at_73_6_and_not_at_johnsons_30_to_40() {
    let law = Johnson::REFERENCE;
    let pair = mild();
    let d_y = law.yield_point(&pair).indentation;
    let mut plastic = 0.0;
    while law.regime(&pair, plastic) != Regime::FullyPlastic {
        plastic = law.next_corner(&pair, plastic);
    }
    // 3 exp(1.5 * 2.8 - 1)
    let (pressure, strain) = pressure_and_strain(&law, &pair, plastic / d_y);
    agrees_in_digits("E* a/(S R)", strain, 73.5976, 6);
    agrees_in_digits("mean pressure", pressure, 2.8, 12);
    let (pressure, strain) = pressure_and_strain(&law, &pair, 100.0);
    assert!((36.0..37.0).contains(&strain) && (2.3..2.4).contains(&pressure), "{pressure} S at {strain}");
}

#[test]
fn the_slope_jumps_as_documented() {
    let law = Johnson::REFERENCE;
    let (pair, point) = (mild(), law.yield_point(&mild()));
    // boundary in yield indentations, slope below and above [F_y/d_y]
    let borders = [(1.0, 1.5, 2.0), (2.958_032_935_524, 2.0, 2.606), (403.671_250_290_7, 5.697, 5.091)];
    let mut corner = 0.0;
    for (border, below, above) in borders {
        corner = law.next_corner(&pair, corner);
        agrees_in_digits("border", corner / point.indentation, border, 12);
        for (at, printed) in [(corner * (1.0 - 1e-9), below), (corner * (1.0 + 1e-9), above)] {
            let slope = law.segment(&pair, at).stiffness(at) * point.indentation / point.force;
            agrees(&format!("slope at {border}"), slope, printed, 3);
        }
    }
}

#[test]
fn the_curve_is_above_hertz_up_to_2_618_yield_indentations() {
    let (pair, law) = (mild(), Johnson::REFERENCE);
    let above = |x: f64| {
        let at = x * law.yield_point(&pair).indentation;
        law.segment(&pair, at).force(at) > pair.hertz_stiffness() * at.powf(1.5)
    };
    // 2x - 1 = x^1.5 at the square of the golden ratio
    let end = 1.25f64.sqrt() + 1.5;
    assert!(above(1.001) && above(2.0) && above(end - 1e-6) && !above(end + 1e-6));
    assert!((3..4000).all(|x| !above(f64::from(x))), "never again");
}

#[test]
fn just_beyond_yield_an_impact_gains_energy_as_documented() {
    let model = model("johnson", "contact-radius");
    let point = model.loading.yield_point(&model.pair);
    let yield_speed = (0.8 * point.force * point.indentation / MASS).sqrt();
    let restitution = |ratio: f64| {
        predict(&model, &Impact { mass: MASS, speed: ratio * yield_speed }).expect("an ordinary impact").restitution
    };
    let largest = (0..2000).map(|step| restitution(1.0 + 1e-3 * f64::from(step))).fold(0.0, f64::max);
    assert!((largest - 1.0178).abs() < 5e-5, "{largest}");
    assert!(restitution(1.58) > 1.0 && restitution(1.60) < 1.0);
}

/// Fully plastic, `a^2 = 2 R d` from the surface on: the limit of Johnson's section 11.5, with tables computed from it.
/// In units of `F_y d_y`, the work of the present curve beyond the boundary `u_p` is `(c/p_Y) u^2/4 + K` with
/// `K = 0.15 - (u_p^2 - u_2^2)/(24 p_Y)`; that of the limit is the same without `K`. At a given energy `W`, `u` therefore
/// differs by the factor `s = (1 - K/W)^(1/2)`, which describes how the limit is approached: `K` is -24600 for `c = 2.8`,
/// `W = 0.4 (v/v_y)^2`.
#[test]
fn fast_impacts_approach_the_fully_plastic_limit_as_its_asymptotics_say() {
    // speeds [m/s], restitution, largest force [N], largest indentation [m] of the limit
    #[rustfmt::skip]
    const LIMIT: [(f64, [[f64; 3]; 3]); 2] = [
        (2.8, [[5.0, 20.0, 100.0], [0.297_563_67, 0.210_409_29, 0.140_709_17], [1646.716, 6586.864, 32934.32]]),
        (3.0, [[5.0, 20.0, 100.0], [0.310_675_43, 0.219_680_71, 0.146_909_34], [1704.513, 6818.052, 34090.26]]),
    ];
    for (plastic_pressure_factor, [speeds, restitutions, forces]) in LIMIT {
        let law = Johnson { plastic_pressure_factor, ..Johnson::REFERENCE };
        let model = AnyModel { loading: AnyLoading::Johnson(law), ..model("hertz", "contact-radius") };
        let unit = unit(&model.pair);
        let border = |factor: f64| (4.0 / (1.1 * PI) * (1.5 * factor - 1.0).exp()).powi(2);
        let excess = 0.15 - (border(plastic_pressure_factor).powi(2) - border(1.1).powi(2)) / (24.0 * 1.1);
        for ((speed, limit), limit_force) in speeds.into_iter().zip(restitutions).zip(forces) {
            let prediction = predict(&model, &Impact { mass: MASS, speed }).expect("an ordinary impact");
            assert_eq!(prediction.regime, Regime::FullyPlastic, "{speed} m/s");
            let energy = prediction.energy / (unit.force * unit.indentation);
            let factor = (1.0 - excess / energy).sqrt();
            let what = format!("{plastic_pressure_factor} S at {speed} m/s");
            agrees(&what, prediction.restitution / factor.powf(0.75), limit, 8);
            agrees_in_digits(&what, prediction.max_force / factor, limit_force, 7);
            // d = (u + 1) d_y/2 for a given u; the limit has u d_y/2 = a^2/(2 R)
            let hertzian = prediction.max_contact_radius.powi(2) / (2.0 * model.pair.radius);
            let depth = hertzian + 0.5 * unit.indentation;
            assert!((prediction.max_indentation / depth - 1.0).abs() < 1e-14, "{what}");
        }
        // (3/8) K/W: a distance from the limit of 0.32 % at 5 m/s for 2.8 S, and at 100 m/s of 8e-6 for 2.8 S and 3e-5 for 3.0
        // S
        let restitution =
            |speed| predict(&model, &Impact { mass: MASS, speed }).expect("an ordinary impact").restitution;
        assert!((restitution(100.0) / restitutions[2] - 1.0).abs() < 3e-5);
    }
}
