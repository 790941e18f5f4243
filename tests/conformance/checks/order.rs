//! Every function in every state.

use crate::face::Face;
use crate::importer::{DISCARD, ERROR, Importer, OK, Phase, STEP};
use crate::table::{Answer, ROWS};

/// The state of an instance, asked by calls that differ between states; it is as before afterwards.
pub fn phase_of(i: &Importer) -> Phase {
    let state = i.save();
    let accepts = |call: &dyn Fn(&Importer) -> i32| {
        let status = call(i);
        assert_eq!(i.restore(state), OK);
        status == OK
    };
    let (_, time) = i.real_status(2);
    assert_eq!(i.restore(state), OK);
    let phase = if accepts(&|i| i.setup(0.0, None)) {
        Phase::Instantiated
    } else if accepts(&|i| i.exit()) {
        Phase::Initialization
    } else if accepts(&|i| i.step(time, STEP)) {
        Phase::StepComplete
    } else if accepts(&|i| i.terminate()) {
        Phase::Terminated
    } else {
        Phase::Error
    };
    i.free(state);
    i.messages();
    phase
}

/// Each call is accepted or refused as the table says, with the right message and the right state afterwards.
pub fn every_function_in_every_state(face: &Face) {
    for phase in Phase::ALL {
        for row in &ROWS {
            let mut i = Importer::at(face, phase);
            assert_eq!(phase_of(&i), phase);
            let readable = phase != Phase::Instantiated;
            let before = readable.then(|| i.bits());
            let what = format!("{} in the state {phase:?}", row.function);
            let status = (row.call)(&mut i);
            let messages = i.messages();
            let statuses: Vec<_> = messages.iter().map(|message| message.status).collect();
            match row.answer_in(phase) {
                Answer::Accepted => {
                    assert_eq!(status, OK, "{what}: {messages:?}");
                    assert!(messages.is_empty(), "{what}: {messages:?}");
                    let then = match row.function {
                        "fmi2Terminate" if phase == Phase::StepComplete => Phase::Terminated,
                        _ => row.then.unwrap_or(phase),
                    };
                    assert_eq!(phase_of(&i), then, "after {what}");
                }
                Answer::Discarded => {
                    assert_eq!((status, &*statuses), (DISCARD, &[DISCARD][..]), "{what}: {messages:?}");
                    assert_eq!(phase_of(&i), phase, "after {what}");
                    assert_eq!(Some(i.bits()), before, "after {what}");
                }
                Answer::Refused => {
                    assert_eq!((status, &*statuses), (ERROR, &[ERROR][..]), "{what}: {messages:?}");
                    let named = messages[0].text.starts_with(&format!("{}: ", row.function));
                    assert!(named, "{what}: {messages:?}");
                    assert_eq!(phase_of(&i), Phase::Error, "after {what}");
                    assert!(before.is_none_or(|before| i.bits() == before), "{what} changes a value");
                }
            }
        }
    }
}

/// fmi2Reset leads from every state to an instance like a new one.
pub fn a_reset_instance_is_like_a_new_one(face: &Face) {
    let course = |i: &mut Importer| -> Vec<Vec<u64>> {
        i.time = 0.0;
        i.go(Phase::StepComplete);
        (0..20)
            .map(|step| {
                i.press(if step < 12 { 0.5 } else { -0.4 });
                i.bits()
            })
            .collect()
    };
    let expected = course(&mut Importer::new(face));
    for phase in Phase::ALL {
        let mut i = Importer::new(face);
        // what a reset has to undo: parameters, inputs, stop time
        assert_eq!(i.set(&face.inputs[..1], &[3e-3]), OK);
        for &parameter in &face.parameters {
            let value = face.starts[&parameter];
            if value > 0.0 {
                assert_eq!(i.set(&[parameter], &[1.01 * value]), OK, "{:?}", i.log);
            }
        }
        assert_eq!(i.setup(0.0, Some(6.0 * STEP)), OK);
        i.go(phase);
        assert_eq!(i.reset(), OK, "{phase:?}: {:?}", i.log);
        assert_eq!(i.enter(), ERROR, "after a reset in the state {phase:?} the experiment is still known");
        assert_eq!(i.reset(), OK, "{phase:?}: {:?}", i.log);
        let bits = course(&mut i);
        let place = bits.iter().zip(&expected).position(|(one, other)| one != other);
        assert_eq!(place, None, "differs from a new one in this step after a reset in the state {phase:?}");
    }
}
