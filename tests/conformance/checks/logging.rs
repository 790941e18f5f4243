//! Messages: their categories, their text, and when there are none.

use crate::checks::order::phase_of;
use crate::face::Face;
use crate::importer::{DISCARD, ERROR, Importer, Message, NAME, OK, Phase, STEP, WARNING};
use std::ptr::null;

/// Checks the form of a message: a declared category that fits the status, and a format of printf without conversions.
fn check(face: &Face, message: &Message) {
    let Message { name, status, category, text } = message;
    assert_eq!(name, NAME);
    assert!(face.categories.contains(category), "{message:?}: the category isn't declared");
    let expected = match *status {
        DISCARD => "logStatusDiscard",
        ERROR => "logStatusError",
        WARNING => "logStatusWarning",
        _ => panic!("{message:?}: a message with this status has nothing to say"),
    };
    assert_eq!(category, expected, "{message:?}");
    let plain = text.replace("%%", "").replace("##", "");
    assert!(!plain.contains(['%', '#']), "{message:?} is a format with conversions, or has references");
    assert!(text.starts_with("fmi2") && text.contains(": ") && text.trim_end() == text, "{message:?}");
    assert!(!text.contains(['\n', '\r', '\t']) && text.len() < 320, "{message:?}");
}

/// What goes wrong in many ways, one message each.
fn mistakes(i: &Importer) -> Vec<Message> {
    let mut all = Vec::new();
    let input = i.face.inputs[0];
    let rates = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e41, f64::MAX];
    for rate in rates {
        assert_eq!(i.set(&[input], &[rate]), ERROR, "{rate}");
        all.extend(i.messages());
        assert_eq!(i.reset(), OK);
    }
    for step in [f64::NAN, 0.0, -1e-300, 1e300, 123456.789, 0.00123456789] {
        assert_eq!((i.setup(0.0, Some(1e-6)), i.enter(), i.exit()), (OK, OK, OK));
        assert_eq!(i.step(0.0, step), ERROR, "{step}");
        all.extend(i.messages());
        assert_eq!(i.reset(), OK);
    }
    all
}

/// Every refused call has one message of good form, with logging on and off.
pub fn every_refusal_is_told(face: &Face) {
    for logging in [true, false] {
        let i = Importer::named(face, NAME, logging);
        let messages = mistakes(&i);
        assert_eq!(messages.len(), 12, "{messages:?}");
        for message in &messages {
            check(face, message);
            assert_eq!(message.status, ERROR);
        }
        assert!(messages[0].text.contains("NaN") && messages[1].text.contains("infinity"), "{messages:?}");
        assert!(messages[10].text.contains("123456.789"), "{:?}", messages[10]);
    }
}

/// A run without errors is silent, whether logging is on or off.
pub fn a_good_run_is_silent(face: &Face) {
    for logging in [true, false] {
        let mut i = Importer::named(face, NAME, logging);
        i.go(Phase::StepComplete);
        for step in 0..30 {
            i.press(if step < 15 { 0.1 } else { -0.2 });
            i.bits();
        }
        assert_eq!(i.terminate(), OK);
        // a unit that moves the bodies warns, since nothing here applies its force
        let messages: Vec<_> = i.messages().into_iter().filter(|message| message.status != WARNING).collect();
        assert!(messages.is_empty(), "{messages:?}");
    }
}

/// The declared categories are accepted, one by one and together. Others are, too, with a warning, and those beside them count.
pub fn categories(face: &Face) {
    for needed in ["logStatusDiscard", "logStatusError", "logAll"] {
        assert!(face.categories.iter().any(|category| category == needed), "{needed} isn't declared");
    }
    for category in &face.categories {
        for on in [true, false] {
            let i = Importer::new(face);
            assert_eq!(i.log(on, &[category]), OK, "{category}: {:?}", i.log);
            assert!(i.messages().is_empty());
        }
    }
    let i = Importer::new(face);
    let all: Vec<&str> = face.categories.iter().map(String::as_str).collect();
    assert_eq!((i.log(true, &all), i.log(false, &all)), (OK, OK));
    let long = "x".repeat(100_000);
    for unknown in
        ["", "logall", "logAll ", "LogAll", "logStatusErro", "logStatusErrors", "%s%n%d", "#1#", "Größe", &long]
    {
        for on in [true, false] {
            for categories in [vec![unknown], vec!["logAll", unknown]] {
                let i = Importer::named(face, NAME, !on);
                assert_eq!(i.log(on, &categories), OK, "{unknown:?}");
                let messages = i.messages();
                assert!(messages.len() == 1 && messages[0].text.contains("logStatusError"), "{messages:?}");
                assert_eq!(messages[0].status, WARNING);
                check(face, &messages[0]);
                assert_eq!((i.setup(0.0, None), i.enter(), i.exit()), (OK, OK, OK), "it goes on after {unknown:?}");
                let discards = on == (categories.len() == 2);
                assert_eq!(discarded(&i).len(), usize::from(discards), "after {categories:?} is set to {on}");
            }
        }
    }
}

/// The messages about a question that is discarded.
fn discarded(i: &Importer) -> Vec<Message> {
    // SAFETY: a place for a text
    assert_eq!(unsafe { (i.f().get_string_status)(i.c, 1, &mut null()) }, DISCARD);
    i.messages()
}

/// A discarded question is told if its category is on, and only then.
pub fn discarded_questions(face: &Face) {
    let i = Importer::at(face, Phase::StepComplete);
    let told = discarded(&i);
    assert_eq!(told.len(), 1);
    check(face, &told[0]);
    for (on, category, expected) in [
        (false, "logStatusDiscard", 0),
        (true, "logStatusWarning", 0),
        (true, "logAll", 1),
        (false, "logStatusError", 1),
        (false, "logAll", 0),
        (true, "logStatusDiscard", 1),
    ] {
        assert_eq!(i.log(on, &[category]), OK);
        assert_eq!(discarded(&i).len(), expected, "after {category} is set to {on}");
    }
    assert_eq!(i.log(false, &[]), OK);
    assert!(discarded(&i).is_empty());
    assert_eq!(phase_of(&i), Phase::StepComplete);
    // errors are always told
    assert_eq!(i.step(i.time, -STEP), ERROR);
    assert_eq!(i.messages().len(), 1);
}

/// Leaving the range of the law is a warning, told once with logging and without, and again after fmi2Reset or after its
/// category is switched on; never an error. It is silent only if its category is named, not if all are switched off, as
/// importers do by themselves.
pub fn warnings(face: &Face) {
    let leave = |i: &mut Importer| {
        i.press(300.0);
        i.press(-300.0);
        i.messages()
    };
    let restarted = |i: &mut Importer| {
        assert_eq!(i.reset(), OK);
        i.go(Phase::StepComplete);
        leave(i)
    };
    for logging in [true, false] {
        let mut i = Importer::named(face, NAME, logging);
        i.go(Phase::StepComplete);
        let told = leave(&mut i);
        assert!(!told.is_empty(), "300 m/s are beyond every law");
        for message in &told {
            check(face, message);
            assert_eq!(message.status, WARNING);
        }
        let again = leave(&mut i);
        for message in &again {
            let before = told.iter().any(|other| other.text.split(" = ").next() == message.text.split(" = ").next());
            assert!(!before, "told twice: {message:?}");
        }
        let all: Vec<&str> = face.categories.iter().map(String::as_str).collect();
        for off in [&[][..], &["logAll"], &all] {
            assert_eq!(i.log(false, off), OK);
            assert_eq!(restarted(&mut i), told, "after {off:?} is switched off");
        }
        assert_eq!(i.log(false, &["logStatusWarning"]), OK);
        assert!(leave(&mut i).is_empty() && restarted(&mut i).is_empty());
        assert_eq!(i.log(true, &["logStatusWarning"]), OK);
        assert!(!leave(&mut i).is_empty());
    }
}
