//! Scenes that the exporter rejects for prebuilt libraries, and data that the FMU rejects.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

use crate::command::{contents, empty_folder, output};
use crate::kinds::{IMPACT, scene};
use crate::loaded::Unit;
use crate::physics::Random;
use crate::prebuilt::{self, export, file, store};
use crate::unit;
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
    let law = |more: &str| scene("big-alabo", &[], "").replacen("[law]\n", &format!("[law]\n{more}\n"), 1);
    let long = "n".repeat(100);
    let cases = [
        (
            law("unloading = \"thornton\""),
            "law.unloading = \"thornton\": big-alabo is prebuilt with unloading = \"contact-radius\"",
        ),
        (law("loading_parameters = { fully_plastic = 80.0 }"), "law.loading_parameters: "),
        (law("unloading = \"contact-radius\"\npassivity_guard = true"), "law.passivity_guard: "),
        (scene("big-alabo", &[], "[friction]\ncoefficient = 0.3\n"), "[friction]: prebuilt libraries have no friction"),
        (
            scene(
                "big-alabo",
                &[],
                "[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n\
                 rate = { model = \"cowper-symonds\", d = 40.4, q = 5 }\n[coupling]\neffective_mass = 4e-3\n",
            ),
            "target.rate: with [coupling] the strength is found at the first touch of each impact",
        ),
        (law("elastic_restitution = 0.98"), "law.elastic_restitution: prebuilt libraries have no losses"),
        (
            scene("hunt-crossley/exact", &[], "[[contact]]\nname = \"a\"\n[[contact]]\nname = \"b\"\n"),
            "[[contact]]: there are 2",
        ),
        (
            scene(
                "big-alabo",
                &[],
                &format!(
                    "[[contact]]\nname = \"{long}\"\nimpactor = {{ radius = 1e-3, youngs_modulus = 2e11, \
             poissons_ratio = 0.3 }}\ntarget = {{ youngs_modulus = 2e11, poissons_ratio = 0.3, yield_strength = 3e8 }}\n"
                ),
            ),
            "[[contact]] name = \"nnn",
        ),
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
    let said = refusal(&scene("thornton", &[], ""), store());
    assert!(said.contains("no prebuilt library `thornton/thornton force`"), "{said}");
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
        ("json", &replaced("\"archive\"", "\"arch\""), "linux-gnu.json is damaged"),
        ("json", &replaced("\"sha256\": \"", "\"sha256\": \"0"), "linux-gnu.br is damaged"),
        ("br", &flipped, "linux-gnu.br is damaged"),
        ("br", &cut, "linux-gnu.br is damaged"),
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
    let begin = good.windows(8).position(|bytes| bytes == b"brinell\0").expect("the data begin with their magic");
    // head, numbers, value references, GUID, texts
    let length = 5 * 8 + 5 * 8 + 30 * 8 + 64 + 32 + 512;
    let folder = empty_folder();
    let mut random = Random(15);
    for byte in (0..length).step_by(3) {
        let mut bad = good.clone();
        bad[begin + byte] ^= 1 << (8.0 * random.next()) as u32;
        let path = folder.path().join(format!("{byte}.so"));
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
