//! `[fmu] standalone = true`: a library that imports nothing from its process and takes its memory from the importer.
//! tests/platforms/kinds_of_hosts.rs tests the kinds of hosts that it runs in.
#![cfg(target_os = "linux")]

use crate::unit;
use brinell_fmu::fmi2::abi::*;
use brinell_testing::face::Face;
use brinell_testing::functions::variadic;
use brinell_testing::long::some;
use brinell_testing::standalone;
use std::cell::{Cell, RefCell};
use std::ffi::{CStr, c_char, c_int, c_void};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::ptr::null_mut;

/// The library of the standalone form of a scene, and that of the unchanged scene.
fn libraries(scene: &Path) -> [PathBuf; 2] {
    [standalone::scene(scene), scene.into()].map(|scene| unit::library(&unit::compiled(&scene)))
}

/// One contact and everything at once; in a long run a rate-dependent one, too.
fn scenes() -> impl Iterator<Item = PathBuf> {
    some(["steel_ball", "damped", "everything"].map(unit::scene), 2)
}

#[test]
fn its_library_has_no_undefined_symbol_is_hardly_larger_and_is_declared() {
    for scene in scenes() {
        let [standalone, other] = libraries(&scene);
        let undefined = |library: &Path| {
            let output = Command::new("nm").args(["-D", "--undefined-only"]).arg(library).output().expect("binutils");
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            String::from_utf8_lossy(&output.stdout).into_owned()
        };
        assert_eq!(undefined(&standalone), "", "{}", scene.display());
        assert!(undefined(&other).contains(" calloc"), "the list is that of another file");
        let [size, before] = [&standalone, &other].map(|library| fs::metadata(library).expect("a library").len());
        // own memory functions instead of calls of those of the process
        assert!(size < before + 400, "{}: {size} against {before} bytes", scene.display());
        assert!(standalone::is_standalone(&standalone) && !standalone::is_standalone(&other));
        let page = standalone.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY").join("documentation/index.html");
        assert!(fs::read_to_string(page).expect("a unit has a page").contains("<code>allocateMemory</code>"));
    }
}

thread_local! {
    /// Memory that was allocated and not freed yet, and the number of allocations left.
    static TAKEN: RefCell<Vec<(*mut c_void, usize)>> = const { RefCell::new(Vec::new()) };
    static LEFT: Cell<usize> = const { Cell::new(usize::MAX) };
    static MESSAGE: RefCell<String> = const { RefCell::new(String::new()) };
}

unsafe extern "C" fn log(_: *mut c_void, _: *const c_char, _: c_int, _: *const c_char, message: *const c_char) {
    // SAFETY: messages end with 0
    let text = unsafe { CStr::from_ptr(message) }.to_string_lossy().into_owned();
    MESSAGE.with(|last| *last.borrow_mut() = text);
}

unsafe extern "C" fn take(count: usize, size: usize) -> *mut c_void {
    if LEFT.get() == 0 {
        return null_mut();
    }
    LEFT.set(LEFT.get() - 1);
    // aligned for the largest type
    let words = (count * size).div_ceil(16);
    let memory = Box::leak(vec![0u128; words].into_boxed_slice()).as_mut_ptr().cast::<c_void>();
    TAKEN.with(|taken| taken.borrow_mut().push((memory, words)));
    memory
}

unsafe extern "C" fn give_back(memory: *mut c_void) {
    TAKEN.with(|taken| {
        let mut taken = taken.borrow_mut();
        let place = taken.iter().position(|(known, _)| *known == memory).expect("it was taken, and not given back yet");
        let (memory, words) = taken.remove(place);
        // SAFETY: it was leaked above
        drop(unsafe { Box::from_raw(std::ptr::slice_from_raw_parts_mut(memory.cast::<u128>(), words)) });
    });
}

/// The standalone FMU of the default scene.
fn loaded() -> Face {
    Face::load(&libraries(&unit::scene("steel_ball"))[0])
}

fn instantiate(
    face: &Face,
    take: Option<fmi2CallbackAllocateMemory>,
    give_back: Option<fmi2CallbackFreeMemory>,
) -> fmi2Component {
    let callbacks = fmi2CallbackFunctions {
        logger: Some(variadic(log)),
        allocateMemory: take,
        freeMemory: give_back,
        stepFinished: None,
        componentEnvironment: null_mut(),
    };
    let (name, guid, nothing) = (c"ball".as_ptr(), face.guid.as_ptr(), c"".as_ptr());
    // SAFETY: strings that end with 0, and callbacks that are copied
    unsafe { (face.functions.instantiate)(name, 1, guid, nothing, &raw const callbacks, 0, 0) }
}

fn message() -> String {
    MESSAGE.with(|message| message.borrow().clone())
}

#[test]
fn an_importer_without_memory_functions_gets_no_instance_and_an_error_that_names_the_missing_one() {
    let face = loaded();
    for (take, give_back, missing) in [
        (None, Some(give_back as fmi2CallbackFreeMemory), "allocateMemory"),
        (Some(take as fmi2CallbackAllocateMemory), None, "freeMemory"),
        (None, None, "allocateMemory"),
    ] {
        assert!(instantiate(&face, take, give_back).is_null());
        assert!(message().contains(missing), "{}", message());
    }
    TAKEN.with(|taken| assert!(taken.borrow().is_empty()));
}

#[test]
fn instances_and_states_use_memory_of_the_importer_and_free_it() {
    let face = loaded();
    let count = || TAKEN.with(|taken| taken.borrow().len());
    let mut state = null_mut();
    // SAFETY: the instance lives, and so does the state
    unsafe {
        let instance = instantiate(&face, Some(take), Some(give_back));
        assert!(!instance.is_null() && count() == 1);
        assert_eq!((face.functions.get_fmu_state)(instance, &raw mut state), 0);
        assert!(!state.is_null() && count() == 2);
        assert_eq!((face.functions.free_fmu_state)(instance, &raw mut state), 0);
        assert!(state.is_null() && count() == 1);
        // no memory is left
        LEFT.set(0);
        assert_eq!((face.functions.get_fmu_state)(instance, &raw mut state), 3);
        assert!(state.is_null() && message().contains("memory"), "{}", message());
        assert!(instantiate(&face, Some(take), Some(give_back)).is_null() && message().contains("memory"));
        LEFT.set(usize::MAX);
        (face.functions.free_instance)(instance);
    }
    assert_eq!(count(), 0);
}
