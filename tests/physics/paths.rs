//! Contacts on paths: the result depends on the path, not on the number of steps.

use crate::physics::{
    self, AnyModel, Random, advance, all_models, exactly, go, is_passive, loading_force, mild, model, on_grid, pressed,
    some_models, unloading_force,
};
use brinell_contact::loading::KogutEtsion;
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Contact, History, Regime, Surface};

#[test]
fn a_hundred_million_small_steps_lose_nothing() {
    let model = model("big-alabo", "contact-radius");
    // an unoptimized build makes a tenth of them, to save time
    let steps = if cfg!(debug_assertions) { 10_000_000 } else { 100_000_000 };
    // from zero; and with steps so small beside the indentation that a plain sum would not change
    for (start, step) in [(0.0, 1.1e-15), (1.0, 1.1e-17)] {
        let mut history = pressed(&model, start);
        for _ in 0..steps {
            advance(&mut history, &model, step);
        }
        let exact = start + f64::from(steps) * step;
        let unit = exact.next_up() - exact;
        let ulps = (history.indentation() - exact) / unit;
        assert!(ulps.abs() <= 4.0, "from {start}: {ulps} units in the last place off");
        assert_eq!(history.max_indentation(), history.indentation());
    }
}

#[test]
fn what_a_step_smaller_than_the_indentation_rounds_away_is_kept() {
    let model = model("big-alabo", "contact-radius");
    // half a unit in the last place of 1
    let half = 0.5 * f64::EPSILON;
    let mut history = pressed(&model, 1.0);
    advance(&mut history, &model, 0.7 * half);
    assert_eq!(history.indentation(), 1.0);
    // together more than half a unit, each of them less
    advance(&mut history, &model, 0.7 * half);
    assert_eq!(history.indentation(), 1.0f64.next_up());
}

#[test]
fn a_step_much_larger_than_the_indentation_is_off_by_half_a_unit_of_its_own_last_place_at_most() {
    let model = model("big-alabo", "contact-radius");
    let half = 0.5 * f64::EPSILON;
    for small in [0.4 * half, 0.9 * half, 3.3 * half, 1e-3, 0.3, 0.999] {
        let mut history = pressed(&model, small);
        advance(&mut history, &model, 1.0);
        // back to the small number: its missing part was lost on the way
        advance(&mut history, &model, -1.0);
        assert!((history.indentation() - small).abs() <= half, "{small:e} became {:e}", history.indentation());
    }
}

#[test]
fn reloading_comes_back_to_the_same_bits() {
    for (name, model) in all_models(mild()) {
        for x in [0.7, 1.0, 1.5, 20.0, 150.0] {
            let mut history = pressed(&model, on_grid(x));
            let before = history;
            for part in [0.999, 0.75, 0.5, 0.1, -3.0] {
                go(&mut history, &model, on_grid(part * x));
                let halfway = history.force();
                assert!(halfway < before.force(), "{name}: to {part} of {x}");
                go(&mut history, &model, on_grid(0.3 * x));
                go(&mut history, &model, on_grid(part * x));
                assert_eq!(history.force(), halfway, "{name}: to {part} of {x}, by another way");
                go(&mut history, &model, on_grid(x));
                assert_eq!(history, before, "{name}: back from {part} of {x}");
            }
        }
    }
}

#[test]
fn a_negative_gap_is_an_indentation_reached_by_loading() {
    for (name, model) in all_models(mild()) {
        for x in [1e-9, 0.5, 1.0, 5.0, 13.93, 40.0, 82.5, 1000.0] {
            let indentation = on_grid(x);
            let mut loaded = pressed(&model, 0.0);
            advance(&mut loaded, &model, indentation);
            assert_eq!(pressed(&model, indentation), loaded, "{name} at {x}");
        }
    }
}

#[test]
fn a_fresh_surface_forgets_the_dent_beyond_the_original_surface_but_not_its_energy() {
    for (name, dented) in all_models(mild()) {
        let fresh = AnyModel { surface: Surface::Fresh, ..dented };
        let first = pressed(&fresh, on_grid(20.0));
        let (lost, dent) = (first.dissipated_energy(&fresh), first.residual_indentation(&fresh));
        let mut history = first;
        if dent > 0.0 {
            // separated, but not beyond the original surface: the dent is still there
            exactly(&mut history, &fresh, 0.5 * dent);
            assert_eq!((history.regime(), history.force()), (Regime::Apart, 0.0), "{name}");
            exactly(&mut history, &fresh, on_grid(20.0));
            assert_eq!(history, first, "{name}");
        }
        for parted in [0.0, -1e-300, -on_grid(3.0)] {
            let mut history = first;
            go(&mut history, &fresh, parted);
            assert_eq!(history.dissipated_energy(&fresh), lost, "{name}: parted to {parted:e}");
            assert_eq!((history.max_indentation(), history.residual_indentation(&fresh)), (0.0, 0.0), "{name}");
            go(&mut history, &fresh, on_grid(10.0));
            assert_eq!(history.force(), loading_force(&fresh, on_grid(10.0)), "{name}");
            let second = pressed(&fresh, on_grid(10.0)).dissipated_energy(&fresh);
            assert_eq!(history.dissipated_energy(&fresh), lost + second, "{name}");
        }
    }
}

#[test]
fn a_dented_surface_keeps_its_dent() {
    for (name, model) in all_models(mild()) {
        let first = pressed(&model, on_grid(20.0));
        let mut history = first;
        go(&mut history, &model, -on_grid(1000.0));
        assert_eq!(history.residual_indentation(&model), first.residual_indentation(&model), "{name}");
        assert_eq!(history.dissipated_energy(&model), first.dissipated_energy(&model), "{name}");
        go(&mut history, &model, on_grid(15.0));
        // some laws leave a dent deeper than that
        let met = on_grid(15.0) > first.residual_indentation(&model);
        let force = if met { unloading_force(&model, on_grid(20.0), on_grid(15.0)) } else { 0.0 };
        assert_eq!(history.force(), force, "{name}");
    }
}

#[test]
fn increments_that_leave_the_range_are_refused_and_change_nothing() {
    for (name, dented) in all_models(mild()) {
        for model in [dented, AnyModel { surface: Surface::Fresh, ..dented }] {
            for path in [&[-1.0][..], &[0.5], &[20.0], &[100.0, 90.0], &[20.0, 0.1], &[20.0, -1.0, 0.5]] {
                let mut history = pressed(&model, 0.0);
                for &x in path {
                    go(&mut history, &model, on_grid(x));
                }
                let before = history;
                for increment in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e101, -1e101, f64::MAX, f64::MIN] {
                    let refused = history.advance(&model, increment).expect_err("out of range").indentation;
                    // the error contains the rejected indentation: so far away, it is the increment
                    assert_eq!(refused.to_bits(), increment.to_bits(), "{name}: {increment} from {path:?}");
                    assert_eq!(history, before, "{name}: {increment} from {path:?}");
                }
            }
        }
    }
}

#[test]
fn the_range_has_the_same_end_however_it_is_reached() {
    use brinell_contact::LARGEST_INDENTATION;
    for (name, dented) in all_models(mild()) {
        for model in [dented, AnyModel { surface: Surface::Fresh, ..dented }] {
            assert!(History::start(&model, LARGEST_INDENTATION).is_err(), "{name}: started there");
            for x in [-1.0, 0.5, 20.0] {
                // one step to zero first, so that the next one ends exactly at the boundary
                let mut history = pressed(&model, on_grid(x));
                go(&mut history, &model, 0.0);
                let before = history;
                for increment in [-LARGEST_INDENTATION, LARGEST_INDENTATION] {
                    assert!(history.advance(&model, increment).is_err(), "{name}: {increment:e} after {x}");
                    assert_eq!(history, before, "{name}: {increment:e} after {x}");
                }
            }
        }
    }
}

#[test]
fn dissipated_energy_never_falls_along_a_long_path() {
    for (name, dented) in some_models(mild()).into_iter().filter(|(_, model)| is_passive(model)) {
        for model in [dented, AnyModel { surface: Surface::Fresh, ..dented }] {
            let (mut history, mut random, mut before, mut largest) = (pressed(&model, 0.0), Random(7), 0.0, 0.0_f64);
            for _ in 0..5000 {
                // over five decades of the yield indentation; a fifth of the turning points are apart
                let x = 10f64.powf(5.0 * random.next() - 1.5) * if random.next() < 0.2 { -1.0 } else { 1.0 };
                go(&mut history, &model, on_grid(x));
                largest = largest.max(history.indentation());
                let lost = history.dissipated_energy(&model);
                // a few rounding errors of the energies whose difference it is, and of the sum over all dents so far
                let hertz = 0.4 * model.pair.hertz_stiffness() * largest.powf(2.5);
                let rounding = 16.0 * f64::EPSILON * hertz.max(lost);
                assert!(lost >= before - rounding, "{name}, {:?}: from {before:e} to {lost:e} at {x}", model.surface);
                before = lost;
            }
            assert_eq!(before > 0.0, physics::yields(&model), "{name}: only a law that yields dissipates");
        }
    }
}

/// The words of a history that are stored.
fn words_of(history: &History) -> Vec<u64> {
    let mut words = Vec::new();
    Contact::<AnyModel>::save(history, &mut |word| words.push(word));
    assert_eq!(words.len(), <History as Contact<AnyModel>>::WORDS);
    words
}

fn of_words(words: &[u64], model: &AnyModel) -> Option<History> {
    History::load(&mut words.iter().copied(), model)
}

#[test]
fn words_that_are_not_a_history_are_refused() {
    let model = model("big-alabo", "contact-radius");
    let words = words_of(&pressed(&model, on_grid(20.0)));
    assert!(of_words(&words, &model).is_some());
    assert_eq!(of_words(&words[1..], &model), None, "a word is missing");
    for index in 0..words.len() {
        for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut words = words.clone();
            words[index] = wrong.to_bits();
            assert_eq!(of_words(&words, &model), None, "word {index} is {wrong}");
        }
    }
    for regime in [6, u64::MAX] {
        let mut words = words.clone();
        words[12] = regime;
        assert_eq!(of_words(&words, &model), None, "there is no regime {regime}");
    }
}

#[test]
fn on_the_way_down_the_contact_radius_is_that_of_an_elastic_recovery() {
    // that of a line is compared with finite elements
    for (name, model) in all_models(mild()).into_iter().filter(|(_, model)| !model.loading.is_line()) {
        let hertzian = !matches!(model.unloading, AnyUnloading::Brinell(_));
        let is_etsion = matches!(model.unloading, AnyUnloading::Etsion(_));
        let is_vu_quoc = matches!(model.unloading, AnyUnloading::VuQuocZhang(_));
        let depth = on_grid(20.0) / KogutEtsion::REFERENCE.unit(&model.pair).indentation;
        let mut history = pressed(&model, on_grid(20.0));
        let (radius, dent) = (history.contact_radius(&model), history.residual_indentation(&model));
        for part in [0.9, 0.25, 0.01] {
            go(&mut history, &model, dent + part * (on_grid(20.0) - dent));
            let ratio = history.contact_radius(&model) / radius;
            // Hertz's recovery, or half the stiffness over E*, which is equal on a Hertzian path
            let expected = match hertzian {
                // the area of this law is another power of the recovery, y_m^-0.12; the other law keeps a part of the radius
                _ if is_etsion => (part.powf(depth.powf(-0.12))).sqrt(),
                _ if is_vu_quoc => (history.indentation() / on_grid(20.0)).sqrt(),
                true => part.sqrt(),
                false => history.stiffness() / (2.0 * model.pair.modulus) / radius,
            };
            // the rounding error of d - d_f, a hundredth of numbers of the size of d
            assert!((ratio / expected - 1.0).abs() < 1e-13, "{name}: {ratio} after {part} of the recovery");
        }
    }
}
