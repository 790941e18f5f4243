//! The library, built so that its own mistakes show: with debug assertions and overflow checks, under the address
//! sanitizer, under the thread sanitizer; and as it is under valgrind's helgrind.
//!
//! The conformance suite and the random calls run on these libraries. In each build, a mistake is made on purpose and must be
//! reported: otherwise silence would prove nothing.
//!
//! `cargo test --release --test sanitizers -- --ignored --nocapture` runs all. The sanitizers take a nightly toolchain and
//! the C compiler's libraries for them; what is missing is skipped with a message.
#![cfg(all(target_os = "linux", target_env = "gnu"))]

use brinell_exporter::prebuilt::LIBRARIES;
use brinell_fmu::scene::library::block::{Block, MAGIC, VERSION};
use brinell_testing::{child, driver, prebuilt, rebuilt, skips, suites, targets, unit};
use driver::{arguments, has_valgrind, valgrind};
use rebuilt::{Sources, TRIPLE, Way};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use std::time::Duration;
use suites::{Subject, Suites};

/// Cargo builds the program before these tests; without its feature they do not compile.
const _: &str = env!("CARGO_BIN_EXE_brinell");

/// The longest time for all checks of a library, which sanitizers slow down.
const LIMIT: Duration = Duration::from_secs(600);

/// Number of random scripts for each library, of about a hundred calls each.
const SCRIPTS: u64 = 300;

static SUITES: LazyLock<Suites> = LazyLock::new(Suites::build);

/// A mistake that a build must report: file, text, replacement. A `~` in the replacement is the text.
type Mistake = (&'static str, &'static str, &'static str);

const STEPPING: &str = "crates/fmu/src/instance/stepping.rs";
const LIFECYCLE: &str = "crates/fmu/src/fmi2/lifecycle.rs";

/// A line of every step.
const STEP: &str = "        let in_order = self.clock.takes(time, end, step, Self::shortest());\n";

const OVERFLOW: Mistake =
    (STEPPING, STEP, "~let _ = core::hint::black_box(core::hint::black_box(255u8) + core::hint::black_box(1u8));\n");

const ASSERTION: Mistake = (STEPPING, STEP, "~debug_assert!(core::hint::black_box(false));\n");

/// The end of the name is written behind the memory of the component.
const SHORT: Mistake = (LIFECYCLE, "size_of::<Component<S>>() + outside + length", "~ - 2");

const LEAK: Mistake = (LIFECYCLE, "            memory.release(c);\n", "            let _ = memory;\n");

/// All instances write to one place.
const RACE: Mistake = (
    STEPPING,
    STEP,
    "~static mut LAST: f64 = 0.0;\n\
     #[allow(unsafe_code)]\n { unsafe { core::ptr::write_volatile(&raw mut LAST, end) }; }\n",
);

/// The mistakes are checked in every run; only the libraries take long.
#[test]
fn every_mistake_applies_to_the_sources() {
    for (file, old, _) in [OVERFLOW, ASSERTION, SHORT, LEAK, RACE] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
        let count = fs::read_to_string(path).expect("a file of the library").matches(old).count();
        assert_eq!(count, 1, "{file} has this text {count} times, not once: {old}");
    }
}

/// Builds the library of `scene` with a mistake, or without.
#[track_caller]
fn build(sources: &Sources, scene: &Path, way: &Way, mistake: Option<Mistake>) -> (PathBuf, PathBuf) {
    let place = sources.use_scene(scene);
    let build = || sources.library("checked", way);
    let library = match mistake {
        Some((file, old, new)) => sources.changed((file, old, &new.replace('~', old)), build),
        None => build(),
    };
    (library.unwrap_or_else(|said| panic!("{said}")), place)
}

/// The suites pass on the libraries of these scenes; each mistake is reported in these words by this check of the
/// conformance suite.
fn examine(name: &str, way: &Way, environment: &[(&str, String)], mistakes: &[(Mistake, &str, &str)]) {
    let sources = Sources::copied(name);
    let steel_ball = unit::scene("steel_ball");
    for (mistake, check, words) in mistakes {
        let (library, place) = build(&sources, &steel_ball, way, Some(*mistake));
        let subject = Subject { library: &library, place: &place, environment, limit: LIMIT };
        let said = SUITES.conform(&subject, Some(check)).expect_err("a mistake that is not reported");
        assert!(said.contains(words), "{mistake:?} is reported otherwise: {said}");
    }
    for scene in targets::scenes() {
        let (library, place) = build(&sources, &scene, way, None);
        let subject = Subject { library: &library, place: &place, environment, limit: LIMIT };
        SUITES.conform(&subject, None).unwrap_or_else(|said| panic!("{}: {said}", scene.display()));
        // a thousand contacts show no more than two, and take longer
        let scripts = if scene.ends_with("many_contacts.toml") { 10 } else { SCRIPTS };
        SUITES.fuzz(&subject, scripts).unwrap_or_else(|said| panic!("{}: {said}", scene.display()));
        println!("{name}: {} passes", scene.file_stem().expect("a name").display());
    }
    for (kind, fmu) in targets::prebuilt() {
        let (library, place) = (build_prebuilt(&sources, &kind, &fmu, way), unit::library(&fmu));
        let subject = Subject { library: &library, place: &place, environment, limit: LIMIT };
        SUITES.conform(&subject, None).unwrap_or_else(|said| panic!("{kind}: {said}"));
        SUITES.fuzz(&subject, SCRIPTS).unwrap_or_else(|said| panic!("{kind}: {said}"));
        println!("{name}: prebuilt {kind} passes");
    }
}

/// Builds the prebuilt library of a `kind` in a `way`, with the scene of `fmu`.
fn build_prebuilt(sources: &Sources, kind: &str, fmu: &Path, way: &Way) -> PathBuf {
    let list = prebuilt::list(prebuilt::store());
    let kind = LIBRARIES.iter().find(|library| library.name == kind).expect("a kind");
    sources.use_kind(&kind.source(list["sources"].as_str().expect("a hash")).0);
    let library = sources.library(kind.name, &Way { prebuilt: true, ..*way }).unwrap_or_else(|said| panic!("{said}"));
    // the block of the FMU, which begins with magic, version and library, replaces the empty one
    let filled = fs::read(unit::library(fmu)).expect("an unpacked library");
    let mut bytes = fs::read(&library).expect("a library");
    let head: Vec<u8> = [MAGIC, VERSION].into_iter().flat_map(u64::to_le_bytes).collect();
    let find = |bytes: &[u8]| bytes.windows(head.len()).position(|part| part == head).expect("a block");
    let (from, to) = (find(&filled), find(&bytes));
    let block = &filled[from..from + size_of::<Block>()];
    assert_eq!(block[..24], bytes[to..to + 24], "another library than that of the FMU");
    bytes[to..to + block.len()].copy_from_slice(block);
    fs::write(&library, bytes).expect("the target folder can be written to");
    library
}

/// Standard output of a command, if it succeeds.
fn printed(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).env_remove("RUSTUP_TOOLCHAIN").output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_string())
}

/// `found`, or a message that no test runner hides.
fn or_skipped(found: Option<PathBuf>, what: &str) -> Option<PathBuf> {
    if found.is_none() {
        skips::skipped("a sanitizer", &format!("it takes a nightly toolchain of rustup, and {what}"));
    }
    found
}

/// The address sanitizer of the C compiler, which fits the one of rustc.
fn runtime_of_addresses() -> Option<PathBuf> {
    let has_nightly = printed("rustc", &["+nightly", "--version"]).is_some();
    let library = printed("cc", &["-print-file-name=libasan.so"]).map(PathBuf::from);
    let library = library.filter(|path| has_nightly && path.is_absolute());
    or_skipped(library, "the C compiler's libasan.so (Debian: libgcc-12-dev)")
}

/// The thread sanitizer of the nightly toolchain.
fn runtime_of_threads() -> Option<PathBuf> {
    let root = printed("rustc", &["+nightly", "--print", "sysroot"]).map(PathBuf::from);
    let archive = root.map(|root| root.join(format!("lib/rustlib/{TRIPLE}/lib/librustc-nightly_rt.tsan.a")));
    or_skipped(archive.filter(|path| path.exists()), "its thread sanitizer")
}

/// A failed assertion ends in the function that a library for use must not need; here it says so and ends the process.
#[test]
#[ignore = "it builds a library for each scene: five minutes"]
fn debug_assertions_and_overflow_checks_find_nothing() {
    let folder = tempfile::tempdir().expect("a folder for temporary files");
    let (source, object) = (folder.path().join("end.c"), folder.path().join("end.o"));
    let text = "#include <stdio.h>\n#include <stdlib.h>\n\
                void brinell_a_panic_path_survived(void) { fputs(\"the library panics\\n\", stderr); abort(); }\n";
    fs::write(&source, text).expect("a folder for temporary files");
    let made = Command::new("cc").args(["-c", "-fPIC", "-o"]).arg(&object).arg(&source).status();
    assert!(made.expect("there is a C compiler").success());
    let way =
        Way { profile: &["debug-assertions=true", "overflow-checks=true"], objects: &[&object], ..Way::default() };
    let check = "every function in every state";
    examine(
        "assertions",
        &way,
        &[],
        &[(OVERFLOW, check, "the library panics"), (ASSERTION, check, "the library panics")],
    );
}

#[test]
#[ignore = "it builds a library for each scene: ten minutes"]
fn the_address_sanitizer_finds_nothing() {
    let Some(runtime) = runtime_of_addresses() else { return };
    let way = Way {
        toolchain: "+nightly",
        profile: &["debug-assertions=false"],
        flags: "-Zsanitizer=address",
        ..Way::default()
    };
    let environment =
        [("LD_PRELOAD", runtime.display().to_string()), ("ASAN_OPTIONS", "detect_leaks=1:handle_sigfpe=0".into())];
    let mistakes = [
        (SHORT, "names", "AddressSanitizer: heap-buffer-overflow"),
        (LEAK, "a good run is silent", "LeakSanitizer: detected memory leaks"),
    ];
    examine("address", &way, &environment, &mistakes);
}

/// Runs the C program, which has eight threads, on `library`; what it says if it fails.
fn run_program(mut command: Command, library: &Path) -> Result<(), String> {
    let mut arguments = arguments();
    arguments[0] = library.to_str().expect("a path of plain characters").into();
    command.args(arguments);
    let scratch = tempfile::tempdir().expect("a folder for temporary files");
    child::run(&mut command, &scratch.path().join("log"), LIMIT).map_err(|failure| failure.to_string())
}

#[test]
#[ignore = "it builds two libraries"]
fn the_thread_sanitizer_finds_nothing() {
    let Some(runtime) = runtime_of_threads() else { return };
    // the functions of `core` are not instrumented; none of them shares memory between threads
    let flags = "-Zsanitizer=thread -Cunsafe-allow-abi-mismatch=sanitizer";
    let way = Way { toolchain: "+nightly", flags, ..Way::default() };
    let runtime = runtime.to_str().expect("a path of plain characters");
    let options = ["-DNO_COUNTING", "-Wl,--whole-archive", runtime, "-Wl,--no-whole-archive"];
    let program = driver::compile("driver-for-threads", &options);
    let sources = Sources::copied("threads");
    for (mistake, passes) in [(Some(RACE), false), (None, true)] {
        let (library, _) = build(&sources, &driver::scene(), &way, mistake);
        let result = run_program(Command::new(&program), &library);
        match passes {
            true => result.unwrap_or_else(|said| panic!("{said}")),
            false => {
                let said = result.expect_err("a race that is not reported");
                assert!(said.contains("ThreadSanitizer: data race"), "{said}");
            }
        }
    }
}

/// The library as it is exported.
#[test]
#[ignore = "helgrind is slow: two minutes"]
fn helgrind_finds_no_race() {
    if !has_valgrind() {
        return;
    }
    let program = driver::compile("driver-for-helgrind", &["-DNO_COUNTING"]);
    let run = |library: &Path| {
        let mut command = valgrind("helgrind");
        command.arg(&program);
        run_program(command, library)
    };
    let sources = Sources::copied("helgrind");
    let (library, place) = build(&sources, &driver::scene(), &Way::default(), Some(RACE));
    let said = run(&library).expect_err("a race that is not reported");
    assert!(said.contains("Possible data race"), "{said}");
    run(&place).unwrap_or_else(|said| panic!("{said}"));
}
