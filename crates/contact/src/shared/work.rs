//! The numbers of one contact during a step.

use super::branch::{Branch, Event, Kind, Watched};
use super::dop853::{Numbers, Slopes};
use super::gradients::Unknown;
use super::loss::Loss;
use super::scales::Scales;
use crate::history::History;
use crate::losses::Form;
use crate::numerics::{largest, quotient, root, smallest};
use libm::{fabs, sqrt};

/// Working memory of one contact for a step, and its results. The caller keeps one for each contact, or makes them anew: a
/// step needs nothing from the step before.
#[derive(Clone, Copy)]
pub struct Work<C> {
    /// The contact, moved by the step.
    pub(super) contact: C,
    /// The first contact of the block, which names it.
    pub(super) block: usize,
    /// Number of contacts behind this one up to the last one that it is coupled with.
    pub(super) reach: usize,
    /// Whether a force acts on its bodies: it is pressed, or coupled with one that is. Others fly along a parabola.
    pub(super) active: bool,
    pub(super) branch: Branch,
    /// `W_ii` \[1/kg\].
    pub(super) inverse_mass: f64,
    /// Whether the bodies close at a given rate; the inverse mass is then a scale only.
    pub(super) is_held: bool,
    /// Closing acceleration by all other forces \[m/s^2\].
    pub(super) acceleration: f64,
    pub(super) now: Instant,
    /// The instant that a step of the integration tries.
    pub(super) trial: Instant,
    pub(super) slopes: Slopes<4>,
    /// Of a contact with a loss.
    pub(super) loss: Option<Loss>,
    /// Power of the force of a contact with a loss \[W\].
    pub(super) power: Slopes<1>,
    /// Of a block that comes to rest.
    pub(super) solution: Unknown,
    /// The largest indentation of dents that were left behind \[m\].
    pub(super) deepest: f64,
    /// A contact with friction at the end of the chord that is tried.
    pub(super) moved: C,
    /// Whether it is apart all along this chord.
    pub(super) flies: bool,
    /// The directions of a contact with friction, of which it uses so many: first the normal, then the tangents.
    pub(super) rows: [Row; 3],
    pub(super) used: usize,
    /// Ratio of the tangential to the normal stiffness.
    pub(super) ratio: f64,
}

/// A direction of a contact with friction.
#[derive(Clone, Copy, Debug, Default)]
pub struct Row {
    /// Diagonal entry of the inverse masses \[1/kg\].
    pub(super) inverse_mass: f64,
    /// Acceleration by all other forces \[m/s^2\].
    pub(super) acceleration: f64,
    /// Rate at the start of the chord \[m/s\].
    pub(super) rate: f64,
    /// Impulse of the step so far \[N.s\].
    pub(super) impulse: f64,
    /// Integral of the impulse over time \[N.s^2\].
    pub(super) moment: f64,
    /// Force at the start of the chord \[N\].
    pub(crate) start: f64,
    /// The force at the start of the last chord and in its middle \[N\], and its time \[s\].
    pub(super) last: [f64; 3],
    /// The part of the bodies' way that the contact has not gone yet \[m\].
    pub(super) lag: f64,
    /// Mean force of the chord that the way follows from \[N\].
    pub(super) force: f64,
    /// Mean acceleration with these forces \[m/s^2\].
    pub(crate) net: f64,
    /// Way of the chord \[m\].
    pub(crate) way: f64,
    /// The way that the contact went.
    pub(super) gone: f64,
    /// Mean force on this way \[N\].
    pub(crate) found: f64,
    /// How the force that is found grows with the way, and with that of the normal \[N/m\].
    pub(crate) slope: f64,
    pub(crate) slope_beside: f64,
    /// Of a target that gives way: how its force falls with the one that it gives way to.
    pub(crate) gives: f64,
    /// Of the normal: the force with its loss as a part of the elastic one, and whether it is known.
    pub(crate) share: f64,
    pub(crate) knows_share: bool,
    /// Of a tangential direction: the largest mean force of all of them together that Coulomb's law allows \[N\].
    pub(crate) most: f64,
    /// Whether its correction would exceed that.
    pub(super) is_limited: bool,
    /// The stiffness at the start of the chord, and how the force grows with the indentation beside \[N/m\].
    pub(super) stiffness_before: [f64; 2],
    /// The same at the start of the last chord.
    pub(super) stiffness_last: [f64; 2],
    /// The same at its end.
    pub(super) stiffness_after: [f64; 2],
    /// The same as means over the chord, and those for the next turn.
    pub(super) stiffness: [f64; 2],
    pub(super) stiffness_next: [f64; 2],
    /// The part of the force on a curved way that grows with the indentation \[N\].
    pub(crate) beside: f64,
    /// The moment of the impulse by which the way is not straight \[N.s^2\].
    pub(super) bend: f64,
    /// The part of it by a force that grows with the indentation.
    pub(super) bend_beside: f64,
    /// Mean acceleration with the mean forces on the way \[m/s^2\].
    pub(super) curved: f64,
    /// Of a block that comes to rest.
    pub(super) solution: Unknown,
}

impl Row {
    /// Impulse of the step so far \[N.s\].
    pub fn impulse(&self) -> f64 {
        self.impulse
    }

    /// Mean force of the chord \[N\].
    pub fn force(&self) -> f64 {
        self.force
    }

    /// Sets what no force needs.
    pub(super) fn loosen(&mut self) {
        let (stiffness, found, most, beside) = ([0.0; 2], 0.0, 0.0, 0.0);
        let (slope, slope_beside, gives) = (0.0, 0.0, 0.0);
        *self = Row { stiffness, stiffness_next: stiffness, found, most, beside, slope, slope_beside, gives, ..*self };
    }

    /// The mean force of the next chord, of this `time` \[s\], if the force goes on along a parabola \[N\].
    pub(super) fn expected(&self, time: f64) -> f64 {
        let [start, middle, before] = self.last;
        if before == 0.0 {
            return self.start;
        }
        // with the mean of the last chord, and the forces at its start and end
        let (slope, bend) = (4.0 * self.start + 2.0 * start - 6.0 * middle, 3.0 * (self.start + start - 2.0 * middle));
        let part = time / before;
        self.start + part * (0.5 * slope + part * bend / 3.0)
    }

    /// The mean stiffnesses over the next chord, of this `time` \[s\], if they go on along straight lines \[N/m\].
    pub(super) fn expected_stiffness(&self, time: f64) -> [f64; 2] {
        let [.., before] = self.last;
        let mut expected = self.stiffness_before;
        for (expected, last) in expected.iter_mut().zip(self.stiffness_last) {
            let change = quotient(0.5 * time * (*expected - last), before, before > 0.0 && last != 0.0, 0.0);
            // not where it jumps, or begins
            *expected += if fabs(change) < 0.5 * fabs(*expected) { change } else { 0.0 };
        }
        expected
    }

    /// The largest stiffness \[N/m\] of a normal row for the bend of a chord of this `time` \[s\]: half of that at which its moment, and
    /// a quarter of that at which its force, would be zero. Only a contact that touches or parts within the chord has a larger one.
    pub(super) fn stiffest(&self, time: f64) -> f64 {
        let force = largest(self.found, 0.0);
        let least = |pull: f64| quotient(3.0 * force, pull, pull > 1e-100 * force, f64::INFINITY);
        smallest(least(self.way), least(time * time * self.curved))
    }

    /// Rate at present \[m/s\].
    pub fn rate(&self) -> f64 {
        self.rate
    }
}

/// A contact at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instant {
    /// Indentation \[m\], closing rate \[m/s\], impulse of the step so far \[N.s\] and the integral of the impulse over time
    /// \[N.s^2\].
    pub numbers: Numbers,
    /// Force \[N\].
    pub force: f64,
    /// The derivative of the closing rate \[m/s^2\].
    pub net: f64,
    /// Force without a loss \[N\].
    pub elastic: f64,
    /// Stiffness \[N/m\] of a contact whose loss needs it.
    pub stiffness: f64,
    /// Rate of indentation \[m/s\]: the closing rate, less that at which the target gives way.
    pub approach: f64,
    /// The rate at which a target gives way per rate of indentation \[1/s\].
    pub easing: f64,
    /// Work of the force of a contact with a loss \[J\]; at a given rate, the heat.
    pub work: f64,
}

impl Instant {
    pub const NOTHING: Instant = Instant {
        numbers: [0.0; 4],
        force: 0.0,
        net: 0.0,
        elastic: 0.0,
        stiffness: 0.0,
        approach: 0.0,
        easing: 0.0,
        work: 0.0,
    };

    /// A contact at this indentation \[m\], of bodies that close at `rate` \[m/s\].
    pub fn at(indentation: f64, rate: f64) -> Instant {
        Instant { numbers: [indentation, rate, 0.0, 0.0], approach: rate, ..Instant::NOTHING }
    }

    /// The derivative of the rate of indentation \[m/s^2\].
    #[inline(always)]
    pub fn bend(&self) -> f64 {
        self.net - self.easing * self.approach
    }

    #[inline(always)]
    pub fn indentation(&self) -> f64 {
        let [indentation, ..] = self.numbers;
        indentation
    }

    #[inline(always)]
    pub fn rate(&self) -> f64 {
        let [_, rate, ..] = self.numbers;
        rate
    }
}

impl<C: Copy> Work<C> {
    /// Working memory for `contact`; any contact will do.
    pub fn new(contact: C) -> Work<C> {
        Work {
            contact,
            moved: contact,
            flies: false,
            block: 0,
            reach: 0,
            active: false,
            branch: Branch::NOTHING,
            inverse_mass: 0.0,
            is_held: false,
            acceleration: 0.0,
            now: Instant::NOTHING,
            trial: Instant::NOTHING,
            slopes: Slopes::NONE,
            loss: None,
            power: Slopes::NONE,
            solution: Unknown::default(),
            deepest: 0.0,
            rows: [Row::default(); 3],
            used: 0,
            ratio: 1.0,
        }
    }
}

impl<C> Work<C> {
    /// The directions in use.
    pub(super) fn rows(&self) -> &[Row] {
        self.rows.get(..self.used).unwrap_or_default()
    }

    /// The same to change.
    pub(super) fn rows_mut(&mut self) -> &mut [Row] {
        self.rows.get_mut(..self.used).unwrap_or_default()
    }

    /// Sets the ways of a chord of this `time` \[s\].
    pub(super) fn set_ways(&mut self, time: f64) {
        self.rows_mut().iter_mut().for_each(|row| row.way = time * (row.rate + 0.5 * time * row.net));
    }

    /// Whether a contact with friction of this history is and stays apart on the way of the chord.
    pub(super) fn stays_apart(&self, history: &History, surface: f64) -> bool {
        let [Row { way, .. }, ..] = self.rows;
        history.force() == 0.0 && history.indentation() < surface && history.indentation() + way < surface
    }

    /// The largest tangential stiffness \[N/m\] for the bend of a chord of this `time` \[s\] that keeps Coulomb's bound: the positive
    /// solution `k` of `|found - k h^2/12 curved| = most`.
    pub(super) fn stiffest_tangent(&self, time: f64) -> f64 {
        let bent = time * time / 12.0;
        let (mut along, mut square, mut size) = (0.0, 0.0, 0.0);
        for row in self.rows().iter().skip(1) {
            let pull = bent * row.curved;
            (along, square, size) = (along + row.found * pull, square + pull * pull, size + row.found * row.found);
        }
        let most = self.rows().get(1).map_or(0.0, |row| row.most);
        let sum = along + root(along * along + square * largest(most * most - size, 0.0));
        quotient(sum, square, square > 0.0, f64::INFINITY)
    }

    /// Impulse of the contact force over the step \[N.s\].
    pub fn impulse(&self) -> f64 {
        let [_, _, impulse, _] = self.now.numbers;
        impulse
    }

    /// The moment of the impulse \[N.s^2\]: its integral over the step, by which the bodies are displaced.
    pub fn moment(&self) -> f64 {
        let [_, _, _, moment] = self.now.numbers;
        moment
    }

    /// Impulse of the tangential force in this direction over the step \[N.s\]; zero without friction.
    pub fn tangential_impulse(&self, direction: usize) -> f64 {
        self.rows.get(1 + direction).map_or(0.0, |row| row.impulse)
    }

    /// The moment of this impulse \[N.s^2\].
    pub fn tangential_moment(&self, direction: usize) -> f64 {
        self.rows.get(1 + direction).map_or(0.0, |row| row.moment)
    }

    /// Tangential rate at the end of the step \[m/s\].
    pub fn tangential_rate(&self, direction: usize) -> f64 {
        self.rows.get(1 + direction).map_or(0.0, |row| row.rate)
    }

    /// The largest indentation during the step or before \[m\], which a fresh surface forgets.
    pub fn deepest(&self) -> f64 {
        self.deepest
    }
}

/// Rounding of an acceleration, relative to the forces that make it up.
const BALANCE: f64 = 1e-13;

/// Last digits by which a sum of opposite forces may be off.
const DIGITS: f64 = 16.0;

/// Last digits of the indentation over which the work of a contact is not known to the part that counts.
const UNRESOLVED: f64 = 1e7;

/// A distance from a threshold, relative to the scale, at which the contact counts as there, and a rate at which it counts
/// as at rest: then its acceleration decides where it goes.
const NEAR: f64 = 1e-13;

impl<C> Work<C> {
    /// The largest rate that the energy allows \[m/s\].
    pub(super) fn speed(&self, scales: &Scales) -> f64 {
        scales.root_energy * sqrt(self.inverse_mass)
    }

    /// The distance from what is `watched` at which the contact counts as there, in its unit.
    pub(super) fn near(&self, watched: &Watched, scales: &Scales) -> f64 {
        let speed = NEAR * self.speed(scales);
        match watched {
            Watched::Indentation { threshold, .. } => speed * scales.time + 4.0 * f64::EPSILON * fabs(*threshold),
            Watched::Rate { .. } => speed + self.rounding_of_approach(),
            Watched::Bend { .. } => self.rounding_of_net(scales),
            Watched::Pull { .. } => self.loss.map_or(0.0, |loss| match loss.damping.form {
                Form::Mobility => speed + self.rounding_of_approach(),
                _ => speed * loss.damping.factor,
            }),
        }
    }

    /// Rounding of the rate of indentation of a target that gives way \[m/s\].
    fn rounding_of_approach(&self) -> f64 {
        let Some(loss) = &self.loss else { return 0.0 };
        let given = loss.easing(fabs(self.now.elastic));
        if given > 0.0 { BALANCE * (fabs(self.now.rate()) + given) } else { 0.0 }
    }

    /// The acceleration \[m/s^2\] whose last digits are rounding: in a deep dent, the last digit of the indentation is a larger part of
    /// the height above the surface.
    pub(super) fn rounded_acceleration(&self) -> f64 {
        let (indentation, force) = (self.now.indentation(), fabs(self.now.force));
        let height = if self.branch.kind == Kind::Path { indentation - self.branch.surface() } else { indentation };
        let digits = quotient(2.0 * fabs(indentation), height, height > 1e-100 * fabs(indentation), 1.0);
        fabs(self.acceleration) + self.inverse_mass * force * (1.0 + digits)
    }

    /// An acceleration that is rounding \[m/s^2\].
    fn rounding_of_net(&self, scales: &Scales) -> f64 {
        let swing = quotient(self.speed(scales), scales.time, scales.time > 0.0, 0.0);
        BALANCE * (fabs(self.acceleration) + self.inverse_mass * fabs(self.now.force) + swing)
            + DIGITS * f64::EPSILON * self.rounded_acceleration()
    }

    /// A work that counts as none, as a part of twice the energy. In a deep dent, the height above the surface has fewer digits.
    pub(super) fn unresolved_part(&self, scales: &Scales) -> f64 {
        let (digit, height) = (f64::EPSILON * fabs(self.now.indentation()), self.speed(scales) * scales.time);
        let part = UNRESOLVED * quotient(digit, height, digit < height, 1.0);
        1e-18 + part * part
    }

    /// Whether the rate of indentation is that of a contact at rest.
    pub(super) fn is_still(&self, scales: &Scales) -> bool {
        fabs(self.now.approach) <= NEAR * self.speed(scales) + self.rounding_of_approach()
    }

    /// 1 for a contact that goes deeper, -1 for one that comes back, 0 for one at rest.
    fn direction(&self, scales: &Scales) -> f64 {
        let (rate, bend) = (self.now.approach, self.now.bend());
        if !self.is_still(scales) {
            return rate.signum();
        }
        if fabs(bend) > self.rounding_of_net(scales) { bend.signum() } else { 0.0 }
    }

    /// The number that falls through zero at what is `watched`, at an `instant`.
    pub(super) fn value(&self, watched: &Watched, instant: &Instant) -> f64 {
        match *watched {
            Watched::Indentation { threshold, sign, .. } => sign * (threshold - instant.indentation()),
            Watched::Rate { threshold, sign, .. } => sign * (threshold - instant.approach),
            Watched::Bend { sign } => sign * instant.bend(),
            Watched::Pull { sign, .. } => {
                let pull = |loss: &Loss| {
                    loss.pull(instant.indentation(), instant.elastic, instant.stiffness, instant.approach)
                };
                sign * self.loss.as_ref().map_or(0.0, pull)
            }
        }
    }

    /// Whether an event is due without any motion: the contact is at a threshold, or beyond it, and moves across.
    pub(super) fn is_due(&self, watched: &Watched, scales: &Scales) -> bool {
        let (near, value) = (self.near(watched, scales), self.value(watched, &self.now));
        match *watched {
            Watched::Indentation { sign, .. } => value <= near && sign * self.direction(scales) > 0.0,
            Watched::Rate { event: Event::Turn, .. } => value <= near && self.direction(scales) < 0.0,
            Watched::Rate { sign, .. } => {
                value < -near || value <= near && sign * self.now.bend() > self.rounding_of_net(scales)
            }
            Watched::Bend { .. } | Watched::Pull { .. } => value < -near,
        }
    }

    /// Whether a rate that is at the largest one and falls seems to rise above it: after a touch it falls with a high power of the
    /// clock, between whose ends a cubic rises.
    pub(super) fn rises_in_the_curve_only(&self, watched: &Watched, near: f64) -> bool {
        let Watched::Rate { event: Event::Lead, sign, .. } = *watched else { return false };
        let [now, trial] = [&self.now, &self.trial].map(|instant| self.value(watched, instant));
        now <= near && sign * self.now.bend() <= 0.0 && trial > near
    }

    /// The time in which the contact leaves a segment of a chain, at its present acceleration \[s\].
    pub(super) fn time_on_segment(&self) -> f64 {
        let (rate, bend) = (self.now.approach, self.now.bend());
        let [down, up] = self.branch.ways(self.now.indentation());
        // the way is rate t + bend t^2/2
        let time = |way: f64, rate: f64, bend: f64| {
            if way == f64::INFINITY {
                return way;
            }
            let speed = root(rate * rate + 2.0 * bend * way);
            let (top, bottom) = if rate < 0.0 { (speed - rate, bend) } else { (2.0 * way, rate + speed) };
            quotient(top, bottom, speed > 0.0 && bottom > 1e-100 * top, f64::INFINITY)
        };
        smallest(time(up, rate, bend), time(down, -rate, -bend))
    }

    /// Tries the flight over `time` \[s\] of a contact that no force acts on.
    pub(super) fn fly(&mut self, time: f64) {
        let ([indentation, rate, impulse, moment], acceleration) = (self.now.numbers, self.acceleration);
        let way = time * (rate + 0.5 * acceleration * time);
        let approach = rate + acceleration * time;
        self.trial = Instant { approach, ..self.now };
        self.trial.numbers = [indentation + way, approach, impulse, moment + impulse * time];
    }

    /// Whether a surface that lags behind its bodies grips again before they are apart.
    pub(super) fn grips_again(&self) -> bool {
        self.loss.is_some_and(|loss| matches!(loss.damping.form, Form::Viscous(growth) if growth.grips_again()))
    }

    /// What the contact waits for.
    pub(super) fn watches(&self) -> impl Iterator<Item = Watched> + use<C> {
        let on_branch = self.branch.watched(self.now.indentation());
        let is_pressed = self.branch.kind != Kind::Apart;
        let of_loss = self
            .loss
            .as_ref()
            .filter(|_| is_pressed)
            .map_or([None; 3], |loss| loss.watched(self.now.indentation(), self.now.approach));
        on_branch.into_iter().chain(of_loss).flatten()
    }
}
