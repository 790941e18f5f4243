//! Transitions between branches. The next branch follows from the present one, or is determined from scratch if it does not.

use super::{ANY, FARTHEST, History, LARGEST_FORCE, LARGEST_INDENTATION, Regime, TOUCHING, TooDeep};
use crate::history::path::Sum;
use crate::loading::Loading;
use crate::material::YieldPoint;
use crate::numerics::{next_above, smallest};
use crate::segment::Segment;
use crate::unloading::Unloading;
use crate::{Model, Peak, Surface};
use core::borrow::Borrow;

impl History {
    /// Moves the contact by `increment` \[m\] to the next branch if the present branch determines which one that is. Otherwise
    /// it changes nothing and returns false. The yield `point` and the model are used only if the law must be evaluated.
    #[inline(always)]
    pub(super) fn go_to_next_branch<L: Loading, U: Unloading, B: Borrow<Model<L, U>>>(
        &mut self,
        increment: f64,
        point: &YieldPoint,
        model: impl Fn() -> B,
    ) -> bool {
        let sum = self.indentation.plus(increment);
        let (before, indentation) = (self.indentation.total(), sum.total());
        // false for NaN
        let found = indentation < LARGEST_INDENTATION
            && if self.is_loading() && indentation < before {
                self.turn(model().borrow(), point, before, indentation)
            } else if indentation >= self.segment.upper {
                if indentation > 0.0 && indentation >= self.max_indentation {
                    indentation != before && {
                        let model = model();
                        let Model { loading, pair, .. } = model.borrow();
                        self.load(model.borrow(), loading.branch(pair, point, indentation), indentation).is_ok()
                    }
                } else {
                    self.meet::<U>(indentation) || self.touch(model().borrow(), point, indentation)
                }
            } else {
                let leaves = indentation < self.segment.lower && indentation > -LARGEST_INDENTATION;
                leaves && self.leave::<U>(model().borrow().surface, indentation)
            };
        if found {
            self.indentation = sum;
        }
        found
    }

    /// Moves the contact by `increment` \[m\] to the branch that holds there, whichever it is.
    #[cold]
    #[inline(never)]
    pub(super) fn find_branch<L: Loading, U: Unloading>(
        &mut self,
        model: &Model<L, U>,
        increment: f64,
    ) -> Result<(), TooDeep> {
        let sum = self.indentation.plus(increment);
        // after an overflow the compensation is meaningless
        let indentation = if sum.value.is_finite() { sum.total() } else { sum.value };
        // without motion the branch stays: a branch that was entered from below is still the right one at its upper end
        if indentation != self.indentation.total() {
            self.enter(model, indentation, increment > 0.0)?;
        }
        self.indentation = sum;
        Ok(())
    }

    /// Puts the contact exactly at `indentation` \[m\]. At a corner, it takes the branch in the direction of motion.
    ///
    /// # Errors
    /// As for [`History::advance`].
    pub(crate) fn go_to<L: Loading, U: Unloading>(
        &mut self,
        model: &Model<L, U>,
        indentation: f64,
        rising: bool,
    ) -> Result<(), TooDeep> {
        self.change_branch(model, indentation, rising)?;
        self.indentation = Sum::new(indentation);
        Ok(())
    }

    /// Changes to the branch that holds at `indentation` \[m\], without moving the contact.
    ///
    /// # Errors
    /// As for [`History::advance`].
    pub(super) fn change_branch<L: Loading, U: Unloading>(
        &mut self,
        model: &Model<L, U>,
        indentation: f64,
        rising: bool,
    ) -> Result<(), TooDeep> {
        let known = self.goes_on_path::<U>(indentation, rising, model.surface);
        if known { Ok(()) } else { self.enter(model, indentation, rising) }
    }

    /// Finds the branch that holds at `indentation` \[m\]; at a corner, the branch in the direction of motion.
    #[cold]
    #[inline(never)]
    pub(super) fn enter<L: Loading, U: Unloading>(
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
        let largest = self.max_indentation();
        if indentation > 0.0 && indentation >= largest {
            let Model { loading, pair, .. } = model;
            let branch = (loading.segment(pair, indentation), loading.regime(pair, indentation));
            return self.load(model, branch, indentation);
        }
        self.max_indentation = largest;
        let forgets = model.surface == Surface::Fresh && indentation <= 0.0;
        if forgets && self.has_parted(model, indentation) {
            self.left_behind += self.dissipated_in_dent(model);
            self.max_indentation = 0.0;
        }
        let largest = self.max_indentation;
        self.least_increment = ANY;
        if !model.is_elastic_at(largest) {
            let peak = model.peak(largest);
            self.unload(model, &peak, model.path_from(&peak), indentation, rising);
        } else if indentation > 0.0 {
            self.spring(model, indentation, largest);
        } else {
            self.regime = Regime::Apart;
            self.segment = Segment::apart(FARTHEST, TOUCHING);
        }
        Ok(())
    }

    /// Makes a contact that has not yielded, and is apart, like one that was never touched.
    pub(crate) fn forget_elastic(&mut self) {
        self.max_indentation = 0.0;
        self.least_increment = ANY;
        self.regime = Regime::Apart;
        self.segment = Segment::apart(FARTHEST, TOUCHING);
    }

    /// Sets the elastic branch of a contact that has not yielded, at `indentation` \[m\] below its `largest` indentation \[m\].
    #[inline(always)]
    fn spring<L: Loading, U: Unloading>(&mut self, model: &Model<L, U>, indentation: f64, largest: f64) {
        self.regime = Regime::Elastic;
        let elastic = model.elastic_segment(indentation);
        self.segment = match () {
            () if model.has_elastic_segment() => Segment { lower: TOUCHING, upper: largest, ..elastic },
            () if L::has_chain() => {
                let lower = if elastic.lower > TOUCHING { elastic.lower } else { TOUCHING };
                Segment { lower, upper: smallest(elastic.upper, largest), ..elastic }
            }
            () => elastic,
        };
    }

    /// Sets this branch of the loading curve. `indentation` \[m\] > 0 is the largest so far.
    ///
    /// # Errors
    /// [`TooDeep`] where the law ends earlier; the history is then unchanged.
    #[inline(always)]
    fn load<L: Loading, U>(
        &mut self,
        model: &Model<L, U>,
        (segment, regime): (Segment, Regime),
        indentation: f64,
    ) -> Result<(), TooDeep> {
        // a law without segments may be a fit that ends earlier
        let Segment { constant: force, linear: stiffness, .. } = segment;
        let shows_numbers = model.loading.is_segmented() || force < LARGEST_FORCE && stiffness < LARGEST_FORCE;
        if !shows_numbers {
            return Err(TooDeep { indentation });
        }
        self.max_indentation = indentation;
        self.segment = Segment { lower: indentation, ..segment };
        self.least_increment = 0.0;
        self.regime = regime;
        Ok(())
    }

    /// Turns back from the loading curve, where the contact is at `largest` \[m\], to `indentation` \[m\]. Returns false and
    /// changes nothing if the indentation may lie outside the dent.
    #[inline(always)]
    fn turn<L: Loading, U: Unloading>(
        &mut self,
        model: &Model<L, U>,
        point: &YieldPoint,
        largest: f64,
        indentation: f64,
    ) -> bool {
        if indentation <= 0.0 {
            return false;
        }
        self.max_indentation = largest;
        self.least_increment = ANY;
        if self.regime == Regime::Elastic && model.has_elastic_segment() {
            // loading and unloading follow the same curve
            (self.segment.lower, self.segment.upper) = (TOUCHING, largest);
        } else if model.yields_before(point, largest) {
            let peak = model.peak_at(point, largest, self.force_at::<L, U>(largest));
            let path = model.unloading.path(&model.pair, &peak);
            self.unload(model, &peak, path, indentation, false);
        } else {
            self.spring(model, indentation, largest);
        }
        true
    }

    /// Sets the branch below `peak`: on the unloading `path`, or separated from it.
    #[inline(always)]
    fn unload<L: Loading, U: Unloading>(
        &mut self,
        model: &Model<L, U>,
        peak: &Peak,
        path: Segment,
        indentation: f64,
        rising: bool,
    ) {
        if indentation > path.lower || (rising && indentation == path.lower) {
            let segment = match model.unloading.is_segmented() {
                true => path,
                false => model.unloading.tangent(&model.pair, peak, &path, indentation),
            };
            self.press(&path, segment);
        } else {
            self.part(&path, model, indentation);
        }
    }

    /// Touches the dent again at `indentation` \[m\], if the contact has kept the path of the dent. Otherwise it changes
    /// nothing and returns false.
    #[inline(always)]
    fn meet<U: Unloading>(&mut self, indentation: f64) -> bool {
        let residual = self.segment.origin;
        // a fresh surface may forget its dent below zero
        let is_kept = U::SEGMENTED && self.regime == Regime::Apart && residual == self.segment.upper;
        let meets = is_kept && indentation > 0.0;
        if meets {
            (self.segment.lower, self.segment.upper) = (next_above(residual), self.max_indentation);
            self.regime = Regime::Unloaded;
        }
        meets
    }

    /// Touches a surface that has not yielded, at `indentation` \[m\] below the largest one. Otherwise it changes nothing and
    /// returns false.
    #[inline(always)]
    fn touch<L: Loading, U: Unloading>(&mut self, model: &Model<L, U>, point: &YieldPoint, indentation: f64) -> bool {
        let touches =
            self.regime == Regime::Apart && indentation > 0.0 && !model.yields_before(point, self.max_indentation);
        if touches {
            self.spring(model, indentation, self.max_indentation);
        }
        touches
    }

    /// Leaves the dent, or touches it again, if the contact knows the path of the dent. Otherwise it changes nothing and
    /// returns false. At the end of the path, the direction of motion decides.
    #[inline]
    fn goes_on_path<U: Unloading>(&mut self, indentation: f64, rising: bool, surface: Surface) -> bool {
        let residual = self.segment.origin;
        let inside = indentation > residual || (rising && indentation == residual);
        // written positively: NaN goes to the law, which rejects it
        let below = indentation < self.max_indentation && indentation > -LARGEST_INDENTATION;
        below && if inside { self.meet::<U>(indentation) } else { self.leave::<U>(surface, indentation) }
    }

    /// Separates from the surface, to `indentation` \[m\]: from a dent whose path begins without force, or from a surface that
    /// has not yielded. Otherwise it changes nothing and returns false.
    #[inline(always)]
    fn leave<U: Unloading>(&mut self, surface: Surface, indentation: f64) -> bool {
        let residual = self.segment.origin;
        // a fresh surface may forget its dent
        let stays = surface == Surface::Dented || indentation > 0.0;
        // a tangent may begin there too, but is not the whole path
        let is_path = U::SEGMENTED && (!U::MIXED || self.segment.upper == self.max_indentation);
        let begins = is_path && self.segment.lower == next_above(residual);
        if self.regime == Regime::Unloaded && begins && self.segment.constant == 0.0 && stays {
            (self.segment.lower, self.segment.upper) = (farthest(surface, indentation), residual);
            self.regime = Regime::Apart;
            return true;
        }
        // a tangent does not know the surface; the segment of a chain may be another one
        let is_lowest = residual <= 0.0 && (U::SEGMENTED && !U::MIXED || self.segment.lower == TOUCHING);
        let springs = self.regime == Regime::Elastic && is_lowest && !self.is_loading() && stays;
        if springs {
            self.segment = Segment::apart(FARTHEST, TOUCHING);
            self.regime = Regime::Apart;
        }
        springs
    }

    /// Sets the branch on the `path` of a dent, or on a `segment` of it.
    #[inline(always)]
    fn press(&mut self, path: &Segment, segment: Segment) {
        self.regime = Regime::Unloaded;
        let lower = if segment.lower > path.lower { segment.lower } else { next_above(path.lower) };
        self.segment = Segment { lower, ..segment };
    }

    /// Sets the branch for no contact at `indentation` \[m\], with the dent at the lower end of `path`.
    #[inline(always)]
    fn part<L, U: Unloading>(&mut self, path: &Segment, model: &Model<L, U>, indentation: f64) {
        self.regime = Regime::Apart;
        let lower = farthest(model.surface, indentation);
        self.segment = match model.unloading.is_segmented() && path.begins_at_origin() {
            true => Segment { lower, upper: path.origin, ..*path },
            false => Segment::apart(lower, path.lower),
        };
    }

    /// Whether there is no contact at `indentation` \[m\] <= 0. With a law that is not passive, contact may last beyond the
    /// original surface.
    fn has_parted<L: Loading, U: Unloading>(&self, model: &Model<L, U>, indentation: f64) -> bool {
        let largest = self.max_indentation();
        model.is_elastic_at(largest) || indentation <= model.unloading_path(largest).lower
    }
}

/// The smallest indentation \[m\] that a contact can reach from `indentation` \[m\] without a change of branch. A fresh surface
/// forgets its dent at zero, so crossing zero must be a change of branch.
fn farthest(surface: Surface, indentation: f64) -> f64 {
    if surface == Surface::Fresh && indentation > 0.0 { TOUCHING } else { FARTHEST }
}
