//! Stability in words, and for programs.

use super::limit::Limit;
use super::{Line, MATTERS, RANGE, Stability};
use crate::numbers::{digits, significant};
use crate::report::ways::{LATE, LEAP_FROG, MASS_KNOWN};
use serde_json::{Value, json};

impl Limit {
    /// Where it is stable.
    pub fn words(self) -> &'static str {
        match self {
            Limit::None => "at no step that was tried",
            Limit::Upto(_) => "up to a step",
            Limit::Every => "at every step that was tried",
        }
    }

    /// As a number: none if there is no such step, and none if no step is too large.
    fn step(self) -> Option<f64> {
        if let Limit::Upto(limit) = self { Some(limit) } else { None }
    }
}

impl Stability {
    /// The limit of a way, if it was measured.
    fn limit(&self, way: &str) -> Option<Limit> {
        self.lines.iter().find(|line| line.way.name == way).map(|line| line.limit)
    }

    /// Up to which step each way is stable, and what to change to go further.
    pub fn sentences(&self) -> Vec<String> {
        let told = |relative: f64| format!("{} s (h sqrt(K/m) = {relative:.3})", digits(relative / self.frequency));
        let sentence = |line: &Line| {
            let begin = format!("With {}, a pressed body stays at rest", line.way.name);
            match line.limit {
                Limit::Upto(limit) => format!("{begin} up to a step of {}.", told(limit)),
                Limit::Every => format!("{begin} at every step that was tried, the largest {}.", told(RANGE.1)),
                Limit::None => {
                    let smallest = told(RANGE.0);
                    format!("{begin} at no step that was tried, the smallest {smallest}{}.", self.instead())
                }
            }
        };
        let mut sentences: Vec<String> = self.lines.iter().map(sentence).collect();
        if self.lines.iter().any(|line| matches!(line.limit, Limit::Upto(_))) {
            let knows = matches!(self.limit(MASS_KNOWN.name), Some(Limit::Every));
            let unit = if knows { "a unit that knows the mass, " } else { "" };
            sentences.push(format!(
                "For bigger stable steps choose {unit}a larger mass or a softer contact: the limits grow as sqrt(m/K)."
            ));
        }
        sentences.push(self.energy());
        sentences
    }

    /// What to use where a way is stable at no step.
    fn instead(&self) -> String {
        let others = self.lines.iter().filter(|line| !matches!(line.limit, Limit::None));
        match others.map(|line| line.way.name).collect::<Vec<_>>().as_slice() {
            [] => String::new(),
            others => format!(": use {} instead", others.join(" or ")),
        }
    }

    /// From which steps on rebounds make energy that matters.
    fn energy(&self) -> String {
        let makes = self.lines.iter().filter_map(|line| {
            let first = line.energies.iter().find(|energy| energy.highest > MATTERS)?;
            let step = first.relative / self.frequency;
            Some(format!("with {} from a step of {} s on", line.way.name, significant(step, 2)))
        });
        let makes: Vec<_> = makes.collect();
        let energy = format!("over {:.0} % more energy than came in", 100.0 * (MATTERS - 1.0));
        if makes.is_empty() {
            return format!("At no step that was tried does a rebound have {energy}.");
        }
        format!("A rebound can have {energy} {}.", makes.join(", "))
    }

    /// For programs; the two ways that have keys of their own have them beside the list of all.
    pub fn json(&self) -> Value {
        let of = |way: &str| self.limit(way).and_then(Limit::step);
        let stable: Vec<_> = self
            .lines
            .iter()
            .map(|line| {
                let limit = line.limit.step();
                let theory = Some(line.way.stable).filter(|limit| limit.is_finite());
                json!({ "way": line.way.name, "stable": line.limit.words(), "h_sqrt(K/m)": limit,
                        "step_s": limit.map(|limit| limit / self.frequency), "elastic_theory": theory })
            })
            .collect();
        json!({
            "largest_stiffness_N_per_m": self.stiffness,
            "stable_leap_frog": of(LEAP_FROG.name),
            "stable_late": of(LATE.name),
            "stable": stable,
            "tried_h_sqrt(K/m)": [RANGE.0, RANGE.1],
        })
    }
}
