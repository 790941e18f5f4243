//! Contacts that share bodies: a force at one contact accelerates the others.
//!
//! A box on its feet, a ball between walls, a stack, a cradle: a body with two contacts moves by the forces of both. Within
//! a step all contacts are integrated together,
//!
//! ```text
//! d(rate)/dt = a - W F(indentations, histories),    W = J M^-1 J^T
//! ```
//!
//! with the [matrix of inverse effective masses](InverseMasses) `W` and the accelerations `a` held. The contacts are sorted
//! into blocks that are coupled (`block`); a contact alone without a loss moves as [`motion`] moves it, to the last bit.
//! Each contact is on a smooth `branch` of its law; an event (`targets`) puts it on another. Between two events the motion
//! is analytic but for the power with which a force begins. A Runge-Kutta pair of order 8 (`dop853`, `step`) follows it, in
//! time or in the `clock` of a contact that has just touched or is about to part. A `loss` has events of its own. Contacts
//! that are slow and in balance `rest` until the end of the step.
//!
//! With [friction](crate::tangential) each contact has more rows: the matrix and the rates are those of all normals, then of all
//! tangents in the first direction, then in the second. The springs of friction follow straight ways, so that such contacts move
//! along `chords`.
//!
//! The impulse `P` and its integral `Q` are states of the motion, so that the bodies move by them exactly:
//!
//! ```text
//! rate(h) = rate(0) + a h - W P,    indentation(h) = indentation(0) + rate(0) h + a h^2/2 - W Q
//! ```
//!
//! A [plate](crate::losses::Plate) gives way by `alpha P`, which the indentation lacks.
//!
//! # Accuracy
//! Rates and indentations are off by about 1e-12 of their scale after an event: `sqrt(2 E W_ii)` for the energy `E` of the
//! motion, and that times the shortest time of an oscillation. The largest indentation of a contact that does not yield is
//! off by up to 1e-9 of itself. Rest drops 1e-12 of the elastic energy of the load. Bodies that rattle between redundant
//! contacts amplify rounding as the motion itself does. The work of a contact with a loss is right to 1e-6 of itself where it is far
//! below the energy of the motion.
//!
//! With friction, rates are off by some 1e-7, with a loss 1e-5, on growing dents 1e-4, in two directions 2e-4 of that scale after an event
//! (`chords`); the balance of work is exact, and Coulomb's bound holds to 1e-9.
//!
//! # Evaluations
//! An impact of one contact takes some hundred evaluations in a step. The most that was seen is 3,105 if its laws have segments, else
//! 36,595, both on a plate of 3 mm. A longer step takes as many for each touch, and some hundred for each oscillation of a contact that is
//! pressed.
//!
//! # Rest
//! Bodies come to rest with a [fitted](crate::losses::RestitutionFitted) loss, as fast as it damps a lasting contact. The
//! [waves](crate::losses::HalfSpaceRadiation) alone take minutes for it; on a plate the bodies sink on at the rate at which it gives way;
//! without a loss they bounce for ever. The fitted loss also damps the swing of contacts that stick.
//!
//! # Limits
//! `W` is constant within a step, so that a body that turns by an angle changes its directions by that angle from step to
//! step. The step costs as many evaluations as the motion has events and oscillations; a light body between heavy ones
//! oscillates fast.
//!
//! # Example
//! Two balls that touch, hit by a third one:
//! ```
//! use brinell_contact::shared::{InverseMasses, Work, follow};
//! use brinell_contact::{Body, History, Model, Pair, Surface, loading::Hertz, unloading::ContactRadius};
//!
//! let ball = Body { radius: 0.01, youngs_modulus: 206e9, poissons_ratio: 0.3 };
//! let pair = Pair::new(&ball, &ball, 300e6).unwrap();
//! let model = Model { pair, loading: Hertz, unloading: ContactRadius, surface: Surface::Dented };
//!
//! // each ball has 33 g: 1/m + 1/m on the diagonal, -1/m for the ball in the middle
//! let entries = [60.6, -30.3, 60.6];
//! let masses = InverseMasses::new(2, &entries).unwrap();
//! masses.check(&mut [0.0; 3]).unwrap();
//!
//! let mut contacts = [History::start(&model, 0.0).unwrap(); 2];
//! let (mut rates, mut work) = ([1.0, 0.0], contacts.map(Work::new));
//! follow(&mut contacts, |_| &model, &masses, &[0.0; 2], &mut rates, &mut work, 1e-3).unwrap();
//!
//! // balls that touch share the impact: the last one does not get all of it
//! let speed = work[1].impulse() / 0.033;
//! assert!(speed > 0.99 && speed < 0.999, "{speed}");
//! ```

mod block;
mod branch;
mod chords;
mod clock;
mod curve;
mod dop853;
mod gradients;
pub mod inverse_masses;
mod loss;
mod rest;
mod scales;
mod step;
mod targets;
mod work;

pub use inverse_masses::{InverseMasses, NotInverseMasses};
pub use work::{Row, Work};

use crate::Model;
use crate::history::History;
use crate::loading::Loading;
use crate::losses::Damping;
use crate::motion::{self, ExternalLoad, NoMotion, PlasticContact};
use crate::numerics::largest;
use crate::regime::TooDeep;
use crate::segment::Segment;
use crate::unloading::Unloading;
use block::Block;
use chords::Chords;
use core::borrow::Borrow;
use work::Instant;

/// A contact whose motion can be coupled with that of others.
pub trait SharedContact<M>: PlasticContact<M> {
    /// Whether the motion of one such contact alone has a closed form: [`motion::follow`].
    const HAS_CLOSED_FORM: bool = false;

    /// The loss, with the largest rate since the touch; `None` for a contact that loses nothing without yield.
    fn damping(&self) -> Option<Damping> {
        None
    }

    /// Adds the `heat` \[J\] of a step, and notes the largest rate since the touch \[m/s\]; zero while apart.
    ///
    /// # Errors
    /// [`TooDeep`] for a heat that overflows.
    fn lose(&mut self, _model: &M, _swiftest: f64, _heat: f64) -> Result<(), TooDeep> {
        Ok(())
    }

    /// The number of tangential directions, zero without friction.
    const DIRECTIONS: usize = 0;

    /// The path of the present dent, of a contact with friction; without yield the elastic curve.
    fn path(&self) -> Segment {
        Segment::NOTHING
    }

    /// Ratio of the tangential to the normal stiffness, of a contact with friction.
    fn stiffness_ratio(_model: &M) -> f64 {
        1.0
    }

    /// The scale of the tangential lengths of a contact with friction in one direction, whose springs move in closed form: they slip or
    /// stick as the sign of the sum of the rate of indentation and the scaled tangential one says, in either direction.
    fn slip_scale(&self, _model: &M) -> Option<f64> {
        None
    }

    /// Sets the forces of a contact with friction at the start of a chord.
    fn set_forces(&self, _model: &M, _rows: &mut [Row; 3]) {}

    /// Stiffness of each row of a contact with friction \[N/m\], and how its force grows with the indentation beside \[N/m\].
    fn stiffnesses(&self, _model: &M) -> [[f64; 2]; 3] {
        [[0.0; 2]; 3]
    }

    /// Moves a contact with friction on a straight way in this `time` \[s\], and finds the mean forces.
    ///
    /// # Errors
    /// [`TooDeep`] outside the range of the law.
    fn go_straight(&mut self, _model: &M, _rows: &mut [Row; 3], _time: f64) -> Result<(), TooDeep> {
        Ok(())
    }

    /// Adds to the work of the tangential force what it does on the bend of a chord \[J\].
    fn take_up(&mut self, _work: f64) {}

    /// Notes what friction did over a `step` \[s\].
    fn end_step(&mut self, _model: &M, _rows: &[Row; 3], _step: f64) {}
}

impl<L: Loading, U: Unloading> SharedContact<Model<L, U>> for History {
    const HAS_CLOSED_FORM: bool = true;
}

/// The result of a step. Impulses and their moments are in the [`Work`] of each contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Number of evaluations of the force of a contact that is not apart, over all contacts. An evaluation of a law without
    /// segments counts as ten.
    pub evaluations: u32,
}

/// The reason why a step could not be computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refused {
    /// The numbers of contacts, accelerations, rates, working memories and inverse masses do not belong together.
    Sizes,
    /// The indentation of this contact, from 0 on, left the range of the law, or one of its numbers is not finite.
    TooDeep(usize, TooDeep),
    /// The step takes more than [`MOST_EVALUATIONS`](motion::MOST_EVALUATIONS).
    TooLong {
        /// Time left \[s\] when they were spent: a step without it would have been computed.
        left: f64,
    },
}

/// Largest rate \[m/s\] and acceleration \[m/s^2\]: their squares are finite.
const LARGEST: f64 = 1e100;

/// Moves all contacts through `step` \[s\] > 0. The `masses` must have been [checked](InverseMasses::check). `accelerations`
/// \[m/s^2\] are the closing accelerations by all forces but those of these contacts, constant over the step; `rates`
/// \[m/s\] are the closing rates, at the start and then at the end. `work` needs one entry for each contact, and then has
/// the impulses. `model` gives the model of a contact.
///
/// # Errors
/// [`Refused`]; no contact and no rate has changed then.
pub fn follow<C: SharedContact<M>, M, B: Borrow<M>>(
    contacts: &mut [C],
    model: impl Fn(usize) -> B,
    masses: &InverseMasses,
    accelerations: &[f64],
    rates: &mut [f64],
    work: &mut [Work<C>],
    step: f64,
) -> Result<Outcome, Refused> {
    let (count, rows) = (contacts.len(), masses.count());
    if [accelerations.len(), rates.len(), count * (1 + C::DIRECTIONS)] != [rows; 3] || work.len() != count {
        return Err(Refused::Sizes);
    }
    for (place, &number) in accelerations.iter().chain(&*rates).chain([&step]).enumerate() {
        let is_finite = number > -LARGEST && number < LARGEST;
        if !is_finite {
            return Err(Refused::TooDeep(place_of(place_of(place, rows).0, count).0, TooDeep { indentation: number }));
        }
    }
    let given = contacts.iter().zip(accelerations).zip(&*rates).zip(&mut *work);
    for (((contact, &acceleration), &rate), member) in given {
        let indentation = contact.plastic().indentation();
        member.contact = *contact;
        member.acceleration = acceleration;
        member.now = Instant::at(indentation, rate);
        member.trial = member.now;
        (member.deepest, member.is_held) = (0.0, false);
    }
    find_blocks(work, masses);
    if C::DIRECTIONS > 0 {
        return follow_with_friction(contacts, model, masses, (accelerations, rates), work, step);
    }
    let mut evaluations = 0_u32;
    for first in 0..count {
        let Some(row) = work.get_mut(first..) else { break };
        let is_alone = !row.iter().skip(1).any(|member| member.block == first);
        let Some(member) = row.first_mut().filter(|member| member.block == first) else { continue };
        let spent = if is_alone && C::HAS_CLOSED_FORM {
            follow_alone(member, model(first).borrow(), step).map_err(|reason| match reason {
                NoMotion::TooDeep(deep) => Refused::TooDeep(first, deep),
                NoMotion::TooLong => Refused::TooLong { left: step },
            })?
        } else {
            let mut block = Block::new(row, masses, &model, first, step);
            block.run()?;
            block.evaluations
        };
        evaluations = evaluations.saturating_add(spent);
    }
    for ((contact, rate), member) in contacts.iter_mut().zip(rates).zip(work) {
        (*contact, *rate) = (member.contact, member.now.rate());
    }
    Ok(Outcome { evaluations })
}

/// Moves a contact that is coupled with no other and whose motion has a closed form. Returns the number of evaluations.
fn follow_alone<C: SharedContact<M>, M>(member: &mut Work<C>, model: &M, step: f64) -> Result<u32, NoMotion> {
    let Work { acceleration, inverse_mass, .. } = *member;
    let [before, rate, ..] = member.now.numbers;
    let mass = 1.0 / inverse_mass;
    let load = ExternalLoad { mass, acceleration };
    let motion::Outcome { speed, speed_removed, evaluations, deepest } =
        motion::follow(&mut member.contact, model, &load, rate, step)?;
    let after = member.contact.plastic().indentation();
    // what the force has kept the bodies from coming closer
    let kept = step * (rate + 0.5 * acceleration * step) - (after - before);
    let moment = if speed_removed > 0.0 { mass * largest(kept, 0.0) } else { 0.0 };
    member.now.numbers = [after, speed, mass * speed_removed, moment];
    member.deepest = deepest;
    Ok(evaluations)
}

/// The same with friction, for which the motion is followed in straight parts.
fn follow_with_friction<C: SharedContact<M>, M, B: Borrow<M>>(
    contacts: &mut [C],
    model: impl Fn(usize) -> B,
    masses: &InverseMasses,
    (accelerations, rates): (&[f64], &mut [f64]),
    work: &mut [Work<C>],
    step: f64,
) -> Result<Outcome, Refused> {
    let count = contacts.len();
    for (place, member) in work.iter_mut().enumerate() {
        member.used = 1 + C::DIRECTIONS;
        for (index, row) in (place..).step_by(count).zip(member.rows_mut()) {
            let [acceleration, rate] =
                [accelerations, &*rates].map(|numbers| numbers.get(index).copied().unwrap_or(0.0));
            *row = Row { inverse_mass: masses.of(index, index), acceleration, rate, ..Row::default() };
        }
    }
    let mut evaluations = 0_u32;
    for block in 0..count {
        if work.get(block).is_some_and(|member| member.block == block) {
            let mut chords = Chords::new(work, masses, &model, block, step);
            chords.run()?;
            evaluations = evaluations.saturating_add(chords.evaluations);
        }
    }
    for (place, (contact, member)) in contacts.iter_mut().zip(work).enumerate() {
        member.contact.end_step(model(place).borrow(), &member.rows, step);
        *contact = member.contact;
        for (rate, row) in rates.iter_mut().skip(place).step_by(count).zip(member.rows()) {
            *rate = row.rate;
        }
    }
    Ok(Outcome { evaluations })
}

/// The contact of the row with this `index` of `count` contacts, and its axis: 0 for the normal, then the tangential directions.
fn place_of(index: usize, count: usize) -> (usize, usize) {
    let axis = index.checked_div(count).unwrap_or(0);
    (index - axis * count, axis)
}

/// Sorts the contacts into blocks, each with the number of its first contact.
fn find_blocks<C>(work: &mut [Work<C>], masses: &InverseMasses) {
    let count = work.len();
    for (place, (member, row)) in work.iter_mut().zip(masses.rows(0)).enumerate() {
        member.block = place;
        member.inverse_mass = row.first().copied().unwrap_or(0.0);
        member.reach = row.iter().rposition(|&entry| entry != 0.0).unwrap_or(0);
    }
    // every round passes the smallest number on; there are at most as many rounds as contacts
    for _ in 0..count {
        let mut changed = false;
        for (index, row) in masses.rows(0).enumerate() {
            let (one, _) = place_of(index, count);
            for (other, _) in (index..).zip(row).skip(1).filter(|(_, entry)| **entry != 0.0) {
                let (other, _) = place_of(other, count);
                let [first, second] = [one, other].map(|place| work.get(place).map_or(place, |member| member.block));
                changed |= first != second;
                let least = core::cmp::min(first, second);
                for place in [one, other] {
                    work.get_mut(place).into_iter().for_each(|member| member.block = least);
                }
            }
        }
        if !changed {
            break;
        }
    }
}

/// Work of the contact forces over a step \[J\], from the impulses and their moments. It needs no inverse of `W`, is right
/// for singular ones and driven walls too, and equals the change of the energies of the contacts.
///
/// `P.(r0 + r1)/2 + a.(h P/2 - Q)`, with the rates \[m/s\] at the start and at the end, and the `accelerations` \[m/s^2\] of
/// the step. With `W P = r0 + a h - r1` it is the integral of `F r`.
pub fn work_of_step<C>(work: &[Work<C>], (before, after): (&[f64], &[f64]), accelerations: &[f64], step: f64) -> f64 {
    let rows = before.iter().zip(after).zip(accelerations).enumerate();
    let works = rows.map(|(index, ((&before, &after), &acceleration))| {
        let (contact, axis) = place_of(index, work.len());
        let [impulse, moment] = work.get(contact).map_or([0.0; 2], |member| match axis.checked_sub(1) {
            None => [member.impulse(), member.moment()],
            Some(direction) => [member.tangential_impulse(direction), member.tangential_moment(direction)],
        });
        0.5 * impulse * (before + after) + acceleration * (0.5 * step * impulse - moment)
    });
    works.sum()
}
