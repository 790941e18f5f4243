//! The state of a contact, and its path through the branches of the law.

use super::loading::Loading;
use super::momentum;
use super::path::{Course, Sum};
use super::segment::Segment;
use super::unloading::Unloading;
use super::{Model, Surface};
use core::f64::consts::PI;

/// The indentation up to which the laws are evaluated [m]: far beyond anything physical, and small enough that no force
/// or energy overflows.
pub const LARGEST_INDENTATION: f64 = 1e100;

/// The farthest that bodies can be apart [m].
const FARTHEST: f64 = (-LARGEST_INDENTATION).next_up();

/// The smallest positive indentation [m]: an elastic contact is open at zero and closed here.
const TOUCHING: f64 = f64::from_bits(1);

/// The least increment of a branch that is followed both ways [m].
const ANY: f64 = -f64::MAX;

/// Which part of the law a contact is on. The numbers are those of the variable `regime`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// No contact.
    Apart = 0,
    /// Hertz: nothing has yielded.
    Elastic = 1,
    /// Elastoplastic loading, first region.
    ElastoplasticFirst = 2,
    /// Elastoplastic loading, second region.
    ElastoplasticSecond = 3,
    /// Fully plastic loading.
    FullyPlastic = 4,
    /// Below the largest indentation of a contact that has yielded: unloading or reloading.
    Unloaded = 5,
}

/// The indentation left the range in which the law can be evaluated, or isn't a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TooDeep {
    /// The indentation that was refused [m].
    pub indentation: f64,
}

/// Everything a contact remembers.
///
/// The branch it is on follows from the indentation, the largest indentation and the last direction of motion; it is
/// kept so that a step that stays on it needs nothing else.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct History {
    indentation: Sum,
    max_indentation: f64,
    segment: Segment,
    /// The smallest increment that leaves the contact on its branch [m]: zero on the loading curve, where the way back is
    /// another.
    least_increment: f64,
    regime: Regime,
    /// Energy lost in dents that were left behind [J] ([`Surface::Fresh`]).
    left_behind: f64,
}

impl Regime {
    /// Every regime, in the order of its number.
    pub const ALL: [Regime; 6] = [
        Regime::Apart,
        Regime::Elastic,
        Regime::ElastoplasticFirst,
        Regime::ElastoplasticSecond,
        Regime::FullyPlastic,
        Regime::Unloaded,
    ];
}

impl History {
    /// Number of words that hold a history.
    pub const WORDS: usize = 13;

    /// Whether the force depends on the rate at the same instant.
    pub const FOLLOWS_RATE: bool = false;

    /// Up to which order there are derivatives of the force by time.
    pub const DERIVATIVES: i32 = 2;

    /// A contact at `gap` [m] before any motion; a negative gap is an indentation reached along the loading curve.
    pub fn start<L: Loading, U: Unloading>(model: &Model<L, U>, gap: f64) -> Result<History, TooDeep> {
        let mut history = History {
            // not -gap, so that no gap is 0.0 and not -0.0
            indentation: Sum::new(0.0 - gap),
            max_indentation: 0.0,
            segment: Segment::apart(0.0, 0.0),
            least_increment: ANY,
            regime: Regime::Apart,
            left_behind: 0.0,
        };
        let indentation = history.indentation();
        history.enter(model, indentation, false)?;
        Ok(history)
    }

    /// Moves the contact by `increment` [m], monotonically.
    ///
    /// # Errors
    /// [`TooDeep`] beyond [`LARGEST_INDENTATION`] on either side, and for NaN; the history is left as it was.
    pub fn advance<L: Loading, U: Unloading>(
        &mut self,
        increment: f64,
        model: impl FnOnce() -> Model<L, U>,
    ) -> Result<(), TooDeep> {
        if !self.advance_on_branch(increment) {
            let sum = self.indentation.plus(increment);
            // what overflows has no rest
            let indentation = if sum.value.is_finite() { sum.total() } else { sum.value };
            // no motion, no other branch: at its very end a branch that was entered from below is still the right one
            if indentation != self.indentation.total() {
                self.enter(&model(), indentation, increment > 0.0)?;
            }
            self.indentation = sum;
        }
        Ok(())
    }

    /// Moves the contact with `rate` [m/s] over `step` [s].
    ///
    /// # Errors
    /// As for [`History::advance`].
    pub fn step<L: Loading, U: Unloading>(
        &mut self,
        rate: f64,
        step: f64,
        model: impl FnOnce() -> Model<L, U>,
    ) -> Result<(), TooDeep> {
        self.advance(rate * step, model)
    }

    /// Moves the contact on `course` over `step` [s].
    ///
    /// # Errors
    /// As for [`History::advance`].
    pub fn step_along<L: Loading, U: Unloading>(
        &mut self,
        course: &Course,
        step: f64,
        model: impl Fn() -> Model<L, U>,
    ) -> Result<(), TooDeep> {
        let mut moved = *self;
        let mut from = 0.0;
        for end in course.monotone_ends(step) {
            let to = course.way(end);
            moved.advance(to - from, &model)?;
            from = to;
        }
        *self = moved;
        Ok(())
    }

    /// Mean force over a step on `course` over `step` [s] that is yet to be made [N].
    ///
    /// # Errors
    /// As for [`History::advance`].
    pub fn mean_force_along<L: Loading, U: Unloading>(
        &self,
        course: &Course,
        step: f64,
        model: &Model<L, U>,
    ) -> Result<f64, TooDeep> {
        Ok(momentum::impulse(self, model, course, step)? / step)
    }

    /// Mean force of a step that came from the indentation `from` [m] on the branch that the contact is on [N].
    #[inline]
    pub fn mean_force_since(&self, from: f64) -> f64 {
        self.segment.mean_force(from, self.indentation())
    }

    /// Derivative of the force by time [N/s], or of second `order` [N/s^2], with this `rate` [m/s] and its derivative `slope`
    /// [m/s^2], on the branch that the contact is on.
    pub fn force_derivative<L: Loading, U: Unloading>(
        &self,
        order: i32,
        rate: f64,
        slope: f64,
        model: &Model<L, U>,
    ) -> f64 {
        let stiffness = self.stiffness();
        if order == 1 { stiffness * rate } else { self.curvature(model) * rate * rate + stiffness * slope }
    }

    /// d2F/d(indentation)^2 on the present branch [N/m^2]; of a law without segments from its stiffness near by.
    fn curvature<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        let indentation = self.indentation();
        let segmented = model.loading.is_segmented() && U::SEGMENTED;
        if segmented || self.segment.upper > indentation.next_up() {
            return self.segment.curvature(indentation);
        }
        let width = 1e-5 * indentation;
        let slope_at = |indentation: f64| {
            let mut near = *self;
            // at the end of the range there is no neighbour
            let rising = self.least_increment == 0.0;
            near.max_indentation = if rising { 0.0 } else { self.max_indentation };
            near.indentation = Sum::new(0.0);
            near.go_to(model, indentation, rising).map_or(0.0, |()| near.stiffness())
        };
        (slope_at(indentation + width) - slope_at(indentation - width)) / (2.0 * width)
    }

    /// The step if it leaves the contact on its branch; otherwise nothing is done, and false.
    #[inline(always)]
    pub fn plain_step(&mut self, rate: f64, step: f64) -> bool {
        self.advance_on_branch(rate * step)
    }

    /// Moves the contact by `increment` [m] if that leaves it on its branch; otherwise nothing is done, and false.
    #[inline(always)]
    pub fn advance_on_branch(&mut self, increment: f64) -> bool {
        let sum = self.indentation.plus(increment);
        let indentation = sum.total();
        // a NaN is not above the lower end; each comparison has its second number in memory
        let goes_on = increment >= self.least_increment;
        let ends = indentation >= self.segment.upper;
        let stays = indentation >= self.segment.lower && goes_on && !ends;
        if stays {
            self.indentation = sum;
        }
        stays
    }

    /// Puts the contact at `indentation` [m] exactly; at a corner on the branch that lies in the direction of motion.
    ///
    /// # Errors
    /// As for [`History::advance`].
    pub(super) fn go_to<L: Loading, U: Unloading>(
        &mut self,
        model: &Model<L, U>,
        indentation: f64,
        rising: bool,
    ) -> Result<(), TooDeep> {
        self.enter(model, indentation, rising)?;
        self.indentation = Sum::new(indentation);
        Ok(())
    }

    /// Finds the branch that holds at `indentation`; at a corner the one that lies in the direction of motion.
    #[cold]
    #[inline(never)]
    fn enter<L: Loading, U: Unloading>(
        &mut self,
        model: &Model<L, U>,
        indentation: f64,
        rising: bool,
    ) -> Result<(), TooDeep> {
        let within = indentation > -LARGEST_INDENTATION && indentation < LARGEST_INDENTATION;
        if !within {
            return Err(TooDeep { indentation });
        }
        // on the loading curve the largest indentation is the present one
        self.max_indentation = self.max_indentation();
        if model.surface == Surface::Fresh && indentation <= 0.0 && self.has_parted(model, indentation) {
            self.left_behind += self.dissipated_in_dent(model);
            self.max_indentation = 0.0;
        }
        if indentation > self.max_indentation {
            self.max_indentation = indentation;
        }
        let largest = self.max_indentation;
        self.least_increment = ANY;
        if indentation > 0.0 && indentation >= largest {
            self.regime = model.loading.regime(&model.pair, indentation);
            self.segment = Segment { lower: indentation, ..model.loading.segment(&model.pair, indentation) };
            self.least_increment = 0.0;
        } else if model.is_elastic_at(largest) {
            if indentation > 0.0 {
                self.regime = Regime::Elastic;
                self.segment = Segment { lower: TOUCHING, upper: largest, ..model.loading.segment(&model.pair, 0.0) };
            } else {
                self.regime = Regime::Apart;
                self.segment = Segment::apart(FARTHEST, TOUCHING);
            }
        } else {
            let residual = model.unloading_path(largest).lower;
            if indentation > residual || (rising && indentation == residual) {
                self.regime = Regime::Unloaded;
                let segment = model.unloading_segment(largest, indentation);
                let lower = if segment.lower > residual { segment.lower } else { residual.next_up() };
                self.segment = Segment { lower, ..segment };
            } else {
                self.regime = Regime::Apart;
                // a fresh surface forgets the dent at zero, so that the border must be noticed
                let forgets = model.surface == Surface::Fresh && indentation > 0.0;
                let lower = if forgets { TOUCHING } else { FARTHEST };
                self.segment = Segment::apart(lower, residual);
            }
        }
        Ok(())
    }

    /// Whether there is no contact at `indentation` [m] <= 0. Laws that make energy may hold on beyond the original surface.
    fn has_parted<L: Loading, U: Unloading>(&self, model: &Model<L, U>, indentation: f64) -> bool {
        let largest = self.max_indentation();
        model.is_elastic_at(largest) || indentation <= model.unloading_path(largest).lower
    }

    /// Indentation [m]; negative while apart.
    #[inline]
    pub fn indentation(&self) -> f64 {
        self.indentation.total()
    }

    /// Largest indentation of the present dent [m].
    pub fn max_indentation(&self) -> f64 {
        let indentation = self.indentation();
        if indentation > self.max_indentation { indentation } else { self.max_indentation }
    }

    /// The part of the law the contact is on.
    pub fn regime(&self) -> Regime {
        self.regime
    }

    /// Normal force [N], compressive positive; exactly zero while apart.
    #[inline]
    pub fn force(&self) -> f64 {
        self.segment.force_inside(self.indentation.total())
    }

    /// The force [N] by laws whose branches have a quadratic term only if `squares` says so.
    #[inline(always)]
    pub fn plain_force(&self, _rate: f64, squares: bool) -> f64 {
        if squares { self.force() } else { self.segment.force_without_square(self.indentation.total()) }
    }

    /// The force, which doesn't depend on the rate [N].
    #[inline]
    pub fn force_at_rate(&self, _rate: f64) -> f64 {
        self.force()
    }

    /// Always: the force doesn't depend on the rate.
    #[inline(always)]
    pub fn is_finite_at_rate(&self, _rate: f64) -> bool {
        true
    }

    /// dF/d(indentation) on the present branch [N/m]; at a corner the one in the direction of the last motion.
    pub fn stiffness(&self) -> f64 {
        self.segment.stiffness(self.indentation.total())
    }

    /// The stiffness, which doesn't depend on the rate [N/m].
    pub fn stiffness_at_rate(&self, _rate: f64) -> f64 {
        self.stiffness()
    }

    /// Depth of the dent that would remain if the load were taken off now [m].
    pub fn residual_indentation<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        if model.is_elastic_at(self.max_indentation()) {
            0.0
        } else {
            model.unloading_path(self.max_indentation()).lower
        }
    }

    /// Contact radius [m], 0 while apart: that of the loading law up to the largest indentation, and from there down
    /// that of the unloading law.
    pub fn contact_radius<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        let indentation = self.indentation.total();
        match self.regime {
            Regime::Apart => 0.0,
            Regime::Unloaded if model.loading.can_yield() => {
                let path = model.unloading_path(self.max_indentation());
                let peak = model.peak(self.max_indentation());
                model.unloading.contact_radius(&model.pair, &peak, &path, indentation)
            }
            _ => model.loading.contact_radius(&model.pair, indentation),
        }
    }

    /// Force over contact area [Pa], 0 while apart.
    pub fn mean_pressure<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        let radius = self.contact_radius(model);
        if radius > 0.0 { self.force() / (PI * radius * radius) } else { 0.0 }
    }

    /// The mean pressure, which doesn't depend on the rate [Pa].
    pub fn mean_pressure_at_rate<L: Loading, U: Unloading>(&self, model: &Model<L, U>, _rate: f64) -> f64 {
        self.mean_pressure(model)
    }

    /// What unloading would give back [J].
    pub fn elastic_energy<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        match self.regime {
            Regime::Apart => 0.0,
            Regime::Elastic => model.loading.work(&model.pair, self.indentation.total()),
            _ => model.recovered_work(self.max_indentation(), self.indentation.total()),
        }
    }

    /// Work turned into plastic deformation since the start [J].
    pub fn dissipated_energy<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        self.left_behind + self.dissipated_in_dent(model)
    }

    /// Loading work up to the largest indentation, less what unloading from there gives back [J].
    fn dissipated_in_dent<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        let largest = self.max_indentation();
        if model.is_elastic_at(largest) {
            return 0.0;
        }
        model.loading.work(&model.pair, largest) - model.recovered_work(largest, largest)
    }

    /// Work done on the contact by the bodies since the start [J]: the sum of the other two energies, and so a function
    /// of the state, not of the steps that led there. A contact that starts pressed in counts the way there as done.
    pub fn work<L: Loading, U: Unloading>(&self, model: &Model<L, U>) -> f64 {
        self.elastic_energy(model) + self.dissipated_energy(model)
    }

    /// Makes this history the same as `other`, number by number: a compiler that looks for the smallest code would otherwise
    /// take the slowest instruction for it.
    #[inline(always)]
    pub fn copy_from(&mut self, other: &History) {
        let Sum { value, rest } = other.indentation;
        let Segment { lower, upper, origin, constant, linear, power, square } = other.segment;
        let (max_indentation, least_increment) = (other.max_indentation, other.least_increment);
        let (regime, left_behind) = (other.regime, other.left_behind);
        self.indentation = Sum { value, rest };
        self.segment = Segment { lower, upper, origin, constant, linear, power, square };
        (self.max_indentation, self.least_increment) = (max_indentation, least_increment);
        (self.regime, self.left_behind) = (regime, left_behind);
    }

    /// The history as words, to be stored.
    pub fn to_words(&self) -> [u64; History::WORDS] {
        let Segment { lower, upper, origin, constant, linear, power, square } = self.segment;
        let Sum { value, rest } = self.indentation;
        let state = [value, rest, self.max_indentation, self.left_behind, self.least_increment].map(f64::to_bits);
        let segment = [lower, upper, origin, constant, linear, power, square].map(f64::to_bits);
        let [value, rest, largest, left_behind, least] = state;
        let [lower, upper, origin, constant, linear, power, square] = segment;
        let regime = self.regime as u64;
        [value, rest, largest, left_behind, least, lower, upper, origin, constant, linear, power, square, regime]
    }

    /// The history of a contact by `model` that [`History::to_words`] stored; `None` if a word is not a finite number or not a regime.
    pub fn from_words<L, U>(words: &[u64; History::WORDS], _model: &Model<L, U>) -> Option<History> {
        let [numbers @ .., regime] = words.map(f64::from_bits);
        if numbers.iter().any(|number| !number.is_finite()) {
            return None;
        }
        let [value, rest, max_indentation, left_behind, least_increment, segment @ ..] = numbers;
        let [lower, upper, origin, constant, linear, power, square] = segment;
        let regime = Regime::ALL.into_iter().find(|&candidate| candidate as u64 == regime.to_bits())?;
        Some(History {
            indentation: Sum { value, rest },
            max_indentation,
            segment: Segment { lower, upper, origin, constant, linear, power, square },
            least_increment,
            regime,
            left_behind,
        })
    }
}
