//! Transitions between branches: exactly at a corner, one unit in the last place beside it, at rest.

use crate::physics::{
    AnyModel, Random, TURNS, advance, all_models, corners, exactly, go, is_passive, mild, model, on_grid, pair_of,
    pressed, unloading_stiffness,
};
use brinell_contact::{History, Loading, Regime, Surface};

#[test]
fn no_motion_changes_nothing() {
    for (name, model) in all_models(mild()) {
        let mut history = pressed(&model, 0.0);
        let mut random = Random(1);
        for turn in TURNS {
            for part in [random.next(), 1.0] {
                let now = history.indentation();
                go(&mut history, &model, now + part * (on_grid(turn) - now));
                let before = history;
                for zero in [0.0, -0.0] {
                    advance(&mut history, &model, zero);
                    assert_eq!(history, before, "{name} at {turn}");
                }
            }
        }
        for corner in corners(&model) {
            let mut history = pressed(&model, 0.75 * corner);
            exactly(&mut history, &model, corner);
            let before = history;
            advance(&mut history, &model, 0.0);
            assert_eq!(history, before, "{name}: at the corner {corner:e}");
        }
    }
}

#[test]
fn no_motion_at_the_residual_indentation_keeps_the_contact_that_was_just_made() {
    for (name, model) in all_models(mild()) {
        let mut history = pressed(&model, on_grid(20.0));
        let residual = history.residual_indentation(&model);
        if residual == 0.0 {
            continue;
        }
        exactly(&mut history, &model, 0.75 * residual);
        exactly(&mut history, &model, residual);
        let before = history;
        advance(&mut history, &model, 0.0);
        assert_eq!(history, before, "{name}");
    }
}

#[test]
fn no_gap_is_a_positive_zero() {
    for (name, model) in all_models(mild()) {
        for gap in [0.0, -0.0] {
            let history = History::start(&model, gap).expect("within range");
            for value in [history.indentation(), history.force(), history.max_indentation(), history.work(&model)] {
                assert_eq!(value.to_bits(), 0, "{name}: {value}");
            }
            assert_eq!(history.regime(), Regime::Apart, "{name}");
        }
    }
}

#[test]
fn at_a_corner_of_the_loading_curve_the_branch_above_holds() {
    for (name, model) in all_models(mild()) {
        for corner in corners(&model) {
            let [below, at, above] = [corner.next_down(), corner, corner.next_up()].map(|end| {
                let mut history = pressed(&model, 0.75 * corner);
                exactly(&mut history, &model, end);
                history
            });
            let slope = |d: f64| model.loading.segment(&model.pair, d).stiffness(d);
            assert_eq!(below.stiffness(), slope(corner.next_down()), "{name} below {corner:e}");
            assert_eq!(at.stiffness(), slope(corner), "{name} at {corner:e}");
            assert_eq!(above.stiffness(), slope(corner.next_up()), "{name} above {corner:e}");
            assert_eq!(at.regime(), above.regime(), "{name} at {corner:e}");
            // not every corner is the boundary of a regime, but at each of them the law has another piece
            let end = |d: f64| model.loading.next_corner(&model.pair, d);
            assert_eq!(end(corner.next_down()), corner, "{name} at {corner:e}");
            assert!(end(corner) > corner, "{name} at {corner:e}");
            // two pieces meet within the rounding of their terms, of which the largest are about twenty times the force
            let rounding = 1e-14 * at.force();
            assert!(below.force() <= at.force() + rounding, "{name} at {corner:e}");
            assert!(at.force() <= above.force() + rounding, "{name} at {corner:e}");
        }
    }
}

#[test]
fn at_the_largest_indentation_the_way_up_is_loading_and_the_way_down_unloading() {
    for (name, model) in all_models(mild()).into_iter().filter(|(_, model)| !corners(model).is_empty()) {
        let peak = on_grid(20.0);
        let regime = model.loading.regime(&model.pair, peak);
        let reach = |from: f64, to: f64| {
            let mut history = pressed(&model, peak);
            exactly(&mut history, &model, from);
            exactly(&mut history, &model, to);
            history
        };
        let loading_stiffness = pressed(&model, peak).stiffness();
        for from in [peak, on_grid(19.0)] {
            let below = reach(from, peak.next_down());
            assert_eq!(
                (below.regime(), below.stiffness()),
                (Regime::Unloaded, unloading_stiffness(&model, peak, peak.next_down())),
                "{name}"
            );
            let at = reach(from, peak);
            assert_eq!((at.regime(), at.stiffness()), (regime, loading_stiffness), "{name}");
            let above = reach(from, peak.next_up());
            assert_eq!((above.regime(), above.max_indentation()), (regime, peak.next_up()), "{name}");
        }
        assert!(unloading_stiffness(&model, peak, peak) > loading_stiffness, "{name}: a corner");
    }
}

#[test]
fn at_the_residual_indentation_the_way_up_is_contact_and_the_way_down_apart() {
    for (name, model) in all_models(mild()).into_iter().filter(|(_, model)| !corners(model).is_empty()) {
        let first = pressed(&model, on_grid(20.0));
        let residual = first.residual_indentation(&model);
        let reach = |from: f64, to: f64| {
            let mut history = first;
            exactly(&mut history, &model, from);
            exactly(&mut history, &model, to);
            (history.regime(), history.stiffness())
        };
        let (down, up) = (on_grid(20.0), 0.75 * residual);
        let apart = (Regime::Apart, 0.0);
        let contact = |d: f64| (Regime::Unloaded, unloading_stiffness(&model, on_grid(20.0), d));
        assert_eq!(reach(down, residual.next_up()), contact(residual.next_up()), "{name}: down to just above");
        assert_eq!(reach(down, residual), apart, "{name}: down to it");
        assert_eq!(reach(down, residual.next_down()), apart, "{name}: down to just below");
        assert_eq!(reach(up, residual.next_down()), apart, "{name}: up to just below");
        assert_eq!(reach(up, residual), contact(residual), "{name}: up to it");
        assert_eq!(reach(up, residual.next_up()), contact(residual.next_up()), "{name}: up to just above");
    }
}

#[test]
fn the_regimes_follow_the_path() {
    use Regime::{Apart, Elastic, ElastoplasticFirst, ElastoplasticSecond, FullyPlastic, Unloaded};
    #[rustfmt::skip]
    let course = [
        (-1.0, Apart), (0.0, Apart), (0.5, Elastic), (0.0, Apart), (0.9, Elastic), (1.1, ElastoplasticFirst),
        (1.0, Unloaded), (0.01, Apart), (1.05, Unloaded), (5.0, ElastoplasticFirst), (14.0, ElastoplasticSecond),
        (13.0, Unloaded), (82.0, ElastoplasticSecond), (83.0, FullyPlastic), (82.0, Unloaded), (-9.0, Apart),
        (82.0, Unloaded), (90.0, FullyPlastic),
    ];
    let model = model("big-alabo", "contact-radius");
    let mut history = pressed(&model, -on_grid(2.0));
    for (x, regime) in course {
        go(&mut history, &model, on_grid(x));
        assert_eq!(history.regime(), regime, "at {x}");
    }
    // an untouched spot is elastic again
    let fresh = AnyModel { surface: Surface::Fresh, ..model };
    for (x, regime) in [(90.0, FullyPlastic), (1.0, Apart), (-1.0, Apart), (0.5, Elastic), (2.0, ElastoplasticFirst)] {
        go(&mut history, &fresh, on_grid(x));
        assert_eq!(history.regime(), regime, "fresh, at {x}");
    }
}

#[test]
fn apart_there_is_neither_contact_radius_nor_pressure() {
    for (name, model) in all_models(mild()) {
        let mut history = pressed(&model, on_grid(20.0));
        assert!(history.contact_radius(&model) > 0.0 && history.mean_pressure(&model) > 0.0, "{name}");
        for x in [0.01, 0.0, -1.0] {
            go(&mut history, &model, on_grid(x));
            if history.regime() == Regime::Apart {
                let readings = [history.contact_radius(&model), history.mean_pressure(&model), history.force()];
                assert_eq!(readings, [0.0; 3], "{name} at {x}");
            }
        }
        assert_eq!(history.regime(), Regime::Apart, "{name}: at the end at the latest");
    }
}

#[test]
fn a_few_roundings_beyond_yield_the_dent_is_not_above_the_surface() {
    let mut random = Random(3);
    // the rounding of these numbers differs from pair to pair
    let mut pair = || {
        let radius = 10f64.powf(-4.0 * random.next());
        pair_of(radius, 10f64.powf(9.0 + 3.0 * random.next()), 10f64.powf(6.0 + 2.0 * random.next()))
    };
    for (name, model) in (0..200).flat_map(|_| all_models(pair())).filter(|(_, model)| is_passive(model)) {
        for corner in corners(&model).into_iter().take(1) {
            let mut largest = corner;
            for _ in 0..10 {
                let history = pressed(&model, largest);
                let depth = history.residual_indentation(&model);
                assert!(depth >= 0.0 && depth < largest, "{name} from {largest:e}: {depth:e}");
                // work of loading minus that of unloading: each has a few rounding errors of the first
                let rounding = 8.0 * f64::EPSILON * history.work(&model);
                assert!(history.dissipated_energy(&model) >= -rounding, "{name} from {largest:e}");
                largest = largest.next_up();
            }
        }
    }
}
