//! What must be said beside the numbers, in a sentence each.

use super::fit::{Fitted, NEAR};
use super::law::Law;
use super::motion::{Outcome, PHASES, Promise, Stepping, exact};
use super::numbers::Radii;
use super::text::change;
use super::tools::{Tool, ToolNumbers};
use super::{Case, Request, Translated, beyond_validity};
use crate::numbers::{quantity, significant};
use crate::scene::Scene;
use brinell_contact::Surface;
use brinell_contact::impact::Impact;

/// A relative difference that is not worth a word.
const SMALL: f64 = 2e-3;
/// A difference of restitutions that is worth a sentence of its own.
const NOTICED: f64 = 1e-2;

fn three(value: f64) -> String {
    significant(value, 3)
}

/// What a number of this way can do and can't, and its remarks.
pub fn of_way(case: &Case, way: &ToolNumbers, fitted: Option<&Fitted>, translated: &Translated) -> Vec<String> {
    let mut notes = vec![met(case, fitted, translated)];
    notes.extend(chosen(way));
    notes.push(falls(case, translated));
    if let Some(fitted) = fitted {
        notes.extend(softened(case, fitted, translated));
        notes.extend(steps(case, way, translated));
        notes.extend(other_masses(case, way, fitted));
    }
    let remarks = way.remarks_for(case.radii.other.is_some());
    let remarks = remarks.map(|remark| match (remark.contains("{smooth_restitutions}"), fitted) {
        (true, Some(fitted)) => remark.replace("{smooth_restitutions}", &smoothed(case, fitted)),
        _ => remark.to_string(),
    });
    notes.extend(remarks);
    notes
}

/// What is met, and where.
fn met(case: &Case, fitted: Option<&Fitted>, translated: &Translated) -> String {
    let (goal, speed) = (case.goal(), quantity(case.speed, "m/s"));
    let promised = &translated.promised[case.at()].mean;
    let Some(fitted) = fitted else {
        return format!(
            "The restitution is the scene's at {speed}. Contact time, largest force and depth are not defined: the speed changes in \
             one step."
        );
    };
    let off = (promised.restitution - goal.restitution).abs();
    let within = if off < SMALL { String::new() } else { format!(" within {}", significant(off, 1)) };
    let (same, apart) = match off < NEAR {
        true => (vec![format!("the restitution{within}")], Vec::new()),
        false => {
            let [theirs, own] = [promised.restitution, goal.restitution].map(three);
            (Vec::new(), vec![format!("the restitution is {theirs}, not {own}: these numbers come no nearer")])
        }
    };
    let changes = [
        ("contact time", promised.contact_time, goal.contact_time, "s"),
        ("largest force", promised.largest_force, goal.largest_force, "N"),
        ("depth", promised.depth, goal.depth, "m"),
    ];
    // a softened contact has its own sentence
    let changes = changes.iter().filter(|_| fitted.softening <= 1.0);
    let changes = changes.map(|(name, value, wanted, unit)| (name, quantity(*value, unit), change(value / wanted)));
    let (met, other): (Vec<_>, Vec<_>) = changes.partition(|(_, _, change)| change == "+0 %");
    let same = same.into_iter().chain(met.iter().map(|(name, ..)| format!("the {name}"))).collect::<Vec<_>>();
    let other = other.iter().map(|(name, value, change)| format!("the {name} is {value} ({change})"));
    let verb = if same.len() == 1 { "is" } else { "are" };
    let same = same.split_last().map(|(last, before)| match before {
        [] => format!("{last} {verb} the scene's"),
        before => format!("{} and {last} {verb} the scene's", before.join(", ")),
    });
    let all = same.into_iter().chain(apart).chain(other).collect::<Vec<_>>();
    format!("At {speed} {}.", all.join("; "))
}

/// The law as it is for a mass that is `part` of that of the fit; `None` where the tool makes the damping from mass and restitution.
fn with_part_of_mass(law: &Law, way: &ToolNumbers, part: f64) -> Option<Law> {
    let is_typed = |key: &str| way.block.contains(&format!("{{{key}}}"));
    let scaled = |key: &str| if is_typed(key) { part } else { 1.0 };
    match *law {
        Law::Spring { .. } if is_typed("pulling_restitution") => None,
        Law::Spring { stiffness, damping, pulls } => Some(Law::Spring {
            stiffness: stiffness * scaled("stiffness_per_mass"),
            damping: damping * scaled("damping_per_mass"),
            pulls,
        }),
        Law::Proportional { stiffness, exponent, factor, mass, pulls } => {
            Some(Law::Proportional { stiffness, exponent, factor, mass: mass * part, pulls })
        }
        law => Some(law),
    }
}

/// That the numbers hold for one mass only, where another one has another restitution than by the scene's law.
fn other_masses(case: &Case, way: &ToolNumbers, fitted: &Fitted) -> Option<String> {
    let stepping = if fitted.is_fine { Stepping::Own } else { way.stepping };
    let theirs = |part: f64| {
        let law = with_part_of_mass(&fitted.law, way, part)?;
        let promise = Promise::at(&law, stepping, part * case.mass, case.speed, fitted.step.unwrap_or(f64::NAN))?;
        Some(promise.mean.restitution)
    };
    let same = theirs(1.0)?;
    let said = case.at_other_masses.iter().filter_map(|(part, own)| {
        let theirs = theirs(*part)?;
        let differs = (theirs - same).abs() > NOTICED && (theirs - own).abs() > NOTICED;
        let which = match (*part < 1.0, case.radii.other.is_some()) {
            (true, false) => "half of it, as between two such balls,",
            (true, true) => "half of it",
            (false, true) => "twice of it, as of equal spheres on a wall,",
            (false, false) => "twice of it",
        };
        differs
            .then(|| format!("with {which} the restitution is {}, by the scene's law {}", three(theirs), three(*own)))
    });
    let said = said.collect::<Vec<_>>();
    let speed = quantity(case.speed, "m/s");
    (!said.is_empty()).then(|| format!("The numbers hold for one effective mass: at {speed}, {}.", said.join("; ")))
}

/// What else was chosen.
fn chosen(way: &ToolNumbers) -> Option<String> {
    let what = match way.form?.chooses() {
        (true, true) => "Exponent and penetration depth are those",
        (true, false) => "The exponent is the one",
        _ => return None,
    };
    Some(format!("{what} with the least error of restitution, largest force and contact time over the range."))
}

/// How the restitution depends on the speed here and there.
fn falls(case: &Case, translated: &Translated) -> String {
    let [slowest, fastest] =
        [case.speeds.first(), case.speeds.last()].map(|speed| quantity(*speed.unwrap_or(&f64::NAN), "m/s"));
    if case.speeds.len() < 2 {
        return format!(
            "One speed was asked for, {slowest}: at others the restitution of the scene's law is another one."
        );
    }
    let own: Vec<f64> = case.wanted.iter().map(|one| one.restitution).collect();
    let theirs: Vec<f64> = translated.promised.iter().map(|one| one.mean.restitution).collect();
    let errors = own.iter().zip(&theirs).map(|(own, theirs)| theirs - own);
    let (low, high) = errors.fold((0.0_f64, 0.0_f64), |(low, high), error| (low.min(error), high.max(error)));
    let off = [(high, "high"), (-low, "low")].into_iter().filter(|(error, _)| *error > 1e-3);
    let off: Vec<_> = off.map(|(error, which)| format!("{} too {which}", three(error))).collect();
    let serves = match off.as_slice() {
        [] => "one set of numbers serves the whole range".to_string(),
        off => format!("one set of numbers can't serve the whole range: it is up to {}", off.join(" and ")),
    };
    format!(
        "From {slowest} to {fastest} the restitution of the scene's law {}, that of this model {}: {serves}.",
        course(&own),
        course(&theirs)
    )
}

/// How a restitution changes as the speed grows.
fn course(values: &[f64]) -> String {
    let (least, most) =
        values.iter().fold((f64::INFINITY, 0.0_f64), |(least, most), value| (least.min(*value), most.max(*value)));
    let [first, last] = [values[0], values[values.len() - 1]];
    let falls = values.windows(2).all(|two| two[1] <= two[0] + 1e-6);
    let grows = values.windows(2).all(|two| two[1] >= two[0] - 1e-6);
    match (falls, grows) {
        _ if most - least < SMALL => format!("stays at {}", three(first)),
        (true, _) => format!("falls from {} to {}", three(first), three(last)),
        (_, true) => format!("grows from {} to {}", three(first), three(last)),
        _ => format!("lies between {} and {}", three(least), three(most)),
    }
}

/// That the step is too long for the contact.
fn softened(case: &Case, fitted: &Fitted, translated: &Translated) -> Option<String> {
    let step = fitted.step.filter(|_| fitted.softening > 1.0)?;
    let goal = case.goal();
    let depth = translated.promised[case.at()].mean.depth;
    let count = fitted.softening * goal.contact_time / step;
    let why = if count > 30.5 { ", and an implicit solver damps less the more steps there are" } else { "" };
    let deep = if depth > case.radii.effective {
        format!(
            " That is more than the radius: the ball sinks in whole. With steps of at most {} the depth stays below a tenth of the radius.",
            quantity(0.1 * step * case.radii.effective / depth, "s")
        )
    } else {
        String::new()
    };
    Some(format!(
        "By the scene's law a contact lasts {}, {} steps of {}. It is softened until it has {count:.0}{why}: {} times as long and {} times as \
         deep ({}). Only the restitution is the scene's.{deep}",
        quantity(goal.contact_time, "s"),
        three(goal.contact_time / step),
        quantity(step, "s"),
        three(fitted.softening),
        three(depth / goal.depth),
        quantity(depth, "m"),
    ))
}

/// What depends on the step.
fn steps(case: &Case, way: &ToolNumbers, translated: &Translated) -> Vec<String> {
    let mut notes = Vec::new();
    let Some(step) = translated.step else { return notes };
    let widest = translated.promised.iter().max_by(|one, other| {
        let width = |one: &Promise| one.most_restitution - one.least_restitution;
        width(one).total_cmp(&width(other))
    });
    if let Some(widest) = widest.filter(|one| one.most_restitution - one.least_restitution > SMALL) {
        notes.push(format!(
            "In steps of {} the rebound depends on where in a step the bodies touch: the mean over {PHASES} phases is promised, single rebounds \
             are {} to {} where they differ most.",
            quantity(step, "s"),
            three(widest.least_restitution),
            three(widest.most_restitution)
        ));
    }
    match (way.stepping, translated.largest_step) {
        (Stepping::Explicit, Some(largest)) => notes.push(format!(
            "The largest step at which no phase of the touch gains energy is {}.",
            quantity(largest, "s")
        )),
        (Stepping::Explicit, None) => notes.push(format!(
            "At a restitution of {} some phases gain energy at every step.",
            three(case.goal().restitution)
        )),
        _ => notes.push(format!(
            "The solver damps by itself, the more the longer the step: the numbers are for steps of {} only. No phase gains energy.",
            quantity(step, "s")
        )),
    }
    notes
}

/// The restitutions of a force whose smoothing isn't known.
fn smoothed(case: &Case, fitted: &Fitted) -> String {
    let Law::Spring { stiffness, damping, .. } = fitted.law else { return String::new() };
    let Some(plain) = exact(&fitted.law, case.mass, case.speed) else { return String::new() };
    let of = |pulls: bool| {
        let law = Law::Smooth { stiffness, damping, width: plain.depth / 20.0, pulls };
        exact(&law, case.mass, case.speed).map_or("unknown".into(), |outcome| three(outcome.restitution))
    };
    format!(
        "With a cubic over this width the restitution at {} is {} if the force never pulls, and {} if it may.",
        quantity(case.speed, "m/s"),
        of(false),
        of(true)
    )
}

/// What is to know of the scene, whatever the tool.
pub fn of_scene(
    scene: &Scene,
    (mass, radii): (f64, &Radii),
    (speeds, wanted): (&[f64], &[Outcome]),
    request: &Request,
    tool: &Tool,
) -> Vec<String> {
    let mut notes = Vec::new();
    if scene.impact_is_assumed {
        notes.push(format!("The scene names no impact; {}.", scene.assumption()));
    }
    notes.push(format!(
        "The numbers are for an effective mass of {}: that of a body that hits a fixed one, of two free bodies m1 m2/(m1 + m2).",
        quantity(mass, "kg")
    ));
    if scene.contact_count() > 1 {
        let more = if scene.inverse_masses().is_some() {
            " They share bodies: a body on several contacts at once has another effective mass at each than in an impact on one."
        } else {
            ""
        };
        notes.push(format!(
            "The scene has {} contacts; the numbers are for the first, by itself.{more}",
            scene.contact_count()
        ));
    }
    if radii.other.is_some() {
        notes.push(format!(
            "The target is a sphere, too. Moduli of Hertz contacts are for the effective radius {} of both, as tools take it from two spheres.",
            quantity(radii.effective, "m")
        ));
    } else if scene.group_value(0, "target.radius").is_some() {
        notes.push(
            "The target is hollow. Tools take a ball on a flat: the moduli of Hertz contacts are for that.".into(),
        );
    }
    if scene.directions > 0 {
        let coefficient = scene.group_value(0, "friction.coefficient").map_or(String::new(), |mu| format!(" ({mu})"));
        notes.push(format!(
            "The scene has friction; these numbers are along the normal, and the blocks switch friction off. {} can have its coefficient{coefficient} as \
             Coulomb friction, but not the partial slip of the scene's law.",
            tool.title
        ));
    }
    let dents = !scene.is_damped() && wanted.iter().any(|one| one.restitution < 1.0 - SMALL);
    if dents && scene.contacts[0].surface == Surface::Dented {
        notes.push(
            "The scene's surface keeps its dents, so that a second impact at the same place is nearly elastic. No tool remembers a dent: \
             every impact there is like the first."
                .into(),
        );
    }
    if request.step.is_some()
        && tool.ways.iter().all(|way| matches!(way.stepping, Stepping::Own | Stepping::Restitution))
    {
        notes.push(format!("{}'s numbers don't depend on a step: --step has no effect.", tool.title));
    }
    if let Some(fastest) = speeds.last() {
        notes.extend(beyond_validity(scene, Impact { mass, speed: *fastest }));
    }
    notes
}
