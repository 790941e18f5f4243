//! Contacts that share bodies, compared with a table from other integrations: `data/truth/bodies/`.

use crate::physics::{AnyModel, model, pair_of};
use brinell_contact::loading::AnyLoading;
use brinell_contact::losses::{self, Form, Growth, Loss};
use brinell_contact::shared::{InverseMasses, SharedContact, Work, follow, work_of_step};
use brinell_contact::tangential::{Friction, Frictional, FrictionalModel};
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Contact, History, Surface};
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

/// A loss with a given factor.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Given {
    form: Form,
    factor: f64,
}

impl Loss for Given {
    const FOLLOWS_RATE: bool = true;

    fn form(&self) -> Form {
        self.form
    }

    fn factor(&self) -> f64 {
        self.factor
    }
}

impl Row {
    /// The models with the losses of the row.
    fn losing_models(&self) -> Vec<losses::Model<AnyLoading, AnyUnloading, Given>> {
        let factors = self.get("loss_factor");
        let forms = self.text("loss").into_iter().zip(factors).map(|(loss, factor)| {
            let form = match loss {
                "fitted" => Form::Proportional,
                "waves" => Form::Viscous(Growth::Square),
                "plate" => Form::Mobility,
                other => panic!("no loss {other}"),
            };
            Given { form, factor }
        });
        self.models().into_iter().zip(forms).map(|(plastic, loss)| losses::Model { plastic, loss }).collect()
    }

    /// Follows the motion of `contacts` from the start of the row in so many `parts`, and compares the end. `heat` gives the
    /// energy that is lost without yield [J].
    fn run<M, C: Contact<M> + SharedContact<M>>(
        &self,
        models: &[M],
        mut contacts: Vec<C>,
        heat: impl Fn(&C) -> f64,
        parts: u32,
    ) {
        let (case, count) = (&self.case, models.len());
        let entries = self.get("W");
        let masses = InverseMasses::new(count, &entries).expect("a triangle");
        let (accelerations, before) = (self.get("acceleration"), self.get("rate_0"));
        let (mut rates, step) = (before.clone(), self.one("step") / f64::from(parts));
        let mut work: Vec<Work<C>> = contacts.iter().map(|&contact| Work::new(contact)).collect();
        let sum = |contacts: &[C], of: &dyn Fn(&C, &M) -> f64| -> f64 {
            contacts.iter().zip(models).map(|(contact, model)| of(contact, model)).sum()
        };
        let elastic = |contacts: &[C]| sum(contacts, &|contact, model| contact.elastic_energy(model));
        let lost = |contacts: &[C]| sum(contacts, &|contact, model| contact.dissipated_energy(model));
        let mut balance = elastic(&contacts) + lost(&contacts);
        let (mut impulses, mut evaluations) = (vec![0.0; count], 0);
        for _ in 0..parts {
            let model = |contact: usize| &models[contact];
            let start = rates.clone();
            let outcome = follow(&mut contacts, model, &masses, &accelerations, &mut rates, &mut work, step);
            evaluations += outcome.unwrap_or_else(|refused| panic!("{case}: {refused:?}")).evaluations;
            balance += work_of_step(&work, (&start, &rates), &accelerations, step);
            impulses.iter_mut().zip(&work).for_each(|(sum, work)| *sum += work.impulse());
        }
        let largest = |numbers: &[f64]| numbers.iter().fold(0.0, |most: f64, number| most.max(number.abs()));
        let (elastic, lost) = (elastic(&contacts), lost(&contacts));
        let heat = contacts.iter().map(heat).sum::<f64>();
        let moving = (0..count).map(|i| 0.5 * before[i].powi(2) / masses.of(i, i)).fold(0.0, f64::max);
        let energy = moving.max(elastic + lost);
        let most = (0..count).map(|i| masses.of(i, i)).fold(0.0, f64::max);
        let speed = (2.0 * energy * most).sqrt();
        let depth = largest(&self.get("indentation")).max(largest(&self.get("max_indentation")));
        let mut error = 0.0_f64;
        let mut close = |what: &str, found: f64, expected: f64, size: f64| {
            let off = (found - expected).abs() / size;
            assert!(off <= 1e-9, "{case}: {what} {found:e}, not {expected:e}, an error of {off:.1e}");
            error = error.max(off);
        };
        for i in 0..count {
            close(&format!("rate {i}"), rates[i], self.get("rate")[i], speed);
            close(&format!("indentation {i}"), contacts[i].indentation(), self.get("indentation")[i], depth);
            // redundant contacts that rattle for long share their impulse by chance
            let impulse = |given: &dyn Fn(usize) -> f64| (0..count).map(|j| masses.of(i, j) * given(j)).sum::<f64>();
            let (found, expected) = (impulse(&|j| impulses[j]), impulse(&|j| self.get("impulse")[j]));
            close(&format!("change of rate {i}"), found, expected, speed.max(expected.abs()));
            // the table notes a dent when it is complete
            let dent = self.get("max_indentation")[i].max(self.get("indentation")[i]);
            if self.get("max_indentation")[i] != 0.0 {
                close(&format!("dent {i}"), contacts[i].max_indentation(), dent, depth);
            }
        }
        close("elastic", elastic, self.one("elastic"), energy);
        close("dissipated", lost - heat, self.one("dissipated"), energy);
        if let Some(expected) = self.get("heat").first() {
            close("heat", heat, *expected, energy);
        }
        close("balance", balance, elastic + lost, energy);
        println!(
            "{case}, {count} contacts, {} events: {} evaluations, an error of {error:.1e}, of the table {:.1e}",
            self.one("events"),
            evaluations,
            self.one("error")
        );
    }
}

#[test]
fn normal_contacts_end_a_step_as_in_the_table() {
    let rows = table("normal");
    assert_eq!(rows.len(), 98);
    for row in rows {
        for parts in [1, 17] {
            let models = row.models();
            let (depths, dents) = (row.get("indentation_0"), row.get("max_indentation_0"));
            let contacts = (0..models.len()).map(|i| start(&models[i], depths[i], dents[i])).collect();
            row.run(&models, contacts, |_| 0.0, parts);
        }
    }
}

#[test]
fn contacts_with_losses_end_a_step_as_in_the_table() {
    for name in ["losses", "rest"] {
        for row in table(name) {
            for parts in [1, 17] {
                let models = row.losing_models();
                let depths = row.get("indentation_0");
                let start = |i: usize| losses::History::start(&models[i], -depths[i]).expect("within range");
                row.run(&models, (0..models.len()).map(start).collect(), losses::History::heat, parts);
            }
        }
    }
}

/// How far the motion of `contacts` with friction ends from the row, over the largest rate that the energy allows, followed in so
/// many `parts`: the largest error of a rate, and that of the balance of work.
fn off<const D: usize>(row: &Row, parts: u32) -> (f64, f64) {
    let (mu, kappa) = (row.get("mu"), row.get("kappa"));
    let models = row.models().into_iter().enumerate().map(|(i, normal)| FrictionalModel {
        normal,
        friction: Friction { coefficient: mu[i], stiffness_ratio: kappa[i] * mu[i] },
        loss: (),
    });
    let models: Vec<_> = models.collect();
    let (count, depths) = (models.len(), row.get("indentation_0"));
    let entries = row.get("W");
    let masses = InverseMasses::new(count * (1 + D), &entries).expect("a triangle");
    let start = |i: usize| Frictional::<D, 16, true>::start(&models[i], -depths[i]).expect("within range");
    let mut contacts: Vec<_> = (0..count).map(start).collect();
    let (accelerations, before) = (row.get("acceleration"), row.get("rate_0"));
    let (mut rates, step) = (before.clone(), row.one("step") / f64::from(parts));
    let mut work: Vec<_> = contacts.iter().map(|&contact| Work::new(contact)).collect();
    let taken_up = |contacts: &[Frictional<D, 16, true>]| -> f64 {
        let of = |(contact, model): (&Frictional<D, 16, true>, &FrictionalModel<_, _>)| {
            contact.elastic_energy(model)
                + contact.dissipated_energy(model)
                + contact.tangential_energy(model)
                + contact.friction_work(model)
        };
        contacts.iter().zip(&models).map(of).sum()
    };
    let (mut balance, mut evaluations) = (taken_up(&contacts), 0);
    for _ in 0..parts {
        let start = rates.clone();
        let model = |contact: usize| &models[contact];
        let outcome = follow(&mut contacts, model, &masses, &accelerations, &mut rates, &mut work, step);
        evaluations += outcome.unwrap_or_else(|refused| panic!("{}: {refused:?}", row.case)).evaluations;
        balance += work_of_step(&work, (&start, &rates), &accelerations, step);
    }
    let energy = (0..before.len()).map(|i| 0.5 * before[i].powi(2) / masses.of(i, i)).fold(balance, f64::max);
    let most = (0..before.len()).map(|i| masses.of(i, i)).fold(0.0, f64::max);
    let expected = row.get("rate");
    let error = rates.iter().zip(&expected).map(|(found, expected)| (found - expected).abs()).fold(0.0, f64::max);
    let (error, balance) = (error / (2.0 * energy * most).sqrt(), (balance - taken_up(&contacts)).abs() / energy);
    println!("{}, {parts} parts: {evaluations} evaluations, error {error:.1e}, balance {balance:.1e}", row.case);
    (error, balance)
}

#[test]
fn contacts_with_friction_end_a_step_as_in_the_table() {
    let (mut all, mut elastic) = (Vec::new(), Vec::new());
    // the bounds that are promised
    for (name, most) in [("friction", 5e-6), ("dents", 3e-4), ("plane", 1e-3)] {
        for row in table(name) {
            for parts in [1, 17] {
                let (error, balance) = match name {
                    "plane" => off::<2>(&row, parts),
                    _ => off::<1>(&row, parts),
                };
                all.push((error / most, balance));
                if name == "friction" {
                    elastic.push(error);
                }
            }
        }
    }
    assert!(all.iter().all(|&(error, balance)| error < 1.0 && balance < 1e-10));
    elastic.sort_by(f64::total_cmp);
    let [median, most] = [50, 90].map(|part| elastic[elastic.len() * part / 100]);
    println!("contacts that don't yield: median {median:.1e}, 90 % below {most:.1e}");
    assert!(median < 2e-7 && most < 1e-6, "{median:.1e}, {most:.1e}");
}
