//! The impulse of a step: exact for any course of the rate, across every corner of the law.

use crate::physics::{AnyModel, Random, mild, some_models, unit};
use brinell_contact::history::momentum::impulse;
use brinell_contact::history::path::RatePolynomial;
use brinell_contact::{History, Surface};

/// The impulse from many small steps, each with Simpson's rule, and the final contact.
fn slowly(history: &History, model: &AnyModel, course: &RatePolynomial, step: f64, parts: u32) -> (f64, History) {
    let mut contact = *history;
    let origin = history.indentation();
    let part = step / f64::from(parts);
    let mut sum = 0.0;
    let mut force = contact.force();
    let to = |time: f64, contact: &mut History| {
        let increment = origin + course.way(time) - contact.indentation();
        contact.advance(model, increment).expect("within range");
        contact.force()
    };
    for index in 0..parts {
        let middle = to((f64::from(index) + 0.5) * part, &mut contact);
        let end = to(f64::from(index + 1) * part, &mut contact);
        sum += part / 6.0 * (force + 4.0 * middle + end);
        force = end;
    }
    (sum, contact)
}

#[test]
fn the_impulse_is_the_integral_of_the_force_for_every_law_and_course() {
    let d_y = unit(&mild()).indentation;
    let mut random = Random(7);
    for (name, model) in some_models(mild()) {
        for surface in [Surface::Dented, Surface::Fresh] {
            let model = AnyModel { surface, ..model };
            let mut history = History::start(&model, 3.0 * d_y).unwrap();
            for case in 0..12 {
                let step = 1e-6;
                let mut size = || (random.next() - 0.45) * 10f64.powf(3.0 * random.next()) * d_y;
                let (rate, slope, bend) = (size() / step, size() / step / step, size() / step / step / step);
                let course = match case % 3 {
                    0 => RatePolynomial::held(rate),
                    1 => RatePolynomial { rate, slope, bend: 0.0 },
                    _ => RatePolynomial { rate, slope, bend },
                };
                let exact = impulse(&history, &model, &course, step).unwrap();
                let (sum, end) = slowly(&history, &model, &course, step, 4000);
                let scale = step * [history.force(), end.force(), sum / step].into_iter().fold(1e-3, f64::max);
                assert!((exact - sum).abs() < 2e-4 * scale, "{name}, {case}: {exact:e} instead of {sum:e}");
                history = end;
            }
        }
    }
}

#[test]
fn the_monotone_parts_of_a_course_end_where_the_rate_changes_its_sign() {
    let ends = |rate, slope, bend| RatePolynomial { rate, slope, bend }.monotone_ends(1.0);
    assert_eq!(ends(1.0, 0.0, 0.0), [1.0; 3]);
    assert_eq!(ends(1.0, -2.0, 0.0), [0.5, 1.0, 1.0]);
    assert_eq!(ends(1.0, -0.5, 0.0), [1.0; 3], "the zero is behind the step");
    assert_eq!(ends(-1.0, 0.0, 8.0), [0.5, 1.0, 1.0]);
    // (t - 1/4)(t - 3/4)
    assert_eq!(ends(0.1875, -1.0, 2.0), [0.25, 0.75, 1.0]);
    // (t - 1/2)^2 touches zero
    assert_eq!(ends(0.25, -1.0, 2.0), [1.0; 3]);
    assert_eq!(ends(0.0, 1.0, 0.0), [1.0; 3]);
}
