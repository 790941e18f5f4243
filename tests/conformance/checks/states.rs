//! States: saved in one phase and set in another, serialized, damaged.

use crate::checks::order::phase_of;
use crate::face::Face;
use crate::importer::{ERROR, Importer, OK, Phase};
use brinell_fmu::fmi2::abi::fmi2FMUstate;
use std::ffi::c_char;
use std::ptr::null_mut;

/// What an instance does from here on.
fn future(i: &mut Importer) -> Vec<Vec<u64>> {
    match phase_of(i) {
        Phase::Instantiated => i.go(Phase::StepComplete),
        Phase::Initialization => assert_eq!(i.exit(), OK),
        Phase::Terminated | Phase::Error => return vec![i.bits()],
        Phase::StepComplete => {}
    }
    i.time = i.real_status(2).1;
    let shown = |step| if step < 6 { 1.0 } else { -2.0 };
    let course = (0..12).map(|step| {
        i.press(shown(step));
        i.bits()
    });
    course.collect()
}

/// A state from each phase, set in each other, by copy and by bytes, in the same instance and in another.
pub fn every_phase_into_every_other(face: &Face) {
    for from in Phase::ALL {
        let mut origin = Importer::at(face, from);
        // a parameter other than its start, and an input
        let parameter = face.parameters.iter().find(|parameter| face.starts[parameter] > 0.0);
        if let (Some(&parameter), Phase::Instantiated | Phase::Initialization) = (parameter, from) {
            assert_eq!(origin.set(&[parameter], &[1.5 * face.starts[&parameter]]), OK, "{:?}", origin.log);
        }
        if from == Phase::StepComplete && face.capability("canInterpolateInputs") == "true" {
            // SAFETY: one element each
            let status = unsafe { (origin.f().set_real_input_derivatives)(origin.c, &face.inputs[0], 1, &1, &2e4) };
            assert_eq!(status, OK, "{:?}", origin.log);
        }
        let state = origin.save();
        let bytes = origin.bytes(state);
        let expected = future(&mut origin);
        for into in Phase::ALL {
            let mut other = Importer::at(face, into);
            assert_eq!(other.restore(state), OK, "{from:?} into {into:?}: {:?}", other.log);
            assert_eq!(phase_of(&other), from, "into {into:?}");
            assert_eq!(other.real_status(2).0 == OK, !matches!(from, Phase::Instantiated | Phase::Initialization));
            assert_eq!(other.restore(state), OK);
            other.messages();
            assert_eq!(future(&mut other), expected, "{from:?} into {into:?}");
            let mut third = Importer::at(face, into);
            let (status, read) = third.state_of(&bytes);
            assert_eq!(status, OK, "{:?}", third.log);
            assert_eq!(third.bytes(read), bytes, "{from:?}");
            assert_eq!((third.restore(read), phase_of(&third)), (OK, from));
            assert_eq!(future(&mut third), expected, "{from:?} into {into:?} by bytes");
            third.free(read);
        }
        assert_eq!(origin.restore(state), OK);
        assert_eq!(future(&mut origin), expected, "{from:?} again");
        origin.free(state);
    }
}

/// A state that exists is overwritten, not made anew.
pub fn saving_into_a_state(face: &Face) {
    let mut i = Importer::at(face, Phase::StepComplete);
    let state = i.save();
    let first = i.bytes(state);
    i.press(2.0);
    let mut same: fmi2FMUstate = state;
    // SAFETY: the state lives
    assert_eq!(unsafe { (i.f().get_fmu_state)(i.c, &raw mut same) }, OK);
    assert_eq!(same, state);
    assert_ne!(i.bytes(state), first);
    // so is a state with other parameters
    if let Some(parameter) = face.parameters.iter().find(|parameter| face.starts[parameter] > 0.0) {
        let other = Importer::new(face);
        assert_eq!(other.set(&[*parameter], &[1.5 * face.starts[parameter]]), OK, "{:?}", other.log);
        let expected = other.save();
        // SAFETY: the state lives
        assert_eq!(unsafe { (other.f().get_fmu_state)(other.c, &raw mut same) }, OK);
        assert_eq!(same, state);
        assert_eq!(i.bytes(state), i.bytes(expected));
        other.free(expected);
    }
    i.free(state);
}

/// A refused state: an error, the pointer as it was, and the instance readable.
fn refused(i: &Importer, bytes: &[c_char], what: &str) {
    let (status, state) = i.state_of(bytes);
    assert_eq!((status, state), (ERROR, null_mut()), "{what}");
    let messages = i.messages();
    assert!(messages.len() == 1 && messages[0].text.contains("the FMU state can't be used"), "{what}: {messages:?}");
}

/// Bytes with any bit changed, of any other length, and of other contents are refused.
pub fn damaged_bytes(face: &Face) {
    let mut i = Importer::at(face, Phase::StepComplete);
    let state = i.save();
    let bytes = i.bytes(state);
    let expected = i.bits();
    // of the state of many contacts, some bits
    let every = (8 * bytes.len()).div_ceil(6000) | 1;
    for bit in (0..8 * bytes.len()).step_by(every) {
        let mut changed = bytes.clone();
        changed[bit / 8] ^= (1u8 << (bit % 8)).cast_signed();
        refused(&i, &changed, &format!("bit {bit}"));
    }
    let lengths = [0, 1, 7, 8, 9, bytes.len() / 2, bytes.len() - 8, bytes.len() - 1, bytes.len() + 1, bytes.len() + 8];
    for length in lengths {
        let mut changed = bytes.clone();
        changed.resize(length, 0);
        refused(&i, &changed, &format!("{length} bytes of {}", bytes.len()));
    }
    for fill in [0, -1, 0x55] {
        refused(&i, &vec![fill; bytes.len()], "other bytes");
    }
    // bytes that have changed places: the last digits of a number, which are those of a good number then
    for word in (0..bytes.len()).step_by(8).take(1000) {
        let mut changed = bytes.clone();
        changed.swap(word, word + 1);
        if changed != bytes {
            refused(&i, &changed, &format!("bytes {word} and {}", word + 1));
        }
    }
    // buffers that are too short
    for length in [0, 1, bytes.len() - 8, bytes.len() - 1] {
        assert_eq!(i.restore(state), OK);
        let mut buffer = vec![7; bytes.len()];
        // SAFETY: the buffer is longer than announced
        let status = unsafe { (i.f().serialize_fmu_state)(i.c, state, buffer.as_mut_ptr(), length) };
        assert_eq!(status, ERROR, "{length} of {} bytes", bytes.len());
        assert!(buffer[length..].iter().all(|byte| *byte == 7), "written beyond {length} bytes");
        i.messages();
    }
    assert_eq!(i.restore(state), OK);
    assert_eq!(i.bits(), expected);
    i.press(1.0);
    i.free(state);
}
