//! The C functions for scenes without an exported library: states, derivatives, phases.

use brinell_contact::damped::AnyDamped;
use brinell_fmu::c::state::Snapshot;
use brinell_fmu::fmi2::abi::{fmi2CallbackFunctions, fmi2Component, fmi2FMUstate, fmi2Status};
use brinell_fmu::fmi2::{lifecycle, states, stepping, variables};
use brinell_fmu::scene::{Absent, Present, Scene};
use brinell_testing::{physics, scenes};
use physics::{all_models, mild};
use scenes::{Choice, Chosen, Damped, Elastoplastic, Held, Massive, OUTPUTS, choose};
use std::marker::PhantomData;
use std::ptr::null_mut;

const OK: fmi2Status = 0;
const ERROR: fmi2Status = 3;

/// An instance behind its C pointer, which is freed at the end.
struct Made<S: Scene> {
    c: fmi2Component,
    scene: PhantomData<S>,
}

impl<S: Scene> Made<S> {
    fn new() -> Made<S> {
        let callbacks = fmi2CallbackFunctions {
            logger: None,
            allocateMemory: None,
            freeMemory: None,
            stepFinished: None,
            componentEnvironment: null_mut(),
        };
        let guid = std::ffi::CString::new(S::guid()).unwrap();
        // SAFETY: null-terminated strings, and callbacks that live during the call.
        let c =
            unsafe { lifecycle::instantiate::<S>(c"one".as_ptr(), 1, guid.as_ptr(), c"".as_ptr(), &callbacks, 0, 0) };
        assert!(!c.is_null());
        Made { c, scene: PhantomData }
    }

    fn ready() -> Made<S> {
        let made = Made::<S>::new();
        // SAFETY: the component lives.
        unsafe {
            assert_eq!(lifecycle::setup_experiment::<S>(made.c, 0, 0.0, 0.0, 0, 0.0), OK);
            assert_eq!(lifecycle::enter_initialization_mode::<S>(made.c), OK);
            assert_eq!(lifecycle::exit_initialization_mode::<S>(made.c), OK);
        }
        made
    }

    fn set(&self, reference: u32, value: f64) -> fmi2Status {
        // SAFETY: the component lives, and so do reference and value.
        unsafe { variables::set_real::<S>(self.c, &reference, 1, &value) }
    }

    fn get(&self, reference: u32) -> f64 {
        let mut value = f64::NAN;
        // SAFETY: as above.
        assert_eq!(unsafe { variables::get_real::<S>(self.c, &reference, 1, &mut value) }, OK);
        value
    }

    fn step(&self, time: f64, step: f64) -> fmi2Status {
        // SAFETY: as above.
        unsafe { stepping::do_step::<S>(self.c, time, step, 1) }
    }

    fn directional(&self, unknown: u32, known: u32) -> (fmi2Status, f64) {
        let mut derivative = f64::NAN;
        // SAFETY: as above.
        let status =
            unsafe { stepping::get_directional_derivative::<S>(self.c, &unknown, 1, &known, 1, &2.0, &mut derivative) };
        (status, derivative)
    }

    fn save(&self) -> fmi2FMUstate {
        let mut state = null_mut();
        // SAFETY: as above.
        assert_eq!(unsafe { states::get_fmu_state::<S>(self.c, &mut state) }, OK);
        state
    }

    fn free(&self, mut state: fmi2FMUstate) {
        // SAFETY: the state belongs to this scene, and is not used again.
        assert_eq!(unsafe { states::free_fmu_state::<S>(self.c, &mut state) }, OK);
        assert!(state.is_null());
    }

    fn bytes(&self, state: fmi2FMUstate) -> Vec<i8> {
        let mut size = 0;
        // SAFETY: the state lives, and the buffer has the requested length.
        unsafe {
            assert_eq!(states::serialized_fmu_state_size::<S>(self.c, state, &mut size), OK);
            let mut bytes = vec![0i8; size];
            assert_eq!(states::serialize_fmu_state::<S>(self.c, state, bytes.as_mut_ptr().cast(), size), OK);
            bytes
        }
    }
}

impl<S: Scene> Drop for Made<S> {
    fn drop(&mut self) {
        // SAFETY: it is not used again.
        unsafe { lifecycle::free_instance::<S>(self.c) };
    }
}

type One = Chosen<Elastoplastic, 1, Present>;
type Massive1 = Chosen<Massive, 1, Present>;
type Several = Chosen<Elastoplastic, 3, Absent>;
type DampedOne = Chosen<Damped, 1, Present>;
// differs in nothing but its name: such a contact has no derivatives of its inputs anyway
type OtherDampedOne = Chosen<Held<Damped>, 1, Present>;

fn choose_default() {
    let (_, model) = all_models(mild()).swap_remove(0);
    choose(Choice::of(model.loading, model.unloading));
}

/// States of two FMUs may look the same: each must recognize its own.
#[test]
fn a_state_of_another_fmu_is_refused_even_if_it_looks_the_same() {
    choose_default();
    let (one, other) = (Made::<OtherDampedOne>::ready(), Made::<DampedOne>::ready());
    let state = one.save();
    let bytes = one.bytes(state);
    let own = other.save();
    assert_eq!(size_of::<Snapshot<OtherDampedOne>>(), size_of::<Snapshot<DampedOne>>());
    assert_eq!(other.bytes(own).len(), bytes.len(), "the two must not be told apart by their length");
    // SAFETY: states of two FMUs with the same layout, and bytes of the given length.
    unsafe {
        assert_eq!(states::set_fmu_state::<DampedOne>(other.c, state), ERROR);
        let mut made = null_mut();
        let refused =
            states::deserialize_fmu_state::<DampedOne>(other.c, bytes.as_ptr().cast(), bytes.len(), &mut made);
        assert_eq!((refused, made.is_null()), (ERROR, true));
    }
    other.free(own);
    one.free(state);
}

/// According to the standard the pointer is only written: its old value may be invalid.
#[test]
fn deserializing_does_not_read_the_pointer_that_it_writes() {
    choose_default();
    let made = Made::<Several>::ready();
    let live = made.save();
    let bytes = made.bytes(live);
    for before in [null_mut(), 0x10 as fmi2FMUstate, usize::MAX as fmi2FMUstate, live] {
        let mut state = before;
        // SAFETY: bytes of the given length.
        let status =
            unsafe { states::deserialize_fmu_state::<Several>(made.c, bytes.as_ptr().cast(), bytes.len(), &mut state) };
        assert_eq!(status, OK);
        assert!(state != before, "a live state is not overwritten");
        assert_eq!(made.bytes(state), bytes);
        made.free(state);
    }
    assert_eq!(made.bytes(live), bytes);
    made.free(live);
}

/// Every pair of output and input has a derivative, including zeros.
#[test]
fn directional_derivatives_answer_for_every_pair_in_every_phase_of_the_standard() {
    fn check<S: Scene>() {
        let contacts = S::contacts() as u32;
        let outputs = (OUTPUTS.len() as u32 + 1) * contacts;
        let ask = |made: &Made<S>, allowed: bool| {
            for unknown in contacts..outputs + contacts {
                for known in 0..contacts {
                    let (status, derivative) = made.directional(unknown, known);
                    assert_eq!(status, if allowed { OK } else { ERROR }, "{unknown} by {known}");
                    assert!(!allowed || derivative.is_finite(), "{unknown} by {known}: {derivative}");
                    if unknown % contacts != known && allowed {
                        assert_eq!(derivative, 0.0, "another contact's input");
                    }
                }
            }
        };
        // the standard does not allow it before Initialization Mode
        assert_eq!(Made::<S>::new().directional(contacts, 0).0, ERROR);
        let made = Made::<S>::new();
        // SAFETY: the component lives.
        unsafe {
            assert_eq!(lifecycle::setup_experiment::<S>(made.c, 0, 0.0, 0.0, 0, 0.0), OK);
            assert_eq!(lifecycle::enter_initialization_mode::<S>(made.c), OK);
        }
        ask(&made, true);
        // SAFETY: the component lives.
        assert_eq!(unsafe { lifecycle::exit_initialization_mode::<S>(made.c) }, OK);
        ask(&made, true);
        for step in 0..6 {
            assert_eq!(made.set(0, [1.0, 2.0, -1.0, -3.0, 0.0, 4.0][step]), OK);
            assert_eq!(made.step(step as f64 * 1e-6, 1e-6), OK);
            ask(&made, true);
        }
        // SAFETY: the component lives.
        assert_eq!(unsafe { lifecycle::terminate::<S>(made.c) }, OK);
        ask(&made, true);
        // there are no derivatives with respect to a parameter or an output
        let refused = Made::<S>::ready();
        assert_eq!(refused.directional(contacts, contacts).0, ERROR);
        // in the error state outputs can still be read
        ask(&refused, true);
    }
    choose_default();
    check::<One>();
    check::<Several>();
    check::<Massive1>();
    for (_, damped) in AnyDamped::ALL {
        let (_, model) = all_models(mild()).swap_remove(0);
        choose(Choice { damped, ..Choice::of(model.loading, model.unloading) });
        check::<DampedOne>();
    }
}

#[test]
fn a_component_lives_from_instantiation_to_its_end_through_the_c_functions() {
    choose_default();
    let made = Made::<Several>::ready();
    for step in 0..50 {
        for contact in 0..3 {
            assert_eq!(made.set(contact, if step % 10 < 6 { 1.0 } else { -1.0 } * f64::from(contact + 1)), OK);
        }
        assert_eq!(made.step(f64::from(step) * 1e-6, 1e-6), OK);
    }
    assert!(made.get(3) > 0.0);
    let state = made.save();
    let force = made.get(4);
    assert_eq!(made.step(50e-6, 1e-6), OK);
    // SAFETY: the state lives.
    assert_eq!(unsafe { states::set_fmu_state::<Several>(made.c, state) }, OK);
    assert_eq!(made.get(4), force);
    made.free(state);
    assert_eq!(made.set(3, 1.0), ERROR, "an output can't be set");
    assert_eq!(made.step(50e-6, 1e-6), ERROR, "after an error");
    // SAFETY: the component lives.
    assert_eq!(unsafe { lifecycle::reset::<Several>(made.c) }, OK);
}

/// Proof that the sanitizer is active if `SANITIZER=address` is set, and that debug assertions are: the same program, when it
/// reads beyond an array, must end with the sanitizer's report.
#[test]
fn the_sanitizer_and_debug_assertions_are_active_where_required() {
    if std::env::var("SANITIZER").as_deref() != Ok("address") {
        println!("skipped: not run with SANITIZER=address");
        return;
    }
    let asserts = cfg!(debug_assertions);
    assert!(asserts, "debug assertions are off");
    let program = std::env::current_exe().unwrap();
    let output =
        std::process::Command::new(program).args(["--ignored", "--exact", "a_read_beyond_an_array"]).output().unwrap();
    let report = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && report.contains("AddressSanitizer: heap-buffer-overflow"), "{report}");
}

#[test]
#[ignore = "it is a mistake, made for the test above"]
fn a_read_beyond_an_array() {
    let numbers = std::hint::black_box(vec![1u8; 16]);
    // SAFETY: none; the sanitizer must report it.
    let beyond = unsafe { std::ptr::read_volatile(numbers.as_ptr().add(16)) };
    println!("{beyond}");
}
