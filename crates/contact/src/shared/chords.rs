//! The motion of contacts with friction, in straight parts.
//!
//! The springs of friction follow a straight way exactly, and a slightly bent one nearly so. A block of contacts with friction
//! therefore moves along chords. Over a chord of the time `h` every force counts with its mean `F` along the way,
//!
//! ```text
//! rate(h) = rate + h (a - W F),    way = h rate + h^2/2 (a - W F),    F = mean force on this way
//! ```
//!
//! so that the bodies do exactly the work that the contacts take up. The way of the bodies is curved by their acceleration. To
//! the next order this changes the mean force by `-h^2/12 K (a - W F)`, and by that the way by `h^3/12 W K rate`, with the
//! stiffness `K` of each row. With the same `K` in both, the balance of work stays exact, whatever `K` is. A tangential force also
//! grows with the indentation beside, and changes the way in the same manner; what both do together on the bent way is added to the work of
//! friction.
//!
//! The mean forces are found by Newton's method, with the response of all rows to each other: a loss may stop a light body between two
//! contacts in a thousandth of a chord. It ends before it is exact: the bodies take the forces that were found on the ways of the contacts,
//! and what the contacts then have not gone of the ways of the bodies is left for the next chord. Of the work, which is a sum of forces times
//! ways, this leaves the change of a force from chord to chord times a small part of a way. The last chord of a step is exact.
//!
//! A turn of this iteration looks at the contacts that touch alone. Those that fly along the chord are looked at in the first turn and again
//! at its end; one that touches then joins.
//!
//! The springs keep what they passed on the bent way: two straight lines in place of a parabola (`tangential`).
//!
//! # Length
//! The error of a chord is estimated by that part of the correction that is not sure: the change of the stiffness over the chord. Only where
//! springs cease to slip does a stiffness jump. A chord ends there.
//!
//! # Accuracy
//! Of fourth order in the length of a chord, but where springs begin to slip or to stick, where dents grow and in two directions.
//! The rates after an impact of contacts that don't yield and have no loss, in one direction, are off by 1e-7 of the largest rate that
//! the energy allows, in the median; with a loss by 8e-6. Work and momentum are exact to rounding, whatever the chords; Coulomb's bound to the accuracy of the
//! iteration.
//!
//! Reference: the mean force on a straight way is the average vector field, and its correction that of fourth order, of
//! G. R. W. Quispel, D. I. McLaren, *J. Phys. A* 41 (2008) 045206.

use super::gradients::{self, SOLVED, System, Unknown};
use super::inverse_masses::InverseMasses;
use super::rest::STILL;
use super::scales::{GROWN, Scales, energy_of_load, stiffness_at};
use super::work::{Instant, Row, Work};
use super::{Refused, SharedContact};
use crate::loading::Loading;
use crate::loading::hertz::EXPONENT as HERTZ;
use crate::losses::{Damping, Form};
use crate::motion::MOST_EVALUATIONS;
use crate::numerics::{largest, quotient, root, smallest};
use core::borrow::Borrow;
use core::marker::PhantomData;
use libm::{cbrt, fabs, sqrt};

/// Number of evaluations that a contact on a chord counts for, by what it costs: with one tangential direction and with two.
const CHORDS: [u32; 2] = [4, 40];

/// The [error](Chords::error) of one chord that is accepted, relative to the largest rate that the energy allows. It is smallest for
/// contacts that never yield, in one tangential direction: their springs are exact.
const ELASTIC: f64 = 5e-8;

/// The same for contacts that may yield.
const YIELDING: f64 = 3e-7;

/// The same with two tangential directions.
const IN_PLANE: f64 = 5e-6;

/// The first chord after a flight, in units of the time scale.
const FIRST: f64 = 0.05;

/// The longest chord while a contact is pressed, in the same units.
const LONGEST: f64 = 0.4;

/// A slip that ends nearer to an end of a chord, as a part of it, does not cut the chord.
const NEAR_END: f64 = 0.01;

/// How often a chord is cut where a slip ends.
const ENDS: u32 = 3;

/// Largest growth of a chord.
const GROWTH: f64 = 2.0;

/// Largest number of iterations for the mean forces.
const ITERATIONS: u32 = 16;

/// Iterations after which the limits of springs no longer change.
const TURNS: u32 = 2;

/// The response of a force to itself that is none.
const LOOSE: f64 = 1e-12;

/// The part of its right side to which the system of an iteration is solved.
const NEWTON: f64 = 1e-4;

/// A change of a rate in an iteration that is rounding, relative to the largest rate.
const CLOSE: f64 = 1e-13;

/// The same for a chord after which others follow.
const NEARLY: f64 = 1e-9;

/// Contacts of a block.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Among {
    All,
    /// Those that don't fly along the chord.
    Touching,
}

impl Among {
    #[inline(always)]
    fn has<C>(self, member: &Work<C>, block: usize) -> bool {
        member.block == block && !(self == Among::Touching && member.flies)
    }
}

/// A block of contacts with friction that are coupled, in a row of contacts that may have others in between.
pub(super) struct Chords<'a, C, M, B, F> {
    work: &'a mut [Work<C>],
    masses: &'a InverseMasses<'a>,
    model: &'a F,
    /// The number of the first contact, which also names the block.
    block: usize,
    /// Time left \[s\].
    left: f64,
    /// Evaluations so far.
    pub evaluations: u32,
    scales: Scales,
    /// The contacts of the system that is solved.
    sought: Among,
    /// The energy \[J\] and the sum of the largest indentations \[m\] for which the time of the scales was found.
    energy: f64,
    depths: f64,
    /// The error of a chord that is accepted.
    tolerance: f64,
    marker: PhantomData<(M, B)>,
}

impl<'a, M, C: SharedContact<M>, B: Borrow<M>, F: Fn(usize) -> B> Chords<'a, C, M, B, F> {
    /// The block of the contact `block`, for `step` \[s\]. `work` is that of all contacts.
    pub fn new(
        work: &'a mut [Work<C>],
        masses: &'a InverseMasses<'a>,
        model: &'a F,
        block: usize,
        step: f64,
    ) -> Chords<'a, C, M, B, F> {
        let scales = Scales::default();
        Chords {
            work,
            masses,
            model,
            block,
            left: step,
            evaluations: 0,
            scales,
            sought: Among::All,
            energy: 0.0,
            depths: f64::NAN,
            tolerance: ELASTIC,
            marker: PhantomData,
        }
    }

    fn members(&self) -> impl Iterator<Item = (usize, &Work<C>)> {
        let block = self.block;
        self.work.iter().enumerate().filter(move |(_, member)| member.block == block)
    }

    fn members_mut(&mut self) -> impl Iterator<Item = (usize, &mut Work<C>)> {
        let block = self.block;
        self.work.iter_mut().enumerate().filter(move |(_, member)| member.block == block)
    }

    /// Moves the block through its time.
    ///
    /// # Errors
    /// [`Refused`].
    pub fn run(&mut self) -> Result<(), Refused> {
        let (model, mut tolerance) = (self.model, if C::DIRECTIONS > 1 { IN_PLANE } else { ELASTIC });
        for (place, member) in self.members_mut() {
            member.deepest = member.contact.plastic().max_indentation();
            let model = model(place);
            member.ratio = C::stiffness_ratio(model.borrow());
            if member.contact.plastic_model(model.borrow()).borrow().loading.can_yield() {
                tolerance = largest(tolerance, YIELDING);
            }
            // a contact that is pressed at the start and has never moved needs a scale for its damping
            let plastic = *member.contact.plastic();
            let is_fitted = |damping: Damping| damping.form == Form::Proportional && damping.swiftest == 0.0;
            if plastic.force() > 0.0 && member.contact.damping().is_some_and(is_fitted) {
                let height = plastic.indentation() - member.contact.path().lower;
                let swiftest = root(member.inverse_mass * plastic.stiffness()) * height;
                member.contact.lose(model.borrow(), swiftest, 0.0).map_err(|deep| Refused::TooDeep(place, deep))?;
            }
        }
        self.tolerance = tolerance;
        let mut next = self.left;
        let mut flying = true;
        while self.left > 0.0 {
            self.count(1)?;
            self.rescale();
            if self.rests() {
                self.rest();
                break;
            }
            let before = core::mem::replace(
                &mut flying,
                self.members().all(|(_, member)| flies::<C, M>(&member.contact, &member.rows)),
            );
            if flying {
                self.fly()?;
                continue;
            }
            if before {
                next = FIRST * self.scales.time;
            }
            let mut time = smallest(smallest(next, LONGEST * self.scales.time), self.left);
            let (mut planned, mut tries) = (0.0, 0);
            let factor = loop {
                let (error, end) = self.attempt(time)?;
                tries += 1;
                // the error is of third order where it is large, else of fourth
                let order = if error > 1.0 { cbrt(error) } else { sqrt(sqrt(error)) };
                let factor = 0.9 * quotient(1.0, order, error > 1e-6, 100.0);
                // written positively to reject NaN
                if error <= 1.0 {
                    break factor;
                }
                // as far as the end of a slip, and from there on as before
                let ends = end > NEAR_END && end < 1.0 - NEAR_END && tries <= ENDS;
                if ends {
                    planned = largest(time, planned);
                }
                time *= if ends {
                    end
                } else if factor > 0.2 {
                    smallest(factor, 0.9)
                } else {
                    0.2
                };
                if time < f64::MIN_POSITIVE {
                    return Err(Refused::TooLong { left: self.left });
                }
            };
            let is_last = time >= self.left;
            self.accept(time)?;
            self.left = if is_last { 0.0 } else { self.left - time };
            let longer = largest(time * smallest(factor, GROWTH), planned);
            next = if is_last { largest(longer, next) } else { longer };
        }
        for (_, member) in self.members_mut() {
            let Work { rows: [normal, ..], contact, .. } = *member;
            let indentation = contact.plastic().indentation();
            member.now = Instant { force: contact.plastic().force(), ..Instant::at(indentation, normal.rate) };
            member.now.numbers = [indentation, normal.rate, normal.impulse, normal.moment];
        }
        Ok(())
    }

    /// Adds to the evaluations.
    fn count(&mut self, evaluations: u32) -> Result<(), Refused> {
        self.evaluations = self.evaluations.saturating_add(evaluations);
        if self.evaluations > MOST_EVALUATIONS { Err(Refused::TooLong { left: self.left }) } else { Ok(()) }
    }

    /// The scales of the motion, from the largest energy so far. The time is found again where a dent or the energy has grown.
    fn rescale(&mut self) {
        let (mut moving, mut stored, mut depths) = (0.0, 0.0, 0.0);
        for (_, member) in self.members() {
            for row in member.rows() {
                moving = largest(0.5 * row.rate * row.rate / row.inverse_mass, moving);
            }
            let plastic = member.contact.plastic();
            let (force, indentation) = (plastic.force(), plastic.indentation());
            // of Hertz's contact, and not more than that of a spring over the whole indentation
            let stiffness = member.contact.path().stiffness(indentation);
            let spring = quotient(0.6 * force * force, stiffness, stiffness > 1e-100 * force, 0.0);
            stored += smallest(spring, 0.5 * force * fabs(indentation));
            depths += plastic.max_indentation();
        }
        let mut energy = largest(moving + stored, 0.5 * self.scales.root_energy * self.scales.root_energy);
        if depths != self.depths || energy > GROWN * self.energy {
            let mut fastest = 0.0;
            for (_, member) in self.members() {
                let load = fabs(member.acceleration) / member.inverse_mass;
                energy = largest(energy_of_load((&member.contact.path(), HERTZ), load), energy);
            }
            for (_, member) in self.members() {
                let stiffness = stiffness_at((&member.contact.path(), HERTZ), energy);
                for (row, ratio) in member.rows().iter().zip(ratios(member)) {
                    fastest = largest(ratio * row.inverse_mass * stiffness, fastest);
                }
            }
            (self.energy, self.depths) = (energy, depths);
            // rates may be so small that their squares vanish
            self.scales.time = quotient(1.0, sqrt(fastest), fastest > 1e-300, f64::INFINITY);
        }
        self.scales.root_energy = sqrt(2.0 * energy);
    }

    /// Finds the accelerations for the forces of all rows that are `among` these.
    fn accelerate(&mut self, among: Among) {
        for member in self.among_mut(among) {
            member.rows_mut().iter_mut().for_each(|row| row.net = row.acceleration);
        }
        self.respond(among, |row| row.force, |row| &mut row.net);
    }

    /// The contacts of the block that are `among` these.
    fn among_mut(&mut self, among: Among) -> impl Iterator<Item = &mut Work<C>> {
        let block = self.block;
        self.work.iter_mut().filter(move |member| among.has(member, block))
    }

    /// Subtracts the response of the bodies to the numbers `of` all rows `among` these, such as their forces, from others.
    fn respond(&mut self, among: Among, of: impl Fn(&Row) -> f64, from: impl Fn(&mut Row) -> &mut f64) {
        let (block, count) = (self.block, self.work.len());
        let mut all = self.masses.rows(0);
        // all normals, then all tangents in the first direction, and so on
        for axis in 0..=C::DIRECTIONS {
            for place in 0..count {
                let Some((own, entries)) = all.next().and_then(<[f64]>::split_first) else { return };
                let Some(row) = self
                    .work
                    .get(place)
                    .filter(|member| among.has(member, block))
                    .and_then(|member| member.rows.get(axis))
                else {
                    continue;
                };
                let force = of(row);
                let couple = |others: &mut [Work<C>], axis: usize, entries: &[f64]| {
                    let mut sum = 0.0;
                    for (other, &entry) in others.iter_mut().zip(entries) {
                        if entry == 0.0 || !among.has(other, block) {
                            continue;
                        }
                        let Some(row) = other.rows.get_mut(axis) else { continue };
                        sum += entry * of(row);
                        *from(row) -= entry * force;
                    }
                    sum
                };
                let after = self.work.get_mut(place + 1..).unwrap_or_default();
                let mut sum = own * force + couple(after, axis, entries);
                let mut entries = entries.get(count - place - 1..).unwrap_or_default();
                for axis in axis + 1..=C::DIRECTIONS {
                    sum += couple(self.work, axis, entries);
                    entries = entries.get(count..).unwrap_or_default();
                }
                if let Some(row) = self.work.get_mut(place).and_then(|member| member.rows.get_mut(axis)) {
                    *from(row) -= sum;
                }
            }
        }
    }

    /// Tries a chord of this `time` \[s\]: finds its mean forces. Returns its [error](Chords::error), infinite if they were not found.
    fn attempt(&mut self, time: f64) -> Result<(f64, f64), Refused> {
        let Chords { model, scales, .. } = *self;
        let [one, two] = CHORDS;
        for (place, member) in self.members_mut() {
            let model = model(place);
            member.contact.set_forces(model.borrow(), &mut member.rows);
            let [Row { net, .. }, ..] = member.rows;
            for (row, stiffness) in member.rows.iter_mut().zip(member.contact.stiffnesses(model.borrow())) {
                row.force = row.expected(time);
                row.stiffness_before = stiffness;
                row.stiffness = row.expected_stiffness(time);
                let [_, beside] = row.stiffness;
                row.beside = time * time / 12.0 * beside * net;
                (row.stiffness_after, row.is_limited) = ([0.0; 2], false);
            }
        }
        let (bent, mut spent) = (time * time / 12.0, 0);
        for turn in 0..ITERATIONS {
            let among = if turn > 0 { Among::Touching } else { Among::All };
            self.set_ways(time, among);
            for (place, member) in self.members_mut().filter(|(_, member)| among == Among::All || !member.flies) {
                member.flies = member.stays_apart(member.contact.plastic(), member.contact.path().lower);
                if member.flies {
                    member.rows_mut().iter_mut().for_each(Row::loosen);
                    continue;
                }
                member.moved = member.contact;
                let refused = |deep| Refused::TooDeep(place, deep);
                // springs that changed their limits in every turn would not come to an end
                member.rows[0].knows_share = turn >= TURNS;
                member.moved.go_straight(model(place).borrow(), &mut member.rows, time).map_err(refused)?;
                spent += if C::DIRECTIONS > 1 { two } else { one };
            }
            self.respond(Among::Touching, |row| row.found, |row| &mut row.curved);
            let mut change = 0.0;
            for (place, member) in self.members_mut().filter(|(_, member)| !member.flies) {
                let ([normal, ..], tangent) = (member.rows, member.stiffest_tangent(time));
                let after = member.moved.stiffnesses(model(place).borrow());
                for (index, (row, after)) in member.rows_mut().iter_mut().zip(after).enumerate() {
                    let most = if index == 0 { row.stiffest(time) } else { tangent };
                    let ([own, beside], [start, start_beside]) = (row.stiffness, row.stiffness_before);
                    let [end, end_beside] = after;
                    row.stiffness_after = after;
                    let with = |stiffness: f64| row.found - bent * stiffness * row.curved;
                    // a contact that parts presses by rounding at most
                    let force = if index == 0 { largest(with(own), 0.0) } else { with(own) };
                    let is_limited = row.is_limited || index > 0 && fabs(force) > row.most;
                    // a contact that slides at last, or would exceed its limit, is taken as sliding
                    let mean = if end > 0.0 && !is_limited { 0.5 * (start + end) } else { 0.0 };
                    let next = smallest(mean, most);
                    let off = largest(fabs(force - row.force), fabs(with(next) - with(own)));
                    let off = time * sqrt(row.inverse_mass) * off;
                    change = if off > change || off.is_nan() { off } else { change };
                    // for the next turn
                    (row.found, row.is_limited) = (force, is_limited);
                    row.stiffness_next = [next, 0.5 * (start_beside + end_beside)];
                    row.beside = bent * beside * normal.curved;
                }
            }
            // the first turn does not know the stiffnesses of the end
            let close = if time >= self.left { CLOSE } else { NEARLY };
            if change <= close * scales.root_energy && turn > 0 {
                self.take_found(time);
                if self.all_stay_apart() {
                    self.count(spent)?;
                    return Ok(self.error(time));
                }
                continue;
            }
            for (_, member) in self.members_mut() {
                member.rows_mut().iter_mut().for_each(|row| row.stiffness = row.stiffness_next);
            }
            self.improve(time);
        }
        self.count(spent)?;
        // a chord this long is not found by iteration
        Ok((f64::INFINITY, 1.0))
    }

    /// Sets the ways of a chord of this `time` \[s\] by the forces of all rows, with what their bends change.
    fn set_ways(&mut self, time: f64, among: Among) {
        let bent = time * time / 12.0;
        // in a plane, the way between the ends of the chord has another direction of slip: with this term the median error is twice as large
        let bends_beside = C::DIRECTIONS == 1;
        self.accelerate(among);
        for member in self.among_mut(among) {
            member.set_ways(time);
            let [Row { way: normal, .. }, ..] = member.rows;
            for row in member.rows_mut() {
                let [own, beside] = row.stiffness;
                row.bend_beside = if bends_beside { bent * beside * normal } else { 0.0 };
                (row.bend, row.curved) = (bent * own * row.way + row.bend_beside, row.acceleration);
                row.way += row.lag;
            }
        }
        self.respond(among, |row| -row.bend, |row| &mut row.way);
    }

    /// Moves the bodies by the forces that were found on the ways of the contacts. What the contacts have not gone of the ways of the
    /// bodies then is left for the next chord, so that the sum of the works is right.
    fn take_found(&mut self, time: f64) {
        for (_, member) in self.members_mut() {
            let [Row { force: expected, found: normal, .. }, ..] = member.rows;
            let size = root(member.rows().iter().skip(1).map(|row| row.found * row.found).sum());
            let mut beside = 0.0;
            for (axis, row) in member.rows_mut().iter_mut().enumerate() {
                // the bound of friction is that of the normal force that was found
                let most = row.most * quotient(normal, expected, expected > 0.0, 0.0);
                let part = if axis > 0 && size > most { quotient(most, size, size > 0.0, 1.0) } else { 1.0 };
                (row.force, row.gone) = (part * row.found, row.way);
                beside += row.bend_beside * row.curved - (1.0 - part) * row.found * row.way;
            }
            // a contact that flies moves at last
            member.moved.take_up(beside);
        }
        self.set_ways(time, Among::All);
    }

    /// Whether the contacts that fly along the chord do so on the ways that were found; those that touch do not fly then.
    fn all_stay_apart(&mut self) -> bool {
        let mut all = true;
        for (_, member) in self.members_mut().filter(|(_, member)| member.flies) {
            member.flies = member.stays_apart(member.contact.plastic(), member.contact.path().lower);
            all = all && member.flies;
        }
        all
    }

    /// Takes the forces that were found for the next turn, less their response to themselves: a step of Newton's method.
    ///
    /// The forces are off by `x`, which moves the ways by `-h^2/2 W x`; by that the next ones differ by `-D h^2/2 W x`, with the `slope` `D` of
    /// each row. What is to be added to the forces of this turn is therefore `res - z` with the difference `res` of those found and
    /// taken, and `(2/h^2 D^-1 + W) z = W res`.
    fn improve(&mut self, time: f64) {
        let half = 0.5 * time * time;
        for member in self.among_mut(Among::Touching) {
            for row in member.rows_mut() {
                (row.net, row.found) = (0.0, quotient(row.found - row.force, 1.0 + row.gives, row.gives >= 0.0, 0.0));
            }
        }
        self.respond(Among::Touching, |row| -row.found, |row| &mut row.net);
        for member in self.among_mut(Among::Touching) {
            for row in member.rows_mut() {
                let stiff = half * row.slope;
                let is_sought = stiff * row.inverse_mass > LOOSE;
                let own = quotient(1.0 + row.gives, stiff, is_sought, 0.0);
                row.solution = Unknown { own, ..Unknown::new(own + row.inverse_mass, row.net, is_sought) };
            }
        }
        self.sought = Among::Touching;
        gradients::solve(self, NEWTON);
        for member in self.among_mut(Among::Touching) {
            let [Row { net, solution, .. }, ..] = member.rows;
            let normal = half * (net - solution.product);
            for row in member.rows_mut() {
                row.force += row.found - row.solution.number - row.slope_beside * normal;
            }
        }
    }

    /// The error of a chord over that which is accepted, and the part of it at which a slip ends that makes it too large.
    ///
    /// What the bend of the chord changes is corrected; what is left is that change times the part by which a stiffness is not known: by
    /// which it changes over the chord. It counts whole where springs do not move in closed form, and where a contact is deeper than
    /// ever: without the latter, a tenth of the motions that yield have ten times the error.
    fn error(&self, time: f64) -> (f64, f64) {
        let accepted = self.tolerance * self.scales.root_energy;
        let (mut error, mut end) = (0.0, 1.0);
        for (place, member) in self.members().filter(|(_, member)| !member.flies) {
            let [normal, ..] = &member.rows;
            let [before, after] = [&member.contact, &member.moved];
            let is_deeper = after.plastic().max_indentation() > before.plastic().max_indentation();
            let model = (self.model)(place);
            let [scale, scale_after] = [before, after].map(|contact| contact.slip_scale(model.borrow()));
            let scale = scale.filter(|_| !is_deeper && scale_after.is_some());
            // forces with a loss are means of products
            let lossy = smallest(fabs(normal.share - 1.0), 1.0);
            let stiffest = largest(before.plastic().stiffness(), after.plastic().stiffness());
            for (axis, (row, ratio)) in member.rows().iter().zip(ratios(member)).enumerate() {
                let ([start, start_beside], [stop, stop_beside]) = (row.stiffness_before, row.stiffness_after);
                let missed = sqrt(row.inverse_mass) * time * time * time / 12.0;
                let whole = ratio * stiffest * fabs(row.net);
                let Some(scale) = scale else {
                    error = largest(missed * whole, error);
                    continue;
                };
                let changes = fabs(stop - start) * fabs(row.net) + fabs(stop_beside - start_beside) * fabs(normal.net);
                let mut force = changes + lossy * whole;
                let turn = smallest(turn_of(normal, row, scale, time), turn_of(normal, row, -scale, time));
                if axis > 0 && turn < 1.0 {
                    // springs that slipped stick from here on
                    let slips = largest(fabs(start_beside), fabs(stop_beside));
                    force += 4.0 * turn * (1.0 - turn) * slips * (scale * fabs(row.net) + fabs(normal.net));
                    if missed * force > accepted {
                        end = smallest(turn, end);
                    }
                }
                error = largest(missed * force, error);
            }
        }
        (quotient(error, accepted, accepted > 0.0, 0.0), end)
    }

    /// Moves the block along the chord that was tried last.
    fn accept(&mut self, time: f64) -> Result<(), Refused> {
        let model = self.model;
        for (place, member) in self.members_mut() {
            if member.flies {
                let refused = |deep| Refused::TooDeep(place, deep);
                member.contact.go_straight(model(place).borrow(), &mut member.rows, time).map_err(refused)?;
            } else {
                member.contact = member.moved;
            }
            let flies = member.flies;
            member.deepest = largest(member.deepest, member.contact.plastic().max_indentation());
            for row in member.rows_mut() {
                row.moment += time * (row.impulse + 0.5 * time * row.force) - row.bend;
                row.impulse += time * row.force;
                row.rate += time * row.net;
                row.lag = if flies { 0.0 } else { row.way - row.gone };
                (row.last, row.stiffness_last) = ([row.start, row.force, time], row.stiffness_before);
            }
        }
        Ok(())
    }

    /// Whether the block is at rest until the end of the step, as that of contacts without friction: every row is slow, and the
    /// forces without rates are in balance. They are then those of the rows.
    fn rests(&mut self) -> bool {
        let model = self.model;
        let (mut stored, mut stiffest) = (0.0, 0.0);
        for (_, member) in self.members() {
            let (force, stiffness) = (member.contact.plastic().force(), member.contact.plastic().stiffness());
            stored = largest(quotient(force * force, stiffness, stiffness > 1e-100 * force, 0.0), stored);
            stiffest = largest(stiffness, stiffest);
        }
        let slow = STILL * sqrt(stored);
        // written positively to reject NaN
        let is_slow =
            |member: &Work<C>| member.rows().iter().all(|row| fabs(row.rate) <= slow * sqrt(row.inverse_mass));
        if !(stored > 0.0 && self.members().all(|(_, member)| is_slow(member))) {
            return false;
        }
        for (place, member) in self.members_mut() {
            member.contact.set_forces(model(place).borrow(), &mut member.rows);
            let force = member.contact.plastic().force();
            member.rows_mut().iter_mut().for_each(|row| row.force = row.start);
            member.rows_mut().iter_mut().take(1).for_each(|row| row.force = force);
        }
        self.accelerate(Among::All);
        let (balanced, left) = (slow * sqrt(stiffest), self.left);
        self.members().all(|(_, member)| {
            let is_pressed = member.contact.plastic().force() > 0.0;
            let way = |row: &Row| left * (largest(row.rate, 0.0) + 0.5 * left * largest(row.net, 0.0));
            let [normal, ..] = &member.rows;
            let stays =
                is_pressed || member.contact.plastic().indentation() + way(normal) < member.contact.path().lower;
            stays && member.rows().iter().all(|row| fabs(row.net) <= balanced * row.inverse_mass)
        })
    }

    /// Holds every contact where it is until the end of the step. The impulses end the rates, and the distances that the bodies
    /// would still move: `P = h F + c` and `Q = h^2 F/2 + q` with `W c = r + h r'` and `W q = h r + h^2 r'/2`.
    fn rest(&mut self) {
        let h = self.left;
        self.solve(|row| h * (row.rate + 0.5 * h * row.net));
        let model = self.model;
        for (place, member) in self.members_mut() {
            let is_pressed = member.contact.plastic().force() > 0.0;
            for row in member.rows_mut() {
                row.moment += h * (row.impulse + 0.5 * h * row.force) + row.solution.number;
                row.way = h * (row.rate + 0.5 * h * row.net) - row.solution.product + row.lag;
                row.lag = 0.0;
            }
            if !is_pressed {
                member.rows_mut().iter_mut().for_each(Row::loosen);
                // within the range of the law, as it stays apart
                let _ = member.contact.go_straight(model(place).borrow(), &mut member.rows, h);
            }
        }
        self.solve(|row| row.rate + h * row.net);
        for (_, member) in self.members_mut() {
            let is_pressed = member.contact.plastic().force() > 0.0;
            for row in member.rows_mut() {
                row.impulse += h * row.force + row.solution.number;
                row.rate = if is_pressed { 0.0 } else { row.rate + h * row.net - row.solution.product };
            }
        }
    }

    /// Solves `W x = side` for the rows of the contacts that are pressed.
    fn solve(&mut self, side: impl Fn(&Row) -> f64) {
        for (_, member) in self.members_mut() {
            let is_pressed = member.contact.plastic().force() > 0.0;
            for row in member.rows_mut() {
                row.solution = Unknown::new(row.inverse_mass, side(row), is_pressed);
            }
        }
        self.sought = Among::All;
        gradients::solve(self, SOLVED);
    }

    /// Lets a block without any force fly, until the first contact touches or to the end of the step.
    fn fly(&mut self) -> Result<(), Refused> {
        let model = self.model;
        let times = self.members().map(|(_, member)| time_to_touch::<C, M>(&member.contact, &member.rows).0);
        let first = times.fold(f64::INFINITY, smallest);
        let time = smallest(first, self.left);
        for (place, member) in self.members_mut() {
            let refused = |deep| Refused::TooDeep(place, deep);
            member.rows_mut().iter_mut().for_each(|row| {
                row.loosen();
                (row.net, row.force) = (row.acceleration, 0.0);
            });
            member.set_ways(time);
            for row in member.rows_mut() {
                (row.way, row.lag) = (row.way + row.lag, 0.0);
            }
            // the way to the surface ends there
            let (until, touches) = time_to_touch::<C, M>(&member.contact, &member.rows);
            let (surface, touches) = (member.contact.path().lower, touches && until <= time);
            let way = surface - member.contact.plastic().indentation();
            member.rows_mut().iter_mut().take(1).filter(|_| touches).for_each(|row| row.way = way);
            member.contact.go_straight(model(place).borrow(), &mut member.rows, time).map_err(refused)?;
            for row in member.rows_mut() {
                row.moment += time * row.impulse;
                row.rate += time * row.net;
                row.last = [0.0; 3];
            }
        }
        self.left = if time < self.left { self.left - time } else { 0.0 };
        Ok(())
    }
}

impl<M, C: SharedContact<M>, B: Borrow<M>, F: Fn(usize) -> B> System for Chords<'_, C, M, B, F> {
    fn visit(&mut self, mut each: impl FnMut(&mut Unknown)) {
        self.among_mut(self.sought)
            .for_each(|member| member.rows_mut().iter_mut().for_each(|row| each(&mut row.solution)));
    }

    fn multiply(&mut self) {
        self.visit(|unknown| unknown.image = 0.0);
        // the response with its sign
        self.respond(self.sought, |row| -row.solution.direction, |row| &mut row.solution.image);
        self.visit(|unknown| unknown.reply = unknown.own * unknown.direction + unknown.image);
    }
}

/// The part of a chord of this `time` \[s\] at which the sum of the rates of the normal and, times `scale`, of the tangent changes
/// its sign: where springs at the edge cease to slip. 1 or more if it does not.
fn turn_of(normal: &Row, tangent: &Row, scale: f64, time: f64) -> f64 {
    let (start, change) = (normal.rate + scale * tangent.rate, time * (normal.net + scale * tangent.net));
    quotient(-start, change, start * (start + change) < 0.0, 1.0)
}

/// Stiffness of the rows of a contact over that of the normal.
fn ratios<C>(member: &Work<C>) -> [f64; 3] {
    [1.0, member.ratio, member.ratio]
}

/// Whether no force acts, and the contact does not touch at once.
fn flies<C: SharedContact<M>, M>(contact: &C, rows: &[Row; 3]) -> bool {
    contact.plastic().force() == 0.0 && time_to_touch::<C, M>(contact, rows).0 > 0.0
}

/// Time until a contact without force touches \[s\], infinite if it does not; and whether it touches then. One that leaves a dent
/// and comes back does not touch, but is where it turns: a fresh surface may have forgotten the dent by then.
fn time_to_touch<C: SharedContact<M>, M>(contact: &C, [Row { rate, acceleration, .. }, ..]: &[Row; 3]) -> (f64, bool) {
    let surface = contact.path().lower;
    let gap = surface - contact.plastic().indentation();
    let touches = gap <= 4.0 * f64::EPSILON * fabs(surface);
    if touches && (*rate > 0.0 || (*rate == 0.0 && *acceleration > 0.0)) {
        return (0.0, true);
    }
    let square = rate * rate + 2.0 * acceleration * largest(gap, 0.0);
    let sum = rate + root(square);
    match *acceleration > 0.0 && *rate < 0.0 {
        true if surface > 0.0 => (-rate / acceleration, false),
        true => ((root(square) - rate) / acceleration, true),
        false => (quotient(2.0 * gap, sum, square >= 0.0 && sum > 0.0 && !touches, f64::INFINITY), true),
    }
}
