//! The choice of a coupling: for each way, its conditions and the steps for errors of 1 % and 0.1 %.

use super::precision::{Line, Point};
use super::stability::Limit;
use brinell_exporter::master::Master;
use brinell_exporter::numbers::{quantity, significant};
use serde::Serialize;

/// Largest error of a way that is called exact.
const EXACT: f64 = 1e-9;

/// A way to couple, with the largest steps for errors of the restitution below 1 % and 0.1 %.
#[derive(Serialize)]
pub struct Choice {
    way: &'static str,
    #[serde(skip)]
    algorithm: Master,
    master: &'static str,
    what: &'static str,
    /// The cheapest of its co-simulation algorithm at 1 %.
    recommended: bool,
    /// Exact to rounding for every step.
    exact: bool,
    one_percent: Option<Point>,
    a_tenth_of_a_percent: Option<Point>,
    /// In words.
    largest_stable_step: String,
}

/// The choice among the measured ways of the scene's FMU.
pub fn of(lines: &[Line], limits: &[Limit]) -> Vec<Choice> {
    let row = |line: &Line| {
        let way = line.way;
        let limit = limits.iter().find(|limit| limit.way == way.name);
        Choice {
            way: way.name,
            algorithm: way.master,
            master: way.master.name(),
            what: way.what,
            recommended: false,
            exact: line.points.iter().all(|point| point.restitution < EXACT),
            one_percent: line.step_for(0.01).cloned(),
            a_tenth_of_a_percent: line.step_for(0.001).cloned(),
            largest_stable_step: limit.map_or("none".into(), Limit::words),
        }
    };
    let mut choices: Vec<Choice> = lines.iter().map(row).collect();
    for master in [Master::Serial, Master::Parallel] {
        let time = |choice: &Choice| choice.one_percent.as_ref().map_or(f64::INFINITY, |point| point.run_time);
        let candidates = choices.iter_mut().filter(|choice| choice.algorithm == master && choice.one_percent.is_some());
        if let Some(best) = candidates.min_by(|one, other| time(one).total_cmp(&time(other))) {
            best.recommended = true;
        }
    }
    choices
}

/// The recommendations as sentences, including one for slow calls.
pub fn sentences(choices: &[Choice]) -> Vec<String> {
    let best = |master: Master| {
        let best = choices.iter().find(|choice| choice.recommended && choice.algorithm == master)?;
        Some((best, best.one_percent.as_ref()?))
    };
    let recommended: Vec<_> = [Master::Serial, Master::Parallel].into_iter().filter_map(best).collect();
    let sentence = |(choice, point): &(&Choice, &Point)| {
        format!(
            "For a {} master: {}, {} steps per contact ({}). Expected error of restitution {} %, largest stable step {}.",
            choice.master,
            choice.way,
            point.steps,
            quantity(point.step, "s"),
            significant(100.0 * point.restitution, 2),
            choice.largest_stable_step
        )
    };
    let mut sentences: Vec<String> = recommended.iter().map(sentence).collect();
    sentences.extend(slow_calls(choices, &recommended));
    sentences
}

/// Cost of a call above which the exact ways are the cheapest, because they need few calls.
fn slow_calls(choices: &[Choice], recommended: &[(&Choice, &Point)]) -> Option<String> {
    let mut least = f64::INFINITY;
    let saved = recommended.iter().filter(|(choice, _)| !choice.exact).filter_map(|(choice, point)| {
        let exact = choices.iter().find(|other| other.exact && other.algorithm == choice.algorithm)?;
        let few = exact.one_percent.as_ref().filter(|few| few.calls < point.calls)?;
        least = least.min((few.run_time - point.run_time) / (point.calls - few.calls));
        Some(format!("{}: {:.0} calls per impact instead of {:.0}", exact.way, few.calls, point.calls))
    });
    let saved: Vec<_> = saved.collect();
    let when = match least {
        _ if saved.is_empty() => return None,
        least if least > 0.0 => {
            format!("If your tool spends more than {} on each call, as Python does", quantity(least, "s"))
        }
        _ => "Cheaper still".into(),
    };
    Some(format!("{when}, use an FMU that knows the mass. {}. It is exact and stable at any step.", saved.join("; ")))
}
