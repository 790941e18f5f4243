//! FMUs from prebuilt libraries: how many instructions they take, how they are made, and what is refused. That they do what compiled ones do:
//! `differential.rs`.

use crate::command::{brinell, contents, empty_folder, output};
use crate::courses;
use crate::hosts::{Host, Interface, Loading, cc, compile};
use crate::kinds::{IMPACT, of_each_kind, scene};
use crate::loaded::Unit;
use crate::physics::Random;
use crate::prebuilt::{self, export, file, store};
use crate::skips;
use crate::unit;
use brinell_fmu::scene::library::block::{Block, MAGIC, VERSION};
use brinell_testing::long;
use std::collections::BTreeMap;
use std::env::consts::DLL_EXTENSION;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

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

/// The error line of an export without a compiler.
#[track_caller]
fn refusal(text: &str, store: &Path) -> String {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    let run = output(prebuilt::without_compiler(folder.path(), store).args(["export", "scene.toml"])).with_status(1);
    assert_eq!(contents(folder.path()), ["scene.toml"]);
    run.err.lines().last().unwrap_or_default().into()
}

#[test]
fn a_scene_that_needs_a_compiler_is_rejected_with_the_key_that_needs_it() {
    let many: String = (0..1000)
        .map(|index| format!("[[contact]]\nname = \"c{index}\"\ntarget = {{ yield_strength = {index}.5e6 }}\n"))
        .collect();
    let cases = [
        (scene("big-alabo", &[], "[fmu]\nstandalone = true\n"), "fmu.standalone: prebuilt libraries take their memory"),
        (scene("big-alabo", &[], &many), "[[contact]]: the data of this scene take "),
    ];
    for (text, expected) in cases {
        let said = refusal(&text, store());
        assert!(said.contains("needs a compiler") && said.contains(expected), "{said}\n{text}");
    }
}

#[test]
fn missing_or_damaged_libraries_and_those_of_another_version_are_reported() {
    let text = scene("big-alabo", &[], "");
    let none = empty_folder();
    let said = refusal(&text, none.path());
    assert!(said.contains("no prebuilt libraries in") && said.contains("BRINELL_PREBUILT"), "{said}");
    let said = refusal(&scene("big-alabo", &["impulse"], ""), &prebuilt::only_state());
    assert!(said.contains("no prebuilt library `momentum`"), "{said}");
    type Change<'a> = &'a dyn Fn(Vec<u8>) -> Vec<u8>;
    let copy = |changed: &str, change: Change| {
        let folder = empty_folder();
        for ending in ["br", "json"] {
            let name = file(ending);
            let bytes = fs::read(store().join(&name)).unwrap();
            fs::write(folder.path().join(name), if ending == changed { change(bytes) } else { bytes }).unwrap();
        }
        folder
    };
    let replaced = |from: &'static str, to: &'static str| {
        move |bytes: Vec<u8>| String::from_utf8(bytes).unwrap().replacen(from, to, 1).into_bytes()
    };
    let flipped = |mut bytes: Vec<u8>| {
        bytes[1000] ^= 16;
        bytes
    };
    let cut = |bytes: Vec<u8>| bytes[..1000].to_vec();
    let cases: [(&str, Change, &str); 5] = [
        ("json", &replaced("\"sources\": \"", "\"sources\": \"0"), "another version"),
        ("json", &replaced("\"archive\"", "\"arch\""), ".json is damaged"),
        ("json", &replaced("\"sha256\": \"", "\"sha256\": \"0"), ".br is damaged"),
        ("br", &flipped, ".br is damaged"),
        ("br", &cut, ".br is damaged"),
    ];
    for (ending, change, expected) in cases {
        let folder = copy(ending, change);
        let said = refusal(&text, folder.path());
        assert!(said.contains(expected), "{said}");
    }
}

/// Changes any bit of the data.
#[test]
fn a_library_with_damaged_data_rejects_instantiation_with_the_reason() {
    let fmu = export(&scene("big-alabo", &["work"], IMPACT), Some(store()));
    let place = unit::library(&fmu);
    let good = fs::read(&place).unwrap();
    let head: Vec<u8> = [MAGIC, VERSION].into_iter().flat_map(u64::to_le_bytes).collect();
    let begin = good.windows(head.len()).position(|bytes| bytes == head).expect("the data begin with their magic");
    let word = |at: usize| u64::from_le_bytes(good[begin + 8 * at..][..8].try_into().unwrap());
    // what is behind the last list is never read
    let length = 8 * (5 + word(3) as usize);
    assert!(length < size_of::<Block>());
    let folder = empty_folder();
    let mut random = Random(15);
    for byte in (0..64).chain((64..length).step_by(301)) {
        let mut bad = good.clone();
        bad[begin + byte] ^= 1 << (8.0 * random.next()) as u32;
        let path = folder.path().join(byte.to_string()).with_extension(DLL_EXTENSION);
        fs::write(&path, bad).unwrap();
        let unit = Unit::open_library(&path, &place);
        let Err(messages) = unit.try_to_instantiate() else { panic!("byte {byte}: an instance") };
        let said = &messages.last().expect("a reason").text;
        let expected = match byte / 8 {
            0 | 1 => "another version",
            2 => "another library",
            _ => "damaged",
        };
        assert!(said.starts_with("fmi2Instantiate: ") && said.contains(expected), "byte {byte}: {said}");
    }
    // the whole library is unchanged
    assert!(Unit::open(&fmu).try_to_instantiate().is_ok());
}
