//! The mean force of a step of bodies with a known mass. It is far smaller than their momentum over a short step, and must not
//! be rounded like it.

use crate::physics::{AnyModel, Random, all_models, mild};
use brinell_contact::motion::{ExternalLoad, follow};
use brinell_contact::{Contact, History, Surface};

/// Number of steps.
const STEPS: u32 = 40_000;

#[test]
fn a_short_step_has_a_mean_between_the_forces_at_its_ends() {
    let models = all_models(mild());
    let mut random = Random(11);
    let one = |random: &mut Random, of: [f64; 3]| of[(random.next() * 3.0) as usize];
    let (mut compared, mut rounded) = (0, 0);
    for _ in 0..STEPS {
        let (name, model) = &models[(random.next() * models.len() as f64) as usize];
        let surface = if random.next() < 0.5 { Surface::Dented } else { Surface::Fresh };
        let model = AnyModel { surface, ..*model };
        let depth = random.log_uniform(1e-9, 1e-4);
        let mut history = History::start(&model, -depth).expect("within range");
        // on the loading curve, at once after unloading began, and farther
        let back = one(&mut random, [0.0, 1e-3, 0.05]) * depth;
        history.advance(&model, -back).expect("within range");
        let mass = random.log_uniform(1e-6, 1e6);
        let acceleration = one(&mut random, [0.0, 9.81, -1e4]);
        let speed = random.log_uniform(1e-6, 1e2) * if random.next() < 0.5 { 1.0 } else { -1.0 };
        let step = random.log_uniform(1e-25, 1e-9);
        let before = history;
        let outcome =
            follow(&mut history, &model, &ExternalLoad { mass, acceleration }, speed, step).expect("within range");
        let (from, to, mean) = (before.force(), history.force(), mass * outcome.speed_removed / step);
        if from == 0.0 || (to - from).abs() > 1e-3 * from || outcome.speed * speed <= 0.0 {
            continue;
        }
        compared += 1;
        let error = (mean - 0.5 * (from + to)).abs();
        // the last part is the rounding of a known acceleration
        let allowed = 0.5 * (to - from).abs() + 1e-14 * (from + mass * acceleration.abs());
        // where a step leaves its branch, or the law has no segments, it is the difference of two speeds
        let speeds = 16.0 * f64::EPSILON * mass * (speed.abs() + acceleration.abs() * step) / step;
        rounded += u32::from(error > allowed);
        let mut other = before;
        let way = history.indentation() - before.indentation();
        let stays = Contact::<AnyModel>::short_step(&mut other, way) && model.is_segmented();
        assert!(
            error <= if stays { allowed } else { allowed + speeds },
            "{name} on a {surface:?} surface, {mass:e} kg at {speed:e} m/s for {step:e} s from {depth:e} m, {back:e} m back, \
             {acceleration} m/s^2: {mean:e} N instead of {from:e} to {to:e} N"
        );
    }
    println!("{compared} compared, {rounded} rounded");
    assert!(compared > STEPS / 2);
    assert!(rounded < compared / 100);
}
