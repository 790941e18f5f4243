//! The smooth pieces of the law along which a contact moves.

use super::Model;
use super::history::History;
use super::loading::Loading;
use super::segment::Segment;
use super::unloading::Unloading;

/// A smooth piece of the law.
pub struct Piece<'a, L, U> {
    model: &'a Model<L, U>,
    kind: Kind,
    /// Lower end of the piece \[m\].
    pub lower: f64,
    /// Upper end of the piece \[m\].
    pub upper: f64,
    /// The largest indentation \[m\], where unloading began.
    largest: f64,
    /// The whole piece, if it is one segment.
    segment: Segment,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Elastic,
    Loading,
    Unloading,
}

impl<'a, L: Loading, U: Unloading> Piece<'a, L, U> {
    /// The piece on which a contact goes on that is `rising`, or else falling.
    pub fn of(history: &History, model: &'a Model<L, U>, rising: bool) -> Piece<'a, L, U> {
        let indentation = history.indentation();
        let largest = history.max_indentation();
        let yields_at = model.loading.yield_point(&model.pair).indentation;
        if largest <= yields_at && !(rising && indentation >= yields_at) {
            let segment = model.loading.segment(&model.pair, 0.0);
            Piece { model, kind: Kind::Elastic, lower: 0.0, upper: segment.upper, largest, segment }
        } else if rising && indentation >= largest {
            let upper = model.loading.next_corner(&model.pair, indentation);
            let segment = model.loading.segment(&model.pair, indentation);
            Piece { model, kind: Kind::Loading, lower: indentation, upper, largest, segment }
        } else {
            let path = model.unloading_path(largest);
            Piece { model, kind: Kind::Unloading, lower: path.lower, upper: largest, largest, segment: path }
        }
    }

    /// The segment to take at `indentation` \[m\]. A law without segments is asked at every point.
    fn at(&self, indentation: f64) -> Segment {
        let pair = &self.model.pair;
        match self.kind {
            Kind::Loading if self.segment.upper < self.upper => self.model.loading.segment(pair, indentation),
            Kind::Unloading if !U::SEGMENTED => self.model.unloading_segment(self.largest, indentation),
            _ => self.segment,
        }
    }

    /// \[N\]; zero below the surface.
    pub fn force(&self, indentation: f64) -> f64 {
        if indentation > self.lower || self.kind == Kind::Loading {
            self.at(indentation).force(indentation)
        } else {
            0.0
        }
    }

    /// The segment that the whole piece is, if it is one.
    pub fn whole(&self) -> Option<&Segment> {
        let pieces = match self.kind {
            Kind::Elastic => false,
            Kind::Loading => self.segment.upper < self.upper,
            Kind::Unloading => !U::SEGMENTED,
        };
        (!pieces).then_some(&self.segment)
    }

    /// \[N/m\]
    pub fn stiffness(&self, indentation: f64) -> f64 {
        if indentation > self.lower { self.at(indentation).stiffness(indentation) } else { 0.0 }
    }
}
