//! Contacts that share bodies, compared with a table from other integrations: `data/truth/bodies/`.

use crate::physics::{AnyModel, model, pair_of};
use brinell_contact::shared::{InverseMasses, Work, follow, work_of_step};
use brinell_contact::{History, Surface};
use brinell_testing::friction::file;
use std::collections::HashMap;

/// A row of the table.
struct Row {
    case: String,
    fields: HashMap<String, String>,
}

impl Row {
    fn text(&self, column: &str) -> Vec<&str> {
        self.fields[column].split_whitespace().collect()
    }

    fn get(&self, column: &str) -> Vec<f64> {
        self.text(column).iter().map(|number| number.parse().expect("a number")).collect()
    }

    fn one(&self, column: &str) -> f64 {
        self.get(column)[0]
    }

    fn models(&self) -> Vec<AnyModel> {
        let sizes = (self.get("E_star"), self.get("R"), self.get("S_y"));
        let laws = self.text("law").into_iter().enumerate();
        laws.map(|(index, law)| {
            let unloading = if law == "hertz" || law == "big-alabo" { "contact-radius" } else { law };
            // a law that never yields has no strength
            let strength = if sizes.2[index] > 0.0 { sizes.2[index] } else { 3e8 };
            AnyModel {
                pair: pair_of(sizes.1[index], sizes.0[index], strength),
                surface: Surface::Dented,
                ..model(law, unloading)
            }
        })
        .collect()
    }
}

/// The rows of one table.
fn table(name: &str) -> Vec<Row> {
    let text = file("data/truth/bodies/tables.csv");
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let columns: Vec<&str> = lines.next().expect("a line with the columns").split(',').collect();
    let rows = lines.map(|line| line.split(',').collect::<Vec<_>>()).filter(|fields| fields[0] == name);
    let named = |fields: Vec<&str>| {
        columns.iter().zip(fields).map(|(column, field)| (column.to_string(), field.to_string())).collect()
    };
    rows.map(|fields| Row { case: fields[1].to_string(), fields: named(fields) }).collect()
}

/// A contact at the start of a row.
fn start(model: &AnyModel, indentation: f64, largest: f64) -> History {
    let mut history = History::start(model, -largest.max(indentation)).expect("within range");
    history.advance(model, indentation - history.indentation()).expect("within range");
    history
}

#[test]
fn normal_contacts_end_a_step_as_in_the_table() {
    let mut worst = 0.0_f64;
    let rows = table("normal");
    assert_eq!(rows.len(), 98);
    for row in rows {
        let models = row.models();
        let count = models.len();
        let entries = row.get("W");
        let masses = InverseMasses::new(count, &entries).expect("a triangle");
        let (depths, dents) = (row.get("indentation_0"), row.get("max_indentation_0"));
        let mut contacts: Vec<History> = (0..count).map(|i| start(&models[i], depths[i], dents[i])).collect();
        let (accelerations, before) = (row.get("acceleration"), row.get("rate_0"));
        let (mut rates, step) = (before.clone(), row.one("step"));
        let mut work: Vec<Work<History>> = contacts.iter().map(|&contact| Work::new(contact)).collect();
        let elastic =
            |contacts: &[History]| -> f64 { contacts.iter().zip(&models).map(|(c, m)| c.elastic_energy(m)).sum() };
        let lost =
            |contacts: &[History]| -> f64 { contacts.iter().zip(&models).map(|(c, m)| c.dissipated_energy(m)).sum() };
        let stored = elastic(&contacts) + lost(&contacts);
        let model = |contact: usize| &models[contact];
        let case = &row.case;
        let outcome = follow(&mut contacts, model, &masses, &accelerations, &mut rates, &mut work, step);
        let outcome = outcome.unwrap_or_else(|refused| panic!("{case}: {refused:?}"));
        let largest = |numbers: &[f64]| numbers.iter().fold(0.0, |most: f64, number| most.max(number.abs()));
        let (elastic, lost) = (elastic(&contacts), lost(&contacts));
        let energy =
            (0..count).map(|i| 0.5 * before[i].powi(2) / masses.of(i, i)).fold(0.0, f64::max).max(elastic + lost);
        let close = |what: &str, found: f64, expected: f64, size: f64| -> f64 {
            let error = (found - expected).abs() / size;
            assert!(error <= 1e-9, "{case}: {what} {found:e}, not {expected:e}, an error of {error:.1e}");
            error
        };
        let most = (0..count).map(|i| masses.of(i, i)).fold(0.0, f64::max);
        let speed = (2.0 * energy * most).sqrt();
        let depth = largest(&row.get("indentation")).max(largest(&row.get("max_indentation")));
        let mut error = 0.0_f64;
        for i in 0..count {
            error = error.max(close(&format!("rate {i}"), rates[i], row.get("rate")[i], speed));
            error = error.max(close(
                &format!("indentation {i}"),
                contacts[i].indentation(),
                row.get("indentation")[i],
                depth,
            ));
            error = error.max(close(
                &format!("impulse {i}"),
                work[i].impulse(),
                row.get("impulse")[i],
                (2.0 * energy / masses.of(i, i)).sqrt(),
            ));
            // the table notes a dent when it is complete
            let dent = row.get("max_indentation")[i].max(row.get("indentation")[i]);
            if row.get("max_indentation")[i] != 0.0 {
                error = error.max(close(&format!("dent {i}"), contacts[i].max_indentation(), dent, depth));
            }
        }
        error = error.max(close("elastic", elastic, row.one("elastic"), energy));
        error = error.max(close("dissipated", lost, row.one("dissipated"), energy));
        let balance = work_of_step(&work, &masses, &before, &accelerations, step) - (elastic + lost - stored);
        error = error.max(close("balance", balance, 0.0, energy));
        println!(
            "{case} {count} {} events, {} evaluations: {error:.1e}, the table {:.1e}",
            row.one("events"),
            outcome.evaluations,
            row.one("error")
        );
        worst = worst.max(error);
    }
    println!("worst error: {worst:.1e}");
}
