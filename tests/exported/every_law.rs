//! Every law in an exported FMU.
//!
//! A usual run takes one law of each kind; `BRINELL_LONG=1 cargo test --release --test exported every_law` takes all.

use crate::command::{compile, empty_folder, run};
use crate::loaded::{OK, Unit};
use crate::physics::Random;
use crate::unit::write_scene;
use brinell_testing::long;
use std::f64::consts::PI;
use std::fs;

/// The laws of a usual run: elastic, fitted in segments; each
/// rate-dependent law with one of its dampings.
const USUAL: [&str; 7] =
    ["hertz", "brinell", "hunt-crossley/exact", "kelvin-voigt", "tsuji/lammps", "kuwabara-kono", "adams-impact"];

/// Those of `laws` that this run takes, `usual` of them in a usual run.
fn taken(laws: &[serde_json::Value], usual: usize) -> impl Iterator<Item = &serde_json::Value> {
    let all = long::is_asked();
    let taken: Vec<_> = laws.iter().filter(|law| all || USUAL.contains(&law["name"].as_str().unwrap())).collect();
    assert!(taken.len() == if all { laws.len() } else { usual }, "{} laws", taken.len());
    taken.into_iter()
}

#[test]
fn every_law_runs_inside_an_fmu_that_has_no_other() {
    let folder = empty_folder();
    let laws = run(folder.path(), ["laws", "--json"]).with_status(0).json();
    let laws = laws["loading"].as_array().unwrap();
    assert!(laws.len() >= 19, "all laws are listed");
    let mut sizes = Vec::new();
    for law in taken(laws, 2) {
        let (loading, unloading) = (law["name"].as_str().unwrap(), law["unloading"].as_str().unwrap());
        // hertz unloads along the loading curve
        let unloading = if loading == "hertz" { String::new() } else { format!("unloading = \"{unloading}\"\n") };
        let scene = format!(
            "name = \"unit\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n[law]\n\
             loading = \"{loading}\"\n{unloading}[impact]\nmass = 4.11e-3\nspeed = 0.5\n"
        );
        fs::write(folder.path().join("scene.toml"), scene).unwrap();
        let exported =
            compile(folder.path(), ["export", "scene.toml", "-o", "unit.fmu", "--json"]).with_status(0).json();
        sizes.push((exported["library_size"].as_u64().unwrap(), loading));
        let checked = run(folder.path(), ["check", "unit.fmu", "--json"]);
        assert_eq!(checked.status, Some(0), "{loading}: {checked:#?}");
    }
    // an FMU with all laws would be larger than its largest part: other laws are left out
    let (smallest, largest) = (sizes.iter().min().unwrap(), sizes.iter().max().unwrap());
    assert_eq!(smallest.1, "hertz", "{sizes:?}");
    assert!(largest.0 < 76_000 && largest.0 > smallest.0 + 10_000, "{sizes:?}");
}

#[test]
fn every_rate_dependent_law_runs_inside_an_fmu_with_nothing_plastic() {
    let folder = empty_folder();
    let laws = run(folder.path(), ["laws", "--json"]).with_status(0).json();
    let laws = laws["damped"].as_array().unwrap();
    assert_eq!(laws.len(), 9 + 3 + 3, "every law in each of its dampings is listed");
    for law in taken(laws, 5) {
        let name = law["name"].as_str().unwrap();
        let (loading, damping) = name.split_once('/').map_or((name, None), |(law, damping)| (law, Some(damping)));
        let asked = ["hunt-crossley", "kelvin-voigt", "tsuji"].contains(&loading);
        let restitution = if asked { "restitution = 0.7\n" } else { "" };
        let damping = damping.map(|damping| format!("damping = \"{damping}\"\n")).unwrap_or_default();
        let scene = format!(
            "name = \"unit\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n[law]\n\
             loading = \"{loading}\"\n{restitution}{damping}[impact]\nmass = 4.11e-3\nspeed = 0.5\n"
        );
        fs::write(folder.path().join("scene.toml"), scene).unwrap();
        let exported = run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu", "--json"]).with_status(0).json();
        let variables: Vec<_> = exported["variables"].as_array().unwrap().iter().map(|v| v.as_str().unwrap()).collect();
        assert_eq!(variables.contains(&"restitution"), asked, "{name}: {variables:?}");
        assert!(!variables.contains(&"target.yield_strength"), "{name}: {variables:?}");
        let checked = run(folder.path(), ["check", "unit.fmu", "--json"]).with_status(0).json();
        let row = |quantity: &str| {
            let rows = checked["rows"].as_array().unwrap();
            rows.iter().find(|row| row["quantity"] == quantity).unwrap()["simulated"].as_f64().unwrap()
        };
        assert!(row("restitution") > 0.5 && row("restitution") < 1.0, "{name}: {checked}");
        let gives = law["restitution"].as_f64().unwrap();
        assert!(gives > 0.4 && gives < 0.95, "{name}: asked for 0.5 it gives {gives}");
    }
}

/// On every branch: rates of both signs over five decades.
#[test]
fn the_contact_area_is_that_of_the_contact_radius() {
    for law in ["big-alabo", "brinell", "johnson", "tsuji"] {
        let more = if law == "tsuji" { "restitution = 0.6\n" } else { "" };
        let text = format!(
            "name = \"area\"\nimpactor = {{ radius = 5e-3 }}\ntarget = {{ material = \"mild steel\" }}\n\
             [law]\nloading = {law:?}\n{more}[fmu]\noutputs = [\"contact_radius\", \"contact_area\"]\n"
        );
        let unit = Unit::load(&write_scene(&format!("area_{law}"), &text));
        let (mut contact, mut random, mut touched) = (unit.ready(), Random(3), 0);
        for step in 0..2000 {
            let rate = (random.next() - 0.45) * 10f64.powf(5.0 * random.next() - 4.0);
            contact.set_one("indentation_rate", rate);
            assert_eq!(contact.step(f64::from(step) * 1e-6, 1e-6), OK);
            let [radius, area] = ["contact_radius", "contact_area"].map(|name| contact.real(name));
            assert!((area - PI * radius * radius).abs() <= 4.0 * f64::EPSILON * area, "{law}, step {step}: {area}");
            touched += u32::from(area > 0.0);
        }
        assert!((100..2000).contains(&touched), "{law}: in contact in {touched} steps");
    }
}
