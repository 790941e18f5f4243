//! Merges three segments of a full list into two.

use super::cone::Cone;
use super::vertex::Vertex;
use crate::numbers::quotient;
use crate::segment::Segment;
use libm::fabs;

/// Change of the tangential force if the vertex between two segments is dropped, divided by the coefficient of
/// friction \[N\].
///
/// The segments run from `first` to `second` and on to `end`: `|(r2 - r1)(dh2 dF1 - dh1 dF2)/(dh1 + dh2)|`.
fn area(first: &Vertex, second: &Vertex, end: &Vertex) -> f64 {
    let (height, force) = (second.height - first.height, second.force - first.force);
    let (next_height, next_force) = (end.height - second.height, end.force - second.force);
    let whole = height + next_height;
    let moment = (second.slope - first.slope) * (next_height * force - height * next_force);
    fabs(quotient(moment, whole, whole > 0.0, 0.0))
}

/// Start of the three segments with the smallest change, and whether the upper one of the two inner vertices matters
/// less.
struct Choice {
    first: usize,
    upper_matters_less: bool,
}

/// The three neighbouring segments of `list` whose two inner vertices matter least. The last segment of the list ends
/// at `end`.
fn choose(list: &[Vertex], end: &Vertex) -> Choice {
    let ends = list.iter().skip(2).chain(core::iter::once(end));
    let mut best = Choice { first: 0, upper_matters_less: false };
    let (mut least, mut below) = (f64::INFINITY, None);
    for (index, ((first, second), end)) in list.iter().zip(list.iter().skip(1)).zip(ends).enumerate() {
        let here = area(first, second, end);
        if let Some(below) = below
            && below + here < least
        {
            least = below + here;
            best = Choice { first: index.saturating_sub(1), upper_matters_less: here < below };
        }
        below = Some(here);
    }
    best
}

/// Removes one segment of a full `list` whose last segment ends at `end`. Returns the number of remaining segments.
///
/// Three neighbours become two that meet halfway between the inner vertices. Their slopes follow from two conditions:
/// the ends and the tangential force stay the same. On a constant curve, no slope may be steeper than that of slipping
/// springs. In a growing dent slopes can be steeper; there the new vertex has to be inside the `cone`. Otherwise the
/// inner vertex that matters less is dropped, and the force changes by its [`area`].
#[cold]
#[inline(never)]
pub(super) fn merge(list: &mut [Vertex], end: &Vertex, curve: &Segment, cone: Option<&Cone>) -> usize {
    let Choice { first, upper_matters_less } = choose(list, end);
    let next = list.get(first + 3).unwrap_or(end);
    let (next_height, next_force) = (next.height, next.force);
    let Some([low, one, two]) = list.get_mut(first..).and_then(<[Vertex]>::first_chunk_mut::<3>) else {
        // no list is that short
        return list.len().saturating_sub(1);
    };
    let steps = [(*low, *one), (*one, *two)].map(|(from, to)| (to.height - from.height, to.force - from.force));
    let [(height, force), (height_one, force_one)] = steps;
    let (height_two, force_two) = (next_height - two.height, next_force - two.force);
    let shift = low.slope * height + one.slope * height_one + two.slope * height_two;
    let pull = low.slope * force + one.slope * force_one + two.slope * force_two;

    let middle = 0.5 * (one.height + two.height);
    let middle_force = curve.force(middle);
    let (lower, lower_force) = (middle - low.height, middle_force - low.force);
    let (upper, upper_force) = (next_height - middle, next_force - middle_force);
    let determinant = lower * upper_force - lower_force * upper;
    let exists = determinant > 0.0;
    let slope = quotient(shift * upper_force - pull * upper, determinant, exists, f64::INFINITY);
    let slope_above = quotient(lower * pull - lower_force * shift, determinant, exists, f64::INFINITY);
    let offset = low.offset + slope * lower;
    let fits = match cone {
        Some(cone) => exists && cone.holds((middle, offset)),
        None => fabs(slope) <= 1.0 && fabs(slope_above) <= 1.0,
    };
    let removed = if fits {
        low.slope = slope;
        *one = Vertex { height: middle, offset, slope: slope_above, force: middle_force, below: 0.0 };
        first + 2
    } else if upper_matters_less {
        one.slope = chord((one.slope, height_one), (two.slope, height_two));
        first + 2
    } else {
        low.slope = chord((low.slope, height), (one.slope, height_one));
        first + 1
    };
    remove(list, removed);
    let left = list.len().saturating_sub(1);
    sum_up(list.get_mut(..left).unwrap_or_default());
    left
}

/// Slope of the chord over two segments with these slopes and heights.
fn chord((slope, height): (f64, f64), (other_slope, other_height): (f64, f64)) -> f64 {
    let whole = height + other_height;
    quotient(slope * height + other_slope * other_height, whole, whole > 0.0, slope)
}

/// Moves all vertices above that of this `index` down by one place.
fn remove(list: &mut [Vertex], index: usize) {
    let mut above = None;
    for vertex in list.iter_mut().skip(index).rev() {
        above = Some(core::mem::replace(vertex, above.unwrap_or(*vertex)));
    }
}

/// Sets the tangential force below each vertex.
pub fn sum_up(list: &mut [Vertex]) {
    let mut before: Option<Vertex> = None;
    for vertex in list {
        vertex.below = before.map_or(0.0, |before| before.pull_up_to(vertex.force));
        before = Some(*vertex);
    }
}
