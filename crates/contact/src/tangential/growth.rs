//! The springs of a growing dent.
//!
//! Springs keep their distance from the centre of the contact and their offsets. Their limits change: the limit of a
//! spring is its compression on the unloading path of the current dent. The distance `x = F'(h)/(2 E*)` identifies a
//! spring on a new path. New contact area is free of stress.
//!
//! A model of parallel springs is passive for any change of the limits. Coulomb's bound holds if the limits add up to
//! the normal force. The accuracy of a growth step depends on the paths. It is exact to rounding for Hertz's curve
//! with `x^2` linear in the largest indentation (`thornton`). Elsewhere a straight line over the old heights is curved over the new
//! ones, and is divided. There is no measured reference for friction on a contact that has yielded.

use super::cut::{Cut, Point};
use super::list::Apex;
use super::merge::Merging;
use super::play_operator::pull;
use super::vector::{add, difference, length};
use super::{Motion, PlayOperator, TINY, Vertex};
use crate::numerics::{largest, quotient, root};
use crate::segment::Segment;
use libm::fabs;

/// A segment whose image on a new path is bent is divided if the tangential force would else be off by more than this part of
/// Coulomb's limit, times the relative growth: the error of a large growth is then the same in however many steps.
const BEND: f64 = 4e-4;

/// The most parts of a segment.
const MOST_PARTS: u32 = 8;

/// Whether `path` is Hertz's curve from its origin. The images of such paths are proportional to each other.
fn is_hertzian(path: &Segment) -> bool {
    path.square == 0.0 && path.linear == 0.0
}

/// The part of a step's way that does not pull a core as stiff as the straight path `new`: area that a dent gains evenly over
/// the step is pulled over half of the way. A path that was curved jumps, without a way.
fn part_of_gain(old: &Segment, new: &Segment) -> f64 {
    let gain = largest(new.linear - old.linear, 0.0);
    let is_gradual = old.power == 0.0 && old.square == 0.0;
    quotient(0.5 * gain, new.linear, is_gradual && new.linear > 0.0, 0.0)
}

/// Height \[m\] on `path` where its stiffness is `stiffness` \[N/m\], but not below the surface.
fn height_with(path: &Segment, stiffness: f64) -> f64 {
    let excess = stiffness - path.linear;
    // root of 2 c3 q^2 + 1.5 c2 q = excess, q = sqrt(z), in a form without cancellation
    let half = 1.5 * path.power;
    let divisor = half + root(half * half + 8.0 * path.square * excess);
    let q = quotient(2.0 * excess, divisor, excess > 0.0 && divisor > 0.0, 0.0);
    largest(path.origin + q * q, path.lower)
}

impl<const D: usize, const N: usize> PlayOperator<D, N> {
    /// Moves the contact on its `way` along the loading curve, while its dent grows: from the end of the `old` path
    /// to the end of the `new` one.
    ///
    /// Springs keep their places and offsets. Their limits change evenly over the way to those of the new path.
    pub fn grow(&mut self, old: &Segment, new: &Segment, way: &Motion<D>) {
        let mut cut = self.grown(old, new, way);
        self.take(&mut cut, new);
    }

    /// Tangential force after such a way that is yet to come, divided by the coefficient of friction \[N\].
    pub(super) fn pull_after(mut self, old: &Segment, new: &Segment, way: &Motion<D>) -> [f64; D] {
        let cut = self.grown(old, new, way);
        pull(cut.left.vertices(), new.force(way.to))
    }

    /// The segments after such a way; the displacement is already that at its end.
    fn grown<'a>(&mut self, old: &Segment, new: &'a Segment, way: &'a Motion<D>) -> Cut<'a, D, N> {
        if self.list.vertices().is_empty() {
            *self = PlayOperator::pressed(old, way.to);
        }
        let before = self.displaced();
        let pull = self.pull(old, way.from);
        self.displace(way.shift);
        let apex = Apex { indentation: way.to, displacement: self.displaced() };
        let mut cut = Cut::new(new, way, before, apex);
        // on Hertz's curve, merged segments keep the energy well enough wherever they meet
        cut.merging = if is_hertzian(new) { Merging::OfGrowth } else { Merging::OfEnergy };
        if new.power == 0.0 && new.square == 0.0 {
            // a straight path: all springs touch at once, and act as one with the mean tension
            let stiffness = largest(old.stiffness(way.from), new.linear);
            let length_of = |force: f64| quotient(force, stiffness, stiffness > 0.0, 0.0);
            let tension = add(pull.map(length_of), -part_of_gain(old, new), way.shift);
            let from = (new.lower, difference(before, tension));
            let from = cut.point(from, length_of(old.force(way.from)));
            let to = cut.point((way.to, apex.displacement), 0.0);
            cut.between(slope(&from, &to), &from, &to);
            return cut;
        }
        let growth = way.rise() / way.to;
        let allowed = if growth > TINY { BEND * growth * new.force(way.to) } else { f64::MAX / 64.0 };
        let edge = self.map(&mut cut, old, new, (way.from, before), allowed);
        let rise = way.to - edge;
        if rise > 0.0 && length(way.shift) > rise {
            cut.touching(edge);
        } else if rise > 0.0 {
            touch(&mut cut, new, (edge, before), way, allowed);
        }
        cut
    }

    /// Adds the segments up to `top` to `cut`, with their heights on the `new` path. The force may be `allowed` off \[N\] for each
    /// segment. Returns the height of the old edge.
    fn map(&self, cut: &mut Cut<D, N>, old: &Segment, new: &Segment, top: (f64, [f64; D]), allowed: f64) -> f64 {
        let image = |height: f64| height_with(new, old.stiffness(height));
        let is_bent = !(is_hertzian(old) && is_hertzian(new));
        let mut edge = new.lower;
        let mut known = None;
        for (vertex, end) in self.segments_up_to(top) {
            let at =
                |cut: &Cut<D, N>, height: f64, offset: [f64; D]| cut.point((image(height), offset), top.0 - height);
            // a segment begins where the one below ends
            let mut from = known.unwrap_or_else(|| at(cut, vertex.height, vertex.offset));
            edge = image(end.0);
            let parts = match is_bent && cut.left.has_room() {
                true => {
                    let middle = image(0.5 * (vertex.height + end.0));
                    parts_of(new, [from.height, middle, edge], difference(end.1, vertex.offset), allowed)
                }
                false => 1,
            };
            for part in 1..parts {
                let height = vertex.height + (end.0 - vertex.height) * (f64::from(part) / f64::from(parts));
                let to = at(cut, height, vertex.offset_at(height));
                cut.between(slope(&from, &to), &from, &to);
                from = to;
            }
            let to = at(cut, end.0, end.1);
            cut.between(slope(&from, &to), &from, &to);
            known = Some(to);
        }
        edge
    }
}

/// Into how many parts a segment is divided whose ends and middle have these heights on `path`, and whose ends differ by the offset
/// `chord` \[m\], if the force may be off by `allowed` \[N\].
fn parts_of<const D: usize>(path: &Segment, [low, middle, high]: [f64; 3], chord: [f64; D], allowed: f64) -> u32 {
    let rise = high - low;
    let bend = fabs(0.5 - quotient(middle - low, rise, rise > 0.0, 0.5)) * length(chord);
    let off = bend * (path.stiffness(high) - path.stiffness(low));
    // the error falls with the square of the number
    (1..MOST_PARTS).find(|&parts| off <= f64::from(parts * parts) * allowed).unwrap_or(MOST_PARTS)
}

/// Adds the springs that touch on the way, from the `edge` on.
///
/// They touch evenly over the square of the stiffness, which is proportional to the area: for Hertz's curve, evenly over the height.
fn touch<const D: usize, const N: usize>(
    cut: &mut Cut<D, N>,
    new: &Segment,
    edge: (f64, [f64; D]),
    way: &Motion<D>,
    allowed: f64,
) {
    let [low, high] = [edge.0, way.to].map(|height| new.stiffness(height) * new.stiffness(height));
    let at = |share: f64| height_with(new, root(low + share * (high - low)));
    let parts = match !is_hertzian(new) && cut.left.has_room() {
        true => parts_of(new, [edge.0, at(0.5), way.to], way.shift, allowed),
        false => 1,
    };
    if parts == 1 {
        let rise = way.to - edge.0;
        let slope = way.shift.map(|shift| quotient(shift, rise, rise > 0.0, 0.0));
        cut.sticks = true;
        return cut.left.extend(Vertex::new(new, edge.0, edge.1, slope));
    }
    let mut from = cut.point(edge, 0.0);
    for part in 1..=parts {
        let share = f64::from(part) / f64::from(parts);
        let height = if part < parts { at(share) } else { way.to };
        let to = cut.point((height, add(edge.1, share, way.shift)), 0.0);
        cut.between(slope(&from, &to), &from, &to);
        from = to;
    }
}

/// Slope of the straight line between two points.
fn slope<const D: usize>(from: &Point<D>, to: &Point<D>) -> [f64; D] {
    let rise = to.height - from.height;
    difference(to.before, from.before).map(|shift| quotient(shift, rise, rise > 0.0, 0.0))
}
