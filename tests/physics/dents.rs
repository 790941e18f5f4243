//! The dent ends the contact: beyond it there is no force, whichever way the bodies move, and inside there is one.

use crate::physics::{
    self, AnyModel, Random, advance, all_models, is_passive, logarithmic, mild, pressed, random_bodies, unit,
};
use brinell_contact::Pair;
use brinell_contact::Regime;
use brinell_contact::history::History;

/// The contact opens at its dent, to the last bit, and the force has vanished there.
///
/// A law that is above Hertz's curve in places may leave a dent above the original surface. Its force then lasts to a
/// negative indentation, as published.
#[track_caller]
fn check(what: &str, model: &AnyModel, history: &History) {
    let (indentation, force) = (history.indentation(), history.force());
    let dent = history.residual_indentation(model);
    assert!(dent >= 0.0 || !is_passive(model), "{what}: a passive law leaves a dent of {dent:e} m");
    let peak = pressed(model, history.max_indentation()).force();
    if indentation < dent {
        assert_eq!(force, 0.0, "{what}: at {indentation:e} m, outside the dent of {dent:e} m");
        assert_eq!(history.regime(), Regime::Apart, "{what}: at {indentation:e} m, with a dent of {dent:e} m");
    } else if indentation == dent {
        // here the direction of motion decides; a path that is Hertz's curve, lowered, ends within the rounding of that
        let deepest = history.max_indentation();
        let hertz = model.pair.hertz_stiffness() * deepest * deepest.sqrt();
        assert!(
            force <= 8.0 * f64::EPSILON * hertz.max(peak),
            "{what}: {force:e} N at the dent of {dent:e} m, after {peak:e} N"
        );
    } else {
        // next to the dent, a power of the distance may be too small for a number
        let is_near = indentation - dent < 1e-150;
        assert!(force > 0.0 || is_near, "{what}: no force at {indentation:e} m, inside the dent of {dent:e} m");
    }
    let close = (indentation - dent).abs() <= 1e-9 * history.max_indentation();
    assert!(!close || force <= 1e-8 * peak, "{what}: {force:e} N at the dent, after {peak:e} N");
}

/// Moves by `way` \[m\] in `parts` steps, and checks each.
fn travel(what: &str, model: &AnyModel, history: &mut History, way: f64, parts: u32) {
    for _ in 0..parts {
        advance(history, model, way / f64::from(parts));
        check(what, model, history);
    }
}

/// Some units returned a force at an indentation of -3e-9 m: the dents of these laws are above the original surface.
#[test]
fn no_contact_presses_beyond_its_dent_in_slow_and_fast_motion() {
    let mut random = Random(2012);
    let bodies: Vec<Pair> = [mild()].into_iter().chain((0..3).map(|_| random_bodies(&mut random))).collect();
    let (mut above, mut below) = (0, 0);
    for &pair in &bodies {
        let depth = unit(&pair).indentation;
        for (name, model) in all_models(pair) {
            for largest in logarithmic(0.3 * depth, 3e3 * depth, 14) {
                // a law that is a fit may end earlier
                let Ok(deepest) = History::start(&model, -largest) else { continue };
                let dent = deepest.residual_indentation(&model);
                above += u32::from(dent < 0.0);
                below += u32::from(dent > 0.0);
                // out beyond the dent and the surface, and in again
                let way = 1.3 * (largest - dent.min(0.0));
                for parts in [1, 3, 50] {
                    let what = format!("{name}, {largest:e} m, {parts} steps, {pair:?}");
                    let mut history = deepest;
                    travel(&what, &model, &mut history, -way, parts);
                    travel(&what, &model, &mut history, 0.9 * way, parts);
                    travel(&what, &model, &mut history, -0.9 * way, parts);
                }
            }
        }
    }
    assert!(above > 100 && below > 1000, "{above} dents above the surface, {below} below");
}

/// At the dent itself and its neighbours, to the last bit, from both sides.
#[test]
fn the_contact_ends_exactly_at_the_dent() {
    for (name, model) in all_models(mild()) {
        for x in [0.5, 1.01, 2.5, 9.0, 40.0, 800.0] {
            let largest = x * unit(&model.pair).indentation;
            let dent = pressed(&model, largest).residual_indentation(&model);
            for target in [dent.next_down(), dent, dent.next_up()] {
                for beyond in [-0.2 * largest, 0.2 * (largest - dent)] {
                    let mut history = pressed(&model, largest);
                    for place in [dent + beyond, target] {
                        let way = place - history.indentation();
                        advance(&mut history, &model, way);
                    }
                    check(&format!("{name}, {x} d_y"), &model, &history);
                }
            }
        }
    }
}

/// The laws whose units were found, at the bodies and the depth of that finding.
#[test]
fn the_laws_of_brake_leave_dents_above_the_surface_as_published() {
    for (name, ratio) in [("brake-2012-line", 9.7), ("brake-2015", 10.64)] {
        let model = physics::model(name, "thornton");
        let largest = ratio * unit(&model.pair).indentation;
        // Thornton's recovery d_m F_m/(K_h d_m^1.5), from the curve alone
        let force = physics::loading_force(&model, largest);
        let hertz = model.pair.hertz_stiffness() * largest * largest.sqrt();
        let dent = largest * (1.0 - force / hertz);
        assert!(dent < -0.05 * largest && dent > -0.09 * largest, "{name}: {dent:e} m at {largest:e} m");
        let got = pressed(&model, largest).residual_indentation(&model);
        assert!((got - dent).abs() <= 1e-14 * largest, "{name}: {got:e} m, not {dent:e} m");
    }
}
