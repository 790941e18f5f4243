//! The summary: what step and coupling to use, and what to expect of them.

use super::precision::{ALONE, Line};
use super::stability::Stability;
use super::ways;
use crate::documentation::digits;
use brinell::contact::impact::Prediction;
use serde_json::{Value, json};

/// The error of restitution that a step is recommended for.
const GOAL: f64 = 0.01;

/// What to do: for every way the step that keeps the error below the goal, the fewest calls first.
pub fn summarize(
    all: &[Line],
    stability: &Stability,
    prediction: &Prediction,
    (cases, failed): (usize, usize),
) -> (Vec<String>, Value) {
    let lines: Vec<_> = all.iter().filter(|line| line.peer.is_none() && line.way != ALONE).collect();
    let mut good: Vec<_> = lines.iter().filter_map(|line| Some((line.way, line.step_for(GOAL)?))).collect();
    good.sort_by(|one, other| one.1.calls.total_cmp(&other.1.calls));
    let mut summary: Vec<String> = good
        .iter()
        .enumerate()
        .map(|(place, (way, point))| {
            let verb = if place == 0 { "Use" } else { "Or" };
            format!(
                "{verb} {way} with steps of {} s ({} per contact): expect an error of restitution of {} % with {:.0} calls, \
                 which take {} us, per impact.",
                digits(point.step),
                point.steps,
                two_digits(100.0 * point.restitution),
                point.calls,
                two_digits(1e6 * point.run_time)
            )
        })
        .collect();
    for line in lines.iter().filter(|line| line.step_for(GOAL).is_none()) {
        summary.push(format!("With {}, no step that was tried keeps the error of restitution below 1 %.", line.way));
    }
    let step = |limit: f64| digits(limit / stability.frequency);
    summary.push(match stability.leap_frog {
        Some(limit) => format!(
            "Leap-frog is stable up to a step of {} s (h sqrt(K/m) = {limit:.3}; elastic theory: 2); for bigger steps choose a \
             larger mass or a softer contact{}.",
            step(limit),
            // which a rate-dependent law can't have
            if lines.iter().any(|line| line.way == ways::MASS_KNOWN.name) { ", or a unit that knows the mass" } else { "" }
        ),
        None => "Leap-frog is stable at no step that was tried: a pressed body never comes to rest.".into(),
    });
    summary.push(match stability.late {
        Some(limit) => format!("A force one step late is stable up to a step of {} s.", step(limit)),
        None => "A force one step late makes energy at every step that was tried: a pressed body never comes to rest."
            .into(),
    });
    summary.push(format!("{} of {cases} stiff and extreme cases are right.", cases - failed));
    let ways: Vec<_> = good
        .iter()
        .map(|(way, point)| {
            json!({ "way": way, "step_s": point.step, "steps_per_contact": point.steps,
                    "error_of_restitution": point.restitution, "calls_per_impact": point.calls })
        })
        .collect();
    let used = json!({
        "goal": GOAL,
        "ways": ways,
        "restitution": prediction.restitution,
        "contact_time_s": prediction.contact_time(),
        "largest_stiffness_N_per_m": stability.stiffness,
        "stable_leap_frog": stability.leap_frog,
        "stable_late": stability.late,
    });
    (summary, used)
}

/// Two significant digits.
fn two_digits(value: f64) -> String {
    digits(format!("{value:.1e}").parse().expect("a number"))
}
