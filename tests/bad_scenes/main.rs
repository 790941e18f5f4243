//! Errors in scenes: the message gives the place, the error and the allowed values, and no file changes. `scenes.txt` has them all.

mod beginners;
mod schema;

use brinell_testing::table::{self, Table};
use brinell_testing::{command, refusal};
use command::{empty_folder, run};
use std::fs;
use std::sync::LazyLock;

/// Cargo builds the program before these tests; without its feature they do not compile.
const _: &str = env!("CARGO_BIN_EXE_brinell");

/// The table of bad scenes; its head explains it.
static TABLE: LazyLock<Table> = LazyLock::new(|| Table::read("tests/bad_scenes/scenes.txt"));

/// A scene without errors, to be modified.
const SCENE: &str = "\
name = \"ball\"
[impactor]
radius = 5e-3
[target]
youngs_modulus = 206e9
poissons_ratio = 0.3
yield_strength = 300e6
";

/// What the program says of a bad scene, and the schema if it says something else.
fn said_of(text: &str, is_warning: bool) -> String {
    let said = if is_warning {
        let folder = empty_folder();
        fs::write(folder.path().join("scene.toml"), text).unwrap();
        run(folder.path(), ["predict", "scene.toml"]).err
    } else {
        refusal::message_of(text.as_bytes())
    };
    let said = said.replace("brinell: ", "").replace("scene.toml:", "");
    let other = schema::agrees(text, &said).err().map(|other| format!(" BUT {other}")).unwrap_or_default();
    said.trim_end().to_string() + &other
}

#[test]
fn every_mistake_of_the_table_is_told_with_its_place_and_these_words() {
    let good = TABLE.files();
    TABLE.check(|mistake, words| {
        let (name, first) = mistake[0].split_once(": ").expect("the name of a good scene");
        let edits: Vec<&str> = [first].iter().chain(&mistake[1..]).copied().collect();
        said_of(&table::altered(&good[name], &edits), words.starts_with("warning: "))
    });
}

#[test]
fn the_good_scenes_of_the_table_are_good() {
    let folder = empty_folder();
    for text in TABLE.files().into_values() {
        assert_eq!(schema::agrees(&text, ""), Ok(()));
        fs::write(folder.path().join("scene.toml"), &text).unwrap();
        run(folder.path(), ["predict", "scene.toml"]).with_status(0);
        run(folder.path(), ["constants", "scene.toml"]).with_status(0);
    }
}

#[test]
fn more_contacts_than_a_matrix_is_made_for_are_refused() {
    let mut text = TABLE.files()["row"].clone();
    for index in 0..255 {
        text += &format!("[[contact]]\nname = \"more_{index}\"\nbetween = [\"front\", \"rear\"]\n");
    }
    let said = said_of(&text, false);
    assert!(said.contains("there are 257 contacts") && said.contains("allowed are 256"), "{said}");
}

/// An elastic law needs none.
#[test]
fn one_contact_may_have_no_yield_strength_under_an_elastic_law() {
    let folder = empty_folder();
    let numbers = "youngs_modulus = 2e11\npoissons_ratio = 0.3";
    let text = TABLE.files()["vice"].replacen("material = \"mild steel\"", numbers, 1);
    let text = text.replacen("\"left\"", "\"left\"\ntarget = { yield_strength = 3e8 }", 1);
    fs::write(folder.path().join("scene.toml"), format!("{text}[law]\nloading = \"hertz\"\n")).unwrap();
    run(folder.path(), ["predict", "scene.toml"]).with_status(0);
}

/// Each name and each alias of one material is that material.
#[test]
fn a_material_has_other_names_and_warns_where_it_is_no_metal() {
    let folder = empty_folder();
    let predicted = |material: &str| {
        let text = SCENE.replace(
            "youngs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 300e6",
            &format!("material = \"{material}\""),
        );
        fs::write(folder.path().join("scene.toml"), text).unwrap();
        run(folder.path(), ["predict", "scene.toml", "--json"]).with_status(0)
    };
    let listed = run(folder.path(), ["materials", "--json"]).with_status(0).json();
    let listed = listed.as_array().unwrap();
    let texts = |value: &serde_json::Value| {
        value.as_array().unwrap().iter().map(|text| text.as_str().unwrap().to_string()).collect::<Vec<_>>()
    };
    let all: Vec<String> = listed.iter().flat_map(|material| texts(&material["aliases"])).collect();
    for material in listed {
        let name = material["name"].as_str().unwrap();
        let by_name = predicted(name);
        // steel and aluminium without a condition have no strength, and the scene gives none
        let is_asked = ["steel", "aluminium"].contains(&name);
        let is_silent = material["warning"].is_null() && !is_asked;
        assert_eq!(by_name.err.is_empty(), is_silent, "{name}: {}", by_name.err);
        for alias in
            texts(&material["aliases"]).iter().filter(|alias| all.iter().filter(|other| other == alias).count() == 1)
        {
            assert_eq!(predicted(alias).json()["laws"], by_name.json()["laws"], "{alias}");
        }
    }
    let said = predicted("glass").err.replace("\n         ", " ");
    assert!(said.contains("target.material = \"glass\": it is brittle and has no yield strength here"), "{said}");
}
