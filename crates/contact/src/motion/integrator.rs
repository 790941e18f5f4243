//! The motion of the bodies through a step, from event to event: touch, corner of the law, turning point, separation.

use super::field::Start;
use super::field::{Ended, Stretch};
use super::flight::Flight;
use super::{COSTLY, ExternalLoad, MOST_EVALUATIONS, MOST_PERIODS, NoMotion, Outcome};
use crate::history::History;
use crate::history::piece::Piece;
use crate::loading::Loading;
use crate::numerics::{largest, quotient, smallest};
use crate::regime::TooDeep;
use crate::unloading::Unloading;
use crate::{Model, Surface};
use core::cell::Cell;
use libm::{fabs, floor};

/// The bodies during a step. The history is updated only where necessary: when a dent is left behind, and at the end.
pub struct Integrator<'a, L, U> {
    history: &'a mut History,
    model: &'a Model<L, U>,
    load: &'a ExternalLoad,
    /// Inverse of the effective mass \[1/kg\].
    inverse_mass: f64,
    /// Present indentation \[m\].
    indentation: f64,
    /// Closing speed \[m/s\].
    speed: f64,
    /// The largest indentation of the dent \[m\].
    largest: f64,
    /// The piece between the largest indentation and the surface of the dent, once it has been computed.
    back: Option<Piece<'a, L, U>>,
    /// Whether the last motion went deeper.
    rising: bool,
    /// Whether the last event was a turning point.
    turned: bool,
    /// Closing speed removed by the contact force so far \[m/s\].
    speed_removed: f64,
    /// Time left \[s\].
    left: f64,
    /// The largest indentation so far of a dent that was left behind \[m\].
    deepest: f64,
    /// The last turning point in the contact.
    turn: Option<Turn>,
    /// The displacement of a step that is a single stretch within one piece \[m\].
    only: Option<f64>,
    events: u32,
    evaluations: Cell<u32>,
}

/// A turning point at the largest indentation of a contact.
#[derive(Clone, Copy)]
struct Turn {
    /// The largest indentation at that time \[m\].
    largest: f64,
    /// Time since then \[s\].
    ago: f64,
    /// Whether a dent was left behind since then.
    forgot: bool,
}

/// The growth of a dent that is attributed to rounding, as a fraction of the indentation.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Number of evaluations that finding a piece counts for, for laws with segments.
const PIECE: u32 = 10;

/// Largest number of events in a step. Flights need no evaluations, so [`MOST_EVALUATIONS`] does not limit them.
const MOST_EVENTS: u32 = MOST_EVALUATIONS / PIECE;

impl<'a, L: Loading, U: Unloading> Integrator<'a, L, U> {
    /// The bodies at the start of a step.
    ///
    /// # Errors
    /// [`TooDeep`] for numbers that are not finite.
    pub fn new(
        history: &'a mut History,
        model: &'a Model<L, U>,
        load: &'a ExternalLoad,
        speed: f64,
        step: f64,
    ) -> Result<Integrator<'a, L, U>, TooDeep> {
        let (indentation, largest) = (history.indentation(), history.max_indentation());
        if let Some(&number) = [speed, step, load.acceleration].iter().find(|number| !number.is_finite()) {
            return Err(TooDeep { indentation: number });
        }
        let path = if model.unloading.is_segmented() { history.path_of_dent() } else { None };
        let back = path.map(|path| Piece::on_path(model, path));
        Ok(Integrator {
            history,
            model,
            load,
            inverse_mass: 1.0 / load.mass,
            indentation,
            speed,
            largest,
            back,
            rising: speed > 0.0,
            turned: false,
            speed_removed: 0.0,
            left: step,
            deepest: 0.0,
            turn: None,
            only: None,
            events: 0,
            evaluations: Cell::new(0),
        })
    }

    /// Advances to the next event. Returns false at the end of the step.
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

    /// Closing speed \[m/s\] and time left \[s\] of bodies that have just reached a surface without a dent, at a speed that `is_new`
    /// accepts.
    #[inline(always)]
    pub fn before_touch(&self, is_new: impl FnOnce(f64) -> bool) -> Option<(f64, f64)> {
        let touches = self.indentation == 0.0 && self.speed > 0.0 && self.left > 0.0;
        (touches && is_new(self.speed) && self.model.is_elastic_at(self.largest)).then_some((self.speed, self.left))
    }

    /// The time left \[s\] of bodies that have just turned at their largest indentation.
    pub fn after_turn(&self) -> Option<f64> {
        (self.turned && self.rising).then_some(self.left)
    }

    /// Ends the step, and updates the history.
    ///
    /// # Errors
    /// [`TooDeep`].
    pub fn stop(mut self) -> Result<Outcome, NoMotion> {
        // a motion on one branch may be shorter than the last digit of the indentation
        let stays = self.only.is_some_and(|way| self.history.advance_on_branch(way));
        if !stays {
            self.settle()?;
        }
        let deepest = largest(self.deepest, self.history.max_indentation());
        // the contact only pushes: a negative value is rounding
        let speed_removed = largest(self.speed_removed, 0.0);
        Ok(Outcome { speed: self.speed, speed_removed, evaluations: self.evaluations.get(), deepest })
    }

    /// Updates the history to the present position of the bodies.
    fn settle(&mut self) -> Result<(), TooDeep> {
        if self.largest > self.history.max_indentation() {
            self.history.go_to(self.model, self.largest, true)?;
        }
        self.history.go_to(self.model, self.indentation, self.rising)
    }

    /// The piece between the largest indentation and the surface of the dent, for unloading and reloading.
    fn back(&mut self) -> &Piece<'a, L, U> {
        let (model, largest) = (self.model, self.largest);
        self.back.get_or_insert_with(|| Piece::at(model, largest, largest, false))
    }

    /// The piece on which the bodies continue.
    fn piece(&mut self, rising: bool) -> Piece<'a, L, U> {
        let Integrator { indentation, largest, model, .. } = *self;
        let on_loading = rising && indentation >= largest;
        let piece = if on_loading { Piece::at(model, indentation, largest, true) } else { self.back().clone() };
        piece.part(indentation, rising)
    }

    /// The indentation of the surface \[m\]: the bottom of the present dent.
    fn surface(&mut self) -> f64 {
        self.back().lower
    }

    /// Whether there is no contact: the bodies are apart, or at the surface and not closing.
    fn is_apart(&mut self) -> bool {
        let indentation = self.indentation;
        let closes = self.speed > 0.0 || (self.speed == 0.0 && self.load.acceleration > 0.0);
        // on the loading curve, the surface of the dent is far below
        if closes && indentation > 0.0 && indentation >= self.largest {
            return false;
        }
        let surface = self.surface();
        indentation < surface || (indentation == surface && !closes)
    }

    /// Flight: until the bodies touch the surface, until a fresh surface forgets its dent, or until the end of the step.
    fn fly(&mut self) -> Result<(), TooDeep> {
        let (surface, indentation) = (self.surface(), self.indentation);
        let flight = Flight { speed: self.speed, acceleration: self.load.acceleration };
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
        // rounding must not turn a flight into a contact
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
        (self.largest, self.back) = (self.history.max_indentation(), None);
        if let Some(turn) = &mut self.turn {
            turn.forgot = true;
        }
        Ok(())
    }

    /// Advances the time by `time` \[s\].
    fn pass(&mut self, time: f64) {
        self.left -= time;
        if let Some(turn) = &mut self.turn {
            turn.ago += time;
        }
    }

    /// Bodies at rest stay where they are: the forces are in balance.
    fn rest(&mut self) {
        self.speed_removed += self.load.acceleration * self.left;
        (self.speed, self.left) = (0.0, 0.0);
    }

    /// Total acceleration of the bodies at their present position on `piece` \[m/s^2\].
    fn net(&self, piece: &Piece<'a, L, U>) -> f64 {
        self.load.acceleration - piece.force(self.indentation) * self.inverse_mass
    }

    /// Whether the motion in contact goes deeper. At rest, it is the direction of the total force; `None` in equilibrium.
    fn direction(&mut self) -> Option<bool> {
        if self.speed != 0.0 {
            return Some(self.speed > 0.0);
        }
        for rising in [true, false] {
            // after a turn the bodies go back; the force may jump, or balance within rounding
            let piece = self.piece(rising);
            let pull = if rising { self.net(&piece) } else { -self.net(&piece) };
            if pull > 0.0 && !(self.turned && self.rising == rising) {
                return Some(rising);
            }
        }
        None
    }

    /// Motion in contact: until the bodies turn, until the end of the smooth piece, or until the end of the step.
    fn press(&mut self, rising: bool) -> Result<(), NoMotion> {
        let piece = self.piece(rising);
        let found = if piece.whole().is_some() { PIECE } else { COSTLY * PIECE };
        self.evaluations.set(self.evaluations.get().saturating_add(found));
        let Integrator { indentation, speed, inverse_mass, left: time, .. } = *self;
        let (acceleration, net) = (self.load.acceleration, self.net(&piece));
        let start = Start { indentation, speed, net, acceleration, inverse_mass, time };
        let stretch = Stretch::new(&piece, &start, rising, &self.evaluations)?;
        let turns = stretch.ended == Ended::Turned;
        // bodies that turn and immediately turn again have no room to move
        if self.turned && turns && stretch.time == 0.0 {
            self.rest();
            return Ok(());
        }
        self.speed_removed += acceleration * stretch.time - stretch.gain;
        self.pass(stretch.time);
        self.indentation = match (stretch.ended, rising) {
            (Ended::AtBorder, true) => piece.upper,
            (Ended::AtBorder, false) => piece.lower,
            // rounding of the distance must not lead off the piece
            (_, true) => smallest(indentation + stretch.way, piece.upper),
            (_, false) => largest(indentation + stretch.way, piece.lower),
        };
        (self.speed, self.rising, self.turned) = (stretch.speed, rising, turns);
        self.only = (self.events == 1 && stretch.ended == Ended::WithStep).then_some(stretch.way);
        if self.indentation > self.largest {
            (self.largest, self.back) = (self.indentation, None);
        }
        let parts = stretch.ended == Ended::AtBorder && !rising;
        if parts && self.model.surface == Surface::Fresh && self.indentation <= 0.0 {
            self.forget()?;
        }
        if rising && turns { self.repeat() } else { Ok(()) }
    }

    /// A motion that has lost nothing since the last turning point is periodic: whole periods are skipped.
    fn repeat(&mut self) -> Result<(), NoMotion> {
        let last = self.turn.replace(Turn { largest: self.largest, ago: 0.0, forgot: false });
        let Some(Turn { largest, ago, forgot }) = last else { return Ok(()) };
        let same = fabs(self.largest - largest) <= ROUNDING * largest;
        let keeps = same && (!forgot || self.model.is_elastic_at(self.largest));
        if !keeps || self.left < ago {
            return Ok(());
        }
        let known = self.left <= MOST_PERIODS * ago;
        if !known {
            return Err(NoMotion::TooLong);
        }
        let periods = floor(quotient(self.left, ago, known, 0.0)) * ago;
        self.speed_removed += self.load.acceleration * periods;
        self.left = if periods < self.left { self.left - periods } else { 0.0 };
        Ok(())
    }
}
