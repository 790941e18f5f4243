//! The law `brinell` for targets that harden and have another Poisson's ratio as well: the theory of first yield, and the limits of hard and
//! deep. The law assumes that the two effects are factors of one strength.

use crate::law_materials::{force, on_steel};
use crate::physics::{AnyModel, logarithmic, unit};
use brinell_contact::{Loading, Pair};

const RATIOS: [f64; 6] = [0.2, 0.25, 0.3, 0.35, 0.4, 0.45];
const HARDENINGS: [f64; 6] = [0.0, 0.005, 0.02, 0.05, 0.075, 0.1];

fn relative_force(model: &AnyModel, x: f64) -> f64 {
    let unit = unit(&model.pair);
    force(model, x * unit.indentation) / unit.force
}

/// The mean pressure over the strength at which Hertz's stresses on the axis reach von Mises' condition.
fn pressure_of_first_yield(ratio: f64) -> f64 {
    let stress = |depth: f64| {
        let along = -1.0 / (1.0 + depth * depth);
        let across = -(1.0 + ratio) * (1.0 - depth * (1.0 / depth).atan()) - 0.5 * along;
        (along - across).abs()
    };
    let largest = (1..20_000).map(|place| stress(1e-4 * f64::from(place))).fold(0.0, f64::max);
    2.0 / 3.0 / largest
}

#[test]
fn first_yield_follows_poissons_ratio_as_in_theory_and_not_the_hardening() {
    let (reference, theory) = (on_steel(0.3, 0.0), pressure_of_first_yield(0.3));
    assert!((theory - 1.0747).abs() < 1e-3, "{theory}");
    let pressure = |model: &AnyModel| {
        let point = model.yield_point();
        point.force / (std::f64::consts::PI * model.pair.radius * point.indentation * model.pair.yield_strength)
    };
    for ratio in RATIOS {
        let expected = pressure_of_first_yield(ratio) / theory;
        let plain = on_steel(ratio, 0.0);
        let found = pressure(&plain) / pressure(&reference);
        assert!((found / expected - 1.0).abs() < 2e-3, "nu = {ratio}: {found} instead of {expected}");
        for hardening in HARDENINGS.into_iter().chain([1.0, 1e3]) {
            assert_eq!(
                on_steel(ratio, hardening).yield_point(),
                plain.yield_point(),
                "nu = {ratio}, H = {hardening} E"
            );
        }
    }
}

#[test]
fn the_force_grows_with_hardening_and_with_poissons_ratio_and_stays_below_the_elastic_one() {
    // the same effective modulus: only the plastic law differs
    let of = |ratio: f64, hardening: f64| {
        let model = on_steel(0.3, hardening);
        let youngs_modulus = model.pair.modulus * (1.0 - ratio * ratio);
        AnyModel { pair: Pair { poissons_ratio: ratio, youngs_modulus, ..model.pair }, ..model }
    };
    for x in logarithmic(1.3, 1000.0, 60) {
        let forces = RATIOS.map(|ratio| HARDENINGS.map(|hardening| relative_force(&of(ratio, hardening), x)));
        for (row, harder) in forces.iter().zip(forces.iter().skip(1)) {
            let all = row.iter().zip(harder).all(|(soft, hard)| *soft <= hard * (1.0 + 1e-5));
            assert!(all, "at {x}: {row:?} {harder:?}");
        }
        for row in forces {
            // just beyond yield, where hardening does nothing, the segments of the law differ in the sixth digit
            let grows = row.windows(2).all(|pair| pair[1] >= pair[0] * (1.0 - 1e-5));
            assert!(grows && (x < 2.0 || row.is_sorted() && row[0] < row[5]), "at {x}: {row:?}");
            assert!(row[5] <= x.powf(1.5) * (1.0 + 1e-14), "at {x}: {row:?}");
        }
    }
}

/// Tabor: deep in the plastic regime the mean pressure is about 2.8 times the flow stress at the strain `0.2 a/R`.
#[test]
fn deep_indentation_has_tabors_pressure_for_each_material() {
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    for ratio in RATIOS {
        for hardening in HARDENINGS {
            let model = on_steel(ratio, hardening);
            let Pair { radius, yield_strength, .. } = model.pair;
            let depth = 500.0 * unit(&model.pair).indentation;
            let a = model.loading.contact_radius(&model.pair, depth);
            let flow = yield_strength + hardening * 206e9 * 0.2 * a / radius;
            let constraint = force(&model, depth) / (std::f64::consts::PI * a * a * flow);
            (least, most) = (least.min(constraint), most.max(constraint));
        }
    }
    println!("pressure over flow stress from {least:.3} to {most:.3}");
    assert!(least > 2.65 && most < 3.0, "{least} {most}");
}

/// A target that hardens without bound stays elastic. The law comes near this limit, far outside its range.
#[test]
fn very_strong_hardening_comes_near_the_elastic_law() {
    for ratio in RATIOS {
        for (x, least) in [(2.0, 0.98), (10.0, 0.95), (100.0, 0.87), (500.0, 0.82)] {
            let share = |hardening: f64| relative_force(&on_steel(ratio, hardening), x) / x.powf(1.5);
            let (some, most) = (share(0.1), share(1e9));
            assert!(most > least && most <= 1.0 + 1e-14 && most > some, "nu = {ratio} at {x}: {some} {most}");
        }
    }
}
