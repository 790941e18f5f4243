//! Scenes with several contacts: the bodies of each contact.

use crate::command::{empty_folder, run};
use serde_json::Value;
use std::fs;

const HEAD: &str = "name = \"unit\"\n";
const IMPACT: &str = "[impact]\nmass = 4e-3\nspeed = 1.0\n";

/// The prediction of `brinell predict` for the first contact of `scene`.
#[track_caller]
fn predicted(scene: &str) -> Value {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), format!("{HEAD}{scene}\n{IMPACT}")).unwrap();
    run(folder.path(), ["predict", "scene.toml", "--json"]).with_status(0).json()
}

/// Compares the scene with `all` for all contacts and one contact with `own` with the equivalent `plain` scene.
#[track_caller]
fn same(all: &str, own: &str, plain: &str) {
    let contact = format!("{all}\n[[contact]]\nname = \"other\"\n{own}\n");
    assert_eq!(predicted(&contact), predicted(plain), "{contact}");
}

const BALL: &str = "[impactor]\nradius = 5e-3\n";

#[test]
fn a_contact_has_the_common_values_of_the_scene() {
    let scene = format!("{BALL}[target]\nmaterial = \"mild steel\"\n");
    same(&scene, "", &scene);
}

#[test]
fn a_contact_has_its_own_number_instead_of_that_of_all() {
    same(
        &format!("{BALL}[target]\nmaterial = \"mild steel\"\n"),
        "impactor = { radius = 4e-3 }\ntarget = { yield_strength = 4e8, radius = 0.1 }",
        "[impactor]\nradius = 4e-3\n[target]\nmaterial = \"mild steel\"\nyield_strength = 4e8\nradius = 0.1\n",
    );
}

/// It also overrides single numbers that the scene gives to all.
#[test]
fn a_contact_has_the_whole_of_its_own_material() {
    same(
        &format!("{BALL}[target]\nmaterial = \"mild steel\"\nyield_strength = 1e9\npoissons_ratio = 0.1\n"),
        "target = { material = \"aluminium 6061-T6\" }",
        &format!("{BALL}[target]\nmaterial = \"aluminium 6061-T6\"\n"),
    );
}

#[test]
fn a_number_of_a_contact_overrides_its_own_material() {
    let target = "material = \"aluminium 6061-T6\", yield_strength = 5e8";
    same(
        &format!("{BALL}[target]\nmaterial = \"mild steel\"\n"),
        &format!("target = {{ {target} }}"),
        &format!("{BALL}[target]\n{}\n", target.replace(", ", "\n")),
    );
}

#[test]
fn the_tables_for_all_may_be_missing_or_have_gaps_that_every_contact_fills() {
    let plain = format!("{BALL}[target]\nmaterial = \"mild steel\"\n");
    let own = "impactor = { radius = 5e-3 }\ntarget = { material = \"mild steel\" }";
    same("", own, &plain);
    same("[impactor]\n[target]\nyield_strength = 1e9\n", own, &plain);
}

#[test]
fn an_elastic_impactor_may_be_that_of_one_contact() {
    same(
        &format!("{BALL}[target]\nmaterial = \"mild steel\"\n"),
        "impactor = { youngs_modulus = 7e10, poissons_ratio = 0.2 }",
        &format!("{BALL}youngs_modulus = 7e10\npoissons_ratio = 0.2\n[target]\nmaterial = \"mild steel\"\n"),
    );
}

/// The law is common to all: without any yield strength it is Hertz's.
#[test]
fn contacts_without_yield_strength_are_elastic() {
    let target = "[target]\nyoungs_modulus = 2e11\npoissons_ratio = 0.3\n";
    same(&format!("{BALL}{target}"), "count = 2", &format!("{BALL}{target}"));
}

#[test]
fn overrides_that_change_nothing_and_names_of_parameters_twice_are_fine() {
    let scene = format!("{BALL}[target]\nmaterial = \"mild steel\"\n");
    let parameters = "[fmu]\nparameters = [\"impactor.radius\", \"other.initial_gap\", \"impactor.radius\"]\n";
    same(&format!("{scene}{parameters}"), "initial_gap = 0.0\ntarget = { surface = \"dented\" }", &scene);
}
