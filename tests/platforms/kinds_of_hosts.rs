//! FMUs with other C libraries and in unusual Linux hosts: the same history gives the same bits as in an ordinary program.
//!
//! Each test compiles the program in tests/platforms/ for its kind of host. The dependencies of a host are unpacked in the
//! target folder (crates/testing/src/debian.rs). If a host is not available, it is skipped with a message.
#![cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]

use brinell_testing::courses;
use brinell_testing::debian;
use brinell_testing::hosts::{Host, Interface, Loading, Said, cc, compile};
use brinell_testing::places::temporary;
use brinell_testing::skips::skipped;
use brinell_testing::standalone;
use brinell_testing::unit;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// The scenes: the default, one that knows the mass, and one with every output.
const SCENES: [&str; 3] = ["steel_ball", "mass_known", "everything"];

/// A library, and its results in an ordinary program.
struct Case {
    name: String,
    library: PathBuf,
    interface: Interface,
    expected: Said,
}

/// The FMUs of all scenes, unchanged and standalone, in an ordinary program.
fn cases(host: &Host) -> Vec<Case> {
    let scenes = SCENES.map(unit::scene).into_iter().chain(SCENES.map(|name| standalone::scene(&unit::scene(name))));
    let case = |scene: PathBuf| {
        let library = unit::library(&unit::compiled(&scene));
        let interface = Interface::beside(&library);
        let expected = host.run(&library, &interface, &courses::history()).unwrap_or_else(|why| panic!("{why}"));
        assert!(expected.host.starts_with("glibc "), "{expected:?}");
        courses::assert_rich(&expected.bits);
        Case { name: scene.display().to_string(), library, interface, expected }
    };
    scenes.map(case).collect()
}

/// Runs the FMUs in `host`, whose name begins with `name`, and compares the results with those in an ordinary program.
#[track_caller]
fn assert_all_run(host: &Host, name: &str) {
    for case in cases(&Host::ordinary()) {
        assert_runs(host, name, &case);
    }
}

#[track_caller]
fn assert_runs(host: &Host, name: &str, case: &Case) {
    let said = host.run(&case.library, &case.interface, &courses::history());
    let said = said.unwrap_or_else(|why| panic!("{} in {name}: {why}", case.name));
    assert!(said.host.starts_with(name), "this is no {name}: {}", said.host);
    // not assert_eq, because there are thousands of lines
    assert!(said.bits == case.expected.bits, "{} in {name}: other bits", case.name);
    assert_eq!((said.memory, &said.message), (case.expected.memory, &case.expected.message), "{} in {name}", case.name);
}

/// Standalone FMUs run in `host`, whose name begins with `name`; for the others, the host reports that `calloc` is missing.
#[track_caller]
fn assert_standalone_alone_runs(host: &Host, name: &str) {
    for case in cases(&Host::ordinary()) {
        if standalone::is_standalone(&case.library) {
            assert_runs(host, name, &case);
        } else {
            let refusal = host.run(&case.library, &case.interface, &courses::history()).unwrap_err();
            assert!(refusal.contains("undefined symbol: calloc"), "{} in {name}: {refusal}", case.name);
        }
    }
}

/// The old C library is that of Debian 11, the release before the last but one.
#[test]
fn fmus_run_on_an_old_c_library() {
    let packages = match debian::packages("bullseye", "bullseye", &["libc6", "libc6-dev", "linux-libc-dev"], false) {
        Ok(packages) => packages,
        Err(why) => return skipped("units on glibc 2.31", &why),
    };
    let root = packages.folder;
    let libraries = root.join("lib/x86_64-linux-gnu");
    // otherwise the compiler would link the library of its own system, whatever the headers are
    let sysroot = format!("--sysroot={}", root.display());
    let linked =
        ["crt1.o", "crti.o", "libc_nonshared.a", "crtn.o"].map(|name| root.join("usr/lib/x86_64-linux-gnu").join(name));
    let linked = linked.into_iter().chain(["libc.so.6", "libdl.so.2"].map(|name| libraries.join(name)));
    let linked: Vec<_> = linked.map(|path| path.display().to_string()).collect();
    let options: Vec<_> =
        ["-nostdlib", "-no-pie", &sysroot].into_iter().chain(linked.iter().map(String::as_str)).collect();
    let program = compile("old-glibc", "host.c", Loading::BySystem, &cc(), &options);
    let program = program.unwrap_or_else(|why| panic!("{why}"));
    let loader = libraries.join("ld-linux-x86-64.so.2");
    let host = Host { command: vec![loader, "--library-path".into(), libraries, program], variables: Vec::new() };
    assert_all_run(&host, "glibc 2.31");
    // the host can fail: a library for a new C library does not load
    let source = temporary().join("needs_new_glibc.c");
    let library = source.with_extension("so");
    // the symbol has the version with which it was moved to the C library
    fs::write(&source, "void *dlopen(const char *, int); void *f(void) { return dlopen(0, 1); }").unwrap();
    let made = Command::new("cc").args(["-shared", "-fPIC", "-o"]).arg(&library).arg(&source).status().unwrap();
    assert!(made.success());
    let interface = Interface { guid: "-".into(), inputs: "0".into(), outputs: vec!["0".into()] };
    let refusal = host.run(&library, &interface, &courses::history()).unwrap_err();
    assert!(refusal.contains("version `GLIBC_2.3"), "{refusal}");
}

#[test]
fn fmus_run_on_musl() {
    let packages = match debian::packages("musl", "bookworm", &["musl", "musl-dev"], false) {
        Ok(packages) => packages,
        Err(why) => return skipped("units on musl", &why),
    };
    let root = packages.folder;
    let file = |name: &str| root.join(name).display().to_string();
    let (include, start) = (file("usr/include/x86_64-linux-musl"), file("usr/lib/x86_64-linux-musl/crt1.o"));
    // the library is also the loader
    let system = file("lib/x86_64-linux-musl/libc.so");
    let options = ["-nostdinc", "-isystem", &include, "-nostdlib", "-no-pie", &start, &system];
    let program = compile("musl", "host.c", Loading::BySystem, &cc(), &options).unwrap_or_else(|why| panic!("{why}"));
    let host = Host { command: vec![system.clone().into(), program], variables: Vec::new() };
    assert_all_run(&host, "another C library");
}

/// Like importers that isolate FMUs: libraries of the process are not visible there.
#[test]
fn standalone_fmus_run_in_a_namespace_of_their_own() {
    let program = compile("namespace", "host.c", Loading::IntoNamespace, &cc(), &["-ldl"]);
    assert_standalone_alone_runs(&Host::program(program.unwrap_or_else(|why| panic!("{why}"))), "glibc ");
}

#[test]
fn standalone_fmus_run_in_a_host_that_is_linked_statically() {
    // a warning of the linker about dlopen is not a failure
    match compile("static", "host.c", Loading::BySystem, &cc(), &["-static", "-ldl"]) {
        Ok(program) => assert_standalone_alone_runs(&Host::program(program), "glibc "),
        Err(why) => skipped("a host that is linked statically", &why),
    }
}

/// Like a program for a device without a dynamic linker.
#[test]
fn standalone_fmus_run_in_a_host_that_loads_them_by_itself() {
    let program = compile("by-hand", "host.c", Loading::ByHand, &cc(), &[]).unwrap_or_else(|why| panic!("{why}"));
    assert_standalone_alone_runs(&Host::program(program), "no dynamic linker");
}
