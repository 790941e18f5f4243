//! The summary: what step and coupling to use, and what to expect of them.

use super::precision::Line;
use super::stability::Stability;
use crate::numbers::{digits, significant};
use brinell::contact::impact::Prediction;
use serde_json::{Value, json};

/// The error of restitution that a step is recommended for.
const GOAL: f64 = 0.01;

/// What to do: for every way the step that keeps the error below the goal, the fewest calls first.
pub fn summarize(
    all: &[Line],
    stability: &Stability,
    prediction: &Prediction,
    (judged, failed): (usize, usize),
) -> (Vec<String>, Value) {
    let own = all.iter().filter(|line| line.peer.is_none());
    let lines: Vec<_> = own.filter_map(|line| Some((line.way?, line.step_for(GOAL)))).collect();
    let mut good: Vec<_> = lines.iter().filter_map(|(way, point)| Some((*way, (*point)?))).collect();
    good.sort_by(|one, other| one.1.calls.total_cmp(&other.1.calls));
    let mut summary: Vec<String> = good
        .iter()
        .enumerate()
        .map(|(place, (way, point))| {
            let verb = if place == 0 { "Use" } else { "Or" };
            format!(
                "{verb} {} ({}) with steps of {} s, {} per contact: expect an error of restitution of {} % with {:.0} calls, \
                 which take {} us, per impact.",
                way.name,
                way.what,
                digits(point.step),
                point.steps,
                significant(100.0 * point.restitution, 2),
                point.calls,
                significant(1e6 * point.run_time, 2)
            )
        })
        .collect();
    for (way, _) in lines.iter().filter(|(_, point)| point.is_none()) {
        summary.push(format!("With {}, no step that was tried keeps the error of restitution below 1 %.", way.name));
    }
    summary.extend(stability.sentences());
    summary.push(format!("{} of {judged} stiff and extreme cases are right.", judged - failed));
    let ways: Vec<_> = good
        .iter()
        .map(|(way, point)| {
            json!({ "way": way.name, "step_s": point.step, "steps_per_contact": point.steps,
                    "error_of_restitution": point.restitution, "calls_per_impact": point.calls })
        })
        .collect();
    let mut used = json!({
        "goal": GOAL,
        "ways": ways,
        "restitution": prediction.restitution,
        "contact_time_s": prediction.contact_time(),
    });
    if let (Value::Object(used), Value::Object(stable)) = (&mut used, stability.json()) {
        used.extend(stable);
    }
    (summary, used)
}
