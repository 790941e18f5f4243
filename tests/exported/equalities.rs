//! Scenes that say the same have the same impact: `equalities.txt`. That their FMUs do what is predicted is said of any scene.

use brinell_contact::impact::Prediction;
use brinell_exporter::scene::Scene;
use brinell_testing::table::{Table, altered};
use std::path::Path;

/// The impact on the first contact of the scene with this name and these edits.
fn predicted(table: &Table, case: &[&str]) -> Prediction {
    let text = altered(&table.files()[case[0].trim()], &case[1..]);
    let scene =
        Scene::parse(text.clone(), Path::new("scene.toml")).unwrap_or_else(|mistake| panic!("{mistake}\n{text}"));
    scene.predictions[0]
}

/// What the impacts differ by, where that is more than the words of the table allow.
fn said(table: &Table, parts: &[&str], words: &str) -> String {
    let all = parts.join(" =>");
    let (one, other) = all.split_once(" == ").expect("two scenes");
    let [one, other] = [one, other].map(|case| predicted(table, &case.split(" =>").collect::<Vec<_>>()));
    let (within, factor) =
        words.strip_prefix("within ").and_then(|rest| rest.split_once(", ")).unwrap_or((&words[7..], "1 "));
    let factor: f64 = factor.split(' ').next().expect("a number").parse().expect("a number");
    let within: f64 = within.parse().expect("a number");
    let numbers = |one: &Prediction| {
        [one.max_indentation, one.max_contact_radius, one.residual_indentation, one.restitution, one.contact_time()]
    };
    let pairs = numbers(&one).into_iter().zip(numbers(&other)).chain([(one.max_force, factor * other.max_force)]);
    let largest =
        pairs.map(|(one, other)| (one - other).abs() / other.abs().max(f64::MIN_POSITIVE)).fold(0.0, f64::max);
    if largest <= within { words.into() } else { format!("within {largest:.1e}: {one:?} and {other:?}") }
}

#[test]
fn scenes_that_say_the_same_have_the_same_impact() {
    let table = Table::read("tests/exported/equalities.txt");
    table.check(|parts, words| said(&table, parts, words));
}
