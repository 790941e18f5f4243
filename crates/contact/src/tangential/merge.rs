//! Merges three segments of a full list into two.

use super::SAME;
use super::list::Apex;
use super::vector::{add, difference, length, times};
use super::vertex::Vertex;
use crate::numerics::{largest, quotient};
use crate::segment::Segment;
use libm::fabs;

/// How much steeper a new segment may be than the steepest of the old ones where the direction of slip turns.
const STEEPER: f64 = 2.0;

/// Relative change of the stiffness below which the curve counts as straight.
const STRAIGHT: f64 = 1e-8;

/// How often a height that keeps the energy is tried.
const MOST_TRIES: u32 = 6;

/// A vertex whose [`area`] is below this part of the force hardly matters.
const FLAT: f64 = 3e-11;

/// Part of the change of energy between two tried heights that counts as none.
const ENOUGH: f64 = 1e-6;

/// Where merged segments meet.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Merging {
    /// Halfway between the vertices that they replace. A vertex is always replaced.
    Halfway,
    /// The same, but a vertex that hardly matters is only dropped.
    OfGrowth,
    /// So that they keep the energy, if they can.
    OfEnergy,
}

/// Change of the tangential force if the vertex between two segments is dropped, divided by the coefficient of
/// friction \[N\]. The segments run from `first` to `second` and on to `end`.
fn area<const D: usize>(first: &Vertex<D>, second: &Vertex<D>, end: &Vertex<D>) -> f64 {
    let (height, force) = (second.height - first.height, second.force - first.force);
    let (next_height, next_force) = (end.height - second.height, end.force - second.force);
    let whole = height + next_height;
    let moment = next_height * force - height * next_force;
    fabs(quotient(moment, whole, whole > 0.0, 0.0)) * length(difference(second.slope, first.slope))
}

/// What of a list matters least.
struct Least {
    /// Start of the three segments whose two inner vertices matter least.
    three: usize,
    /// Whether the upper one of these matters less.
    upper_matters_less: bool,
    /// The segment below the vertex that matters least.
    below: usize,
    /// The [`area`] of this vertex \[N\].
    area: f64,
}

/// What of `list` matters least. Its last segment ends at `end`.
fn choose<const D: usize>(list: &[Vertex<D>], end: &Vertex<D>) -> Least {
    let ends = list.iter().skip(2).chain(core::iter::once(end));
    let mut found = Least { three: 0, upper_matters_less: false, below: 0, area: f64::INFINITY };
    let (mut least, mut below) = (f64::INFINITY, None);
    for (index, ((first, second), end)) in list.iter().zip(list.iter().skip(1)).zip(ends).enumerate() {
        let here = area(first, second, end);
        if let Some(below) = below
            && below + here < least
        {
            least = below + here;
            found = Least { three: index.saturating_sub(1), upper_matters_less: here < below, ..found };
        }
        if here < found.area {
            found = Least { below: index, area: here, ..found };
        }
        below = Some(here);
    }
    found
}

/// Slope of the chord over two segments with these slopes and heights.
fn chord<const D: usize>((slope, height): ([f64; D], f64), (other, other_height): ([f64; D], f64)) -> [f64; D] {
    let whole = height + other_height;
    add(slope, quotient(other_height, whole, whole > 0.0, 0.0), difference(other, slope))
}

/// Three neighbouring segments of a list that become two, up to the start `end` of the next one.
struct Three<'a, const D: usize> {
    low: Vertex<D>,
    one: Vertex<D>,
    two: Vertex<D>,
    end: (f64, f64),
    curve: &'a Segment,
    cone: Option<&'a Apex<D>>,
}

impl<const D: usize> Three<'_, D> {
    /// The segments themselves, with the heights and forces of their ends.
    fn segments(&self) -> [(&Vertex<D>, (f64, f64)); 3] {
        let Three { low, one, two, end, .. } = self;
        [(low, (one.height, one.force)), (one, (two.height, two.force)), (two, *end)]
    }

    /// The two segments that meet at the height `middle` \[m\], with the same ends and the same tangential force; `None` if they
    /// would be too steep.
    fn meeting_at(&self, middle: f64) -> Option<[Vertex<D>; 2]> {
        let Three { low, one, two, end: (end_height, end_force), curve, cone } = *self;
        let (mut shift, mut pull) = ([0.0; D], [0.0; D]);
        for (vertex, (height, force)) in self.segments() {
            shift = add(shift, height - vertex.height, vertex.slope);
            pull = add(pull, force - vertex.force, vertex.slope);
        }
        let middle_force = curve.force(middle);
        let (lower, lower_force) = (middle - low.height, middle_force - low.force);
        let (upper, upper_force) = (end_height - middle, end_force - middle_force);
        let determinant = lower * upper_force - lower_force * upper;
        // on a straight curve, where all springs have the same height, there is no second condition
        let exists = determinant > STRAIGHT * lower * upper_force;
        let solve = |vector: [f64; D]| vector.map(|part| quotient(part, determinant, exists, 0.0));
        let slope = solve(add(times(upper_force, shift), -upper, pull));
        let slope_above = solve(add(times(lower, pull), -lower_force, shift));
        let offset = add(low.offset, lower, slope);
        let steeper = largest(length(slope), length(slope_above));
        let fits = match cone {
            Some(cone) if D == 1 => cone.distance(middle, offset) >= -SAME * cone.indentation,
            _ if D == 1 => steeper <= 1.0,
            _ => {
                let steepest = [&low, &one, &two].iter().fold(1.0, |steepest, at| largest(steepest, length(at.slope)));
                steeper <= STEEPER * steepest
            }
        };
        let above = Vertex { height: middle, offset, slope: slope_above, force: middle_force };
        (exists && fits).then_some([Vertex { slope, ..low }, above])
    }

    /// Tangential energy of the three segments at this `displacement` \[m\], times `kappa/mu` \[J\].
    fn energy(&self, displacement: [f64; D]) -> f64 {
        self.segments().iter().fold(0.0, |sum, (vertex, end)| sum + vertex.energy(self.curve, displacement, *end))
    }

    /// The two segments that meet at the height `middle` \[m\], and how much more energy they store than the energy `before`, times
    /// `kappa/mu` \[J\].
    fn gain_at(&self, middle: f64, displacement: [f64; D], before: f64) -> Option<([Vertex<D>; 2], f64)> {
        let [low, above] = self.meeting_at(middle)?;
        let energy = |vertex: &Vertex<D>, end| vertex.energy(self.curve, displacement, end);
        let after = energy(&low, (above.height, above.force)) + energy(&above, self.end);
        Some(([low, above], after - before))
    }

    /// The two segments that store the same energy at this `displacement` \[m\], or else the ones that meet halfway.
    fn with_the_same_energy(&self, displacement: [f64; D]) -> Option<[Vertex<D>; 2]> {
        let Three { low, one, two, end, .. } = self;
        let half = |from: f64, to: f64| 0.5 * (from + to);
        let before = self.energy(displacement);
        let gain_at = |height: f64| self.gain_at(height, displacement, before);
        let halfway = gain_at(half(one.height, two.height));
        let mut best = halfway;
        let places = [one.height, two.height, half(low.height, one.height), half(two.height, end.0)];
        for place in places {
            let Some((from, gain)) = best else {
                best = gain_at(place);
                continue;
            };
            let Some((to, other)) = gain_at(place) else { continue };
            if gain * other > 0.0 {
                continue;
            }
            // between the two heights, by the rule of false position with halved ends
            let [mut low, mut high] = [(from[1].height, gain), (to[1].height, other)];
            for _ in 0..MOST_TRIES {
                let share = quotient(low.1, low.1 - high.1, low.1 != high.1, 0.5);
                let height = low.0 + share * (high.0 - low.0);
                let Some((found, gain)) = gain_at(height) else { break };
                best = Some((found, gain));
                if fabs(gain) <= ENOUGH * (fabs(low.1) + fabs(high.1)) {
                    break;
                }
                if gain * low.1 > 0.0 {
                    (low, high.1) = ((height, gain), 0.5 * high.1);
                } else {
                    (high, low.1) = ((height, gain), 0.5 * low.1);
                }
            }
            break;
        }
        best.map(|(segments, _)| segments)
    }
}

/// Removes one segment of a full `list` whose last segment ends at `end`. Returns the number of remaining segments.
///
/// Three neighbours become two that meet where [`Merging`] says. Their slopes follow from two conditions
/// in each direction: the ends and the tangential force stay the same. Along a line, no slope may be steeper than that of
/// slipping springs; after a cut of all segments the new vertex has to be inside the `cone` instead. In two directions, where
/// the straight lines between slipping springs are inside their limit, the new vertex is slightly beyond it; the next slip brings
/// it back. The new slopes must not be much steeper than the old ones. Otherwise the inner vertex that matters less is dropped,
/// and the force changes by its [`area`].
#[cold]
#[inline(never)]
pub(super) fn merge<const D: usize>(
    list: &mut [Vertex<D>],
    end: &Vertex<D>,
    curve: &Segment,
    cone: Option<&Apex<D>>,
    merging: Merging,
) -> usize {
    let Least { three: first, upper_matters_less, below, area } = choose(list, end);
    if merging != Merging::Halfway && area <= FLAT * end.force {
        return without_bend(list, end, below);
    }
    let next = list.get(first + 3).unwrap_or(end);
    let next = (next.height, next.force);
    let Some([low, one, two]) = list.get_mut(first..).and_then(<[Vertex<D>]>::first_chunk_mut::<3>) else {
        // no list is that short
        return list.len().saturating_sub(1);
    };
    let three = Three { low: *low, one: *one, two: *two, end: next, curve, cone };
    let merged = match cone {
        Some(cone) if merging == Merging::OfEnergy => three.with_the_same_energy(cone.displacement),
        _ => three.meeting_at(0.5 * (one.height + two.height)),
    };
    let height_one = two.height - one.height;
    let removed = if let Some(merged) = merged {
        [*low, *one] = merged;
        first + 2
    } else if upper_matters_less {
        one.slope = chord((one.slope, height_one), (two.slope, next.0 - two.height));
        first + 2
    } else {
        low.slope = chord((low.slope, one.height - low.height), (one.slope, height_one));
        first + 1
    };
    remove(list, removed)
}

/// Drops the vertex above the segment `below`, which hardly bends the polyline. Returns the number of remaining segments.
fn without_bend<const D: usize>(list: &mut [Vertex<D>], end: &Vertex<D>, below: usize) -> usize {
    let next = list.get(below + 2).unwrap_or(end).height;
    if let Some([low, one]) = list.get_mut(below..).and_then(<[Vertex<D>]>::first_chunk_mut::<2>) {
        low.slope = chord((low.slope, one.height - low.height), (one.slope, next - one.height));
    }
    remove(list, below + 1)
}

/// Removes one segment. Returns the number of the others.
fn remove<const D: usize>(list: &mut [Vertex<D>], removed: usize) -> usize {
    let mut above = None;
    for vertex in list.iter_mut().skip(removed).rev() {
        above = Some(core::mem::replace(vertex, above.unwrap_or(*vertex)));
    }
    list.len().saturating_sub(1)
}
