//! The tangential state of a contact, and its step along one elastic curve: partial slip within Coulomb's bound.

use super::cut::Cut;
use super::list::{Apex, List};
use super::vector::{add, difference, length, times};
use super::{Motion, SAME, Sliding, TINY, Vertex};
use crate::history::path::Sum;
use crate::numerics::{largest, next_above, quotient, smallest};
use crate::segment::Segment;

/// The height of a triangle over that of a parabola of the same area.
const FOUR_THIRDS: f64 = 4.0 / 3.0;

/// Lowest height of springs that slip if none do \[m\].
const NONE: f64 = f64::MAX;

/// The springs of a contact in `D` tangential directions: the displacement, and the polyline of their stuck offsets, of at most
/// `N` segments (sixteen are recommended, eight or more are allowed).
///
/// The methods take the elastic normal force over the indentation as `curve`, from the surface (its lower end): Hertz's law, or
/// the unloading path of a dent. It has to be the same in all calls until the contact separates or its dent grows. Its stiffness
/// must not fall with the indentation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlayOperator<const D: usize, const N: usize> {
    /// Scaled tangential displacement \[m\] since the first touch or since the whole contact last slipped.
    pub(super) displacement: [Sum; D],
    pub(super) list: List<D, N>,
    /// Height of the lowest springs that slipped on the last way \[m\]; not along a line, where slopes tell.
    pub(super) slips_from: f64,
}

impl<const D: usize, const N: usize> PlayOperator<D, N> {
    /// No contact.
    pub const APART: Self = PlayOperator { displacement: [Sum::new(0.0); D], list: List::EMPTY, slips_from: NONE };

    /// A contact that is pressed in without tangential displacement, at `indentation` \[m\].
    pub fn pressed(curve: &Segment, indentation: f64) -> Self {
        let mut stuck = PlayOperator::APART;
        if indentation > curve.lower {
            stuck.list.add(Vertex::new(curve, curve.lower, [0.0; D], [0.0; D]));
        }
        stuck
    }

    /// Scaled displacement \[m\].
    pub(super) fn displaced(&self) -> [f64; D] {
        self.displacement.map(Sum::total)
    }

    /// Adds this `shift` \[m\] to the displacement.
    pub(super) fn displace(&mut self, shift: [f64; D]) {
        for (sum, shift) in self.displacement.iter_mut().zip(shift) {
            *sum = sum.plus(shift);
        }
    }

    /// Moves the contact on its way along `curve`.
    pub fn advance(&mut self, curve: &Segment, way: &Motion<D>) {
        self.advance_bent(curve, way, [0.0; D]);
    }

    /// The same on a way that is slightly bent: where half of the indentation is done, the displacement is beside the straight line by
    /// `bend` \[m\].
    pub(super) fn advance_bent(&mut self, curve: &Segment, way: &Motion<D>, bend: [f64; D]) {
        if way.to <= curve.lower {
            *self = PlayOperator::APART;
            return;
        }
        if !way.moves() {
            return;
        }
        let is_new = self.list.vertices().is_empty();
        if is_new {
            *self = PlayOperator::pressed(curve, way.to);
        }
        // a contact that starts with an indentation already has springs
        let is_fresh = is_new && way.from <= curve.lower;
        let (way, bend) = if is_fresh {
            let part = way.part_above(curve.lower);
            (way.above(curve.lower), times(part * part, bend))
        } else {
            (*way, bend)
        };
        let before = self.displaced();
        self.displace(way.shift);
        if !way.sticks() {
            return match self.slips_from_edge() {
                true => self.cut_edge(curve, &way, is_fresh),
                false => self.slip(curve, &way, before, is_fresh),
            };
        }
        self.slips_from = NONE;
        let (slope, half) = (way.slope(), 0.5 * way.rise());
        // two straight lines with the same area beside the line as a parabola
        let turn = bend.map(|bend| quotient(FOUR_THIRDS * bend, half, half > 0.0, 0.0));
        let [lower, upper] = [1.0, -1.0].map(|sign| add(slope, sign, turn));
        let [lower, upper] = if length(lower) <= 1.0 && length(upper) <= 1.0 { [lower, upper] } else { [slope; 2] };
        if is_fresh {
            self.list.set_slope(lower);
        } else if way.to > way.from && self.turns(lower) {
            if self.segments() >= N && way.rise() <= TINY * way.to {
                let displacement = self.displaced();
                return self.list.stretch(&Apex { indentation: way.to, displacement });
            }
            self.list.push(curve, Vertex::new(curve, way.from, before, lower));
        }
        if way.to > way.from && self.turns(upper) {
            let middle = add(before, half, lower);
            self.list.push(curve, Vertex::new(curve, way.from + half, middle, upper));
        }
    }

    /// Whether the last segment has another slope than `slope`.
    fn turns(&self, slope: [f64; D]) -> bool {
        self.list.last().is_none_or(|last| length(difference(last.slope, slope)) > SAME)
    }

    /// Whether springs slip only from the edge inwards, however the contact moves: along a line, and no segment is steeper than
    /// the cones. They then move in [closed form](super::edge).
    #[inline(always)]
    pub(super) fn slips_from_edge(&self) -> bool {
        D == 1 && self.list.vertices().iter().all(|vertex| length(vertex.slope) <= 1.0 + SAME)
    }

    /// Whether the next step along the curve has an exact result: it merges no segments, and springs slip only from the edge.
    pub(super) fn is_exact(&self) -> bool {
        self.segments() < N && self.slips_from_edge()
    }

    /// Moves all springs that leave the cone of the current point.
    fn slip(&mut self, curve: &Segment, way: &Motion<D>, before: [f64; D], is_fresh: bool) {
        let apex = Apex { indentation: way.to, displacement: self.displaced() };
        let mut cut = Cut::new(curve, way, before, apex);
        if is_fresh {
            cut.touching(curve.lower);
        } else {
            let mut last = None;
            for (vertex, end) in self.segments_up_to((way.from, before)) {
                // unloading leaves no segment above the contact
                let height = smallest(end.0, way.to);
                let end = if height < end.0 { (height, vertex.offset_at(height)) } else { end };
                last = Some(cut.segment(vertex, last, end));
            }
            if way.to > way.from {
                cut.touching(way.from);
            }
        }
        self.take(&mut cut, curve);
    }

    /// Multiplies the limits of all springs at `indentation` \[m\] by a positive `factor`, with all lengths scaled to the new
    /// [coefficient](super::Friction::scale). Springs beyond their new limits slip.
    pub(super) fn scale_limits(&mut self, curve: &Segment, indentation: f64, factor: f64) {
        let longer = quotient(1.0, factor, factor > 0.0, 0.0);
        if longer == 1.0 || self.list.vertices().is_empty() {
            return;
        }
        self.displacement = self.displaced().map(|length| Sum::new(longer * length));
        self.list.lengthen(longer);
        self.slips_from = NONE;
        if self.list.vertices().iter().all(|vertex| length(vertex.slope) <= 1.0 + SAME) {
            return;
        }
        let apex = Apex { indentation, displacement: self.displaced() };
        let way = Motion::straight(indentation, indentation, [0.0; D]);
        let mut cut = Cut::new(curve, &way, apex.displacement, apex);
        for (vertex, end) in self.segments_up_to((indentation, apex.displacement)) {
            let at = |(height, offset)| cut.point((height, offset), longer * (indentation - height));
            let (from, to) = (at((vertex.height, vertex.offset)), at(end));
            cut.between(vertex.slope, &from, &to);
        }
        self.take(&mut cut, curve);
    }

    /// The segments with the height and offset of their ends \[m\]; the last one ends at `top`.
    pub(super) fn segments_up_to(&self, top: (f64, [f64; D])) -> impl Iterator<Item = (&Vertex<D>, (f64, [f64; D]))> {
        let vertices = self.list.vertices();
        let ends = vertices.iter().skip(1).map(|next| (next.height, next.offset));
        vertices.iter().zip(ends.chain(core::iter::once(top)))
    }

    /// Takes over the segments of `cut` on `curve`.
    pub(super) fn take(&mut self, cut: &mut Cut<D, N>, curve: &Segment) {
        let lowest = cut.left.lowest();
        self.slips_from = match cut.slips_from {
            // springs above it stick
            Some(height) if cut.sticks && height <= lowest => next_above(lowest),
            Some(height) => height,
            None => NONE,
        };
        let indentation = cut.apex.indentation;
        self.list = cut.left.list(curve, &cut.apex, cut.merging);
        if self.sliding() == Sliding::Sliding {
            // from here on only the tension of the springs matters
            self.list.rebase(indentation);
            self.displacement = [Sum::new(0.0); D];
        }
    }

    /// Tangential force at the current `indentation` \[m\], divided by the coefficient of friction \[N\]. It opposes
    /// the motion: a positive rate leads to a positive force.
    #[inline]
    pub fn pull(&self, curve: &Segment, indentation: f64) -> [f64; D] {
        match self.list.vertices() {
            [] => [0.0; D],
            vertices => pull(vertices, curve.force(indentation)),
        }
    }

    /// Stored tangential energy at `indentation` \[m\], times `kappa/mu` \[J\].
    pub fn energy(&self, curve: &Segment, indentation: f64) -> f64 {
        let displacement = self.displaced();
        let vertices = self.list.vertices();
        let ends = vertices.iter().skip(1).map(|next| (next.height, next.force));
        let ends = ends.chain(core::iter::once((indentation, curve.force(indentation))));
        let energy =
            vertices.iter().zip(ends).fold(0.0, |sum, (vertex, end)| sum + vertex.energy(curve, displacement, end));
        // relaxed springs have rounding errors of either sign
        largest(0.0, energy)
    }

    /// Height \[m\] of the lowest springs that slip.
    fn slips_from(&self) -> f64 {
        match self.list.last() {
            Some(last) if D == 1 => {
                if length(last.slope) >= 1.0 - SAME {
                    last.height
                } else {
                    NONE
                }
            }
            _ => self.slips_from,
        }
    }

    /// Slip state of the contact, from its last way.
    pub fn sliding(&self) -> Sliding {
        let slips_from = self.slips_from();
        match self.list.vertices() {
            [] => Sliding::Apart,
            [lowest, ..] if slips_from <= lowest.height => Sliding::Sliding,
            _ if slips_from < NONE => Sliding::PartialSlip,
            _ => Sliding::Stick,
        }
    }

    /// The slope of the offsets at the edge: a unit vector where springs slip there.
    pub fn edge(&self) -> [f64; D] {
        self.list.last().map_or([0.0; D], |last| last.slope)
    }

    /// Height \[m\] of the highest spring that sticks, for a contact at `indentation` \[m\].
    pub fn stick_height(&self, indentation: f64) -> f64 {
        smallest(self.slips_from(), indentation)
    }

    /// Number of segments of the polyline.
    pub fn segments(&self) -> usize {
        self.list.vertices().len()
    }
}

/// Tangential force of segments whose last one ends at the normal force `force` \[N\], divided by the coefficient of friction
/// \[N\].
#[inline]
pub(super) fn pull<const D: usize>(vertices: &[Vertex<D>], force: f64) -> [f64; D] {
    let ends = vertices.iter().skip(1).map(|next| next.force).chain(core::iter::once(force));
    vertices.iter().zip(ends).fold([0.0; D], |sum, (vertex, end)| add(sum, end - vertex.force, vertex.slope))
}
