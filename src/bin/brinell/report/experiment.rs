//! Published measurements beside every law: rebound hardness devices on steel.

use super::data::{Cell, Table, number, text};
use super::{Figure, Part};
use crate::experiment;
use crate::law_list::experiment::{Experiment, WITH_RATE, all, fitted, grid};
use crate::laws::{published, unloading_of};
use crate::plot::{Picture, Series, View};
use crate::scene::Rate;
use brinell::contact::loading::AnyLoading;

/// Name of the data, and of the law with the fitted rate constant, in pictures.
const MEASURED: &str = "measured";
const FITTED: &str = "brinell, rate";

/// The laws that stand out in the picture: the two that the guide recommends or has as default, with and without rate.
const STRONG: [&str; 4] = [MEASURED, FITTED, WITH_RATE, "big-alabo"];

/// The section of the report.
pub fn part() -> Part {
    let found = all();
    let c = fitted();
    Part {
        title: "Laws beside measurements",
        words: format!(
            "Not this scene, but a carbide ball of 3 mm at 2.05 m/s on steel (rebound hardness device D). Every law has the yield \
             strength HV/3, and none was fitted to these rebounds, which are known to +-0.012. With HV/3 {WITH_RATE} rebounds too \
             little. A strength that grows with the strain rate, with the one constant c = {c:.3} fitted to the whole curve, explains \
             it; the constants of the literature do not. A law that is close may be so for the wrong reason: an error of its \
             quasi-static force may make up for the missing rate."
        ),
        figures: vec![figure(c)],
        switches: Vec::new(),
        method: String::from(
            "The same numbers as <code>brinell laws --experiment</code>; sources and accuracy are in <code>experiment/README.md</code> \
             of the project. S is the factor of HV/3 that gives the measured rebound. Dents: the printed diameter and depth, and by \
             each law the diameter under the load and the depth after it. The printed depths are those of caps with the printed \
             diameters, with two digits. The factor of about 1.3 that mends the rebound of brinell makes its dents shallower than \
             printed, and brings their diameters closer; so the depths are no evidence against it.",
        ),
        tables: vec![rebounds(&found), rates(&found), dents(&found)],
    }
}

/// Restitution over hardness: every law, the law with a rate, and the measured curve.
fn figure(c: f64) -> Figure {
    let line = |label: &str, of: &dyn Fn(f64) -> Option<f64>| Series {
        label: label.into(),
        points: grid().map(|hardness| (hardness, of(hardness).unwrap_or(f64::NAN))).collect(),
        dots: false,
    };
    let law = |(name, loading): (&'static str, AnyLoading)| {
        line(name, &|vickers| {
            experiment::restitution_by(loading, unloading_of(name).1, experiment::strength_of(vickers))
        })
    };
    let mut series: Vec<_> = AnyLoading::ALL.into_iter().filter(|(name, _)| *name != "hertz").map(law).collect();
    let rate = Rate::JohnsonCook { c, reference_rate: 1.0 };
    let (loading, unloading) = (published(WITH_RATE), unloading_of(WITH_RATE).1);
    series.push(line(FITTED, &|vickers| Some(experiment::with_rate(loading, unloading, &rate, vickers)?.0)));
    series.push(Series { dots: true, ..line(MEASURED, &experiment::restitution) });
    let picture = Picture {
        x_title: "Vickers hardness [HV]".into(),
        y_title: "restitution".into(),
        logarithmic: (false, false),
        series,
    };
    let view = View { strong: Some(STRONG.map(String::from).to_vec()), values: Some(0.2..1.05), ..View::default() };
    let caption = "Restitution over hardness: measured, and by every law with HV/3".into();
    Figure { name: "experiment", caption, svg: picture.labelled(700, 400, &view), folded: false }
}

fn cell(value: Option<f64>) -> Cell {
    value.map_or(Cell::Empty, number)
}

/// Restitution and necessary strength.
fn rebounds(found: &Experiment) -> Table {
    let columns = [
        ("law", ""),
        ("unloading", ""),
        ("restitution 300 HV", ""),
        ("restitution 600 HV", ""),
        ("restitution 800 HV", ""),
        ("worst error", ""),
        ("S 300 HV", ""),
        ("S 600 HV", ""),
        ("S 800 HV", ""),
    ];
    let mut table = Table::new("experiment-rebounds", columns);
    let mut first = vec![text(MEASURED), text("")];
    first.extend(found.restitution.map(number));
    first.extend((0..4).map(|_| Cell::Empty));
    table.rows.push(first);
    for law in &found.laws {
        let mut row = vec![text(law.name), text(law.unloading)];
        row.extend(law.restitution.map(cell));
        row.push(number(law.worst_restitution));
        row.extend(law.strength_factor.map(cell));
        table.rows.push(row);
    }
    table
}

/// The law with a strain rate.
fn rates(found: &Experiment) -> Table {
    let columns = [
        ("rate of brinell", ""),
        ("restitution 300 HV", ""),
        ("restitution 600 HV", ""),
        ("restitution 800 HV", ""),
        ("worst error 250-800 HV", ""),
        ("S 300 HV", ""),
        ("S 600 HV", ""),
        ("S 800 HV", ""),
    ];
    let mut table = Table::new("experiment-rates", columns);
    for rated in &found.rates {
        let mut row = vec![text(rated.model.clone())];
        row.extend(rated.restitution.map(cell));
        row.push(number(rated.worst_restitution));
        row.extend(rated.factor.map(cell));
        table.rows.push(row);
    }
    table
}

/// The dents of all devices.
fn dents(found: &Experiment) -> Table {
    let columns = [
        ("law", ""),
        ("device", ""),
        ("hardness", "HV"),
        ("printed diameter", "m"),
        ("diameter", "m"),
        ("printed depth", "m"),
        ("depth", "m"),
    ];
    let mut table = Table::new("experiment-dents", columns);
    for law in &found.laws {
        for (printed, said) in found.dents.iter().zip(&law.dents) {
            table.rows.push(vec![
                text(law.name),
                text(printed.device),
                number(printed.hardness),
                number(printed.diameter),
                cell(said.map(|[diameter, _]| diameter)),
                number(printed.depth),
                cell(said.map(|[_, depth]| depth)),
            ]);
        }
    }
    // two hundred rows
    table.on_page = false;
    table
}
