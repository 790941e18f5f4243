//! The state of a contact, and its path through the branches of the law.

mod behaviour;
mod course;
mod outputs;
mod saved;

use super::loading::Loading;
use super::path::Sum;
use super::segment::Segment;
use super::unloading::Unloading;
use super::{Model, Surface};
use core::borrow::Borrow;

/// The indentation up to which the laws are evaluated \[m\]: far beyond anything physical, and small enough that no force
/// or energy overflows.
pub const LARGEST_INDENTATION: f64 = 1e100;

/// The largest force \[N\] and stiffness \[N/m\] of a law that is a fit: times any time and any indentation they are numbers.
const LARGEST_FORCE: f64 = 1e200;

/// The farthest that bodies can be apart \[m\].
const FARTHEST: f64 = (-LARGEST_INDENTATION).next_up();

/// The smallest positive indentation \[m\]: an elastic contact is open at zero and closed here.
const TOUCHING: f64 = f64::from_bits(1);

/// The least increment of a branch that is followed both ways \[m\].
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
    /// The indentation that was refused \[m\].
    pub indentation: f64,
}

/// Everything a contact remembers.
///
/// The branch it is on follows from the indentation, the largest indentation and the last direction of motion; it is
/// kept so that a step that stays on it needs nothing else. While apart a contact keeps the path of its dent as well, if
/// that begins at no force: bodies that part and meet again then need nothing of the law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct History {
    indentation: Sum,
    max_indentation: f64,
    segment: Segment,
    /// The smallest increment that leaves the contact on its branch \[m\]: zero on the loading curve, where the way back is
    /// another.
    least_increment: f64,
    regime: Regime,
    /// Energy lost in dents that were left behind \[J\] ([`Surface::Fresh`]).
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
    /// A contact at `gap` \[m\] before any motion; a negative gap is an indentation reached along the loading curve.
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

    /// Moves the contact by `increment` \[m\], monotonically.
    ///
    /// # Errors
    /// [`TooDeep`] beyond [`LARGEST_INDENTATION`] on either side, and for NaN; the history is left as it was.
    pub fn advance<L: Loading, U: Unloading>(&mut self, model: &Model<L, U>, increment: f64) -> Result<(), TooDeep> {
        if self.advance_on_branch(increment) { Ok(()) } else { self.leave_branch(increment, || model) }
    }

    /// Moves the contact by `increment` \[m\] to whatever branch holds there; the model is asked for only if the law is.
    #[inline(always)]
    fn leave_branch<L: Loading, U: Unloading, B: Borrow<Model<L, U>>>(
        &mut self,
        increment: f64,
        model: impl Fn() -> B,
    ) -> Result<(), TooDeep> {
        let sum = self.indentation.plus(increment);
        // what overflows has no rest
        let indentation = if sum.value.is_finite() { sum.total() } else { sum.value };
        // no motion, no other branch: at its very end a branch that was entered from below is still the right one
        if indentation != self.indentation.total() {
            let rising = increment > 0.0;
            let known = U::SEGMENTED && self.goes_on_path(indentation, rising, model().borrow().surface);
            if !known {
                self.enter(model().borrow(), indentation, rising)?;
            }
        }
        self.indentation = sum;
        Ok(())
    }

    /// Moves the contact by `increment` \[m\] if that leaves it on its branch; otherwise nothing is done, and false.
    #[inline(always)]
    pub(super) fn advance_on_branch(&mut self, increment: f64) -> bool {
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

    /// Whether the contact is on the loading curve, from where the way back is another one.
    fn is_loading(&self) -> bool {
        self.least_increment == 0.0
    }

    /// Puts the contact at `indentation` \[m\] exactly; at a corner on the branch that lies in the direction of motion.
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
        let before = *self;
        // then the law needn't be asked for its yield point, unless a fresh surface forgets the dent
        let has_yielded = self.regime as i32 >= Regime::ElastoplasticSecond as i32;
        // on the loading curve the largest indentation is the present one
        self.max_indentation = self.max_indentation();
        let forgets = model.surface == Surface::Fresh && indentation <= 0.0;
        if forgets && self.has_parted(model, indentation) {
            self.left_behind += self.dissipated_in_dent(model);
            self.max_indentation = 0.0;
        }
        if indentation > self.max_indentation {
            self.max_indentation = indentation;
        }
        let largest = self.max_indentation;
        self.least_increment = ANY;
        if indentation > 0.0 && indentation >= largest {
            let (segment, regime) = model.loading.branch(&model.pair, indentation);
            self.regime = regime;
            self.segment = Segment { lower: indentation, ..segment };
            self.least_increment = 0.0;
            // a law without segments may be a fit that ends before
            let Segment { constant: force, linear: stiffness, .. } = self.segment;
            let shows_numbers = model.loading.is_segmented() || force < LARGEST_FORCE && stiffness < LARGEST_FORCE;
            if !shows_numbers {
                *self = before;
                return Err(TooDeep { indentation });
            }
        } else if !model.loading.can_yield() || !(has_yielded && largest > 0.0) && model.is_elastic_at(largest) {
            if indentation > 0.0 {
                self.regime = Regime::Elastic;
                self.segment = Segment { lower: TOUCHING, upper: largest, ..model.loading.segment(&model.pair, 0.0) };
            } else {
                self.regime = Regime::Apart;
                self.segment = Segment::apart(FARTHEST, TOUCHING);
            }
        } else {
            let peak = model.peak(largest);
            let path = model.unloading.path(&model.pair, &peak);
            if indentation > path.lower || (rising && indentation == path.lower) {
                let segment = match U::SEGMENTED {
                    true => path,
                    false => model.unloading.tangent(&model.pair, &peak, &path, indentation),
                };
                self.press(&path, segment);
            } else {
                self.part(&path, model, indentation);
            }
        }
        Ok(())
    }

    /// Parts from the path of the dent, or meets it again, if the contact knows it; otherwise nothing is done, and false.
    #[inline]
    fn goes_on_path(&mut self, indentation: f64, rising: bool, surface: Surface) -> bool {
        let residual = self.segment.origin;
        let meets = indentation > residual || (rising && indentation == residual);
        // a fresh surface may forget its dent
        let stays = surface == Surface::Dented || indentation > 0.0;
        // written so that a NaN and what is too far away are left to the law
        let below = stays && indentation < self.max_indentation && indentation > -LARGEST_INDENTATION;
        match self.regime {
            // an elastic contact knows no path: its origin is far away
            Regime::Apart if below && meets && residual == self.segment.upper => {
                (self.segment.lower, self.segment.upper) = (residual.next_up(), self.max_indentation);
                self.regime = Regime::Unloaded;
                true
            }
            Regime::Unloaded if below && !meets && self.segment.begins_at_origin() => {
                (self.segment.lower, self.segment.upper) = (farthest(surface, indentation), residual);
                self.regime = Regime::Apart;
                true
            }
            _ => false,
        }
    }

    /// On the `path` of a dent, or on a `segment` of it.
    fn press(&mut self, path: &Segment, segment: Segment) {
        self.regime = Regime::Unloaded;
        let lower = if segment.lower > path.lower { segment.lower } else { path.lower.next_up() };
        self.segment = Segment { lower, ..segment };
    }

    /// Apart at `indentation` \[m\], with the dent that `path` leads to.
    fn part<L, U: Unloading>(&mut self, path: &Segment, model: &Model<L, U>, indentation: f64) {
        self.regime = Regime::Apart;
        let lower = farthest(model.surface, indentation);
        self.segment = match U::SEGMENTED && path.begins_at_origin() {
            true => Segment { lower, upper: path.origin, ..*path },
            false => Segment::apart(lower, path.lower),
        };
    }

    /// Whether there is no contact at `indentation` \[m\] <= 0. Laws that make energy may hold on beyond the original surface.
    fn has_parted<L: Loading, U: Unloading>(&self, model: &Model<L, U>, indentation: f64) -> bool {
        let largest = self.max_indentation();
        model.is_elastic_at(largest) || indentation <= model.unloading_path(largest).lower
    }
}

/// How far a contact can go from `indentation` \[m\] without another branch \[m\]. A fresh surface forgets its dent at zero, so that
/// the border must be noticed.
fn farthest(surface: Surface, indentation: f64) -> f64 {
    if surface == Surface::Fresh && indentation > 0.0 { TOUCHING } else { FARTHEST }
}
