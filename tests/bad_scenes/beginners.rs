//! `brinell new`, and typical errors of beginners in scenes.

use super::command::{Run, contents, empty_folder, run, scene};
use super::{SCENE, schema};
use std::fs;

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
            out.lines().filter(|line| !line.contains("compiled in")).map(String::from).collect::<Vec<_>>()
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

/// Read from a web page or a word processor, each stands for a character that TOML knows.
#[test]
fn a_character_of_a_word_processor_is_named_with_what_to_type() {
    for (from, to, hint) in [
        (
            "\"ball\"",
            "\u{201c}ball\u{201d}",
            "scene.toml:1:8: `\u{201c}` (U+201C) is a quotation mark of a word processor; type \" in",
        ),
        (
            "5e-3",
            "\u{2018}5 mm\u{2019}",
            "scene.toml:3:10: `\u{2018}` (U+2018) is a quotation mark of a word processor; type \"",
        ),
        ("5e-3", "\u{ab}5 mm\u{bb}", "(U+00AB) is a quotation mark"),
        ("5e-3", "\u{201e}5 mm\u{201c}", "(U+201E) is a quotation mark"),
        ("5e-3", "\"5 mm\u{201d}", "scene.toml:3:15: `\u{201d}` (U+201D) is a quotation mark of a word processor"),
        ("0.3", "\u{2212}0.3", "(U+2212) is a minus sign of a word processor; type - in"),
        ("5e-3", "5e\u{2013}3", "(U+2013) is a dash of a word processor; type - in"),
        ("radius = ", "radius\u{a0}= ", "scene.toml:3:7: (U+00A0) is a space of a page of the web; type a space in"),
        ("radius", "\u{201c}radius\u{201d}", "(U+201C) is a quotation mark"),
    ] {
        let said = said(&SCENE.replacen(from, to, 1)).replace("\n  ", " ");
        assert!(said.contains(hint), "nothing of {hint} in {said}");
    }
    // where it is a character of a text or a remark, another mistake is told
    let said = said(&SCENE.replacen("name", "# \u{201c}x\u{201d}\ncolour = \"\u{201c}\"\nname", 1));
    assert!(said.contains("`colour`"), "{said}");
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

/// The message of `brinell predict` about a wrong scene.
#[track_caller]
fn said(text: &str) -> String {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    let message = run(folder.path(), ["predict", "scene.toml"]).with_status(1).err;
    schema::agrees(text, &message);
    message
}

/// The warnings about the plausibility of a valid scene.
#[track_caller]
fn doubted(text: &str) -> String {
    predicted(text).with_status(0).err
}

/// What the program says of the impact of a scene that the schema accepts.
fn predicted(text: &str) -> Run {
    schema::accepts(text);
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    run(folder.path(), ["predict", "scene.toml"])
}

/// The good scene with an impact.
fn with_impact() -> String {
    format!("{SCENE}[impact]\nmass = 4e-3\nspeed = 1.0\n")
}

#[test]
fn a_wrong_unit_is_told_with_its_place_and_the_units_that_are_allowed() {
    for (from, to, hint) in [
        ("radius = 5e-3", "radius = 5mm", "scene.toml:3:10: radius = 5mm: a number with a unit is in quotes: \"5 mm\""),
        ("206e9", "206GPa # stiff", "youngs_modulus = 206GPa: a number with a unit is in quotes: \"206 GPa\""),
        (
            "radius = 5e-3",
            "radius = \"5 MPa\"",
            "scene.toml:3:10: impactor.radius = \"5 MPa\": MPa is a pressure; a length has a unit like one of `nm`, `um`, `mm`",
        ),
        ("206e9", "\"206 Gpa\"", "target.youngs_modulus = \"206 Gpa\": there is no unit `Gpa`; did you mean `GPa`? A"),
        ("4e-3", "\"4 gram\"", "impact.mass = \"4 gram\": there is no unit `gram`"),
        (
            "4e-3",
            "\"4e-3\"",
            "impact.mass = \"4e-3\": in quotes a number needs its unit: \"4e-3 kg\"; without quotes it is in",
        ),
        (
            "1.0",
            "\"3.6 km\"",
            "impact.speed = \"3.6 km\": km is a length; a speed has a unit like one of `mm/s`, `cm/s`, `m/s`",
        ),
        ("1.0", "\"1e400 m/s\"", "impact.speed = \"1e400 m/s\": the number is too large"),
        ("206e9", "\"-206 GPa\"", "target.youngs_modulus = -206 GPa is out of range: allowed is"),
        ("[impactor]\nradius = 5e-3", "impactor = { radius = \"5 kg\" }", "impactor.radius = \"5 kg\": kg is a mass"),
        (
            "yield_strength = 300e6",
            "power_law = { coefficient = \"400 mm\", exponent = 0.2 }",
            "target.power_law.coefficient = \"400 mm\": mm is a length; a pressure has",
        ),
        (
            "300e6",
            "300e6\nrate = { model = \"cowper-symonds\", d = \"40 s\", q = 5 }",
            "target.rate.d = \"40 s\": s is a time; a rate has a unit like",
        ),
        (
            "speed = 1.0",
            "speed = 1.0\n[law]\nloading = \"kuwabara-kono\"\nloading_parameters = { relaxation_time = \"1 mm\" }",
            "law.loading_parameters.relaxation_time = \"1 mm\": mm is a length; a time has",
        ),
        // a word of a law, and numbers without dimension
        ("0.3", "\"0.3 m\"", "this is text, expected a number in `poissons_ratio"),
    ] {
        let text = with_impact().replacen(from, to, 1);
        // one line for a table comes before the others
        let text = if to.starts_with("impactor") {
            text.replacen("name = \"ball\"\n", &format!("name = \"ball\"\n{to}\n"), 1).replacen(
                &format!("{to}\n[target]"),
                "[target]",
                1,
            )
        } else {
            text
        };
        let said = said(&text);
        assert!(said.contains(hint) && said.lines().count() == 1, "nothing of {hint} in {said}");
    }
}

#[test]
fn a_value_of_another_kind_is_told_in_words_of_the_file() {
    for (from, to, hint) in [
        ("[impactor]\nradius = 5e-3", "impactor = 5", "expected a table in `impactor = 5`"),
        ("[impactor]\nradius = 5e-3", "fmu = 5", "expected a table in `fmu = 5`"),
        (
            "[impactor]",
            "[contact]\nname = \"left\"\n[impactor]",
            "this is a table, expected a list in `[contact]`; write `[[contact]]`",
        ),
        ("radius = 5e-3", "radius = 1e400", "scene.toml:3:10: the number is too large: numbers are below 1.797"),
        ("radius = 5e-3", "radius = [1]", "this is a list of 1, expected a number or two in `radius = [1]`"),
        ("radius = 5e-3", "radius = \"five\"", "this is text, expected a number in `radius = \"five\"`"),
        ("radius = 5e-3", "radius = true", "this is true or false, expected a number in `radius = true`"),
        ("radius = 5e-3", "radius = 5.", "this is no number"),
        ("radius = 5e-3", "radius = +-1", "this is no number"),
        ("radius = 5e-3", "radius = NaN", "this is no number"),
        ("radius = 5e-3", "radius = five", "this is neither a number nor text in quotes in `radius = five`"),
        ("radius = 5e-3", "radius = 2024-01-01", "this is a date, expected a number in `radius = 2024-01-01`"),
        ("radius = 5e-3", "radius = 07:32:00", "this is a date, expected a number in `radius = 07:32:00`"),
        (
            "[impactor]\nradius = 5e-3",
            "impact = 2024-01-01",
            "this is a date, expected a table in `impact = 2024-01-01`",
        ),
        ("[impactor]\nradius = 5e-3", "fmu = 2024-01-01", "this is a date, expected a table in `fmu = 2024-01-01`"),
        (
            "[impactor]\nradius = 5e-3",
            "contact = 2024-01-01",
            "this is a date, expected a list in `contact = 2024-01-01`",
        ),
        (
            "[impactor]\nradius = 5e-3",
            "law.loading = 2024-01-01",
            "expected text in quotes in `law.loading = 2024-01-01`",
        ),
        (
            "[target]",
            "[target]\nsurface = 2024-01-01",
            "this is a date, expected text in quotes in `surface = 2024-01-01`",
        ),
        (
            "[impactor]\nradius = 5e-3",
            "fmu.standalone = 2024-01-01",
            "this is a date, expected true or false in `fmu.standalone",
        ),
        ("[target]", "[target]\nsurface = 5", "this isn't text in quotes in `surface = 5`"),
        ("[impactor]\nradius = 5e-3", "law.loading_parameters = 5", "expected a table in `law.loading_parameters = 5`"),
        (
            "[impactor]\nradius = 5e-3",
            "law.loading_parameters = 2024-01-01",
            "this is a date, expected a table in `law.loading_parameters = 2024-01-01`",
        ),
    ] {
        let text = SCENE.replacen(from, to, 1);
        let text = if to.starts_with(['[', 'r']) {
            text
        } else {
            text.replacen(to, "", 1).replacen('\n', &format!("\n{to}\n"), 1)
        };
        let said = said(&text).replace("\n  ", " ");
        assert!(said.contains(hint), "nothing of {hint} in {said}");
    }
}

#[test]
fn a_decimal_comma_is_called_so_wherever_it_is() {
    for (from, to, hint) in [
        ("5e-3", "5,3", "scene.toml:3:11: radius = 5,3: this is a decimal comma; write 5.3"),
        ("5e-3", "5,3e-3 # mm", "radius = 5,3e-3: this is a decimal comma; write 5.3e-3"),
        (
            "5e-3",
            "\"1,234 mm\"",
            "impactor.radius = \"1,234 mm\": write 1.234 mm if this is a decimal comma, or 1234 mm",
        ),
        ("0.3", "0,3", "scene.toml:6:19: poissons_ratio = 0,3: this is a decimal comma; write 0.3"),
        ("0.3", "\"0,3\"", "poissons_ratio = 0,3: this is a decimal comma; write 0.3"),
        ("206e9", "206,000", "write 206.000, or 206000 if it separates thousands"),
        (
            "yield_strength = 300e6",
            "power_law = { coefficient = 400,5e6, exponent = 0.2 }",
            "coefficient = 400,5e6: this is a",
        ),
        (
            "yield_strength = 300e6",
            "power_law = { coefficient = 4e8, exponent = 0,2 }",
            "exponent = 0,2: this is a decimal",
        ),
        (
            "yield_strength = 300e6",
            "power_law = {exponent=0,2,coefficient=4e8}",
            "exponent = 0,2: this is a decimal comma",
        ),
        ("300e6", "300e6\n[friction]\ncoefficient = 0,3", "coefficient = 0,3: this is a decimal comma; write 0.3"),
    ] {
        let said = said(&SCENE.replacen(from, to, 1)).replace("\n  ", " ");
        assert!(said.contains(hint) && said.lines().count() == 1, "nothing of {hint} in {said}");
    }
    // a comma with another meaning
    for (from, to) in [
        ("5e-3", "[5,3]"),
        ("\"ball\"", "\"ball\"\ndescription = \"E=5,3\" x"),
        ("yield_strength = 300e6", "power_law = { coefficient = 4,exponent = 0.2, }}"),
    ] {
        let said = said(&SCENE.replacen(from, to, 1));
        assert!(!said.contains("decimal comma"), "{said}");
    }
}

/// A scene from a stranger may have commands for the terminal in it.
#[test]
fn control_characters_of_a_scene_are_not_printed() {
    for text in ["\u{1b}[31m = 3\n".into(), SCENE.replacen("ball", "\u{1b}]0;title\u{7}", 1)] {
        let said = said(&text);
        assert!(said.contains("scene.toml:1:") && !said.contains(['\u{1b}', '\u{7}']), "{said:?}");
    }
}

#[test]
fn an_implausible_number_causes_a_question() {
    for (from, to, question) in [
        ("5e-3", "5", "scene.toml:3:10: impactor.radius = 5 m; did you mean 5e-3?"),
        ("206e9", "206", "target.youngs_modulus = 206 Pa; did you mean 206e9?"),
        ("206e9", "206000", "target.youngs_modulus = 206e3 Pa; did you mean 206e9?"),
        ("206e9", "206e12", "target.youngs_modulus = 206e12 Pa; did you mean 206e9?"),
        (
            "youngs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 300e6",
            "youngs_modulus = 70000\npoissons_ratio = 0.3",
            "target.youngs_modulus = 70000 Pa; did you mean 70e9?",
        ),
        ("yield_strength = 300e6", "tensile_strength = 655", "target.tensile_strength = 655 Pa; did you mean 655e6?"),
        (
            "[target]",
            "[target]\ndensity = 7850\nplate_thickness = 4",
            "target.plate_thickness = 4 m; did you mean 4e-3?",
        ),
        (
            "mass = 4e-3",
            "mass = 4",
            "impact.mass = 4 kg is 1000 times the mass of a solid ball of steel of this radius, 4.11 g; did you mean 4e-3?",
        ),
        (
            "mass = 4e-3",
            "mass = 4000",
            "impact.mass = 4000 kg is a million times the mass of a solid ball of steel of this radius, 4.11 g; did you mean 4e-3?",
        ),
        (
            "mass = 4e-3",
            "mass = 4e-6",
            "impact.mass = 4e-6 kg is a thousandth of the mass of a solid ball of steel of this radius, 4.11 g; did you mean 4e-3?",
        ),
        ("speed = 1.0", "drop_height = 300", "impact.drop_height = 300 m; did you mean 0.3?"),
        ("300e6", "300", "target.yield_strength = 300 Pa; did you mean 300e6?"),
        ("206e9", "1e9", "is more than a fifth of youngs_modulus"),
        ("[target]", "[target]\ndensity = 7.85", "target.density = 7.85 kg/m^3; did you mean 7850?"),
        (
            "yield_strength = 300e6",
            "power_law = { coefficient = 400, exponent = 0.2 }\n[law]\nloading = \"brinell\"",
            "target.power_law.coefficient = 400 Pa; did you mean 400e6?",
        ),
        (
            "[target]",
            "youngs_modulus = 206e9\npoissons_ratio = 0.3\npower_law = { coefficient = 400, exponent = 0.2 }\n\
             [law]\nloading = \"brinell\"\n[target]",
            "impactor.power_law.coefficient = 400 Pa; did you mean 400e6?",
        ),
        (
            "300e6",
            "300e6\nhardening_modulus = 2000\n[law]\nloading = \"brinell\"",
            "target.hardening_modulus = 2000 Pa; did you mean 2e9?",
        ),
        (
            "300e6",
            "300e6\ntangent_modulus = 2\n[law]\nloading = \"brinell\"",
            "target.tangent_modulus = 2 Pa; did you mean",
        ),
        ("speed = 1.0", "speed = 5000.0", "impact.speed = 5000 m/s; did you mean 5?"),
        ("5e-3", "5e-3\ndensity = 7.85", "impactor.density = 7.85 kg/m^3; did you mean 7850?"),
        ("[target]", "[target]\ndensity = 7850\nlength = 500\narea = 1e-4", "target.length = 500 m; did you mean 0.5?"),
        (
            "[target]",
            "[target]\ndensity = 7850\nlength = 0.5\narea = 7854",
            "target.area = 7854 m^2; did you mean 7.854e-3?",
        ),
    ] {
        let said = predicted(&with_impact().replacen(from, to, 1));
        let (doubted, is_possible) = (&said.err, said.status == Some(0));
        let begins = if is_possible { "brinell: warning: scene.toml:" } else { "brinell: scene.toml:" };
        assert!(doubted.starts_with(begins), "{doubted}");
        assert!(is_possible || doubted.contains("no contact is wider than its body; "), "{doubted}");
        assert!(doubted.contains(question) && doubted.lines().count() == 1, "nothing of {question} in {doubted}");
    }
    for (tables, question) in [
        ("[impact]\nmass = 4e7\nspeed = 1.0\n", "impact.mass = 40e6 kg; did you mean 40000?"),
        ("[coupling]\neffective_mass = 4e7\n", "coupling.effective_mass = 40e6 kg; did you mean 40000?"),
        (
            "[coupling]\neffective_mass = 1.0\n[[contact]]\nname = \"left\"\neffective_mass = 4e7\n",
            "left.effective_mass = 40e6 kg; did you mean 40000?",
        ),
        (
            "[[body]]\nname = \"ball\"\nmass = 4e7\n[[contact]]\nname = \"left\"\nbetween = [\"ball\", \"ground\"]\n",
            "body `ball`: mass = 40e6 kg; did you mean 40000?",
        ),
        (
            "[[body]]\nname = \"box\"\nmass = 0.3\ninertia = [1.2e5, 2.6e5, 3.5e5]\n[[contact]]\nname = \"left\"\n\
             between = [\"box\", \"ground\"]\n",
            "body `box`: inertia[1] = 120e3 kg m^2; did you mean 120e-6? (the mass is 300 g, and radii of gyration are",
        ),
    ] {
        // a ball with such a mass makes a contact that is wider than itself
        let doubted = predicted(&format!("{SCENE}{tables}")).err;
        assert!(doubted.contains(question) && doubted.lines().count() <= 2, "nothing of {question} in {doubted}");
    }
    for good in ["5e-6", "0.5", "1.0"] {
        // 4 g press a ball of 5 um wider than itself
        let said = predicted(&with_impact().replacen("5e-3", good, 1)).err;
        assert!(!said.contains("did you mean"), "{said}");
    }
    assert_eq!(doubted(&with_impact().replacen("[target]", "[target]\nradius = 1e3", 1)), "", "nearly flat");
    let names = fs::read_dir(scene("x").parent().unwrap()).unwrap();
    for path in names.map(|name| name.unwrap().path()).filter(|path| path.extension().is_some_and(|is| is == "toml")) {
        let folder = empty_folder();
        assert_eq!(run(folder.path(), ["predict".as_ref(), path.as_os_str()]).with_status(0).err, "", "{path:?}");
    }
}

#[test]
fn a_missing_name_blames_nobody_else() {
    let said = said(&with_impact().replacen("name = \"ball\"\n", "", 1));
    assert!(said.contains("missing `name`") && !said.contains("[impactor]"), "{said}");
}

#[test]
fn a_typing_mistake_finds_the_word_that_is_meant() {
    for (from, to, question) in [
        ("yield_strength = 300e6", "material = \"Mild Steel\"", "did you mean `mild steel`?"),
        ("yield_strength = 300e6", "material = \"aluminum 6061\"", "did you mean `aluminium 6061-T6`?"),
        ("yield_strength = 300e6", "yeild_strength = 300e6", "did you mean `yield_strength`?"),
        ("[impact]", "[law]\nloading = \"brinel\"\n[impact]", "did you mean `brinell`?"),
        ("[impact]", "[law]\nunloading = \"contact_radius\"\n[impact]", "did you mean `contact-radius`?"),
        ("[impact]", "[fmu]\noutputs = [\"forse\"]\n[impact]", "did you mean `force`?"),
        ("[impact]", "[fmu]\nparameters = [\"yield_strength\"]\n[impact]", "did you mean `target.yield_strength`?"),
        ("[impact]", "[impcat]\nx = 1\n[impact]", "did you mean `impact`?"),
        ("[impactor]", "[impacter]", "did you mean `impactor`?"),
        (
            "yield_strength = 300e6",
            "material = \"bearing steel\"",
            "may be several materials: say which, one of `bearing steel 52100, hardened`, `bearing",
        ),
        (
            "yield_strength = 300e6",
            "material = \"Stainless Steel\"",
            "say which, `stainless steel 304` or `stainless steel 316L, annealed`",
        ),
        ("[target]", "[target]\nsurface = \"Fresh\"", "did you mean `fresh`?"),
    ] {
        let said = said(&with_impact().replacen(from, to, 1));
        assert!(said.contains(question), "nothing of {question} in {said}");
    }
}

#[test]
fn a_cylinder_needs_its_length_and_the_size_of_what_it_lies_on() {
    for (keys, needs) in [("", "needs impactor.length"), ("\nlength = \"20 mm\"", "target.thickness is missing")] {
        let said = said(&with_impact().replacen("[impactor]", &format!("[impactor]\nshape = \"cylinder\"{keys}"), 1));
        assert!(said.contains(needs), "{said}");
    }
}

#[test]
fn missing_features_are_called_not_supported() {
    for (from, to) in [
        ("[impact]", "[impact]\nangle = 30"),
        ("[target]", "[target]\ncoating = \"TiN\""),
        ("[target]", "[target]\nadhesion = 0.1"),
        ("[target]", "[target]\nroughness = 1e-6"),
    ] {
        let said = said(&with_impact().replacen(from, to, 1));
        assert!(said.contains("is not supported") && said.contains("see Limits"), "{said}");
    }
    for key in ["friction", "mu", "friction_coefficient"] {
        let said = said(&with_impact().replacen("[target]", &format!("[target]\n{key} = 0.3"), 1));
        assert!(said.contains("a table [friction] with a `coefficient`"), "{said}");
    }
    for (key, hint) in [
        ("HB = 200", "hardness = \"200 HBW 10/3000\""),
        ("vickers_hardness = 640", "\"640 HV10\""),
        ("hrc = 58", "\"58 HRC\""),
        ("Rm = 655", "it is called tensile_strength, as in tensile_strength = \"655 MPa\""),
        ("Rp0.2 = 240", "it is called yield_strength, or with the tensile strength tensile_test = { proof_stress = "),
        (
            "proof_stress = 240",
            "it is called yield_strength, or with the tensile strength tensile_test = { proof_stress = ",
        ),
        ("stress_strain_curve = \"a.csv\"", "it is called tensile_test, as in tensile_test = \"curve.csv\""),
        ("HV10 = 640", "\"640 HV10\""),
        ("HLD = 700", "\"700 HLD\""),
        ("nu = 0.3", "it is called poissons_ratio"),
        ("rho = 7850", "it is called density"),
        ("diameter = 0.01", "give the radius"),
        ("thickness = 0.01", "a ball has a plate that gives way of target.plate_thickness"),
        ("drop_height = 0.3", "[impact] has a drop_height"),
        ("gravity = 9.81", "inputs = [\"external_acceleration\"] in [coupling]"),
    ] {
        let said = said(&with_impact().replacen("[target]", &format!("[target]\n{key}"), 1)).replace("\n  ", " ");
        assert!(said.contains(hint), "nothing of {hint} in {said}");
    }
    for (from, to, hint) in [
        ("speed =", "velocity =", "it is called speed, in [impact]"),
        ("[impact]", "[impact]\nsurface = \"fresh\"", "[target] has a surface"),
    ] {
        let said = said(&with_impact().replacen(from, to, 1));
        assert!(said.contains(hint), "nothing of {hint} in {said}");
    }
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
    // rigid
    let said = said(
        "name = \"ball\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n[impact]\nspeed = 1.0\n",
    );
    assert!(said.contains("missing field `mass` in [impact]") && said.contains("density or material"), "{said}");
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

#[test]
fn a_hardness_that_says_no_strength_is_told_with_what_is_allowed() {
    for (from, to, hint) in [
        (
            "yield_strength = 300e6",
            "hardness = 200",
            "scene.toml:7:12: target.hardness = 200: write the number with its scale, such",
        ),
        (
            "yield_strength = 300e6",
            "hardness = \"hard\"",
            "target.hardness = \"hard\": a hardness is a number with its scale",
        ),
        (
            "yield_strength = 300e6",
            "hardness = \"200 HK\"",
            "target.hardness = \"200 HK\": a hardness is a number with its",
        ),
        (
            "yield_strength = 300e6",
            "hardness = \"1,000 HV\"",
            "target.hardness = \"1,000 HV\": write 1.000 if this is a decimal comma, or 1000 if it separates",
        ),
        (
            "yield_strength = 300e6",
            "hardness = \"15 HRC\"",
            "15 HRC is out of range: allowed is 20 to 68; softer steel takes HRB",
        ),
        (
            "yield_strength = 300e6",
            "hardness = \"105 HRB\"",
            "105 HRB is out of range: allowed is 55 to 100; harder steel takes HRC",
        ),
        (
            "yield_strength = 300e6",
            "hardness = \"700 HBW 10/3000\"",
            "700 HBW is out of range: allowed is 3 to 650; harder metals take",
        ),
        ("yield_strength = 300e6", "hardness = \"90 HBW\"", "give ball and load, as in \"95 HBW 10/500\""),
        (
            "yield_strength = 300e6",
            "hardness = \"200 HBW 10\"",
            "`10` is not the ball's diameter in mm and the load in kgf",
        ),
        (
            "yield_strength = 300e6",
            "hardness = \"200 HBW 10/100\"",
            "the dent's diameter would be 0.07972 of the ball's: 0.15 to 0.6",
        ),
        ("yield_strength = 300e6", "hardness = \"700 HL\"", "a rebound hardness has the letter of its device"),
        ("yield_strength = 300e6", "hardness = \"5e-3 HV\"", "a hardness is a number with its scale"),
        ("yield_strength = 300e6", "hardness = \"3000 HV\"", "3000 HV is out of range: allowed is 5 to 1000"),
        (
            "yield_strength = 300e6",
            "hardness = \"200 HV\"\nyield_strength = 3e8",
            "target.hardness and target.yield_strength say the same: give one of them",
        ),
        (
            "yield_strength = 300e6",
            "hardness = \"200 HV\"\ntensile_strength = \"650 MPa\"",
            "target.hardness and target.tensile_strength say the same",
        ),
        (
            "yield_strength = 300e6",
            "hardening_exponent = 0.2\nyield_strength = 3e8",
            "target.hardening_exponent belongs to target.hardness or target.tensile_strength",
        ),
        (
            "yield_strength = 300e6",
            "hardness = \"200 HV\"\nhardening_exponent = 2",
            "target.hardening_exponent = 2 is out of range: allowed is 0 to 0.6",
        ),
        ("206e9", "117e9\nhardness = \"90 HV\"\n#", "with a Young's modulus of 117 GPa give hardening_exponent"),
        ("206e9", "117e9\nhardness = \"80 HRB\"\n#", "HRB is converted by a table for steel that isn't austenitic"),
        (
            "youngs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 300e6",
            "material = \"stainless steel 304\"\nhardness = \"85 HRB\"",
            "and this is austenitic steel: give HBW with ball and load, HV",
        ),
        (
            "yield_strength = 300e6",
            "hardness = \"700 HLD\"\nrate = { model = \"johnson-cook\", c = 0.01 }",
            "target.rate has no place beside 700 HLD: the test was an impact",
        ),
        (
            "yield_strength = 300e6",
            "hardness = \"200 HV\"\nrate = { model = \"johnson-cook\", c = 0.01, reference_rate = 1.0 }",
            "target.rate.reference_rate = 1: the strength from 200 HV is that of a test at about 0.001 1/s, so leave it out",
        ),
        (
            "5e-3",
            "5e-3\nhardness = \"58 HRC\"",
            "impactor.hardness needs impactor.youngs_modulus and impactor.poissons_ratio",
        ),
        ("speed = 1.0", "speed = 1.0\ndrop_height = 0.3", "impact.speed and impact.drop_height determine each other"),
        ("speed = 1.0", "drop_height = 0", "impact.drop_height = 0 must be positive"),
        ("speed = 1.0", "", "missing field `speed` in [impact], or `drop_height`"),
    ] {
        let text = with_impact().replacen(from, to, 1);
        let text = if to.ends_with('#') { text.replacen("yield_strength = 300e6\n", "", 1) } else { text };
        let said = said(&text).replace("\n  ", " ");
        assert!(said.contains(hint) && said.lines().count() == 1, "nothing of {hint} in {said}");
    }
}
