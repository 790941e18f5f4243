//! People's own data: tensile tests in files, tables of materials, strengths of single contacts. What is exported has the numbers, and
//! no file.

use crate::archive;
use crate::command::{assert_same, brinell, empty_folder, output, run};
use crate::prebuilt::finding_no_compiler;
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const BALL: &str =
    "name = \"ball\"\nimpactor = { radius = \"5 mm\", density = \"7.85 g/cm3\" }\nimpact = { speed = 2.0 }\n";

/// A test of steel as a German spreadsheet writes it: 1000 MPa eps^0.2 in true plastic strain, up to the largest load.
fn curve() -> String {
    let row = |step: i32| {
        let plastic = 1e-4 * 1.1_f64.powi(step);
        let stress = 1000.0 * plastic.powf(0.2);
        let strain = plastic + stress / 210e3;
        format!("{:.6};{:.4}\n", 100.0 * strain.exp_m1(), stress * (-strain).exp()).replace('.', ",")
    };
    "Dehnung [%];Spannung [MPa]\n".to_string() + &(0..80).map(row).collect::<String>()
}

fn folder_with(files: &[(&str, &str)]) -> TempDir {
    let folder = empty_folder();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

fn predicted(folder: &Path, scene: &str) -> Value {
    run(folder, ["predict", scene, "--json"]).with_status(0).json()
}

fn number(answer: &Value, key: &str) -> f64 {
    answer["laws"][0][key].as_f64().unwrap_or_else(|| panic!("no {key} in {answer}"))
}

const STEEL: &str = "youngs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\n";

#[test]
fn a_tensile_test_in_a_file_beside_the_scene_says_what_its_points_say() {
    let points: Vec<f64> = (0..12).map(|step| 0.005 * 1.3_f64.powi(step)).collect();
    let stresses: Vec<f64> = points.iter().map(|strain| 1e9 * strain.powf(0.2)).collect();
    let by_points = format!(
        "{BALL}[target]\n{STEEL}tensile_test = {{ plastic_strain = {points:?}, true_stress = {stresses:?} }}\n"
    );
    let by_file = format!("{BALL}[target]\n{STEEL}tensile_test = \"tests/curve 7.csv\"\n");
    let folder =
        folder_with(&[("a/scene.toml", &by_file), ("a/tests/curve 7.csv", &curve()), ("points.toml", &by_points)]);
    let [file, points] = ["a/scene.toml", "points.toml"].map(|scene| predicted(folder.path(), scene));
    for key in ["restitution", "largest_force", "dent"] {
        let error = number(&file, key) / number(&points, key) - 1.0;
        assert!(error.abs() < 3e-3, "{key}: {error}");
    }
    let said = run(folder.path(), ["predict", "a/scene.toml"])
        .with_status(0)
        .out
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ");
    for words in [
        "A tensile test is a flow stress of 49",
        "(power law through its",
        "standard deviation 3",
        "hardening exponent 0.2",
        "its tangent there is S =",
    ] {
        assert!(said.contains(words), "no {words:?} in {said}");
    }
}

/// The same specimen in a machine that gives way: without a warning only where it doesn't, and the same impact where its compliance is taken
/// off. Force and travel with the specimen's sizes are the same test.
#[test]
fn a_crosshead_is_warned_of_and_its_compliance_can_be_taken_off() {
    let rows: Vec<[f64; 2]> = (0..110)
        .map(|step| {
            // its elastic part, then a power law from 2e-5 on
            let plastic = if step < 30 { 0.0 } else { 2e-5 * 1.11_f64.powi(step - 30) };
            let stress = if step < 30 { 114.0 * f64::from(step) / 30.0 } else { 1000.0 * plastic.powf(0.2) };
            let strain = plastic + stress / 210e3;
            [strain.exp_m1(), stress * (-strain).exp()]
        })
        .collect();
    let table = |part: f64| {
        let row = |[strain, stress]: &[f64; 2]| format!("{};{stress}\n", strain + stress / 210e3 * (1.0 / part - 1.0));
        "strain;stress [MPa]\n".to_string() + &rows.iter().map(row).collect::<String>()
    };
    let raw = |[strain, stress]: &[f64; 2]| format!("{}\t{}\n", 30.0 * strain, 7.5 * stress);
    let raw = "# travel [mm]\tforce [N]\n".to_string() + &rows.iter().map(raw).collect::<String>();
    let scene = |test: &str| format!("{BALL}[target]\n{STEEL}tensile_test = {test}\n");
    let [right, most, soft] = [1.0, 0.95, 0.5].map(table);
    let folder = folder_with(&[
        ("right.csv", &right),
        ("most.csv", &most),
        ("soft.csv", &soft),
        ("raw.csv", &raw),
        ("right.toml", &scene("\"right.csv\"")),
        ("most.toml", &scene("\"most.csv\"")),
        ("soft.toml", &scene("\"soft.csv\"")),
        ("off.toml", &scene("{ curve = \"soft.csv\", compliance_correction = true }")),
        ("raw.toml", &scene("{ curve = \"raw.csv\", section = \"7.5 mm^2\", gauge_length = \"3 cm\" }")),
    ]);
    let told = |scene: &str| {
        let run = run(folder.path(), ["predict", scene]).with_status(0);
        run.err.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    for scene in ["right.toml", "most.toml", "off.toml", "raw.toml"] {
        assert_eq!(told(scene), "", "{scene}");
    }
    let warning = "target.tensile_test: the curve begins with a slope of 105 GPa, 0.5 of youngs_modulus = 210 GPa; a strain by the crosshead \
                   contains the machine: give that of an extensometer, take the record's own slope off with compliance_correction = true";
    assert!(told("soft.toml").contains(warning), "{}", told("soft.toml"));
    let restitution = |scene: &str| number(&predicted(folder.path(), scene), "restitution");
    let expected = restitution("right.toml");
    for (scene, tolerance) in [("off.toml", 1e-3), ("raw.toml", 1e-9)] {
        let error = restitution(scene) / expected - 1.0;
        assert!(error.abs() < tolerance, "{scene}: {error}");
    }
    assert!(restitution("soft.toml") < 0.995 * expected, "the crosshead makes it softer");
}

/// Hollomon and Considere: sigma = Rm (e eps/n)^n, n from Rp0.2 and Rm.
#[test]
fn two_numbers_of_a_tensile_test_are_a_power_law() {
    let scene = format!(
        "{BALL}[target]\n{STEEL}tensile_test = {{ proof_stress = \"240 MPa\", tensile_strength = \"480 MPa\" }}\n"
    );
    let folder = folder_with(&[("scene.toml", &scene)]);
    let said = run(folder.path(), ["predict", "scene.toml"])
        .with_status(0)
        .out
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ");
    let n = 0.2149_f64;
    let ratio = n * (1.0 + ((0.002 + 240.0 / 210e3) / n).ln());
    assert!((ratio - 0.5_f64.ln()).abs() < 2e-3, "{ratio}");
    let stress = 480.0 * (std::f64::consts::E * 0.03 / n).powf(n);
    assert!(said.contains(&format!("is a flow stress of {stress:.1}")), "no {stress} in {said}");
    assert!(said.contains("standard deviation 5 %"), "{said}");
}

/// A law without hardening takes the flow stress at the strain, beside another law as in a scene of its own; a hardness test takes what belongs
/// to its own strain. In so wide a dent the fit's tables of hardening are
/// 5.6 % below Tabor's rule.
#[test]
fn a_law_without_hardening_takes_the_flow_stress_of_a_tensile_test() {
    let scene = |law: &str| {
        format!(
            "{BALL}law = {{ loading = \"{law}\" }}\n[target]\n{STEEL}tensile_test = {{ proof_stress = \"240 MPa\", tensile_strength = \"480 MPa\" }}\n"
        )
    };
    let folder = folder_with(&[("johnson.toml", &scene("johnson")), ("brinell.toml", &scene("brinell"))]);
    let own = number(&predicted(folder.path(), "johnson.toml"), "restitution");
    let beside = run(folder.path(), ["predict", "brinell.toml", "--laws", "johnson", "--json"]).with_status(0).json();
    let error = number(&beside, "restitution") / own - 1.0;
    assert!(error.abs() < 0.02, "the strain is that of the scene's own law: {error}");
    let hardness = |scene: &str| {
        let answer = run(folder.path(), ["hardness", scene, "--load", "1000kgf", "--laws", "brinell", "--json"])
            .with_status(0)
            .json();
        answer["laws"][0]["brinell_hardness"].as_f64().unwrap()
    };
    let [of_tangent, of_stress] = ["brinell.toml", "johnson.toml"].map(hardness);
    let said = run(folder.path(), ["hardness", "brinell.toml", "--load", "1000kgf"]).with_status(0).out;
    assert!(said.contains("note: target: A tensile test with a proof stress of 240 MPa"), "{said}");
    assert!((of_tangent / of_stress - 1.0).abs() < 0.07, "{of_tangent} and {of_stress}");
}

const MATERIALS: &str = "\
[[material]]
name = \"our steel\"
aliases = [\"batch 7\"]
youngs_modulus = \"205 GPa\"
poissons_ratio = 0.29
hardness = \"300 HV10\"
density = \"7.8 g/cm3\"
source = \"own measurement\"

[[material]]
name = \"mild steel\"
youngs_modulus = 206e9
poissons_ratio = 0.3
yield_strength = \"280 MPa\"
density = 7850
";

/// The unit, its GUID and its own scene are the same from wherever the numbers came, and the scene in it needs no file.
#[test]
fn a_unit_has_the_numbers_of_the_files_beside_the_scene_and_not_the_files() {
    let scene = |test: &str, material: &str| {
        format!(
            "{BALL}[target]\n{STEEL}tensile_test = \"{test}\"\n[[contact]]\nname = \"a\"\n[[contact]]\nname = \"b\"\ntarget = {{ material = \"{material}\" }}\n"
        )
    };
    let folder = folder_with(&[
        ("one/scene.toml", &scene("curve.csv", "batch 7")),
        ("one/curve.csv", &curve()),
        ("one/materials.toml", MATERIALS),
        ("two/scene.toml", &scene("../elsewhere/test.csv", "batch 7")),
        ("elsewhere/test.csv", &curve()),
        ("config/brinell/materials.toml", MATERIALS),
    ]);
    for place in ["one", "two"] {
        let mut command = brinell(folder.path());
        command.args(["export", &format!("{place}/scene.toml"), "--output", &format!("{place}/unit.fmu")]);
        // the table of the user, for the scene that has none beside it
        for name in ["XDG_CONFIG_HOME", "APPDATA"] {
            command.env(name, folder.path().join("config"));
        }
        command.env("HOME", folder.path().join("none"));
        let said = output(finding_no_compiler(&mut command)).with_status(0).out;
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        let from = if place == "one" {
            "materials.toml beside the scene"
        } else {
            "materials.toml in the user's configuration folder"
        };
        if !cfg!(target_os = "macos") {
            assert!(said.contains(&format!("Material `our steel` is that of {from}")), "{said}");
        }
        assert!(said.contains("A tensile test is a flow stress of"), "{said}");
        assert!(said.contains("our steel, 300 HV10, is a flow stress of"), "{said}");
    }
    let [one, two] = ["one", "two"].map(|place| folder.path().join(place).join("unit.fmu"));
    assert_same(&fs::read(&one).unwrap(), &fs::read(&two).unwrap());
    let inside = archive::text(&one, "resources/scene.toml");
    assert!(inside.contains("true_strain = [") && !inside.contains(".csv"), "{inside}");
    fs::write(folder.path().join("inside.toml"), inside).unwrap();
    assert_eq!(predicted(folder.path(), "inside.toml")["laws"], predicted(folder.path(), "one/scene.toml")["laws"]);
    let page = archive::text(&one, "documentation/index.html");
    assert!(page.contains("<h3>Strength</h3>") && page.contains("power law") && page.contains("<svg"), "{page}");
    for text in [page, archive::text(&one, "modelDescription.xml")] {
        assert!(!text.contains("curve.csv") && !text.contains("materials.toml"), "{text}");
    }
    run(folder.path(), ["check", "one/unit.fmu"]).with_status(0);
}

#[test]
fn a_material_of_ones_own_says_where_it_is_from_and_goes_before_the_built_in_one() {
    let text = |material: &str, more: &str| format!("{BALL}target = {{ material = \"{material}\" }}\n{more}");
    let own = "[[material]]\nname = \"mild steel\"\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 1e9\ndensity = 7850.0\n";
    let folder = folder_with(&[
        ("scene.toml", &text("mild steel", "")),
        ("inside.toml", &text("mild steel", own)),
        ("built_in.toml", &text("S355", "")),
        ("materials.toml", MATERIALS),
    ]);
    let said = |scene: &str| {
        run(folder.path(), ["predict", scene]).with_status(0).out.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let one = said("scene.toml");
    assert!(
        one.contains(
            "Material `mild steel` is that of materials.toml beside the scene, not the built-in one of this name."
        ),
        "{one}"
    );
    assert!(said("inside.toml").contains("Material `mild steel` is that of the scene, not the built-in"));
    assert!(!said("built_in.toml").contains("Material `"));
    let [beside, inside] =
        ["scene.toml", "inside.toml"].map(|scene| number(&predicted(folder.path(), scene), "restitution"));
    assert!(beside < 0.9 * inside, "280 MPa and 1 GPa: {beside} and {inside}");
    let list = run(folder.path(), ["materials", "--json"]).with_status(0).json();
    assert_eq!(
        (list[0]["name"].as_str(), list[0]["place"].as_str()),
        (Some("our steel"), Some("materials.toml beside the scene"))
    );
    assert!(list.as_array().unwrap().iter().any(|material| material["place"] == "built in"));
}

/// What holds for all contacts of a scene also holds for one of them.
#[test]
fn a_contact_has_a_hardness_a_tensile_test_or_a_material_of_its_own() {
    let strengths = [
        "hardness = \"300 HV10\"",
        "tensile_strength = \"655 MPa\"",
        "tensile_test = { proof_stress = \"240 MPa\", tensile_strength = \"480 MPa\" }",
        "power_law = { coefficient = 9e8, exponent = 0.15 }",
    ];
    for strength in strengths {
        let none = "rate = { model = \"johnson-cook\", c = 0, reference_rate = 1e-3 }\n";
        let alone = format!("{BALL}[target]\n{STEEL}{none}{strength}\n");
        let own = format!(
            "{BALL}[target]\n{STEEL}{none}yield_strength = 9e8\n[[contact]]\nname = \"a\"\ntarget = {{ {strength} }}\n[[contact]]\nname = \"b\"\n"
        );
        let folder = folder_with(&[("alone.toml", &alone), ("own.toml", &own)]);
        let value = |scene: &str, name: &str| {
            let text = run(folder.path(), ["export", scene, "--output", "unit.fmu"]).with_status(0);
            let xml = archive::text(&folder.path().join("unit.fmu"), "modelDescription.xml");
            let (_, rest) =
                xml.split_once(&format!("name=\"{name}\"")).unwrap_or_else(|| panic!("no {name}: {text:?}"));
            let (_, rest) = rest.split_once("start=\"").unwrap();
            rest.split('"').next().unwrap().parse::<f64>().unwrap()
        };
        let alone = value("alone.toml", "target.yield_strength");
        let own_value = value("own.toml", "a.target.yield_strength");
        assert!((own_value / alone - 1.0).abs() < 1e-9, "{strength}: {own_value} and {alone}");
        // that of all others stays
        assert_eq!(value("own.toml", "target.yield_strength"), 9e8, "{strength}");
    }
    let impactor = format!(
        "{BALL}[target]\n{STEEL}yield_strength = 9e8\n[[contact]]\nname = \"a\"\nimpactor = {{ material = \"mild steel\", hardness = \"150 HV10\" }}\n"
    );
    let folder = folder_with(&[("scene.toml", &impactor)]);
    let said = run(folder.path(), ["export", "scene.toml"]).with_status(0).out;
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("a: impactor: 150 HV10 is a flow stress of"), "{said}");
}

#[test]
fn a_contact_whose_own_strength_has_no_hardening_doesnt_harden_as_the_others_do() {
    let test = "tensile_test = { proof_stress = \"240 MPa\", tensile_strength = \"480 MPa\" }";
    let scene = format!(
        "{BALL}[target]\n{STEEL}{test}\n[[contact]]\nname = \"a\"\ntarget = {{ hardness = \"300 HV10\" }}\n[[contact]]\nname = \"b\"\n"
    );
    let folder = folder_with(&[("scene.toml", &scene)]);
    run(folder.path(), ["export", "scene.toml", "--output", "unit.fmu"]).with_status(0);
    let xml = archive::text(&folder.path().join("unit.fmu"), "modelDescription.xml");
    let start = |name: &str| {
        let (_, rest) = xml.split_once(&format!("name=\"{name}\"")).unwrap_or_else(|| panic!("no {name} in {xml}"));
        rest.split_once("start=\"").unwrap().1.split('"').next().unwrap().parse::<f64>().unwrap()
    };
    assert_eq!(start("a.target.hardening_modulus"), 0.0);
    assert!(start("target.hardening_modulus") > 1e9);
    run(folder.path(), ["check", "unit.fmu"]).with_status(0);
}
