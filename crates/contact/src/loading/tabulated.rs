//! A loading curve of one's own, given by numbers.

use super::{Loading, MOST_SEGMENTS, RecoveryOf};
use crate::material::{Pair, YieldPoint};
use crate::numerics::{largest, quotient, smallest};
use crate::regime::Regime;
use crate::segment::Segment;
use crate::unloading::Recovery;
use crate::validity::largest_radius;
use libm::sqrt;

/// The largest number of knots.
pub const MOST: usize = 32;

/// A curve through knots with value and slope at each, as a chain of [segments](Segment):
///
/// | regime | where | `F` |
/// |---|---|---|
/// | elastic | up to the first knot | `F_1 (d/d_1)^1.5` |
/// | plastic | between two knots | `c0 + c1 d + c2 d^1.5 + c3 d^2` |
/// | beyond the last knot | | a straight line |
///
/// The elastic recovery is `d_e = c 3 F/(4 E* a)`; `a^2` and the factor `c` are straight lines over the depth between the knots. A contact that
/// is passive has `d(d_e)/dd <= 1` and `d_e <= 1.5 F/F'` everywhere: its dent then only deepens, and its unloading is not softer than its
/// loading. The law keeps to the second; the first is up to who gives the knots. Lengths are in units of the effective radius, forces of
/// `E* R^2`: geometrically similar contacts of the same bodies have the same numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Tabulated {
    #[cfg_attr(feature = "serde", serde(skip, default = "reference"))]
    pub(crate) curve: TableCurve,
}

#[cfg(feature = "serde")]
fn reference() -> TableCurve {
    Tabulated::REFERENCE.curve
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TableCurve {
    /// At least one.
    count: usize,
    knots: [TableKnot; MOST],
    /// Work up to each knot `[E* R^3]`.
    work: [f64; MOST],
    /// `g` of the [unloading](crate::unloading::Tabulated) is this number times `1 - d_e/d`.
    shape: f64,
}

/// A point of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableKnot {
    /// Indentation `[R]`.
    pub depth: f64,
    /// Force `[E* R^2]`.
    pub force: f64,
    /// Stiffness `[E* R]`.
    pub stiffness: f64,
    /// `c`, the elastic recovery of an unloading from here over `3 F/(4 E* a)` \[-\].
    pub factor: f64,
    /// `a^2`, with the contact radius `a` `[R^2]`.
    pub square: f64,
}

impl TableKnot {
    const NONE: TableKnot = TableKnot { depth: 0.0, force: 0.0, stiffness: 0.0, factor: 0.0, square: 0.0 };

    /// Indentation, force and stiffness on the bodies of `pair` \[m, N, N/m\].
    fn on(&self, pair: &Pair) -> [f64; 3] {
        let stiffness = pair.modulus * pair.radius;
        [self.depth * pair.radius, self.force * (stiffness * pair.radius), self.stiffness * stiffness]
    }
}

/// The numbers of a knot, in a list of them.
const NUMBERS: usize = 5;

/// A law of no bodies in particular, for tests: Hertz's up to a depth of `1e-4 R`.
const EXAMPLE: [[f64; NUMBERS]; 4] = [
    [1e-4, 4e-6 / 3.0, 2e-2, 1.0, 1e-4],
    [4e-4, 8.4e-6, 2.7e-2, 1.0, 5.25e-4],
    [1.6e-3, 4.6e-5, 3.5e-2, 1.0, 2.514e-3],
    [1e-2, 3.5e-4, 3.7e-2, 1.0, 1.8047e-2],
];

impl Tabulated {
    /// An example. A scene has a curve of its own.
    pub const REFERENCE: Tabulated = {
        let mut knots = [TableKnot::NONE; MOST];
        let mut place = 0;
        while place < EXAMPLE.len() {
            let [depth, force, stiffness, factor, square] = EXAMPLE[place];
            knots[place] = TableKnot { depth, force, stiffness, factor, square };
            place += 1;
        }
        // the sums of the works of the segments; a test computes them
        let mut work = [0.0; MOST];
        [work[0], work[1], work[2], work[3]] = EXAMPLE_WORK;
        Tabulated { curve: TableCurve { count: EXAMPLE.len(), knots, work, shape: 0.0 } }
    };

    /// The law through these knots, of which the first [`MOST`] count, with the `shape` of its unloading.
    pub fn new(knots: impl Iterator<Item = TableKnot>, shape: f64) -> Tabulated {
        let mut curve = TableCurve { count: 0, knots: [TableKnot::NONE; MOST], work: [0.0; MOST], shape };
        let mut before: Option<(TableKnot, f64)> = None;
        for ((slot, work), knot) in curve.knots.iter_mut().zip(&mut curve.work).zip(knots) {
            *slot = knot;
            let numbers = |knot: &TableKnot| [knot.depth, knot.force, knot.stiffness];
            *work = match &before {
                Some((before, sum)) => sum + Segment::between(numbers(before), numbers(&knot)).work(knot.depth),
                None => 0.4 * knot.force * knot.depth,
            };
            before = Some((knot, *work));
            curve.count += 1;
        }
        Tabulated { curve }
    }

    /// Its knots.
    pub fn knots(&self) -> &[TableKnot] {
        self.curve.knots.get(..self.curve.count).unwrap_or_default()
    }

    /// The shape of the unloading, and the numbers of all knots: what [`Loading::through`] takes.
    pub fn list(&self) -> impl Iterator<Item = f64> {
        let of = |knot: &TableKnot| [knot.depth, knot.force, knot.stiffness, knot.factor, knot.square];
        core::iter::once(self.curve.shape).chain(self.knots().iter().flat_map(of))
    }

    /// The last knot at or below `indentation` \[m\] with its place, and the next one; `None` in the elastic part.
    fn around(&self, pair: &Pair, indentation: f64) -> Option<(usize, &TableKnot, Option<&TableKnot>)> {
        let knots = self.knots();
        let place = knots.partition_point(|knot| knot.depth * pair.radius <= indentation).checked_sub(1)?;
        Some((place, knots.get(place)?, knots.get(place + 1)))
    }

    fn first(&self) -> &TableKnot {
        let [first, ..] = &self.curve.knots;
        first
    }

    /// Hertz's exponent through the first knot.
    fn elastic(&self, pair: &Pair) -> Segment {
        let [upper, force, _] = self.first().on(pair);
        Segment { upper, power: force / (upper * sqrt(upper)), ..Segment::NOTHING }
    }

    /// `a^2` \[m^2\] and `c` at `indentation` \[m\]. Beyond the last knot `a^2` grows as on average up to there, and `c` stays.
    fn lines(&self, pair: &Pair, indentation: f64) -> (f64, f64) {
        let depth = indentation / pair.radius;
        let (square, factor) = match self.around(pair, indentation) {
            None => (self.first().square * (depth / self.first().depth), self.first().factor),
            Some((_, from, Some(to))) => {
                let part = (depth - from.depth) / (to.depth - from.depth);
                (from.square + part * (to.square - from.square), from.factor + part * (to.factor - from.factor))
            }
            Some((_, last, None)) => (last.square * (depth / last.depth), last.factor),
        };
        (pair.radius * pair.radius * square, factor)
    }

    /// The elastic recovery \[m\] from `indentation` \[m\], where the contact has this radius \[m\].
    fn recovery(&self, pair: &Pair, indentation: f64, radius: f64, factor: f64) -> f64 {
        let segment = self.segment(pair, indentation);
        let (force, stiffness) = (segment.force(indentation), segment.stiffness(indentation));
        let recovery = smallest(factor * (0.75 * force / (pair.modulus * radius)), indentation);
        let shape = self.shape(recovery, indentation);
        // not softer than the loading
        smallest(recovery, (1.5 - 0.5 * shape) * quotient(force, stiffness, stiffness > 0.0, f64::INFINITY))
    }

    fn shape(&self, recovery: f64, indentation: f64) -> f64 {
        self.curve.shape * (1.0 - recovery / indentation)
    }
}

/// Work of [`EXAMPLE`] up to each knot.
const EXAMPLE_WORK: [f64; 4] = [5.333_333_333_333_334e-11, 1.461e-9, 3.3157e-8, 1.685_173e-6];

impl Loading for Tabulated {
    fn has_squares() -> bool {
        true
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        let [indentation, force, _] = self.first().on(pair);
        YieldPoint { indentation, force }
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        match self.around(pair, indentation) {
            None => self.elastic(pair),
            Some((_, begin, Some(end))) => Segment::between(begin.on(pair), end.on(pair)),
            Some((_, last, None)) => Segment::beyond(last.on(pair)),
        }
    }

    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        let Some((place, ..)) = self.around(pair, indentation) else { return self.elastic(pair).work(indentation) };
        let unit = pair.modulus * (pair.radius * pair.radius * pair.radius);
        let before = self.curve.work.get(place).copied().unwrap_or(0.0);
        before * unit + self.segment(pair, indentation).work(indentation)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        sqrt(self.lines(pair, indentation).0)
    }

    /// The recovery has its length \[m\] as its factor, and the shape of the path as its difference.
    fn at_peak(
        &self,
        pair: &Pair,
        _point: &YieldPoint,
        indentation: f64,
        _force: f64,
        _recovery: &RecoveryOf<'_>,
    ) -> (f64, Recovery) {
        let (square, factor) = self.lines(pair, indentation);
        let radius = sqrt(square);
        let recovery = self.recovery(pair, indentation, radius, factor);
        let difference = self.shape(recovery, indentation);
        (radius, Recovery { factor: recovery, difference })
    }

    fn has_own_widths() -> bool {
        true
    }

    /// Valid up to the last knot.
    fn widths(&self, pair: &Pair, size: f64) -> [f64; 2] {
        let last = self.knots().last().map_or(0.0, |knot| pair.radius * sqrt(knot.square));
        [smallest(largest_radius(pair.radius, size), last), largest(size, last)]
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        if indentation < self.yield_point(pair).indentation { Regime::Elastic } else { Regime::ElastoplasticFirst }
    }

    /// The first number is the shape of the unloading, the others are those of the knots.
    fn through(self, list: &[f64]) -> Tabulated {
        let Some((shape, numbers)) = list.split_first() else { return self };
        let (knots, _) = numbers.as_chunks::<NUMBERS>();
        let knot = |&[depth, force, stiffness, factor, square]: &[f64; NUMBERS]| TableKnot {
            depth,
            force,
            stiffness,
            factor,
            square,
        };
        Tabulated::new(knots.iter().map(knot), *shape)
    }
}

const _: () = assert!(MOST < MOST_SEGMENTS as usize);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_works_of_the_example_are_those_of_its_segments() {
        let example = Tabulated::REFERENCE;
        let computed = Tabulated::new(example.knots().iter().copied(), 0.0);
        for (one, other) in computed.curve.work.iter().zip(example.curve.work) {
            assert!((one - other).abs() <= 1e-14 * other, "{one:e}, not {other:e}");
        }
        let list: std::vec::Vec<_> = computed.list().collect();
        assert_eq!(example.through(&list), computed);
    }
}
