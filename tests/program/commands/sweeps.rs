//! `brinell predict` over a range of speeds: tables, pictures and pages, and impacts with too little energy.

use crate::command::{self, empty_folder, run, scene};
use std::fs;

#[test]
fn a_sweep_is_a_table_or_a_picture() {
    let folder = empty_folder();
    let scene = scene("steel_ball");
    let sweep = |output: &str| {
        let arguments = ["predict", &scene.display().to_string(), "--laws", "all", "--sweep", "speed=0.01:10", "-o"];
        run(folder.path(), arguments.iter().copied().chain([output])).with_status(0);
        fs::read_to_string(folder.path().join(output)).unwrap()
    };
    let table = sweep("sweep.csv");
    let columns = table.lines().next().unwrap().split(',').count();
    assert!(table.lines().all(|line| line.split(',').count() == columns), "a table has as many columns everywhere");
    let speeds: Vec<f64> = table
        .lines()
        .filter(|line| line.starts_with("brinell/brinell,"))
        .map(|line| line.split(',').nth(1).unwrap().parse().unwrap())
        .collect();
    assert!(speeds[0] == 0.01 && speeds.is_sorted() && (speeds[speeds.len() - 1] - 10.0).abs() < 1e-12);
    let picture = sweep("sweep.svg");
    assert!(picture.starts_with("<svg") && picture.contains("brinell"));
    for title in ["restitution", "largest force [N]", "depth of the dent [m]"] {
        assert_eq!(picture.matches(title).count(), 1, "one panel with {title}");
    }
    assert_eq!(picture.matches("brinell/brinell\n").count(), 1, "the panels share one legend");
    let page = sweep("sweep.html");
    assert_eq!(page.matches("<svg").count(), 3);
    assert!(page.contains("effective mass of 4.11 g and speed from 10 mm/s to 10 m/s"));
    // the page is self-contained: it only names the namespace of SVG and the table
    let outside = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!outside.contains("http") && !outside.contains("<script") && !outside.contains("url("));
    assert!(page.contains(&table.replace('\n', "%0A")), "the whole table is in the page");
    assert!(page.contains("prefers-color-scheme: dark") && page.contains("@media print"));
}

/// The page of a sweep over the first contact of `text`.
fn sweep_page(text: &str) -> String {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    run(folder.path(), ["predict", "scene.toml", "--sweep", "speed=0.01:1", "-o", "x.html"]).with_status(0);
    fs::read_to_string(folder.path().join("x.html")).unwrap()
}

/// The page once said "A rigid sphere meets a half-space", without the numbers.
#[test]
fn the_page_of_a_sweep_shows_bodies_that_only_the_contact_gives() {
    let contact = "impactor = { radius = 4e-3, youngs_modulus = 7e10, poissons_ratio = 0.22 }\n\
                   target = { material = \"mild steel\", radius = -0.5 }\n";
    let page = sweep_page(&format!(
        "name = \"own\"\n[[contact]]\nname = \"left\"\n{contact}[[contact]]\nname = \"right\"\n{contact}"
    ));
    let words = "In the first contact, <code>left</code>, an elastic sphere meets a spherical socket";
    assert!(page.contains(words), "nothing of {words} in {page}");
    for row in
        ["impactor.radius</th><td>0.004 m", "impactor.youngs_modulus</th><td>7e10 Pa", "target.radius</th><td>-0.5 m"]
    {
        assert!(page.contains(row), "nothing of {row} in {page}");
    }
    assert!(!page.contains("rigid") && !page.contains("half-space"), "{page}");
}

/// The number of a contact overrides that of all contacts.
#[test]
fn the_page_of_a_sweep_shows_the_contacts_number_and_not_the_scenes() {
    let page = sweep_page(
        "name = \"own\"\nimpactor = { radius = 5e-3 }\ntarget = { material = \"mild steel\" }\n\
         [[contact]]\nname = \"left\"\nimpactor = { radius = 2e-3 }\n[[contact]]\nname = \"right\"\n",
    );
    assert!(page.contains("impactor.radius</th><td>0.002 m") && !page.contains("0.005 m"), "{page}");
    assert!(page.contains("a rigid sphere meets a half-space"), "{page}");
}

/// Such an impact has no energy balance.
#[test]
fn the_page_of_a_sweep_states_how_rate_dependent_impacts_were_computed() {
    let text = fs::read_to_string(scene("damped")).unwrap();
    let page = sweep_page(&text);
    assert!(page.contains("by integrating the motion") && !page.contains("energy balance"), "{page}");
}

/// The energy of 1e-160 m/s underflows; this is not an error of the law.
#[test]
fn an_energy_too_small_to_compute_with_is_not_blamed_on_the_law() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let asked: [&[&str]; 4] =
        [&["--speed", "1e-160"], &["--energy", "1e-320"], &["--drop-height", "1e-322"], &["--sweep", "speed=1e-160:1"]];
    for arguments in asked {
        let all = ["predict", &scene].into_iter().chain(arguments.iter().copied());
        let failed = run(folder.path(), all).with_status(2);
        assert!(failed.err.contains("kinetic energy") && failed.err.contains("2.22507e-308 J"), "{failed:#?}");
        assert!(!failed.err.contains("law") && failed.err.len() < 200, "{failed:#?}");
    }
    run(folder.path(), ["predict", &scene, "--speed", "1e-150", "--laws", "all"]).with_status(0);
}

#[test]
fn a_sweep_without_any_dent_has_its_panels_too() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let arguments = ["predict", &scene, "--laws", "hertz", "--sweep", "speed=0.01:10", "-o", "sweep.svg"];
    run(folder.path(), arguments).with_status(0);
    assert!(fs::read_to_string(folder.path().join("sweep.svg")).unwrap().contains("depth of the dent"));
}

/// Numbers of the sweep's CSV: the columns by name, one law.
fn columns(text: &str, name: &str) -> Vec<f64> {
    let place = text.lines().next().unwrap().split(',').position(|column| column == name);
    let place = place.unwrap_or_else(|| panic!("no {name} in {text}"));
    text.lines().skip(1).map(|line| line.split(',').nth(place).unwrap().parse().unwrap()).collect()
}

/// Each point equals the prediction for the scene with that number.
#[test]
fn a_sweep_over_a_parameter_is_that_of_scenes_with_it() {
    let folder = empty_folder();
    let text = |radius: f64, strength: f64, target: f64| {
        format!(
            "name = \"ball\"\n[impactor]\nradius = {radius:?}\nyoungs_modulus = 70e9\npoissons_ratio = 0.2\n[target]\n\
             youngs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = {strength:?}\nradius = {target:?}\n\
             [impact]\nmass = 4e-3\nspeed = 1.0\n"
        )
    };
    let force = |text: &str, laws: &str| {
        fs::write(folder.path().join("one.toml"), text).unwrap();
        let answer = run(folder.path(), ["predict", "one.toml", "--laws", laws, "--json"]).with_status(0).json();
        answer["laws"][0]["largest_force"].as_f64().unwrap()
    };
    fs::write(folder.path().join("scene.toml"), text(5e-3, 300e6, -0.05)).unwrap();
    for laws in ["big-alabo", "jackson-green", "hertz"] {
        for (range, with) in [
            ("impactor.radius=1e-3:2e-2:5", &(|value| text(value, 300e6, -0.05)) as &dyn Fn(f64) -> String),
            ("target.yield_strength=200e6:900e6:8", &|value| text(5e-3, value, -0.05)),
            ("target.radius=-1e-1:-1e-2:4", &|value| text(5e-3, 300e6, value)),
        ] {
            let name = range.split('=').next().unwrap();
            let arguments = ["predict", "scene.toml", "--laws", laws, "--sweep", range, "-o", "sweep.csv"];
            if laws == "hertz" && name == "target.yield_strength" {
                assert!(run(folder.path(), arguments).with_status(2).err.contains("no yield strength"));
                continue;
            }
            run(folder.path(), arguments).with_status(0);
            let table = fs::read_to_string(folder.path().join("sweep.csv")).unwrap();
            let unit = if name.ends_with("radius") { "m" } else { "Pa" };
            let values = columns(&table, &format!("{name}_{unit}"));
            let count: usize = range.rsplit(':').next().unwrap().parse().unwrap();
            assert_eq!(values.len(), count);
            for (value, found) in values.iter().zip(columns(&table, "largest_force_N")) {
                assert_eq!(found, force(&with(*value), laws), "{laws}, {name} = {value}");
            }
        }
    }
}

/// From 200 to 900 MPa in eight values 100 MPa apart. A range below a decade has equal differences, a larger one
/// equal ratios.
#[test]
fn the_values_of_a_sweep_are_round_where_they_can_be() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let values = |range: &str, column: &str| {
        run(folder.path(), ["predict", &scene, "--sweep", range, "-o", "x.csv"]).with_status(0);
        columns(&fs::read_to_string(folder.path().join("x.csv")).unwrap(), column)
    };
    let strengths = values("target.yield_strength=200e6:900e6:8", "target.yield_strength_Pa");
    assert_eq!(strengths, [2e8, 3e8, 4e8, 5e8, 6e8, 7e8, 8e8, 9e8]);
    let speeds = values("speed=0.01:10:4", "speed_m_per_s");
    assert!(
        speeds.iter().zip([0.01, 0.1, 1.0, 10.0]).all(|(one, other)| (one / other - 1.0).abs() < 1e-12),
        "{speeds:?}"
    );
    assert_eq!(values("energy=1e-3:2e-3", "energy_J").len(), 201);
}

#[test]
fn two_sweeps_are_a_map() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let sweeps = ["--sweep", "speed=0.1:10:7", "--sweep", "target.yield_strength=200e6:900e6:5"];
    let run = |more: &[&str]| run(folder.path(), ["predict", &scene].iter().chain(&sweeps).chain(more)).with_status(0);
    run(&["-o", "map.csv"]);
    let table = fs::read_to_string(folder.path().join("map.csv")).unwrap();
    let (speeds, strengths) = (columns(&table, "speed_m_per_s"), columns(&table, "target.yield_strength_Pa"));
    let forces = columns(&table, "largest_force_N");
    assert_eq!(forces.len(), 35);
    // the corner equals the impact of that scene
    let text = fs::read_to_string(&scene)
        .unwrap()
        .replace("material = \"mild steel\"", "material = \"mild steel\"\nyield_strength = 900e6");
    fs::write(folder.path().join("corner.toml"), text).unwrap();
    let corner =
        command::run(folder.path(), ["predict", "corner.toml", "--speed", "10", "--json"]).with_status(0).json();
    assert_eq!((speeds[34], strengths[34]), (10.0, 900e6));
    assert_eq!(corner["laws"][0]["largest_force"].as_f64(), Some(forces[34]));
    run(&["-o", "map.svg"]);
    let picture = fs::read_to_string(folder.path().join("map.svg")).unwrap();
    assert!(picture.matches("<title>").count() == 3 * 35 && picture.contains("speed [m/s]"));
    run(&["-o", "map.html"]);
    let page = fs::read_to_string(folder.path().join("map.html")).unwrap();
    assert!(page.contains("speed from 100 mm/s to 10 m/s and target.yield_strength from 200 MPa to 900 MPa"), "{page}");
    let json = run(&["--json"]).json();
    assert_eq!(json["laws"][0]["largest_force"].as_array().unwrap().len(), 35);
    let short = run(&[]).out;
    assert!(short.lines().count() < 40 && short.contains("restitution by speed"), "{short}");
}

#[test]
fn a_sweep_in_a_terminal_is_short_and_has_all_digits_in_json() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let arguments = ["predict", &scene, "--sweep", "speed=0.01:10"];
    let short = run(folder.path(), arguments).with_status(0).out;
    assert!(short.lines().count() <= 14 && short.contains("big-alabo/contact-radius"), "{short}");
    let json = run(folder.path(), arguments.into_iter().chain(["--json"])).with_status(0).json();
    let law = &json["laws"][0];
    assert_eq!(law["speed"].as_array().unwrap().len(), 201);
    let one = run(folder.path(), ["predict", &scene, "--speed", "10", "--json"]).with_status(0).json();
    assert_eq!(law["restitution"][200], one["laws"][0]["restitution"]);
}

const DEFORMED: &str = "loading = \"big-alabo\"\nunloading = \"deformed-radius\"";
const GUARDED: &str = "loading = \"big-alabo\"\nunloading = \"deformed-radius\"\npassivity_guard = true";

/// Each point equals the prediction for the scene with that constant.
#[test]
fn a_sweep_over_a_constant_of_a_law_is_that_of_scenes_with_it() {
    let folder = empty_folder();
    let text = |law: &str, constants: &str| {
        format!(
            "name = \"ball\"\nimpactor = {{ radius = 5e-3 }}\ntarget = {{ material = \"mild steel\" }}\n\
             impact = {{ mass = 4e-3, speed = 1.0 }}\n[law]\n{law}\n{constants}\n"
        )
    };
    let cases = [
        ("loading = \"thornton\"", "law.loading_parameters.peak_pressure_factor=1.2:2.4:4", "loading"),
        ("loading = \"power\"", "law.loading_parameters.exponent=1.1:1.4:3", "loading"),
        (DEFORMED, "law.unloading_parameters.pressure_factor=2:3:3", "unloading"),
        (GUARDED, "law.unloading_parameters.pressure_factor=2:3:3", "unloading"),
        ("loading = \"kuwabara-kono\"", "law.loading_parameters.relaxation_time=1e-6:1e-5:2", "loading"),
    ];
    for (law, range, kind) in cases {
        fs::write(folder.path().join("scene.toml"), text(law, "")).unwrap();
        run(folder.path(), ["predict", "scene.toml", "--sweep", range, "-o", "sweep.csv"]).with_status(0);
        let table = fs::read_to_string(folder.path().join("sweep.csv")).unwrap();
        let constant = range.split('=').next().and_then(|name| name.rsplit('.').next()).unwrap();
        let column = table.lines().next().unwrap().split(',').find(|name| name.contains(constant)).unwrap().to_string();
        let found: Vec<_> = columns(&table, &column).into_iter().zip(columns(&table, "restitution")).collect();
        assert!(found.len() > 1 && found[0].1 != found[found.len() - 1].1, "{law}, {range}: {found:?}");
        for (value, restitution) in found {
            let constants = format!("{kind}_parameters = {{ {constant} = {value:?} }}");
            fs::write(folder.path().join("one.toml"), text(law, &constants)).unwrap();
            let one = run(folder.path(), ["predict", "one.toml", "--json"]).with_status(0).json();
            let expected = one["laws"][0]["restitution"].as_f64().unwrap();
            assert!((restitution / expected - 1.0).abs() < 1e-14, "{law}, {constant} = {value}");
        }
    }
}

#[test]
fn a_constant_that_cannot_be_varied_is_rejected_with_those_that_can() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let refused = |laws: &str, range: &str, words: &str| {
        let run = run(folder.path(), ["predict", &scene, "--laws", laws, "--sweep", range]).with_status(2);
        assert!(run.err.contains(words), "{laws}, {range}: {}", run.err);
    };
    refused(
        "thornton",
        "law.loading_parameters.peak_presure_factor=1:2",
        "did you mean `law.loading_parameters.peak_pressure_factor`?",
    );
    refused("thornton", "law.loading_parameters.stiffness_ratio=2:8", "unknown parameter");
    refused("hertz", "law.loading_parameters.yield_pressure_factor=1:2", "which has none");
    refused("hertz", "law.unloading_parameters.pressure_factor=1:2", "no unloading law");
    refused("tsuji", "law.unloading_parameters.pressure_factor=1:2", "no unloading law");
    refused("thornton", "law.loading_parameters.peak_pressure_factor=-1:2", "out of range: allowed is");
    // with several laws, the table shows those that have it
    let sweep =
        ["--laws", "thornton,hertz", "--sweep", "law.loading_parameters.peak_pressure_factor=1.2:2.4:2", "-o", "x.csv"];
    run(folder.path(), ["predict", &scene].into_iter().chain(sweep)).with_status(0);
    let table = fs::read_to_string(folder.path().join("x.csv")).unwrap();
    assert!(table.contains("thornton/") && !table.contains("hertz,"), "{table}");
}

/// A dent of 10.3 mm in a ball of 5 mm was once printed without a word.
#[test]
fn sweeps_and_inverse_predictions_warn_where_the_law_is_not_valid() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let warned = |arguments: &[&str]| {
        let command = ["predict", scene.as_str()];
        run(folder.path(), command.iter().chain(arguments)).with_status(0)
    };
    for arguments in [
        &["--sweep", "speed=1:1000"][..],
        &["--sweep", "target.yield_strength=2e5:4e6"],
        &["--sweep", "speed=1:1000:5", "--sweep", "mass=1e-3:1:5"],
        &["--sweep", "speed=1:1000:5", "--angle", "30", "--friction", "0.1"],
    ] {
        let said = warned(arguments).err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            said.contains("impacts are outside the law's validity (") && said.contains("effective radii"),
            "{arguments:?}: {said}"
        );
        warned(&[arguments, &["-o", "x.html"]].concat());
        let page = fs::read_to_string(folder.path().join("x.html")).unwrap();
        assert!(page.contains("<p>Warning: ") && page.contains("outside the law's validity"), "{page}");
    }
    for arguments in [&["--dent", "0.8e-3"][..], &["--restitution", "0.05"]] {
        let said = warned(arguments).err;
        assert!(said.contains("brinell: warning: "), "{arguments:?}: {said}");
    }
    let curve = |to| run(folder.path(), ["curve", &scene, "--to", to, "--laws", "brinell,thornton"]).with_status(0).err;
    assert_eq!(curve("1e-4"), "");
    let said = curve("1e-3");
    assert!(said.contains("where no law is valid, with brinell/brinell, thornton/thornton"), "{said}");
    for arguments in [&["--sweep", "speed=0.1:1"][..], &["--dent", "1e-5"], &["--restitution", "0.5"]] {
        assert_eq!(warned(arguments).err, "", "{arguments:?}");
    }
}

#[test]
fn each_row_of_a_sweep_says_whether_its_impact_is_valid() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let strengths = ["--sweep", "target.yield_strength=2e5:4e7:9"];
    for more in [&[][..], &["--sweep", "mass=1e-3:1e-1:4"]] {
        let all = ["predict", &scene, "--laws", "brinell,thornton", "-o", "x.csv"];
        run(folder.path(), all.iter().chain(&strengths).chain(more)).with_status(0);
        let table = fs::read_to_string(folder.path().join("x.csv")).unwrap();
        // of the effective radius of 5 mm, at 1 m/s
        let wide = columns(&table, "largest_contact_radius_m").into_iter().map(|radius| radius > 0.3 * 5e-3);
        let expected: Vec<_> = wide.map(|is_wide| if is_wide { 0.0 } else { 1.0 }).collect();
        assert_eq!(columns(&table, "valid"), expected);
        assert!(expected.contains(&0.0) && expected.contains(&1.0), "{expected:?}");
    }
}

#[test]
fn implausible_numbers_of_the_command_line_are_asked_about_with_what_was_probably_meant() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let said = |arguments: &[&str]| {
        let run = run(folder.path(), ["predict", scene.as_str()].iter().chain(arguments));
        run.err.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let curve = run(folder.path(), ["curve", &scene, "--to", "10"]);
    assert!(curve.err.contains("to = 10 m; did you mean 10e-6?"), "{curve:?}");
    for (arguments, words) in [
        (&["--speed", "5000"][..], "warning: speed = 5000 m/s; did you mean 5?"),
        (&["--sweep", "speed=1000:10000"], "warning: speed = 10000 m/s; did you mean 10?"),
        (&["--sweep", "target.yield_strength=200:400"], "warning: target.yield_strength = 200 Pa; did you mean 200e6?"),
        (&["--sweep", "impactor.radius=1:10"], "warning: impactor.radius = 10 m; did you mean 0.01?"),
        (&["--sweep", "speed=1:2:2", "--sweep", "target.youngs_modulus=190:210:2"], "190 Pa; did you mean 190e9?"),
        (&["--sweep", "speed=5000:6000:2", "--angle", "30", "--friction", "0.1"], "did you mean 5?"),
        (&["--dent", "10"], "warning: dent = 10 m; did you mean 10e-6?"),
        (&["--dent", "0.05"], "warning: dent = 0.05 m; did you mean 50e-6?"),
    ] {
        let said = said(arguments);
        assert!(said.contains(words), "{arguments:?}: {said}");
    }
    for arguments in [
        &["--speed", "1e-3"][..],
        &["--sweep", "target.radius=5:50:2"],
        &["--sweep", "target.yield_strength=200e6:900e6:2"],
        &["--sweep", "impactor.radius=1e-3:1e-2:2"],
    ] {
        assert_eq!(said(arguments), "", "{arguments:?}");
    }
}
