//! People's own data: tensile tests in files, tables of materials, strengths of single contacts. What is exported has the numbers, and
//! no file.

use crate::archive;
use crate::command::{assert_same, brinell, output};
use crate::prebuilt::finding_no_compiler;
use brinell_testing::folder::{Folder, number, words};
use std::fs;

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

/// The restitution of a scene in `folder`.
fn restitution(folder: &Folder, scene: &str) -> f64 {
    number(&folder.json(&format!("predict {scene}")), "laws/0/restitution")
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
        Folder::with(&[("a/scene.toml", &by_file), ("a/tests/curve 7.csv", &curve()), ("points.toml", &by_points)]);
    let [file, points] = ["a/scene.toml", "points.toml"].map(|scene| folder.json(&format!("predict {scene}")));
    for key in ["restitution", "largest_force", "dent"] {
        let error = number(&file["laws"][0], key) / number(&points["laws"][0], key) - 1.0;
        assert!(error.abs() < 3e-3, "{key}: {error}");
    }
    let said = folder.words("predict a/scene.toml");
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
    let folder = Folder::with(&[
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
    let told = |scene: &str| words(&folder.call(&format!("predict {scene}")).with_status(0).err);
    for scene in ["right.toml", "most.toml", "off.toml", "raw.toml"] {
        assert_eq!(told(scene), "", "{scene}");
    }
    let warning = "target.tensile_test: the curve begins with a slope of 105 GPa, 0.5 of youngs_modulus = 210 GPa; a strain by the crosshead \
                   contains the machine: give that of an extensometer, take the record's own slope off with compliance_correction = true";
    assert!(told("soft.toml").contains(warning), "{}", told("soft.toml"));
    let expected = restitution(&folder, "right.toml");
    for (scene, tolerance) in [("off.toml", 1e-3), ("raw.toml", 1e-9)] {
        let error = restitution(&folder, scene) / expected - 1.0;
        assert!(error.abs() < tolerance, "{scene}: {error}");
    }
    assert!(restitution(&folder, "soft.toml") < 0.995 * expected, "the crosshead makes it softer");
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
    let folder = Folder::with(&[
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
        let said = words(&output(finding_no_compiler(&mut command)).with_status(0).out);
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
    let [one, two] = ["one/unit.fmu", "two/unit.fmu"].map(|name| folder.at(name));
    assert_same(&fs::read(&one).unwrap(), &fs::read(&two).unwrap());
    let inside = archive::text(&one, "resources/scene.toml");
    assert!(inside.contains("true_strain = [") && !inside.contains(".csv"), "{inside}");
    folder.write("inside.toml", &inside);
    assert_eq!(folder.json("predict inside.toml")["laws"], folder.json("predict one/scene.toml")["laws"]);
    let page = archive::text(&one, "documentation/index.html");
    assert!(page.contains("<h3>Strength</h3>") && page.contains("power law") && page.contains("<svg"), "{page}");
    for text in [page, archive::text(&one, "modelDescription.xml")] {
        assert!(!text.contains("curve.csv") && !text.contains("materials.toml"), "{text}");
    }
    folder.call("check one/unit.fmu").with_status(0);
}

/// The start value of a variable in the FMU of a scene.
fn start(folder: &Folder, scene: &str, name: &str) -> f64 {
    folder.call(&format!("export {scene} --output unit.fmu")).with_status(0);
    let xml = archive::text(&folder.at("unit.fmu"), "modelDescription.xml");
    let (_, rest) = xml.split_once(&format!("name=\"{name}\"")).unwrap_or_else(|| panic!("no {name} in {xml}"));
    rest.split_once("start=\"").unwrap().1.split('"').next().unwrap().parse().unwrap()
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
        let folder = Folder::with(&[("alone.toml", &alone), ("own.toml", &own)]);
        let alone = start(&folder, "alone.toml", "target.yield_strength");
        let own_value = start(&folder, "own.toml", "a.target.yield_strength");
        assert!((own_value / alone - 1.0).abs() < 1e-9, "{strength}: {own_value} and {alone}");
        // that of all others stays
        assert_eq!(start(&folder, "own.toml", "target.yield_strength"), 9e8, "{strength}");
    }
    let impactor = format!(
        "{BALL}[target]\n{STEEL}yield_strength = 9e8\n[[contact]]\nname = \"a\"\nimpactor = {{ material = \"mild steel\", hardness = \"150 HV10\" }}\n"
    );
    let folder = Folder::of(&impactor);
    let said = folder.words("export scene.toml");
    assert!(said.contains("a: impactor: 150 HV10 is a flow stress of"), "{said}");
}

#[test]
fn a_contact_whose_own_strength_has_no_hardening_doesnt_harden_as_the_others_do() {
    let test = "tensile_test = { proof_stress = \"240 MPa\", tensile_strength = \"480 MPa\" }";
    let scene = format!(
        "{BALL}[target]\n{STEEL}{test}\n[[contact]]\nname = \"a\"\ntarget = {{ hardness = \"300 HV10\" }}\n[[contact]]\nname = \"b\"\n"
    );
    let folder = Folder::of(&scene);
    assert_eq!(start(&folder, "scene.toml", "a.target.hardening_modulus"), 0.0);
    assert!(start(&folder, "scene.toml", "target.hardening_modulus") > 1e9);
    folder.call("check unit.fmu").with_status(0);
}
