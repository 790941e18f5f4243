//! An impact by the law of a tool: exactly, and step by step as the tool itself moves.

use super::law::Law;
use super::runge_kutta;
use crate::bisection::border;
use libm::pow;

/// What an impact is compared by. NaN where a tool does not define it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Outcome {
    /// Rebound speed over incoming speed.
    pub restitution: f64,
    /// Largest force \[N\].
    pub largest_force: f64,
    /// \[s\]
    pub contact_time: f64,
    /// Largest overlap \[m\].
    pub depth: f64,
}

/// How a tool moves a body through a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stepping {
    /// Its integrator chooses its steps, or finds the events.
    Own,
    /// Force of the step's start, then the speed, then the place.
    Explicit,
    /// Force of the step's end, if the bodies overlap at its start.
    Implicit,
    /// The same, and already in the step in which the bodies would touch.
    Predicted,
    /// The same, with the force of a spring that is longer by the gap that is left in the step in which the bodies would touch.
    Stretched,
    /// The lagged solver of Drake: spring and damping of the step's end, if the bodies overlap at its start.
    Lagged,
    /// The speed is set to the restitution times that before.
    Restitution,
}

/// Largest error of a step, relative to the scales of length and speed.
const TOLERANCE: f64 = 1e-11;
/// Part of the overlap by which a step may change it where the surface may grip again.
const NEAR: f64 = 0.01;
/// More steps than any impact needs.
const MOST_STEPS: usize = 200_000;
/// Phases of the touch within a step over which means are taken.
pub const PHASES: u32 = 20;

/// The overlap \[m\] at which the spring of `law` alone stops a `mass` \[kg\] with this `speed` \[m/s\].
pub fn scale(law: &Law, mass: f64, speed: f64) -> f64 {
    let (stiffness, exponent) = law.elastic();
    pow(0.5 * (exponent + 1.0) * mass * speed * speed / stiffness, 1.0 / (exponent + 1.0))
}

/// The impact of a `mass` \[kg\] at `speed` \[m/s\] by `law`, without errors of a step; `None` if it does not end.
pub fn exact(law: &Law, mass: f64, speed: f64) -> Option<Outcome> {
    let length = scale(law, mass, speed);
    // a damping that falls faster than the spring lets the surface go, and grip again
    let grips_again = matches!(law, Law::Impact { .. });
    let ends_early = !law.pulls() && !grips_again;
    let over =
        |deepest: f64, [x, w]: &[f64; 2]| *w < 0.0 && (*x <= 0.0 || ends_early && law.force(*x, *w, deepest) <= 0.0);
    let force = |x: f64, w: f64, deepest: f64| {
        let force = law.force(x, w, deepest);
        if grips_again { force.max(0.0) } else { force }
    };
    let (mut state, mut deepest, mut time) = ([0.0, speed], 0.0_f64, 0.0);
    let mut step = 1e-5 * length / speed;
    let mut peak = Peak::default();
    peak.add(0.0, law.force(0.0, speed, 0.0));
    for _ in 0..MOST_STEPS {
        let slope = |[x, w]: &[f64; 2]| Some([*w, -force(*x, *w, deepest.max(*x)) / mass]);
        let (next, error) = runge_kutta::step(&state, step, slope)?;
        let error = (error[0].abs() / length).max(error[1].abs() / speed);
        let factor = runge_kutta::factor(TOLERANCE, error);
        // written positively to reject NaN
        let accepted = error <= TOLERANCE;
        if !accepted {
            step *= if factor > 0.1 { factor } else { 0.1 };
            continue;
        }
        let part = |part: f64| runge_kutta::step(&state, part, slope).map_or(next, |(state, _)| state);
        if state[1] > 0.0 && next[1] <= 0.0 {
            // the way back begins at the turning point, where laws with a memory have a corner
            let turning = border((0.0, step), |step| part(step)[1] <= 0.0);
            (state, time) = (part(turning), time + turning);
            deepest = deepest.max(state[0]);
            state[1] = state[1].min(-f64::MIN_POSITIVE);
            peak.add(time, law.force(state[0], 0.0, deepest));
            continue;
        }
        if over(deepest, &next) {
            let end = border((0.0, step), |step| over(deepest, &part(step)));
            return Some(Outcome {
                restitution: -part(end)[1] / speed,
                largest_force: peak.most,
                contact_time: time + end,
                depth: deepest,
            });
        }
        (state, time) = (next, time + step);
        deepest = deepest.max(state[0]);
        peak.add(time, force(state[0], state[1], deepest));
        step *= factor.min(5.0);
        if grips_again && state[1] < 0.0 {
            // a longer step could miss where the surface grips
            step = step.min(NEAR * state[0].max(1e-3 * length) / -state[1]);
        }
    }
    None
}

/// The largest of numbers over time, between them as on a parabola through three.
#[derive(Default)]
struct Peak {
    last: [(f64, f64); 2],
    most: f64,
    count: u32,
}

impl Peak {
    fn add(&mut self, time: f64, force: f64) {
        self.most = self.most.max(force);
        let [(t0, f0), (t1, f1)] = self.last;
        if self.count >= 2 && f1 >= f0 && f1 >= force && t1 > t0 && time > t1 {
            let (left, right) = ((f1 - f0) / (t1 - t0), (force - f1) / (time - t1));
            let bend = (right - left) / (time - t0);
            let slope = left + bend * (t1 - t0);
            // a corner is no parabola
            if bend < 0.0 {
                self.most = self.most.max((f1 - 0.25 * slope * slope / bend).min(f1 + (f1 - f0).max(f1 - force)));
            }
        }
        self.last = [(t1, f1), (time, force)];
        self.count += 1;
    }
}

/// One step of `step` \[s\] from overlap `x` \[m\] (negative: a gap) and closing speed `w` \[m/s\]: the new ones, and the force \[N\].
fn stepped(law: &Law, stepping: Stepping, mass: f64, step: f64, (x, w, deepest): (f64, f64, f64)) -> (f64, f64, f64) {
    let force = match (stepping, *law) {
        (Stepping::Predicted, Law::Spring { stiffness, damping, .. }) => {
            let softness = 1.0 / (step * stiffness + damping);
            let error_reduction = if x > 0.0 { step * stiffness * softness } else { 1.0 };
            ((w + error_reduction * x / step) / (softness + step / mass)).max(0.0)
        }
        (Stepping::Stretched, _) if x + step * w <= 0.0 => 0.0,
        _ if x <= 0.0 && stepping != Stepping::Stretched => 0.0,
        (Stepping::Implicit | Stepping::Stretched, Law::Spring { stiffness, damping, .. }) => {
            let hard = step * stiffness + damping;
            ((stiffness * x + hard * w) / (1.0 + step * hard / mass)).max(0.0)
        }
        (Stepping::Lagged, Law::HuntCrossley { stiffness, dissipation, .. }) => {
            // the force falls as the speed of the end falls: one root
            let at = |end: f64| stiffness * (x + step * end).max(0.0) * (1.0 + dissipation * end).max(0.0);
            let (mut low, mut high) = (w - step * at(w) / mass, w);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                *(if middle + step * at(middle) / mass > w { &mut high } else { &mut low }) = middle;
            }
            at(high)
        }
        _ => {
            let force = law.force(x, w, deepest);
            if law.pulls() { force } else { force.max(0.0) }
        }
    };
    let w = w - step * force / mass;
    (x + step * w, w, force)
}

/// An impact in equal steps of `step` \[s\], the first of which begins the part `phase` of a step before the touch.
pub fn in_steps(law: &Law, stepping: Stepping, mass: f64, speed: f64, step: f64, phase: f64) -> Outcome {
    let (mut x, mut w) = (-phase * step * speed, speed);
    let (mut depth, mut largest_force, mut count) = (0.0_f64, 0.0_f64, 0_u32);
    let mut law = *law;
    for _ in 0..MOST_STEPS {
        law = law.noticing(x, depth);
        let (next, after, force) = stepped(&law, stepping, mass, step, (x, w, depth));
        (x, w) = (next, after);
        if force != 0.0 {
            count += 1;
            largest_force = largest_force.max(force);
        } else if count > 0 && w <= 0.0 {
            break;
        }
        depth = depth.max(x);
    }
    Outcome { restitution: -w / speed, largest_force, contact_time: f64::from(count) * step, depth }
}

/// The mean of an impact over the phases of the touch, with the smallest and the largest restitution.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Promise {
    #[serde(flatten)]
    pub mean: Outcome,
    pub least_restitution: f64,
    pub most_restitution: f64,
}

impl Promise {
    /// An outcome that has no spread.
    pub fn of(mean: Outcome) -> Promise {
        Promise { mean, least_restitution: mean.restitution, most_restitution: mean.restitution }
    }

    /// Over the phases of the touch in steps of `step` \[s\]. `None` if an exact impact does not end.
    pub fn at(law: &Law, stepping: Stepping, mass: f64, speed: f64, step: f64) -> Option<Promise> {
        if stepping == Stepping::Own {
            return exact(law, mass, speed).map(Promise::of);
        }
        let all = (0..PHASES)
            .map(|phase| in_steps(law, stepping, mass, speed, step, (f64::from(phase) + 0.5) / f64::from(PHASES)));
        let mut sum = Outcome { restitution: 0.0, largest_force: 0.0, contact_time: 0.0, depth: 0.0 };
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for one in all {
            let part = 1.0 / f64::from(PHASES);
            sum.restitution += part * one.restitution;
            sum.largest_force += part * one.largest_force;
            sum.contact_time += part * one.contact_time;
            sum.depth += part * one.depth;
            (least, most) = (least.min(one.restitution), most.max(one.restitution));
        }
        Some(Promise { mean: sum, least_restitution: least, most_restitution: most })
    }
}
