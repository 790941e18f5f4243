//! The library in an FMU, as bytes: small, self-contained, and without traces of where it was built.
#![cfg(target_os = "linux")]

use crate::skips;
use crate::unit;
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
    let library = unit::library(&unit::compiled(&unit::scene("steel_ball")));
    let size = fs::metadata(&library).unwrap().len();
    assert!(size < LARGEST_OF_DEFAULT, "{size} bytes");
}

/// Messages are the part of a feature that an optimizer cannot see to be superfluous.
#[test]
fn it_has_no_words_of_features_that_the_scene_lacks() {
    let library = fs::read(unit::library(&unit::compiled(&unit::scene("steel_ball")))).unwrap();
    assert!(contains(&library, "indentation_rate"), "its messages are text");
    for word in ["tangential", "parallel", "external_acceleration", "effective_mass", "passivity"] {
        assert!(!contains(&library, word), "{word}");
    }
    let frictional = fs::read(unit::library(&unit::compiled(&unit::scene("oblique")))).unwrap();
    assert!(contains(&frictional, "tangential_rate") && !contains(&frictional, "parallel"));
}

/// Nothing unwinds through a library that cannot panic, and nobody needs to know which compiler made it.
#[test]
fn it_has_no_tables_for_unwinding_and_no_comment() {
    for library in libraries() {
        let Some(sections) = tool("readelf", &["-SW"], &library) else { return };
        assert!(sections.contains(".text"), "no list of sections: {sections}");
        for name in [".eh_frame", ".comment", ".debug", ".symtab"] {
            assert!(!sections.contains(name), "{name} in {sections}");
        }
    }
}

/// The code of an output is in the library only if the scene requests the output.
#[test]
fn an_output_that_is_not_requested_is_not_in_the_library() {
    let size = |scene: &Path| fs::metadata(unit::library(&unit::compiled(scene))).unwrap().len();
    let text = fs::read_to_string(unit::scene("steel_ball")).unwrap();
    let with_work = unit::write_scene("steel_ball", &text.replacen("outputs = [", "outputs = [\"work\", ", 1));
    let [default, work] = [&unit::scene("steel_ball"), &with_work].map(|scene| size(scene));
    assert!(default + 200 < work, "{default} and {work} bytes");
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

/// Otherwise it would load only with a C library of the same kind, at least as new as the one on the build machine.
#[test]
fn it_needs_no_library_and_no_version_of_a_symbol() {
    for library in libraries() {
        let Some(dynamic) = tool("readelf", &["-dW"], &library) else { return };
        assert!(dynamic.contains("SYMTAB"), "no dynamic section: {dynamic}");
        for entry in ["NEEDED", "VERNEED", "RPATH", "RUNPATH", "TEXTREL", "INIT", "FINI"] {
            assert!(!dynamic.contains(&format!("({entry}")), "{entry} in {dynamic}");
        }
    }
}

/// Because of an executable stack, the loader would make the stack of the whole process executable, or fail.
#[test]
fn its_stack_is_not_executable() {
    for library in libraries() {
        let Some(segments) = tool("readelf", &["-lW"], &library) else { return };
        let stack = segments.lines().find(|line| line.contains("GNU_STACK")).expect("a stack segment");
        assert!(stack.contains(" RW "), "{stack}");
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

/// The library of a scene whose parameters are all constants contains no name of a parameter.
#[test]
fn a_parameter_that_is_a_constant_is_not_in_the_library() {
    let bytes = fs::read(unit::library(&unit::compiled(&unit::scene("elastic")))).unwrap();
    assert!(!contains(&bytes, "youngs_modulus") && !contains(&bytes, "initial_gap"));
}
