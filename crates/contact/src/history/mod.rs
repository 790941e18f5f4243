//! The state of an elastoplastic contact, and its path through the branches of the law.

pub mod momentum;
pub(crate) mod panel;
pub mod path;
pub(crate) mod piece;

mod behaviour;
mod branches;
mod course;
mod outputs;
mod saved;

use super::Model;
use super::loading::Loading;
use super::regime::{LARGEST_INDENTATION, Regime, TooDeep};
use super::segment::Segment;
use super::unloading::Unloading;
use crate::history::path::Sum;

/// The largest force \[N\] and stiffness \[N/m\] of a fitted law. Their products with any time and any indentation are finite.
const LARGEST_FORCE: f64 = 1e200;

/// The lower limit of the indentation \[m\]: the largest distance between the bodies, with a negative sign.
const FARTHEST: f64 = (-LARGEST_INDENTATION).next_up();

/// The smallest positive indentation \[m\]: an elastic contact is open at zero and closed here.
const TOUCHING: f64 = f64::from_bits(1);

/// The `least_increment` \[m\] of a branch that is followed in both directions: any increment is allowed.
const ANY: f64 = -f64::MAX;

/// The whole state of an elastoplastic contact.
///
/// The branch follows from the indentation, the largest indentation and the last direction of motion. It is stored so that a
/// step that stays on the branch needs nothing else: the first three fields. While apart, a contact also keeps the path of its
/// dent if that path begins without force. Bodies that separate and touch again then need no evaluation of the law.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct History {
    indentation: Sum,
    /// The smallest increment that keeps the contact on its branch \[m\]. It is zero on the loading curve, because unloading
    /// follows another path.
    least_increment: f64,
    segment: Segment,
    max_indentation: f64,
    /// Energy lost in dents that were left behind \[J\]; see [`Surface::Fresh`].
    left_behind: f64,
    regime: Regime,
}

impl History {
    /// A contact at `gap` \[m\] before any motion. A negative gap is an indentation reached along the loading curve.
    pub fn start<L: Loading, U: Unloading>(model: &Model<L, U>, gap: f64) -> Result<History, TooDeep> {
        let mut history = History {
            // not -gap: a gap of zero must give 0.0 and not -0.0
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
    /// [`TooDeep`] beyond [`LARGEST_INDENTATION`] on either side, and for NaN; the history is then unchanged.
    pub fn advance<L: Loading, U: Unloading>(&mut self, model: &Model<L, U>, increment: f64) -> Result<(), TooDeep> {
        if self.advance_on_branch(increment) { Ok(()) } else { self.find_branch(model, increment) }
    }

    /// Moves the contact by `increment` \[m\] if it stays on its branch. Otherwise it changes nothing and returns false.
    #[inline(always)]
    pub(super) fn advance_on_branch(&mut self, increment: f64) -> bool {
        let sum = self.indentation.plus(increment);
        let indentation = sum.total();
        // false for NaN; each comparison takes its second operand from memory
        let goes_on = increment >= self.least_increment;
        let ends = indentation >= self.segment.upper;
        let stays = indentation >= self.segment.lower && goes_on && !ends;
        if stays {
            self.indentation = sum;
        }
        stays
    }

    /// Force \[N\] of the branch at `indentation` \[m\].
    #[inline(always)]
    fn force_at<L: Loading, U: Unloading>(&self, indentation: f64) -> f64 {
        // most laws never have a quadratic term
        match U::SQUARES || L::has_squares() {
            true => self.segment.force(indentation),
            false => self.segment.force_without_square(indentation),
        }
    }

    /// Whether the contact is on the loading curve, so that unloading would follow another path.
    pub(super) fn is_loading(&self) -> bool {
        self.least_increment == 0.0
    }

    /// The path of the dent from its lower end, if the contact knows it and if it is a segment without force at that end.
    pub(super) fn path_of_dent(&self) -> Option<Segment> {
        let known = match self.regime {
            Regime::Unloaded => self.segment.begins_at_origin(),
            Regime::Apart => self.segment.origin == self.segment.upper,
            _ => false,
        };
        known.then_some(Segment { lower: self.segment.origin, upper: self.max_indentation, ..self.segment })
    }

    /// The branch that the contact is on. While apart, the force is zero whatever the segment gives above its upper end.
    pub(super) fn branch(&self) -> &Segment {
        &self.segment
    }
}
