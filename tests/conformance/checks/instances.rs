//! What makes an instance: names, resource locations, callbacks, and strings that end with the call.

use crate::face::Face;
use crate::importer::{ERROR, Importer, Log, NAME, OK, Phase, STEP, callbacks, functions};
use brinell_fmu::fmi2::abi::*;
use std::ffi::{CStr, CString, c_int};
use std::ptr::{null, null_mut};

/// The arguments of fmi2Instantiate.
struct Arguments<'a> {
    name: *const fmi2Char,
    kind: c_int,
    guid: *const fmi2Char,
    resources: *const fmi2Char,
    callbacks: *const fmi2CallbackFunctions,
    visible: c_int,
    face: &'a Face,
}

impl Arguments<'_> {
    /// Makes an instance and frees it; whether there was one.
    fn make(&self) -> bool {
        // SAFETY: strings that end with 0 or null, callbacks that live or null
        unsafe {
            let c = (functions(self.face).instantiate)(
                self.name,
                self.kind,
                self.guid,
                self.resources,
                self.callbacks,
                self.visible,
                1,
            );
            (functions(self.face).free_instance)(c);
            !c.is_null()
        }
    }
}

fn with<T>(face: &Face, use_of: impl FnOnce(Arguments, &Log) -> T) -> T {
    let log = Log::default();
    let callbacks = callbacks(face, &log);
    let (guid, resources) = (face.guid.as_ptr(), c"".as_ptr());
    let name = c"one".as_ptr();
    use_of(Arguments { name, kind: 1, guid, resources, callbacks: &callbacks, visible: 0, face }, &log)
}

/// Names of every form; the logger gets them as they are.
pub fn names(face: &Face) {
    let long = "n".repeat(100_000);
    let names = [NAME, "x", "%", "%%", "#r1#", "a\nb", "\u{1F3D0} шар 球", "\"<&>'", "%n%n%n%n%s", &long];
    for name in names {
        let i = Importer::named(face, name, true);
        assert_eq!(i.step(0.0, STEP), ERROR);
        let messages = i.messages();
        assert_eq!(messages.len(), 1);
        assert_eq!(messages[0].name, name);
    }
    for name in ["", " ", "\t\n "] {
        let text = CString::new(name).expect("no zero");
        let made = with(face, |arguments, log| {
            let made = Arguments { name: text.as_ptr(), ..arguments }.make();
            assert!(made || log.borrow().len() == 1, "{log:?}");
            made
        });
        assert!(!made, "an instance with the name {name:?}");
    }
}

/// No unit has resources that it reads: any location will do.
pub fn resource_locations(face: &Face) {
    let long = format!("file:///{}", "x/".repeat(50_000));
    let locations = [
        "",
        "file:",
        "file:/tmp",
        "file:///tmp/with%20space/resources",
        "file://localhost/tmp",
        "file:///no/such/folder",
        "file:///C:/units/resources",
        "http://example.org/resources",
        "/tmp",
        "C:\\units\\resources",
        "%s%n",
        "file:///Größe",
        "file:///%C3%A4%ZZ%",
        "\u{1F3D0}",
        &long,
    ];
    for location in locations {
        let text = CString::new(location).expect("no zero");
        let made = with(face, |arguments, log| {
            let made = Arguments { resources: text.as_ptr(), ..arguments }.make();
            assert!(log.borrow().is_empty(), "{location:?}: {log:?}");
            made
        });
        assert!(made, "no instance with the resource location {location:?}");
    }
    assert!(with(face, |arguments, _| Arguments { resources: null(), ..arguments }.make()), "NULL");
    assert!(with(face, |arguments, _| Arguments { visible: 1, ..arguments }.make()), "visible");
}

/// Wrong arguments give no instance, and one message that names the argument.
pub fn wrong_arguments(face: &Face) {
    let refused = |change: &dyn Fn(&mut Arguments), named: &str| {
        with(face, |mut arguments, log| {
            change(&mut arguments);
            assert!(!arguments.make(), "an instance in spite of {named}");
            let log = log.borrow();
            let is_named =
                log.len() == 1 && log[0].text.contains(named) && log[0].text.starts_with("fmi2Instantiate: ");
            assert!(is_named && log[0].status == ERROR && log[0].category == "logStatusError", "{log:?}");
        });
    };
    let own = face.guid.to_str().expect("plain characters");
    let longer = CString::new(format!("{own}0")).expect("no zero");
    let shorter = CString::new(&own[..own.len() - 1]).expect("no zero");
    let other = CString::new(format!("{}{}", &own[..own.len() - 1], "~")).expect("no zero");
    for guid in [c"", c"%s", &longer, &shorter, &other] {
        refused(&|arguments| arguments.guid = guid.as_ptr(), "fmuGUID");
    }
    refused(&|arguments| arguments.guid = null(), "fmuGUID");
    refused(&|arguments| arguments.name = null(), "instanceName");
    refused(&|arguments| arguments.name = c"".as_ptr(), "instanceName");
    for kind in [0, 2, -1, c_int::MAX, c_int::MIN] {
        refused(&|arguments| arguments.kind = kind, "fmuType");
    }
    assert!(!with(face, |arguments, _| Arguments { callbacks: null(), ..arguments }.make()), "NULL callbacks");
}

/// Name, GUID, resource location and callbacks may be gone after the call, and those of a category as well.
pub fn strings_end_with_the_call(face: &Face) {
    let log = Box::new(Log::default());
    let mut own = Box::new(callbacks(face, &log));
    let mut texts: Vec<Vec<u8>> = [NAME, face.guid.to_str().expect("plain characters"), "file:///tmp", "logAll"]
        .iter()
        .map(|text| CString::new(*text).expect("no zero").into_bytes_with_nul())
        .collect();
    let f = functions(face);
    let place = |text: &[u8]| text.as_ptr().cast::<fmi2Char>();
    // SAFETY: everything lives during the calls
    unsafe {
        let (name, guid, resources) = (place(&texts[0]), place(&texts[1]), place(&texts[2]));
        let c = (f.instantiate)(name, 1, guid, resources, &raw const *own, 0, 1);
        assert!(!c.is_null());
        assert_eq!((f.set_debug_logging)(c, 1, 1, &place(&texts[3])), OK);
        // what the importer had there is overwritten, and then gone
        texts.iter_mut().for_each(|text| text.fill(b'x'));
        own.logger = None;
        own.componentEnvironment = null_mut();
        drop((texts, own));
        assert_eq!((f.do_step)(c, 0.0, STEP, 1), ERROR);
        (f.free_instance)(c);
    }
    let messages = log.borrow();
    assert!(messages.len() == 1 && messages[0].name == NAME, "{messages:?}");
    // the library's own texts stay
    let i = Importer::new(face);
    // SAFETY: constants of the library
    let before = unsafe { ((i.f().get_version)(), (i.f().get_types_platform)()) };
    let mut other = Importer::new(face);
    other.go(Phase::StepComplete);
    drop((i, other));
    // SAFETY: as above
    let texts = unsafe { (CStr::from_ptr(before.0), CStr::from_ptr(before.1)) };
    assert_eq!(texts, (c"2.0", c"default"));
}

/// An importer without a logger gets the same answers.
pub fn no_logger(face: &Face) {
    let log = Log::default();
    let silent = fmi2CallbackFunctions { logger: None, ..callbacks(face, &log) };
    with(face, |arguments, _| assert!(Arguments { callbacks: &silent, ..arguments }.make()));
    with(face, |arguments, _| assert!(!Arguments { callbacks: &silent, kind: 0, ..arguments }.make()));
    // SAFETY: everything lives during the calls
    unsafe {
        let f = functions(face);
        let c = (f.instantiate)(c"one".as_ptr(), 1, face.guid.as_ptr(), null(), &raw const silent, 0, 1);
        assert_eq!((f.do_step)(c, 0.0, STEP, 1), ERROR);
        assert_eq!((f.set_debug_logging)(c, 1, 1, &c"%s%n".as_ptr()), OK);
        assert_eq!((f.reset)(c), OK);
        (f.free_instance)(c);
    }
    assert!(log.borrow().is_empty());
}
