//! What a prediction says, by features of scenes: strengths at the rate and strain of the impact, rollers, ellipses, the range of validity, the
//! guard, and what explains a rebound. That the FMU does the same:
//! `tests/exported/any_scene.rs`.

use crate::archive;
use crate::command::{empty_folder, run};
use brinell_testing::long::some;
use brinell_testing::written::Written;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// A scene of 5 mm on steel with these lines of the target and the law, and this impact.
fn scene(target: &str, law: &str, impact: &str) -> String {
    format!(
        "name = \"unit\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n{target}\n[law]\n{law}\n[impact]\n{impact}\n"
    )
}

const IMPACT: &str = "mass = 4.11e-3\nspeed = 1.0";

/// The answer of `predict` in `folder` for the scene `text`.
fn predicted_in(folder: &Path, text: &str, arguments: &[&str]) -> Value {
    fs::write(folder.join("scene.toml"), text).unwrap();
    let all = ["predict", "scene.toml", "--json"].into_iter().chain(arguments.iter().copied());
    run(folder, all).with_status(0).json()
}

fn predicted(text: &str, arguments: &[&str]) -> Value {
    predicted_in(empty_folder().path(), text, arguments)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn the_strength_follows_from_the_mean_strain_rate_of_the_impact() {
    let johnson_cook = |rate: f64| 1.0 + 0.014 * rate.ln();
    let cowper_symonds = |rate: f64| 1.0 + (rate / 40.4).powf(0.2);
    let models: [(&str, &dyn Fn(f64) -> f64); 2] = [
        ("rate = { model = \"johnson-cook\", c = 0.014, reference_rate = 1.0 }", &johnson_cook),
        ("rate = { model = \"cowper-symonds\", d = 40.4, q = 5 }", &cowper_symonds),
    ];
    for (model, factor) in models {
        for (law, speed) in [("brinell", "0.2"), ("big-alabo", "1.0"), ("johnson", "20.0"), ("jackson-green", "1.0")] {
            let answer = predicted(&scene(model, &format!("loading = {law:?}"), IMPACT), &["--speed", speed]);
            let (strength, impact) = (&answer["strength"], &answer["laws"][0]);
            let rate = 0.2 * number(&impact["largest_contact_radius"]) / 5e-3 / number(&impact["loading_time"]);
            for (name, expected) in
                [("strain_rate", rate), ("factor", factor(rate)), ("yield_strength", 300e6 * factor(rate))]
            {
                assert!((number(&strength[name]) / expected - 1.0).abs() < 1e-8, "{law} at {speed}, {name}: {answer}");
            }
            assert!(answer["notes"].to_string().contains("strain rate of this impact"), "{answer}");
        }
    }
}

#[test]
fn a_power_law_becomes_the_closest_line_over_the_strains_of_the_impact() {
    let steel = "youngs_modulus = 206e9\npoissons_ratio = 0.3\npower_law = { coefficient = 700e6, exponent = 0.2 }";
    let text = scene(steel, "loading = \"brinell\"", IMPACT).replace("material = \"mild steel\"\n", "");
    for speed in ["0.5", "5.0"] {
        let answer = predicted(&text, &["--speed", speed]);
        let of = |name: &str| number(&answer["strength"]["line"][name]);
        let (strain, strength, modulus) = (of("strain"), of("yield_strength"), of("hardening_modulus"));
        let radius = number(&answer["laws"][0]["largest_contact_radius"]);
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
    }
}

#[test]
fn contacts_with_other_bodies_have_their_own_factor_of_the_rate() {
    let contacts = "[[contact]]\nname = \"small\"\nimpactor = { radius = 1e-3 }\ntarget = { yield_strength = 300e6 }\n\
                    [[contact]]\nname = \"large\"\ntarget = { yield_strength = 300e6 }\n";
    let rate = "rate = { model = \"cowper-symonds\", d = 40.4, q = 5 }";
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), scene(rate, "loading = \"brinell\"", IMPACT) + contacts).unwrap();
    let exported = run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu", "--json"]).with_status(0).json();
    let strength = |index: usize| number(&exported["contacts"][index]["own"]["target.yield_strength"]);
    assert!(strength(0) > 1.05 * strength(1) && strength(1) > 2.0 * 300e6, "{exported}");
}

const ROLLER: &str =
    "name = \"unit\"\nimpactor = { shape = \"cylinder\", radius = 0.01, length = 0.02, density = 7810.0 }\n";
const PLATE: &str = "target = { youngs_modulus = 206e9, poissons_ratio = 0.3, yield_strength = 300e6, thickness = 0.04";

#[test]
fn a_roller_is_solid_and_the_constant_of_a_plate_is_that_of_its_layer() {
    let half_width = 2.0 * 0.01 * 1.7937 * 300e6 / (206e9 / 0.91);
    for (base, k) in [("smooth", 0.2966), ("bonded", -0.053)] {
        let answer = predicted(&format!("{ROLLER}{PLATE}, base = \"{base}\" }}\nimpact = {{ speed = 0.5 }}\n"), &[]);
        let notes = answer["notes"].to_string();
        let found =
            notes.split("C = ").nth(1).and_then(|rest| rest.split(' ').next()).unwrap_or_else(|| panic!("{notes}"));
        let expected = 2.0 * f64::ln(0.08 / half_width) + k;
        assert!((found.parse::<f64>().unwrap() / expected - 1.0).abs() < 1e-3, "{base}: {found}, not {expected}");
        let mass = number(&answer["mass"]);
        assert!((mass / (7810.0 * std::f64::consts::PI * 1e-4 * 0.02) - 1.0).abs() < 1e-12, "{mass}");
    }
}

#[test]
fn commands_of_balls_say_so() {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), format!("{ROLLER}{PLATE} }}\nimpact = {{ speed = 0.5 }}\n")).unwrap();
    for (arguments, words) in [
        (vec!["hardness", "scene.toml", "--load", "1kN"], "the scene a cylinder"),
        (vec!["translate", "scene.toml", "--for", "mujoco"], "the scene has a cylinder"),
        (vec!["predict", "scene.toml", "--laws", "brinell"], "is a law of balls"),
        (vec!["predict", "scene.toml", "--sweep", "impactor.radius=0.01:0.02:3"], "the constant C"),
    ] {
        let said = run(folder.path(), arguments.iter().copied());
        assert!(said.err.contains(words), "{arguments:?}: {}", said.err);
    }
    run(folder.path(), ["predict", "scene.toml", "--laws", "all"]).with_status(0);
    run(folder.path(), ["curve", "scene.toml", "-o", "curve.csv"]).with_status(0);
}

#[test]
fn half_axes_are_said_along_x_and_y_with_the_radii_of_the_scene() {
    let text = |radius: &str| scene("", "", IMPACT).replace("radius = 5e-3", &format!("radius = {radius}"));
    let [one, other] = ["[40e-3, 5e-3]", "[5e-3, 40e-3]"]
        .map(|radius| predicted(&text(radius), &[])["laws"][0]["largest_half_axes"].clone());
    assert_eq!((&one[0], &one[1]), (&other[1], &other[0]));
    assert!(one[0].as_f64() > one[1].as_f64(), "{one}");
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), text("[40e-3, 5e-3]")).unwrap();
    let said = run(folder.path(), ["predict", "scene.toml"]).with_status(0).out;
    assert!(said.contains("largest half-axes") && said.contains(" along x, ") && !said.contains("a/R"), "{said}");
}

#[test]
fn predict_warns_of_an_impact_beyond_the_validity_and_of_no_other() {
    let plain = scene("", "", IMPACT);
    let warnings = |scene: &str, speed: &str| {
        let folder = empty_folder();
        let list = predicted_in(folder.path(), scene, &["--speed", speed])["laws"][0]["warnings"].clone();
        let list = list.as_array().unwrap().clone();
        let text = run(folder.path(), ["predict", "scene.toml", "--speed", speed]).with_status(0).out;
        assert_eq!(text.lines().filter(|line| line.starts_with("warning: ")).count(), list.len(), "{text}");
        list.iter().map(|warning| warning.as_str().unwrap().to_string()).collect::<Vec<_>>()
    };
    assert!(warnings(&plain, "1").is_empty());
    let wide = warnings(&plain, "40");
    assert!(wide.len() == 1 && wide[0].contains("effective radii; above 0.3 "), "{wide:?}");
    let both = warnings(&plain, "60");
    assert!(both.len() == 2 && both[1].contains("of the wave speed of 5123 m/s; above 0.01 "), "{both:?}");
    let numbers = "youngs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 300e6";
    let unknown = warnings(&plain.replace("material = \"mild steel\"", numbers), "60");
    assert_eq!(unknown.len(), 1, "nothing is known of waves: {unknown:?}");
    let light = warnings(&plain.replace("material", "density = 1e-3\nmaterial"), "60");
    assert_eq!(light.len(), 1, "a number stands before a material's: {light:?}");
}

#[test]
fn the_density_is_a_constant_of_the_fmu_and_not_a_variable() {
    let plain = scene("", "", IMPACT);
    let steel = Written::of(&plain);
    assert!(steel.has_number(7850.0) && !steel.has_text("density"), "{}", steel.rust);
    let contacts = "[[contact]]\nname = \"a\"\n[[contact]]\nname = \"b\"\ntarget = { density = 2e3 }\n";
    let several = Written::of(&format!("{plain}{contacts}"));
    assert!(several.has_number(7850.0) && several.has_number(2e3), "{}", several.rust);
    let unknown =
        Written::of(&plain.replace("material = \"mild steel\"", "youngs_modulus = 1e9\npoissons_ratio = 0.3"));
    assert!(!unknown.has_number(7850.0), "{}", unknown.rust);
}

#[test]
fn export_and_its_page_say_what_predict_says() {
    let folder = empty_folder();
    let text = scene("", "loading = \"big-alabo\"", "mass = 4.11e-3\nspeed = 60.0");
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    let exported = run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu", "--json"]).with_status(0).json();
    let warnings = exported["warnings"].as_array().unwrap();
    assert_eq!(warnings.len(), 2, "{exported}");
    let said = run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(0).out;
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    let page = archive::text(&folder.path().join("unit.fmu"), "documentation/index.html");
    for warning in warnings {
        let warning = warning.as_str().unwrap();
        assert!(said.contains(&format!("warning {warning}")), "{said}");
        assert!(page.contains(&format!("<strong>Beyond the validity of the law:</strong> {warning}.")), "{warning}");
    }
    assert!(page.contains("here an indentation of 225 \u{b5}m") && page.contains("here 51.23 m/s"));
}

/// The guard acts on each of two contacts of a scene with these laws.
#[test]
fn a_guarded_fmu_states_where_the_guard_acts_and_one_without_has_no_word_of_it() {
    let folder = empty_folder();
    let contacts = "[[contact]]\nname = \"soft\"\n[[contact]]\nname = \"hard\"\ntarget = { yield_strength = 3e9 }\n";
    // one with a range from first yield on, one whose range begins later
    for loading in ["stronge", "ghaednia"] {
        let law = format!("loading = \"{loading}\"\nunloading = \"thornton\"\npassivity_guard = true");
        for guard in [true, false] {
            let law = law.replace("true", &guard.to_string());
            fs::write(folder.path().join("scene.toml"), scene("", &law, IMPACT) + contacts).unwrap();
            let call = ["export", "scene.toml", "-o", "unit.fmu", "--json"];
            let exported = run(folder.path(), call).with_status(0).json();
            let said = run(folder.path(), &call[..4]).with_status(0).out;
            let page = archive::text(&folder.path().join("unit.fmu"), "documentation/index.html");
            let constants = run(folder.path(), ["constants", "scene.toml"]).with_status(0).out;
            if !guard {
                assert!(exported["passivity_guard"].is_null() && !page.contains("Passivity guard"), "{exported}");
                assert!(!constants.to_lowercase().contains("guard"));
                continue;
            }
            let ranges = |value: &Value| -> Vec<(f64, f64)> {
                serde_json::from_value(value["passivity_guard"].clone()).unwrap()
            };
            let (all, own) = (ranges(&exported), [&exported["contacts"][0], &exported["contacts"][1]].map(ranges));
            for (from, to) in own.concat() {
                assert!(all.iter().any(|range| range.0 <= from && to <= range.1), "{from} to {to} is not in {all:?}");
            }
            assert!(all.is_sorted() && all.windows(2).all(|pair| pair[0].1 < pair[1].0), "{all:?}");
            let words = format!("from {:.4} to {:.4}", all[0].0, all[0].1);
            assert!(said.contains("guard      acts at largest indentations") && said.contains(&words), "{said}");
            assert!(page.contains("Passivity guard") && page.contains(&words), "{loading}");
        }
    }
}

#[test]
fn the_stated_range_of_the_guard_ends_where_energy_begins_to_be_lost() {
    let folder = empty_folder();
    let text = scene(
        "",
        "loading = \"stronge\"\nunloading = \"thornton\"\npassivity_guard = true",
        "mass = 4.11e-3\nspeed = 0.0025",
    );
    assert!((number(&predicted_in(folder.path(), &text, &[])["laws"][0]["restitution"]) - 1.0).abs() < 1e-13);
    let unguarded = text.replace("passivity_guard = true", "");
    assert!(number(&predicted(&unguarded, &[])["laws"][0]["restitution"]) > 1.05);
    let exported = run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu", "--json"]).with_status(0).json();
    let ranges = exported["passivity_guard"].as_array().unwrap();
    let [from, to] = [0, 1].map(|end| ranges[0][end].as_f64().unwrap());
    // d_y = R (3 pi 1.1 S/(4 E*))^2 of 5 mm on mild steel
    let ratio = 3.0 * std::f64::consts::PI * 1.1 * 300e6 / (4.0 * 206e9 / (1.0 - 0.3 * 0.3));
    let d_y = 0.005 * ratio * ratio;
    let lost = |x: f64| {
        let to = format!("{:e}", x * d_y);
        run(folder.path(), ["curve", "scene.toml", "--to", &to, "-o", "curve.csv"]).with_status(0);
        let table = fs::read_to_string(folder.path().join("curve.csv")).unwrap();
        let row = table.lines().last().unwrap().split(',').map(|cell| cell.parse().unwrap_or(f64::NAN));
        let row: Vec<f64> = row.collect();
        // the dissipated energy at the end, in F_y d_y with F_y = 1.1 pi S R d_y
        row[8] / (1.1 * std::f64::consts::PI * 300e6 * 0.005 * d_y * d_y)
    };
    assert!(ranges.len() == 1 && (from - 1.0).abs() < 1e-12, "{exported}");
    assert!(lost(0.999 * to).abs() < 1e-12 && lost(0.5 * to).abs() < 1e-12, "{}", lost(0.999 * to));
    assert!(lost(1.001 * to) > 1e-6, "{}", lost(1.001 * to));
}

/// The scene with another yield strength [Pa].
fn scene_with(yield_strength: f64) -> String {
    scene(&format!("yield_strength = {yield_strength:e}"), "", IMPACT)
}

/// The predicted restitution.
fn restitution(text: &str, law: &str, speed: f64) -> f64 {
    number(&predicted(text, &["--laws", law, "--speed", &format!("{speed:e}")])["laws"][0]["restitution"])
}

/// The explanations of the restitution `goal` with `law`.
fn explained(folder: &Path, law: &str, goal: f64) -> Value {
    predicted_in(folder, &scene_with(300e6), &["--laws", law, "--restitution", &goal.to_string()])["laws"][0].clone()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

#[test]
fn every_solution_has_the_requested_rebound() {
    let folder = empty_folder();
    // the number of solutions: counted in the curves of restitution over speed
    let cases = [
        ("big-alabo", 0.87, 3),
        ("big-alabo", 0.5, 1),
        ("zhao-maietta-chang", 0.735, 3),
        ("brake-2012-tangent", 0.99, 3),
        ("brinell", 0.446, 1),
        ("jackson-green", 0.7, 1),
    ];
    for (law, goal, count) in some(cases, 2) {
        let explained = explained(folder.path(), law, goal);
        let speeds = numbers(&explained["speed"]["solutions"]);
        let strengths = numbers(&explained["yield_strength"]["solutions"]);
        assert_eq!(speeds.len(), count, "{law} at {goal}: {explained}");
        assert_eq!(strengths.len(), count, "{law} at {goal}: {explained}");
        for speed in speeds {
            let got = restitution(&scene_with(300e6), law, speed);
            assert!((got - goal).abs() < 1e-9, "{law} at {speed} m/s: {got}, not {goal}");
        }
        for strength in strengths {
            let got = restitution(&scene_with(strength), law, 1.0);
            assert!((got - goal).abs() < 1e-9, "{law} with {strength} Pa: {got}, not {goal}");
        }
    }
}

/// The published law has a minimum of the restitution just above yield, where two solutions approach each other.
#[test]
fn two_solutions_closer_than_the_grid_are_both_found() {
    let folder = empty_folder();
    let speeds = |goal: f64| numbers(&explained(folder.path(), "big-alabo", goal)["speed"]["solutions"]);
    // the minimum by trying smaller and smaller values: two solutions approach each other, then only the third remains
    let (mut low, mut high) = (0.8, 0.86);
    while high - low > 1e-9 {
        let middle = 0.5 * (low + high);
        match speeds(middle).len() {
            1 => low = middle,
            3 => high = middle,
            other => panic!("{other} solutions at {middle}"),
        }
    }
    let found = speeds(high);
    assert!(found[1] / found[0] < 1.001, "{found:?}: closer than the points of any coarse grid");
}

#[test]
fn an_elastic_rebound_is_explained_by_every_speed_below_yield() {
    let folder = empty_folder();
    let explained = explained(folder.path(), "big-alabo", 1.0);
    let ranges = explained["speed"]["ranges"].as_array().unwrap();
    assert_eq!(ranges.len(), 1, "{explained}");
    // the speed at which the scene's target yields, according to predict
    let arguments = ["predict", "scene.toml", "--json"];
    let onset = &run(folder.path(), arguments).with_status(0).json()["laws"][0]["onsets"][0]["speed"];
    let end = numbers(&ranges[0])[1];
    assert!((end / onset.as_f64().unwrap() - 1.0).abs() < 1e-6, "{end}, yields at {onset}");
}

/// The fitted dent of Jackson and Green begins with a jump of the restitution down from 1.
#[test]
fn a_value_that_restitution_jumps_past_is_no_solution() {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), scene_with(300e6)).unwrap();
    let arguments = ["predict", "scene.toml", "--laws", "jackson-green/jackson,brinell", "--restitution", "0.999"];
    let run = run(folder.path(), arguments).with_status(0);
    assert!(run.out.contains("jumps past it") && run.out.contains("with no speed"), "{run:#?}");
}

/// Restitution of the scene's impact with each of the `laws`.
fn restitutions(text: &str, laws: &str) -> Vec<f64> {
    let predicted = predicted(text, &["--laws", laws]);
    predicted["laws"].as_array().unwrap().iter().map(|law| number(&law["restitution"])).collect()
}

#[test]
fn the_scenes_own_law_is_compared_with_its_constants_and_others_with_those_of_the_reference() {
    let own = scene("", "loading = \"walton-braun\"\nunloading_parameters = { stiffness_ratio = 25.0 }", IMPACT);
    let found = restitutions(&own, "walton-braun,walton-braun/walton-braun,big-alabo/walton-braun,luding");
    // sqrt(1/25)
    assert!(found[..2].iter().all(|restitution| (restitution - 0.2).abs() < 1e-14), "{found:?}");
    let usual =
        restitutions(&scene("", "loading = \"big-alabo\"", IMPACT), "walton-braun,big-alabo/walton-braun,luding");
    assert!((usual[0] - 0.5).abs() < 1e-14, "{usual:?}");
    // the unloading law is the scene's, the loading law has the reference constants
    assert!((found[2] / usual[1] - 0.4).abs() < 1e-12, "{found:?} {usual:?}");
    assert_eq!(found[3], usual[2]);
}
