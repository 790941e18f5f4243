//! `brinell ssp` as a user calls it; tests/fmpy/test_ssp.py has what is in the packages.

#[path = "support/command.rs"]
mod command;

use command::{assert_same, contents, empty_folder, run, scene};
use std::fs;

#[test]
fn a_system_goes_to_the_current_folder_and_says_what_it_has() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let said = run(folder.path(), ["ssp", &scene]).with_status(0);
    assert_eq!(contents(folder.path()), ["steel_ball.ssp"]);
    for part in
        ["steel_ball.ssp", "`contact`", "inputs      indentation_rate", "outputs     force, ", "target.yield_strength"]
    {
        assert!(said.out.contains(part), "{part}: {said:#?}");
    }
    let json = run(folder.path(), ["ssp", &scene, "--json", "-o", "other.ssp"]).with_status(0).json();
    assert_eq!(json["ssp"], "other.ssp");
    assert_eq!(json["inputs"], serde_json::json!(["indentation_rate"]));
    let bytes = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_eq!(json["size"], bytes("other.ssp").len());
    assert_same(&bytes("steel_ball.ssp"), &bytes("other.ssp"));
}

#[test]
fn a_wrong_name_or_scene_is_told_and_nothing_is_written() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let said = run(folder.path(), ["ssp", &scene, "-o", "ball.zip"]).with_status(1);
    assert_eq!(said.err, "brinell: ball.zip: the name must end in .ssp\n");
    let text = fs::read_to_string(&scene).unwrap().replace("mild steel", "cheese");
    fs::write(folder.path().join("wrong.toml"), text).unwrap();
    let said = run(folder.path(), ["ssp", "wrong.toml"]).with_status(1);
    assert!(said.err.contains("wrong.toml:9:") && said.err.contains("cheese"), "{said:#?}");
    assert_eq!(contents(folder.path()), ["wrong.toml"]);
}
