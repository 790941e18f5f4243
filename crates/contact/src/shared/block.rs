//! The motion of contacts that are coupled, from event to event.

use super::branch::{Branch, Event, Kind, Watched};
use super::clock::Clock;
use super::dop853::{self, Slopes};
use super::inverse_masses::InverseMasses;
use super::loss::Loss;
use super::scales::{Scales, energy_of_load, stiffness_at};
use super::targets::Target;
use super::work::Work;
use super::{Refused, SharedContact};
use crate::impact::Impact;
use crate::loading::Loading;
use crate::losses::Damping;
use crate::motion::MOST_EVALUATIONS;
use crate::numerics::{largest, quotient, root, smallest};
use crate::{Model, TooDeep};
use core::borrow::Borrow;
use core::marker::PhantomData;
use libm::fabs;

/// Number of evaluations that an event counts for.
const EVENT: u32 = 10;

/// The first step with the clock of a contact, in units of the time scale. In the clock a touch is smooth.
const FIRST_BY_CLOCK: f64 = 0.3;

/// The first step after a touch in time, in the same units.
const FIRST_AFTER_TOUCH: f64 = 1e-3;

/// The first step of a contact that is pressed.
const FIRST: f64 = 0.4;

/// Largest growth of a step. With more, the estimate of the error is blind across the point where a force begins.
const GROWTH: f64 = 3.0;

/// An indentation beyond which no load is of interest \[m\]: its powers are finite.
const FARTHEST: f64 = 1e20;

/// Largest number of rounds in which contacts change their branches without a step.
const ROUNDS: u32 = 4;

/// A block of contacts that are coupled, in a row of contacts that may have others in between.
pub(super) struct Block<'a, C, M, B, F> {
    pub work: &'a mut [Work<C>],
    pub masses: &'a InverseMasses<'a>,
    pub model: &'a F,
    /// The number of the first contact, which also names the block.
    pub first: usize,
    /// Time left \[s\].
    pub left: f64,
    /// Evaluations so far.
    pub evaluations: u32,
    pub scales: Scales,
    /// The largest energy so far \[J\].
    pub energy: f64,
    /// The step of the integration to try next \[s\].
    next: f64,
    /// Whether a contact has just touched.
    pub touched: bool,
    /// Number of evaluations that one of all forces counts for.
    pub cost: u32,
    /// Slopes of time and of the root of the height, by the clock.
    pub ticks: Slopes<2>,
    /// Time and root of the height at the end of the step that was tried.
    pub ticked: [f64; 2],
    marker: PhantomData<(M, B)>,
}

impl<'a, C: SharedContact<M>, M, B: Borrow<M>, F: Fn(usize) -> B> Block<'a, C, M, B, F> {
    /// The block of the contact `first`, for `step` \[s\].
    pub fn new(
        work: &'a mut [Work<C>],
        masses: &'a InverseMasses<'a>,
        model: &'a F,
        first: usize,
        step: f64,
    ) -> Block<'a, C, M, B, F> {
        Block {
            work,
            masses,
            model,
            first,
            left: step,
            evaluations: 0,
            scales: Scales::default(),
            energy: 0.0,
            next: step,
            touched: false,
            cost: 0,
            ticks: Slopes::NONE,
            ticked: [0.0; 2],
            marker: PhantomData,
        }
    }

    /// The contacts of the block, with their places in the row.
    pub(super) fn members(&self) -> impl Iterator<Item = (usize, &Work<C>)> {
        let first = self.first;
        self.work.iter().enumerate().filter(move |(_, member)| member.block == first)
    }

    pub(super) fn members_mut(&mut self) -> impl Iterator<Item = (usize, &mut Work<C>)> {
        let first = self.first;
        self.work.iter_mut().enumerate().filter(move |(_, member)| member.block == first)
    }

    /// The contacts on whose bodies a force acts.
    pub(super) fn active_mut(&mut self) -> impl Iterator<Item = (usize, &mut Work<C>)> {
        self.members_mut().filter(|(_, member)| member.active)
    }

    /// Stiffness of the contact at `place` at present \[N/m\].
    pub(super) fn stiffness(&self, place: usize, member: &Work<C>) -> f64 {
        present_stiffness(member, || (self.model)(self.first + place))
    }

    /// Moves the block through its time.
    ///
    /// # Errors
    /// [`Refused`].
    pub fn run(&mut self) -> Result<(), Refused> {
        self.enter()?;
        self.rescale();
        self.count(self.cost)?;
        if self.cost > 0 {
            self.next = smallest(FIRST * self.scales.time, self.left);
        }
        while self.left > 0.0 {
            self.count(1)?;
            self.change_branches()?;
            if self.rests() {
                self.rest();
            } else {
                self.go_on()?;
            }
        }
        self.leave()
    }

    /// Adds to the evaluations.
    pub(super) fn count(&mut self, evaluations: u32) -> Result<(), Refused> {
        self.evaluations = self.evaluations.saturating_add(evaluations);
        if self.evaluations > MOST_EVALUATIONS { Err(Refused::TooLong { left: self.left }) } else { Ok(()) }
    }

    /// Finds the branches on which the contacts start, and their forces.
    fn enter(&mut self) -> Result<(), Refused> {
        let Block { model, first, .. } = *self;
        let mut spent = 0;
        for (place, member) in self.members_mut() {
            let model = model(first + place);
            let (rate, plastic) = (member.now.rate(), member.contact.plastic_model(model.borrow()));
            member.branch = Branch::of(member.contact.plastic(), plastic.borrow(), rate);
            if member.now.indentation() == 0.0 {
                spent += meet(member, model.borrow()).map_err(|deep| Refused::TooDeep(first + place, deep))?;
            }
            member.loss = member.contact.damping().map(|damping| Loss {
                damping: Damping { swiftest: largest(fabs(rate), damping.swiftest), ..damping },
                leads: 0.0,
                slack: false,
                most: 0.0,
                before: member.contact.plastic().work(plastic.borrow()),
            });
        }
        self.evaluate_now();
        self.scale_losses();
        self.scale_held();
        self.count(spent)
    }

    /// Gives a scale to the damping of contacts that are pressed at the start and have never moved.
    fn scale_losses(&mut self) {
        let Block { model, first, .. } = *self;
        for (place, member) in self.members_mut() {
            let has_no_scale = member.loss.is_some_and(|loss| loss.damping.swiftest == 0.0);
            if member.branch.kind == Kind::Apart || !has_no_scale {
                continue;
            }
            let stiffness = present_stiffness(member, || model(first + place));
            let height = largest(member.now.indentation() - member.branch.surface(), 0.0);
            let Some(loss) = &mut member.loss else { continue };
            loss.damping.swiftest = root(member.inverse_mass * stiffness) * height;
            if loss.damping.swiftest == 0.0 {
                loss.begin();
            }
        }
    }

    /// Gives bodies that close at a given rate, which have no energy, the scales of a swing in which a target that gives way would take the
    /// energy of the largest load. No load is larger than that of the way of the step.
    fn scale_held(&mut self) {
        let (left, mut most) = (self.left, self.energy);
        for (_, member) in self.members_mut().filter(|(_, member)| member.inverse_mass == 0.0) {
            let (mobility, rate) = (member.loss.map_or(0.0, |loss| loss.easing(1.0)), fabs(member.now.rate()));
            let steady = quotient(rate, mobility, mobility > 0.0, 0.0);
            let (segment, _) = member.branch.scale();
            let reach = smallest(largest(member.now.indentation() + rate * left, segment.origin), FARTHEST);
            let deepest = segment.force(reach);
            // bodies that don't touch have any scale
            let load = if deepest > 0.0 { smallest(steady, deepest) } else { steady };
            let energy = energy_of_load(member.branch.scale(), largest(load, member.now.elastic));
            let stiffness = stiffness_at(member.branch.scale(), energy);
            member.inverse_mass = largest(mobility * mobility * stiffness, f64::MIN_POSITIVE);
            member.is_held = true;
            most = largest(energy, most);
        }
        self.energy = most;
    }

    /// Lets every contact that is at a threshold and moves across it change its branch.
    fn change_branches(&mut self) -> Result<(), Refused> {
        for _ in 0..ROUNDS {
            let mut changed = false;
            for place in 0..self.work.len() {
                let Some(member) = self.work.get(place).filter(|member| member.block == self.first) else { continue };
                let due = member.watches().find(|watched| member.is_due(watched, &self.scales));
                if let Some(watched) = due {
                    self.happen(place, &watched)?;
                    changed = true;
                }
            }
            if !changed {
                break;
            }
            self.evaluate_now();
            self.rescale();
        }
        Ok(())
    }

    /// Changes the branch of the contact at `place` at an event.
    fn happen(&mut self, place: usize, watched: &Watched) -> Result<(), Refused> {
        self.count(EVENT)?;
        let event = watched.event();
        let (first, model) = (self.first, (self.model)(self.first + place));
        let refused = |deep| Refused::TooDeep(first + place, deep);
        let Some(member) = self.work.get_mut(place) else { return Ok(()) };
        let spent = if event == Event::Touch { meet(member, model.borrow()).map_err(refused)? } else { 0 };
        let model = member.contact.plastic_model(model.borrow());
        let model = model.borrow();
        let is_still = member.is_still(&self.scales);
        if let Some(loss) = &mut member.loss {
            let sign = if let Watched::Rate { sign, .. } = watched { *sign } else { 0.0 };
            loss.happen(event, member.now.approach, sign);
            if event == Event::Touch && is_still {
                loss.begin();
            }
        }
        let parts_from = (event == Event::Part).then(|| member.branch.surface());
        let forgets = event == Event::Forget || parts_from.is_some_and(|surface| surface <= 0.0);
        if forgets && member.branch.forgets {
            let at = parts_from.unwrap_or(0.0);
            member.deepest = largest(member.deepest, member.branch.largest);
            settle(member, model, at, false).map_err(refused)?;
            let rate = smallest(member.now.rate(), -f64::MIN_POSITIVE);
            member.branch = Branch::of(member.contact.plastic(), model, rate);
            return Ok(());
        }
        let (indentation, loading) = (member.now.indentation(), member.now.elastic);
        member.branch = member.branch.after(event, model, indentation);
        if event == Event::Turn
            && let Some(loss) = &mut member.loss
        {
            let branch = &member.branch;
            let path = branch.force(indentation).unwrap_or_else(|| branch.force_without_segments(indentation, model));
            loss.hold(loading, path, member.now.rate());
        }
        self.touched |= event == Event::Touch;
        self.count(spent)
    }

    /// The contact in whose clock the next step is smooth, if it is not in time \[s\].
    fn clock(&self, time: f64) -> Option<Clock> {
        let clocks = self.members().filter_map(|(place, member)| Clock::of(place, member, &self.scales, time));
        clocks.reduce(|best, next| if next.until < best.until { next } else { best })
    }

    /// The time in which a contact leaves a segment of a chain \[s\]; infinite without one.
    fn time_on_segments(&self) -> f64 {
        if !C::Loading::has_chain() {
            return f64::INFINITY;
        }
        self.members().fold(f64::INFINITY, |least, (_, member)| smallest(member.time_on_segment(), least))
    }

    /// One step of the integration, or as much of it as there is before the next event.
    fn go_on(&mut self) -> Result<(), Refused> {
        if self.cost == 0 {
            self.next = self.left;
        }
        let mut time = smallest(self.next, self.left);
        let clock = self.clock(if self.touched { FIRST_BY_CLOCK * self.scales.time } else { time });
        if self.touched && self.cost > 0 {
            let first = if clock.is_some() { FIRST_BY_CLOCK } else { FIRST_AFTER_TOUCH };
            time = smallest(first * self.scales.time, self.left);
        }
        self.touched = false;
        let within = smallest(time, self.time_on_segments());
        let mut length = clock.as_ref().map_or(within, |clock| clock.length(within));
        let factor = loop {
            let error = self.attempt(clock.as_ref(), length)?;
            let factor = dop853::factor(error);
            // written positively to reject NaN
            if error <= 1.0 {
                break factor;
            }
            length *= if factor > 0.2 { smallest(factor, 0.9) } else { 0.2 };
            if length < f64::MIN_POSITIVE {
                return Err(Refused::TooLong { left: self.left });
            }
        };
        self.finish()?;
        let is_last = clock.is_none() && length >= self.left;
        let passed = self.passed(clock.as_ref(), length);
        let growth = if factor < GROWTH { factor } else { GROWTH };
        let Some((target, part)) = self.first_target(clock.as_ref(), length, None) else {
            if !is_last || growth < 1.0 {
                self.next = if within < time { largest(time, passed * growth) } else { passed * growth };
            }
            self.accept(clock.as_ref(), length);
            self.left = if is_last { 0.0 } else { largest(self.left - passed, 0.0) };
            self.rescale();
            return Ok(());
        };
        let (target, length, error) = self.approach(clock.as_ref(), target, part * length, length)?;
        if error > 1.0 {
            // where a force ends as a power, most of the longer step had none
            self.next = 0.5 * self.passed(clock.as_ref(), length);
            return Ok(());
        }
        // the time of a step by the clock beyond the surface goes back; across a joint the motion goes on as it was
        let goes_on = matches!(target, Target::Event(_, watched) if watched.event() == Event::Joint);
        self.next = if clock.is_some() || goes_on { time } else { passed * smallest(growth, 1.0) };
        let passed = if length > 0.0 { self.passed(clock.as_ref(), length) } else { 0.0 };
        if length > 0.0 {
            self.accept(clock.as_ref(), length);
        }
        match target {
            Target::Time => self.left = 0.0,
            Target::Event(place, watched) => {
                self.left = if length >= self.left && clock.is_none() { 0.0 } else { largest(self.left - passed, 0.0) };
                self.happen(place, &watched)?;
                self.evaluate_now();
            }
        }
        self.rescale();
        Ok(())
    }

    /// Moves the histories to where the contacts are.
    fn leave(&mut self) -> Result<(), Refused> {
        for place in 0..self.work.len() {
            let model = (self.model)(self.first + place);
            let Some(member) = self.work.get_mut(place).filter(|member| member.block == self.first) else { continue };
            let plastic = member.contact.plastic_model(model.borrow());
            let plastic = plastic.borrow();
            let (at, rising) = (member.now.indentation(), member.now.approach > 0.0);
            let refused = |deep| Refused::TooDeep(self.first + place, deep);
            settle(member, plastic, at, rising).map_err(refused)?;
            if let Some(loss) = &member.loss {
                let is_apart = member.branch.kind == Kind::Apart;
                let swiftest = if is_apart { 0.0 } else { loss.swiftest(member.now.approach) };
                let stored = member.contact.plastic().work(plastic) - loss.before;
                let heat = member.now.work - if member.is_held { 0.0 } else { stored };
                member.contact.lose(model.borrow(), swiftest, heat).map_err(refused)?;
            }
            member.deepest = largest(member.deepest, member.contact.plastic().max_indentation());
        }
        Ok(())
    }
}

/// Stiffness of a contact at present \[N/m\]. Only laws without segments need the `model`.
pub(super) fn present_stiffness<C: SharedContact<M>, M, B: Borrow<M>>(
    member: &Work<C>,
    model: impl FnOnce() -> B,
) -> f64 {
    let indentation = member.now.indentation();
    member.branch.stiffness(indentation).unwrap_or_else(|| {
        let model = model();
        member.branch.stiffness_without_segments(indentation, member.contact.plastic_model(model.borrow()).borrow())
    })
}

/// Lets a contact find the strength of an impact that begins now on a surface without a dent, if it has one of its own. Returns the number
/// of evaluations that it took.
fn meet<C: SharedContact<M>, M>(member: &mut Work<C>, model: &M) -> Result<u32, TooDeep> {
    let is_free = !member.is_held && member.inverse_mass > 0.0;
    let mass = quotient(1.0, member.inverse_mass, is_free, 0.0);
    let impact = Impact { mass, speed: member.now.approach };
    let may_be_new = is_free && impact.speed > 0.0 && member.branch.surface() <= 0.0;
    if !(may_be_new && member.contact.is_new(&impact)) {
        return Ok(0);
    }
    let plastic = member.contact.plastic_model(model);
    settle(member, plastic.borrow(), 0.0, true)?;
    let reached = member.contact.plastic().max_indentation();
    if !plastic.borrow().is_elastic_at(reached) {
        return Ok(0);
    }
    let (plastic, spent) = member.contact.strengthen(model, &impact)?;
    member.branch = Branch::of(member.contact.plastic(), plastic.borrow(), impact.speed);
    member.deepest = largest(member.deepest, reached);
    Ok(spent)
}

/// Moves the history of a contact to the indentation `at` \[m\], over the largest one on its way.
fn settle<C: SharedContact<M>, M>(
    member: &mut Work<C>,
    model: &Model<C::Loading, C::Unloading>,
    at: f64,
    rising: bool,
) -> Result<(), TooDeep> {
    let most = member.branch.largest;
    let history = member.contact.plastic_mut();
    if most > history.max_indentation() {
        history.go_to(model, most, true)?;
    }
    history.go_to(model, at, rising)
}
