//! `brinell report` in quick mode: the page is self-contained, and its numbers agree with theory.

#[path = "support/command.rs"]
mod command;

use command::{contents, empty_folder, run, scene};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;
use tempfile::TempDir;

/// The quick report of a scene: its folder and its data.
fn report(name: &str) -> (TempDir, Value) {
    let folder = empty_folder();
    let scene = scene(name).display().to_string();
    run(folder.path(), ["report", &scene, "--quick", "-o", "report"]).with_status(0);
    let text = fs::read_to_string(folder.path().join("report/report.json")).expect("the data stand beside the page");
    let data = serde_json::from_str(&text).expect("JSON");
    (folder, data)
}

/// The report of the default scene, made once.
static DEFAULT: LazyLock<(TempDir, Value)> = LazyLock::new(|| report("steel_ball"));

/// The ways of an FMU that knows the mass.
const KNOWN: [&str; 2] = ["mass known", "mass known, parallel"];

fn rows<'a>(data: &'a Value, table: &str) -> &'a [Value] {
    data[table].as_array().unwrap_or_else(|| panic!("no table {table}"))
}

#[track_caller]
fn row<'a>(data: &'a Value, table: &str, way: &str) -> &'a Value {
    rows(data, table).iter().find(|row| row["way"] == way).unwrap_or_else(|| panic!("no way {way} in {table}"))
}

#[test]
fn fitted_orders_are_those_of_the_methods() {
    for (way, order) in [("late force", 1.0), ("predicted_force", 2.0), ("leap-frog", 2.0), ("input derivatives", 3.0)]
    {
        let fitted = row(&DEFAULT.1, "orders", way)["order"].as_f64().expect("a fitted order");
        assert!((fitted - order).abs() < 0.3, "{way}: order {fitted} instead of {order}");
    }
}

#[test]
fn an_fmu_that_knows_the_mass_is_exact_to_rounding_for_every_step() {
    for way in KNOWN {
        let known = rows(&DEFAULT.1, "precision").iter().filter(|row| row["way"] == way);
        let errors: Vec<f64> = known.map(|row| row["error_of_restitution"].as_f64().expect("an error")).collect();
        assert_eq!(errors.len(), 8, "{way}: 2 to 256 steps per contact");
        assert!(errors.iter().all(|error| *error < 1e-11), "{way}: {errors:?}");
    }
}

/// The data of the elastic scene, made once.
static ELASTIC: LazyLock<Value> = LazyLock::new(|| report("elastic").1);

#[test]
fn the_stable_limits_of_an_elastic_scene_are_those_of_theory() {
    // the smallest root of the polynomial in (h omega)^2 for which input derivatives have the eigenvalue -1
    let polynomial = |z: f64| ((z - 48.0) * z + 432.0) * z - 576.0;
    let (mut low, mut high) = (0.0, 2.0f64);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if polynomial(middle) < 0.0 { low = middle } else { high = middle }
    }
    for (way, theory) in [("predicted_force", 2.0), ("leap-frog", 2.0), ("input derivatives", low.sqrt())] {
        let row = row(&ELASTIC, "limits", way);
        let told = row["elastic_theory"].as_f64().expect("a limit of theory");
        assert!((told / theory - 1.0).abs() < 1e-12, "{way}: theory says {theory}, the report {told}");
        let limit = row["largest_stable_h_sqrt(K/m)"].as_f64().expect("a limit");
        assert!((limit / theory - 1.0).abs() < 0.05, "{way}: h sqrt(K/m) = {limit} instead of {theory}");
    }
    for (way, words) in [
        ("late force", "at no step that was tried"),
        ("mass known", "at every step that was tried"),
        ("mass known, parallel", "at every step that was tried"),
    ] {
        let row = row(&ELASTIC, "limits", way);
        assert_eq!(row["stable"], words, "{way}");
        assert!(row["largest_stable_h_sqrt(K/m)"].is_null(), "{way} has no limit: {row}");
    }
}

#[test]
fn the_json_has_the_stable_limit_of_every_way() {
    let used = &ELASTIC["use"];
    let stable = used["stable"].as_array().expect("a list");
    let limits = rows(&ELASTIC, "limits");
    assert_eq!(stable.len(), limits.len());
    for (told, limit) in stable.iter().zip(limits) {
        assert_eq!((&told["way"], &told["stable"]), (&limit["way"], &limit["stable"]));
        assert_eq!(told["h_sqrt(K/m)"], limit["largest_stable_h_sqrt(K/m)"]);
        assert_eq!(told["step_s"], limit["largest_stable_step_s"]);
    }
    assert_eq!(used["stable_leap_frog"], row(&ELASTIC, "limits", "leap-frog")["largest_stable_h_sqrt(K/m)"]);
    assert!(used["stable_late"].is_null(), "a late force is stable at no step: {used}");
}

#[test]
fn each_co_simulation_algorithm_has_one_recommended_way_the_cheapest_that_reaches_one_percent() {
    let ways = DEFAULT.1["use"]["ways"].as_array().expect("a list");
    let time = |way: &Value| way["one_percent"]["time_per_impact_s"].as_f64().unwrap_or(f64::INFINITY);
    for master in ["serial (Gauss-Seidel)", "parallel (Jacobi)"] {
        let ways: Vec<_> = ways.iter().filter(|way| way["master"] == master).collect();
        let recommended: Vec<_> = ways.iter().filter(|way| way["recommended"] == true).collect();
        assert_eq!(recommended.len(), 1, "{master}: {ways:?}");
        assert!(ways.iter().all(|way| time(way) >= time(recommended[0])), "{master}: {ways:?}");
        assert!(recommended[0]["one_percent"]["error_of_restitution"].as_f64().expect("an error") < 0.01);
    }
    let exact = ways.iter().filter(|way| way["exact"] == true).map(|way| way["way"].as_str().expect("a name"));
    assert_eq!(exact.collect::<Vec<_>>(), KNOWN);
}

#[test]
fn all_cases_of_an_elastic_scene_are_right() {
    let verdicts = rows(&ELASTIC, "extremes").iter().map(|row| row["verdict"].as_str().expect("a verdict"));
    let wrong: Vec<_> = verdicts.filter(|verdict| *verdict != "right").collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// Step and highest rebound energy of a way, over the steps of the map.
fn energies(data: &Value, way: &str) -> Vec<(f64, f64)> {
    let rows = rows(data, "stability").iter().filter(|row| row["way"] == way);
    let number = |value: &Value| value.as_f64().expect("a number");
    rows.map(|row| (number(&row["h_sqrt(K/m)"]), number(&row["highest_rebound_over_incoming_energy"]))).collect()
}

#[test]
fn the_map_has_every_way_at_every_step() {
    let steps = |way: &str| energies(&DEFAULT.1, way).into_iter().map(|(step, _)| step).collect::<Vec<_>>();
    let first = steps("late force");
    assert_eq!(first.len(), 41);
    assert!((first[0] / 0.02 - 1.0).abs() < 1e-12 && (first[40] / 8.0 - 1.0).abs() < 1e-12, "{first:?}");
    for way in ["predicted_force", "leap-frog", "input derivatives", "mass known", "mass known, parallel"] {
        assert_eq!(steps(way), first, "{way}");
    }
    let map = fs::read_to_string(DEFAULT.0.path().join("report/stability.svg")).expect("a map");
    for way in ["late force", "predicted_force", "leap-frog", "input derivatives", "mass known"] {
        assert!(map.contains(way), "the map has no row {way}");
    }
}

#[test]
fn an_fmu_that_knows_the_mass_creates_energy_at_no_step() {
    for (data, way) in [&DEFAULT.1, &*ELASTIC].into_iter().flat_map(|data| KNOWN.map(|way| (data, way))) {
        for (step, energy) in energies(data, way) {
            assert!(energy <= 1.0 + 1e-9, "{way}: h sqrt(K/m) = {step}: {energy}");
        }
    }
}

#[test]
fn a_delayed_force_creates_energy_at_a_large_step() {
    let (step, energy) = *energies(&DEFAULT.1, "late force").last().expect("steps");
    assert!(energy > 1.0, "h sqrt(K/m) = {step}: {energy}");
}

#[test]
fn restitution_over_speed_has_every_law() {
    for law in rows(&DEFAULT.1, "laws").iter().map(|row| &row["law"]).filter(|law| *law != "finite elements") {
        let speeds = rows(&DEFAULT.1, "restitution").iter().filter(|row| row["law"] == *law);
        assert_eq!(speeds.count(), 41, "{law}");
    }
    let truth = rows(&DEFAULT.1, "restitution").iter().filter(|row| row["law"] == "finite elements");
    let truth: Vec<f64> = truth.map(|row| row["restitution"].as_f64().expect("a number")).collect();
    // from truth/README.md; its slowest impact is slower than a hundredth of the scene's speed
    let printed = [0.777, 0.645, 0.536, 0.450];
    assert_eq!(truth.len(), printed.len(), "{truth:?}");
    assert!(truth.iter().zip(printed).all(|(one, other)| (one - other).abs() < 6e-4), "{truth:?}");
}

#[test]
fn the_spread_has_the_extremes_of_the_laws() {
    let laws = rows(&DEFAULT.1, "laws").iter();
    let laws: Vec<_> = laws.filter(|row| row["law"] != "hertz" && row["law"] != "finite elements").collect();
    for row in rows(&DEFAULT.1, "spread") {
        let key = match row["quantity"].as_str().expect("a name") {
            "restitution" => "restitution",
            "largest force" => "largest_force_N",
            "dent" => "dent_m",
            "contact time" => "contact_time_s",
            other => panic!("a quantity {other}"),
        };
        let values = || laws.iter().map(|law| law[key].as_f64().expect("a number"));
        assert_eq!(row["lowest"].as_f64(), Some(values().fold(f64::INFINITY, f64::min)), "{row}");
        assert_eq!(row["highest"].as_f64(), Some(values().fold(f64::NEG_INFINITY, f64::max)), "{row}");
        for (by, value) in [("lowest_by", "lowest"), ("highest_by", "highest")] {
            let law = laws.iter().find(|law| law["law"] == row[by]).expect("a law of the table");
            assert_eq!(law[key], row[value], "{row}");
        }
    }
    assert_eq!(rows(&DEFAULT.1, "spread").len(), 4);
}

#[test]
fn all_extreme_cases_are_judged_and_pass() {
    let cases = rows(&DEFAULT.1, "extremes");
    assert!(cases.len() >= 50, "some dozens of cases, not {}", cases.len());
    for case in cases {
        assert_eq!(case["verdict"], "right", "{case}");
        for error in ["error_of_force", "error_of_energy"] {
            let (error, tolerance) = (case[error].as_f64(), case["tolerance"].as_f64());
            assert!(error.is_some() && error <= tolerance, "{case}");
        }
        let wide = case["a/R"].as_f64().expect("a width") > 0.3;
        let beyond = case["beyond_validity"].as_str().expect("words");
        assert_eq!(wide, beyond.contains("a/R above 0.3"), "{case}");
    }
}

#[test]
fn the_page_is_self_contained_with_its_data_beside_it() {
    let folder = DEFAULT.0.path().join("report");
    let page = fs::read_to_string(folder.join("index.html")).expect("a page");
    assert!(page.ends_with("</html>\n"), "the page is whole");
    for outside in ["<link", "<img", "@import", "src=", "url(", "fetch(", "import(", "XMLHttpRequest"] {
        assert!(!page.contains(outside), "the page has {outside}");
    }
    // the only web address is the name of the vector format, which is not loaded
    let addresses = page.matches("http").count();
    assert_eq!(addresses, page.matches("xmlns=\"http://www.w3.org/2000/svg\"").count());
    let expected = [
        "contact-time-against-steps.svg",
        "dent-against-steps.svg",
        "error-against-calls.svg",
        "error-against-steps.svg",
        "error-against-time.svg",
        "extremes.csv",
        "force-against-steps.svg",
        "force-over-indentation.svg",
        "force-over-time.svg",
        "index.html",
        "laws.csv",
        "laws.svg",
        "limits.csv",
        "orders.csv",
        "precision.csv",
        "report.json",
        "restitution.csv",
        "restitution.svg",
        "spread.csv",
        "stability-curves.svg",
        "stability.csv",
        "stability.svg",
    ];
    assert_eq!(contents(&folder), expected);
    for file in expected {
        assert!(page.contains(file) || file == "index.html", "the page names {file}");
    }
}

#[test]
fn csv_and_json_have_the_same_rows() {
    let (folder, data) = &*DEFAULT;
    for table in ["precision", "orders", "limits", "stability", "extremes", "laws", "spread", "restitution"] {
        let path = Path::new("report").join(table).with_extension("csv");
        let csv = fs::read_to_string(folder.path().join(path)).expect("a table");
        assert_eq!(csv.lines().count(), rows(data, table).len() + 1, "{table}");
    }
}

#[test]
fn a_scene_with_several_contacts_or_a_rate_dependent_law_has_a_report_too() {
    let (_folder, data) = report("two_contacts");
    assert!(data["summary"].to_string().contains("measures the first contact"), "{}", data["summary"]);
    let (_folder, data) = report("damped");
    assert!(rows(&data, "orders").iter().all(|row| row["way"] != "mass known"), "{}", data["orders"]);
}

#[test]
fn the_fmu_alone_adds_only_rounding() {
    let alone: Vec<_> = rows(&DEFAULT.1, "precision").iter().filter(|row| row["way"] == "unit alone").collect();
    assert_eq!(alone.len(), 7, "4 to 256 steps per contact");
    for row in alone {
        for error in ["error_of_restitution", "error_of_largest_force", "error_of_dent"] {
            assert!(row[error].as_f64().expect("an error") < 1e-14, "{error}: {row}");
        }
    }
}

#[test]
fn the_error_of_the_dent_has_the_order_of_the_method_too() {
    let dents = |way: &str| -> Vec<f64> {
        let points = rows(&DEFAULT.1, "precision").iter().filter(|row| row["way"] == way);
        points.map(|row| row["error_of_dent"].as_f64().expect("an error")).collect()
    };
    // from 32 to 256 steps per contact
    for (way, order) in [("late force", 1.0), ("leap-frog", 2.0), ("input derivatives", 3.0)] {
        let dents = dents(way);
        let fallen = (dents[4] / dents[7]).log2() / 3.0;
        assert!((fallen - order).abs() < 0.35, "{way}: order {fallen} instead of {order}");
    }
}

#[test]
fn an_fmu_may_reject_impacts_beyond_its_law_and_the_summary_warns_of_a_wide_impact() {
    let folder = empty_folder();
    let text = fs::read_to_string(scene("steel_ball")).expect("a scene");
    let text = text.replace("loading = \"big-alabo\"", "loading = \"jackson-green\"");
    let text = text.replace("speed = 1.0 ", "speed = 60.0 ");
    assert!(text.contains("jackson-green") && text.contains("60.0"), "{text}");
    fs::write(folder.path().join("scene.toml"), text).expect("a writable folder");
    let run = run(folder.path(), ["report", "scene.toml", "--quick", "--json"]).with_status(0);
    let data = run.json();
    let refused = "rejected, correctly: fmi2DoStep returned status 3: fmi2DoStep: the indentation would become";
    let verdicts = || rows(&data, "extremes").iter().map(|row| row["verdict"].as_str().expect("a verdict"));
    assert!(verdicts().any(|verdict| verdict.starts_with(refused)), "{:?}", verdicts().collect::<Vec<_>>());
    let fine = |verdict: &str| verdict == "right" || verdict.starts_with("rejected, correctly");
    assert!(verdicts().all(fine), "{:?}", verdicts().collect::<Vec<_>>());
    let summary = data["summary"].to_string();
    for warning in ["the contact radius reaches", "the speed is 0.0117 of the wave speed"] {
        assert!(summary.contains(warning), "{summary}");
    }
}

#[test]
fn energy_created_by_a_law_is_reported_and_is_no_failure_of_its_fmu() {
    let folder = empty_folder();
    let text = fs::read_to_string(scene("steel_ball")).expect("a scene");
    let text =
        text.replace("loading = \"big-alabo\"", "loading = \"stronge\"").replace("speed = 1.0 ", "speed = 1e-3 ");
    fs::write(folder.path().join("scene.toml"), text).expect("a writable folder");
    let data = run(folder.path(), ["report", "scene.toml", "--quick", "--json"]).with_status(0).json();
    let gains = |row: &&Value| row["beyond_validity"].as_str().expect("words").contains("the law gains energy");
    let gaining: Vec<_> = rows(&data, "extremes").iter().filter(gains).collect();
    assert!(!gaining.is_empty() && gaining.iter().all(|row| row["verdict"] == "right"), "{gaining:?}");
}
