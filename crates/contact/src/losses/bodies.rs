//! The motion of bodies of known mass under a contact with losses, and of bodies that press on a plate.
//!
//! From event to event as without losses; between two events a pair of Runge-Kutta methods follows the motion. The heat is
//! what the energy balance of the contact leaves, so that the balance is exact whatever the errors of the integration are. A
//! flight spends nothing: rounding of its energy, which may be much larger, is no heat.

use super::history::History;
use super::stretch::{Ended, State, Stretch};
use super::{Damping, Form, Loss, Model};
use crate::loading::Loading;
use crate::motion::flight::Flight;
use crate::motion::{COSTLY, Drive, MOST_EVALUATIONS, NoMotion, Outcome};
use crate::numbers::{largest, quotient};
use crate::piece::Piece;
use crate::regime::TooDeep;
use crate::unloading::Unloading;
use libm::fabs;

/// Newton's steps to the balance of a plate, which is near.
const SETTLING: u32 = 3;

/// Largest number of events in a step.
const MOST_EVENTS: u32 = MOST_EVALUATIONS / 10;

/// The bodies during a step.
pub(super) struct Bodies<'a, L, U, K> {
    pub contact: History<K>,
    model: &'a Model<L, U, K>,
    inverse_mass: f64,
    acceleration: f64,
    /// Closing speed \[m/s\].
    pub speed: f64,
    /// Whether the indentation has just turned, and then where to.
    turned: Option<bool>,
    /// Distance by which the bodies have come closer since the last event \[m\].
    way: f64,
    /// Energy that the bodies have spent in contact, over their mass \[J/kg\].
    spent: f64,
    /// Distance by which the target has given way \[m\].
    retreat: f64,
    /// Energy that the target has carried away by giving way \[J\].
    heat: f64,
    /// Closing speed removed by the contact force so far \[m/s\].
    taken: f64,
    /// Time left \[s\].
    left: f64,
    /// The next step of the integration to try \[s\].
    pub guess: f64,
    /// Evaluations left.
    evaluations: u32,
    /// The largest indentation before the last event \[m\], whatever a fresh surface has forgotten there.
    deepest: f64,
}

impl<'a, L: Loading, U: Unloading, K: Loss> Bodies<'a, L, U, K> {
    /// Bodies with this inverse mass \[1/kg\], acceleration \[m/s^2\] and closing speed \[m/s\], for `time` \[s\].
    pub fn new(
        contact: &History<K>,
        model: &'a Model<L, U, K>,
        (inverse_mass, acceleration, speed): (f64, f64, f64),
        time: f64,
    ) -> Result<Bodies<'a, L, U, K>, TooDeep> {
        if let Some(&number) = [speed, time, acceleration].iter().find(|number| !number.is_finite()) {
            return Err(TooDeep { indentation: number });
        }
        let evaluations = if model.plastic.is_segmented() { MOST_EVALUATIONS } else { MOST_EVALUATIONS / COSTLY };
        Ok(Bodies {
            contact: *contact,
            model,
            inverse_mass,
            acceleration,
            speed,
            turned: None,
            way: 0.0,
            spent: 0.0,
            retreat: 0.0,
            heat: 0.0,
            taken: 0.0,
            left: time,
            guess: time,
            evaluations,
            deepest: 0.0,
        })
    }

    fn indentation(&self) -> f64 {
        self.contact.plastic.indentation()
    }

    /// Follows the motion to the end of the time.
    ///
    /// # Errors
    /// [`NoMotion`].
    pub fn run(&mut self) -> Result<(), NoMotion> {
        for _ in 0..MOST_EVENTS {
            if self.left <= 0.0 {
                return Ok(());
            }
            let below = self.below();
            if self.is_above(below.lower) { self.fly(below.lower)? } else { self.spend(below)? }
        }
        Err(NoMotion::TooLong)
    }

    /// Motion in contact to the next event, with the energy that the bodies spend.
    fn spend(&mut self, below: Piece<'a, L, U>) -> Result<(), NoMotion> {
        let (speed, taken) = (self.speed, self.taken);
        self.way = 0.0;
        self.press_from(below, &mut |_, _| ())?;
        // without force they spend nothing, and the difference would be rounding
        if self.taken != taken {
            // v0^2 - v1^2 without loss of digits
            self.spent += 0.5 * (speed - self.speed) * (speed + self.speed) + self.acceleration * self.way;
        }
        Ok(())
    }

    /// The piece between the largest indentation and the surface of the dent, which is its lower end. One event takes both
    /// from one evaluation; see [`Piece::ahead`].
    fn below(&self) -> Piece<'a, L, U> {
        Piece::at(&self.model.plastic, self.indentation(), self.contact.plastic.max_indentation(), false)
    }

    /// Whether there is no contact: the bodies are apart, or at the surface and not closing.
    pub fn is_apart(&self) -> bool {
        self.is_above(self.below().lower)
    }

    /// The same for a `surface` \[m\].
    fn is_above(&self, surface: f64) -> bool {
        let indentation = self.indentation();
        let closes = self.speed > 0.0 || (self.speed == 0.0 && self.acceleration > 0.0);
        indentation < surface || (indentation == surface && !closes)
    }

    /// The largest indentation of the motion so far \[m\], also where a fresh surface has forgotten it.
    pub fn deepest(&self) -> f64 {
        largest(self.deepest, self.contact.plastic.max_indentation())
    }

    /// Puts the contact at `indentation` \[m\].
    fn go_to(&mut self, indentation: f64, rising: bool) -> Result<(), TooDeep> {
        self.deepest = self.deepest();
        self.contact.plastic.go_to(&self.model.plastic, indentation, rising)
    }

    /// Flight: until the bodies touch the `surface` \[m\], until a fresh surface forgets its dent, or until the end of the time.
    fn fly(&mut self, surface: f64) -> Result<(), TooDeep> {
        let indentation = self.indentation();
        // every contact has its own largest speed
        self.contact.swiftest = 0.0;
        let flight = Flight { speed: self.speed, acceleration: self.acceleration };
        let closing = flight.arrival(surface - indentation, self.left);
        let end = closing.map_or(self.left, |arrival| arrival.time);
        let forgets = History::<K>::forgets(&self.model.plastic) && indentation > 0.0;
        let parting = if forgets { flight.reversed().arrival(indentation, end) } else { None };
        self.turned = None;
        if let Some(arrival) = parting {
            self.left -= arrival.time;
            self.speed = -arrival.speed;
            return self.go_to(0.0, false);
        }
        if let Some(arrival) = closing {
            self.left -= arrival.time;
            self.speed = arrival.speed;
            self.contact.swiftest = self.speed;
            return self.go_to(surface, true);
        }
        let goal = indentation + flight.way(self.left);
        self.speed = flight.speed_after(self.left);
        self.left = 0.0;
        // rounding must not turn a flight into a contact
        self.go_to(if goal >= surface { surface } else { goal }, false)
    }

    /// Motion in contact: until the indentation turns, until the end of the smooth piece, or until the end of the time.
    pub fn press(&mut self, watch: &mut dyn FnMut(&State, f64)) -> Result<(), NoMotion> {
        self.press_from(self.below(), watch)
    }

    /// The same, with the piece `below` the largest indentation.
    fn press_from(&mut self, below: Piece<'a, L, U>, watch: &mut dyn FnMut(&State, f64)) -> Result<(), NoMotion> {
        let (start, surface) = (self.indentation(), below.lower);
        let largest_so_far = self.contact.plastic.max_indentation();
        let damping = Damping { swiftest: self.contact.swiftest, ..self.contact.damping_for(0.0) };
        let rate = self.speed - damping.retreat(below.force(start));
        let net = self.acceleration - below.force(start) * self.inverse_mass;
        if self.is_stuck(&damping, below.force(start)) {
            self.taken += self.acceleration * self.left;
            self.left = 0.0;
            return Ok(());
        }
        let rising = match self.turned {
            Some(rising) => rising,
            None if rate != 0.0 => rate > 0.0,
            None => net > 0.0,
        };
        let piece = if rising && start >= largest_so_far {
            Piece::at(&self.model.plastic, start, largest_so_far, true)
        } else {
            below
        };
        let (inverse_mass, acceleration) = (self.inverse_mass, self.acceleration);
        let mut stretch = Stretch {
            piece: &piece,
            damping,
            inverse_mass,
            acceleration,
            start,
            surface,
            rising,
            leads: false,
            slack: false,
        };
        let (state, ended) = stretch.run(self.speed, self.left, &mut self.guess, &mut self.evaluations, watch);
        let end = stretch.indentation(&state);
        self.contact.swiftest = stretch.damping.swiftest;
        self.taken += acceleration * state.time - (state.speed - self.speed);
        self.left -= state.time;
        (self.way, self.retreat) = (self.way + state.way, self.retreat + state.retreat);
        self.heat += state.heat;
        self.speed = state.speed;
        self.turned = (ended == Ended::Turned).then_some(!rising);
        match ended {
            Ended::TooLong => return Err(NoMotion::TooLong),
            Ended::AtBorder => self.go_to(if rising { piece.upper } else { piece.lower }, rising)?,
            // rounding must not lead off the piece
            _ => self.go_to(if end > piece.lower { end } else { piece.lower }, rising)?,
        }
        if ended == Ended::AtRest {
            if inverse_mass == 0.0 && self.speed > 0.0 {
                self.settle(&stretch)?;
            }
            self.rest(&stretch, &state);
        }
        Ok(())
    }

    /// Puts a contact on a plate where the plate gives way at the speed of the bodies.
    fn settle(&mut self, stretch: &Stretch<L, U>) -> Result<(), TooDeep> {
        let before = self.indentation();
        let mut d = before;
        for _ in 0..SETTLING {
            let rate = self.speed - stretch.damping.retreat(stretch.piece.force(d));
            let easing = stretch.damping.retreat(stretch.piece.stiffness(d));
            let next = d + quotient(rate, easing, easing > 0.0, 0.0);
            // the balance is near, and on the same piece
            let is_near = next > stretch.surface && next < stretch.piece.upper;
            d = if is_near { next } else { d };
        }
        self.retreat -= d - before;
        let deeper = d >= self.contact.plastic.max_indentation();
        self.go_to(d, deeper || stretch.rising && d > before)
    }

    /// Bodies at rest stay where they are. On a plate they keep the speed at which it gives way to them; a given speed stays.
    fn rest(&mut self, stretch: &Stretch<L, U>, state: &State) {
        let (force, _) = stretch.force_and_rate(state);
        if self.inverse_mass > 0.0 {
            self.speed = stretch.damping.retreat(force);
        }
        let way = self.speed * self.left;
        // the force at which the plate gives way at this speed
        let mobility = stretch.damping.retreat(1.0);
        let steady = quotient(self.speed, mobility, mobility > 0.0, 0.0);
        self.way += way;
        self.retreat += way;
        self.heat += steady * way;
        self.taken += self.acceleration * self.left;
        self.left = 0.0;
    }

    /// Whether bodies at rest cannot move in either direction. The damping has no scale then: like dry friction, it takes up
    /// any small difference of the forces.
    fn is_stuck(&self, damping: &Damping, force: f64) -> bool {
        if damping.form != Form::Proportional || self.speed != 0.0 || damping.swiftest != 0.0 {
            return false;
        }
        let net = |gain: f64| self.acceleration - force * largest(gain, 0.0) * self.inverse_mass;
        net(1.0 + damping.factor) <= 0.0 && net(1.0 - damping.factor) >= 0.0
    }
}

/// Moves the contact through `step` \[s\] > 0, with the closing speed `speed` \[m/s\] at the start.
///
/// # Errors
/// [`NoMotion`]; the history is then unchanged.
pub fn follow<L: Loading, U: Unloading, K: Loss>(
    history: &mut History<K>,
    model: &Model<L, U, K>,
    drive: &Drive,
    speed: f64,
    step: f64,
) -> Result<Outcome, NoMotion> {
    let Drive { mass, acceleration } = *drive;
    let before = history.plastic.work(&model.plastic);
    let mut bodies = Bodies::new(history, model, (1.0 / mass, acceleration, speed), step)?;
    bodies.run()?;
    let deepest = bodies.deepest();
    let Bodies { contact: mut next, speed: end, spent, taken, evaluations, .. } = bodies;
    // also without force a surface that lags behind the bodies relaxes
    let heat = mass * spent - (next.plastic.work(&model.plastic) - before);
    next.take(model, heat)?;
    *history = next;
    let most = if model.plastic.is_segmented() { MOST_EVALUATIONS } else { MOST_EVALUATIONS / COSTLY };
    Ok(Outcome { speed: end, taken: largest(taken, 0.0), evaluations: most.saturating_sub(evaluations), deepest })
}

/// The contact on a plate after `step` \[s\] of bodies that close at `rate` \[m/s\], and its impulse \[N.s\].
///
/// # Errors
/// [`TooDeep`] outside the range of the law, and for a step that would take too many evaluations.
pub(super) fn driven<L: Loading, U: Unloading, K: Loss>(
    history: &History<K>,
    model: &Model<L, U, K>,
    rate: f64,
    step: f64,
) -> Result<(History<K>, f64), TooDeep> {
    let mobility = history.damping_for(rate).retreat(1.0);
    let mut bodies = Bodies::new(history, model, (0.0, 0.0, rate), step)?;
    bodies.run().map_err(|reason| match reason {
        NoMotion::TooDeep(deep) => deep,
        NoMotion::TooLong => TooDeep { indentation: history.plastic.indentation() + rate * step },
    })?;
    let Bodies { contact: mut next, retreat, heat, .. } = bodies;
    next.take(model, heat)?;
    Ok((next, retreat / mobility))
}

/// A time that is short for the bodies of an impact \[s\]: a thousandth of that in which they move by `indentation` \[m\].
pub(super) fn short_time(indentation: f64, speed: f64) -> f64 {
    1e-3 * fabs(indentation) / speed
}
