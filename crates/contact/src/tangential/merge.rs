//! Merges three segments of a full list into two.

use super::SAME;
use super::list::Apex;
use super::vector::{add, difference, length, times};
use super::vertex::Vertex;
use crate::numbers::{largest, quotient};
use crate::segment::Segment;
use libm::fabs;

/// How much steeper a new segment may be than the steepest of the old ones where the direction of slip turns.
const STEEPER: f64 = 2.0;

/// Relative change of the stiffness below which the curve counts as straight.
const STRAIGHT: f64 = 1e-8;

/// Change of the tangential force if the vertex between two segments is dropped, divided by the coefficient of
/// friction \[N\]. The segments run from `first` to `second` and on to `end`.
fn area<const D: usize>(first: &Vertex<D>, second: &Vertex<D>, end: &Vertex<D>) -> f64 {
    let (height, force) = (second.height - first.height, second.force - first.force);
    let (next_height, next_force) = (end.height - second.height, end.force - second.force);
    let whole = height + next_height;
    let moment = next_height * force - height * next_force;
    fabs(quotient(moment, whole, whole > 0.0, 0.0)) * length(difference(second.slope, first.slope))
}

/// Start of the three segments of `list` whose two inner vertices matter least, and whether the upper one of these
/// matters less. The last segment of the list ends at `end`.
fn choose<const D: usize>(list: &[Vertex<D>], end: &Vertex<D>) -> (usize, bool) {
    let ends = list.iter().skip(2).chain(core::iter::once(end));
    let (mut best, mut least, mut below) = ((0, false), f64::INFINITY, None);
    for (index, ((first, second), end)) in list.iter().zip(list.iter().skip(1)).zip(ends).enumerate() {
        let here = area(first, second, end);
        if let Some(below) = below
            && below + here < least
        {
            least = below + here;
            best = (index.saturating_sub(1), here < below);
        }
        below = Some(here);
    }
    best
}

/// Slope of the chord over two segments with these slopes and heights.
fn chord<const D: usize>((slope, height): ([f64; D], f64), (other, other_height): ([f64; D], f64)) -> [f64; D] {
    let whole = height + other_height;
    add(slope, quotient(other_height, whole, whole > 0.0, 0.0), difference(other, slope))
}

/// Removes one segment of a full `list` whose last segment ends at `end`. Returns the number of remaining segments.
///
/// Three neighbours become two that meet halfway between the inner vertices. Their slopes follow from two conditions
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
) -> usize {
    let (first, upper_matters_less) = choose(list, end);
    let next = list.get(first + 3).unwrap_or(end);
    let (next_height, next_force) = (next.height, next.force);
    let left = list.len().saturating_sub(1);
    let Some([low, one, two]) = list.get_mut(first..).and_then(<[Vertex<D>]>::first_chunk_mut::<3>) else {
        // no list is that short
        return left;
    };
    let [(height, force), (height_one, force_one)] =
        [(*low, *one), (*one, *two)].map(|(from, to)| (to.height - from.height, to.force - from.force));
    let (height_two, force_two) = (next_height - two.height, next_force - two.force);
    let sum = |a: f64, b: f64, c: f64| add(add(times(a, low.slope), b, one.slope), c, two.slope);
    let (shift, pull) = (sum(height, height_one, height_two), sum(force, force_one, force_two));

    let middle = 0.5 * (one.height + two.height);
    let middle_force = curve.force(middle);
    let (lower, lower_force) = (middle - low.height, middle_force - low.force);
    let (upper, upper_force) = (next_height - middle, next_force - middle_force);
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
            let steepest = [&*low, one, two].iter().fold(1.0, |steepest, at| largest(steepest, length(at.slope)));
            steeper <= STEEPER * steepest
        }
    };
    let removed = if exists && fits {
        low.slope = slope;
        *one = Vertex { height: middle, offset, slope: slope_above, force: middle_force };
        first + 2
    } else if upper_matters_less {
        one.slope = chord((one.slope, height_one), (two.slope, height_two));
        first + 2
    } else {
        low.slope = chord((low.slope, height), (one.slope, height_one));
        first + 1
    };
    let mut above = None;
    for vertex in list.iter_mut().skip(removed).rev() {
        above = Some(core::mem::replace(vertex, above.unwrap_or(*vertex)));
    }
    left
}
