//! Steps, times and questions about the status.

use crate::checks::order::phase_of;
use crate::face::Face;
use crate::importer::{DISCARD, ERROR, Importer, OK, Phase, STEP};
use std::ffi::c_int;
use std::ptr::null;

/// Steps and times that are wrong are refused; those that rounding makes are taken.
pub fn times(face: &Face) {
    let wrong = [
        (0.0, 0.0),
        (0.0, -STEP),
        (0.0, f64::NAN),
        (0.0, f64::INFINITY),
        (f64::NAN, STEP),
        (f64::INFINITY, STEP),
        (0.5 * STEP, STEP),
        (-0.5 * STEP, STEP),
        (1.0, STEP),
        (0.0, -0.0),
        (0.0, f64::MAX),
    ];
    for (late, step) in wrong {
        let i = Importer::at(face, Phase::StepComplete);
        let before = i.bits();
        assert_eq!(i.step(i.time + late, step), ERROR, "a step of {step} from {late} after the end of the last one");
        assert_eq!(i.messages().len(), 1);
        assert_eq!(i.bits(), before);
    }
    for late in [1e-9 * STEP, -1e-9 * STEP, 0.01 * STEP, -0.01 * STEP] {
        let i = Importer::at(face, Phase::StepComplete);
        assert_eq!(i.step(i.time + late, STEP), OK, "{late}: {:?}", i.log);
        assert_eq!(i.real_status(2), (OK, i.time + late + STEP));
    }
    for (start, stop) in [(f64::NAN, None), (f64::INFINITY, None), (0.0, Some(f64::NAN)), (1.0, Some(0.5))] {
        let i = Importer::new(face);
        assert_eq!(i.setup(start, stop), ERROR, "{start} to {stop:?}");
        assert_eq!(i.enter(), ERROR);
    }
    let i = Importer::new(face);
    assert_eq!(
        (i.setup(0.0, Some(f64::INFINITY)), i.enter(), i.exit()),
        (OK, OK, OK),
        "an infinite stop time is no end"
    );
    assert_eq!(i.step(0.0, STEP), OK);
    // the stop time: rounding is no step beyond it, a hundredth of a step is one
    for (over, expected) in [(0.0, OK), (1e-6, OK), (1e-2, ERROR), (1.0, ERROR)] {
        let i = Importer::new(face);
        assert_eq!((i.setup(0.0, Some(STEP)), i.enter(), i.exit()), (OK, OK, OK));
        assert_eq!(i.step(0.0, STEP * (1.0 + over)), expected, "{over} of a step beyond the stop time");
    }
    let i = Importer::new(face);
    assert_eq!(i.enter(), ERROR, "no initialization without fmi2SetupExperiment");
}

/// Time may be counted as importers do, anywhere on its axis: as a sum of steps, as multiples of one, and with the step as the difference of two
/// points. A sum may end behind the stop time by its rounding, and the next step from there is refused; the last experiment counts.
pub fn ways_of_counting(face: &Face) {
    let count = 1000usize.div_ceil(face.rates.len());
    for start in [0.0, -3.0, 1e5] {
        // at 1e5 s a third of a microsecond is some 20,000 roundings, and a nanosecond 69: ten of these end 4 % of a step late
        for (step, count) in [(1e-3, count), (STEP / 3.0, count), (0.1, count), (1e-9, 10)] {
            let begun = |stop| {
                let i = Importer::new(face);
                // another experiment before it
                assert_eq!((i.setup(0.0, Some(1e-9)), i.setup(start, stop)), (OK, OK));
                assert_eq!((i.enter(), i.exit()), (OK, OK), "{:?}", i.log);
                i
            };
            let point = |number: usize| start + number as f64 * step;
            let mut sum = start;
            let (counted, mixed, summed) = (begun(None), begun(None), begun(Some(point(count))));
            for number in 0..count {
                let what = format!("step {number} of {step} from {start}");
                assert_eq!(summed.step(sum, step), OK, "{what}: {:?}", summed.log);
                assert_eq!(counted.step(point(number), step), OK, "{what}: {:?}", counted.log);
                assert_eq!(mixed.step(point(number), point(number + 1) - point(number)), OK, "{what}: {:?}", mixed.log);
                sum += step;
            }
            // the points given count, not a sum of the library
            assert_eq!(counted.real_status(2), (OK, point(count - 1) + step));
            // where time is known to a step, half a step off is a mistake, and one from the stop time
            if step > 1e-9 {
                assert_eq!(summed.step(sum, step), ERROR);
                assert_eq!(counted.step(point(count) + 0.5 * step, step), ERROR);
                assert_eq!(mixed.step(point(count) - 0.5 * step, step), ERROR);
            }
        }
    }
}

/// Questions about the status: what exists is told, the rest is discarded.
pub fn statuses(face: &Face) {
    let i = Importer::at(face, Phase::StepComplete);
    for kind in [c_int::MIN, -1, 0, 1, 2, 3, 4, 77, c_int::MAX] {
        let (mut status, mut integer, mut boolean, mut text) = (7, 7, 7, null());
        let (real_status, real) = i.real_status(kind);
        assert_eq!(real_status, if kind == 2 { OK } else { DISCARD }, "{kind}");
        assert!(if kind == 2 { (real - i.time).abs() < 1e-15 } else { real.is_nan() }, "{kind}: {real}");
        // SAFETY: places for one answer each
        unsafe {
            let given = (i.f().get_status)(i.c, kind, &raw mut status);
            assert_eq!((given, status), if kind == 0 { (OK, OK) } else { (DISCARD, 7) }, "{kind}");
            let given = (i.f().get_boolean_status)(i.c, kind, &raw mut boolean);
            assert_eq!((given, boolean), if kind == 3 { (OK, 0) } else { (DISCARD, 7) }, "{kind}");
            assert_eq!(((i.f().get_integer_status)(i.c, kind, &raw mut integer), integer), (DISCARD, 7));
            assert_eq!((i.f().get_string_status)(i.c, kind, &raw mut text), DISCARD);
        }
        assert!(text.is_null());
    }
    assert_eq!(phase_of(&i), Phase::StepComplete);
}
