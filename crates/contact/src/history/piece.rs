//! The smooth pieces of a law.

use crate::Model;
use crate::history::History;
use crate::loading::Loading;
use crate::numerics::{largest, next_above, smallest};
use crate::regime::LARGEST_INDENTATION;
use crate::segment::Segment;
use crate::unloading::{Peak, Unloading};

/// The numbers of a smooth piece: all but the model, whose law they belong to.
#[derive(Clone, Copy)]
pub(crate) struct Numbers {
    kind: Kind,
    /// Lower end of the piece \[m\].
    pub lower: f64,
    /// Upper end of the piece \[m\].
    pub upper: f64,
    segment: Segment,
    is_whole: bool,
    unloading: Option<(Peak, Segment)>,
}

impl Numbers {
    /// No piece of any law.
    pub const NOTHING: Numbers = Numbers {
        kind: Kind::Elastic,
        lower: 0.0,
        upper: 0.0,
        segment: Segment::NOTHING,
        is_whole: true,
        unloading: None,
    };

    /// The segment that covers the whole piece, if there is one.
    #[inline(always)]
    pub fn whole(&self) -> Option<&Segment> {
        self.is_whole.then_some(&self.segment)
    }

    /// Whether the piece is a part of the loading curve beyond yield, where unloading follows another path.
    pub fn is_loading(&self) -> bool {
        self.kind == Kind::Loading
    }
}

/// A smooth piece of a law.
pub struct Piece<'a, L, U> {
    pub(crate) model: &'a Model<L, U>,
    kind: Kind,
    /// Lower end of the piece \[m\].
    pub lower: f64,
    /// Upper end of the piece \[m\].
    pub upper: f64,
    /// The segment that covers the whole piece, if there is one; otherwise a segment somewhere on it.
    segment: Segment,
    is_whole: bool,
    /// The start of unloading and the ends of its path, if the path is not a segment.
    unloading: Option<(Peak, Segment)>,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Elastic,
    Loading,
    Unloading,
    /// One segment of a chain, which also has a force at its lower end.
    Part,
}

impl<L, U> Clone for Piece<'_, L, U> {
    fn clone(&self) -> Self {
        let Piece { model, kind, lower, upper, segment, is_whole, unloading } = *self;
        Piece { model, kind, lower, upper, segment, is_whole, unloading }
    }
}

impl<'a, L: Loading, U: Unloading> Piece<'a, L, U> {
    /// The piece on which a contact continues if it is `rising` or falling; `Err` with the indentation of the surface \[m\]
    /// that a contact has left or not yet reached.
    ///
    /// The surface is the lower end of the piece, from one evaluation. In another place, the compiler may compute a part of the
    /// same expression in advance, with the usual rounding, although the host has changed it. A motion down to the lower end
    /// would then not get below the surface.
    pub fn ahead(history: &History, model: &'a Model<L, U>, rising: bool) -> Result<Piece<'a, L, U>, f64> {
        let indentation = history.indentation();
        let piece = Piece::at(model, indentation, history.max_indentation(), rising);
        let touches = indentation > piece.lower || (rising && indentation == piece.lower);
        if touches { Ok(piece) } else { Err(piece.lower) }
    }

    /// The piece of a contact at `indentation` that was never deeper than `largest` \[m\], if it is `rising` or falling.
    pub fn at(model: &'a Model<L, U>, indentation: f64, largest: f64, rising: bool) -> Piece<'a, L, U> {
        let upper = model.loading.yield_point(&model.pair).indentation;
        if largest <= upper && !(rising && indentation >= upper) {
            let within = if indentation > 0.0 { indentation } else { 0.0 };
            let (kind, segment) = (Kind::Elastic, model.elastic_segment(within));
            let is_whole = model.has_elastic_segment()
                || model.has_chain() && segment.lower <= 0.0 && segment.upper >= smallest(upper, LARGEST_INDENTATION);
            return Piece { model, kind, lower: 0.0, upper, segment, is_whole, unloading: None };
        }
        if rising && indentation >= largest {
            let upper = model.loading.next_corner(&model.pair, indentation);
            let segment = model.loading.segment(&model.pair, indentation);
            let is_whole = model.loading.is_segmented() || segment.upper >= upper;
            return Piece { model, kind: Kind::Loading, lower: indentation, upper, segment, is_whole, unloading: None };
        }
        Piece::below(model, largest)
    }

    /// The part of the piece on which one segment of a chain holds, from `indentation` \[m\] on if it is `rising` or falling. The whole
    /// piece, if it is none of a chain.
    pub(crate) fn part(self, indentation: f64, rising: bool) -> Piece<'a, L, U> {
        // a tangent holds at one point
        let is_tangent = self.segment.upper <= next_above(self.segment.lower);
        if !self.model.has_chain() || self.is_whole() || self.kind == Kind::Loading || is_tangent {
            return self;
        }
        let segment = self.segment_at(largest(if rising { indentation } else { indentation.next_down() }, self.lower));
        let (lower, upper) = (largest(segment.lower, self.lower), smallest(segment.upper, self.upper));
        Piece { kind: Kind::Part, lower, upper, segment, is_whole: true, unloading: None, ..self }
    }

    /// The piece of an unloading `path` that is one segment.
    pub fn on_path(model: &'a Model<L, U>, path: Segment) -> Piece<'a, L, U> {
        let Segment { lower, upper, .. } = path;
        Piece { model, kind: Kind::Unloading, lower, upper, segment: path, is_whole: true, unloading: None }
    }

    /// The piece of `model` that has these `numbers`.
    pub(crate) fn of_numbers(model: &'a Model<L, U>, numbers: &Numbers) -> Piece<'a, L, U> {
        let Numbers { kind, lower, upper, segment, is_whole, unloading } = *numbers;
        Piece { model, kind, lower, upper, segment, is_whole, unloading }
    }

    /// The piece without its model.
    pub(crate) fn numbers(&self) -> Numbers {
        let Piece { kind, lower, upper, segment, is_whole, unloading, .. } = *self;
        Numbers { kind, lower, upper, segment, is_whole: is_whole || self.is_whole(), unloading }
    }

    /// The unloading piece from `largest` \[m\], beyond yield.
    fn below(model: &'a Model<L, U>, largest: f64) -> Piece<'a, L, U> {
        let peak = model.peak(largest);
        let path = model.path_from(&peak);
        let middle = 0.5 * (path.lower + largest);
        let is_segmented = model.unloading.is_segmented();
        let segment = if is_segmented { path } else { model.unloading.tangent(&model.pair, &peak, &path, middle) };
        // a path that is not a segment has a different tangent at every point, or segments of a chain
        let is_whole = is_segmented || segment.upper >= largest && segment.lower <= path.lower;
        let unloading = (!is_whole).then_some((peak, path));
        Piece { model, kind: Kind::Unloading, lower: path.lower, upper: largest, segment, is_whole, unloading }
    }

    /// The segment that holds at `indentation` \[m\]. A law without segments is evaluated at every point.
    fn segment_at(&self, indentation: f64) -> Segment {
        let pair = &self.model.pair;
        match self.unloading {
            _ if self.is_whole() => self.segment,
            Some((peak, path)) => self.model.unloading.tangent(pair, &peak, &path, indentation),
            None => self.model.loading.segment(pair, indentation),
        }
    }

    /// Whether there is a force at `indentation` \[m\]: above the surface, and anywhere on the loading curve.
    fn presses_at(&self, indentation: f64) -> bool {
        indentation > self.lower || self.kind == Kind::Loading || self.model.has_chain() && self.kind == Kind::Part
    }

    /// Force \[N\]; zero below the surface.
    pub fn force(&self, indentation: f64) -> f64 {
        if self.presses_at(indentation) { self.segment_at(indentation).force(indentation) } else { 0.0 }
    }

    /// Whether one segment covers the whole piece. For laws made of segments the compiler knows this, and omits the code that
    /// other laws need.
    fn is_whole(&self) -> bool {
        self.model.is_segmented() || self.is_whole
    }

    /// The segment that covers the whole piece, if there is one.
    pub fn whole(&self) -> Option<&Segment> {
        self.is_whole().then_some(&self.segment)
    }

    /// Stiffness dF/d(indentation) \[N/m\].
    pub fn stiffness(&self, indentation: f64) -> f64 {
        if self.presses_at(indentation) { self.segment_at(indentation).stiffness(indentation) } else { 0.0 }
    }

    /// The tangent at `indentation` \[m\], with `z` counted from the origin of the piece.
    pub fn tangent(&self, indentation: f64) -> Segment {
        Segment { origin: self.origin(), linear: self.stiffness(indentation), ..Segment::NOTHING }
    }

    /// The indentation from which the force may grow as a fractional power \[m\]. It is never above the piece.
    pub fn origin(&self) -> f64 {
        match self.kind {
            _ if self.is_whole() => self.segment.origin,
            Kind::Unloading => self.lower,
            _ => 0.0,
        }
    }
}
