//! The tests themselves on other systems: they compile for each of them, and run on Windows as far as Wine shows.
//!
//! In Wine there is neither a compiler nor Python, and the program there has prebuilt libraries beside it. A test that fails for
//! want of a tool says so, and is counted by that tool; any other one that fails is wrong, but those in
//! `OF_COMPILED`.
#![cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]

use brinell_testing::command::{brinell, output};
use brinell_testing::places::{root, temporary};
use brinell_testing::skips::skipped;
use brinell_testing::toolchain::{self, TestProgram, cargo_for, test_programs};
use brinell_testing::windows::{TARGET, Wine};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{Write, stderr};
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// For Windows that of Microsoft's linker, which checking doesn't need. The tests in Wine are of the other one.
const CHECKED: [&str; 3] = ["x86_64-pc-windows-msvc", "x86_64-apple-darwin", "aarch64-apple-darwin"];

#[test]
#[ignore = "twenty minutes: cargo test --release --test platforms portable -- --ignored --nocapture"]
fn the_tests_compile_for_other_systems() {
    for target in CHECKED {
        let mut cargo = match cargo_for(target, "check") {
            Ok(cargo) => cargo,
            Err(why) => {
                skipped(&format!("compiling the tests for {target}"), &why);
                continue;
            }
        };
        let said = output(cargo.args(["--all-targets", "--keep-going"])).with_status(0).err;
        assert!(!said.contains("\nwarning: "), "{target}: {said}");
        let _ = writeln!(stderr(), "{target}: compiles without a warning");
    }
}

/// Why a test can't pass that exports with a compiler.
const COMPILER: &str = "need a compiler";

/// Why a test can't pass that calls Python.
const PYTHON: &str = "need Python";

/// What a test says for want of a tool, and the tool.
const MISSING: [(&str, &str); 9] = [
    ("there is no Rust toolchain on PATH", COMPILER),
    ("rustc can't be started", COMPILER),
    ("/bin/cargo\" \"metadata\"", COMPILER),
    ("/bin/cargo\" \"doc\"", COMPILER),
    ("the tests in Python need Python", PYTHON),
    ("there is no `python`", PYTHON),
    ("the first test looks for Python", PYTHON),
    ("can't be started: program not found", PYTHON),
    // what the wheel's tests share has failed before
    ("LazyLock instance has previously been poisoned", PYTHON),
];

/// Tests that take more than prebuilt libraries and don't say so: what a compiled library is like and what it leaves out, and what is
/// said where there are none.
const OF_COMPILED: [&str; 3] = [
    "exported::descriptions::an_fmu_without_input_derivatives_is_smaller_and_names_the_key",
    "exported::prebuilt_libraries::the_summary_shows_how_the_fmu_was_made",
    "guide::surface::the_json_of_every_command_has_the_keys_of_the_list",
];

/// The longest time for a test program.
const LIMIT: Duration = Duration::from_secs(3600);

/// The number of tests of all programs, as `command` starts them.
fn count(programs: &[TestProgram], command: impl Fn(&Path) -> Command) -> usize {
    let of = |program: &TestProgram| {
        let said = output(command(&program.file).args(["--list", "--format", "terse"])).with_status(0).out;
        said.lines().filter(|line| line.trim_end().ends_with(": test")).count()
    };
    programs.iter().map(of).sum()
}

/// What each test of a program comes to, by its name: `ok`, `ignored`, or what it says when it fails.
fn run(wine: &Wine, program: &TestProgram, log: &Path) -> BTreeMap<String, String> {
    let mut command = wine.command(&program.file);
    // any release takes this option with that variable
    command.args(["-Z", "unstable-options", "--format", "json"]).env("RUSTC_BOOTSTRAP", "1");
    command.current_dir(&program.package).env("RUST_BACKTRACE", "0").env_remove("CARGO").stdin(Stdio::null());
    // files, not pipes: what Wine leaves running holds them open
    let open = |ending: &str| File::create(log.with_extension(ending)).expect("the target folder can be written to");
    let mut child = command.stdout(open("json")).stderr(open("err")).spawn().expect("Wine can be started");
    let begin = Instant::now();
    while child.try_wait().expect("a child").is_none() && begin.elapsed() < LIMIT {
        thread::sleep(Duration::from_millis(50));
    }
    // if it hangs
    let _ = child.kill();
    let _ = child.wait();
    let said = fs::read(log.with_extension("json")).expect("it was just written");
    let said = String::from_utf8_lossy(&said);
    let mut results = BTreeMap::new();
    for event in said.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok()) {
        let (kind, name) = (event["type"].as_str(), event["name"].as_str());
        if let (Some("test"), Some(name)) = (kind, name) {
            let result = match event["event"].as_str() {
                Some("started") | None => "it doesn't end",
                Some("failed") => event["stdout"].as_str().unwrap_or("it fails and says nothing"),
                Some(other) => other,
            };
            results.insert(name.to_string(), result.to_string());
        }
    }
    results
}

#[test]
#[ignore = "an hour: cargo test --release --test platforms portable -- --ignored --nocapture"]
fn the_tests_pass_on_windows_as_far_as_wine_shows() {
    let (wine, mut cargo) = match Wine::find().and_then(|wine| Ok((wine, cargo_for(TARGET, "test")?))) {
        Ok(found) => found,
        Err(why) => return skipped("the tests in Wine", &why),
    };
    let Some(toolchain) = toolchain::toolchain() else { return };
    let programs = test_programs(wine.linking(&mut cargo));
    let folder = programs[0].file.parent().expect("a program is in a folder");
    let beside_program = folder.parent().expect("target/TARGET/release/deps");
    wine.settle(folder);
    wine.settle(beside_program);
    wine.settle(&beside_program.join("examples"));
    let libraries = beside_program.join("share/brinell/prebuilt");
    let mut prebuild = brinell(temporary());
    prebuild.env("BRINELL_TOOLCHAIN", toolchain).args(["prebuild", "--platforms", "win64", "-o"]).arg(&libraries);
    output(&mut prebuild).with_status(0);

    let mut native = Command::new(env!("CARGO"));
    let native = test_programs(native.args(["test", "--release", "--locked"]).current_dir(root()));
    let (here, there) = (count(&native, |path| Command::new(path)), count(&programs, |path| wine.command(path)));
    let mut counts = BTreeMap::from([("pass", 0)]);
    let mut wrong = Vec::new();
    for program in &programs {
        let results = run(&wine, program, &temporary().join("in-wine"));
        for (name, said) in results {
            let name = format!("{}::{name}", program.name);
            let missing = MISSING.iter().find(|(words, _)| said.contains(words)).map(|(_, tool)| *tool);
            let known = OF_COMPILED.contains(&&*name).then_some(COMPILER);
            let kind = match &*said {
                "ok" => Some("pass"),
                "ignored" => Some("have commands of their own"),
                _ => missing.or(known),
            };
            match kind {
                Some(kind) => *counts.entry(kind).or_default() += 1,
                None => wrong.push(format!("{name}: {said}")),
            }
        }
    }
    // cargo belongs to this system: a path of Windows is a name for it
    for entry in fs::read_dir(root()).expect("the repository can be read").flatten() {
        if entry.file_name().to_string_lossy().starts_with("Z:\\") {
            fs::remove_dir_all(entry.path()).expect("a folder of this test");
        }
    }
    let counted: usize = counts.values().sum::<usize>() + wrong.len();
    let said: String = counts.iter().map(|(kind, count)| format!("\n{count:>5} {kind}")).collect();
    let _ = writeln!(stderr(), "{here} tests, {there} of them for Windows:{said}\n{:>5} fail", wrong.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(counted, there, "a program ends before its tests");
}
