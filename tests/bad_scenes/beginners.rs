//! `brinell new`, and typical errors of beginners in scenes.

use super::SCENE;
use super::command::{contents, empty_folder, run};
use brinell_testing::{refusal, unit};
use std::fs;
use std::path::Path;

#[test]
fn a_new_scene_is_a_good_one_and_is_not_overwritten() {
    let folder = empty_folder();
    let made = run(folder.path(), ["new", "hammer"]).with_status(0);
    for said in [
        "wrote hammer.toml",
        ".brinell.schema.json",
        "next:",
        "brinell predict hammer.toml",
        "brinell export hammer.toml",
    ] {
        assert!(made.out.contains(said), "{said}: {made:#?}");
    }
    let text = fs::read_to_string(folder.path().join("hammer.toml")).unwrap();
    assert!(text.contains("name = \"hammer\"") && text.contains("surface = \"fresh\"") && text.contains("for ever"));
    for shown in ["\"5 mm\"", "\"1 m/s\"", "hardness = \"180 HBW", "drop_height = \"5 cm\""] {
        assert!(text.contains(shown), "{shown}: {text}");
    }
    assert!(!text.contains("NAME\"") && text.lines().all(|line| line.chars().count() <= 130), "{text}");
    let predicted = run(folder.path(), ["predict", "hammer.toml"]).with_status(0);
    assert_eq!(predicted.err, "", "a template without doubts");
    run(folder.path(), ["export", "hammer.toml"]).with_status(0);
    let refused = run(folder.path(), ["new", "hammer"]).with_status(1);
    assert!(refused.err.contains("hammer.toml") && refused.err.contains("exists already"), "{refused:#?}");
    assert_eq!(fs::read_to_string(folder.path().join("hammer.toml")).unwrap(), text);
}

/// The texts recommend `brinell`, and nobody should have to ask for it.
#[test]
fn a_scene_without_a_law_and_a_new_scene_have_the_law_that_is_recommended() {
    let folder = empty_folder();
    run(folder.path(), ["new", "fresh"]).with_status(0);
    let law = |name: &str, law: &str, expected: &str| {
        fs::write(folder.path().join(name), format!("{}{law}", with_impact())).unwrap();
        let said = run(folder.path(), ["predict", name, "--json"]).with_status(0).json();
        assert_eq!(said["laws"][0]["law"], expected, "{law}");
    };
    let said = run(folder.path(), ["predict", "fresh.toml", "--json"]).with_status(0).json();
    assert_eq!(said["laws"][0]["law"], "brinell/brinell");
    law("plain.toml", "", "brinell/brinell");
    law("empty.toml", "[law]\n", "brinell/brinell");
    law("other.toml", "[law]\nunloading = \"thornton\"\n", "brinell/thornton");
    law("paper.toml", "[law]\nloading = \"big-alabo\"\n", "big-alabo/contact-radius");
    let elastic = with_impact().replace("yield_strength = 300e6\n", "");
    fs::write(folder.path().join("elastic.toml"), elastic).unwrap();
    let said = run(folder.path(), ["predict", "elastic.toml", "--json"]).with_status(0).json();
    assert_eq!(said["laws"][0]["law"], "hertz");
}

/// Steel has a strength only by its condition.
#[test]
fn a_target_of_steel_is_asked_for_its_strength_and_takes_its_hardness() {
    let folder = empty_folder();
    let said = |target: &str, law: &str| {
        let text = format!(
            "name = \"drop\"\nimpactor = {{ radius = \"5 mm\", material = \"steel\", hardness = \"58 HRC\" }}\n\
             target = {{ material = \"steel\"{target} }}\nimpact = {{ drop_height = \"30 cm\" }}\n{law}"
        );
        fs::write(folder.path().join("drop.toml"), text).unwrap();
        run(folder.path(), ["predict", "drop.toml"]).with_status(0)
    };
    let elastic = said("", "");
    assert!(elastic.err.contains("target.material = \"steel\" has no strength"), "{elastic:#?}");
    assert_eq!(said("", "law = { loading = \"hertz\" }\n").err, "");
    let hard = said(", hardness = \"200 HBW\"", "");
    assert!(hard.err.is_empty() && hard.out.contains("brinell/brinell"), "{hard:#?}");
}

/// Every commented key is valid in a scene.
#[test]
fn every_comment_of_a_new_scene_that_is_a_key_can_be_taken_in() {
    let folder = empty_folder();
    run(folder.path(), ["new", "all"]).with_status(0);
    let path = folder.path().join("all.toml");
    let text = fs::read_to_string(&path).unwrap();
    let mut taken = 0;
    let lines: Vec<String> = text
        .lines()
        .map(|line| {
            let key = line.strip_prefix("# ").filter(|key| key.starts_with('[') || key.contains(" = "));
            taken += usize::from(key.is_some());
            key.unwrap_or(line).to_string()
        })
        .collect();
    assert!(taken >= 14, "{taken}: {text}");
    fs::write(&path, lines.join("\n")).unwrap();
    let predicted = run(folder.path(), ["predict", "all.toml"]).with_status(0);
    assert_eq!(predicted.err, "");
}

#[test]
fn an_invalid_name_is_refused_and_nothing_is_written() {
    let folder = empty_folder();
    for (name, why) in [
        ("4ball", "letters, digits and `_`"),
        ("steel ball", "letters, digits and `_`"),
        ("a\"b", "letters, digits and `_`"),
        ("../ball", "letters, digits and `_`"),
        ("con", "a device on Windows"),
        ("int", "a keyword of C or C++"),
    ] {
        let refused = run(folder.path(), ["new", name]).with_status(2);
        assert!(refused.err.contains(&format!("name = {name:?} is")) && refused.err.contains(why), "{refused:#?}");
    }
    assert!(contents(folder.path()).is_empty());
}

/// The shell of Windows writes UTF-16, an old editor Latin-1.
#[test]
fn a_scene_in_another_encoding_than_utf_8_is_refused_with_its_place() {
    let folder = empty_folder();
    let utf16: Vec<u8> = format!("\u{feff}{SCENE}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    let without_mark: Vec<u8> = SCENE.encode_utf16().flat_map(u16::to_be_bytes).collect();
    let utf32: Vec<u8> = format!("\u{feff}{SCENE}").chars().flat_map(|c| u32::from(c).to_le_bytes()).collect();
    let latin1 = [SCENE.as_bytes(), b"# gr\xf6\xdfer\n"].concat();
    for (bytes, parts) in [
        (utf16, ["scene.toml:1:1: byte 0xFF", "UTF-16"]),
        (without_mark, ["scene.toml:1:1: byte 0x00", "UTF-16"]),
        (utf32, ["scene.toml:1:1: byte 0xFF", "UTF-32"]),
        (latin1, ["scene.toml:8:5: byte 0xF6", "UTF-8"]),
        (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec(), ["scene.toml:1:1: this is a picture (PNG)", "plain text (TOML)"]),
        (b"\xff\xd8\xff\xe0\0".to_vec(), ["this is a picture (JPEG)", "plain text"]),
        (b"%PDF-1.7\n".to_vec(), ["this is a document (PDF)", "plain text"]),
        (b"{\\rtf1\\ansi name = }".to_vec(), ["this is a document (RTF)", "plain text"]),
        (b"\x1f\x8b\x08\0".to_vec(), ["compressed (gzip)", "plain text"]),
        (b"\x7fELF\x02".to_vec(), ["a program or a library", "plain text"]),
        (b"<!DOCTYPE html><html>".to_vec(), ["a page of the web", "plain text"]),
        (b"name = \"b\"\0\0\x01".to_vec(), ["this is no text", "plain text"]),
        (b"PK\x05\x06\0\0".to_vec(), ["an empty zip archive", "plain text"]),
    ] {
        fs::write(folder.path().join("scene.toml"), bytes).unwrap();
        let message = run(folder.path(), ["predict", "scene.toml"]).with_status(1).err;
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_file_that_never_ends_is_no_scene() {
    let message = run(empty_folder().path(), ["predict", "/dev/zero"]).with_status(1).err;
    assert!(message.contains("/dev/zero: it has more than 256 MB; allowed for a scene is 256 MB"), "{message}");
}

/// Every command that takes a scene takes that of an FMU, and says of a folder and of a missing file which one may be meant.
#[test]
fn a_scene_may_be_that_of_an_fmu_and_of_a_folder_the_scene_in_it_is_named() {
    let folder = empty_folder();
    fs::write(folder.path().join("ball.toml"), with_impact()).unwrap();
    fs::write(folder.path().join("materials.toml"), "").unwrap();
    run(folder.path(), ["export", "ball.toml"]).with_status(0);
    let calls = [
        &["predict"][..],
        &["curve"],
        &["si"],
        &["constants"],
        &["translate", "--for", "mujoco"],
        &["hardness", "--load", "3000kgf"],
        &["export", "-o", "again.fmu"],
    ];
    for call in calls {
        let call = |what: &str| run(folder.path(), [call, &[what]].concat());
        // but for how long it took
        let told = |what: &str| {
            let out = call(what).with_status(0).out.replace("ball.fmu", "ball.toml");
            out.lines().filter(|line| !line.contains("  made  ")).map(String::from).collect::<Vec<_>>()
        };
        assert_eq!(told("ball.fmu"), told("ball.toml"), "{:?}", call("x").err);
        let said = call(".").with_status(1).err;
        assert!(said.starts_with("brinell: .: this is a folder; the scene in it is ./ball.toml"), "{said}");
        let said = call("bal.toml").with_status(1).err;
        assert!(said.contains("did you mean ball.toml?"), "{said}");
    }
    assert!(fs::read(folder.path().join("again.fmu")).unwrap() == fs::read(folder.path().join("ball.fmu")).unwrap());
    let said = run(folder.path(), ["check", "."]).with_status(1).err;
    assert!(said.contains("name one of the files (.fmu) in it: ./again.fmu, ./ball.fmu"), "{said}");
    let said = run(folder.path(), ["export", "ball.fmu"]).with_status(1).err;
    assert!(said.contains("this is the scene itself, which isn't overwritten"), "{said}");
    let empty = empty_folder();
    let said = run(empty.path(), ["predict", "."]).with_status(1).err;
    assert!(said.contains("no scene (.toml) is in it; `brinell new NAME` writes one"), "{said}");
    // of another program
    fs::write(empty.path().join("other.fmu"), b"PK\x03\x04 and so on").unwrap();
    let said = run(empty.path(), ["predict", "other.fmu"]).with_status(1).err;
    assert!(said.contains("other.fmu: it is no zip archive"), "{said}");
}

/// Nor does a scene of the repository.
#[test]
fn a_usual_number_causes_no_question() {
    let folder = empty_folder();
    let doubts = |scene: &Path| run(folder.path(), ["predict".as_ref(), scene.as_os_str()]).err;
    for (from, to) in [("5e-3", "5e-6"), ("5e-3", "0.5"), ("5e-3", "1.0"), ("[target]", "[target]\nradius = 1e3")] {
        fs::write(folder.path().join("scene.toml"), with_impact().replacen(from, to, 1)).unwrap();
        // 4 g press a ball of 5 um wider than itself
        let said = doubts(Path::new("scene.toml"));
        assert!(!said.contains("did you mean") && (said.is_empty() || to == "5e-6"), "{to}: {said}");
    }
    for path in unit::scenes() {
        assert_eq!(doubts(&path), "", "{}", path.display());
    }
}

/// A scene from a stranger may have commands for the terminal in it.
#[test]
fn control_characters_of_a_scene_are_not_printed() {
    for text in ["\u{1b}[31m = 3\n".into(), SCENE.replacen("ball", "\u{1b}]0;title\u{7}", 1)] {
        let said = refusal::message_of(text.as_bytes());
        assert!(said.contains("scene.toml:1:") && !said.contains(['\u{1b}', '\u{7}']), "{said:?}");
    }
}

#[test]
fn a_thousand_materials_of_which_two_are_used_are_told_in_few_lines() {
    let folder = empty_folder();
    let materials = |count: usize| {
        let one = |index: usize| {
            format!(
                "[[material]]\nname = \"m{index}\"\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\ndensity = 7850\nyield_strength = 3e8\n"
            )
        };
        (0..count).map(one).collect::<String>()
    };
    let used = with_impact().replacen(
        "youngs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 300e6",
        "material = \"m7\"",
        1,
    );
    fs::write(folder.path().join("scene.toml"), format!("{used}{}", materials(1000))).unwrap();
    let out = run(folder.path(), ["predict", "scene.toml"]).with_status(0).out;
    assert!(out.contains("Material `m7` is that of the scene."), "{out}");
    assert!(out.contains("999 materials of the scene are used by no body: `m0` to `m999`."), "{out}");
    assert_eq!(out.matches("aterial").count() - out.matches("materials").count(), 1, "{out}");
}

/// The good scene with an impact.
fn with_impact() -> String {
    format!("{SCENE}[impact]\nmass = 4e-3\nspeed = 1.0\n")
}

/// A ball of known density needs no mass; an explicit number overrides that of the material.
#[test]
fn an_impactor_takes_a_material_and_a_density() {
    let folder = empty_folder();
    let predicted = |impactor: &str, impact: &str| {
        let text = format!(
            "name = \"ball\"\n[impactor]\nradius = 5e-3\n{impactor}\n[target]\nmaterial = \"mild steel\"\n{impact}"
        );
        fs::write(folder.path().join("scene.toml"), text).unwrap();
        run(folder.path(), ["predict", "scene.toml", "--json"]).with_status(0).json()
    };
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let by_name = predicted("material = \"mild steel\"", "[impact]\nspeed = 2.0");
    let by_numbers = predicted(
        "youngs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 300e6",
        &format!("[impact]\nspeed = 2.0\nmass = {}", by_name["mass"]),
    );
    assert_eq!(by_name["laws"], by_numbers["laws"]);
    let volume = 4.0 / 3.0 * std::f64::consts::PI * 5e-3f64.powi(3);
    assert!((number(&by_name["mass"]) / (7850.0 * volume) - 1.0).abs() < 1e-12);
    let lighter = predicted("material = \"mild steel\"\ndensity = 1000.0", "");
    assert!((number(&lighter["mass"]) / (1000.0 * volume) - 1.0).abs() < 1e-12);
    let softer = predicted("material = \"mild steel\"\nyoungs_modulus = 1e9", "[impact]\nspeed = 2.0");
    let force = |answer: &serde_json::Value| number(&answer["laws"][0]["largest_force"]);
    assert!(force(&softer) < 0.5 * force(&by_name), "{softer}");
}

/// A scene that names only a loading law has its default unloading law, and so has a prediction with that law.
#[test]
fn a_law_that_is_named_alone_is_the_same_in_a_scene_and_in_a_prediction() {
    let folder = empty_folder();
    let write = |name: &str, law: &str| {
        let text = format!("{}[law]\n{law}\n", with_impact());
        fs::write(folder.path().join(name), text).unwrap();
    };
    write("other.toml", "unloading = \"original-radius\"");
    for (law, _) in brinell_contact::loading::AnyLoading::of_balls() {
        write("own.toml", &format!("loading = \"{law}\""));
        let own = run(folder.path(), ["predict", "own.toml", "--json"]).with_status(0).json();
        let named = run(folder.path(), ["predict", "own.toml", "--laws", law, "--json"]).with_status(0).json();
        assert_eq!(own["laws"], named["laws"], "{law}");
        if law != "brinell" {
            let beside = run(folder.path(), ["predict", "other.toml", "--laws", law, "--json"]).with_status(0).json();
            assert_eq!(own["laws"], beside["laws"], "{law} beside another law");
        }
        let pair = own["laws"][0]["law"].as_str().unwrap();
        assert!(law == "hertz" || pair.starts_with(&format!("{law}/")), "{pair}");
    }
    write("own.toml", "loading = \"brinell\"");
    let own = run(folder.path(), ["predict", "own.toml", "--json"]).with_status(0).json();
    assert_eq!(own["laws"][0]["law"], "brinell/brinell");
}
