//! `brinell predict` over a range of speeds: tables, pictures and pages, and impacts with too little energy to be any.

#[path = "support/command.rs"]
mod command;

use command::{empty_folder, run, scene};
use std::fs;

#[test]
fn a_sweep_is_a_table_or_a_picture() {
    let folder = empty_folder();
    let scene = scene("steel_ball");
    let sweep = |output: &str| {
        let arguments = ["predict", &scene.display().to_string(), "--laws", "all", "--sweep", "speed", "0.01:10", "-o"];
        run(folder.path(), arguments.iter().copied().chain([output])).with_status(0);
        fs::read_to_string(folder.path().join(output)).unwrap()
    };
    let table = sweep("sweep.csv");
    let columns = table.lines().next().unwrap().split(',').count();
    assert!(table.lines().all(|line| line.split(',').count() == columns), "a table has as many columns everywhere");
    let speeds: Vec<f64> = table
        .lines()
        .filter(|line| line.starts_with("brinell,"))
        .map(|line| line.split(',').nth(1).unwrap().parse().unwrap())
        .collect();
    assert!(speeds[0] == 0.01 && speeds.is_sorted() && (speeds[speeds.len() - 1] - 10.0).abs() < 1e-12);
    let picture = sweep("sweep.svg");
    assert!(picture.starts_with("<svg") && picture.contains("brinell"));
    for title in ["restitution", "largest force [N]", "depth of the dent [m]"] {
        assert_eq!(picture.matches(title).count(), 1, "one panel with {title}");
    }
    assert_eq!(picture.matches("brinell\n").count(), 1, "the panels share one legend");
    let page = sweep("sweep.html");
    assert_eq!(page.matches("<svg").count(), 3);
    assert!(page.contains("effective mass of 0.00411 kg") && page.contains("from 0.01 to 10 m/s"));
    // everything is in the page: what it names besides is the namespace of SVG and the table
    let outside = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!outside.contains("http") && !outside.contains("<script") && !outside.contains("url("));
    assert!(page.contains(&table.replace('\n', "%0A")), "the whole table is in the page");
    assert!(page.contains("prefers-color-scheme: dark") && page.contains("@media print"));
}

/// The page of a sweep over the first contact of `text`.
fn sweep_page(text: &str) -> String {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    run(folder.path(), ["predict", "scene.toml", "--sweep", "speed", "0.01:1", "-o", "x.html"]).with_status(0);
    fs::read_to_string(folder.path().join("x.html")).unwrap()
}

/// It said "A rigid sphere meets a half-space", and nothing of the numbers.
#[test]
fn the_page_of_a_sweep_knows_bodies_that_only_the_contact_gives() {
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

/// A number that a contact has of its own stands before that of all contacts.
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
fn the_page_of_a_sweep_says_how_rate_dependent_impacts_were_found() {
    let text = fs::read_to_string(scene("damped")).unwrap();
    let page = sweep_page(&text);
    assert!(page.contains("by integrating the motion") && !page.contains("energy balance"), "{page}");
}

/// Half a square of 1e-160 m/s is next to no number at all: no law is to blame.
#[test]
fn an_energy_too_small_to_compute_with_is_not_blamed_on_the_law() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let asked: [&[&str]; 4] = [
        &["--speed", "1e-160"],
        &["--energy", "1e-320"],
        &["--drop-height", "1e-322"],
        &["--sweep", "speed", "1e-160:1"],
    ];
    for arguments in asked {
        let all = ["predict", &scene].into_iter().chain(arguments.iter().copied());
        let failed = run(folder.path(), all).with_status(1);
        assert!(failed.err.contains("kinetic energy") && failed.err.contains("2.22507e-308 J"), "{failed:#?}");
        assert!(!failed.err.contains("law") && failed.err.len() < 200, "{failed:#?}");
    }
    run(folder.path(), ["predict", &scene, "--speed", "1e-150", "--laws", "all"]).with_status(0);
}

#[test]
fn a_sweep_without_any_dent_has_its_panels_too() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let arguments = ["predict", &scene, "--laws", "hertz", "--sweep", "speed", "0.01:10", "-o", "sweep.svg"];
    run(folder.path(), arguments).with_status(0);
    assert!(fs::read_to_string(folder.path().join("sweep.svg")).unwrap().contains("depth of the dent"));
}
