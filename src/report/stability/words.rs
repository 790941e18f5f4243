//! Stability as text and as JSON.

use super::limit::Limit;
use super::{MATTERS, RANGE, Stability};
use crate::numbers::quantity;
use crate::report::ways::{LATE, LEAP_FROG, Way};
use serde_json::{Value, json};

impl Limit {
    /// The stable range.
    pub fn words(self) -> &'static str {
        match self {
            Limit::None => "at no step that was tried",
            Limit::Upto(_) => "up to a step",
            Limit::Every => "at every step that was tried",
        }
    }

    /// As a number; `None` if no step is stable, and if every step is.
    fn step(self) -> Option<f64> {
        if let Limit::Upto(limit) = self { Some(limit) } else { None }
    }
}

impl Stability {
    /// The limit of a way, if it was measured.
    fn limit(&self, way: &str) -> Option<Limit> {
        self.lines.iter().find(|line| line.way.name == way).map(|line| line.limit)
    }

    /// The largest stable step of a way, in words.
    pub fn largest_step(&self, way: &Way) -> String {
        match self.limit(way.name) {
            Some(Limit::Upto(limit)) => quantity(limit / self.frequency, "s"),
            Some(Limit::Every) => "any".into(),
            Some(Limit::None) | None => "none".into(),
        }
    }

    /// The steps from which rebounds gain a relevant energy.
    pub fn sentence(&self) -> Option<String> {
        let gains = self.lines.iter().filter_map(|line| {
            let first = line.energies.iter().find(|energy| energy.highest > MATTERS)?;
            Some(format!("{} from {}", line.way.name, quantity(first.relative / self.frequency, "s")))
        });
        let gains: Vec<_> = gains.collect();
        let percent = 100.0 * (MATTERS - 1.0);
        (!gains.is_empty()).then(|| {
            format!("Rebounds can gain more than {percent:.0} % of energy at large steps: {}.", gains.join(", "))
        })
    }

    /// JSON; two ways have keys of their own in addition to the list of all ways.
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
