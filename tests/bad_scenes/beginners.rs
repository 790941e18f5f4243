//! `brinell new`, and typical errors of beginners in scenes.

use super::SCENE;
use super::command::{empty_folder, run};
use brinell_testing::folder::{Folder, number};
use brinell_testing::{refusal, unit};
use std::fs;

#[test]
fn a_new_scene_is_a_good_one_and_is_not_overwritten() {
    let folder = Folder::with(&[]);
    let made = folder.call("new hammer").with_status(0);
    let next = [
        "wrote hammer.toml",
        ".brinell.schema.json",
        "next:",
        "brinell predict hammer.toml",
        "brinell export hammer.toml",
    ];
    for said in next {
        assert!(made.out.contains(said), "{said}: {made:#?}");
    }
    let text = folder.read("hammer.toml");
    for shown in [
        "name = \"hammer\"",
        "surface = \"fresh\"",
        "for ever",
        "\"5 mm\"",
        "\"1 m/s\"",
        "hardness = \"180 HBW",
        "drop_height = \"5 cm\"",
    ] {
        assert!(text.contains(shown), "{shown}: {text}");
    }
    assert!(!text.contains("NAME\"") && text.lines().all(|line| line.chars().count() <= 130), "{text}");
    assert_eq!(folder.call("predict hammer.toml").with_status(0).err, "", "a template without doubts");
    folder.call("export hammer.toml").with_status(0);
    let refused = folder.call("new hammer").with_status(1);
    assert!(refused.err.contains("hammer.toml") && refused.err.contains("exists already"), "{refused:#?}");
    assert_eq!(folder.read("hammer.toml"), text);
}

/// The texts recommend `brinell`, and nobody should have to ask for it.
#[test]
fn a_scene_without_a_law_and_a_new_scene_have_the_law_that_is_recommended() {
    let folder = Folder::with(&[]);
    folder.call("new scene").with_status(0);
    assert_eq!(folder.json("predict scene.toml")["laws"][0]["law"], "brinell/brinell");
    let elastic = with_impact().replace("yield_strength = 300e6\n", "");
    for (text, expected) in [
        (with_impact(), "brinell/brinell"),
        (with_impact() + "[law]\n", "brinell/brinell"),
        (with_impact() + "[law]\nunloading = \"thornton\"\n", "brinell/thornton"),
        (with_impact() + "[law]\nloading = \"big-alabo\"\n", "big-alabo/contact-radius"),
        (elastic, "hertz"),
    ] {
        assert_eq!(Folder::of(&text).json("predict scene.toml")["laws"][0]["law"], expected, "{text}");
    }
}

/// Steel has a strength only by its condition.
#[test]
fn a_target_of_steel_is_asked_for_its_strength_and_takes_its_hardness() {
    let said = |target: &str, law: &str| {
        let text = format!(
            "name = \"drop\"\nimpactor = {{ radius = \"5 mm\", material = \"steel\", hardness = \"58 HRC\" }}\n\
             target = {{ material = \"steel\"{target} }}\nimpact = {{ drop_height = \"30 cm\" }}\n{law}"
        );
        Folder::of(&text).call("predict scene.toml").with_status(0)
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
    let folder = Folder::with(&[]);
    folder.call("new all").with_status(0);
    let text = folder.read("all.toml");
    let mut taken = 0;
    let mut take = |line: &str| {
        let key = line.strip_prefix("# ").filter(|key| key.starts_with('[') || key.contains(" = "));
        taken += usize::from(key.is_some());
        format!("{}\n", key.unwrap_or(line))
    };
    let all: String = text.lines().map(&mut take).collect();
    assert!(taken >= 14, "{taken}: {text}");
    assert_eq!(Folder::of(&all).call("predict scene.toml").with_status(0).err, "");
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
    let folder = Folder::with(&[("ball.toml", &with_impact()), ("materials.toml", "")]);
    folder.call("export ball.toml").with_status(0);
    for call in [
        "predict",
        "curve",
        "si",
        "constants",
        "translate --for mujoco",
        "hardness --load 3000kgf",
        "export -o again.fmu",
    ] {
        let call = |what: &str| folder.call(&format!("{call} {what}"));
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
    assert!(fs::read(folder.at("again.fmu")).unwrap() == fs::read(folder.at("ball.fmu")).unwrap());
    let other = Folder::with(&[("other.fmu", "PK\x03\x04 of another program")]);
    for (folder, call, told) in [
        (&folder, "check .", "name one of the files (.fmu) in it: ./again.fmu, ./ball.fmu"),
        (&folder, "export ball.fmu", "this is the scene itself, which isn't overwritten"),
        (&other, "predict .", "no scene (.toml) is in it; `brinell new NAME` writes one"),
        (&other, "predict other.fmu", "other.fmu: it is no zip archive"),
    ] {
        let said = folder.call(call).with_status(1).err;
        assert!(said.contains(told), "{call}: {said}");
    }
}

/// Nor does a scene of the repository.
#[test]
fn a_usual_number_causes_no_question() {
    let doubts = |text: &str| Folder::of(text).call("predict scene.toml").err;
    for (from, to) in [("5e-3", "5e-6"), ("5e-3", "0.5"), ("5e-3", "1.0"), ("[target]", "[target]\nradius = 1e3")] {
        // 4 g press a ball of 5 um wider than itself
        let said = doubts(&with_impact().replacen(from, to, 1));
        assert!(!said.contains("did you mean") && (said.is_empty() || to == "5e-6"), "{to}: {said}");
    }
    for path in unit::scenes() {
        assert_eq!(doubts(&fs::read_to_string(&path).unwrap()), "", "{}", path.display());
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
    let material = |index: usize| {
        let numbers = "youngs_modulus = 206e9\npoissons_ratio = 0.3\ndensity = 7850\nyield_strength = 3e8";
        format!("[[material]]\nname = \"m{index}\"\n{numbers}\n")
    };
    let used = with_impact().replacen(
        "youngs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 300e6",
        "material = \"m7\"",
        1,
    );
    let text = used + &(0..1000).map(material).collect::<String>();
    let out = Folder::of(&text).call("predict scene.toml").with_status(0).out;
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
    let predicted = |impactor: &str, impact: &str| {
        Folder::of(&format!(
            "name = \"ball\"\n[impactor]\nradius = 5e-3\n{impactor}\n[target]\nmaterial = \"mild steel\"\n{impact}"
        ))
        .json("predict scene.toml")
    };
    let by_name = predicted("material = \"mild steel\"", "[impact]\nspeed = 2.0");
    let by_numbers = predicted(
        "youngs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 300e6",
        &format!("[impact]\nspeed = 2.0\nmass = {}", by_name["mass"]),
    );
    assert_eq!(by_name["laws"], by_numbers["laws"]);
    let volume = 4.0 / 3.0 * std::f64::consts::PI * 5e-3f64.powi(3);
    assert!((number(&by_name, "mass") / (7850.0 * volume) - 1.0).abs() < 1e-12);
    let lighter = predicted("material = \"mild steel\"\ndensity = 1000.0", "");
    assert!((number(&lighter, "mass") / (1000.0 * volume) - 1.0).abs() < 1e-12);
    let softer = predicted("material = \"mild steel\"\nyoungs_modulus = 1e9", "[impact]\nspeed = 2.0");
    let [softer, usual] = [softer, by_name].map(|answer| number(&answer, "laws/0/largest_force"));
    assert!(softer < 0.5 * usual, "{softer}");
}

/// A scene that names only a loading law has its default unloading law, and so has a prediction with that law.
#[test]
fn a_law_that_is_named_alone_is_the_same_in_a_scene_and_in_a_prediction() {
    let with = |law: &str| Folder::of(&format!("{}[law]\n{law}\n", with_impact()));
    let other = with("unloading = \"original-radius\"");
    for (law, _) in brinell_contact::loading::AnyLoading::of_balls() {
        let folder = with(&format!("loading = \"{law}\""));
        let own = folder.json("predict scene.toml");
        let named = format!("predict scene.toml --laws {law}");
        assert_eq!(own["laws"], folder.json(&named)["laws"], "{law}");
        if law != "brinell" {
            assert_eq!(own["laws"], other.json(&named)["laws"], "{law} beside another law");
        }
        let pair = own["laws"][0]["law"].as_str().unwrap();
        assert!(law == "hertz" || pair.starts_with(&format!("{law}/")), "{pair}");
        assert!(law != "brinell" || pair == "brinell/brinell", "{pair}");
    }
}
