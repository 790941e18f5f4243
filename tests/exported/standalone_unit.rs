//! `[fmu] standalone = true`: a library that imports nothing from its process and takes its memory from the importer.
//! tests/platforms/kinds_of_hosts.rs tests the kinds of hosts that it runs in.
#![cfg(target_os = "linux")]

use crate::command;
use crate::unit;
use brinell_testing::long::some;
use brinell_testing::standalone;
use libloading::Library;
use std::cell::{Cell, RefCell};
use std::ffi::{CStr, CString, c_char, c_int, c_void};
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
fn its_library_has_no_undefined_symbol_and_is_hardly_larger() {
    let mut count = 0;
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
        count += 1;
    }
    assert!(count >= 2);
}

#[test]
fn its_model_description_declares_it() {
    let [standalone, other] = libraries(&unit::scene("steel_ball"));
    assert!(standalone::is_standalone(&standalone) && !standalone::is_standalone(&other));
    let page = standalone.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY").join("documentation/index.html");
    assert!(fs::read_to_string(page).expect("a unit has a page").contains("<code>allocateMemory</code>"));
}

#[test]
fn the_key_is_true_or_false() {
    let folder = command::empty_folder();
    let scene = "name = \"ball\"\nimpactor = { radius = 5e-3 }\ntarget = { material = \"mild steel\" }\n[fmu]\nstandalone = 1\n";
    fs::write(folder.path().join("scene.toml"), scene).unwrap();
    let run = command::run(folder.path(), ["export", "scene.toml"]).with_status(1);
    assert!(
        run.err.contains("scene.toml:5") && run.err.contains("expected true or false in `standalone = 1`"),
        "{run:#?}"
    );
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

type Log = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);
type Take = unsafe extern "C" fn(usize, usize) -> *mut c_void;
type GiveBack = unsafe extern "C" fn(*mut c_void);

#[repr(C)]
struct Callbacks {
    log: Log,
    take: Option<Take>,
    give_back: Option<GiveBack>,
    unused: [usize; 2],
}

/// The standalone library of the default scene, and its GUID.
fn loaded() -> (Library, CString) {
    let [path, _] = libraries(&unit::scene("steel_ball"));
    let root = path.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
    let description = fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library");
    let guid = description.split_once(" guid=\"").and_then(|(_, rest)| rest.split('"').next()).expect("a GUID");
    // SAFETY: the FMU was made by the program under test, and has no initializers
    (unsafe { Library::new(&path) }.expect("a library that can be loaded"), CString::new(guid).unwrap())
}

fn instantiate(library: &Library, guid: &CStr, take: Option<Take>, give_back: Option<GiveBack>) -> *mut c_void {
    type Instantiate = unsafe extern "C" fn(
        *const c_char,
        c_int,
        *const c_char,
        *const c_char,
        *const Callbacks,
        c_int,
        c_int,
    ) -> *mut c_void;
    let callbacks = Callbacks { log, take, give_back, unused: [0; 2] };
    // SAFETY: the type of the standard, strings that end with 0, and callbacks that are copied
    unsafe {
        let instantiate = library.get::<Instantiate>("fmi2Instantiate").expect("every unit has it");
        instantiate(c"ball".as_ptr(), 1, guid.as_ptr(), c"".as_ptr(), &raw const callbacks, 0, 0)
    }
}

fn message() -> String {
    MESSAGE.with(|message| message.borrow().clone())
}

#[test]
fn an_importer_without_memory_functions_gets_no_instance_and_an_error_that_names_the_missing_one() {
    let (library, guid) = loaded();
    for (take, give_back, missing) in [
        (None, Some(give_back as GiveBack), "allocateMemory"),
        (Some(take as Take), None, "freeMemory"),
        (None, None, "allocateMemory"),
    ] {
        assert!(instantiate(&library, &guid, take, give_back).is_null());
        assert!(message().contains(missing), "{}", message());
    }
    TAKEN.with(|taken| assert!(taken.borrow().is_empty()));
}

#[test]
fn instances_and_states_use_memory_of_the_importer_and_free_it() {
    type Get = unsafe extern "C" fn(*mut c_void, *mut *mut c_void) -> c_int;
    type Free = unsafe extern "C" fn(*mut c_void);
    let (library, guid) = loaded();
    let count = || TAKEN.with(|taken| taken.borrow().len());
    // SAFETY: the types of the standard; the instance lives, and so does the state
    unsafe {
        let instance = instantiate(&library, &guid, Some(take), Some(give_back));
        assert!(!instance.is_null() && count() == 1);
        let [get, free_state] = ["fmi2GetFMUstate", "fmi2FreeFMUstate"].map(|name| *library.get::<Get>(name).unwrap());
        let mut state = null_mut();
        assert_eq!(get(instance, &raw mut state), 0);
        assert!(!state.is_null() && count() == 2);
        assert_eq!(free_state(instance, &raw mut state), 0);
        assert!(state.is_null() && count() == 1);
        // no memory is left
        LEFT.set(0);
        assert_eq!(get(instance, &raw mut state), 3);
        assert!(state.is_null() && message().contains("memory"), "{}", message());
        assert!(instantiate(&library, &guid, Some(take), Some(give_back)).is_null() && message().contains("memory"));
        LEFT.set(usize::MAX);
        library.get::<Free>("fmi2FreeInstance").unwrap()(instance);
    }
    assert_eq!(count(), 0);
}
