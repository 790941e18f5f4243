//! The state of a contact, and its path through the branches of the law.

mod behaviour;
mod branches;
mod course;
mod outputs;
mod saved;

use super::Model;
use super::loading::Loading;
use super::path::Sum;
use super::segment::Segment;
use super::unloading::Unloading;

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
        if self.advance_on_branch(increment) { Ok(()) } else { self.find_branch(model, increment) }
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

    /// Force \[N\] at `indentation` \[m\] of the branch.
    #[inline(always)]
    fn force_at<L: Loading, U: Unloading>(&self, indentation: f64) -> f64 {
        // most laws never have a quadratic term
        match U::SQUARES || L::has_squares() {
            true => self.segment.force(indentation),
            false => self.segment.force_without_square(indentation),
        }
    }

    /// Whether the contact is on the loading curve, from where the way back is another one.
    pub(super) fn is_loading(&self) -> bool {
        self.least_increment == 0.0
    }

    /// The path of the dent from its lower end, if that is a segment without force there and the contact knows it.
    pub(super) fn path_of_dent(&self) -> Option<Segment> {
        let known = match self.regime {
            Regime::Unloaded => self.segment.begins_at_origin(),
            Regime::Apart => self.segment.origin == self.segment.upper,
            _ => false,
        };
        known.then_some(Segment { lower: self.segment.origin, upper: self.max_indentation, ..self.segment })
    }

    /// The branch that the contact is on. Apart there is no force on it, whatever its segment says above its upper end.
    pub(super) fn branch(&self) -> &Segment {
        &self.segment
    }
}
