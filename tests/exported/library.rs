//! The library in an FMU, as bytes: small, self-contained, and without traces of where it was built.
#![cfg(target_os = "linux")]

use crate::skips;
use crate::unit;
use brinell_contact::loading::BigAlabo;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Largest size of a library [bytes]: that of an FMU that knows the mass, with the law `brinell`. It holds both the table of the curve of a
/// pair and the construction that makes it, so that a contact deeper than the table has the same law.
const LARGEST: u64 = 106_000;

/// The same with friction: the springs, their growth with the dent, and their merge, which keeps the energy where it can.
const LARGEST_WITH_FRICTION: u64 = 156_000;

/// The same where contacts share bodies: the integration of all contacts, optimized for speed.
const LARGEST_OF_SHARED_BODIES: u64 = 182_000;

/// The same with friction in two directions, whose springs are followed along chords.
const LARGEST_OF_SHARED_BODIES_WITH_FRICTION: u64 = 256_000;

/// Largest size of the library of the default scene [bytes].
const LARGEST_OF_DEFAULT: u64 = 39_000;

fn libraries() -> Vec<PathBuf> {
    unit::scenes_to_compile().iter().map(|scene| unit::library(&unit::compiled(scene))).collect()
}

/// Standard output of a binutils program; `None`, with a message, if it is not installed.
fn tool(name: &str, arguments: &[&str], library: &Path) -> Option<String> {
    let Ok(output) = Command::new(name).args(arguments).arg(library).output() else {
        skips::skipped(&format!("what {name} shows of a library"), "it isn't installed");
        return None;
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(String::from_utf8_lossy(&output.stdout).into_owned())
}

fn contains(bytes: &[u8], text: &str) -> bool {
    bytes.windows(text.len()).any(|window| window == text.as_bytes())
}

#[test]
fn it_is_small() {
    for library in libraries() {
        let size = fs::metadata(&library).unwrap().len();
        let bytes = fs::read(&library).unwrap();
        let largest = match () {
            () if contains(&bytes, "touch, part and turn") && contains(&bytes, "tangential_rate") => {
                LARGEST_OF_SHARED_BODIES_WITH_FRICTION
            }
            () if contains(&bytes, "tangential_rate") => LARGEST_WITH_FRICTION,
            () if contains(&bytes, "touch, part and turn") => LARGEST_OF_SHARED_BODIES,
            () => LARGEST,
        };
        assert!(size < largest, "{}: {size} bytes", library.display());
    }
    // the code of an output is in the library only if the scene requests the output
    let size = |scene: &Path| fs::metadata(unit::library(&unit::compiled(scene))).unwrap().len();
    let text = fs::read_to_string(unit::scene("steel_ball")).unwrap();
    let with_work = unit::write_scene("steel_ball", &text.replacen("outputs = [", "outputs = [\"work\", ", 1));
    let [default, work] = [&unit::scene("steel_ball"), &with_work].map(|scene| size(scene));
    assert!(default < LARGEST_OF_DEFAULT && default + 200 < work, "{default} and {work} bytes");
}

/// Messages are the part of a feature that an optimizer cannot see to be superfluous; constants are eight bytes each.
#[test]
fn it_has_no_words_and_constants_of_what_the_scene_lacks() {
    let [plain, frictional, elastic] = ["steel_ball", "oblique", "elastic"]
        .map(|name| fs::read(unit::library(&unit::compiled(&unit::scene(name)))).unwrap());
    assert!(contains(&plain, "indentation_rate"), "its messages are text");
    for word in ["tangential", "parallel", "external_acceleration", "effective_mass", "passivity"] {
        assert!(!contains(&plain, word), "{word}");
    }
    assert!(contains(&frictional, "tangential_rate") && !contains(&frictional, "parallel"));
    // a parameter that is a constant has no name
    assert!(!contains(&elastic, "youngs_modulus") && !contains(&elastic, "initial_gap"));
    let law = BigAlabo::REFERENCE;
    for number in [law.yield_pressure_factor, law.second_region, law.fully_plastic, law.plastic_slope] {
        let has = |library: &[u8]| library.windows(8).any(|bytes| bytes == number.to_le_bytes());
        assert!(has(&plain) && !has(&elastic), "{number}");
    }
}

/// Nothing unwinds through a library that cannot panic, and nobody needs to know which compiler made it. Versions of symbols would be those
/// of the C library on the build machine; because of an executable stack, the loader would make that of the whole process executable.
#[test]
fn it_has_no_tables_for_unwinding_no_comment_no_needed_library_and_no_executable_stack() {
    let [sections, entries] = [
        &[".eh_frame", ".comment", ".debug", ".symtab"][..],
        &["NEEDED", "VERNEED", "RPATH", "RUNPATH", "TEXTREL", "INIT", "FINI"],
    ];
    for library in libraries() {
        let Some(found) = tool("readelf", &["-SW"], &library) else { return };
        assert!(found.contains(".text") && !sections.iter().any(|name| found.contains(name)), "{found}");
        let found = tool("readelf", &["-dW"], &library).expect("as above");
        assert!(found.contains("SYMTAB") && !entries.iter().any(|name| found.contains(&format!("({name}"))), "{found}");
        let segments = tool("readelf", &["-lW"], &library).expect("as above");
        let stack = segments.lines().find(|line| line.contains("GNU_STACK")).expect("a stack segment");
        assert!(stack.contains(" RW "), "{stack}");
    }
}

#[test]
fn it_exports_the_functions_of_the_standard_and_nothing_else() {
    for library in libraries() {
        let Some(symbols) = tool("nm", &["-D", "--defined-only"], &library) else { return };
        let names: Vec<_> = symbols.lines().filter_map(|line| line.rsplit(' ').next()).collect();
        assert!(names.iter().all(|name| name.starts_with("fmi2")), "{names:?}");
        assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), 44, "{names:?}");
        assert_eq!(names.len(), 44, "{names:?}");
    }
}

/// Only memory functions, and those to which compilers translate loops over memory; above all, nothing that panics.
#[test]
fn it_takes_only_memory_functions_from_the_process() {
    let allowed = ["calloc", "free", "memcpy", "memmove", "memset", "memcmp", "bcmp", "strlen"];
    for library in libraries() {
        let Some(symbols) = tool("nm", &["-D", "--undefined-only"], &library) else { return };
        let names: Vec<_> = symbols.lines().filter_map(|line| line.rsplit(' ').next()).collect();
        assert!(names.contains(&"calloc"), "the list is that of another file: {names:?}");
        assert!(names.iter().all(|name| allowed.contains(name)), "{names:?}");
    }
}

#[test]
fn it_holds_no_path_of_the_machine_that_built_it() {
    for library in libraries() {
        let bytes = fs::read(&library).unwrap();
        let temporary = std::env::temp_dir();
        for path in ["/home", "/root", "/rustc/", "rustc/", ".cargo", "registry", env!("CARGO_MANIFEST_DIR")] {
            assert!(!contains(&bytes, path), "{path:?} in {}", library.display());
        }
        assert!(!contains(&bytes, &format!("{}/", temporary.display())), "{} in the library", temporary.display());
        assert!(contains(&bytes, "fmi2DoStep"), "the search would find nothing at all");
    }
}
