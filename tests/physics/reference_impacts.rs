//! Impacts compared with tables of independently computed numbers, as printed, unless a comment names another source.

use crate::physics::{AnyModel, MASS, mild, model, unit};
use crate::printed::{agrees, agrees_in_digits, closure};
use brinell_contact::impact::{Impact, Prediction, predict};
use brinell_contact::{Body, Loading, Pair, Surface};

fn impact(model: &AnyModel, speed: f64) -> Prediction {
    predict(model, &Impact { mass: MASS, speed }).expect("an ordinary impact")
}

#[test]
fn restitution_has_its_extrema_where_a_search_with_40_digits_finds_them() {
    // For each closure: (x_m, v/v_y, e) with their decimals, of the minimum after yield and of the maximum after that. e is as
    // printed. The positions are not: the printed ones come from a coarser search and are off by up to 0.01 d_y and 0.03 v_y.
    // These come from a golden-section search on the closed forms with 40 digits, independent of this code.
    type Printed = [(f64, i32); 3];
    #[rustfmt::skip]
    const EXTREMA: [(&str, Printed, Printed); 5] = [
        ("contact-radius", [(1.629, 3), (1.699, 3), (0.84256, 5)], [(4.733, 3), (6.103, 3), (0.90042, 5)]),
        ("thornton", [(1.651, 3), (1.723, 3), (0.78085, 5)], [(14.414, 3), (26.33, 2), (0.97644, 5)]),
        ("original-radius", [(1.594, 3), (1.661, 3), (0.82452, 5)], [(14.228, 3), (25.89, 2), (0.99095, 5)]),
        ("deformed-radius", [(1.644, 3), (1.715, 3), (0.81482, 5)], [(4.064, 3), (5.009, 3), (0.86189, 5)]),
        ("rd165", [(1.644, 3), (1.715, 3), (0.82112, 5)], [(4.064, 3), (5.009, 3), (0.86855, 5)]),
    ];
    let unit = unit(&mild());
    for (name, minimum, maximum) in EXTREMA {
        let model = closure(name);
        let restitution_and_speed = |x: f64| {
            let largest = x * unit.indentation;
            let work = model.loading.work(&model.pair, largest);
            let given_back = model.recovered_work(largest, largest);
            ((given_back / work).sqrt(), (work / (0.4 * unit.force * unit.indentation)).sqrt())
        };
        // steps of 1e-4 d_y: a fifth of half a unit of the last printed digit, and e is flat there
        for (what, printed, from, sign) in [("minimum", minimum, 1.001, 1.0), ("maximum", maximum, 2.5, -1.0)] {
            let mut best = (from, f64::INFINITY);
            for step in 0..250_000 {
                let x = from + 1e-4 * f64::from(step);
                let value = sign * restitution_and_speed(x).0;
                best = if value < best.1 { (x, value) } else { best };
                if what == "minimum" && x > 4.0 {
                    break;
                }
            }
            let (restitution, speed) = restitution_and_speed(best.0);
            let found = [best.0, speed, restitution];
            for (value, (number, decimals)) in found.into_iter().zip(printed) {
                agrees(&format!("{name}, {what}"), value, number, decimals);
            }
        }
    }
}

#[test]
fn far_beyond_yield_restitution_falls_with_the_printed_power_of_the_speed() {
    const POWER: [(&str, f64); 4] =
        [("contact-radius", -0.25), ("thornton", -0.25), ("deformed-radius", -0.25), ("original-radius", -1.0 / 6.0)];
    for (name, power) in POWER {
        let restitution = |speed| impact(&closure(name), speed).restitution;
        let measured = (restitution(2e4) / restitution(1e4)).log2();
        // at 5e6 v_y the force is a pure line within 1e-5, and so is the power
        assert!((measured - power).abs() < 1e-4, "{name}: {measured}");
    }
}

#[test]
fn hertz_agrees_with_the_four_benchmark_impacts() {
    const RIGID: Body = Body { radius: f64::INFINITY, youngs_modulus: f64::INFINITY, poissons_ratio: 0.0 };
    // name, E [Pa], nu, density [kg/m^3], radius [m], closing speed [m/s], two spheres?, d_m [m], F_m [N], t_c [s]
    #[rustfmt::skip]
    let cases = [
        ("glass", 48e9, 0.20, 2800.0, 0.01, 20.0, true, 2.74112702e-4, 1.06968890e4, 4.03394557e-5),
        ("limestone", 20e9, 0.25, 2500.0, 0.01, 20.0, true, 3.68304026e-4, 7.10824128e3, 5.42010049e-5),
        ("aluminium", 70e9, 0.30, 2699.0, 0.1, 0.2, false, 4.97171752e-5, 1.13698583e4, 7.31656641e-4),
        ("magnesium", 40e9, 0.35, 1800.0, 0.1, 0.2, false, 5.21232883e-5, 7.23268103e3, 7.67065905e-4),
    ];
    for (name, youngs_modulus, poissons_ratio, density, radius, speed, two, indentation, force, time) in cases {
        let sphere = Body { radius, youngs_modulus, poissons_ratio };
        let sphere_mass = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3) * density;
        let (target, mass) = if two { (sphere, sphere_mass / 2.0) } else { (RIGID, sphere_mass) };
        let pair = Pair::new(&sphere, &target, f64::INFINITY).expect("a sphere touches in one point");
        let model = AnyModel { pair, surface: Surface::Dented, ..model("hertz", "contact-radius") };
        let prediction = predict(&model, &Impact { mass, speed }).unwrap_or_else(|| panic!("{name}: no prediction"));
        agrees_in_digits(name, prediction.max_indentation, indentation, 9);
        agrees_in_digits(name, prediction.max_force, force, 9);
        agrees_in_digits(name, prediction.contact_time(), time, 9);
    }
}

#[test]
fn an_impact_whose_energy_underflows_has_no_prediction() {
    let model = model("big-alabo", "contact-radius");
    for (mass, speed) in [(1e-200, 1e-100), (1e-20, 1e-150)] {
        assert_eq!(predict(&model, &Impact { mass, speed }), None, "{mass} kg at {speed} m/s");
    }
}
