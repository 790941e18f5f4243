//! The motion of bodies of known mass under a rate-dependent law.
//!
//! From touch to separation, a pair of Runge-Kutta methods follows the motion; between contacts it is a parabola. The heat is
//! what the energy balance of the contact leaves, so that the balance is exact whatever the errors of the integration are. A
//! flight spends nothing: rounding of its energy, which may be much larger, is no heat.

mod integration;

use super::{Damped, History, Sum, within};
use crate::damped::Model;
use crate::motion::flight::Flight;
use crate::motion::{Drive, MOST_EVALUATIONS, NoMotion, Outcome, SMALLEST_MOTION};
use crate::numbers::{largest, smallest};
use crate::regime::TooDeep;
use crate::runge_kutta::{self, EVALUATIONS};
use libm::{fabs, sqrt};

/// Largest error of a step of the integration, relative to the largest indentation and speed of the contact.
const TOLERANCE: f64 = 1e-12;

/// Largest number of contacts and flights in a step.
const MOST_EVENTS: u32 = MOST_EVALUATIONS / 10;

/// Indentation \[m\] and closing speed \[m/s\].
#[derive(Clone, Copy, Debug)]
struct State {
    depth: f64,
    speed: f64,
}

/// The bodies during a step.
struct Bodies<D> {
    contact: History<D>,
    inverse_mass: f64,
    acceleration: f64,
    state: State,
    /// The largest indentation and speed of the present contact \[m, m/s\].
    scale: State,
    /// Energy that the bodies have spent in contact, over their mass \[J/kg\].
    spent: f64,
    /// Closing speed removed by the contact force so far \[m/s\].
    taken: f64,
    /// Time left \[s\].
    left: f64,
    /// The largest indentation so far of contacts that have ended \[m\].
    deepest: f64,
    evaluations: u32,
}

/// Moves the contact through `step` \[s\] > 0, with the closing speed `speed` \[m/s\] at the start.
///
/// # Errors
/// [`NoMotion`]; the history is then unchanged.
pub fn follow<D: Damped + Copy>(
    history: &mut History<D>,
    _model: &Model<D>,
    drive: &Drive,
    speed: f64,
    step: f64,
) -> Result<Outcome, NoMotion> {
    let Drive { mass, acceleration } = *drive;
    if let Some(&number) = [speed, step, acceleration].iter().find(|number| !number.is_finite()) {
        return Err(TooDeep { indentation: number }.into());
    }
    let state = State { depth: history.indentation(), speed };
    // of bodies at rest, the speed of an oscillation of this size
    let swing = sqrt(history.stiffness(0.0) / mass) * largest(state.depth, 0.0);
    let mut bodies = Bodies {
        contact: *history,
        inverse_mass: 1.0 / mass,
        acceleration,
        state,
        scale: State {
            depth: if state.depth < SMALLEST_MOTION { 0.0 } else { state.depth },
            speed: largest(fabs(speed), swing),
        },
        spent: 0.0,
        taken: 0.0,
        left: step,
        deepest: history.max_indentation(),
        evaluations: 0,
    };
    let before = history.stored();
    bodies.run()?;
    let Bodies { contact: mut next, state: end, spent, taken, evaluations, deepest, .. } = bodies;
    next.dissipated = next.dissipated.plus(mass * spent - (next.stored() - before));
    let finite = next.stored() + next.dissipated.total() < f64::INFINITY && next.force(end.speed) < f64::INFINITY;
    if !finite {
        return Err(TooDeep { indentation: end.depth }.into());
    }
    *history = next;
    let deepest = largest(deepest, next.max_indentation);
    Ok(Outcome { speed: end.speed, taken: largest(taken, 0.0), evaluations, deepest })
}

impl<D: Damped + Copy> Bodies<D> {
    fn run(&mut self) -> Result<(), NoMotion> {
        for _ in 0..MOST_EVENTS {
            if self.left <= 0.0 {
                return Ok(());
            }
            let State { depth, speed } = self.state;
            let closes = speed > 0.0 || (speed == 0.0 && self.acceleration > 0.0);
            if depth < 0.0 || (depth == 0.0 && !closes) { self.fly()? } else { self.press()? }
        }
        Err(NoMotion::TooLong)
    }

    /// Puts the bodies into this state.
    fn go_to(&mut self, state: State) -> Result<(), TooDeep> {
        self.contact.indentation = Sum::new(within(state.depth)?);
        self.contact.max_indentation = largest(self.contact.max_indentation, state.depth);
        self.state = state;
        Ok(())
    }

    /// Flight: until the bodies touch, or until the end of the step.
    fn fly(&mut self) -> Result<(), TooDeep> {
        let State { depth, speed } = self.state;
        let flight = Flight { speed, acceleration: self.acceleration };
        if let Some(arrival) = flight.arrival(-depth, self.left) {
            self.left -= arrival.time;
            return self.go_to(State { depth: 0.0, speed: arrival.speed });
        }
        let (goal, end) = (depth + flight.way(self.left), flight.speed_after(self.left));
        self.left = 0.0;
        // rounding must not turn a flight into a contact
        self.go_to(State { depth: if goal > 0.0 { 0.0 } else { goal }, speed: end })
    }

    /// Contact: until the bodies separate, come to rest, or until the end of the step.
    fn press(&mut self) -> Result<(), NoMotion> {
        let State { depth, speed } = self.state;
        if depth == 0.0 {
            self.deepest = largest(self.deepest, self.contact.max_indentation);
            self.contact.max_indentation = 0.0;
            self.contact.touch_speed = 0.0;
            self.scale = State { depth: 0.0, speed };
        }
        self.note_speed();
        if depth > 0.0 && self.rests() {
            self.rest();
            return Ok(());
        }
        let mut guess = if depth < SMALLEST_MOTION { self.first_guess() } else { self.left };
        while self.left > 0.0 {
            let step = self.limited(guess);
            self.evaluations += EVALUATIONS;
            if self.evaluations > MOST_EVALUATIONS {
                return Err(NoMotion::TooLong);
            }
            let (next, error) = self.stepped(step);
            let factor = runge_kutta::factor(TOLERANCE, error);
            // written positively to reject NaN
            let accepted = error <= TOLERANCE;
            if !accepted {
                guess = step * if factor > 0.1 { factor } else { 0.1 };
                if guess <= f64::MIN_POSITIVE {
                    return Err(NoMotion::TooLong);
                }
                continue;
            }
            let change = self.until_border(step, &next).or_else(|| self.until_grip(step, &next));
            if let Some(shorter) = change.or_else(|| self.until_largest_speed(step, &next)) {
                guess = shorter;
                continue;
            }
            if self.state.speed > 0.0 && next.speed < 0.0 {
                let (_, turning) = self.event(step, |_, state| state.speed <= 0.0);
                self.contact.max_indentation = largest(self.contact.max_indentation, turning.depth);
            }
            if next.depth <= 0.0 && self.state.depth + next.depth < self.state.depth {
                let (time, end) = self.event(step, |_, state| state.depth <= 0.0);
                return Ok(self.pass(time, State { depth: 0.0, ..end })?);
            }
            let before = self.state;
            self.pass(step, next)?;
            self.note_speed();
            if self.rests() {
                self.rest();
                return Ok(());
            }
            guess = smallest(step * if factor < 5.0 { factor } else { 5.0 }, self.of_grip(&before));
        }
        Ok(())
    }

    /// Bodies at rest stay where they are. What is left of their speed is below all digits of the motion.
    fn rest(&mut self) {
        self.taken += self.acceleration * self.left + self.state.speed;
        self.spent += 0.5 * self.state.speed * self.state.speed;
        (self.state.speed, self.left) = (0.0, 0.0);
    }

    /// Keeps the largest speed since the contact began as that of the first touch. In a free impact that is the speed at first
    /// touch. Bodies that touch slowly and are accelerated would otherwise have a damping without bound.
    fn note_speed(&mut self) {
        let speed = fabs(self.state.speed);
        let known = if self.contact.touch_speed < f64::INFINITY { self.contact.touch_speed } else { 0.0 };
        let largest = largest(known, speed);
        self.contact.touch_speed = if largest > 0.0 { largest } else { f64::INFINITY };
    }

    /// Moves the bodies to `next`, `time` \[s\] later.
    fn pass(&mut self, time: f64, next: State) -> Result<(), TooDeep> {
        let State { depth, speed } = self.state;
        self.left -= time;
        // v0^2 - v1^2 without loss of digits
        self.spent += 0.5 * (speed - next.speed) * (speed + next.speed) + self.acceleration * (next.depth - depth);
        self.taken += self.acceleration * time - (next.speed - speed);
        let scale = self.scale;
        self.scale = State { depth: largest(scale.depth, next.depth), speed: largest(scale.speed, fabs(next.speed)) };
        self.go_to(next)
    }
}
