//! Every argument NULL, wrong, repeated or huge.
//!
//! SAFETY of all calls: the components and states live, and a pointer that is not null has as many elements as announced.

use crate::checks::order::phase_of;
use crate::face::Face;
use crate::importer::{ERROR, Importer, OK, Phase, STEP};
use brinell_fmu::fmi2::abi::{fmi2Component, fmi2FMUstate};
use std::ffi::c_int;
use std::ptr::{null, null_mut};

/// Every function without an instance is fmi2Error, and fmi2FreeInstance does nothing.
pub fn no_instance(face: &Face) {
    let none: fmi2Component = null_mut();
    let f = crate::importer::functions(face);
    let (reference, mut size, mut state) = (face.inputs[0], 0, null_mut());
    // SAFETY: there is no instance, and the other arguments live
    let statuses = unsafe {
        (f.free_instance)(none);
        [
            (f.set_debug_logging)(none, 1, 0, null()),
            (f.setup_experiment)(none, 0, 0.0, 0.0, 0, 0.0),
            (f.enter_initialization_mode)(none),
            (f.exit_initialization_mode)(none),
            (f.terminate)(none),
            (f.reset)(none),
            (f.cancel_step)(none),
            (f.get_real)(none, &reference, 1, &mut 0.0),
            (f.get_integer)(none, &reference, 1, &mut 0),
            (f.get_boolean)(none, &reference, 1, &mut 0),
            (f.get_string)(none, &reference, 1, &mut null()),
            (f.set_real)(none, &reference, 1, &0.0),
            (f.set_integer)(none, &reference, 1, &0),
            (f.set_boolean)(none, &reference, 1, &0),
            (f.set_string)(none, &reference, 1, &null()),
            (f.do_step)(none, 0.0, STEP, 1),
            (f.set_real_input_derivatives)(none, &reference, 1, &1, &0.0),
            (f.get_real_output_derivatives)(none, &reference, 1, &1, &mut 0.0),
            (f.get_directional_derivative)(none, &reference, 1, &reference, 1, &1.0, &mut 0.0),
            (f.get_fmu_state)(none, &raw mut state),
            (f.set_fmu_state)(none, null_mut()),
            (f.free_fmu_state)(none, &raw mut state),
            (f.serialized_fmu_state_size)(none, null_mut(), &raw mut size),
            (f.serialize_fmu_state)(none, null_mut(), null_mut(), 0),
            (f.deserialize_fmu_state)(none, null(), 0, &raw mut state),
            (f.get_status)(none, 0, &mut 0),
            (f.get_real_status)(none, 2, &mut 0.0),
            (f.get_integer_status)(none, 2, &mut 0),
            (f.get_boolean_status)(none, 3, &mut 0),
            (f.get_string_status)(none, 1, &mut null()),
        ]
    };
    assert_eq!(statuses, [ERROR; 30]);
    assert!(state.is_null() && size == 0);
}

/// A call with one argument NULL, and the name of the argument.
type Null = (&'static str, fn(&Importer, u32, fmi2FMUstate) -> c_int);

/// More elements than memory can have: with a null pointer, nothing may be read.
const HUGE: usize = usize::MAX;

const NULLS: [Null; 26] = [
    ("vr", |i, _, _| unsafe { (i.f().get_real)(i.c, null(), 1, &mut 0.0) }),
    ("vr", |i, _, _| unsafe { (i.f().get_real)(i.c, null(), HUGE, null_mut()) }),
    ("value", |i, vr, _| unsafe { (i.f().get_real)(i.c, &vr, 1, null_mut()) }),
    ("vr", |i, _, _| unsafe { (i.f().set_real)(i.c, null(), 1, &0.0) }),
    ("vr", |i, _, _| unsafe { (i.f().set_real)(i.c, null(), HUGE, null()) }),
    ("value", |i, vr, _| unsafe { (i.f().set_real)(i.c, &vr, 1, null()) }),
    ("vr", |i, _, _| unsafe { (i.f().get_integer)(i.c, null(), 2, &mut 0) }),
    ("value", |i, vr, _| unsafe { (i.f().get_integer)(i.c, &vr, 1, null_mut()) }),
    ("vr", |i, _, _| unsafe { (i.f().get_boolean)(i.c, null(), HUGE, null_mut()) }),
    ("vr", |i, _, _| unsafe { (i.f().get_string)(i.c, null(), 1, null_mut()) }),
    ("vr", |i, _, _| unsafe { (i.f().set_integer)(i.c, null(), 1, null()) }),
    ("vr", |i, _, _| unsafe { (i.f().set_boolean)(i.c, null(), 1, null()) }),
    ("vr", |i, _, _| unsafe { (i.f().set_string)(i.c, null(), HUGE, null()) }),
    ("vr", |i, _, _| unsafe { (i.f().set_real_input_derivatives)(i.c, null(), 1, &1, &0.0) }),
    ("order", |i, vr, _| unsafe { (i.f().set_real_input_derivatives)(i.c, &vr, 1, null(), &0.0) }),
    ("value", |i, vr, _| unsafe { (i.f().set_real_input_derivatives)(i.c, &vr, 1, &1, null()) }),
    ("vr", |i, _, _| unsafe { (i.f().get_real_output_derivatives)(i.c, null(), 1, &1, &mut 0.0) }),
    ("order", |i, vr, _| unsafe { (i.f().get_real_output_derivatives)(i.c, &vr, 1, null(), &mut 0.0) }),
    ("value", |i, vr, _| unsafe { (i.f().get_real_output_derivatives)(i.c, &vr, 1, &1, null_mut()) }),
    ("FMUstate", |i, _, _| unsafe { (i.f().get_fmu_state)(i.c, null_mut()) }),
    ("FMUstate", |i, _, _| i.restore(null_mut())),
    ("FMUstate", |i, _, _| unsafe { (i.f().serialized_fmu_state_size)(i.c, null_mut(), &mut 0) }),
    ("size", |i, _, state| unsafe { (i.f().serialized_fmu_state_size)(i.c, state, null_mut()) }),
    ("serializedState", |i, _, state| unsafe { (i.f().serialize_fmu_state)(i.c, state, null_mut(), HUGE) }),
    ("serializedState", |i, _, _| unsafe { (i.f().deserialize_fmu_state)(i.c, null(), 8, &mut null_mut()) }),
    ("categories", |i, _, _| unsafe { (i.f().set_debug_logging)(i.c, 1, 1, null()) }),
];

const NULLS_OF_DERIVATIVES_AND_STATUS: [Null; 10] = [
    ("vUnknown_ref", |i, vr, _| directional(i, [null(), &vr], &1.0, &mut 0.0)),
    ("vKnown_ref", |i, vr, _| directional(i, [&vr, null()], &1.0, &mut 0.0)),
    ("dvKnown", |i, vr, _| directional(i, [&vr, &vr], null(), &mut 0.0)),
    ("dvUnknown", |i, vr, _| directional(i, [&vr, &vr], &1.0, null_mut())),
    ("value", |i, _, _| unsafe { (i.f().get_status)(i.c, 0, null_mut()) }),
    ("value", |i, _, _| unsafe { (i.f().get_real_status)(i.c, 2, null_mut()) }),
    ("value", |i, _, _| unsafe { (i.f().get_integer_status)(i.c, 2, null_mut()) }),
    ("value", |i, _, _| unsafe { (i.f().get_boolean_status)(i.c, 3, null_mut()) }),
    ("value", |i, _, _| unsafe { (i.f().get_string_status)(i.c, 1, null_mut()) }),
    ("categories", |i, _, _| unsafe { (i.f().set_debug_logging)(i.c, 0, 2, [c"logAll".as_ptr(), null()].as_ptr()) }),
];

fn directional(i: &Importer, [unknown, known]: [*const u32; 2], direction: *const f64, value: *mut f64) -> c_int {
    // SAFETY: one element each, or null
    unsafe { (i.f().get_directional_derivative)(i.c, unknown, 1, known, 1, direction, value) }
}

/// A NULL argument is fmi2Error with its name, and nothing changes.
pub fn null_arguments(face: &Face) {
    for (number, (argument, call)) in NULLS.iter().chain(&NULLS_OF_DERIVATIVES_AND_STATUS).enumerate() {
        let i = Importer::at(face, Phase::StepComplete);
        let (before, state) = (i.bits(), i.save());
        assert_eq!(call(&i, face.inputs[0], state), ERROR, "call {number}, {argument}");
        let messages = i.messages();
        let named = messages.len() == 1 && messages[0].text.ends_with(&format!("the argument {argument} is null"));
        assert!(named, "call {number}, {argument}: {messages:?}");
        assert_eq!(phase_of(&i), Phase::Error);
        assert_eq!(i.bits(), before, "call {number}, {argument}");
        i.free(state);
        // a state that is NULL, or no place for one, is nothing to free
        // SAFETY: null
        unsafe {
            assert_eq!((i.f().free_fmu_state)(i.c, null_mut()), OK);
            assert_eq!((i.f().free_fmu_state)(i.c, &mut null_mut()), OK);
        }
    }
}

/// Empty arrays may be null.
pub fn empty_arrays(face: &Face) {
    let i = Importer::at(face, Phase::StepComplete);
    // SAFETY: arrays without elements
    let statuses = unsafe {
        let f = i.f();
        [
            (f.get_real)(i.c, null(), 0, null_mut()),
            (f.get_integer)(i.c, null(), 0, null_mut()),
            (f.get_boolean)(i.c, null(), 0, null_mut()),
            (f.get_string)(i.c, null(), 0, null_mut()),
            (f.set_real)(i.c, null(), 0, null()),
            (f.set_integer)(i.c, null(), 0, null()),
            (f.set_boolean)(i.c, null(), 0, null()),
            (f.set_string)(i.c, null(), 0, null()),
            (f.set_real_input_derivatives)(i.c, null(), 0, null(), null()),
            (f.get_real_output_derivatives)(i.c, null(), 0, null(), null_mut()),
            (f.get_directional_derivative)(i.c, null(), 0, null(), 0, null(), null_mut()),
            (f.set_debug_logging)(i.c, 1, 0, null()),
        ]
    };
    assert_eq!(statuses, [OK; 12], "{:?}", i.log);
}

/// References that are repeated, many, or unknown.
pub fn repeated_and_many_references(face: &Face) {
    let i = Importer::at(face, Phase::StepComplete);
    let many: Vec<u32> = face.outputs.iter().cycle().copied().take(100_000).collect();
    let mut values = vec![f64::NAN; many.len()];
    assert_eq!(i.get(&many, &mut values), OK, "{:?}", i.log);
    for (place, value) in values.iter().enumerate() {
        assert_eq!(value.to_bits(), values[place % face.outputs.len()].to_bits(), "element {place}");
    }
    // in any order, each variable has the value that it has alone
    let mut backwards: Vec<u32> = face.reals.clone();
    backwards.reverse();
    let mut values = vec![f64::NAN; backwards.len()];
    assert_eq!(i.get(&backwards, &mut values), OK, "{:?}", i.log);
    for (reference, value) in backwards.iter().zip(&values).take(50) {
        assert_eq!(i.real(*reference).to_bits(), value.to_bits(), "{reference}");
    }
    // pairs are no ranges: of the same variable, of consecutive ones, of one contact and of two
    let first: Vec<u32> = face.reals.iter().copied().take(6).collect();
    for &one in &first {
        for &other in &first {
            let mut values = [f64::NAN; 2];
            assert_eq!(i.get(&[one, other], &mut values), OK, "{:?}", i.log);
            let alone = [i.real(one), i.real(other)];
            assert_eq!(values.map(f64::to_bits), alone.map(f64::to_bits), "{one} and {other}");
        }
    }
    for &one in face.inputs.iter().take(3) {
        for &other in face.inputs.iter().take(3) {
            assert_eq!(i.set(&[one, other], &[1e-3, 2e-3]), OK, "{:?}", i.log);
            assert_eq!(i.real(other), 2e-3);
            assert!(one == other || i.real(one) == 1e-3, "{one} and {other}");
        }
    }
    // of several values for one input, the last one counts
    let input = face.inputs[0];
    let rates: Vec<f64> = (0..100_000).map(|index| 1e-9 * f64::from(index)).collect();
    assert_eq!(i.set(&vec![input; rates.len()], &rates), OK, "{:?}", i.log);
    assert_eq!(i.real(input), rates[rates.len() - 1]);
    // a bad one among many: none is set
    let all: Vec<u32> = face.inputs.iter().copied().cycle().take(face.inputs.len().max(3)).collect();
    for place in [0, all.len() / 2, all.len() - 1] {
        for (reference, value) in [(u32::MAX, 0.1), (input, f64::NAN), (face.outputs[0], 0.1)] {
            let i = Importer::at(face, Phase::StepComplete);
            let before = i.bits();
            let (mut references, mut values) = (all.clone(), vec![0.25; all.len()]);
            (references[place], values[place]) = (reference, value);
            assert_eq!(i.set(&references, &values), ERROR, "{reference} = {value}");
            assert_eq!(i.bits(), before, "{reference} = {value} at {place}");
        }
    }
    // consecutive references that go on behind the last rate
    let i = Importer::at(face, Phase::StepComplete);
    let (before, last) = (i.bits(), face.rates[face.rates.len() - 1]);
    let beyond: Vec<u32> = (last.saturating_sub(1)..last + 3)
        .filter(|reference| face.rates.contains(reference) || face.outputs.contains(reference))
        .collect();
    if beyond.iter().any(|reference| face.outputs.contains(reference)) {
        assert_eq!(i.set(&beyond, &vec![0.25; beyond.len()]), ERROR, "{beyond:?}");
        assert_eq!(i.bits(), before, "{beyond:?}");
    }
}

/// Unknown references, and those of other types, are refused by every function that takes references.
pub fn wrong_references(face: &Face) {
    let largest = face.largest_reference();
    let unknown = [largest + 1, largest + 2, 2 * largest + 100, 1 << 16, 1 << 31, u32::MAX - 1, u32::MAX];
    let unknown = unknown.into_iter().filter(|reference| !face.reals.contains(reference));
    type Call = fn(&Importer, u32) -> c_int;
    let calls: [(&str, Call); 10] = [
        ("Real", |i, vr| i.get(&[vr], &mut [0.0])),
        ("Real", |i, vr| i.set(&[vr], &[0.0])),
        ("Integer", |i, vr| i.get_integers(&[vr], &mut [0])),
        ("Integer", |i, vr| unsafe { (i.f().set_integer)(i.c, &vr, 1, &0) }),
        ("Boolean", |i, vr| unsafe { (i.f().get_boolean)(i.c, &vr, 1, &mut 0) }),
        ("Boolean", |i, vr| unsafe { (i.f().set_boolean)(i.c, &vr, 1, &0) }),
        ("String", |i, vr| unsafe { (i.f().get_string)(i.c, &vr, 1, &mut null()) }),
        ("String", |i, vr| unsafe { (i.f().set_string)(i.c, &vr, 1, &c"".as_ptr()) }),
        ("Real", |i, vr| unsafe { (i.f().get_real_output_derivatives)(i.c, &vr, 1, &1, &mut 0.0) }),
        ("Real", |i, vr| unsafe { (i.f().set_real_input_derivatives)(i.c, &vr, 1, &1, &0.0) }),
    ];
    let integers: Vec<u32> = face.integers.iter().copied().take(2).collect();
    let others = face.reals.iter().copied().take(3).chain(integers.iter().copied());
    for reference in unknown.chain(others) {
        for (kind, call) in calls {
            let is_kind = match kind {
                "Real" => face.reals.contains(&reference),
                "Integer" => face.integers.contains(&reference),
                _ => false,
            };
            if is_kind {
                continue;
            }
            let i = Importer::at(face, Phase::StepComplete);
            assert_eq!(call(&i, reference), ERROR, "{kind} {reference}");
            let messages = i.messages();
            assert!(messages.len() == 1 && !messages[0].text.is_empty(), "{kind} {reference}: {messages:?}");
            if !face.reals.contains(&reference) && !face.integers.contains(&reference) {
                assert!(messages[0].text.contains(&reference.to_string()), "{messages:?}");
            }
        }
    }
}
