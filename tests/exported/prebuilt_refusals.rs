//! Scenes that the exporter rejects for prebuilt libraries, and data that the FMU rejects.

use crate::command::{contents, empty_folder, output};
use crate::kinds::{IMPACT, scene};
use crate::loaded::Unit;
use crate::physics::Random;
use crate::prebuilt::{self, export, file, store};
use crate::unit;
use brinell_fmu::scene::library::block::{Block, MAGIC, VERSION};
use std::env::consts::DLL_EXTENSION;
use std::fs;
use std::path::Path;

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
