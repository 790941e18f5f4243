//! The laws side by side for one impact: the spread is what a user can't know without a measurement.

use super::Part;
use super::data::{Table, number, text};
use crate::curve;
use crate::documentation::{digits, escape};
use crate::laws::{Choice, choose};
use crate::predict;
use crate::scene::Scene;
use brinell::contact::loading::AnyLoading;

/// The impact of `scene` by every law that its bodies can have.
pub fn part(scene: &Scene) -> Part {
    let mut choices: Vec<Choice> = choose(scene, &[]).unwrap_or_default();
    let mut left_out = Vec::new();
    let own = choices.first().map(|choice| choice.name.clone()).unwrap_or_default();
    for (name, _) in AnyLoading::ALL.iter().filter(|(name, _)| *name != own) {
        match choose(scene, &[(*name).to_string()]) {
            Ok(more) => choices.extend(more),
            Err(error) => left_out.push(error.to_string()),
        }
    }
    let columns = [("law", ""), ("restitution", ""), ("largest force", "N"), ("dent", "m"), ("contact time", "s")];
    let mut table = Table::new("laws", columns);
    let (mut low, mut high, mut deepest) = (f64::INFINITY, 0.0, 0.0);
    choices.retain(|choice| match predict::one(choice, &scene.impact) {
        Err(error) => {
            left_out.push(error.to_string());
            false
        }
        Ok(prediction) => {
            // Hertz's law loses nothing, which is no opinion on what a target that yields does
            if choice.name != "hertz" || own == "hertz" {
                (low, high) = (f64::min(low, prediction.restitution), f64::max(high, prediction.restitution));
            }
            if choice.name == own {
                deepest = prediction.max_indentation;
            }
            table.rows.push(vec![
                text(&choice.name),
                number(prediction.restitution),
                number(prediction.max_force),
                number(prediction.residual_indentation),
                number(prediction.contact_time()),
            ]);
            true
        }
    });
    let mut words = format!(
        "The same impact by {} laws, the scene's first: restitution from {} to {} (Hertz's law for a target that yields not \
         counted). The curves go to the largest indentation of the scene's law; dots are finite elements.",
        table.rows.len(),
        digits(low),
        digits(high)
    );
    for reason in left_out {
        words.push_str(&format!(" Left out: {}.", escape(&reason)));
    }
    let pictures = match curve::svg(&choices, deepest, &scene.impact, true) {
        Ok(svg) => vec![("laws", svg)],
        Err(brinell::contact::TooDeep { .. }) => {
            words.push_str(" There is no picture: a law can't be evaluated as deep as that.");
            Vec::new()
        }
    };
    Part { title: "Laws side by side", words, pictures, tables: vec![table] }
}
