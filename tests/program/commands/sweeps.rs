//! `brinell predict` over ranges: each point of a table is the prediction for a scene with these numbers.

use brinell_testing::folder::{Folder, column, number};
use serde_json::json;
use std::collections::BTreeSet;

#[test]
fn a_sweep_has_a_row_for_each_law_and_value() {
    let folder = Folder::of_scene("steel_ball");
    let sweep = "predict scene.toml --laws all --sweep speed=0.01:10";
    folder.call(&format!("{sweep} -o sweep.csv")).with_status(0);
    let table = folder.read("sweep.csv");
    let columns = table.lines().next().unwrap().split(',').count();
    assert!(table.lines().all(|line| line.split(',').count() == columns), "a table has as many columns everywhere");
    let own = table.lines().filter(|line| line.starts_with("brinell/brinell,"));
    let speeds: Vec<f64> = own.map(|line| line.split(',').nth(1).unwrap().parse().unwrap()).collect();
    assert!(speeds[0] == 0.01 && speeds.is_sorted() && (speeds[speeds.len() - 1] - 10.0).abs() < 1e-12);
    let laws: BTreeSet<_> = table.lines().skip(1).map(|line| line.split(',').next().unwrap()).collect();
    assert_eq!(table.lines().count(), 1 + laws.len() * 201);
    let short = folder.call(sweep).with_status(0).out;
    assert!(laws.iter().all(|law| short.lines().any(|line| line == *law)), "a table for each law: {short}");
}

/// A scene with this impactor, target and law.
fn scene(impactor: &str, target: &str, law: &str) -> String {
    format!(
        "name = \"ball\"\nimpactor = {{ {impactor} }}\ntarget = {{ {target} }}\nlaw = {{ {law} }}\n\
         impact = {{ mass = 4e-3, speed = 1.0 }}\n"
    )
}

/// Error and warning are the last columns of a table, and the others are those of a sweep with the same numbers.
#[test]
fn an_impact_of_a_table_has_the_numbers_of_a_sweep_or_its_error() {
    let folder = Folder::of_scene("steel_ball");
    for (table, more, sweep, wrong) in [
        (
            "speed,mass\n0.1,4 g\n\n-1,4e-3\n40 m/s,4e-3\n",
            "",
            "--sweep speed=0.1,40 --sweep mass=4e-3,",
            "speed = -1 must be positive",
        ),
        (
            "angle,speed,friction.coefficient\n30,1,0.1\n95,1,0.1\n40,1,0.1\n",
            "--friction 0.1",
            "--sweep angle=30,40, --sweep speed=1, --sweep friction.coefficient=0.1,",
            "angle = 95",
        ),
    ] {
        let call = format!("predict scene.toml --laws brinell,thornton {more}");
        folder.write("impacts.csv", table);
        let json = folder.json(&format!("{call} --impacts impacts.csv"));
        let swept = folder.json(&format!("{call} {sweep}"));
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
        let out = folder.call(&format!("{call} --impacts impacts.csv -o answer.csv"));
        assert_eq!(out.with_status(0).err, "", "each impact has its own warnings");
        let csv = folder.read("answer.csv");
        assert!(csv.lines().next().unwrap().ends_with(",valid,error,warning"));
        assert_eq!(csv.matches(&format!(",\"{wrong}")).count(), 2, "{csv}");
    }
}

#[test]
fn a_table_of_impacts_is_read_as_spreadsheets_write_it() {
    let folder = Folder::of_scene("steel_ball");
    let answers = [
        "speed,mass\n0.5,0.004\n",
        "\u{feff}speed;mass\r\n0,5;0,004\r\n",
        "# of Monday\nspeed\tmass\n0.5\t4 g\n",
        "\"speed [mm/s]\",\"mass [g]\"\n\"500\",\"4\"\n",
        "sep=;\nspeed (cm/s);mass\n50;4 g\n",
    ]
    .map(|table| {
        folder.write("impacts.csv", table);
        folder.json("predict scene.toml --impacts impacts.csv")
    });
    assert!(answers.iter().all(|answer| answer["laws"] == answers[0]["laws"]), "{answers:#?}");
    for (table, why) in [
        ("speed;mass\n1.082;1\n", "1: `1.082` is ambiguous"),
        ("speed [kg]\n1\n", "2: speed = `1 kg`: kg is a mass"),
        ("", "1: there is no heading"),
        ("speed\n", "1: 0 impacts below the heading"),
        ("speed,mass\n1\n", "2: 1 cells below a heading of 2"),
        ("speed\n\n1 kg\n", "3: speed = `1 kg`: kg is a mass"),
    ] {
        folder.write("impacts.csv", table);
        let told = folder.call("predict scene.toml --impacts impacts.csv --json").with_status(2).err;
        assert!(told.contains(&format!("impacts.csv:{why}")), "{told}");
    }
}

/// The scene with the number of a sweep in place of `#`.
#[test]
fn a_sweep_over_one_number_is_that_of_scenes_with_it() {
    const GLASS: &str = "radius = 5e-3, youngs_modulus = 70e9, poissons_ratio = 0.2";
    const STEEL: &str = "youngs_modulus = 206e9, poissons_ratio = 0.3, yield_strength = 3e8, radius = -0.05";
    let bodies = [
        ("impactor.radius=1e-3:2e-2:5", GLASS.replace("5e-3", "#"), STEEL.into()),
        ("target.yield_strength=200e6:900e6:8", GLASS.into(), STEEL.replace("3e8", "#")),
        ("target.radius=-1e-1:-1e-2:4", GLASS.into(), STEEL.replace("-0.05", "#")),
    ];
    let mut cases = Vec::new();
    for loading in ["big-alabo", "jackson-green", "hertz"] {
        for (range, impactor, target) in &bodies {
            if loading != "hertz" || !range.contains("strength") {
                cases.push((*range, scene(impactor, target, &format!("loading = {loading:?}"))));
            }
        }
    }
    let brinell = "loading = \"brinell\"";
    let steel = "material = \"mild steel\"";
    for (range, target, law) in [
        ("target.hardening_modulus=1e9:2e10:3", format!("{steel}, hardening_modulus = #"), brinell.into()),
        ("target.plate_thickness=4e-3:8e-3:2", format!("{steel}, plate_thickness = #"), brinell.into()),
        ("elastic_restitution=0.8:0.9:2", steel.into(), format!("{brinell}, elastic_restitution = #")),
    ] {
        cases.push((range, scene("radius = 5e-3", &target, &law)));
    }
    let deformed = "loading = \"big-alabo\", unloading = \"deformed-radius\"";
    for (range, law) in [
        ("law.loading_parameters.peak_pressure_factor=1.2:2.4:4", "loading = \"thornton\""),
        ("law.loading_parameters.exponent=1.1:1.4:3", "loading = \"power\""),
        ("law.unloading_parameters.pressure_factor=2:3:3", deformed),
        ("law.unloading_parameters.pressure_factor=2:3:3", &format!("{deformed}, passivity_guard = true")),
        ("law.loading_parameters.relaxation_time=1e-6:1e-5:2", "loading = \"kuwabara-kono\""),
    ] {
        let name = range.split('=').next().unwrap();
        let law = format!("{law}, {} = #", name.trim_start_matches("law."));
        cases.push((range, scene("radius = 5e-3", steel, &law)));
    }
    for (range, text) in cases {
        let (name, ends) = range.split_once('=').unwrap();
        let folder = Folder::of(&text.replace('#', ends.split(':').next().unwrap()));
        folder.call(&format!("predict scene.toml --sweep {range} -o sweep.csv")).with_status(0);
        let table = folder.read("sweep.csv");
        let head = table.lines().next().unwrap().split(',').find(|head| head.starts_with(name));
        let values = column(&table, head.unwrap_or_else(|| panic!("no {name} in {table}")));
        let found = ["restitution", "largest_force_N"].map(|name| column(&table, name));
        assert_eq!(values.len().to_string(), ends.rsplit(':').next().unwrap(), "{range}");
        let last = values.len() - 1;
        assert!(found.iter().any(|column| column[0] != column[last]), "{range}: {text}");
        for (row, value) in values.iter().enumerate() {
            let one = Folder::of(&text.replace('#', &format!("{value:?}"))).json("predict scene.toml");
            for (name, found) in ["restitution", "largest_force"].into_iter().zip(&found) {
                let expected = number(&one["laws"][0], name);
                assert!((found[row] / expected - 1.0).abs() < 1e-14, "{range}: {text} {value}");
            }
        }
    }
}

/// Each row equals the prediction for a scene with these numbers, in the order of the combinations.
#[test]
fn sweeps_over_several_quantities_are_those_of_scenes_with_them() {
    let text = |radius: f64, strength: f64| {
        let target = format!("material = \"mild steel\", yield_strength = {strength:?}");
        scene(&format!("radius = {radius:?}"), &target, "loading = \"brinell\"")
    };
    let folder = Folder::of(&text(5e-3, 300e6));
    let sweep = "predict scene.toml --sweep speed=1:3:3 --sweep impactor.radius=1e-3:2e-3:2 --sweep target.yield_strength=3e8:4e8:2";
    folder.call(&format!("{sweep} -o x.csv")).with_status(0);
    let table = folder.read("x.csv");
    let found = ["speed_m_per_s", "impactor.radius_m", "target.yield_strength_Pa", "largest_force_N"]
        .map(|name| column(&table, name));
    let mut row = 0;
    for speed in [1.0, 2.0, 3.0] {
        for radius in [1e-3, 2e-3] {
            for strength in [300e6, 400e6] {
                let one = Folder::of(&text(radius, strength)).json(&format!("predict scene.toml --speed {speed}"));
                let force = number(&one, "laws/0/largest_force");
                let [values @ .., largest] = found.each_ref().map(|column| column[row]);
                assert_eq!(values, [speed, radius, strength]);
                assert!((largest / force - 1.0).abs() < 1e-14, "{largest}, not {force}");
                row += 1;
            }
        }
    }
    assert_eq!(found[0].len(), row);
    let json = folder.json(sweep);
    for column in json["columns"].as_array().unwrap() {
        let values = json["laws"][0][column["name"].as_str().unwrap()].as_array();
        assert_eq!(values.map(Vec::len), Some(row), "{column}");
    }
    let short = folder.call(sweep).with_status(0).out;
    assert!(short.lines().count() < 20 && short.contains("9 of 12 values"), "{short}");
}

#[test]
fn each_row_of_a_sweep_says_whether_its_impact_is_valid() {
    let folder = Folder::of_scene("steel_ball");
    for more in ["", "--sweep mass=1e-3:1e-1:4"] {
        let sweep = "predict scene.toml --laws brinell,thornton -o x.csv --sweep target.yield_strength=2e5:4e7:9";
        folder.call(&format!("{sweep} {more}")).with_status(0);
        let table = folder.read("x.csv");
        // of the effective radius of 5 mm, at 1 m/s
        let wide = column(&table, "largest_contact_radius_m").into_iter().map(|radius| radius > 0.3 * 5e-3);
        let expected: Vec<_> = wide.map(|is_wide| if is_wide { 0.0 } else { 1.0 }).collect();
        assert_eq!(column(&table, "valid"), expected);
        assert!(expected.contains(&0.0) && expected.contains(&1.0), "{expected:?}");
    }
}
