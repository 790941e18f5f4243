//! `brinell predict` over ranges: tables and their warnings, and impacts with too little energy.

use crate::command::{empty_folder, run, scene};
use serde_json::json;
use std::collections::BTreeSet;
use std::fs;

#[test]
fn a_sweep_has_a_row_for_each_law_and_value() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let sweep = ["predict", &scene, "--laws", "all", "--sweep", "speed=0.01:10"];
    run(folder.path(), sweep.iter().chain(&["-o", "sweep.csv"])).with_status(0);
    let table = fs::read_to_string(folder.path().join("sweep.csv")).unwrap();
    let columns = table.lines().next().unwrap().split(',').count();
    assert!(table.lines().all(|line| line.split(',').count() == columns), "a table has as many columns everywhere");
    let speeds: Vec<f64> = table
        .lines()
        .filter(|line| line.starts_with("brinell/brinell,"))
        .map(|line| line.split(',').nth(1).unwrap().parse().unwrap())
        .collect();
    assert!(speeds[0] == 0.01 && speeds.is_sorted() && (speeds[speeds.len() - 1] - 10.0).abs() < 1e-12);
    let laws: BTreeSet<_> = table.lines().skip(1).map(|line| line.split(',').next().unwrap()).collect();
    assert_eq!(table.lines().count(), 1 + laws.len() * 201);
    let short = run(folder.path(), sweep).with_status(0).out;
    assert!(laws.iter().all(|law| short.lines().any(|line| line == *law)), "a table for each law: {short}");
}

/// Numbers of the sweep's CSV: the columns by name, one law.
fn columns(text: &str, name: &str) -> Vec<f64> {
    let place = text.lines().next().unwrap().split(',').position(|column| column == name);
    let place = place.unwrap_or_else(|| panic!("no {name} in {text}"));
    text.lines().skip(1).map(|line| line.split(',').nth(place).unwrap().parse().unwrap()).collect()
}

/// Error and warning are the last columns of a table, and the others are those of a sweep with the same numbers.
#[test]
fn an_impact_of_a_table_has_the_numbers_of_a_sweep_or_its_error() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let laws = ["predict", &scene, "--laws", "brinell,thornton", "--friction", "0.1"];
    for (table, sweep, wrong) in [
        (
            "speed,mass\n0.1,4 g\n\n-1,4e-3\n40 m/s,4e-3\n",
            &["speed=0.1,40", "mass=4e-3,"][..],
            "speed = -1 must be positive",
        ),
        (
            "angle,speed,friction.coefficient\n30,1,0.1\n95,1,0.1\n40,1,0.1\n",
            &["angle=30:40:2", "speed=1,", "friction.coefficient=0.1,"],
            "angle = 95",
        ),
    ] {
        let words = if table.starts_with("angle") { &laws[..] } else { &laws[..4] };
        fs::write(folder.path().join("impacts.csv"), table).unwrap();
        let listed = run(folder.path(), words.iter().chain(&["--impacts", "impacts.csv", "--json"])).with_status(0);
        let json = listed.json();
        let axes: Vec<_> = sweep.iter().flat_map(|axis| ["--sweep", axis]).collect();
        let swept = run(folder.path(), words.iter().chain(&axes).chain(&["--json"])).with_status(0).json();
        assert_eq!(json["columns"], swept["columns"]);
        for (law, expected) in json["laws"].as_array().unwrap().iter().zip(swept["laws"].as_array().unwrap()) {
            for name in json["columns"].as_array().unwrap().iter().map(|column| column["name"].as_str().unwrap()) {
                let other = expected[name].as_array().unwrap();
                let number = &law[name][1];
                assert_eq!(law[name], json!([other[0], number, other[1]]), "{name}");
                assert!(table.contains(name) || number.is_null(), "{name} of an impact that can't be: {number}");
            }
            let error = law["error"].as_array().unwrap();
            assert!(error[1].as_str().unwrap().starts_with(wrong), "{error:?}");
            assert_eq!((&error[0], &error[2]), (&json!(""), &json!("")));
            assert_eq!(law["warning"][2] != "", law["valid"][2] == 0.0);
        }
        let out = run(folder.path(), words.iter().chain(&["--impacts", "impacts.csv", "-o", "answer.csv"]));
        assert_eq!(out.with_status(0).err, "", "each impact has its own warnings");
        let csv = fs::read_to_string(folder.path().join("answer.csv")).unwrap();
        assert!(csv.lines().next().unwrap().ends_with(",valid,error,warning"));
        assert_eq!(csv.matches(&format!(",\"{wrong}")).count(), 2, "{csv}");
    }
    for (table, why) in [
        ("", "1: there is no heading"),
        ("speed\n", "1: 0 impacts below the heading"),
        ("speed,mass\n1\n", "2: 1 cells below a heading of 2"),
        ("speed\n\n1 kg\n", "3: speed = `1 kg`: kg is a mass"),
    ] {
        fs::write(folder.path().join("impacts.csv"), table).unwrap();
        let told = run(folder.path(), ["predict", &scene, "--impacts", "impacts.csv", "--json"]).with_status(2).err;
        assert!(told.contains(&format!("impacts.csv:{why}")), "{told}");
    }
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

/// Each row equals the prediction for a scene with these numbers, in the order of the combinations.
#[test]
fn sweeps_over_several_quantities_are_those_of_scenes_with_them() {
    let folder = empty_folder();
    let text = |radius: f64, strength: f64| {
        format!(
            "name = \"ball\"\nimpactor = {{ radius = {radius:?} }}\nlaw = {{ loading = \"brinell\" }}\n\
             target = {{ material = \"mild steel\", yield_strength = {strength:?} }}\nimpact = {{ mass = 4e-3, speed = 1.0 }}\n"
        )
    };
    fs::write(folder.path().join("scene.toml"), text(5e-3, 300e6)).unwrap();
    let sweeps = [
        "--sweep",
        "speed=1:3:3",
        "--sweep",
        "impactor.radius=1e-3:2e-3:2",
        "--sweep",
        "target.yield_strength=3e8:4e8:2",
    ];
    let asked =
        |more: &[&str]| run(folder.path(), ["predict", "scene.toml"].iter().chain(&sweeps).chain(more)).with_status(0);
    asked(&["-o", "x.csv"]);
    let table = fs::read_to_string(folder.path().join("x.csv")).unwrap();
    let found = ["speed_m_per_s", "impactor.radius_m", "target.yield_strength_Pa", "largest_force_N"]
        .map(|name| columns(&table, name));
    let mut row = 0;
    for speed in [1.0, 2.0, 3.0] {
        for radius in [1e-3, 2e-3] {
            for strength in [300e6, 400e6] {
                fs::write(folder.path().join("one.toml"), text(radius, strength)).unwrap();
                let arguments = ["predict", "one.toml", "--json", "--speed", &speed.to_string()];
                let one = run(folder.path(), arguments).with_status(0).json();
                let force = one["laws"][0]["largest_force"].as_f64().unwrap();
                let [values @ .., largest] = found.each_ref().map(|column| column[row]);
                assert_eq!(values, [speed, radius, strength]);
                assert!((largest / force - 1.0).abs() < 1e-14, "{largest}, not {force}");
                row += 1;
            }
        }
    }
    assert_eq!(found[0].len(), row);
    let json = asked(&["--json"]).json();
    assert_eq!(json["laws"][0]["largest_force"].as_array().unwrap().len(), row);
    let short = asked(&[]).out;
    assert!(short.lines().count() < 20 && short.contains("9 of 12 values"), "{short}");
}

#[test]
fn a_sweep_over_a_list_has_its_values_in_their_order() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    for (range, values) in [
        ("speed=3,1,2", json!([3.0, 1.0, 2.0])),
        ("speed=1 m/s,50 cm/s", json!([1.0, 0.5])),
        ("speed=1.0,2.0", json!([1.0, 2.0])),
        ("speed=2,", json!([2.0])),
    ] {
        let answer = run(folder.path(), ["predict", &scene, "--sweep", range, "--json"]).with_status(0).json();
        assert_eq!(answer["laws"][0]["speed"], values, "{range}");
    }
}

#[test]
fn the_columns_of_a_table_in_json_have_units_and_the_regimes_names() {
    let folder = empty_folder();
    let scene = scene("mass_known").display().to_string();
    for arguments in [&["predict", &scene, "--sweep", "speed=0.1:1:2", "--json"][..], &["curve", &scene, "--json"]] {
        let table = run(folder.path(), arguments).with_status(0).json();
        let columns = table["columns"].as_array().unwrap();
        for column in columns {
            assert!(table["laws"][0][column["name"].as_str().unwrap()].is_array(), "{column}");
        }
        let name = if arguments[0] == "curve" { "force" } else { "largest_force" };
        assert!(columns.contains(&json!({ "name": name, "unit": "N" })), "{columns:?}");
        assert_eq!(table["regimes"][4], "fully plastic");
    }
}

#[test]
fn numbers_with_units_become_numbers_in_si_units() {
    let folder = empty_folder();
    let given =
        ["target.yield_strength=400 MPa", "bead[3].initial_gap=-5 um", "speed=3.6 km/h", "mass=2.5", "angle=0.5 rad"];
    let numbers = run(folder.path(), ["numbers"].iter().chain(&given)).with_status(0).json();
    assert_eq!(numbers, json!([400e6, -5e-6, 1.0, 2.5, 0.5_f64.to_degrees()]));
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
fn of_several_laws_the_table_shows_those_that_have_the_constant() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let sweep =
        ["--laws", "thornton,hertz", "--sweep", "law.loading_parameters.peak_pressure_factor=1.2:2.4:2", "-o", "x.csv"];
    run(folder.path(), ["predict", &scene].into_iter().chain(sweep)).with_status(0);
    let table = fs::read_to_string(folder.path().join("x.csv")).unwrap();
    assert!(table.contains("thornton/") && !table.contains("hertz,"), "{table}");
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
fn a_sweep_over_the_strength_keeps_the_laws_that_have_one() {
    let folder = empty_folder();
    fs::copy(scene("steel_ball"), folder.path().join("scene.toml")).unwrap();
    let sweep = |laws: &str| {
        let range = "target.yield_strength=1e8:1e9:3";
        run(folder.path(), ["predict", "scene.toml", "--laws", laws, "--sweep", range, "--json"])
    };
    for (laws, left) in [("hertz,thornton", 1), ("thornton,hunt-crossley,brinell", 2)] {
        assert_eq!(sweep(laws).with_status(0).json()["laws"].as_array().unwrap().len(), left, "{laws}");
    }
}
