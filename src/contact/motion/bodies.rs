//! The bodies on their way through a step, from event to event: touch, corner of the law, turning point, separation.

use super::field::{Field, Forces, Start};
use super::flight::Flight;
use super::travel::{Passage, pass};
use super::{COSTLY, Drive, MOST_EVALUATIONS, MOST_PERIODS, NoMotion, Outcome, SMALLEST};
use crate::contact::history::{History, TooDeep};
use crate::contact::loading::Loading;
use crate::contact::numbers::{largest, smallest};
use crate::contact::piece::Piece;
use crate::contact::unloading::Unloading;
use crate::contact::{Model, Surface};
use core::cell::Cell;
use libm::{fabs, floor};

/// The bodies as far as they have come. The history follows where it must: where a dent is left behind, and at the end.
pub struct Bodies<'a, L, U> {
    history: &'a mut History,
    model: &'a Model<L, U>,
    drive: &'a Drive,
    /// Where they are \[m\].
    indentation: f64,
    /// Closing speed \[m/s\].
    speed: f64,
    /// The largest indentation of the dent \[m\].
    largest: f64,
    /// Where the surface of that dent is met \[m\], if that has been asked.
    surface: Option<f64>,
    /// Direction of the last motion.
    rising: bool,
    /// Whether they turned at the last event.
    turned: bool,
    /// Speed that the contact force has taken so far \[m/s\].
    taken: f64,
    /// Time left \[s\].
    left: f64,
    /// The largest indentation so far \[m\], of a dent that is left behind.
    deepest: f64,
    /// The last time that they turned in the contact.
    turn: Option<Turn>,
    events: u32,
    evaluations: Cell<u32>,
}

/// A turning point at the deepest place of a contact.
#[derive(Clone, Copy)]
struct Turn {
    /// The largest indentation then \[m\].
    largest: f64,
    /// Since then \[s\].
    ago: f64,
    /// Whether a dent was left behind since then.
    forgot: bool,
}

/// What a dent may grow by rounding, as a part of the indentation.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A way, as a part of the indentation, on which a law without segments is as its tangent: what that misses of the change of force
/// is what the rounding of the force makes of it.
const SHORT: f64 = 1e-8;

/// A speed that is none, as a part of what the forces make in the time left.
const NOTHING: f64 = 1e-100;

/// Evaluations that it takes to find a piece of a law that has segments.
const PIECE: u32 = 10;

/// Events after which a step is given up, as after [`MOST_EVALUATIONS`]: bodies in flight take none.
const MOST_EVENTS: u32 = MOST_EVALUATIONS / PIECE;

/// What a stretch has come to.
struct Progress {
    /// \[m\]
    indentation: f64,
    /// \[m/s\]
    speed: f64,
    /// \[s\]
    time: f64,
    turned: bool,
}

impl<'a, L: Loading, U: Unloading> Bodies<'a, L, U> {
    /// The bodies at the start of a step.
    ///
    /// # Errors
    /// [`TooDeep`] for numbers that aren't finite.
    pub fn new(
        history: &'a mut History,
        model: &'a Model<L, U>,
        drive: &'a Drive,
        speed: f64,
        step: f64,
    ) -> Result<Bodies<'a, L, U>, TooDeep> {
        let (indentation, largest) = (history.indentation(), history.max_indentation());
        if let Some(&number) = [speed, step, drive.acceleration].iter().find(|number| !number.is_finite()) {
            return Err(TooDeep { indentation: number });
        }
        Ok(Bodies {
            history,
            model,
            drive,
            indentation,
            speed,
            largest,
            surface: None,
            rising: speed > 0.0,
            turned: false,
            taken: 0.0,
            left: step,
            deepest: 0.0,
            turn: None,
            events: 0,
            evaluations: Cell::new(0),
        })
    }

    /// Goes on to the next event; false at the end of the step.
    ///
    /// # Errors
    /// [`NoMotion`].
    pub fn go_on(&mut self) -> Result<bool, NoMotion> {
        self.events += 1;
        if self.events > MOST_EVENTS || self.evaluations.get() > MOST_EVALUATIONS {
            return Err(NoMotion::TooLong);
        }
        if self.is_apart() {
            self.fly()?;
        } else if let Some(rising) = self.direction() {
            self.press(rising)?;
        } else {
            self.rest();
        }
        Ok(self.left > 0.0)
    }

    /// The end of the step, where the history is left.
    ///
    /// # Errors
    /// [`TooDeep`].
    pub fn stop(mut self) -> Result<Outcome, NoMotion> {
        self.settle()?;
        let deepest = largest(self.deepest, self.largest);
        // the contact only pushes: less than nothing is rounding
        let taken = largest(self.taken, 0.0);
        Ok(Outcome { speed: self.speed, taken, evaluations: self.evaluations.get(), deepest })
    }

    /// Brings the history to where the bodies are.
    fn settle(&mut self) -> Result<(), TooDeep> {
        if self.largest > self.history.max_indentation() {
            self.history.go_to(self.model, self.largest, true)?;
        }
        self.history.go_to(self.model, self.indentation, self.rising)
    }

    /// Where the surface is met \[m\]: at the dent that there is.
    fn surface(&mut self) -> f64 {
        let (model, largest) = (self.model, self.largest);
        *self
            .surface
            .get_or_insert_with(|| if model.is_elastic_at(largest) { 0.0 } else { model.unloading_path(largest).lower })
    }

    /// Whether nothing slows the bodies down now: they are apart, or at the surface and not closing.
    fn is_apart(&mut self) -> bool {
        let indentation = self.indentation;
        let closes = self.speed > 0.0 || (self.speed == 0.0 && self.drive.acceleration > 0.0);
        // on the loading curve the surface is far below
        if closes && indentation > 0.0 && indentation >= self.largest {
            return false;
        }
        let surface = self.surface();
        indentation < surface || (indentation == surface && !closes)
    }

    /// Flight: to the surface, to where a fresh surface forgets its dent, or to the end of the step.
    fn fly(&mut self) -> Result<(), TooDeep> {
        let (surface, indentation) = (self.surface(), self.indentation);
        let flight = Flight { speed: self.speed, acceleration: self.drive.acceleration };
        let closing = flight.arrival(surface - indentation, self.left);
        let end = closing.map_or(self.left, |arrival| arrival.time);
        let forgets = self.model.surface == Surface::Fresh && indentation > 0.0;
        let parting = if forgets { flight.reversed().arrival(indentation, end) } else { None };
        if let Some(arrival) = parting {
            self.pass(arrival.time);
            (self.indentation, self.speed, self.rising) = (0.0, -arrival.speed, false);
            return self.forget();
        }
        if let Some(arrival) = closing {
            self.pass(arrival.time);
            (self.indentation, self.speed, self.rising) = (surface, arrival.speed, true);
            return Ok(());
        }
        let goal = indentation + flight.way(self.left);
        // rounding must not make a contact of a flight
        self.indentation = if goal >= surface { surface } else { goal };
        self.speed = flight.speed_after(self.left);
        self.rising = goal > indentation;
        self.left = 0.0;
        Ok(())
    }

    /// Leaves the dent behind.
    fn forget(&mut self) -> Result<(), TooDeep> {
        self.settle()?;
        self.deepest = largest(self.deepest, self.largest);
        (self.largest, self.surface) = (self.history.max_indentation(), None);
        if let Some(turn) = &mut self.turn {
            turn.forgot = true;
        }
        Ok(())
    }

    /// Lets `time` \[s\] pass.
    fn pass(&mut self, time: f64) {
        self.left -= time;
        if let Some(turn) = &mut self.turn {
            turn.ago += time;
        }
    }

    /// Bodies at rest stay where they are: the forces balance.
    fn rest(&mut self) {
        self.taken += self.drive.acceleration * self.left;
        (self.speed, self.left) = (0.0, 0.0);
    }

    fn forces(&self) -> Forces {
        Forces { inverse_mass: 1.0 / self.drive.mass, acceleration: self.drive.acceleration }
    }

    /// The direction of the motion under force; at rest that of the force, or none if it is in balance.
    fn direction(&self) -> Option<bool> {
        if self.speed != 0.0 {
            return Some(self.speed > 0.0);
        }
        let forces = self.forces();
        let net = |rising| {
            let piece = Piece::at(self.model, self.indentation, self.largest, rising);
            forces.acceleration - piece.force(self.indentation) * forces.inverse_mass
        };
        // what has turned goes back; the force may jump, or be in balance within rounding
        let may = |rising| !(self.turned && self.rising == rising);
        if may(true) && net(true) > 0.0 {
            Some(true)
        } else if may(false) && net(false) < 0.0 {
            Some(false)
        } else {
            None
        }
    }

    /// Under force: to where the bodies turn, to the end of the smooth piece, or to the end of the step.
    fn press(&mut self, rising: bool) -> Result<(), NoMotion> {
        let piece = Piece::at(self.model, self.indentation, self.largest, rising);
        let found = if piece.whole().is_some() { PIECE } else { COSTLY * PIECE };
        self.evaluations.set(self.evaluations.get().saturating_add(found));
        let progress = self.stretch(&piece, rising)?;
        // what turns and at once turns back has no room to move
        if self.turned && progress.turned && progress.time == 0.0 {
            self.rest();
            return Ok(());
        }
        self.taken += self.drive.acceleration * progress.time - (progress.speed - self.speed);
        self.pass(progress.time);
        (self.indentation, self.speed) = (progress.indentation, progress.speed);
        (self.rising, self.turned) = (rising, progress.turned);
        if self.indentation > self.largest {
            (self.largest, self.surface) = (self.indentation, None);
        }
        let parts = !rising && self.indentation <= piece.lower && !progress.turned;
        if parts && self.model.surface == Surface::Fresh && self.indentation <= 0.0 {
            self.forget()?;
        }
        if rising && progress.turned { self.repeat() } else { Ok(()) }
    }

    /// The way on one smooth `piece`.
    fn stretch(&self, piece: &Piece<'a, L, U>, rising: bool) -> Result<Progress, NoMotion> {
        let Bodies { indentation, speed, left, .. } = *self;
        let forces = self.forces();
        let net = forces.acceleration - piece.force(indentation) * forces.inverse_mass;
        let sign = if rising { 1.0 } else { -1.0 };
        let pull = sign * net;
        // squared it would be lost beside the others
        let speed = if fabs(speed) > NOTHING * fabs(net) * left { speed } else { 0.0 };
        let bound = if rising { piece.upper - indentation } else { indentation - piece.lower };
        // written positively, so that a NaN ends it
        let (has_room, goes_on) = (bound > 0.0, speed != 0.0 || pull > 0.0);
        if !has_room || !goes_on {
            return Ok(Progress { indentation, speed: 0.0, time: 0.0, turned: true });
        }
        if bound < SMALLEST {
            let border = if rising { piece.upper } else { piece.lower };
            return Ok(Progress { indentation: border, speed, time: 0.0, turned: false });
        }
        // no farther than without more force than there is now
        let reach = left * (fabs(speed) + if pull > 0.0 { 0.5 * pull * left } else { 0.0 }) * (1.0 + ROUNDING);
        if reach < SMALLEST {
            return Ok(Progress {
                indentation: indentation + sign * reach,
                speed: speed + net * left,
                time: left,
                turned: false,
            });
        }
        let start = Start { indentation, speed, net, time: left };
        let limit = sign * smallest(bound, reach);
        let short = fabs(limit) <= SHORT * indentation;
        let segment = piece.whole().copied().or_else(|| short.then(|| piece.tangent(indentation)));
        let passage = match segment {
            Some(segment) => {
                let (field, place) = Field::on_segment(&segment, &forces, &start, limit, &self.evaluations);
                pass(field, &place, limit, left)?
            }
            None => {
                let (field, place, limit) = Field::fitted(piece, &forces, &start, limit, &self.evaluations)?;
                pass(field, &place, limit, left)?
            }
        };
        let Passage { way, speed, time, turned } = passage;
        let speed = if speed > 0.0 { sign * speed } else { 0.0 };
        let border = if rising { piece.upper } else { piece.lower };
        let place = indentation + way;
        let inside = if rising { smallest(place, border) } else { largest(place, border) };
        let indentation = if way == sign * bound { border } else { inside };
        Ok(Progress { indentation, speed, time, turned })
    }

    /// A motion that has lost nothing since the last turn goes on as it was: its whole periods are left out.
    fn repeat(&mut self) -> Result<(), NoMotion> {
        let last = self.turn.replace(Turn { largest: self.largest, ago: 0.0, forgot: false });
        let Some(Turn { largest, ago, forgot }) = last else { return Ok(()) };
        let same = fabs(self.largest - largest) <= ROUNDING * largest;
        let keeps = same && (!forgot || self.model.is_elastic_at(self.largest));
        if !keeps || self.left < ago {
            return Ok(());
        }
        if self.left > MOST_PERIODS * ago {
            return Err(NoMotion::TooLong);
        }
        let periods = floor(self.left / ago) * ago;
        self.taken += self.drive.acceleration * periods;
        self.left = if periods < self.left { self.left - periods } else { 0.0 };
        Ok(())
    }
}
