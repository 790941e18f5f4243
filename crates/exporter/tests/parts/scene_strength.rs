use brinell_contact::rate::{self, FIRST_STRAIN, Factors, Strains};
use brinell_exporter::scene::Scene;
use std::path::Path;

fn scene(strength: &str, speed: f64) -> Scene {
    let text = format!(
        "name = \"test\"\nimpactor = {{ radius = 5e-3, density = 7850.0 }}\n[target]\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\n\
         rate = {{ model = \"johnson-cook\", c = 0.0, reference_rate = 1e-3 }}\n{strength}\n[impact]\nspeed = {speed}\n"
    );
    Scene::parse(text, Path::new("test.toml")).unwrap_or_else(|error| panic!("{error}"))
}

/// The force, and the strain, at an indentation of a contact that has at each indentation the tangent at its own strain.
fn at_own_strain(scene: &Scene, indentation: f64) -> (f64, Strains) {
    let mut strains = Strains { softer: FIRST_STRAIN, harder: FIRST_STRAIN };
    for _ in 0..40 {
        let model = scene.with_strengths_at(0, strains, Factors::SLOW);
        let radius = model.peak(indentation).contact_radius;
        strains.softer = (rate::TABOR * radius / model.pair.radius).max(1e-6);
    }
    (scene.with_strengths_at(0, strains, Factors::SLOW).peak(indentation).force, strains)
}

/// There are no finite elements of a power law. The fit's own tables are of linear hardening; taken at each indentation with the tangent
/// at that indentation's strain, they are what Tabor says of a power law all along the loading. In an impact, the one tangent at the
/// largest strain differs from that by 1.6 % in depth, 1.8 % in force and 0.004 in restitution at most, for exponents to 0.3 and strains
/// of 0.7 to 4.5 %: too strong at first, it makes shallower dents. The straight line by least squares has 6.5 %, 7.0 % and 0.010, the
/// flow stress alone 9.8 %, 6.0 % and 0.015.
#[test]
fn one_tangent_is_as_good_as_that_of_each_strain() {
    let [mut worst, mut by_line, mut by_stress] = [[0.0_f64; 3]; 3];
    let mut strains = (1.0_f64, 0.0_f64);
    for exponent in [0.05, 0.1, 0.2, 0.3] {
        for (coefficient, speed) in [(600e6, 0.3), (600e6, 3.0), (600e6, 8.0), (1500e6, 2.0), (1500e6, 12.0)] {
            let points: Vec<f64> = (0..10).map(|step| 0.003 * 1.4_f64.powi(step)).collect();
            let stresses: Vec<f64> = points.iter().map(|strain| coefficient * strain.powf(exponent)).collect();
            let test = format!("tensile_test = {{ plastic_strain = {points:?}, true_stress = {stresses:?} }}");
            let scene = scene(&test, speed);
            let prediction = scene.predictions[0];
            let found = scene.in_impact(0, &scene.impact).expect("a prediction");
            strains = (strains.0.min(found.strains.softer), strains.1.max(found.strains.softer));
            const PIECES: u32 = 300;
            let step = 1.2 * prediction.max_indentation / f64::from(PIECES);
            let (mut work, mut before, mut depth) = (0.0, 0.0, 0.0);
            while work < prediction.energy {
                let force = at_own_strain(&scene, depth + step).0;
                let piece = 0.5 * step * (before + force);
                let part = ((prediction.energy - work) / piece).min(1.0);
                (work, before, depth) = (work + piece, force, depth + part * step);
            }
            let (force, own) = at_own_strain(&scene, depth);
            let model = scene.with_strengths_at(0, own, Factors::SLOW);
            let rebound = model.recovered_work(depth, depth);
            let restitution = (rebound / prediction.energy).sqrt();
            let errors = |other: &Scene| {
                let other = other.predictions[0];
                let sizes = [other.max_indentation / depth - 1.0, other.max_force / force - 1.0];
                [sizes[0], sizes[1], other.restitution - restitution].map(f64::abs)
            };
            let line =
                self::scene(&format!("power_law = {{ coefficient = {coefficient:e}, exponent = {exponent} }}"), speed);
            let stress = coefficient * found.strains.softer.powf(exponent);
            let stress = self::scene(&format!("yield_strength = {stress:e}"), speed);
            for (worst, scene) in [(&mut worst, &scene), (&mut by_line, &line), (&mut by_stress, &stress)] {
                worst.iter_mut().zip(errors(scene)).for_each(|(worst, error)| *worst = worst.max(error));
            }
        }
    }
    let is_within = |errors: [f64; 3], most: [f64; 3]| errors.iter().zip(most).all(|(error, most)| *error < most);
    assert!(is_within(worst, [0.016, 0.019, 0.004]), "{worst:?}");
    for other in [by_line, by_stress] {
        assert!(is_within(worst.map(|error| 2.0 * error), other), "{worst:?}, not half of {other:?}");
    }
    assert!(strains.0 < 0.01 && strains.1 > 0.04, "{strains:?}");
}
