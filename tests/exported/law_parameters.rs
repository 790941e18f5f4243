//! The constants of the laws: as data, in a scene, and in an exported FMU.

use crate::archive;
use crate::command::{empty_folder, run};
use crate::written::Written;
use brinell_contact::loading::{AnyLoading, Power};
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Body, Loading, Pair};
use brinell_testing::laws::{self, text};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The entry of each law of a kind in the file, and the names and values of the law's fields.
fn told_and_own(kind: &str) -> Vec<(toml::Table, serde_json::Map<String, Value>)> {
    let fields =
        |law: Value| law.as_object().unwrap().values().next().unwrap().as_object().cloned().unwrap_or_default();
    let own: Vec<(&str, Value)> = if kind == "loading" {
        AnyLoading::ALL.iter().map(|(name, law)| (*name, serde_json::to_value(law).unwrap())).collect()
    } else {
        AnyUnloading::ALL.iter().map(|(name, law)| (*name, serde_json::to_value(law).unwrap())).collect()
    };
    own.into_iter().map(|(name, law)| (laws::entry(kind, name).clone(), fields(law))).collect()
}

fn parameters(told: &toml::Table) -> Vec<toml::Table> {
    let all = told.get("parameters").and_then(|all| all.as_array()).cloned().unwrap_or_default();
    all.iter().map(|parameter| parameter.as_table().unwrap().clone()).collect()
}

fn number(table: &toml::Table, key: &str) -> f64 {
    table[key].as_float().unwrap_or_else(|| panic!("{key} of {table} is no number"))
}

#[test]
fn the_data_names_every_constant_of_every_law_and_no_other() {
    for kind in ["loading", "unloading"] {
        for (told, own) in told_and_own(kind) {
            let law = text(&told, "name");
            let fixed = told.get("fixed").and_then(|all| all.as_array()).cloned().unwrap_or_default();
            let fixed = fixed.iter().map(|name| name.as_str().unwrap().to_string());
            let named: Vec<String> =
                parameters(&told).iter().map(|parameter| text(parameter, "name").to_string()).chain(fixed).collect();
            let different: BTreeSet<_> = named.iter().collect();
            assert_eq!(different.len(), named.len(), "{law}: a constant is named twice");
            assert_eq!(different, own.keys().collect(), "{law}");
        }
    }
}

#[test]
fn every_reference_constant_is_a_number_within_its_limits() {
    for kind in ["loading", "unloading"] {
        for (told, own) in told_and_own(kind) {
            for parameter in parameters(&told) {
                let name = text(&parameter, "name");
                let value = own[name].as_f64().unwrap_or_else(|| panic!("{name} is a list"));
                let range = number(&parameter, "minimum")..=number(&parameter, "maximum");
                assert!(range.contains(&value), "{}: {name} = {value}", text(&told, "name"));
                assert!(!text(&parameter, "description").is_empty(), "{name}");
                if let Some(below) = parameter.get("below") {
                    assert!(value < own[below.as_str().unwrap()].as_f64().unwrap(), "{name}");
                }
            }
        }
    }
}

#[test]
fn every_loading_law_states_its_validity() {
    for (told, _) in told_and_own("loading") {
        assert!(text(&told, "validity").len() > 20, "{}", text(&told, "name"));
    }
}

/// A scene of a steel target with these lines under `[law]`.
fn scene(law: &str) -> String {
    format!(
        "name = \"unit\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n[law]\n{law}\n\
         [impact]\nmass = 4.11e-3\nspeed = 0.5\n"
    )
}

#[test]
fn every_law_takes_its_own_constants() {
    let folder = empty_folder();
    let constants = |law: &str| {
        fs::write(folder.path().join("scene.toml"), scene(law)).unwrap();
        run(folder.path(), ["constants", "scene.toml"]).with_status(0).out
    };
    let given = |told: &toml::Table, own: &serde_json::Map<String, Value>| {
        let all = parameters(told);
        let all = all.iter().map(|parameter| text(parameter, "name"));
        all.map(|name| format!("{name} = {:?}", own[name].as_f64().unwrap())).collect::<Vec<_>>().join(", ")
    };
    // those of a line follow from the scene, a table of one's own has none
    let of_ball = |(told, _): &(toml::Table, _)| !["line", "table"].contains(&text(told, "name"));
    for (told, own) in told_and_own("loading").into_iter().filter(of_ball) {
        let law = format!("loading = \"{}\"", text(&told, "name"));
        // an empty table causes the check of the whole law on the bodies of the scene
        let all = format!("{law}\nloading_parameters = {{ {} }}", given(&told, &own));
        assert_eq!(constants(&all), constants(&law));
    }
    let home = [("etsion", "kogut-etsion"), ("jackson", "jackson-green")];
    for (told, own) in told_and_own("unloading").into_iter().filter(of_ball) {
        let name = text(&told, "name");
        let same = ["walton-braun", "luding", "vu-quoc-zhang"].contains(&name).then_some(name);
        let loading = home.iter().find(|(unloading, _)| *unloading == name).map(|(_, loading)| *loading).or(same);
        let law = format!("loading = \"{}\"\nunloading = \"{name}\"", loading.unwrap_or("big-alabo"));
        let all = format!("{law}\nunloading_parameters = {{ {} }}", given(&told, &own));
        assert_eq!(constants(&all), constants(&law));
    }
}

/// The fits of Jackson and Green and of Kogut and Etsion jump down where they meet Hertz's law or the plastic line.
#[test]
fn where_a_published_law_falls_its_constants_can_still_be_given() {
    let folder = empty_folder();
    let predict = |law: &str, given: &str| {
        let law = format!("loading = \"{law}\"\nloading_parameters = {{ {given} }}");
        let text = scene(&law).replace("[law]", "poissons_ratio = 0.5\n[law]");
        fs::write(folder.path().join("scene.toml"), text).unwrap();
        run(folder.path(), ["constants", "scene.toml"])
    };
    predict("kogut-etsion", "first_area_factor = 0.95").with_status(0);
    predict("jackson-green", "area_exponent = 0.15").with_status(0);
    predict("ghaednia", "hardening = 0.03").with_status(0);
    // but they may not fall farther
    let refused = predict("kogut-etsion", "second_factor = 1.5").with_status(1);
    assert!(refused.err.contains("the loading force falls"), "{refused:#?}");
}

#[test]
fn a_scenes_constants_are_those_of_its_fmu_and_the_fmu_agrees_with_the_prediction() {
    let folder = empty_folder();
    let law = "loading = \"power\"\nloading_parameters = { exponent = 1.15, coefficient = 2 }";
    fs::write(folder.path().join("scene.toml"), scene(law)).unwrap();
    let written = Written::of(&scene(law));
    assert!(written.rust.contains("contact::loading::Power"), "{}", written.rust);
    for constant in [1.6, 2.0, 1.15] {
        assert!(written.has_number(constant), "no {constant} in {}", written.rust);
    }
    run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(0);
    let checked = run(folder.path(), ["check", "unit.fmu", "--json"]).with_status(0).json();
    let row = |quantity: &str| {
        let rows = checked["rows"].as_array().unwrap();
        rows.iter().find(|row| row["quantity"] == quantity).unwrap()["simulated"].as_f64().unwrap()
    };
    // the result of the binary, compared with the law with these constants at the indentation that it reached
    let sphere = Body { radius: 5e-3, youngs_modulus: f64::INFINITY, poissons_ratio: 0.3 };
    let steel = Body { radius: f64::INFINITY, youngs_modulus: 206e9, poissons_ratio: 0.3 };
    let pair = Pair::new(&sphere, &steel, 300e6).unwrap();
    let power = Power { exponent: 1.15, coefficient: 2.0, ..Power::REFERENCE };
    let depth = row("largest indentation");
    let force = power.segment(&pair, depth).force(depth);
    assert!((row("largest force") / force - 1.0).abs() < 1e-6, "{checked}");
    let reference = Power::REFERENCE.segment(&pair, depth).force(depth);
    assert!((force / reference - 1.0).abs() > 0.02, "the constants make a difference");
}

/// The documentation of the FMU of a scene with these lines under `[law]`.
fn page(law: &str) -> String {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), scene(law)).unwrap();
    run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(0);
    archive::text(&folder.path().join("unit.fmu"), "documentation/index.html")
}

#[test]
fn the_formulas_on_the_page_of_an_fmu_contain_its_constants_and_derived_numbers() {
    let law = "loading = \"big-alabo\"\nloading_parameters = { second_region = 10.0, fully_plastic = 50.0, plastic_slope = 4.0 }";
    // computed by hand: k_l = 1.5 sqrt(9) = 4.5, f_tep = 9^1.5 + 1 = 28, f_p = 4.5 * 40 + 28 = 208
    let page = page(law);
    for formula in ["10 &lt;= x &lt; 50: f = 4.5 (x - 10) + 28<", "50 &lt;= x: f = 4 (x - 50) + 208<"] {
        assert!(page.contains(formula), "nothing of {formula} in {page}");
    }
    assert!(page.contains("describes those of the reference"), "{page}");
}

#[test]
fn the_texts_of_every_law_have_numbers_in_place_of_names() {
    let folder = empty_folder();
    let list = run(folder.path(), ["laws", "--json"]).with_status(0).json();
    let laws = ["loading", "unloading", "damped"].iter().flat_map(|kind| list[kind].as_array().unwrap());
    let mut formulas = 0;
    for law in laws {
        let texts = law["formulas"].as_array().unwrap().iter().chain([&law["notes"], &law["validity"]]);
        for text in texts.filter_map(|text| text.as_str()) {
            assert!(!text.contains(['{', '}']), "{text}");
            formulas += 1;
        }
    }
    assert!(formulas > 100, "{formulas}");
    let of = |name: &str| {
        let law = list["loading"].as_array().unwrap().iter().find(|law| law["name"] == name).unwrap();
        law["formulas"].as_array().unwrap().last().unwrap().as_str().unwrap().to_string()
    };
    assert_eq!(of("big-alabo"), "fully plastic, 82.5 <= x: f = 5.0909 (x - 82.5) + 417.34");
    assert_eq!(of("zhao-maietta-chang"), "fully plastic, 54 <= x: f = 2 (2.8/1.1) x, a^2 = 2 R d");
}

#[test]
fn the_page_of_an_fmu_has_its_constants() {
    let law = "loading = \"johnson\"\nloading_parameters = { plastic_pressure_factor = 3.0 }\nunloading = \"walton-braun\"\n\
               unloading_parameters = { stiffness_ratio = 6.25 }";
    let page = page(law);
    for (name, value) in
        [("yield_pressure_factor", "1.1"), ("plastic_pressure_factor", "3"), ("stiffness_ratio", "6.25")]
    {
        let row = format!("<code>{name}</code></td><td class=\"n\">{value}</td>");
        assert!(page.contains(&row), "nothing of {row} in {page}");
    }
}

/// Restitution of the scene's impact with each of the `laws`.
fn restitution(folder: &Path, laws: &str) -> Vec<f64> {
    let predicted = run(folder, ["predict", "scene.toml", "--json", "--laws", laws]).with_status(0).json();
    predicted["laws"].as_array().unwrap().iter().map(|law| law["restitution"].as_f64().unwrap()).collect()
}

#[test]
fn the_scenes_own_law_is_compared_with_its_constants_and_others_with_those_of_the_reference() {
    let folder = empty_folder();
    let law = "loading = \"walton-braun\"\nunloading_parameters = { stiffness_ratio = 25.0 }";
    fs::write(folder.path().join("scene.toml"), scene(law)).unwrap();
    let found = restitution(folder.path(), "walton-braun,walton-braun/walton-braun,big-alabo/walton-braun,luding");
    // sqrt(1/25)
    assert!(found[..2].iter().all(|restitution| (restitution - 0.2).abs() < 1e-14), "{found:?}");
    let reference = scene("loading = \"big-alabo\"");
    fs::write(folder.path().join("scene.toml"), reference).unwrap();
    let usual = restitution(folder.path(), "walton-braun,big-alabo/walton-braun,luding");
    assert!((usual[0] - 0.5).abs() < 1e-14, "{usual:?}");
    // the unloading law is the scene's, the loading law has the reference constants
    assert!((found[2] / usual[1] - 0.4).abs() < 1e-12, "{found:?} {usual:?}");
    assert_eq!(found[3], usual[2]);
    let curve = |law: &str| {
        fs::write(folder.path().join("scene.toml"), scene(law)).unwrap();
        run(folder.path(), ["curve", "scene.toml", "--laws", "power", "--to", "1e-5", "--json"]).with_status(0).out
    };
    let own = curve("loading = \"power\"\nloading_parameters = { exponent = 1.15 }");
    assert_ne!(own, curve("loading = \"power\""));
    assert_eq!(curve("loading = \"stronge\""), curve("loading = \"power\""));
}
