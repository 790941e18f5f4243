//! The rate-dependent laws: reference values, energy, and the forces along a path.

use crate::physics::{MASS, logarithmic, mild};
use crate::prescribed::rate_dependent_laws;
use brinell_contact::Contact;
use brinell_contact::behaviour::is_finite_at;
use brinell_contact::damped::hunt_crossley::DampingFactor;
use brinell_contact::damped::tsuji::TsujiDamping;
use brinell_contact::damped::{Adams, AnyDamped, Damped, HuntCrossley, KelvinVoigt, KuwabaraKono, Tsuji};
use brinell_contact::impact::{Impact, Prediction};
use brinell_contact::loading::Elastic;
use brinell_contact::losses::{self, Damper, History, impact};
use brinell_contact::unloading::ContactRadius;
use std::f64::consts::PI;

type Model = losses::Model<Elastic, ContactRadius, Damper>;

fn model_of(law: AnyDamped, restitution: f64) -> Model {
    law.model(mild(), restitution, MASS)
}

fn predict(law: AnyDamped, restitution: f64, speed: f64) -> Prediction {
    impact::predict(&model_of(law, restitution), &Impact { mass: MASS, speed }).expect("within range")
}

fn assert_close(what: &str, value: f64, expected: f64, tolerance: f64) {
    let error = (value / expected - 1.0).abs();
    assert!(error <= tolerance, "{what}: {value:e} instead of {expected:e}, off by {error:e}");
}

/// The restitution that each damping factor gives for a required restitution e, from published tables.
const DELIVERED: [(DampingFactor, [f64; 6]); 8] = [
    (DampingFactor::HuntCrossley, [0.5158326, 0.5468541, 0.5812880, 0.6629622, 0.7679998, 0.9090157]),
    (DampingFactor::LeeWang, [0.6866634, 0.7119502, 0.7389953, 0.7991988, 0.8693431, 0.9523702]),
    (DampingFactor::HerbertMcwhannell, [0.4906977, 0.5007793, 0.5199666, 0.5936243, 0.7226826, 0.9008930]),
    (DampingFactor::LankaraniNikravesh, [0.6652654, 0.6722625, 0.6842246, 0.7252411, 0.7959726, 0.9131767]),
    (DampingFactor::ZhiyingQishao, [0.2174693, 0.2664174, 0.3266974, 0.4826080, 0.6795665, 0.8959182]),
    (DampingFactor::Gonthier, [0.1009898, 0.2046091, 0.3042249, 0.4877413, 0.6695813, 0.8764354]),
    (DampingFactor::Flores, [0.0694442, 0.1555400, 0.2562079, 0.4704448, 0.6831842, 0.8939207]),
    (DampingFactor::HuGuo, [0.0740735, 0.1655959, 0.2706585, 0.4877413, 0.6972970, 0.8998999]),
];

/// The required restitutions in those tables.
const ASKED: [f64; 6] = [0.1, 0.2, 0.3, 0.5, 0.7, 0.9];

fn hunt_crossley(damping_factor: DampingFactor) -> AnyDamped {
    AnyDamped::HuntCrossley(HuntCrossley { damping_factor })
}

#[test]
fn each_hunt_crossley_factor_gives_the_restitution_of_the_table() {
    for (factor, delivered) in DELIVERED {
        for (asked, expected) in ASKED.into_iter().zip(delivered) {
            let prediction = predict(hunt_crossley(factor), asked, 1.0);
            assert!((prediction.restitution - expected).abs() < 6e-8, "{factor:?} {asked}: {}", prediction.restitution);
        }
    }
}

#[test]
fn the_exact_factor_is_that_of_the_table_and_gives_the_required_restitution() {
    let table = [9.998159398, 4.919166716, 3.087081981, 1.432750533, 0.634828281, 0.166481951];
    for (asked, chi) in ASKED.into_iter().zip(table) {
        assert!((DampingFactor::Exact.chi(asked) - chi).abs() < 1e-9, "{asked}: {}", DampingFactor::Exact.chi(asked));
    }
    for asked in [0.001, 0.01, 0.1, 0.5, 0.9, 0.99, 0.999999, 1.0] {
        for speed in [1e-3, 1.0, 50.0] {
            let prediction = predict(hunt_crossley(DampingFactor::Exact), asked, speed);
            assert_close(&format!("restitution at {speed}"), prediction.restitution, asked, 1e-8);
        }
    }
}

#[test]
fn the_depth_of_a_hunt_crossley_impact_is_that_of_the_closed_form() {
    for (factor, _) in DELIVERED {
        let chi = factor.chi(0.6);
        let stiffness = mild().hertz_stiffness();
        let power = 2.5 * MASS * 4.0 * (chi - chi.ln_1p()) / (stiffness * chi * chi);
        let prediction = predict(hunt_crossley(factor), 0.6, 2.0);
        assert_close(&format!("{factor:?}"), prediction.max_indentation, power.powf(0.4), 1e-10);
    }
}

#[test]
fn without_damping_an_impact_is_that_of_hertz() {
    let pair = mild();
    for law in [hunt_crossley(DampingFactor::Exact), AnyDamped::Tsuji(Tsuji::REFERENCE)] {
        let prediction = predict(law, 1.0, 3.0);
        let depth = (5.0 * MASS * 9.0 / (4.0 * pair.hertz_stiffness())).powf(0.4);
        assert_close("depth", prediction.max_indentation, depth, 1e-10);
        assert_close("force", prediction.max_force, pair.hertz_stiffness() * depth.powf(1.5), 1e-10);
        assert_close("contact time", prediction.contact_time(), 2.943_275_184_32 * depth / 3.0, 1e-9);
        assert_close("restitution", prediction.restitution, 1.0, 1e-10);
    }
}

/// Restitution of a linear spring and dashpot that does not pull.
///
/// Reference: T. Schwager, T. Poeschel, Granular Matter 9 (2007) 465-469.
fn without_tension(asked: f64) -> f64 {
    let z = -asked.ln() / (PI * PI + asked.ln() * asked.ln()).sqrt();
    let root = (1.0 - z * z).sqrt();
    (-z / root * f64::atan2(2.0 * z * root, 2.0 * z * z - 1.0)).exp()
}

#[test]
fn kelvin_voigt_and_tsuji_give_the_restitution_of_a_surface_that_does_not_pull() {
    let table = [0.2527294, 0.3248628, 0.3971405, 0.5502832, 0.7182014, 0.9020261];
    for (asked, expected) in ASKED.into_iter().zip(table) {
        assert!((without_tension(asked) - expected).abs() < 6e-8, "{asked}: {}", without_tension(asked));
        for speed in [0.01, 1.0, 30.0] {
            let linear = predict(AnyDamped::KelvinVoigt(KelvinVoigt::REFERENCE), asked, speed);
            assert_close(&format!("kelvin-voigt {asked}"), linear.restitution, without_tension(asked), 1e-9);
            let tsuji = predict(AnyDamped::Tsuji(Tsuji::REFERENCE), asked, speed);
            assert_close(&format!("tsuji {asked}"), tsuji.restitution, without_tension(asked), 1e-8);
        }
    }
}

#[test]
fn the_other_tsuji_dampings_give_the_restitutions_of_the_tables() {
    let lammps = [0.349961, 0.429213, 0.502575, 0.645835, 0.787676, 0.929395];
    let delivered = |damping_factor, asked| predict(AnyDamped::Tsuji(Tsuji { damping_factor }), asked, 1.0).restitution;
    for (asked, expected) in ASKED.into_iter().zip(lammps) {
        let restitution = delivered(TsujiDamping::Lammps, asked);
        assert!((restitution - expected).abs() < 6e-7, "{asked}: {restitution}");
    }
    for (asked, expected) in [(0.2, 0.20025), (0.5, 0.50001), (0.9, 0.89992), (0.98, 0.97236)] {
        let restitution = delivered(TsujiDamping::NoTension, asked);
        assert!((restitution - expected).abs() < 6e-6, "{asked}: {restitution}");
    }
}

#[test]
fn kelvin_voigt_takes_up_the_energy_of_hertz_at_its_characteristic_speed() {
    let law = KelvinVoigt { characteristic_speed: 0.7 };
    let linear = predict(AnyDamped::KelvinVoigt(law), 1.0, 0.7);
    let hertz = predict(hunt_crossley(DampingFactor::Exact), 1.0, 0.7);
    assert_close("depth", linear.max_indentation, hertz.max_indentation, 1e-9);
    let half_a_period = PI * (linear.max_indentation / 0.7);
    assert_close("contact time", linear.contact_time(), half_a_period, 1e-9);
}

#[test]
fn kuwabara_kono_gives_the_restitutions_of_the_table() {
    for (s, expected) in [(0.001, 0.998272), (0.01, 0.982883), (0.05, 0.918133), (0.1, 0.845144), (0.2, 0.722085)] {
        let speed = 2.0f64;
        let relaxation_time = s / ((mild().hertz_stiffness() / MASS).powf(0.4) * speed.powf(0.2));
        let prediction = predict(AnyDamped::KuwabaraKono(KuwabaraKono { relaxation_time }), 0.5, speed);
        assert!((prediction.restitution - expected).abs() < 6e-7, "{s}: {}", prediction.restitution);
    }
}

#[test]
fn the_impact_function_is_that_of_the_manuals() {
    let law =
        Adams { stiffness_factor: 2.0, exponent: 2.2, full_damping: 50.0, damping_depth: 1e-4, ..Adams::REFERENCE };
    let model = law.model(mild(), 1.0, 1.0);
    let stiffness = 2.0 * mild().hertz_stiffness() * 1e-4f64.powf(1.5) / 1e-4f64.powf(2.2);
    for (depth, step) in [(0.5e-4, 0.5), (0.25e-4, 0.0625 * 2.5), (1e-4, 1.0), (3e-4, 1.0)] {
        let mut history = History::start(&model, 0.0).unwrap();
        history.advance(&model, depth, 1.0).unwrap();
        for rate in [0.3, 0.0, -0.2] {
            let expected = stiffness * depth.powf(2.2) + 50.0 * step * rate;
            assert_close(&format!("force at {depth}"), history.force(rate), expected, 1e-12);
        }
        assert_eq!(history.force(-1e9), 0.0, "the surface doesn't pull");
    }
}

#[test]
fn the_touch_speed_is_that_of_the_step_that_closes_the_contact() {
    let model = model_of(hunt_crossley(DampingFactor::HuntCrossley), 0.5);
    let force =
        |depth: f64, rate: f64, touch: f64| mild().hertz_stiffness() * depth.powf(1.5) * (1.0 + 0.75 * rate / touch);
    let mut history = History::start(&model, 1e-6).unwrap();
    history.advance(&model, 2.0, 1e-6).unwrap();
    assert_close("after the touch", history.force(2.0), force(1e-6, 2.0, 2.0), 1e-9);
    history.advance(&model, 0.5, 2e-6).unwrap();
    assert_close("slower now", history.force(0.5), force(2e-6, 0.5, 2.0), 1e-9);
    history.advance(&model, -1.0, 3e-6).unwrap();
    assert_eq!((history.force(-1.0), history.force(1.0)), (0.0, 0.0), "apart");
    history.advance(&model, 0.25, 8e-6).unwrap();
    assert_close("touched again", history.force(0.25), force(1e-6, 0.25, 0.25), 1e-9);
}

#[test]
fn a_contact_that_starts_pressed_in_counts_its_first_closing_rate_as_the_touch() {
    let model = model_of(hunt_crossley(DampingFactor::HuntCrossley), 0.5);
    let mut history = History::start(&model, -1e-6).unwrap();
    let elastic = mild().hertz_stiffness() * 1e-9;
    assert_close("at rest", history.force(0.0), elastic, 1e-12);
    assert_close("damped at once", history.force(3.0), 1.75 * elastic, 1e-12);
    assert_close("not yet closing", history.force(-3.0), elastic, 1e-12);
    history.advance(&model, -0.1, 1e-6).unwrap();
    history.advance(&model, 4.0, 0.1e-6).unwrap();
    let depth = 1e-6 - 0.1e-6 + 0.4e-6;
    let expected = mild().hertz_stiffness() * f64::powf(depth, 1.5) * 1.75;
    assert_close("damped", history.force(4.0), expected, 1e-9);
}

#[test]
fn accepted_values_are_finite_and_nothing_physical_is_refused() {
    for (name, law) in rate_dependent_laws() {
        let model = model_of(law, 0.3);
        for depth in logarithmic(1e-300, 1e99, 120) {
            for rate in [1e-300, 1e-9, 1e4] {
                let mut history = History::start(&model, 0.0).unwrap();
                let stepped = history.advance(&model, rate, depth / rate);
                let physical = depth > 1e-18 && depth < 1e3 && rate > 1e-10;
                assert!(stepped.is_ok() || !physical, "{name} at {depth:e} m, {rate} m/s");
                for now in [rate, -rate, 0.0, 1e5, 1e200] {
                    let finite = is_finite_at::<Model, _>(&history, now);
                    assert!(finite || !physical || now > 1e5, "{name} at {depth:e} m, {now} m/s");
                    let values = [
                        history.force(now),
                        history.stiffness(now),
                        history.mean_pressure(&model, now),
                        history.work(&model),
                    ];
                    assert!(!finite || values.iter().all(|value| value.is_finite()), "{name} at {depth:e}: {values:?}");
                }
            }
        }
    }
}

#[test]
fn indentations_out_of_range_are_refused_and_change_nothing() {
    let model = model_of(hunt_crossley(DampingFactor::Exact), 0.5);
    assert!(History::start(&model, f64::NAN).is_err());
    assert!(History::start(&model, -1e100).is_err());
    let mut history = History::start(&model, -1e-6).unwrap();
    let before = history;
    for rate in [1e200, -1e200, f64::NAN, f64::INFINITY] {
        assert!(history.advance(&model, rate, 1.0).is_err(), "{rate}");
        assert_eq!(history, before);
    }
}

#[test]
fn factors_follow_the_bodies() {
    // twice the modulus: twice the stiffness; K_h chi and the C of the others change with their own powers
    let pair = mild();
    let stiffer = brinell_contact::Pair { modulus: 2.0 * pair.modulus, ..pair };
    for (name, law, power) in [
        ("hunt-crossley", hunt_crossley(DampingFactor::Exact), 1.0),
        ("tsuji", AnyDamped::Tsuji(Tsuji::REFERENCE), 0.5),
        ("kelvin-voigt", AnyDamped::KelvinVoigt(KelvinVoigt::REFERENCE), 0.4),
        ("kuwabara-kono", AnyDamped::KuwabaraKono(KuwabaraKono::REFERENCE), 1.0),
        ("adams-impact", AnyDamped::Adams(Adams::REFERENCE), 0.0),
    ] {
        let damping = |pair| {
            let model = law.model(pair, 0.5, 2.0);
            let mut history = History::start(&model, 0.0).unwrap();
            history.advance(&model, 1.0, 1e-6).unwrap();
            history.force(1.0) - history.force(0.0)
        };
        assert_close(name, damping(stiffer) / damping(pair), f64::powf(2.0, power), 1e-10);
    }
}

#[test]
fn a_contact_that_starts_indented_shows_the_force_of_its_first_step() {
    for (name, law) in AnyDamped::ALL {
        for restitution in [0.1, 0.5, 0.9] {
            let model = model_of(law, restitution);
            for depth in logarithmic(1e-9, 1e-3, 25) {
                for rate in [-100.0, -1.0, -1e-6, 0.0, 1e-6, 1.0, 100.0] {
                    let before = History::start(&model, -depth).expect("within range");
                    let mut after = before;
                    after.advance(&model, rate, 1e-12 * depth / 100.0).expect("within range");
                    let close = |one: f64, other: f64| (one - other).abs() <= 1e-6 * one.abs().max(other.abs());
                    let what = format!("{name} {restitution} {depth} {rate}");
                    assert!(
                        close(before.force(rate), after.force(rate)),
                        "{what}: {} {}",
                        before.force(rate),
                        after.force(rate)
                    );
                    assert!(close(before.stiffness(rate), after.stiffness(rate)), "{what}");
                    let dampings = [&before, &after].map(|history| Contact::<Model>::damping(history, rate));
                    assert!(dampings[0] >= 0.0, "{what}: {dampings:?}");
                }
            }
        }
    }
}
