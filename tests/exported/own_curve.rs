//! FMUs of a loading curve of one's own, compiled and prebuilt, that do what is predicted of it.

use crate::both_ways::Both;
use crate::command::{compile, empty_folder, run};
use crate::physics::Random;
use crate::prebuilt::store;
use crate::written::Written;
use std::fs;

/// A scene with the file `fe.csv` and these other lines.
fn scene(more: &str) -> String {
    format!(
        "name = \"unit\"\nimpactor = {{ radius = \"5 mm\", density = 7850.0 }}\ntarget = {{ youngs_modulus = \"206 GPa\", poissons_ratio = 0.3 }}\n\
         law = {{ loading = {{ table = \"fe.csv\" }} }}\n\
         fmu = {{ outputs = [\"work\", \"dissipated_energy\", \"contact_radius\", \"residual_indentation\", \"mean_pressure\"] }}\n{more}"
    )
}

/// A curve that begins as Hertz's and falls behind, up to 20 um.
fn file() -> String {
    let row = |row: u32| {
        let depth = 20e-6 * (f64::from(row) / 60.0).powi(2);
        let force = 2.134e10 * depth.powf(1.5) / (1.0 + (depth / 4e-6).sqrt());
        format!("{};{}", 1e6 * depth, force)
    };
    format!("depth [um];force [N]\n{}\n", (1..=60).map(row).collect::<Vec<_>>().join("\n"))
}

const IMPACT: &str = "impact = { mass = 4e-3, speed = 1.0 }\n";
const BODIES: &str = "impact = { speed = 1.0 }\n[[body]]\nname = \"lower\"\nmass = 0.033\n[[body]]\nname = \"upper\"\nmass = 0.02\n\
                      [[contact]]\nname = \"floor\"\nbetween = [\"lower\", \"ground\"]\n\
                      [[contact]]\nname = \"pair\"\nbetween = [\"upper\", \"lower\"]\n";

#[test]
fn an_fmu_of_an_own_curve_agrees_with_the_prediction() {
    let folder = empty_folder();
    fs::write(folder.path().join("fe.csv"), file()).unwrap();
    let coupled = format!("{IMPACT}coupling = {{ effective_mass = 4e-3 }}\n");
    for more in [IMPACT, &coupled, BODIES] {
        fs::write(folder.path().join("scene.toml"), scene(more)).unwrap();
        run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(0);
        run(folder.path(), ["check", "unit.fmu"]).with_status(0);
    }
    fs::write(folder.path().join("scene.toml"), scene(IMPACT)).unwrap();
    compile(folder.path(), ["export", "scene.toml", "-o", "compiled.fmu"]).with_status(0);
    run(folder.path(), ["check", "compiled.fmu"]).with_status(0);
    let said = run(folder.path(), ["predict", "scene.toml"]).with_status(0).out;
    assert!(said.contains("The loading curve of the file: "), "{said}");
}

#[test]
fn a_compiled_library_has_an_own_curve_alone_and_says_what_a_prebuilt_one_says() {
    let row = |row: u32| (f64::from(row) * 1e-6, 2.134e10 * (f64::from(row) * 1e-6).powf(1.5) * 0.7);
    let list = |of: &dyn Fn(u32) -> f64| (1..20).map(|row| format!("{:e}", of(row))).collect::<Vec<_>>().join(", ");
    let rows = format!("{{ depth = [{}], force = [{}] }}", list(&|at| row(at).0), list(&|at| row(at).1));
    let text = scene(IMPACT).replace("\"fe.csv\"", &rows);
    let written = Written::of(&text);
    assert!(written.rust.contains("contact::loading::Tabulated, contact::unloading::Tabulated"), "{}", written.rust);
    // also beyond the last row
    Both::of(text, store()).compare(100, &mut Random(7));
}
