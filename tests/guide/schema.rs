//! The JSON Schema of scenes accepts what is valid, and an editor's own checker finds it by the first line of a scene.

use crate::{read, root};
use brinell_testing::command::{brinell, empty_folder, output};
use brinell_testing::{python, schema};
use std::fs;
use std::process::Command;

#[test]
fn the_schema_accepts_every_scene_of_the_repository() {
    let folders =
        ["scenes", "examples", "data/experiment", "crates/exporter/src/scene"].map(|folder| root().join(folder));
    let files = folders.iter().flat_map(|folder| fs::read_dir(folder).expect("a folder with scenes"));
    let files =
        files.map(|file| file.expect("a file").path()).filter(|path| path.extension().is_some_and(|is| is == "toml"));
    let mut count = 0;
    for path in files {
        let found = schema::mistakes(&fs::read_to_string(&path).expect("a scene"));
        assert_eq!(found, Some(Vec::new()), "{}", path.display());
        count += 1;
    }
    assert!(count >= 26, "{count}");
}

/// Taplo is what Even Better TOML and others run.
#[test]
fn taplo_checks_a_new_scene_by_its_first_line() {
    let folder = empty_folder();
    output(brinell(folder.path()).args(["new", "ball"])).with_status(0);
    let file = folder.path().join("ball.toml");
    let good = fs::read_to_string(&file).unwrap();
    let lint = || {
        let taplo = python::python().with_file_name(if cfg!(windows) { "taplo.exe" } else { "taplo" });
        output(Command::new(taplo).args(["lint", "ball.toml"]).current_dir(folder.path()))
    };
    lint().with_status(0);
    for (from, to, said) in [
        ("radius = \"5 mm\"", "radius = \"5 kg\"", "\"5 kg\" does not match"),
        ("radius = \"5 mm\"", "radius = -5e-3", "less than the minimum"),
        ("loading = \"brinell\"", "loading = \"brinel\"", "\"brinel\" is not one of"),
        ("\n[impact] ", "\n[imapct] ", "'imapct' was unexpected"),
    ] {
        assert!(good.contains(from), "{from}");
        fs::write(&file, good.replacen(from, to, 1)).unwrap();
        let found = lint().with_status(1);
        assert!(found.err.contains(said), "{to}: {found:#?}");
    }
}

/// The same scene makes the same FMU, wherever its schema lies.
#[test]
fn an_fmu_has_no_line_about_a_schema() {
    let folder = empty_folder();
    let constants = |text: &str| {
        fs::write(folder.path().join("scene.toml"), text).unwrap();
        let exported = output(brinell(folder.path()).args(["export", "scene.toml", "-o", "unit.fmu"]));
        exported.with_status(0);
        fs::read(folder.path().join("unit.fmu")).unwrap()
    };
    let scene = read("scenes/steel_ball.toml".as_ref());
    assert_eq!(constants(&scene), constants(&format!("#:schema ./.brinell.schema.json\n{scene}")));
}
