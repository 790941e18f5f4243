//! The laws beside finite elements: the tables of the guide, and the accuracy in the table of laws.

use crate::devices;
use crate::physics::{self, AnyModel, mild, passive_from, unit};
use crate::tables::{heading, row, shows};
use crate::{is_writing, read, root};
use brinell_contact::LARGEST_INDENTATION;
use brinell_contact::loading::AnyLoading;
use brinell_contact::{Loading, Model, Numbered, Pair, Surface, TwoBodies};
use brinell_testing::laws::{entries, entry, says, text};
use std::fs;
use std::path::Path;

/// The names of the laws that yield.
pub fn yielding() -> impl Iterator<Item = &'static str> {
    AnyLoading::of_balls().map(|(name, _)| name).filter(|name| *name != "hertz")
}

/// A loading law on `pair` with the unloading law of scenes that name none, in the form for other materials.
fn model(name: &str, pair: Pair, hardening_modulus: f64) -> AnyModel {
    let (loading, unloading) = (physics::loading(name), physics::unloading(unloading_with(name)));
    let bodies = TwoBodies { hardening_modulus, curvature: 0.0, other: physics::elastic_partner(&pair) };
    Model { pair, loading: loading.of_bodies(bodies), unloading, surface: Surface::Dented }.prepared()
}

/// The unloading law of a scene that names none.
pub fn unloading_with(name: &str) -> &'static str {
    let own = text(entry("loading", name), "unloading");
    if own.is_empty() { "contact-radius" } else { own }
}

/// The numbers of a table in a file, of the lines that begin with `start`; other cells are NaN.
pub fn numbers(file: &str, start: &str) -> Vec<Vec<f64>> {
    let text = read(Path::new(file));
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let rows = lines.skip(1).filter_map(|line| line.strip_prefix(start));
    rows.map(|line| line.split(',').map(|cell| cell.trim().parse().unwrap_or(f64::NAN)).collect()).collect()
}

/// The number that is farther from zero.
pub fn larger(one: f64, other: f64) -> f64 {
    if other.abs() > one.abs() { other } else { one }
}

pub fn percent(value: f64, digits: usize) -> String {
    format!("{:+.digits$} %", 100.0 * value)
}

/// Errors of a loading law relative to a finite-element curve.
struct Errors {
    worst: f64,
    /// Place of the worst error [yield indentations].
    worst_at: f64,
    rms: f64,
}

impl Errors {
    /// The errors from the indentation `from` to `to` [yield indentations].
    fn of(model: &AnyModel, curve: &[Vec<f64>], (from, to): (f64, f64)) -> Errors {
        let unit = unit(&model.pair);
        let mut errors = Errors { worst: 0.0, worst_at: 0.0, rms: 0.0 };
        let (mut count, mut squares) = (0.0, 0.0);
        for point in curve.iter().filter(|point| (from..=to).contains(&point[0])) {
            let depth = point[0] * unit.indentation;
            let error = model.loading.segment(&model.pair, depth).force(depth) / (point[2] * unit.force) - 1.0;
            (count, squares) = (count + 1.0, squares + error * error);
            if error.abs() > errors.worst.abs() {
                (errors.worst, errors.worst_at) = (error, point[0]);
            }
        }
        assert!(count > 250.0, "the curve is complete");
        Errors { rms: (squares / count).sqrt(), ..errors }
    }

    fn place(&self) -> f64 {
        format!("{:.2e}", self.worst_at).parse().expect("a number")
    }
}

/// The errors of a loading law up to a thousand yield indentations, on the bodies of the default scene.
fn errors(name: &str) -> Errors {
    Errors::of(&model(name, at_small_strain(name), 0.0), &numbers("data/truth/loading.csv", ""), (0.0, f64::INFINITY))
}

/// The mild pair; for the law `brinell`, which is corrected for large strain, with so weak a target that the strain is small as in the
/// finite elements.
fn at_small_strain(name: &str) -> Pair {
    let pair = mild();
    if name == "brinell" { Pair { yield_strength: SMALL_STRAIN * pair.yield_strength, ..pair } } else { pair }
}

/// With strengths times this, the strain is small.
const SMALL_STRAIN: f64 = 1e-6;

/// The largest jump of the force, relative to it.
fn largest_jump(name: &str) -> f64 {
    let AnyModel { loading, pair, .. } = model(name, mild(), 0.0);
    let (mut largest, mut corner) = (0.0f64, loading.next_corner(&pair, 0.0));
    while corner < 1e4 * unit(&pair).indentation && corner < LARGEST_INDENTATION {
        let [below, above] = [corner.next_down(), corner].map(|depth| loading.segment(&pair, depth).force(depth));
        largest = larger(largest, (above - below) / above);
        corner = loading.next_corner(&pair, corner);
    }
    largest
}

/// The table of all loading laws.
fn all_laws() -> String {
    let mut table = heading(&["law", "worst error of the force", "rms", "jump", "energy", "measured rebounds"]);
    for (name, _) in AnyLoading::of_balls() {
        let law = entry("loading", name);
        let (errors, jump) = (errors(name), largest_jump(name));
        assert_eq!(jump.abs() > 1e-12, says(law, "jumps"), "{name} jumps by {jump:e}");
        let jump = if says(law, "jumps") { percent(jump, 1) } else { "none".into() };
        let from = passive_from(name, unloading_with(name));
        let energy = match law.get("energy").filter(|_| from != Some(-1.0)) {
            Some(energy) => {
                let below = from.map_or(String::new(), |ratio| format!(" for nu < {ratio}"));
                format!("restitution up to {:.3}{below}", energy["restitution"].as_float().expect("a number"))
            }
            None => "passive".into(),
        };
        let worst = format!("{} at {} d_y", percent(errors.worst, 1), errors.place());
        let energy = format!("{energy} (with `{}`)", unloading_with(name));
        table += &row(&[
            &format!("`{name}`"),
            &worst,
            &format!("{:.1} %", 100.0 * errors.rms),
            &jump,
            &energy,
            &rebounds(name),
        ]);
    }
    table
}

/// The worst error of the measured rebounds with a strength from the hardness; a dash for a law that doesn't yield.
fn rebounds(name: &str) -> String {
    if name == "hertz" { "-".into() } else { percent(devices::worst(name), 1) }
}

#[test]
fn the_table_of_errors_is_the_one_that_is_measured() {
    shows("laws.md", "errors", &all_laws());
}

/// +30 % at some 25 to 30 yield indentations was measured independently.
#[test]
fn the_errors_of_two_laws_are_those_of_an_independent_computation() {
    assert!((errors("big-alabo").worst - 0.308).abs() < 0.002);
    assert!(errors("brinell").worst.abs() < 0.005);
}

#[test]
fn the_accuracy_in_the_table_of_laws_is_the_measured_one() {
    let path = root().join("modelDescription/laws.toml");
    let mut table = fs::read_to_string(&path).expect("the table of laws");
    // that of a line contact is not measured on balls, and a curve of one's own is its file's
    for law in entries("loading").filter(|law| !["line", "table"].contains(&text(law, "name"))) {
        let (name, told) = (text(law, "name"), text(law, "accuracy"));
        let Errors { worst, rms, .. } = errors(name);
        let measured = format!("{} at {} d_y, rms {:.1} %", percent(worst, 1), errors(name).place(), 100.0 * rms);
        if is_writing() {
            let begin =
                table.find(&format!("[[loading]]\nname = \"{name}\"\n")).expect("an entry begins with its name");
            let place = begin + table[begin..].find("\nreference = ").expect("an entry has a reference") + 1;
            let line = format!("accuracy = \"{told}\"\n");
            let start = if told.is_empty() { place } else { place - line.len() };
            table.replace_range(start..place, &format!("accuracy = \"{measured}\"\n"));
        } else {
            assert_eq!(told, measured, "laws.toml, {name}; BRINELL_WRITE=1 writes it");
        }
    }
    if is_writing() {
        fs::write(path, table).expect("the table can be written");
    }
}

#[test]
fn the_errors_of_two_laws_in_the_readme_are_those_that_are_measured() {
    let page = read(Path::new("README.md")).split_whitespace().collect::<Vec<_>>().join(" ");
    let shown: Vec<&str> = page.split("differs by up to ").skip(1).filter_map(|rest| rest.split(" %").next()).collect();
    let measured = ["big-alabo", "brinell"].map(|name| percent(errors(name).worst, 1));
    assert_eq!(shown.iter().map(|number| format!("{number} %")).collect::<Vec<_>>(), measured);
}
