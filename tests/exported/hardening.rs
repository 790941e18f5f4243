//! Scenes with a target that hardens or has a Poisson's ratio other than 0.3: the contents of the FMU, and its agreement with the predictions.

use crate::command::{empty_folder, run};
use crate::written::Written;
use std::fs;
use std::path::Path;

/// A scene with these lines in its target, these laws and these settable parameters.
fn scene(target: &str, law: &str, fmu: &str) -> String {
    format!(
        "name = \"unit\"\n[impactor]\nradius = 5e-3\n[target]\nyoungs_modulus = 206e9\nyield_strength = 300e6\n{target}\n\
         [law]\n{law}\n[fmu]\n{fmu}\n[impact]\nmass = 4.11e-3\nspeed = 2.0\n"
    )
}

const BRINELL: &str = "loading = \"brinell\"";

fn write(folder: &Path, text: &str) {
    fs::write(folder.join("scene.toml"), text).unwrap();
}

/// The predictions for the scene `text`, with additional arguments.
fn predicted(text: &str, arguments: &[&str]) -> serde_json::Value {
    let folder = empty_folder();
    write(folder.path(), text);
    let all = ["predict", "scene.toml", "--json"].into_iter().chain(arguments.iter().copied());
    run(folder.path(), all).with_status(0).json()["laws"][0].clone()
}

#[test]
fn an_fmu_that_hardens_agrees_with_the_prediction() {
    let folder = empty_folder();
    let laws = [BRINELL, "loading = \"brinell\"\nunloading = \"contact-radius\""];
    let coupled = "[coupling]\neffective_mass = 4.11e-3\n";
    for (target, law, more) in [
        ("poissons_ratio = 0.3\nhardening_modulus = 4e9", laws[0], ""),
        ("poissons_ratio = 0.4\nhardening_modulus = 4e9", laws[1], ""),
        ("poissons_ratio = 0.45\nhardening_modulus = 4e9", laws[0], coupled),
        ("poissons_ratio = 0.2", laws[0], coupled),
    ] {
        let outputs = "outputs = [\"work\", \"dissipated_energy\", \"contact_radius\", \"residual_indentation\"]";
        write(folder.path(), &(scene(target, law, outputs) + more));
        run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(0);
        run(folder.path(), ["check", "unit.fmu"]).with_status(0);
    }
}

#[test]
fn only_the_law_brinell_has_the_form_for_two_bodies() {
    for (law, has) in [(BRINELL, true), ("loading = \"johnson\"", false)] {
        let rust = Written::of(&scene("poissons_ratio = 0.3", law, "parameters = [\"target.yield_strength\"]")).rust;
        assert_eq!(rust.contains("loading::Paired"), has, "{law}:\n{rust}");
    }
    let other = Written::of(&scene("poissons_ratio = 0.4", "loading = \"brinell\"\nunloading = \"thornton\"", "")).rust;
    assert!(other.contains("loading::Paired, contact::unloading::Thornton"), "{other}");
}

#[test]
fn an_fmu_whose_target_does_not_harden_has_no_such_parameter() {
    for (more, has) in [("", false), ("\nhardening_modulus = 1e9", true)] {
        let written = Written::of(&scene(&format!("poissons_ratio = 0.3{more}"), BRINELL, ""));
        assert_eq!(written.has_text("target.hardening_modulus"), has, "{}", written.rust);
    }
}

#[test]
fn a_tangent_modulus_is_equivalent_to_a_hardening_modulus() {
    // E_t = H/(1 + H/E)
    let hardening = 10e9;
    let tangent = hardening / (1.0 + hardening / 206e9);
    let one = predicted(&scene(&format!("poissons_ratio = 0.3\nhardening_modulus = {hardening:e}"), BRINELL, ""), &[]);
    let other = predicted(&scene(&format!("poissons_ratio = 0.3\ntangent_modulus = {tangent:e}"), BRINELL, ""), &[]);
    for name in ["restitution", "largest_force", "dent"] {
        let [one, other] = [&one, &other].map(|law| law[name].as_f64().unwrap());
        assert!((one / other - 1.0).abs() < 1e-12, "{name}: {one} and {other}");
    }
    // for a material, and for a contact with the modulus of the scene
    let of_material = "name = \"unit\"\nimpactor = { radius = 5e-3 }\nlaw = { loading = \"brinell\" }\n\
                       target = { material = \"mild steel\" }\n[[contact]]\nname = \"one\"\n";
    let written = Written::of(&format!("{of_material}target = {{ tangent_modulus = 2e9 }}\n"));
    let modulus = 2e9 / (1.0 - 2e9 / 206e9);
    assert!(written.has_number(modulus), "{modulus:e} in {}", written.rust);
}

#[test]
fn a_sweep_and_a_comparison_include_the_hardening() {
    let text = scene("poissons_ratio = 0.3\nhardening_modulus = 2e9", BRINELL, "");
    let alone = predicted(&text, &[])["restitution"].as_f64().unwrap();
    let named = predicted(&text, &["--laws", "brinell"])["restitution"].as_f64().unwrap();
    assert_eq!(alone, named);
    let none = predicted(&scene("poissons_ratio = 0.3", BRINELL, ""), &[])["restitution"].as_f64().unwrap();
    assert!(alone > none + 1e-3, "{alone} and {none}");
    let folder = empty_folder();
    write(folder.path(), &text);
    run(folder.path(), ["predict", "scene.toml", "--sweep", "target.hardening_modulus=0:10e9:6", "-o", "sweep.csv"])
        .with_status(0);
    let table = fs::read_to_string(folder.path().join("sweep.csv")).unwrap();
    let heads: Vec<_> = table.lines().next().unwrap().split(',').map(str::to_string).collect();
    let place = heads.iter().position(|head| head.contains("restitution")).unwrap_or_else(|| panic!("{heads:?}"));
    let restitution: Vec<f64> =
        table.lines().skip(1).map(|row| row.split(',').nth(place).unwrap().parse().unwrap()).collect();
    assert!(restitution.len() == 6 && restitution.is_sorted() && restitution[0] == none, "{restitution:?}");
}

#[test]
fn a_power_law_becomes_the_closest_line_over_the_strains_of_the_impact() {
    let folder = empty_folder();
    let text = |impact: &str| {
        format!(
            "name = \"unit\"\n[impactor]\nradius = 5e-3\n[target]\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\n\
             power_law = {{ coefficient = 700e6, exponent = 0.2 }}\n[law]\n{BRINELL}\n[impact]\n{impact}\n"
        )
    };
    let predicted = |text: &str, arguments: &[&str]| {
        write(folder.path(), text);
        let all = ["predict", "scene.toml", "--json"].into_iter().chain(arguments.iter().copied());
        run(folder.path(), all).with_status(0).json()
    };
    for speed in ["0.5", "5.0"] {
        let answer = predicted(&text(&format!("mass = 4.11e-3\nspeed = {speed}")), &[]);
        let of = |name: &str| answer["strength"]["line"][name].as_f64().unwrap();
        let (strain, strength, modulus) = (of("strain"), of("yield_strength"), of("hardening_modulus"));
        let radius = answer["laws"][0]["largest_contact_radius"].as_f64().unwrap();
        assert!((strain / (0.2 * radius / 5e-3) - 1.0).abs() < 1e-9, "{strain} and {radius}");
        // no other line is closer: the residual is orthogonal to 1 and to the strain
        let (mut constant, mut linear) = (0.0, 0.0);
        let points = 200_000;
        for point in 0..points {
            let strain = strain * (f64::from(point) + 0.5) / f64::from(points);
            let residual = 700e6 * strain.powf(0.2) - strength - modulus * strain;
            constant += residual / f64::from(points);
            linear += residual * strain / f64::from(points);
        }
        assert!(constant.abs() < 1e-5 * strength && linear.abs() < 1e-5 * strength * strain, "{constant} {linear}");
        let note = answer["notes"].to_string();
        assert!(note.contains("Tabor") && note.contains("half or twice"), "{note}");
        // an impact from the command line has its own line
        let other = predicted(&text("mass = 4.11e-3\nspeed = 1.0"), &["--speed", speed]);
        assert_eq!(other["laws"][0]["restitution"], answer["laws"][0]["restitution"]);
        run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(0);
        run(folder.path(), ["check", "unit.fmu"]).with_status(0);
    }
}
