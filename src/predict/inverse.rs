//! Inverse predictions: from a measured dent or rebound to the speed and the yield strength that explain it.
//!
//! A dent grows with the speed and falls with the strength: one of each explains it. Restitution is not monotone: a rebound may
//! have several explanations or none, and the search finds all of them within a range.

use super::question::Question;
use crate::messages::WrongCall;
use brinell_contact::impact::Impact;
use brinell_exporter::bisection::border;
use brinell_exporter::laws::Choice;
use brinell_exporter::layout::{json_line, paragraph};
use brinell_exporter::numbers::{quantity, significant};
use brinell_exporter::predict::{PredictError, beyond, one, positive};
use brinell_exporter::validity;
use serde_json::{Value, json};
use std::error::Error;

impl Question<'_> {
    /// Prints the speed that causes `dent` [m], and the yield strength that explains it after the impact.
    ///
    /// # Errors
    /// [`PredictError::NotPositive`], [`PredictError::NoDent`] or [`PredictError::NoSolution`].
    pub fn explain_dent(&self, dent: f64) -> Result<(), Box<dyn Error>> {
        let Question { choices, impact, as_json, .. } = *self;
        let dent = positive("dent", dent).map_err(WrongCall::of)?;
        let mut answers = Vec::new();
        for choice in choices {
            let speed = speed_of_dent(choice, impact.mass, dent)?;
            let strength = strength_of_dent(choice, &impact, dent)?;
            self.warn(choice, &[speed], &[strength]);
            if as_json {
                answers.push(json!({ "law": choice.laws, "speed": speed, "yield_strength": strength }));
                continue;
            }
            let words = format!(
                "by {}, {} leaves a dent of {} at {} on the target of the scene, or at {} on a target with a yield strength of {}",
                choice.laws,
                quantity(impact.mass, "kg"),
                quantity(dent, "m"),
                quantity(speed, "m/s"),
                quantity(impact.speed, "m/s"),
                quantity(strength, "Pa")
            );
            print!("{}", paragraph("", &words));
        }
        if as_json {
            let object = json!({ "dent": dent, "mass": impact.mass, "impact_speed": impact.speed, "laws": answers });
            print!("{}", json_line(&object));
        }
        Ok(())
    }

    /// Prints the speeds, and the yield strengths at the speed of the impact, for which the restitution is `goal`.
    ///
    /// # Errors
    /// [`PredictError::Restitution`], [`PredictError::NoDent`], or [`PredictError::NoRebound`] if no law explains it.
    pub fn explain_rebound(&self, goal: f64) -> Result<(), Box<dyn Error>> {
        let Question { choices, impact, as_json, .. } = *self;
        if !(goal > 0.0 && goal <= 1.0) {
            return Err(WrongCall::of(PredictError::Restitution(goal)).into());
        }
        let rebounds = explain(choices, &impact, goal)?;
        for (choice, ExplainedRebound { speeds, strengths, .. }) in choices.iter().zip(&rebounds) {
            self.warn(choice, &speeds.numbers(), &strengths.numbers());
        }
        match as_json {
            true => print!("{}", json_line(&json(&rebounds, &impact, goal))),
            false => print!("{}", text(&rebounds, &impact, goal)),
        }
        Ok(())
    }

    /// Warns about answers that are outside the validity of the law.
    fn warn(&self, choice: &Choice, speeds: &[f64], strengths: &[f64]) {
        let Question { scene, impact, .. } = *self;
        let at = |speed: &f64| Some((choice.clone(), Impact { speed: *speed, ..impact }, quantity(*speed, "m/s")));
        let with = |strength: &f64| {
            let model = choice.model.with_yield_strength(*strength)?;
            Some((Choice { model, ..choice.clone() }, impact, quantity(*strength, "Pa")))
        };
        for (choice, impact, answer) in speeds.iter().filter_map(at).chain(strengths.iter().filter_map(with)) {
            let Ok(prediction) = one(&choice, &impact) else { continue };
            for limit in beyond(scene, &choice.model.pair(), impact.speed, &prediction) {
                crate::messages::warn(&format!("{}, {answer}: {}", choice.laws, validity::words(limit)));
            }
        }
    }
}

/// The speed [m/s] at which `mass` [kg] leaves a dent of `dent` [m].
fn speed_of_dent(choice: &Choice, mass: f64, dent: f64) -> Result<f64, PredictError> {
    choice.model.elastoplastic().ok_or_else(|| PredictError::NoDent(choice.laws.clone()))?;
    // a speed beyond the range of the law counts as an infinitely deep dent
    let depth = |speed: f64| one(choice, &Impact { mass, speed }).map_or(f64::INFINITY, |p| p.residual_indentation);
    root(("speed", "m/s"), (1e-9, 1e6), ("dent", dent), depth)
}

/// The yield strength [Pa] for which the impact leaves a dent of `dent` [m]: the inverse of the Brinell test.
fn strength_of_dent(choice: &Choice, impact: &Impact, dent: f64) -> Result<f64, PredictError> {
    let depth = |yield_strength: f64| {
        let softer = choice.model.with_yield_strength(yield_strength);
        // the dent falls with the strength; a target too soft for the law counts as an infinitely deep dent
        let prediction = softer.and_then(|softer| softer.predict(impact));
        prediction.map_or(f64::NEG_INFINITY, |prediction| -prediction.residual_indentation)
    };
    let modulus = choice.model.pair().modulus;
    root(("yield strength", "Pa"), (1e-7 * modulus, modulus), ("dent", -dent), depth)
}

/// The argument at which the increasing function `of` has the value `goal`.
fn root(
    (what, unit): (&'static str, &'static str),
    (low, high): (f64, f64),
    (name, goal): (&'static str, f64),
    of: impl Fn(f64) -> f64,
) -> Result<f64, PredictError> {
    let none = PredictError::NoSolution { what, unit, low, high, name, value: goal.abs(), of: "m" };
    let exceeds = |argument: f64| of(argument) >= goal;
    if exceeds(low) || !exceeds(high) {
        return Err(none);
    }
    Ok(border((low, high), exceeds))
}

/// Range of the search over speeds [m/s].
const SPEEDS: (f64, f64) = (1e-9, 1e6);

/// Range of the search over yield strengths [effective moduli].
const STRENGTHS: (f64, f64) = (1e-7, 1.0);

/// Grid points in each decade. The search also finds narrower extrema of the curve if the nearest value is at a grid
/// point.
const POINTS_PER_DECADE: f64 = 60.0;

/// Restitutions with a smaller difference are equal: an elastic impact has 1 to rounding.
const SAME: f64 = 1e-13;

/// Tolerance of the restitution at a solution; with a larger difference the curve has jumped past the goal.
const REACHED: f64 = 1e-10;

/// Places where a function has the requested value.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Solution {
    At(f64),
    /// At all places in between.
    Between(f64, f64),
    /// At no place, but the function jumps past the value here.
    Jump(f64),
}

/// The result for a range.
struct Search {
    range: (f64, f64),
    /// Smallest and largest restitution on the grid.
    reached: (f64, f64),
    solutions: Vec<Solution>,
}

/// Both explanations of a rebound with one law.
struct ExplainedRebound {
    law: String,
    speeds: Search,
    strengths: Search,
}

/// For each law: the speeds, and the yield strengths at the speed of `impact`, for which the restitution is `goal`.
///
/// # Errors
/// [`PredictError::NoRebound`] if no law has an explanation.
fn explain(choices: &[Choice], impact: &Impact, goal: f64) -> Result<Vec<ExplainedRebound>, PredictError> {
    if let Some(damped) = choices.iter().find(|choice| choice.model.elastoplastic().is_none()) {
        return Err(PredictError::NoDent(damped.laws.clone()));
    }
    let rebounds: Vec<_> = choices.iter().map(|choice| explain_by(choice, impact, goal)).collect();
    if rebounds.iter().all(|rebound| rebound.speeds.is_empty() && rebound.strengths.is_empty()) {
        let searched = rebounds.iter().map(|rebound| {
            let (speeds, strengths) =
                (rebound.speeds.nothing("speed", "m/s"), rebound.strengths.nothing(STRENGTH, "Pa"));
            format!("{}: {speeds}; {strengths}", rebound.law)
        });
        return Err(PredictError::NoRebound { goal, searched: searched.collect::<Vec<_>>().join("; ") });
    }
    Ok(rebounds)
}

const STRENGTH: &str = "yield strength";

fn explain_by(choice: &Choice, impact: &Impact, goal: f64) -> ExplainedRebound {
    let model = choice.model;
    let modulus = model.pair().modulus;
    let speeds = search(SPEEDS, goal, |speed| model.restitution(&Impact { speed, ..*impact }));
    let range = (STRENGTHS.0 * modulus, STRENGTHS.1 * modulus);
    let strengths =
        search(range, goal, |yield_strength| model.with_yield_strength(yield_strength)?.restitution(impact));
    ExplainedRebound { law: choice.laws.clone(), speeds, strengths }
}

/// All places in `range` where the function `of` has the value `goal`. The function may be undefined in places.
fn search(range: (f64, f64), goal: f64, of: impl Fn(f64) -> Option<f64>) -> Search {
    let (low, high) = range;
    let steps = (POINTS_PER_DECADE * libm::log10(high / low)).ceil() as u32;
    let argument = |step| low * libm::pow(high / low, f64::from(step) / f64::from(steps));
    // zero for a difference of rounding
    let over = |argument: f64| {
        let over = of(argument)? - goal;
        Some((argument, if over.abs() <= SAME { 0.0 } else { over }))
    };
    let grid: Vec<_> = (0..=steps).map(|step| over(argument(step))).collect();
    let reached = grid.iter().flatten().map(|(_, over)| goal + over);
    let reached = (reached.clone().fold(f64::INFINITY, f64::min), reached.fold(f64::NEG_INFINITY, f64::max));
    let value = |argument| over(argument).map_or(f64::NAN, |(_, over)| over);
    let mut points: Vec<_> = grid.iter().copied().flatten().collect();
    for three in grid.windows(3) {
        let &[Some(before), Some(point), Some(after)] = three else { continue };
        // the curve may have an extremum between two points, and cross the goal twice
        let nearest = |other: f64| point.1 * other > 0.0 && point.1.abs() <= other.abs();
        if nearest(before.1) && nearest(after.1) {
            points.push(turn((before.0, after.0), point.1.signum(), value));
        }
    }
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    Search { range, reached, solutions: solutions(&points, value) }
}

/// The place where the function, of one sign in `from..to`, has its smallest absolute value, by golden-section
/// search; with its value there.
fn turn((mut from, mut to): (f64, f64), sign: f64, value: impl Fn(f64) -> f64) -> (f64, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    for _ in 0..80 {
        let (left, right) = (to - GOLDEN * (to - from), from + GOLDEN * (to - from));
        if sign * value(left) < sign * value(right) {
            to = right;
        } else {
            from = left;
        }
    }
    let found = 0.5 * (from + to);
    (found, value(found))
}

/// The solutions between `points`, which are sorted arguments with the distance of the function from the goal.
fn solutions(points: &[(f64, f64)], value: impl Fn(f64) -> f64) -> Vec<Solution> {
    let mut found = Vec::new();
    let mut zeros: Option<(f64, f64)> = None;
    for (index, &(at, over)) in points.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| points[before]);
        if over == 0.0 {
            let begin = before.map_or(at, |(before, _)| border((before, at), |x| value(x) == 0.0));
            zeros = Some((zeros.map_or(begin, |(begin, _)| begin), at));
            continue;
        }
        if let Some((begin, last)) = zeros.take() {
            let end = border((at, last), |x| value(x) == 0.0);
            found.push(plateau(begin, end));
        } else if let Some((before, other)) = before.filter(|(_, other)| other * over < 0.0) {
            let root = border((before, at), |x| value(x) * other <= 0.0);
            found.push(if value(root).abs() <= REACHED { Solution::At(root) } else { Solution::Jump(root) });
        }
    }
    found.extend(zeros.map(|(begin, last)| plateau(begin, last)));
    found
}

/// The function has the value from `begin` to `end`. If these differ by a few units in the last place, they are one
/// solution.
fn plateau(begin: f64, end: f64) -> Solution {
    if end - begin <= 1e-9 * end { Solution::At(0.5 * (begin + end)) } else { Solution::Between(begin, end) }
}

impl Search {
    fn is_empty(&self) -> bool {
        !self.solutions.iter().any(|solution| !matches!(solution, Solution::Jump(_)))
    }

    /// The numbers that explain the restitution, with the ends of ranges.
    fn numbers(&self) -> Vec<f64> {
        let of = |solution: &Solution| match *solution {
            Solution::At(x) => vec![x],
            Solution::Between(from, to) => vec![from, to],
            Solution::Jump(_) => Vec::new(),
        };
        self.solutions.iter().flat_map(of).collect()
    }

    fn nothing(&self, what: &str, unit: &'static str) -> String {
        let ((low, high), (least, most)) = (self.range, self.reached);
        format!(
            "with a {what} from {} to {} restitution is {} to {}",
            quantity(low, unit),
            quantity(high, unit),
            significant(least, 4),
            significant(most, 4)
        )
    }

    fn json(&self) -> Value {
        let points = self.solutions.iter().filter_map(|s| if let Solution::At(x) = s { Some(*x) } else { None });
        let ranges =
            self.solutions.iter().filter_map(|s| if let Solution::Between(a, b) = s { Some([*a, *b]) } else { None });
        let jumps = self.solutions.iter().filter_map(|s| if let Solution::Jump(x) = s { Some(*x) } else { None });
        json!({
            "solutions": points.collect::<Vec<_>>(), "ranges": ranges.collect::<Vec<_>>(), "jumps": jumps.collect::<Vec<_>>(),
            "searched": [self.range.0, self.range.1], "restitution_reached": [self.reached.0, self.reached.1],
        })
    }

    fn text(&self, text: &mut String, what: &str, unit: &'static str) {
        let number = |value: f64| quantity(value, unit);
        for solution in &self.solutions {
            let words = match *solution {
                Solution::At(x) => format!("with a {what} of {}", number(x)),
                Solution::Between(from, to) => format!("with any {what} from {} to {}", number(from), number(to)),
                Solution::Jump(x) => format!("not at {}, where restitution jumps past it", number(x)),
            };
            text.push_str(&paragraph("  ", &words));
        }
        if self.is_empty() {
            text.push_str(&paragraph("  ", &format!("with no {what}: {}", self.nothing(what, unit))));
        }
    }
}

/// The explanations as text.
fn text(rebounds: &[ExplainedRebound], impact: &Impact, goal: f64) -> String {
    let mut text = String::new();
    let (mass, speed) = (quantity(impact.mass, "kg"), quantity(impact.speed, "m/s"));
    for ExplainedRebound { law, speeds, strengths } in rebounds {
        text.push_str(&paragraph(
            "",
            &format!("by {law}, {mass} has a restitution of {goal} on the target of the scene"),
        ));
        speeds.text(&mut text, "speed", "m/s");
        text.push_str(&format!("and at {speed} on a target\n"));
        strengths.text(&mut text, STRENGTH, "Pa");
    }
    text
}

/// The explanations as JSON.
fn json(rebounds: &[ExplainedRebound], impact: &Impact, goal: f64) -> Value {
    let law = |ExplainedRebound { law, speeds, strengths }: &ExplainedRebound| json!({ "law": law, "speed": speeds.json(), "yield_strength": strengths.json() });
    let laws: Vec<_> = rebounds.iter().map(law).collect();
    json!({ "restitution": goal, "mass": impact.mass, "impact_speed": impact.speed, "laws": laws })
}
