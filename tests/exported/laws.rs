//! What an FMU says of its law: its constants, its formulas, and whether it may gain energy.

use crate::archive;
use crate::command::{empty_folder, run};
use crate::written::Written;
use std::fs;

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
    let list = run(folder.path(), ["laws", "--json"]).with_status(0).json();
    let constants = |law: &str| {
        fs::write(folder.path().join("scene.toml"), scene(law)).unwrap();
        run(folder.path(), ["constants", "scene.toml"]).with_status(0).out
    };
    // those that belong to one loading law
    let home = [("etsion", "kogut-etsion"), ("jackson", "jackson-green")];
    let same = ["walton-braun", "luding", "vu-quoc-zhang"].map(|name| (name, name));
    for kind in ["loading", "unloading"] {
        for law in list[kind].as_array().unwrap() {
            let (name, parameters) = (law["name"].as_str().unwrap(), law["parameters"].as_array().unwrap());
            // those of a line follow from the scene, a table of one's own has none
            if ["line", "table"].contains(&name) {
                continue;
            }
            let given = parameters.iter().map(|constant| {
                format!("{} = {:?}", constant["name"].as_str().unwrap(), constant["value"].as_f64().unwrap())
            });
            let given = given.collect::<Vec<_>>().join(", ");
            let found = home.iter().chain(&same).find(|(unloading, _)| *unloading == name);
            let law = match kind {
                "loading" => format!("loading = \"{name}\""),
                _ => format!("loading = \"{}\"\nunloading = \"{name}\"", found.map_or("big-alabo", |home| home.1)),
            };
            // an empty table causes the check of the whole law on the bodies of the scene
            assert_eq!(constants(&format!("{law}\n{kind}_parameters = {{ {given} }}")), constants(&law));
        }
    }
}

/// What a compiled library of a scene has of the laws, and what it hasn't.
#[test]
fn a_compiled_library_has_the_laws_and_constants_of_its_scene_alone() {
    let plain = |law: &str| scene(law);
    let roller = "name = \"unit\"\nimpactor = { shape = \"cylinder\", radius = 0.01, length = 0.02 }\ntarget = { material = \"mild steel\", thickness = 0.04 }\n\
                  impact = { mass = 0.05, speed = 0.5 }\n";
    let table = "loading = { table = { depth = [1e-6, 2e-6, 3e-6, 4e-6, 5e-6, 6e-6, 7e-6, 8e-6], \
                 force = [14.94, 42.25, 77.62, 119.5, 167.0, 219.5, 276.7, 338.0] } }";
    for (text, has, has_not) in [
        (plain("loading = \"brinell\""), "loading::Paired", "Power"),
        (
            plain("loading = \"brinell\"\nunloading = \"thornton\""),
            "loading::Paired, contact::unloading::Thornton",
            "Power",
        ),
        (plain("loading = \"johnson\""), "loading::Johnson", "Paired"),
        (plain("loading = \"power\"\nloading_parameters = { exponent = 1.15 }"), "contact::loading::Power", "Paired"),
        (roller.into(), "contact::loading::Line, contact::unloading::Line", "Paired"),
        (
            plain(table).replace("material = \"mild steel\"", "youngs_modulus = 206e9\npoissons_ratio = 0.3"),
            "contact::loading::Tabulated, contact::unloading::Tabulated",
            "Paired",
        ),
    ] {
        let written = Written::of(&text);
        assert!(written.rust.contains(has) && !written.rust.contains(has_not), "{has}: {}", written.rust);
        assert_eq!(written.has_number(1.15), text.contains("1.15"), "{}", written.rust);
    }
    for (more, hardens) in [("", false), ("\nhardening_modulus = 1e9", true)] {
        let text = plain("loading = \"brinell\"").replace("steel\"", &format!("steel\"{more}"));
        assert_eq!(Written::of(&text).has_text("target.hardening_modulus"), hardens);
    }
    // the strength of a material is a parameter only if it is below that of the target
    for (impactor, is_parameter) in [
        ("material = \"aluminium 6061-T6\"", true),
        ("material = \"titanium Ti-6Al-4V\"", false),
        ("material = \"titanium Ti-6Al-4V\"\nyield_strength = 880e6", true),
        ("", false),
    ] {
        let text = plain("loading = \"big-alabo\"").replace("5e-3\n", &format!("5e-3\n{impactor}\n"));
        assert_eq!(Written::of(&text).has_text("impactor.yield_strength"), is_parameter, "{impactor}");
    }
}

/// The documentation of the FMU of a scene with these lines under `[law]`, and these parameters.
fn page(law: &str, parameters: &str) -> String {
    let folder = empty_folder();
    let text = scene(law).replace("[impact]", &format!("[fmu]\nparameters = {parameters}\n[impact]"));
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(0);
    archive::text(&folder.path().join("unit.fmu"), "documentation/index.html")
}

#[test]
fn the_page_of_an_fmu_has_its_constants_and_its_formulas_contain_them() {
    let law = "loading = \"big-alabo\"\nloading_parameters = { second_region = 10.0, fully_plastic = 50.0, plastic_slope = 4.0 }";
    // computed by hand: k_l = 1.5 sqrt(9) = 4.5, f_tep = 9^1.5 + 1 = 28, f_p = 4.5 * 40 + 28 = 208
    let formulas = [
        "10 &lt;= x &lt; 50: f = 4.5 (x - 10) + 28<",
        "50 &lt;= x: f = 4 (x - 50) + 208<",
        "describes those of the reference",
    ];
    let other = "loading = \"johnson\"\nloading_parameters = { plastic_pressure_factor = 3.0 }\nunloading = \"walton-braun\"\n\
                 unloading_parameters = { stiffness_ratio = 6.25 }";
    let row = |name: &str, value: &str| format!("<code>{name}</code></td><td class=\"n\">{value}</td>");
    let rows =
        [row("yield_pressure_factor", "1.1"), row("plastic_pressure_factor", "3"), row("stiffness_ratio", "6.25")];
    for (law, parts) in [(law, formulas), (other, rows.each_ref().map(String::as_str))] {
        let page = page(law, "[]");
        for part in parts {
            assert!(page.contains(part), "nothing of {part} in {page}");
        }
    }
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
fn an_fmu_states_whether_its_law_may_gain_energy_for_any_value_of_its_parameters() {
    let none = "make no energy: dissipated energy never falls";
    // law, settable parameters, statement
    let cases = [
        ("loading = \"big-alabo\"", "[]", none),
        ("loading = \"stronge\"", "[]", "may make energy: dissipated energy may fall"),
        ("loading = \"stronge\"", "[]", "The largest is 1.154 (1.154 below"),
        ("loading = \"stronge\"\nunloading = \"walton-braun\"", "[]", none),
        (
            "loading = \"stronge\"\npassivity_guard = true",
            "[]",
            "With the guard, no contact returns more energy than it took",
        ),
        // steel has 0.3; an FMU whose Poisson's ratio can be set is different
        ("loading = \"jackson-green\"\nunloading = \"jackson\"", "[\"target.yield_strength\"]", none),
        (
            "loading = \"jackson-green\"\nunloading = \"jackson\"",
            "[\"target.poissons_ratio\"]",
            "may make energy below a Poisson's ratio of 0.02",
        ),
        // with the scene's own constants
        ("loading = \"big-alabo\"\nloading_parameters = { fully_plastic = 80.0 }", "[]", none),
        ("loading = \"power\"\nloading_parameters = { coefficient = 2.5 }", "[]", "may make energy"),
        (
            "loading = \"jackson-green\"\nloading_parameters = { hardness_factor = 2.9 }\nunloading = \"contact-radius\"",
            "[\"impactor.radius\"]",
            "may make energy",
        ),
    ];
    for (law, parameters, words) in cases {
        let page = page(law, parameters);
        let said = page.split("<p>").find(|paragraph| paragraph.contains("issipated energy")).expect("a paragraph");
        let said = said.split("</p>").next().unwrap();
        assert!(said.contains(words), "{law} with {parameters}: {said}");
    }
}
