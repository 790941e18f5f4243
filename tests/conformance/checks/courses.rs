//! Courses of pressing and rebounding: what the values of every contact must satisfy.

use crate::face::Face;
use crate::importer::{Importer, OK, Phase, STEP};
use crate::judge::{Seen, check_values, same_values};

/// The values of all Real outputs.
fn outputs(i: &Importer) -> Vec<f64> {
    let mut values = vec![f64::NAN; i.face.outputs.len()];
    assert_eq!(i.get(&i.face.outputs, &mut values), OK, "{:?}", i.log);
    values
}

/// Pressing, rebounding, flying, pressing deeper, at several speeds: the force is there while the bodies press and gone
/// when they are apart, energies are balanced, dissipated energy doesn't fall, and no value is infinite or NaN.
pub fn values_along_a_course(face: &Face) {
    for (speed, step) in [(1e-3, 1e-5), (0.1, 1e-6), (1.0, 1e-6), (1.0, 1e-7), (10.0, 1e-6)] {
        let mut i = Importer::new(face);
        assert_eq!((i.setup(0.0, None), i.enter(), i.exit()), (OK, OK, OK));
        let mut seen = Seen::default();
        let mut largest: f64 = 0.0;
        for number in 0..160 {
            // in for 40, out for 60, deeper in for 60
            let rate = if (40..100).contains(&number) { -1.3 * speed } else { speed };
            i.set_rates(rate);
            assert_eq!(i.step(i.time, step), OK, "{:?}", i.log);
            i.time += step;
            let values = outputs(&i);
            seen = check_values(face, &values, &seen)
                .unwrap_or_else(|wrong| panic!("{speed} m/s, step {number}: {wrong}"));
            largest = largest.max(values[0]);
        }
        assert!(largest > 0.0, "{speed} m/s: nothing presses back");
        assert_eq!(i.real_status(2), (OK, i.time));
    }
}

/// The work is the force over the way: pressed in, drawn back until the bodies part, pressed in again.
pub fn work(face: &Face) {
    let is_prefix = |prefix: &&str| prefix.is_empty() || prefix.ends_with('.');
    let prefixes: Vec<&str> =
        face.named.keys().filter_map(|name| name.strip_suffix("work").filter(is_prefix)).collect();
    if prefixes.is_empty() {
        return;
    }
    let pressed = prefixes.iter().filter(|prefix| work_of(face, prefix) > 0.0).count();
    assert!(pressed > 0, "no contact has any work");
}

/// Checks the work of the contact whose variables begin with `prefix`; returns its largest value [J].
fn work_of(face: &Face, prefix: &str) -> f64 {
    let of = |name: &str| face.named[&format!("{prefix}{name}")];
    let (work, force, indentation) = (of("work"), of("force"), of("indentation"));
    let mut i = Importer::new(face);
    assert_eq!((i.setup(0.0, None), i.enter(), i.exit()), (OK, OK, OK));
    let (rates, step) = (&face.rates, 1e-8);
    let (mut sum, mut largest) = (i.real(work), 0.0f64);
    for number in 0..8000 {
        // out for long enough to part
        let rate = if (2000..5000).contains(&number) { -0.7 } else { 1.0 };
        assert_eq!(i.set(rates, &vec![rate; rates.len()]), OK, "{:?}", i.log);
        // some laws follow the rate at once
        let (from, begin) = (i.real(indentation), i.real(force));
        assert_eq!(i.step(i.time, step), OK, "{:?}", i.log);
        i.time += step;
        // a force that jumps at the touch has its value from the first moment on
        let end = i.real(force);
        let begin = if begin == 0.0 { end } else { begin };
        sum += 0.5 * (begin + end) * (i.real(indentation) - from);
        largest = largest.max(sum);
        // the trapezoids of the first steps are a poor sum of a power
        let rest = if number < 100 { 0.0 } else { (i.real(work) - sum).abs() };
        assert!(rest <= 1e-3 * largest, "step {number}: a work of {} J, but {sum} J from the force", i.real(work));
    }
    largest
}

/// The impulse grows by the mean force times the step. Its moment over the step lies between those of an impulse at the end
/// of the step and at its start.
pub fn impulse(face: &Face) {
    let beside = |name: &str| -> Vec<(u32, u32)> {
        let other = |prefix: &str| face.named.get(&format!("{prefix}{name}")).copied();
        let names = face.named.iter().filter(|(name, _)| name.ends_with("mean_force"));
        names.filter_map(|(name, &force)| Some((force, other(name.strip_suffix("mean_force")?)?))).collect()
    };
    let (impulses, moments) = (beside("impulse"), beside("impulse_moment"));
    let (mut i, mut largest) = (Importer::at(face, Phase::StepComplete), 0.0_f64);
    for step in 0..60 {
        let before: Vec<f64> = impulses.iter().map(|(_, impulse)| i.real(*impulse)).collect();
        i.press(if step < 30 { 1.0 } else { -1.0 });
        for ((mean_force, impulse), before) in impulses.iter().zip(before) {
            let (grown, taken) = (i.real(*impulse) - before, i.real(*mean_force) * STEP);
            assert!(
                (grown - taken).abs() <= 1e-9 * taken.abs() + 1e-20,
                "step {step}: {grown} N.s instead of {taken} N.s"
            );
        }
        for (mean_force, moment) in &moments {
            let (moment, most) = (i.real(*moment), i.real(*mean_force) * STEP * STEP);
            largest = largest.max(most);
            let rounding = 1e-12 * largest;
            let possible = if most > rounding { 0.0 < moment && moment < most } else { moment.abs() <= rounding };
            assert!(possible, "step {step}: a moment of {moment:e} N.s2, and at most {most:e} N.s2 is possible");
        }
    }
}

/// A step and its parts end at the same values, along a course with yield and rebound.
pub fn steps_and_their_parts(face: &Face) {
    // a unit that moves the bodies takes the rate at the start of a step: its parts need other ones
    if face.named.keys().any(|name| name.ends_with("mean_force")) {
        return;
    }
    for parts in [2, 10, 64] {
        let (mut whole, mut pieces) =
            (Importer::at(face, Phase::StepComplete), Importer::at(face, Phase::StepComplete));
        let step = 1e-5;
        for rate in [0.5, 0.5, -0.2, 0.1, 1.0, -3.0, 2.0, 2.0, -1.0] {
            [&whole, &pieces].into_iter().for_each(|i| i.set_rates(rate));
            assert_eq!(whole.step(whole.time, step), OK, "{:?}", whole.log);
            whole.time += step;
            for _ in 0..parts {
                let part = step / f64::from(parts);
                assert_eq!(pieces.step(pieces.time, part), OK, "{:?}", pieces.log);
                pieces.time += part;
            }
            same_values(face, &outputs(&whole), &outputs(&pieces))
                .unwrap_or_else(|wrong| panic!("{parts} parts: {wrong}"));
        }
    }
}
