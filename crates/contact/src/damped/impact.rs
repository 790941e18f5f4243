//! Prediction of an impact on a rate-dependent contact.

use super::{Damped, Model};
use crate::Regime;
use crate::impact::{Impact, Prediction};
use crate::numbers::{largest, smallest};
use crate::regime::LARGEST_INDENTATION;
use crate::runge_kutta;
use libm::{fabs, sqrt};

/// An instant of the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Time since first contact \[s\].
    pub time: f64,
    /// Indentation \[m\].
    pub indentation: f64,
    /// Closing speed \[m/s\].
    pub speed: f64,
}

/// Largest error of a step, relative to the largest indentation and to the incoming speed.
const TOLERANCE: f64 = 1e-13;

/// More steps than any contact needs: with this tolerance it takes a few thousand.
const MOST_STEPS: u32 = 1_000_000;

/// The impact `impact` on an untouched contact. The energy balance depends on the path, so the motion `m d'' = -F(d, d')` is
/// integrated by a pair of Runge-Kutta methods of order 5 and 4. Events are found by bisection of the last step. This is only
/// used for predictions, not during a co-simulation. The results are accurate to about 1e-10.
///
/// `None` if the mass or the speed is not positive and finite, if the energy is below the smallest normal number, or if the
/// motion leaves the range of the law.
pub fn predict<D: Damped + Copy>(model: &Model<D>, impact: &Impact) -> Option<Prediction> {
    follow(model, impact, |_, _| {})
}

/// [`predict`] that also passes every instant of the integration, from first contact to the end, to `watch`, together with the
/// force \[N\].
pub fn follow<D: Damped + Copy>(
    model: &Model<D>,
    impact: &Impact,
    mut watch: impl FnMut(&State, f64),
) -> Option<Prediction> {
    let positive = |value: f64| value > 0.0 && value < f64::INFINITY;
    let energy = impact.energy();
    // a subnormal energy has already lost digits
    if !positive(impact.mass) || !positive(impact.speed) || !positive(energy) || energy < f64::MIN_POSITIVE {
        return None;
    }
    let motion = Motion::new(model, impact)?;
    let mut state = State { time: 0.0, indentation: 0.0, speed: impact.speed };
    let mut step = 1e-6 * motion.time;
    let (mut turning, mut max_force) = (state, motion.force(&state));
    watch(&state, 0.0);
    for _ in 0..MOST_STEPS {
        let (next, error) = motion.step(&state, step);
        let factor = runge_kutta::factor(TOLERANCE, error);
        // written positively to reject NaN
        let accepted = error <= TOLERANCE;
        if !accepted {
            step *= if factor > 0.1 { factor } else { 0.1 };
            continue;
        }
        if state.speed > 0.0 && next.speed <= 0.0 {
            turning = motion.event(&state, step, |state| state.speed <= 0.0);
        }
        max_force = largest(max_force, motion.largest_force(&state, &next, step));
        if motion.lets_go_or_grips(&state, &next) {
            state = motion.event(&state, step, |later| motion.lets_go_or_grips(&state, later));
            watch(&state, motion.force(&state));
            // the force of a grip begins with zero, and a longer step could miss it
            if state.indentation > 0.0 {
                step = smallest(step, 0.25 * state.indentation / fabs(state.speed));
            }
            continue;
        }
        if motion.is_over(&next) {
            let end = motion.event(&state, step, |state| motion.is_over(state));
            watch(&end, 0.0);
            let rebound_energy = 0.5 * impact.mass * end.speed * end.speed;
            return Some(Prediction {
                max_indentation: turning.indentation,
                max_force,
                max_contact_radius: sqrt(model.pair.radius * turning.indentation),
                regime: Regime::Elastic,
                residual_indentation: 0.0,
                energy,
                rebound_energy,
                restitution: -end.speed / impact.speed,
                loading_time: turning.time,
                unloading_time: end.time - turning.time,
            });
        }
        state = next;
        watch(&state, motion.force(&state));
        step *= if factor < 5.0 { factor } else { 5.0 };
    }
    None
}

/// The motion of a mass under the law.
struct Motion<'a, D> {
    law: &'a D,
    elastic: f64,
    damping: f64,
    mass: f64,
    speed: f64,
    /// Scale of the indentation \[m\]: the elastic energy there is the kinetic energy.
    length: f64,
    /// Scale of the time \[s\].
    time: f64,
}

impl<'a, D: Damped + Copy> Motion<'a, D> {
    fn new(model: &'a Model<D>, impact: &Impact) -> Option<Motion<'a, D>> {
        let Impact { mass, speed } = *impact;
        let factors = model.law.factors(&model.pair, model.restitution, model.mass);
        let by_touch = model.law.scaled_by_touch();
        let damping = if by_touch { factors.damping / speed } else { factors.damping };
        let energy = 0.5 * mass * speed * speed;
        let (mut low, mut high) = (0u64, LARGEST_INDENTATION.to_bits());
        let holds = factors.elastic * model.law.elastic(LARGEST_INDENTATION).integral > energy;
        while high - low > 1 {
            // the bits of positive f64 numbers, read as integers, keep their order
            let middle = low + (high - low) / 2;
            let beyond = factors.elastic * model.law.elastic(f64::from_bits(middle)).integral > energy;
            *(if beyond { &mut high } else { &mut low }) = middle;
        }
        let length = f64::from_bits(high);
        holds.then_some(Motion {
            law: &model.law,
            elastic: factors.elastic,
            damping,
            mass,
            speed,
            length,
            time: length / speed,
        })
    }

    /// Force \[N\]. It is negative where the surface would have to pull, so that the end of the contact is a change of sign; zero
    /// where such a surface grips again.
    fn force(&self, state: &State) -> f64 {
        let d = state.indentation;
        let sum = if d > 0.0 {
            self.elastic * self.law.elastic(d).value + self.damping * state.speed * self.law.damping(d).value
        } else {
            0.0
        };
        if self.law.grips_again() { largest(sum, 0.0) } else { sum }
    }

    fn is_over(&self, state: &State) -> bool {
        let without_force = || self.force(state) <= 0.0 && !self.law.grips_again();
        state.speed < 0.0 && (state.indentation <= 0.0 || without_force())
    }

    /// Whether a surface that grips again has let go of the bodies, or gripped, on the way `from` one state to a later one.
    fn lets_go_or_grips(&self, from: &State, later: &State) -> bool {
        // it lags behind in a separation only, and ends with a force
        let pushes = |state: &State| state.speed >= 0.0 || state.indentation <= 0.0 || self.force(state) > 0.0;
        self.law.grips_again() && pushes(from) != pushes(later)
    }

    /// The state after `step` \[s\], and the relative error.
    fn step(&self, state: &State, step: f64) -> (State, f64) {
        let at = |&[indentation, speed]: &[f64; 2]| State { time: state.time + step, indentation, speed };
        let slope = |numbers: &[f64; 2]| Some([numbers[1], -self.force(&at(numbers)) / self.mass]);
        let Some((next, [length, speed])) = runge_kutta::step(&[state.indentation, state.speed], step, slope) else {
            return (*state, f64::INFINITY);
        };
        (at(&next), largest(fabs(length) / self.length, fabs(speed) / self.speed))
    }

    /// The state within the `step` from `state` at which `happens` becomes true. It must be true at the end of the step.
    fn event(&self, state: &State, step: f64, happens: impl Fn(&State) -> bool) -> State {
        let (mut low, mut high) = (0.0, step);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if happens(&self.step(state, middle).0) { &mut high } else { &mut low }) = middle;
        }
        self.step(state, high).0
    }

    /// The largest force between `state` and `next` \[N\]: at an end, or at a maximum, which is found by section search.
    fn largest_force(&self, state: &State, next: &State, step: f64) -> f64 {
        let (mut low, mut high) = (0.0, step);
        let force = |step: f64| self.force(&self.step(state, step).0);
        let ends = largest(self.force(state), self.force(next));
        // the force is smooth: if it is lower in the middle, or monotone, the maximum is at an end
        if force(0.5 * step) <= 0.5 * (self.force(state) + self.force(next)) {
            return ends;
        }
        for _ in 0..50 {
            let third = (high - low) / 3.0;
            if force(low + third) < force(high - third) {
                low += third;
            } else {
                high -= third;
            }
        }
        largest(ends, force(0.5 * (low + high)))
    }
}
