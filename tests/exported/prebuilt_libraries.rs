//! FMUs from prebuilt libraries have the same outputs as compiled ones, bit for bit.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

use crate::both_ways::Both;
use crate::command::{self, assert_same, brinell, empty_folder, output, run};
use crate::courses;
use crate::hosts::{Host, Interface, Loading, cc, compile};
use crate::kinds::{further, one_of_each_kind, scene};
use crate::loaded::Unit;
use crate::physics::Random;
use crate::prebuilt::{self, LAWS, export, export_anew, store};
use crate::pytest;
use crate::skips;
use crate::unit;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Compares compiled and prebuilt FMUs for scenes of a law.
fn compare(law: &str, scenes: Vec<(&str, String)>, store: &Path) {
    let mut random = Random(14);
    let mut messages = 0;
    for (kind, text) in scenes {
        let both = Both::of(text, store);
        assert_eq!(both.kind, kind, "{law}");
        for _ in 0..20 {
            messages += both.compare(200, &mut random);
        }
    }
    assert!(messages > 100, "{law}: {messages} messages were compared");
}

#[test]
fn a_prebuilt_library_gives_the_same_bits_and_messages_as_a_compiled_one() {
    LAWS.iter().for_each(|law| compare(law, one_of_each_kind(law), store()));
}

#[test]
fn the_warning_about_unstable_steps_is_that_of_a_compiled_library() {
    for (kind, text) in one_of_each_kind("big-alabo") {
        let told = Both::of(text, store()).drive_with_long_steps(4e-3);
        let expected = "fmi2DoStep: steps of 0.002 s are unstable with a mass of 0.004 kg: make them shorter, or let the unit move it by [coupling]";
        // of the others, one expects another mass, one is told not to look, and some move the body themselves
        let count = usize::from(kind == "state");
        assert_eq!(told.iter().filter(|message| *message == expected).count(), count, "{kind}: {told:?}");
    }
}

/// The same for every law, with more scenes for each law. BRINELL_PREBUILT may name a folder with libraries.
#[test]
#[ignore = "compiles 300 libraries: cargo test --release --test exported prebuilt_libraries -- --ignored"]
fn every_prebuilt_library_gives_the_same_bits_and_messages_as_a_compiled_one() {
    let named = std::env::var_os("BRINELL_PREBUILT").map(Into::into);
    let store = named.unwrap_or_else(|| prebuilt::made_once("every", &[]));
    let laws = prebuilt::laws(&store);
    assert!(laws.len() >= 35, "{laws:?}");
    compare("big-alabo", further("big-alabo"), &store);
    laws.iter().for_each(|law| compare(law, one_of_each_kind(law), &store));
}

/// Largest ratio of instructions between a prebuilt library and a compiled one.
const MOST: f64 = 1.3;

/// Instructions for setting the rate, making the step and reading the outputs, over a history with steps of all sizes.
fn instructions(fmu: &Path, program: &Path) -> f64 {
    let library = unit::library(fmu);
    let counts = fmu.with_extension("callgrind");
    let mut command: Vec<PathBuf> = ["valgrind", "--tool=callgrind"].map(PathBuf::from).into();
    command.push(format!("--callgrind-out-file={}", counts.display()).into());
    let functions = ["fmi2SetReal", "fmi2DoStep", "fmi2GetReal"];
    command.extend(functions.map(|name| PathBuf::from(format!("--toggle-collect={name}"))));
    command.push(program.into());
    let host = Host { command, variables: Vec::new() };
    let said =
        host.run(&library, &Interface::beside(&library), &courses::history()).unwrap_or_else(|why| panic!("{why}"));
    courses::assert_rich(&said.bits);
    let text = fs::read_to_string(counts).expect("callgrind has written its counts");
    let total = text.lines().find_map(|line| line.strip_prefix("totals: ")).expect("callgrind writes a total");
    total.trim().parse().expect("a number")
}

#[test]
fn a_prebuilt_library_takes_hardly_more_instructions_than_a_compiled_one() {
    if Command::new("valgrind").arg("--version").output().is_err() {
        return skips::skipped("instructions of prebuilt libraries", "there is no valgrind");
    }
    let program =
        compile("ordinary", "host.c", Loading::BySystem, &cc(), &["-ldl"]).unwrap_or_else(|why| panic!("{why}"));
    for (kind, text) in one_of_each_kind("big-alabo") {
        let [compiled, prebuilt] = [None, Some(store())].map(|store| instructions(&export(&text, store), &program));
        println!("{kind}: {:.3}", prebuilt / compiled);
        assert!(prebuilt < MOST * compiled, "{kind}: {prebuilt} instead of {compiled} instructions");
    }
}

/// Scenes for each kind of library that a plain simulation can run.
fn plain_scenes() -> impl Iterator<Item = (&'static str, String)> {
    // a slow constant rate must reach the surface
    let near = |text: String| text.replace("initial_gap = 1e-6", "initial_gap = 0.0");
    one_of_each_kind("big-alabo").into_iter().map(move |(kind, text)| (kind, near(text)))
}

#[test]
fn fmus_of_every_kind_pass_the_check_and_are_the_same_bytes_each_time() {
    for (kind, text) in plain_scenes() {
        let (fmu, (again, _)) = (export(&text, Some(store())), export_anew(&text, Some(store())));
        assert_same(&fs::read(&fmu).unwrap(), &fs::read(again).unwrap());
        let check = run(fmu.parent().unwrap(), ["check", "unit.fmu", "--json"]).with_status(0).json();
        assert_eq!(check["passed"], true, "{kind}: {check}");
    }
}

#[test]
fn fmpy_accepts_fmus_of_every_kind() {
    let fmu = |(kind, text): (&str, String)| (kind.to_string(), export(&text, Some(store())));
    let fmus = plain_scenes().map(fmu).collect();
    for file in [
        "test_model_description_is_valid.py",
        "test_initial_values.py",
        "test_parameter_limits.py",
        "test_inputs.py",
        "test_state_is_restored.py",
        "test_simulate_fmu.py",
    ] {
        pytest::pytest(file, &fmus);
    }
}

/// With a compiler the scene is compiled unless the user requests a prebuilt library; without a compiler it is not.
#[test]
fn the_summary_shows_how_the_fmu_was_made() {
    let folder = empty_folder();
    let text = scene("big-alabo", &["indentation"], "");
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    let with = |option: Option<&str>, compiler: bool| {
        let mut command = match compiler {
            true => brinell(folder.path()),
            false => prebuilt::without_compiler(folder.path(), store()),
        };
        let run = output(command.env("BRINELL_PREBUILT", store()).args(["export", "scene.toml"]).args(option));
        run.with_status(0).out.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let compiled = with(None, true);
    assert!(compiled.contains("made compiled in "), "{compiled}");
    for prebuilt in [with(Some("--prebuilt"), true), with(None, false)] {
        assert!(prebuilt.contains("made from the prebuilt library `big-alabo/contact-radius force`"), "{prebuilt}");
    }
}

/// FMUs of two laws with different numbers, compiled and prebuilt: none accepts a state of another.
#[test]
fn states_of_other_scenes_are_rejected() {
    let texts = [
        scene("big-alabo", &["work"], ""),
        scene("big-alabo", &["work"], "[fmu]\ninitial_gap = 1e-9\n"),
        scene("big-alabo", &["work", "regime"], ""),
    ];
    let mut fmus: Vec<_> = texts.iter().map(|text| Unit::open(&export(text, Some(store())))).collect();
    fmus.push(Unit::open(&export(&texts[0], None)));
    let instances: Vec<_> = fmus.iter().map(Unit::ready).collect();
    for (index, instance) in instances.iter().enumerate() {
        let state = instance.save();
        let bytes = instance.bytes(state);
        for (other, taker) in instances.iter().enumerate() {
            let taken = taker.deserialize(&bytes);
            assert_eq!(taken.is_some(), index == other, "{index} to {other}");
            taken.into_iter().for_each(|state| taker.free(state));
        }
        instance.free(state);
    }
}

#[test]
fn the_kind_in_the_source_tree_is_that_of_the_default_scene() {
    let folder = empty_folder();
    let kind = run(folder.path(), ["kind".as_ref(), command::scene("steel_ball").as_os_str()]).with_status(0);
    let source = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/unit/src/kind.rs")).unwrap();
    assert!(kind.out == source, "crates/unit/src/kind.rs is not what the program writes:\n{}", kind.out);
}

/// The same bytes from any run, with any number of threads.
#[test]
fn prebuilding_is_reproducible_and_rejects_unknown_laws() {
    let again = prebuilt::folder().join("again");
    prebuilt::prebuild(&again, &["--laws", "hunt-crossley/flores", "--kinds", "force"]).with_status(0);
    let library = |store: &Path| {
        let list = prebuilt::list(store);
        let streams = list["streams"].as_array().unwrap();
        let mut all = streams.iter().flat_map(|stream| stream["libraries"].as_array().unwrap());
        all.find(|library| library["name"] == "hunt-crossley/flores force").expect("it is there").clone()
    };
    assert_eq!(library(&again), library(store()));
    let said = prebuilt::prebuild(&again, &["--laws", "nobody"]).with_status(1).err;
    assert!(said.contains("no law `nobody`") && said.contains("big-alabo"), "{said}");
    let said = prebuilt::prebuild(&again, &["--kinds", "all"]).with_status(1).err;
    assert!(said.contains("no kind `all`") && said.contains("parallel"), "{said}");
}
