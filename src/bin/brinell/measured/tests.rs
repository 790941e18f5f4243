//! Fits to computed measurements, with and without errors.

use super::*;
use crate::scene::{Rate, Scene};
use std::path::Path;

const BODIES: &str = "name = \"ball\"\nimpactor = { radius = 5e-3 }\nimpact = { mass = 4.11e-3, speed = 1.0 }\n";

fn scene(rest: &str) -> Scene {
    Scene::parse(format!("{BODIES}{rest}"), Path::new("scene.toml")).expect("a good scene")
}

fn steel(strength: f64, more: &str) -> Scene {
    scene(&format!(
        "law = {{ loading = \"brinell\" }}\n[target]\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\n\
         yield_strength = {strength:?}\n{more}\n"
    ))
}

/// Values by the law of `scene` at these arguments, with an error for each.
fn computed(scene: &Scene, kind: Kind, arguments: &[f64], error: impl Fn(usize) -> f64) -> Measured {
    let mut measured = Measured { kind, points: Vec::new(), unloaded: 0 };
    let flow = Flow::of(scene).expect("a law that yields");
    for (index, at) in arguments.iter().enumerate() {
        let value = measured.by(scene, &flow, *at).expect("within range");
        measured.points.push((*at, value + error(index)));
    }
    measured
}

const SPEEDS: [f64; 10] = [0.05, 0.1, 0.2, 0.4, 0.8, 1.2, 2.0, 3.0, 5.0, 8.0];

fn exact(_: usize) -> f64 {
    0.0
}

#[track_caller]
fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "{found:e} instead of {expected:e}");
}

#[test]
fn a_fit_finds_the_strength_that_made_the_rebounds_wherever_it_starts() {
    for strength in [50e6, 300e6, 2e9] {
        let measured = computed(&steel(strength, ""), Kind::Restitution, &SPEEDS, exact);
        for start in [20e6, 300e6, 5e9] {
            let found = fit(&steel(start, ""), &measured, &[Fit::YieldStrength]).expect("a fit");
            let [estimate] = found.estimates.as_slice() else { panic!("one parameter") };
            close(estimate.value, strength, 1e-6);
            let (low, high) = estimate.interval.expect("ten points");
            assert!(low <= strength * (1.0 + 1e-6) && high >= strength * (1.0 - 1e-6) && high / low < 1.0001);
            // 8 m/s make too wide a dent in the softest target
            let is_wide = found.remarks.iter().any(|remark| remark.contains("at 1 of 10 points (speeds from 8 m/s"));
            assert_eq!((found.remarks.len(), is_wide), (usize::from(strength < 100e6), strength < 100e6), "{found:?}");
            assert!(estimate.doubt.is_none(), "{found:?}");
            assert!(found.rms[1] < 1e-9, "{:?}", found.rms);
        }
    }
}

#[test]
fn a_fit_finds_the_strength_of_a_loading_curve_and_its_hardening() {
    let depths: Vec<f64> = (1..=20).map(|index| 2e-6 * f64::from(index)).collect();
    let measured = computed(&steel(400e6, "hardening_modulus = 5e9"), Kind::Force, &depths, exact);
    let start = steel(300e6, "");
    let found = fit(&start, &measured, &[Fit::YieldStrength, Fit::HardeningModulus]).expect("a fit");
    close(found.estimates[0].value, 400e6, 1e-5);
    close(found.estimates[1].value, 5e9, 1e-4);
    // the strength alone can't describe a target that hardens
    let alone = fit(&start, &measured, &[Fit::YieldStrength]).expect("a fit");
    assert!(alone.estimates[0].value > 410e6 && alone.rms[1] > 100.0 * found.rms[1], "{alone:?}");
    assert!(alone.remarks.iter().any(|remark| remark.contains("follow a trend")), "{alone:?}");
}

#[test]
fn a_fit_finds_the_constant_of_a_rate_model() {
    let johnson =
        |c: f64| steel(300e6, &format!("rate = {{ model = \"johnson-cook\", c = {c:?}, reference_rate = 1.0 }}"));
    let measured = computed(&johnson(0.04), Kind::Restitution, &SPEEDS, exact);
    let found = fit(&johnson(0.01), &measured, &[Fit::Rate]).expect("a fit");
    close(found.estimates[0].value, 0.04, 1e-5);
    assert_eq!(found.estimates[0].name, "target.rate.c");
    let cowper = |d: f64| steel(300e6, &format!("rate = {{ model = \"cowper-symonds\", d = {d:?}, q = 5.0 }}"));
    let measured = computed(&cowper(8000.0), Kind::Restitution, &SPEEDS, exact);
    let found = fit(&cowper(40.4), &measured, &[Fit::Rate]).expect("a fit");
    close(found.estimates[0].value, 8000.0, 1e-4);
    assert!(matches!(found.flow.rate, Some(Rate::CowperSymonds { q: 5.0, .. })), "{found:?}");
}

/// A sequence of independent numbers with a normal distribution.
struct Normal(u64);

impl Normal {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    fn next(&mut self) -> f64 {
        (-2.0 * self.uniform().ln()).sqrt() * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

#[test]
fn the_interval_contains_the_true_strength_in_95_of_100_measurements() {
    let (scene, count) = (steel(300e6, ""), 300);
    let mut random = Normal(7);
    let mut inside = 0;
    for _ in 0..count {
        let errors: Vec<f64> = SPEEDS[..5].iter().map(|_| 0.01 * random.next()).collect();
        let measured = computed(&scene, Kind::Restitution, &SPEEDS[..5], |index| errors[index]);
        let found = fit(&scene, &measured, &[Fit::YieldStrength]).expect("a fit");
        let (low, high) = found.estimates[0].interval.expect("five points");
        inside += u32::from((low..=high).contains(&300e6));
    }
    let part = f64::from(inside) / f64::from(count);
    // three standard deviations of the binomial distribution
    assert!((part - 0.95).abs() < 0.038, "{part}");
}

#[test]
fn what_a_measurement_does_not_determine_is_said() {
    let doubt = |scene: &Scene, measured: &Measured, fits: &[Fit], words: &str| {
        let found = fit(scene, measured, fits).expect("a fit");
        let said: Vec<_> =
            found.estimates.iter().filter_map(|estimate| estimate.doubt.clone()).chain(found.remarks).collect();
        assert!(said.iter().any(|said| said.contains(words)), "{said:?}, not {words}");
    };
    let normal = steel(300e6, "");
    // impacts below yield
    let slow = computed(&steel(30e9, ""), Kind::Restitution, &[0.01, 0.02, 0.05], exact);
    doubt(&steel(30e9, ""), &slow, &[Fit::YieldStrength], "not determined: no restitution depends on it");
    let one = computed(&normal, Kind::Restitution, &[1.0], exact);
    doubt(&normal, &one, &[Fit::YieldStrength], "without an interval: 1 points for 1 parameters");
    // two measurements of the same impact that disagree
    let scattered = computed(&normal, Kind::Restitution, &[1.0, 1.0, 1.0], |index| 0.2 * (index as f64 - 1.0));
    doubt(&normal, &scattered, &[Fit::YieldStrength], "hardly determined: its interval spans a factor");
    // a softening target
    let soft = computed(&normal, Kind::Restitution, &SPEEDS, |index| -0.01 * index as f64);
    doubt(&normal, &soft, &[Fit::HardeningModulus], "not distinguishable from 0: the best value would be negative");
    // strength and rate act alike at one speed
    let rate = steel(300e6, "rate = { model = \"johnson-cook\", c = 0.02, reference_rate = 1.0 }");
    let same = computed(&rate, Kind::Restitution, &[1.0, 1.0, 1.0, 1.0], |index| 0.001 * [1.0, -1.0, 2.0, -2.0][index]);
    doubt(&rate, &same, &[Fit::YieldStrength, Fit::Rate], "only a combination of the parameters");
}

#[test]
fn what_a_scene_cannot_fit_is_rejected_with_the_reason() {
    let normal = steel(300e6, "");
    let speeds = computed(&normal, Kind::Restitution, &SPEEDS, exact);
    let forces = computed(&normal, Kind::Force, &[1e-6, 1e-5], exact);
    let rate = steel(300e6, "rate = { model = \"johnson-cook\", c = 0.02, reference_rate = 1.0 }");
    let target = "target = { material = \"mild steel\" }\n";
    let power_law = "law = { loading = \"brinell\" }\n[target]\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\n\
                     power_law = { coefficient = 700e6, exponent = 0.2 }\n";
    let cases: [(Scene, &Measured, &[Fit], &str); 6] = [
        (steel(300e6, ""), &speeds, &[Fit::Rate], "--fit rate needs a rate model in the scene"),
        (rate, &forces, &[Fit::Rate], "--fit rate needs speeds"),
        (steel(300e6, ""), &speeds, &[Fit::YieldStrength, Fit::YieldStrength], "names target.yield_strength twice"),
        (
            scene(&format!("{target}law = {{ loading = \"hertz\" }}\n")),
            &speeds,
            &[Fit::YieldStrength],
            "hertz doesn't yield",
        ),
        (
            scene(&format!("{target}law = {{ loading = \"thornton\" }}\n")),
            &speeds,
            &[Fit::HardeningModulus],
            "thornton has no hardening modulus",
        ),
        (scene(power_law), &speeds, &[Fit::YieldStrength], "follows from target.power_law"),
    ];
    for (scene, measured, fits, words) in cases {
        let error = fit(&scene, measured, fits).expect_err(words);
        assert!(error.contains(words), "{error}, not {words}");
    }
}

/// Once the strength, its interval and the rms were those of the negative optimum.
#[test]
fn where_a_parameter_would_be_negative_the_others_are_fitted_again_with_zero() {
    let rigid = steel(300e6, "");
    let points = vec![(5e-6, 114.40), (10e-6, 257.01), (15e-6, 404.79), (20e-6, 558.65)];
    let measured = Measured { kind: Kind::Force, points, unloaded: 0 };
    let both = fit(&rigid, &measured, &[Fit::YieldStrength, Fit::HardeningModulus]).expect("a fit");
    let alone = fit(&rigid, &measured, &[Fit::YieldStrength]).expect("a fit");
    close(both.estimates[0].value, 294.3e6, 1e-3);
    close(both.rms[1], 3.87, 2e-3);
    assert_eq!((both.estimates[1].value, both.flow.hardening.hardening_modulus), (0.0, 0.0));
    assert!(both.estimates[1].doubt.as_ref().is_some_and(|doubt| doubt.contains("would be negative")), "{both:?}");
    close(both.estimates[0].value, alone.estimates[0].value, 1e-6);
    let [one, other] = [&both, &alone].map(|found| found.estimates[0].interval.expect("four points"));
    close(one.0, other.0, 1e-5);
    close(one.1, other.1, 1e-5);
    // a rate constant, with rebounds that grow weaker than those of a constant strength
    let rate = steel(300e6, "rate = { model = \"johnson-cook\", c = 0.02, reference_rate = 1.0 }");
    let soft = computed(&steel(300e6, ""), Kind::Restitution, &SPEEDS, |index| -0.004 * index as f64);
    let both = fit(&rate, &soft, &[Fit::YieldStrength, Fit::Rate]).expect("a fit");
    let alone = fit(&steel(300e6, ""), &soft, &[Fit::YieldStrength]).expect("a fit");
    assert_eq!(both.estimates[1].value, 0.0, "{both:?}");
    close(both.estimates[0].value, alone.estimates[0].value, 1e-5);
    close(both.rms[1], alone.rms[1], 1e-6);
}

#[test]
fn planted_strength_and_rate_are_found_away_from_the_bound() {
    let johnson = |strength: f64, c: f64| {
        steel(strength, &format!("rate = {{ model = \"johnson-cook\", c = {c:?}, reference_rate = 1.0 }}"))
    };
    let measured = computed(&johnson(350e6, 0.03), Kind::Restitution, &SPEEDS, exact);
    let found = fit(&johnson(200e6, 0.0), &measured, &[Fit::YieldStrength, Fit::Rate]).expect("a fit");
    close(found.estimates[0].value, 350e6, 1e-3);
    close(found.estimates[1].value, 0.03, 1e-2);
}

#[test]
fn points_that_repeat_each_other_give_no_interval() {
    let normal = steel(300e6, "");
    let same = computed(&normal, Kind::Restitution, &[1.0, 1.0, 1.0], exact);
    let found = fit(&normal, &same, &[Fit::YieldStrength]).expect("a fit");
    let doubt = found.estimates[0].doubt.as_deref().unwrap_or_default();
    assert!(doubt.contains("without an interval: 1 different points for 1 parameters"), "{found:?}");
    assert_eq!(found.estimates[0].interval, None);
}

#[test]
fn points_too_wide_for_the_law_are_named() {
    let normal = steel(300e6, "");
    let says = |kind, at: &[f64]| {
        let found = fit(&normal, &computed(&normal, kind, at, exact), &[Fit::YieldStrength]).expect("a fit");
        found.remarks.into_iter().find(|remark| remark.contains("effective radii"))
    };
    assert_eq!(says(Kind::Force, &[1e-6, 1e-5, 5e-5]), None);
    let deep = says(Kind::Force, &[1e-5, 5e-5, 5e-4, 6e-4]).expect("a remark");
    assert!(deep.contains("at 2 of 4 points (depths from 500 um to 600 um)"), "{deep}");
    assert_eq!(says(Kind::Restitution, &SPEEDS), None);
    let fast = says(Kind::Restitution, &[1.0, 2.0, 300.0]).expect("a remark");
    assert!(fast.contains("at 1 of 3 points (speeds from 300 m/s"), "{fast}");
}
