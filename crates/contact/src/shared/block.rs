//! The motion of contacts that are coupled, from event to event: the integration between two events, and the place of each event.

use super::branch::{Branch, Event, Kind, Watched};
use super::clock::Clock;
use super::curve::Curve;
use super::dop853::{self, STAGES, Slopes};
use super::inverse_masses::InverseMasses;
use super::loss::Loss;
use super::work::{Instant, Scales, Work};
use super::{Refused, SharedContact};
use crate::losses::Damping;
use crate::motion::MOST_EVALUATIONS;
use crate::numbers::{largest, quotient, root, smallest};
use crate::{Model, Surface};
use core::borrow::Borrow;
use core::marker::PhantomData;
use libm::{fabs, pow, sqrt};

/// Largest error of a step of the integration, as a part of the scales of rates and indentations.
const TOLERANCE: f64 = 2e-13;

/// Errors below this part of a number do not count: they are rounding.
const ROUNDING: f64 = 2e-15;

/// Number of evaluations that one evaluation of a law without segments counts for.
const COSTLY: u32 = 10;

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

/// Largest number of steps in search of an event; two or three are usual.
const APPROACHES: u32 = 40;

/// Correction of the length of a step to an event, relative to the length, below which the event is found.
const FOUND: f64 = 1e-12;

/// Largest number of rounds in which contacts change their branches without a step.
const ROUNDS: u32 = 4;

/// Energies grow by this factor before the scales are computed again.
const GROWN: f64 = 1.2;

/// The place of no contact.
const NO_CLOCK: usize = usize::MAX;

/// The same for an event at which the force has a kink and no jump: the place matters by its square.
const FOUND_KINK: f64 = 1e-8;

/// A part of a bracket so near its start that the number is at its threshold there.
const AT_START: f64 = 1e-6;

/// Two lengths of a step between which an event lies, each with the number that falls through zero there.
struct Bracket {
    before: (f64, f64),
    beyond: (f64, f64),
}

impl Bracket {
    /// The next length to try after `length`, where the number is `value`: by the secant, and every fourth time halfway.
    fn next(&mut self, length: f64, value: f64, attempt: u32) -> f64 {
        *(if value > 0.0 { &mut self.before } else { &mut self.beyond }) = (length, value);
        let ((low, above), (high, below)) = (self.before, self.beyond);
        let part = quotient(above, above - below, above - below > 1e-100 * above, 0.5);
        let part = if attempt % 4 == 3 || !(part > AT_START && part < 1.0) { 0.5 } else { part };
        low + part * (high - low)
    }
}

/// What ends a step of the integration early.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Target {
    /// The end of the time, for a step in the clock of a contact.
    Time,
    /// An event of the contact at this place.
    Event(usize, Watched),
}

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
    scales: Scales,
    /// The largest energy so far \[J\].
    energy: f64,
    /// The step of the integration to try next \[s\].
    next: f64,
    /// Whether a contact has just touched.
    touched: bool,
    /// Number of evaluations that one of all forces counts for.
    cost: u32,
    /// Slopes of time and of the root of the height, by the clock.
    ticks: Slopes<2>,
    /// Time and root of the height at the end of the step that was tried.
    ticked: [f64; 2],
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
            scales: Scales { root_energy: 0.0, time: 0.0 },
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
    fn active_mut(&mut self) -> impl Iterator<Item = (usize, &mut Work<C>)> {
        self.members_mut().filter(|(_, member)| member.active)
    }

    /// Calls `read` with the model of the contact at `place`.
    pub(super) fn with_model<T>(&self, place: usize, read: impl FnOnce(&Model<C::Loading, C::Unloading>) -> T) -> T {
        let model = (self.model)(self.first + place);
        read(C::plastic_model(model.borrow()))
    }

    /// Moves the block through its time.
    ///
    /// # Errors
    /// [`Refused`].
    pub fn run(&mut self) -> Result<(), Refused> {
        self.enter();
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
    fn count(&mut self, evaluations: u32) -> Result<(), Refused> {
        self.evaluations = self.evaluations.saturating_add(evaluations);
        if self.evaluations > MOST_EVALUATIONS { Err(Refused::TooLong { left: self.left }) } else { Ok(()) }
    }

    /// Finds the branches on which the contacts start, and their forces.
    fn enter(&mut self) {
        let Block { model, first, .. } = *self;
        for (place, member) in self.members_mut() {
            let model = model(first + place);
            let (history, rate) = (member.contact.plastic(), member.now.rate());
            let plastic = C::plastic_model(model.borrow());
            member.branch = Branch::of(history, plastic, rate);
            member.loss = member.contact.damping().map(|damping| Loss {
                damping: Damping { swiftest: largest(fabs(rate), damping.swiftest), ..damping },
                leads: 0.0,
                slack: false,
                before: history.work(plastic),
            });
        }
        self.evaluate_now();
        self.scale_losses();
    }

    /// Gives a scale to the damping of contacts that are pressed at the start and have never moved.
    fn scale_losses(&mut self) {
        let Block { model, first, .. } = *self;
        for (place, member) in self.members_mut() {
            let is_pressed = member.branch.kind != Kind::Apart;
            let Some(loss) = member.loss.as_mut().filter(|loss| is_pressed && loss.damping.swiftest == 0.0) else {
                continue;
            };
            let model = model(first + place);
            let indentation = member.now.indentation();
            let stiffness = member.branch.stiffness(indentation, C::plastic_model(model.borrow()));
            let height = largest(indentation - member.branch.surface(), 0.0);
            loss.damping.swiftest = root(member.inverse_mass * stiffness) * height;
            if loss.damping.swiftest == 0.0 {
                loss.begin();
            }
        }
    }

    /// Forces and accelerations at present.
    fn evaluate_now(&mut self) {
        self.cost = 0;
        let mut cost = 0;
        for (_, member) in self.members_mut() {
            member.trial = member.now;
            member.active = true;
            cost += member.branch.cost(COSTLY);
        }
        self.cost = cost;
        self.evaluate(NO_CLOCK, 0.0);
        for (_, member) in self.members_mut() {
            member.now = member.trial;
            member.active = member.branch.kind != Kind::Apart;
        }
        spread_activity(self.work, self.masses, self.first);
    }

    /// Forces and accelerations of the instants that are tried. The contact at `place_of_clock` is where the root of its height is `w`.
    fn evaluate(&mut self, place_of_clock: usize, w: f64) {
        let Block { model, first, masses, .. } = *self;
        for (place, member) in self.active_mut() {
            let branch = &member.branch;
            let (by_root, indentation) = (place == place_of_clock, member.trial.indentation());
            let known = if by_root { branch.force_of_root(w) } else { branch.force(indentation) };
            let elastic = known.unwrap_or_else(|| {
                let model = model(first + place);
                let model = C::plastic_model(model.borrow());
                let at = if by_root { branch.surface() + w * w } else { indentation };
                let force = branch.force_without_segments(at, model);
                if by_root && w < 0.0 { -force } else { force }
            });
            let trial = &mut member.trial;
            trial.elastic = elastic;
            (trial.force, trial.approach) = (elastic, trial.rate());
            if let Some(loss) = &member.loss
                && branch.kind != Kind::Apart
            {
                if loss.needs_stiffness() {
                    let model = model(first + place);
                    let model = C::plastic_model(model.borrow());
                    trial.stiffness = match by_root {
                        true => branch.stiffness_of_root(w, model),
                        false => branch.stiffness(indentation, model),
                    };
                    trial.easing = loss.easing(trial.stiffness);
                }
                (trial.force, trial.approach) = loss.force_and_approach(elastic, trial.stiffness, trial.rate());
            } else {
                trial.easing = 0.0;
            }
            member.trial.net = member.acceleration;
        }
        accelerate(self.work, masses, first);
    }

    /// Lets every contact that is at a threshold and moves across it change its branch.
    fn change_branches(&mut self) -> Result<(), Refused> {
        for _ in 0..ROUNDS {
            let mut changed = false;
            for place in 0..self.work.len() {
                let Some(member) = self.work.get(place).filter(|member| member.block == self.first) else { continue };
                let surface = self.with_model(place, |model| model.surface);
                let due = member.watches(surface).find(|watched| member.is_due(watched, &self.scales));
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
        let model = (self.model)(self.first + place);
        let model = C::plastic_model(model.borrow());
        let Some(member) = self.work.get_mut(place) else { return Ok(()) };
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
        if forgets && model.surface == Surface::Fresh {
            let at = parts_from.unwrap_or(0.0);
            member.deepest = largest(member.deepest, member.branch.largest);
            settle(member, model, at, false).map_err(|deep| Refused::TooDeep(self.first + place, deep))?;
            let rate = smallest(member.now.rate(), -f64::MIN_POSITIVE);
            member.branch = Branch::of(member.contact.plastic(), model, rate);
            return Ok(());
        }
        member.branch = member.branch.after(event, model, member.now.indentation());
        self.touched |= event == Event::Touch;
        Ok(())
    }

    /// The scales of the motion, from the largest energy so far.
    fn rescale(&mut self) {
        let mut stored = 0.0;
        let (mut moving, mut least) = (0.0, 0.0);
        for (place, member) in self.members() {
            let (rate, mass) = (member.now.rate(), member.inverse_mass);
            moving = largest(0.5 * rate * rate / mass, moving);
            if member.branch.kind != Kind::Apart {
                let stiffness =
                    self.with_model(place, |model| member.branch.stiffness(member.now.indentation(), model));
                stored += member.stored(stiffness);
            }
            // a body that is set down has no energy yet
            let pressed = fabs(member.acceleration) / mass;
            if pressed > 0.0 {
                let segment = self.with_model(place, |model| member.branch.stiff_segment(model));
                let exists = segment.power > 1e-100 * pressed;
                let bent = quotient(pressed, segment.power, exists, f64::INFINITY);
                let bent = if exists { pow(bent, 2.0 / 3.0) } else { bent };
                let straight = quotient(pressed, segment.linear, segment.linear > 1e-100 * pressed, f64::INFINITY);
                let way = smallest(bent, straight);
                least = largest(if way < f64::INFINITY { pressed * way } else { 0.0 }, least);
            }
        }
        let energy = largest(largest(moving + stored, least), self.energy);
        let known = self.scales.time > 0.0 && energy <= GROWN * self.energy && !self.touched;
        self.scales.root_energy = sqrt(2.0 * energy);
        if known {
            self.scales.root_energy = largest(self.scales.root_energy, sqrt(2.0 * self.energy));
            return;
        }
        self.energy = energy;
        let mut swiftest = 0.0;
        for (place, member) in self.members() {
            let segment = self.with_model(place, |model| member.branch.stiff_segment(model));
            let exists = segment.power > 1e-100 * energy;
            let bent = quotient(2.5 * energy, segment.power, exists, 0.0);
            let bent = if exists { pow(bent, 0.4) } else { f64::INFINITY };
            let exists = segment.linear > 1e-100 * energy;
            let straight = root(quotient(2.0 * energy, segment.linear, exists, 0.0));
            let way = smallest(bent, if exists { straight } else { f64::INFINITY });
            let way = if way < f64::INFINITY { way } else { 0.0 };
            let stiffness = segment.linear + 1.5 * segment.power * sqrt(way) + 2.0 * segment.square * way;
            swiftest = largest(member.inverse_mass * stiffness, swiftest);
            let decay = member.loss.as_ref().map_or(0.0, |loss| loss.decay(stiffness, member.inverse_mass));
            swiftest = largest(decay * decay, swiftest);
        }
        self.scales.time = quotient(1.0, sqrt(swiftest), swiftest > 0.0, self.left);
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
        let mut length = clock.as_ref().map_or(time, |clock| clock.length(time));
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
                self.next = passed * growth;
            }
            self.accept(clock.as_ref(), length);
            self.left = if is_last { 0.0 } else { largest(self.left - passed, 0.0) };
            self.rescale();
            return Ok(());
        };
        let (target, length) = self.approach(clock.as_ref(), target, part * length, length)?;
        // the time of a step by the clock beyond the surface goes back
        self.next = if clock.is_some() { time } else { passed * smallest(growth, 1.0) };
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

    /// The time of the step that was tried \[s\].
    fn passed(&self, clock: Option<&Clock>, length: f64) -> f64 {
        let [time, _] = self.ticked;
        if clock.is_some() { time } else { length }
    }

    /// The contact in whose clock the next step is smooth, if it is not in time \[s\].
    fn clock(&self, time: f64) -> Option<Clock> {
        let clocks = self.members().filter_map(|(place, member)| Clock::of(place, member, &self.scales, time));
        clocks.reduce(|best, next| if next.until < best.until { next } else { best })
    }

    /// Tries a step of this length. Returns its error as a multiple of the tolerance.
    fn attempt(&mut self, clock: Option<&Clock>, length: f64) -> Result<f64, Refused> {
        self.count(self.cost.saturating_mul(STAGES as u32))?;
        let start = clock.map_or([0.0; 2], |clock| [0.0, clock.root]);
        for stage in 0..if self.cost > 0 { STAGES } else { 0 } {
            let [_, w] = if stage == 0 { start } else { self.ticks.at_stage(stage, &start, length) };
            if stage == 0 {
                self.active_mut().for_each(|(_, member)| member.trial = member.now);
            } else {
                for (_, member) in self.active_mut() {
                    member.trial.numbers = member.slopes.at_stage(stage, &member.now.numbers, length);
                }
                self.evaluate(clock.map_or(NO_CLOCK, |clock| clock.place), w);
            }
            let pace = if clock.is_some() { w } else { 1.0 };
            let mut rate_of_clock = 0.0;
            for (place, member) in self.active_mut() {
                let Instant { numbers: [_, rate, impulse, _], force, net, approach, .. } = member.trial;
                member.slopes.set(stage, [pace * approach, pace * net, pace * force, pace * impulse]);
                if member.loss.is_some() {
                    member.power.set(stage, [pace * force * rate]);
                }
                if clock.is_some_and(|clock| clock.place == place) {
                    rate_of_clock = approach;
                }
            }
            self.ticks.set(stage, [pace, 0.5 * rate_of_clock]);
        }
        self.ticked = self.ticks.at_end(&start, length);
        let time = self.passed(clock, length);
        self.members_mut().filter(|(_, member)| !member.active).for_each(|(_, member)| member.fly(time));
        let (mut fifth, mut third) = (0.0, 0.0);
        let scales = self.scales;
        let mut note = |of_fifth: f64, of_third: f64, number: f64, unit: f64| {
            let missed = length * fabs(of_fifth);
            if missed > ROUNDING * fabs(number) || missed.is_nan() {
                let relative = |missed: f64| quotient(missed, unit, unit > 1e-100 * missed, 1e100);
                fifth = largest(fifth, relative(missed));
                third = largest(third, relative(length * fabs(of_third)));
            }
        };
        for (_, member) in self.active_mut() {
            member.trial.numbers = member.slopes.at_end(&member.now.numbers, length);
            if member.loss.is_some() {
                let [work] = member.power.at_end(&[member.now.work], length);
                member.trial.work = work;
            }
            let ([way5, rate5, ..], [way3, rate3, ..]) = member.slopes.differences();
            let [indentation, rate, ..] = member.trial.numbers;
            let unit = TOLERANCE * member.speed(&scales);
            note(way5, way3, indentation, unit * scales.time);
            note(rate5, rate3, rate, unit);
        }
        if clock.is_some() {
            let ([time5, _], [time3, _]) = self.ticks.differences();
            note(time5, time3, 0.0, TOLERANCE * scales.time);
        }
        Ok(dop853::error(fifth, third))
    }

    /// Forces at the end of the step that was tried.
    fn finish(&mut self) -> Result<(), Refused> {
        self.count(self.cost)?;
        self.evaluate(NO_CLOCK, 0.0);
        Ok(())
    }

    /// Makes the step that was tried the present.
    fn accept(&mut self, clock: Option<&Clock>, length: f64) {
        let paces = self.paces(clock);
        for (_, member) in self.members_mut() {
            // a turn on the way without yield, which is no event
            if member.branch.kind == Kind::Path && member.now.approach > 0.0 && member.trial.approach < 0.0 {
                let top = indentation_over(member, &paces, length).top();
                member.branch.note(top.unwrap_or(0.0));
            }
            member.now = member.trial;
            member.branch.note(member.now.indentation());
        }
    }

    /// The pace of time, and its slope, at both ends of the step that was tried.
    fn paces(&self, clock: Option<&Clock>) -> [[f64; 2]; 2] {
        let Some(clock) = clock else { return [[1.0, 0.0]; 2] };
        let Some(member) = self.work.get(clock.place) else { return [[1.0, 0.0]; 2] };
        let [_, end] = self.ticked;
        [[clock.root, 0.5 * member.now.approach], [end, 0.5 * member.trial.approach]]
    }

    /// The first event of the step that was tried, but for one, and the part of the step at which it comes.
    fn first_target(&self, clock: Option<&Clock>, length: f64, but: Option<Target>) -> Option<(Target, f64)> {
        let paces = self.paces(clock);
        let mut first: Option<(Target, f64)> = None;
        let mut end = 1.0;
        let [time, w] = self.ticked;
        if let Some(clock) = clock {
            let [[from, slope], [to, last]] = paces;
            let parts = Target::Event(
                clock.place,
                Watched::Indentation { event: Event::Part, threshold: clock.surface, sign: -1.0 },
            );
            if w < 0.0 && but != Some(parts) {
                let bend = |instant: &Instant, w: f64| 0.5 * w * instant.bend() * length * length;
                let member = self.work.get(clock.place)?;
                let (start, stop) = (bend(&member.now, from), bend(&member.trial, to));
                let curve = Curve::quintic([from, slope * length, start], [to, last * length, stop]);
                end = curve.first_fall(1.0, 0.0).unwrap_or(1.0);
                first = Some((parts, end));
            }
            let curve = Curve::quintic(
                [0.0, from * length, slope * length * length],
                [time, to * length, last * length * length],
            );
            let left = curve.below(self.left, 1.0);
            if but != Some(Target::Time)
                && let Some(part) = left.first_fall(end, 0.0)
            {
                end = part;
                first = Some((Target::Time, part));
            }
        }
        for (place, member) in self.members() {
            let surface = self.with_model(place, |model| model.surface);
            let is_clock = clock.is_some_and(|clock| clock.place == place);
            for watched in member.watches(surface) {
                let parts = matches!(watched, Watched::Indentation { event: Event::Part, .. });
                // beyond the surface the clock goes back
                let is_beyond = matches!(watched, Watched::Pull { .. }) && is_clock && w < 0.0;
                if but == Some(Target::Event(place, watched)) || is_clock && parts || is_beyond {
                    continue;
                }
                let (now, trial) = (&member.now, &member.trial);
                let mut near = member.near(&watched, &self.scales);
                let curve = match watched {
                    Watched::Indentation { threshold, sign, .. } => {
                        indentation_over(member, &paces, length).below(threshold, sign)
                    }
                    Watched::Rate { threshold, sign, .. } => {
                        let [[from, _], [to, _]] = paces;
                        let (start, stop) = (from * now.bend() * length, to * trial.bend() * length);
                        Curve::cubic([now.approach, start], [trial.approach, stop]).below(threshold, sign)
                    }
                    Watched::Bend { sign } => {
                        // in units of rate, by the part of the step
                        let [[from, _], [to, _]] = paces;
                        let (start, stop) = (from * now.bend() * length, to * trial.bend() * length);
                        let rate =
                            Curve::cubic([sign * now.approach, sign * start], [sign * trial.approach, sign * stop]);
                        near = largest(near * length * largest(from, to), member.near(&Watched::TURN, &self.scales));
                        rate.slope()
                    }
                    Watched::Pull { .. } => {
                        let (start, stop) = (member.value(&watched, now), member.value(&watched, trial));
                        Curve::cubic([start, stop - start], [stop, stop - start])
                    }
                };
                if let Some(part) = curve.first_fall(end, near)
                    && (part < end || first.is_none())
                {
                    end = part;
                    first = Some((Target::Event(place, watched), part));
                }
            }
        }
        first
    }

    /// Repeats the step with the length that ends at the target, starting with `length`; another target may come first. Returns the
    /// target and the length, zero for a target that is here.
    fn approach(
        &mut self,
        clock: Option<&Clock>,
        target: Target,
        length: f64,
        whole: f64,
    ) -> Result<(Target, f64), Refused> {
        let (mut target, mut length) = (target, length);
        let mut bracket = self.bracket(clock, &target, whole);
        for attempt in 0..APPROACHES {
            if length <= 0.0 {
                return Ok((target, 0.0));
            }
            self.attempt(clock, length)?;
            self.finish()?;
            let (gap, slope) = self.gap(clock, &target);
            let (change, found) = match slope {
                Some(slope) => {
                    let leads = slope < 0.0 && fabs(gap) < -0.5 * slope * length;
                    (quotient(gap, -slope, leads, 0.0), FOUND)
                }
                None => (bracket.next(length, gap, attempt) - length, FOUND_KINK),
            };
            let other = self.first_target(clock, length, Some(target));
            if let Some((other, part)) = other
                && (part - 1.0) * length < change - found * length
            {
                let before = length;
                (target, length) = (other, part * length);
                bracket = self.bracket(clock, &target, before);
                continue;
            }
            if fabs(change) <= found * length || fabs(gap) <= self.exact(&target) {
                if slope.is_none() && gap > 0.0 {
                    // short of a kink, the force before it would come back at once
                    length *= 1.0 + 4.0 * FOUND_KINK;
                    self.attempt(clock, length)?;
                    self.finish()?;
                }
                break;
            }
            length += change;
        }
        Ok((target, length))
    }

    /// The lengths between which the target lies, after a step of length `whole` that went beyond.
    fn bracket(&self, clock: Option<&Clock>, target: &Target, whole: f64) -> Bracket {
        let start = match target {
            Target::Event(place, watched) => {
                self.work.get(*place).map_or(0.0, |member| member.value(watched, &member.now))
            }
            Target::Time => self.left,
        };
        let (beyond, _) = self.gap(clock, target);
        Bracket { before: (0.0, largest(start, 0.0)), beyond: (whole, smallest(beyond, 0.0)) }
    }

    /// The number of the motion that falls through zero at the target, and its slope if it is known, at the end of the step that was
    /// tried.
    fn gap(&self, clock: Option<&Clock>, target: &Target) -> (f64, Option<f64>) {
        let [_, [pace, slope]] = self.paces(clock);
        let [time, w] = self.ticked;
        let Target::Event(place, watched) = *target else { return (self.left - time, Some(-pace)) };
        let Some(member) = self.work.get(place) else { return (0.0, None) };
        let (value, trial) = (member.value(&watched, &member.trial), &member.trial);
        match watched {
            Watched::Indentation { event: Event::Part, .. } if clock.is_some_and(|clock| clock.place == place) => {
                (w, Some(slope))
            }
            Watched::Indentation { sign, .. } => (value, Some(-sign * pace * trial.approach)),
            Watched::Rate { sign, .. } => (value, Some(-sign * pace * trial.bend())),
            Watched::Bend { .. } | Watched::Pull { .. } => (value, None),
        }
    }

    /// A gap that is rounding. A number that was at the threshold already only has to be clear of it.
    fn exact(&self, target: &Target) -> f64 {
        let Target::Event(place, watched) = target else { return 0.0 };
        self.work.get(*place).map_or(0.0, |member| {
            let near = member.near(watched, &self.scales);
            if member.value(watched, &member.now) > near { 0.01 * near } else { 2.0 * near }
        })
    }

    /// Moves the histories to where the contacts are.
    fn leave(&mut self) -> Result<(), Refused> {
        for place in 0..self.work.len() {
            let model = (self.model)(self.first + place);
            let plastic = C::plastic_model(model.borrow());
            let Some(member) = self.work.get_mut(place).filter(|member| member.block == self.first) else { continue };
            let (at, rising) = (member.now.indentation(), member.now.approach > 0.0);
            let refused = |deep| Refused::TooDeep(self.first + place, deep);
            settle(member, plastic, at, rising).map_err(refused)?;
            if let Some(loss) = &member.loss {
                let is_apart = member.branch.kind == Kind::Apart;
                let swiftest = if is_apart { 0.0 } else { loss.swiftest(member.now.approach) };
                let heat = member.now.work - (member.contact.plastic().work(plastic) - loss.before);
                member.contact.lose(model.borrow(), swiftest, heat).map_err(refused)?;
            }
            member.deepest = largest(member.deepest, member.contact.plastic().max_indentation());
        }
        Ok(())
    }
}

/// Moves the history of a contact to the indentation `at` \[m\], over the largest one on its way.
fn settle<C: SharedContact<M>, M>(
    member: &mut Work<C>,
    model: &Model<C::Loading, C::Unloading>,
    at: f64,
    rising: bool,
) -> Result<(), crate::TooDeep> {
    let most = member.branch.largest;
    let history = member.contact.plastic_mut();
    if most > history.max_indentation() {
        history.go_to(model, most, true)?;
    }
    history.go_to(model, at, rising)
}

/// The indentation over the step that was tried.
fn indentation_over<C>(member: &Work<C>, paces: &[[f64; 2]; 2], length: f64) -> Curve {
    let &[start, end] = paces;
    let number = |instant: &Instant, [pace, slope]: [f64; 2]| {
        let (rate, bend) = (instant.approach, instant.bend());
        [instant.indentation(), pace * rate * length, (slope * rate + pace * pace * bend) * length * length]
    };
    Curve::quintic(number(&member.now, start), number(&member.trial, end))
}

/// Makes every contact active that is coupled with one that is pressed.
fn spread_activity<C>(work: &mut [Work<C>], masses: &InverseMasses, first: usize) {
    let mut rest = work;
    for row in masses.rows(first) {
        let Some((member, others)) = core::mem::take(&mut rest).split_first_mut() else { return };
        let is_pressed = |member: &Work<C>| member.block == first && member.branch.kind != Kind::Apart;
        for (other, &entry) in others.iter_mut().take(member.reach).zip(row.iter().skip(1)) {
            if entry != 0.0 {
                other.active |= is_pressed(member);
                member.active |= is_pressed(other);
            }
        }
        rest = others;
    }
}

/// Adds the accelerations by the contact forces: `-W F`. A row of the matrix ends with its last coupled contact.
#[inline(always)]
pub(super) fn accelerate<C>(work: &mut [Work<C>], masses: &InverseMasses, first: usize) {
    let mut rest = work;
    for row in masses.rows(first) {
        let Some((member, others)) = core::mem::take(&mut rest).split_first_mut() else { return };
        if member.block == first
            && member.active
            && let Some((own, row)) = row.split_first()
        {
            let force = member.trial.force;
            member.trial.net -= own * force;
            for (other, entry) in others.iter_mut().take(member.reach).zip(row) {
                member.trial.net -= entry * other.trial.force;
                other.trial.net -= entry * force;
            }
        }
        rest = others;
    }
}
