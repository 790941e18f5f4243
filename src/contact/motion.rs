//! The motion of a mass that the contact force slows down: a contact that knows the mass.
//!
//! An impact takes some ten microseconds, a step of a multibody tool a millisecond. Here `m x'' = m a - F(x)` is followed
//! through the law inside of the step, however many times the bodies meet in it.

use super::history::{History, TooDeep};
use super::loading::Loading;
use super::piece::Piece;
use super::unloading::Unloading;
use super::{Model, Surface};
use libm::{fabs, sqrt};

/// What drives the two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Effective mass \[kg\] > 0: `1/m = 1/m1 + 1/m2`.
    pub mass: f64,
    /// Closing acceleration by all other forces \[m/s^2\], held over the step.
    pub acceleration: f64,
}

/// Where a step has led.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Closing speed at the end \[m/s\].
    pub speed: f64,
    /// Speed that the contact force alone has taken \[m/s\]: its impulse over the mass. Zero without contact, and never less.
    pub taken: f64,
    /// Evaluations of the force that it took.
    pub evaluations: u32,
    /// The largest indentation on the way \[m\], which a fresh surface forgets.
    pub deepest: f64,
}

/// [`follow`], for the history and the model of a scene.
pub type Follow<H, M> = fn(&mut H, &M, &Drive, f64, f64) -> Result<Outcome, NoMotion>;

/// Why a step could not be followed to its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoMotion {
    /// The indentation left the range of the law.
    TooDeep(TooDeep),
    /// It takes more than [`MOST_EVALUATIONS`]: bodies that rebound without loss thousands of times.
    TooLong,
}

impl From<TooDeep> for NoMotion {
    fn from(fault: TooDeep) -> NoMotion {
        NoMotion::TooDeep(fault)
    }
}

/// Evaluations of the force after which a step is given up; an impact takes about a thousand.
pub const MOST_EVALUATIONS: u32 = 4_000_000;

/// Largest error of an inner step, relative to its change of speed and its way.
const TOLERANCE: f64 = 2e-14;

/// The rounding of a force or of an indentation, relative to it, in tolerances.
const CANCELLED: f64 = 0.1;

/// Columns of the extrapolation: its order is twice that.
const COLUMNS: usize = 8;

/// Ways that an indentation can't be divided into, as a part of it.
const INDIVISIBLE: f64 = 8.0 * f64::EPSILON;

/// Largest inner step times the frequency of the contact: less than half an oscillation, so that the speed changes its sign
/// once at most.
const LARGEST_PHASE: f64 = 1.2;

/// Way and speed after an inner step, with its error in tolerances.
#[derive(Clone, Copy)]
struct Trial {
    way: f64,
    speed: f64,
    error: f64,
    columns: usize,
}

/// One step of a given length over a smooth piece, by Stoermer's rule and extrapolation.
struct Stepper<'a, 'b, L, U> {
    piece: &'a Piece<'b, L, U>,
    drive: &'a Drive,
    start: f64,
    speed: f64,
    /// What rounding makes of a difference of forces that cancel, over the mass, in tolerances \[m/s^2\].
    noise: f64,
    evaluations: &'a mut u32,
}

impl<L: Loading, U: Unloading> Stepper<'_, '_, L, U> {
    fn acceleration(&mut self, way: f64) -> f64 {
        *self.evaluations += 1;
        self.drive.acceleration - self.piece.force(self.start + way) / self.drive.mass
    }

    /// The state after `time` \[s\].
    ///
    /// Reference: E. Hairer, S. P. Norsett, G. Wanner, *Solving Ordinary Differential Equations I*, section II.14.
    fn trial(&mut self, time: f64) -> Trial {
        let first = self.acceleration(0.0);
        let mut table = [(0.0, 0.0); COLUMNS];
        let mut trial = Trial { way: 0.0, speed: self.speed, error: f64::INFINITY, columns: COLUMNS };
        for column in 0..COLUMNS {
            let parts = (column + 1) as f64;
            let part = time / parts;
            let mut increment = part * (self.speed + 0.5 * part * first);
            let mut way = increment;
            for _ in 0..column {
                increment += part * part * self.acceleration(way);
                way += increment;
            }
            let mut entry = (way, increment / part + 0.5 * part * self.acceleration(way));
            // the row of the table, from its left end to the diagonal
            let mut before = (0.0, 0.0);
            for (index, slot) in table.iter_mut().take(column + 1).enumerate() {
                let old = *slot;
                if index > 0 {
                    let ratio = parts / (parts - index as f64);
                    let weight = 1.0 / (ratio * ratio - 1.0);
                    entry = (entry.0 + weight * (entry.0 - before.0), entry.1 + weight * (entry.1 - before.1));
                }
                *slot = entry;
                before = old;
            }
            let (change, speed_change) = (fabs(entry.0 - trial.way), fabs(entry.1 - trial.speed));
            let speed_scale = largest(largest(fabs(self.speed), fabs(entry.1)), fabs(first) * time);
            // a small motion under a large load: what rounding makes of the difference of two large forces is no error
            let speed_scale = largest(speed_scale, self.noise * time);
            let relative = largest(change / (speed_scale * time), speed_change / speed_scale);
            let error = if speed_scale > 0.0 { relative / TOLERANCE } else { 0.0 };
            trial = Trial { way: entry.0, speed: entry.1, error, columns: column + 1 };
            if column > 0 && error <= 1.0 {
                break;
            }
        }
        trial
    }

    /// The time in `(0, high]` \[s\] at which `of` a trial vanishes, which has another sign at `high` than at zero: Newton's
    /// method with the given `slope`, in a bracket.
    fn root(&mut self, high: f64, of: impl Fn(&Trial) -> f64, slope: impl Fn(&Trial, f64) -> f64) -> (f64, Trial) {
        let (mut low, mut high) = (0.0, high);
        let end = self.trial(high);
        let positive_at_end = of(&end) > 0.0;
        let (mut time, mut trial) = (high, end);
        for _ in 0..60 {
            let value = of(&trial);
            if (value > 0.0) == positive_at_end {
                high = time;
            } else {
                low = time;
            }
            let acceleration = self.acceleration(trial.way);
            let newton = time - value / slope(&trial, acceleration);
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if value == 0.0 || fabs(next - time) <= 1e-16 * high || high - low <= 4.0 * f64::EPSILON * high {
                break;
            }
            time = next;
            trial = self.trial(time);
        }
        (time, trial)
    }
}

fn largest(one: f64, other: f64) -> f64 {
    if one > other { one } else { other }
}

/// Moves the contact through `step` \[s\] with the closing speed `speed` \[m/s\] at its start.
///
/// # Errors
/// [`NoMotion`]; the history is then somewhere on the way.
pub fn follow<L: Loading, U: Unloading>(
    history: &mut History,
    model: &Model<L, U>,
    drive: &Drive,
    speed: f64,
    step: f64,
) -> Result<Outcome, NoMotion> {
    let mut motion =
        Motion { history, model, drive, speed, taken: 0.0, left: step, inner: step, evaluations: 0, deepest: 0.0 };
    while motion.left > 0.0 {
        if motion.is_apart() {
            motion.fly()?;
        } else {
            motion.press()?;
        }
        if motion.evaluations > MOST_EVALUATIONS {
            return Err(NoMotion::TooLong);
        }
    }
    // the contact only pushes: less than nothing is rounding
    let taken = largest(motion.taken, 0.0);
    Ok(Outcome { speed: motion.speed, taken, evaluations: motion.evaluations, deepest: motion.deepest })
}

/// The motion as far as it has come.
struct Motion<'a, L, U> {
    history: &'a mut History,
    model: &'a Model<L, U>,
    drive: &'a Drive,
    speed: f64,
    /// Speed that the contact force has taken so far \[m/s\].
    taken: f64,
    /// Time left \[s\].
    left: f64,
    /// Length of the next inner step \[s\].
    inner: f64,
    evaluations: u32,
    /// The largest indentation so far \[m\].
    deepest: f64,
}

impl<L: Loading, U: Unloading> Motion<'_, L, U> {
    /// Where the surface is met \[m\]: at the dent that the contact has.
    fn surface(&self) -> f64 {
        self.history.residual_indentation(self.model)
    }

    /// Whether nothing slows the bodies down now: they are apart, or at the surface and not closing.
    fn is_apart(&self) -> bool {
        let (indentation, surface) = (self.history.indentation(), self.surface());
        let closes = self.speed > 0.0 || (self.speed == 0.0 && self.drive.acceleration > 0.0);
        indentation < surface || (indentation == surface && !closes)
    }

    /// Flight: a parabola, to the surface, to where a fresh surface forgets its dent, or to the end of the step.
    fn fly(&mut self) -> Result<(), NoMotion> {
        let Drive { acceleration, .. } = *self.drive;
        let (indentation, surface) = (self.history.indentation(), self.surface());
        let closing = time_to_close(surface - indentation, self.speed, acceleration);
        let forgets = self.model.surface == Surface::Fresh && indentation > 0.0;
        let parting = if forgets { time_to_close(indentation, -self.speed, -acceleration) } else { None };
        let before = |time: Option<f64>, end: f64| time.filter(|&time| time < end);
        let end = before(closing, self.left).unwrap_or(self.left);
        if let Some(time) = before(parting, end) {
            return self.arrive(time, 0.0, false);
        }
        if let Some(time) = before(closing, self.left) {
            return self.arrive(time, surface, true);
        }
        let goal = indentation + self.left * (self.speed + 0.5 * acceleration * self.left);
        // rounding must not make a contact of a flight
        self.arrive(self.left, if goal < surface { goal } else { surface }, false)
    }

    /// The end of a flight of `time` \[s\] at `goal` \[m\].
    fn arrive(&mut self, time: f64, goal: f64, rising: bool) -> Result<(), NoMotion> {
        let speed = self.speed + self.drive.acceleration * time;
        // what rounding makes of a graze is no motion away from the surface
        self.speed = if rising && speed < 0.0 { 0.0 } else { speed };
        self.left -= time;
        self.go_to(goal, rising)
    }

    /// Puts the contact at `goal` \[m\].
    fn go_to(&mut self, goal: f64, rising: bool) -> Result<(), NoMotion> {
        self.history.go_to(self.model, goal, rising)?;
        self.deepest = largest(self.deepest, self.history.max_indentation());
        Ok(())
    }

    /// The direction of the motion under force; at rest that of the acceleration.
    fn is_rising(&mut self) -> bool {
        if self.speed != 0.0 {
            return self.speed > 0.0;
        }
        let up = Piece::of(self.history, self.model, true);
        self.drive.acceleration > up.force(self.history.indentation()) / self.drive.mass
    }

    /// One inner step under force, to the next event at most.
    fn press(&mut self) -> Result<(), NoMotion> {
        let start = self.history.indentation();
        let rising = self.is_rising();
        let piece = Piece::of(self.history, self.model, rising);
        let released = piece.upper - piece.lower <= INDIVISIBLE * start;
        if !rising && released {
            // a recovery of no more than rounding takes no time
            let energy = self.model.recovered_work(piece.upper, start);
            let speed = -sqrt(self.speed * self.speed + 2.0 * energy / self.drive.mass);
            self.taken += self.speed - speed;
            self.speed = speed;
            return self.go_to(piece.lower, false);
        }
        let mut inner = if self.inner < self.left { self.inner } else { self.left };
        let Drive { mass, acceleration } = *self.drive;
        // without another force nothing cancels
        let rounded = fabs(acceleration) + start * piece.stiffness(start) / mass;
        let noise = if acceleration == 0.0 { 0.0 } else { CANCELLED * rounded };
        let (speed, evaluations) = (self.speed, &mut self.evaluations);
        let mut stepper = Stepper { piece: &piece, drive: self.drive, start, speed, noise, evaluations };
        let mut trial = stepper.trial(inner);
        loop {
            let stiffness = largest(piece.stiffness(start), piece.stiffness(start + trial.way));
            let phase = inner * sqrt(stiffness / mass);
            // written so that a NaN is refused
            if trial.error <= 1.0 && phase <= LARGEST_PHASE {
                break;
            }
            inner *= if phase > 4.0 * LARGEST_PHASE || phase.is_nan() { 0.1 } else { 0.4 };
            if *stepper.evaluations > MOST_EVALUATIONS {
                return Err(NoMotion::TooLong);
            }
            trial = stepper.trial(inner);
        }
        let grows = trial.columns < COLUMNS - 2;
        let (mut time, mut goal) = (inner, start + trial.way);
        // where the speed changes its sign is the turning point, and on the loading curve the end of the piece
        let turns = if rising { trial.speed < 0.0 } else { trial.speed > 0.0 };
        if turns && self.speed != 0.0 {
            (time, trial) = stepper.root(time, |trial| trial.speed, |_, acceleration| acceleration);
            trial.speed = 0.0;
            goal = start + trial.way;
        }
        let leaves = if rising { goal >= piece.upper } else { goal <= piece.lower };
        if leaves {
            let end = if rising { piece.upper } else { piece.lower };
            let way = end - start;
            if goal != end {
                (time, trial) = stepper.root(time, |trial| trial.way - way, |trial, _| trial.speed);
            }
            goal = end;
        }
        self.go_to(goal, rising)?;
        self.taken += self.drive.acceleration * time - (trial.speed - self.speed);
        self.speed = trial.speed;
        self.left -= time;
        self.inner = if grows && !turns && !leaves { 2.0 * inner } else { inner };
        Ok(())
    }
}

/// When a body at distance `gap` \[m\] >= 0 with closing `speed` and `acceleration` arrives \[s\]; `None` if never.
fn time_to_close(gap: f64, speed: f64, acceleration: f64) -> Option<f64> {
    // gap = speed t + acceleration t^2/2, in the form that doesn't cancel
    let discriminant = speed * speed + 2.0 * acceleration * gap;
    if discriminant < 0.0 {
        return None;
    }
    let root = sqrt(discriminant);
    let time = if speed > 0.0 { 2.0 * gap / (speed + root) } else { (root - speed) / acceleration };
    (0.0..f64::INFINITY).contains(&time).then_some(time)
}
