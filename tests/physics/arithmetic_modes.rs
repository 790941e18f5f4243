//! A host may have changed the direction of rounding, or take numbers below the normal ones as zero. Results then differ by
//! roundings only.
#![cfg(target_arch = "x86_64")]

use crate::physics::{AnyModel, TURNS, advance, all_models, mild, model, on_grid, pressed};
use brinell_contact::History;
use brinell_testing::arithmetic::{MODES, control, set_control};
use std::hint::black_box;

/// The result of `work` in a mode of arithmetic.
fn within<T>(mode: u32, work: impl FnOnce() -> T) -> T {
    let usual = control();
    set_control(usual | mode);
    // prevents any computation before or after
    let result = black_box(black_box(work)());
    set_control(usual);
    result
}

/// Force \[N\], elastic and dissipated energy \[J\], dent \[m\], and the square of the contact radius \[m^2\], as the radius
/// begins with a root.
fn readings(history: &History, model: &AnyModel) -> [f64; 5] {
    let radius = history.contact_radius(model);
    [
        history.force(),
        history.elastic_energy(model),
        history.dissipated_energy(model),
        history.residual_indentation(model),
        radius * radius,
    ]
}

/// The readings at the turns of a path that is walked in `parts` between any two of them.
fn along(model: &AnyModel, parts: u32) -> Vec<[f64; 5]> {
    let mut history = pressed(model, 0.0);
    let to = |turn| {
        let increment = (on_grid(turn) - history.indentation()) / f64::from(parts);
        (0..parts).for_each(|_| advance(&mut history, model, increment));
        readings(&history, model)
    };
    TURNS.into_iter().map(to).collect()
}

#[test]
fn the_modes_are_set() {
    let third = |mode| within(mode, || black_box(1.0) / black_box(3.0));
    assert!(third(MODES[0]) < third(MODES[1]));
    let tiny = |mode| within(mode, || black_box(f64::MIN_POSITIVE) * black_box(0.5));
    assert_eq!((tiny(0) > 0.0, tiny(MODES[3]) > 0.0), (true, false));
}

#[test]
fn a_path_gives_the_same_in_every_mode_of_arithmetic() {
    for (name, model) in all_models(mild()) {
        for parts in [1, 7, 1000] {
            let usual = along(&model, parts);
            let largest = |index: usize| usual.iter().map(|seen| seen[index].abs()).fold(0.0, f64::max);
            let work = largest(1) + largest(2);
            let sizes = [largest(0), work, work, largest(3), largest(4)];
            for &mode in MODES {
                for (turn, (one, two)) in usual.iter().zip(within(mode, || along(&model, parts))).enumerate() {
                    for index in 0..5 {
                        assert!(
                            (one[index] - two[index]).abs() <= 1e-13 * sizes[index],
                            "{name}, mode {mode:x}, turn {turn} in {parts} parts, {index}: {:e} instead of {:e}",
                            two[index],
                            one[index]
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn a_million_small_steps_lose_nothing_in_any_mode() {
    let model = model("big-alabo", "contact-radius");
    for &mode in MODES {
        for (start, step) in [(0.0, 1.1e-15), (1.0, 1.1e-17)] {
            let end = within(mode, || {
                let mut history = pressed(&model, start);
                (0..1_000_000).for_each(|_| advance(&mut history, &model, step));
                history.indentation()
            });
            let right = start + 1e6 * step;
            assert!((end - right).abs() <= 4.0 * f64::EPSILON * right, "mode {mode:x}: {end:e} instead of {right:e}");
        }
    }
}
