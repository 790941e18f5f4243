//! The choice of a coupling: for each way, its conditions and the steps for errors of 1 % and 0.1 %.

use super::precision::{Line, Point};
use super::stability::Stability;
use super::ways::{Master, Way};
use crate::numbers::{quantity, significant};
use serde_json::{Value, json};
use std::fmt::Write;

/// Errors of restitution for which steps are given. The recommendation depends on the cost at the first one.
const GOALS: [f64; 2] = [0.01, 0.001];

/// Largest error of a way that is called exact.
const EXACT: f64 = 1e-9;

/// A way to couple.
struct Row<'a> {
    way: &'static Way,
    /// The largest step for each of the goals.
    steps: [Option<&'a Point>; 2],
    /// Exact to rounding for every step.
    exact: bool,
    /// The largest stable step, in words.
    stable: String,
    recommended: bool,
}

/// All ways to couple.
pub struct Choice<'a>(Vec<Row<'a>>);

impl Choice<'_> {
    /// The choice among the measured ways.
    pub fn of<'a>(lines: &'a [Line], stability: &Stability) -> Choice<'a> {
        let own = lines.iter().filter(|line| line.peer.is_none());
        let row = |line: &'a Line| {
            let way = line.way?;
            let exact = line.points.iter().all(|point| point.restitution < EXACT);
            let steps = GOALS.map(|goal| line.step_for(goal));
            Some(Row { way, steps, exact, stable: stability.largest_step(way), recommended: false })
        };
        let mut rows: Vec<Row> = own.filter_map(row).collect();
        for master in [Master::Serial, Master::Parallel] {
            let candidates = rows.iter_mut().filter(|row| row.way.master == master && row.steps[0].is_some());
            let time = |row: &Row| row.steps[0].map_or(f64::INFINITY, |point| point.run_time);
            if let Some(best) = candidates.min_by(|one, other| time(one).total_cmp(&time(other))) {
                best.recommended = true;
            }
        }
        Choice(rows)
    }

    fn recommended(&self) -> impl Iterator<Item = (&Row<'_>, &Point)> {
        self.0.iter().filter(|row| row.recommended).filter_map(|row| Some((row, row.steps[0]?)))
    }

    /// The recommendations as sentences, including one for slow calls.
    pub fn sentences(&self) -> Vec<String> {
        let mut recommended: Vec<_> = self.recommended().collect();
        recommended.sort_by_key(|(row, _)| row.way.master == Master::Parallel);
        let mut sentences: Vec<String> = recommended
            .into_iter()
            .map(|(row, point)| {
                format!(
                    "For a {} master: {}, {} steps per contact ({}). Expected error of restitution {} %, largest stable step {}.",
                    row.way.master.name(),
                    row.way.name,
                    point.steps,
                    quantity(point.step, "s"),
                    significant(100.0 * point.restitution, 2),
                    row.stable
                )
            })
            .collect();
        sentences.extend(self.slow_calls());
        sentences
    }

    /// Cost of a call above which the exact ways are the cheapest, because they need few calls.
    fn slow_calls(&self) -> Option<String> {
        let mut least = f64::INFINITY;
        let saved = self.recommended().filter(|(row, _)| !row.exact).filter_map(|(row, point)| {
            let exact = self.0.iter().find(|other| other.exact && other.way.master == row.way.master)?;
            let few = exact.steps[0].filter(|few| few.calls < point.calls)?;
            least = least.min((few.run_time - point.run_time) / (point.calls - few.calls));
            Some(format!("{}: {:.0} calls per impact instead of {:.0}", exact.way.name, few.calls, point.calls))
        });
        let saved: Vec<_> = saved.collect();
        let when = match least {
            _ if saved.is_empty() => return None,
            least if least > 0.0 => {
                format!("If your tool spends more than {} on each call, as Python does", quantity(least, "s"))
            }
            _ => "Cheaper still".into(),
        };
        Some(format!(
            "{when}, use an FMU that knows the mass. {}. It is exact and stable at any step.",
            saved.join("; ")
        ))
    }

    /// JSON.
    pub fn json(&self) -> Value {
        let step = |point: &Option<&Point>| {
            point.map(|point| {
                json!({ "steps_per_contact": point.steps, "step_s": point.step, "error_of_restitution": point.restitution,
                        "calls_per_impact": point.calls, "time_per_impact_s": point.run_time })
            })
        };
        let row = |row: &Row| {
            json!({ "way": row.way.name, "master": row.way.master.name(), "recommended": row.recommended,
                    "exact": row.exact, "one_percent": step(&row.steps[0]), "a_tenth_of_a_percent": step(&row.steps[1]) })
        };
        self.0.iter().map(row).collect()
    }

    /// The table as HTML.
    pub fn html(&self) -> String {
        let mut table = String::from(
            "<div class=\"table\">\n<table class=\"choice\">\n<thead><tr><th>Way</th><th>Master</th><th>What the master does</th>\
             <th>Step for 1 %</th><th>Step for 0.1 %</th><th>Largest stable step</th><th>Time per impact at 1 %</th>\
             <th>Calls per impact at 1 %</th></tr></thead>\n<tbody>\n",
        );
        for row in &self.0 {
            row.write(&mut table).expect("a String takes everything");
        }
        table.push_str("</tbody>\n</table>\n</div>\n");
        table
    }
}

impl Row<'_> {
    fn write(&self, table: &mut String) -> std::fmt::Result {
        let Row { way, steps, exact, stable, recommended } = self;
        let (class, mark) = if *recommended { (" class=\"best\"", " <strong>recommended</strong>") } else { ("", "") };
        let step = |point: &Option<&Point>| match point {
            _ if *exact => "any".into(),
            Some(point) => format!("{} ({} per contact)", quantity(point.step, "s"), point.steps),
            None => "none tried".into(),
        };
        let cost = |of: &dyn Fn(&Point) -> String| steps[0].map_or_else(|| "-".into(), of);
        writeln!(
            table,
            "<tr{class}><td>{}{mark}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{stable}</td><td>{}</td><td>{}</td></tr>",
            way.name,
            way.master.name(),
            way.what,
            step(&steps[0]),
            step(&steps[1]),
            cost(&|point| quantity(point.run_time, "s")),
            cost(&|point| format!("{:.0}", point.calls))
        )
    }
}
