//! `brinell report --measured`: a user's own measurement in the report.

use super::rows;
use crate::command::{empty_folder, run, scene};
use std::fs;

#[test]
fn a_measurement_is_drawn_and_the_strength_that_explains_it_is_found() {
    let folder = empty_folder();
    let text =
        fs::read_to_string(scene("steel_ball")).unwrap().replace("loading = \"big-alabo\"", "loading = \"brinell\"");
    // the rebounds of a target of 450 MPa
    let stronger = text.replace("material = \"mild steel\"", "material = \"mild steel\"\nyield_strength = 450e6");
    for (name, text) in [("scene.toml", &text), ("stronger.toml", &stronger)] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let sweep =
        run(folder.path(), ["predict", "stronger.toml", "--sweep", "speed=0.1:3:8", "--json"]).with_status(0).json();
    let column = |name: &str| sweep["laws"][0][name].as_array().unwrap().clone();
    let lines = column("speed").into_iter().zip(column("restitution")).map(|(speed, e)| format!("{speed},{e}\n"));
    fs::write(folder.path().join("drops.csv"), format!("speed [m/s],restitution\n{}", lines.collect::<String>()))
        .unwrap();
    let arguments = ["report", "scene.toml", "--measured", "drops.csv", "--quick", "--json", "-o", "report"];
    let data = run(folder.path(), arguments).with_status(0).json();
    let [fit] = rows(&data, "fit") else { panic!("one parameter: {data}") };
    let number = |name: &str| fit[name].as_f64().expect("a number");
    assert_eq!(fit["parameter"], "target.yield_strength");
    assert!((number("fitted") / 450e6 - 1.0).abs() < 1e-6, "{fit}");
    assert!(number("lowest") <= number("fitted") && number("fitted") <= number("highest"), "{fit}");
    assert_eq!(rows(&data, "measured").len(), 8);
    assert!(data["summary"].to_string().contains("target.yield_strength: 450 MPa, with 95 % confidence"), "{data}");
    let page = fs::read_to_string(folder.path().join("report/index.html")).unwrap();
    assert!(page.find("Your measurement").unwrap() < page.find("Error against run time").unwrap());
    for picture in ["measured.svg", "restitution.svg"] {
        let svg = fs::read_to_string(folder.path().join("report").join(picture)).unwrap();
        assert!(svg.contains("data-series=\"measured\""), "{picture}");
    }
}

#[test]
fn a_wrong_measurement_is_rejected_before_anything_is_measured() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    fs::write(folder.path().join("good.csv"), "speed,restitution\n1,0.4\n2,0.3\n").unwrap();
    fs::write(folder.path().join("bad.csv"), "speed,restitution\n1,0.4\n2,1.3\n").unwrap();
    for (arguments, status, words) in [
        (&["--measured", "bad.csv"][..], 1, "bad.csv:3, column 2: restitution = 1.3 must be above 0 and at most 1"),
        (&["--measured", "none.csv"], 1, "none.csv"),
        (&["--measured", "good.csv", "--fit", "rate"], 2, "--fit rate needs a rate model in the scene"),
        (&["--measured", "good.csv", "--fit", "hardness"], 2, "invalid value 'hardness'"),
        (&["--measured", "good.csv", "--fit", "hardening_modulus"], 2, "big-alabo has no hardening modulus"),
        (&["--fit", "rate"], 2, "--measured"),
    ] {
        let failed = run(folder.path(), ["report", &scene].iter().chain(arguments)).with_status(status);
        assert!(failed.err.contains(words), "{arguments:?}: {}, not {words}", failed.err);
        assert!(!folder.path().join("steel_ball_report").exists());
    }
}
