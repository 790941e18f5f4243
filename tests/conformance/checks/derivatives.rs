//! Derivatives of inputs and outputs, and directional derivatives.

use crate::checks::variables::some;
use crate::face::Face;
use crate::importer::{ERROR, Importer, OK, Phase, STEP};
use std::ffi::c_int;

fn output_derivative(i: &Importer, reference: u32, order: c_int) -> (c_int, f64) {
    let mut value = f64::NAN;
    // SAFETY: one element each
    (unsafe { (i.f().get_real_output_derivatives)(i.c, &reference, 1, &order, &raw mut value) }, value)
}

fn input_derivative(i: &Importer, reference: u32, order: c_int, value: f64) -> c_int {
    // SAFETY: one element each
    unsafe { (i.f().set_real_input_derivatives)(i.c, &reference, 1, &order, &value) }
}

pub fn directional(i: &Importer, unknown: u32, known: u32, direction: f64) -> (c_int, f64) {
    let mut value = f64::NAN;
    // SAFETY: one element each
    let status = unsafe { (i.f().get_directional_derivative)(i.c, &unknown, 1, &known, 1, &direction, &raw mut value) };
    (status, value)
}

/// Whether the unit moves the bodies: it changes the rate itself within a step.
fn moves_bodies(face: &Face) -> bool {
    let signs = ["effective_mass", "closing_speed"];
    face.variables.iter().any(|variable| signs.iter().any(|sign| variable.name.ends_with(sign)))
}

/// Every output has the derivatives up to the declared order, and no others; other variables have none.
pub fn of_every_output(face: &Face) {
    let largest: c_int = face.capability("maxOutputDerivativeOrder").parse().expect("a number");
    for variable in some(face) {
        for order in [c_int::MIN, -1, 0, 1, 2, 3, 4, c_int::MAX] {
            let i = Importer::at(face, Phase::StepComplete);
            let (status, value) = output_derivative(&i, variable.reference, order);
            let exists = variable.causality == "output" && variable.is_real && (1..=largest).contains(&order);
            let what = format!("{}, order {order}: {:?}", variable.name, i.log);
            if exists {
                // some outputs have the first derivative only
                let accepted = status == OK && value.is_finite();
                assert!(accepted || order > 1 && status == ERROR, "{what}: {status}, {value}");
            } else {
                assert_eq!(status, ERROR, "{what}");
            }
            let told = i.messages().len();
            assert_eq!(told, usize::from(status == ERROR), "{what}");
            i.bits();
        }
    }
}

/// The indentation changes at the rate that is set, and the work by force times rate, pressing and rebounding.
pub fn are_those_of_the_course(face: &Face) {
    let moves = moves_bodies(face) || face.capability("canInterpolateInputs") == "false";
    let Some(prefix) = face.named.keys().find_map(|name| name.strip_suffix("indentation").filter(|p| p.is_empty()))
    else {
        return;
    };
    for rate in [0.4, -0.1] {
        let mut i = Importer::at(face, Phase::StepComplete);
        i.press(rate);
        let of = |name: &str| face.named.get(&format!("{prefix}{name}")).copied();
        let (status, speed) = output_derivative(&i, of("indentation").expect("it was found"), 1);
        assert_eq!(status, OK);
        if !moves {
            assert_eq!(speed, rate);
        }
        if let (Some(work), Some(force), false) = (of("work"), of("force"), moves) {
            let expected = i.real(force) * rate;
            let (status, power) = output_derivative(&i, work, 1);
            assert_eq!(status, OK);
            assert!((power - expected).abs() <= 1e-12 * expected.abs(), "{power} W instead of {expected} W");
        }
    }
}

/// Derivatives of inputs: accepted where the FMU can interpolate, for inputs only, of the orders that exist; they hold for
/// one step.
pub fn of_inputs(face: &Face) {
    let can = face.capability("canInterpolateInputs") == "true";
    let rates = &face.rates;
    for variable in some(face).into_iter().filter(|variable| variable.is_real) {
        for (order, value) in [(1, 0.0), (1, 5.0), (2, 0.0), (2, 5.0), (0, 1.0), (3, 1.0), (-1, 1.0), (c_int::MAX, 1.0)]
        {
            let i = Importer::at(face, Phase::StepComplete);
            let status = input_derivative(&i, variable.reference, order, value);
            let is_rate = rates.contains(&variable.reference);
            let expected = can && is_rate && (1..=2).contains(&order);
            // the standard lets an FMU have the first derivative only, and doesn't let it say so
            let may_differ = order == 2 && status == ERROR || !is_rate && variable.causality == "input";
            if !may_differ {
                assert_eq!(status == OK, expected, "{}, order {order}: {:?}", variable.name, i.log);
            }
            assert_eq!(i.messages().len(), usize::from(status != OK));
        }
    }
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let i = Importer::at(face, Phase::StepComplete);
        assert_eq!(input_derivative(&i, rates[0], 1, value), ERROR, "{value}");
    }
    if !can || moves_bodies(face) {
        return;
    }
    let mut i = Importer::at(face, Phase::StepComplete);
    let is_depth = |name: &str| name.rsplit('.').next() == Some("indentation");
    let depth = face.named.iter().find(|(name, _)| is_depth(name)).map(|(_, reference)| *reference);
    let Some(depth) = depth else { return };
    let advance = |i: &mut Importer| {
        let before = i.real(depth);
        assert_eq!(i.step(i.time, STEP), OK, "{:?}", i.log);
        i.time += STEP;
        i.real(depth) - before
    };
    let all = vec![0.5; rates.len()];
    assert_eq!(i.set(rates, &all), OK);
    let plain = advance(&mut i);
    let slope = 1e5;
    for &rate in rates {
        assert_eq!(input_derivative(&i, rate, 1, slope), OK);
    }
    let curved = advance(&mut i);
    let expected = plain + 0.5 * slope * STEP * STEP;
    assert!((curved - expected).abs() < 1e-12 * expected, "{curved} m instead of {expected} m");
    let after = advance(&mut i);
    assert!((after - plain).abs() < 1e-12 * plain, "{after} m instead of {plain} m: the derivative holds on");
}

/// Directional derivatives by every input are finite and linear in the direction; by other variables there are none.
pub fn in_every_direction(face: &Face) {
    let outputs: Vec<_> = some(face).into_iter().filter(|variable| variable.causality == "output").collect();
    for variable in &outputs {
        for known in face.rates.iter().copied().take(1).chain(face.sideways.iter().copied().take(1)) {
            let i = Importer::at(face, Phase::StepComplete);
            let (status, one) = directional(&i, variable.reference, known, 1.0);
            let (_, two) = directional(&i, variable.reference, known, -2.0);
            assert!(status == OK && one.is_finite() && two == -2.0 * one, "{}: {one} and {two}", variable.name);
        }
        for known in [variable.reference, face.outputs[0], u32::MAX].into_iter().chain(face.parameters.first().copied())
        {
            let i = Importer::at(face, Phase::StepComplete);
            assert_eq!(directional(&i, variable.reference, known, 1.0).0, ERROR, "{} by {known}", variable.name);
        }
    }
    for unknown in [u32::MAX, face.largest_reference() + 1] {
        let i = Importer::at(face, Phase::StepComplete);
        assert_eq!(directional(&i, unknown, face.rates[0], 1.0).0, ERROR, "{unknown}");
    }
}
