//! FMUs from prebuilt libraries have the same outputs as compiled ones, bit for bit.

use crate::both_ways::Both;
use crate::command::{self, assert_same, brinell, empty_folder, output, run};
use crate::courses;
use crate::hosts::{Host, Interface, Loading, cc, compile};
use crate::kinds::{any_scene, of_each_kind, scene};
use crate::loaded::Unit;
use crate::physics::Random;
use crate::prebuilt::{self, export, export_anew, store};
use crate::skips;
use crate::unit;
use brinell_exporter::scene::Scene;
use brinell_testing::long;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Compares compiled and prebuilt FMUs of a scene; returns the number of messages.
fn compare(text: String, random: &mut Random) -> (String, usize) {
    let both = Both::of(text, store());
    let messages = (0..if long::is_asked() { 10 } else { 3 }).map(|_| both.compare(100, random)).sum();
    (both.kind, messages)
}

/// Scenes of the repository, whose libraries other tests compile, too; and those of each kind that are chosen, in a usual run of the
/// kinds that are left.
#[test]
fn a_prebuilt_library_gives_the_same_bits_and_messages_as_a_compiled_one() {
    let mut random = Random(14);
    let mut kinds = BTreeSet::new();
    let mut messages = 0;
    for scene in unit::scenes_to_compile() {
        let (kind, count) = compare(fs::read_to_string(scene).expect("a scene file"), &mut random);
        kinds.insert(kind);
        messages += count;
    }
    for (expected, text) in of_each_kind() {
        if kinds.contains(expected) && !long::is_asked() {
            continue;
        }
        let (kind, count) = compare(text, &mut random);
        assert_eq!(kind, expected);
        kinds.insert(kind);
        messages += count;
    }
    assert_eq!(kinds, prebuilt::names(store()));
    assert!(messages > 150, "{messages} messages were compared");
}

#[test]
fn any_scene_has_the_same_bits_and_messages_in_both_ways() {
    let count = if long::is_asked() { 100 } else { 2 };
    let (mut random, mut done) = (Random(2026), 0);
    let mut kinds = BTreeMap::new();
    while done < count {
        let text = any_scene(&mut random);
        if Scene::parse(text.clone(), Path::new("any.toml")).is_err() {
            continue;
        }
        println!("{done}:\n{text}");
        let (kind, _) = compare(text, &mut random);
        *kinds.entry(kind).or_insert(0) += 1;
        done += 1;
    }
    println!("{kinds:?}");
}

/// Functions, and the largest ratio of their instructions between a prebuilt library and a compiled one, for one contact and for
/// arrays that are as long as the scene needs. A compiled library knows what its scene has, and needs no table to find it.
const MOST: [(&[&str], [f64; 2]); 2] = [(&["fmi2DoStep"], [1.15, 3.5]), (&["fmi2SetReal", "fmi2GetReal"], [2.0, 6.0])];

/// Steps over which instructions are counted.
const COUNTED: usize = 300;

/// Instructions of these functions over a history with steps of all sizes.
fn instructions(fmu: &Path, program: &Path, functions: &[&str]) -> f64 {
    let library = unit::library(fmu);
    let history = fmu.with_extension("history");
    let steps: String =
        fs::read_to_string(courses::history()).expect("a history").split_inclusive('\n').take(COUNTED).collect();
    fs::write(&history, steps).expect("the target folder can be written to");
    let counts = fmu.with_extension("callgrind");
    let mut command: Vec<PathBuf> = ["valgrind", "--tool=callgrind"].map(PathBuf::from).into();
    command.push(format!("--callgrind-out-file={}", counts.display()).into());
    command.extend(functions.iter().map(|name| PathBuf::from(format!("--toggle-collect={name}"))));
    command.push(program.into());
    let host = Host { command, variables: Vec::new() };
    let said = host.run(&library, &Interface::beside(&library), &history).unwrap_or_else(|why| panic!("{why}"));
    assert_eq!(said.bits.lines().count(), COUNTED);
    let text = fs::read_to_string(counts).expect("callgrind has written its counts");
    let total = text.lines().find_map(|line| line.strip_prefix("totals: ")).expect("callgrind writes a total");
    total.trim().parse().expect("a number")
}

#[test]
fn a_prebuilt_library_takes_hardly_more_instructions_than_a_compiled_one() {
    if long::leaves_out("instructions of prebuilt libraries") {
        return;
    }
    if Command::new("valgrind").arg("--version").output().is_err() {
        return skips::skipped("instructions of prebuilt libraries", "there is no valgrind");
    }
    let program =
        compile("ordinary", "host.c", Loading::BySystem, &cc(), &["-ldl"]).unwrap_or_else(|why| panic!("{why}"));
    let mut beyond = Vec::new();
    // the last scene of each kind
    let scenes: BTreeMap<_, _> = of_each_kind().into_iter().filter(|(kind, _)| !kind.contains("friction")).collect();
    for (kind, text) in scenes {
        let fmus = [None, Some(store())].map(|store| export(&text, store));
        for (functions, most) in MOST {
            let [compiled, prebuilt] = fmus.each_ref().map(|fmu| instructions(fmu, &program, functions));
            let ratio = prebuilt / compiled;
            println!("{kind}, {functions:?}: {ratio:.3}");
            if ratio > most[usize::from(kind != "state")] {
                beyond.push(format!("{kind}, {functions:?}: {ratio:.3}"));
            }
        }
    }
    assert!(beyond.is_empty(), "{beyond:#?}");
}

#[test]
fn fmus_of_every_kind_pass_the_check_and_are_the_same_bytes_each_time() {
    for (kind, text) in of_each_kind() {
        // a slow constant rate must reach the surface
        let text = text.replace("initial_gap = 1e-6", "initial_gap = 0.0");
        let (fmu, (again, _)) = (export(&text, Some(store())), export_anew(&text, Some(store())));
        assert_same(&fs::read(&fmu).unwrap(), &fs::read(again).unwrap());
        let check = run(fmu.parent().unwrap(), ["check", "unit.fmu", "--json"]).with_status(0).json();
        assert_eq!(check["passed"], true, "{kind}: {check}");
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
        assert!(prebuilt.contains("made from the prebuilt library `state`"), "{prebuilt}");
    }
}

/// FMUs with different numbers: none accepts a state of another, but the compiled one and the prebuilt one of a scene are the same.
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
            // the last one is the first one, compiled
            assert_eq!(taken.is_some(), index % 3 == other % 3, "{index} to {other}");
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
fn prebuilding_is_reproducible_and_rejects_unknown_kinds() {
    let again = prebuilt::only_state();
    let library = |store: &Path| {
        let all = prebuilt::libraries(store);
        all.into_iter().find(|listed| listed["name"] == "state").expect("it is there")
    };
    assert_eq!(library(&again), library(store()));
    let said = prebuilt::prebuild(&again, &["--kinds", "all"]).with_status(1).err;
    assert!(said.contains("no kind `all`") && said.contains("moved"), "{said}");
}
