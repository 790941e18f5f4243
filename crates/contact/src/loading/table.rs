//! The curve of a pair at its knots, made once, so that a change of branch looks it up.

use crate::loading::two_bodies::TwoBodies;
use crate::material::{Pair, YieldPoint};
use crate::numerics::quotient;
use crate::segment::Segment;
use crate::unloading::Recovery;
use libm::sqrt;

/// More knots than most pairs have up to an indentation of their radius. Beyond the last one the construction is asked.
const MOST: usize = 32;

/// What is known of the bodies at a point of the loading curve beside force and work. These numbers change slowly.
#[derive(Clone, Copy)]
pub(super) struct Slow {
    /// The contact area over that of Hertz's law, `a^2/(R d)`.
    pub area: f64,
    /// How the recovery of the bodies differs from that of the law itself.
    pub recovery: Recovery,
    /// The part of the gap's curvature that the softer body takes on.
    pub share: f64,
}

/// Their number.
const SLOW: usize = 4;

/// The slow numbers as a list.
type Numbers = [f64; SLOW];

impl Slow {
    fn numbers(&self) -> Numbers {
        [self.area, self.recovery.factor, self.recovery.difference, self.share]
    }
}

/// A point of the curve: the root of its indentation \[m^0.5\], and the slow numbers there.
pub(super) type Sample = (f64, Slow);

/// The slow numbers at a knot, and their slopes over the root of the indentation.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct End {
    root: f64,
    values: Numbers,
    slopes: Numbers,
}

impl End {
    const NOTHING: End = End { root: 0.0, values: [0.0; SLOW], slopes: [0.0; SLOW] };

    /// The end at a knot, with the slopes of the parabola through it and two neighbours, or of the line through the only one.
    #[inline(never)]
    pub fn of((root, slow): Sample, near: [Option<Sample>; 2]) -> End {
        let values = slow.numbers();
        let secants = near.map(|near| {
            let (there, slow) = near?;
            let (way, mut slopes) = (there - root, slow.numbers());
            for (slope, value) in slopes.iter_mut().zip(values) {
                *slope = quotient(*slope - value, way, way != 0.0, 0.0);
            }
            Some((way, slopes))
        });
        let slopes = match secants {
            [Some((one, mut slopes)), Some((other, more))] => {
                for (slope, far) in slopes.iter_mut().zip(more) {
                    *slope += quotient((*slope - far) * one, other - one, other != one, 0.0);
                }
                slopes
            }
            [Some((_, only)), None] | [None, Some((_, only))] => only,
            [None, None] => [0.0; SLOW],
        };
        End { root, values, slopes }
    }
}

/// The slow numbers on a piece, over the root of the indentation: cubics by the values and slopes at both ends, and terms of fourth order by
/// a point between them.
#[derive(Clone, Copy)]
pub(super) struct Interpolant<'a> {
    begin: &'a End,
    end: &'a End,
    bumps: Numbers,
}

impl<'a> Interpolant<'a> {
    /// The course from one end to the other through the point in the `middle`.
    #[inline(never)]
    pub fn through(begin: &'a End, middle: Option<Sample>, end: &'a End) -> Interpolant<'a> {
        let course = Interpolant { begin, end, bumps: [0.0; SLOW] };
        let Some((root, slow)) = middle else { return course };
        let (plain, mut bumps) = (course.at(root), slow.numbers());
        let part = (root - begin.root) / (end.root - begin.root);
        let inner = part * (1.0 - part);
        for (bump, value) in bumps.iter_mut().zip(plain.numbers()) {
            *bump = quotient(*bump - value, inner * inner, inner > 0.0, 0.0);
        }
        Interpolant { bumps, ..course }
    }

    /// The slow numbers at a `root` of the indentation \[m^0.5\].
    #[inline(never)]
    pub fn at(&self, root: f64) -> Slow {
        let Interpolant { begin, end, bumps } = self;
        let length = end.root - begin.root;
        let part = (root - begin.root) / length;
        let rest = 1.0 - part;
        let inner = part * rest;
        let mut numbers = *bumps;
        let ends = begin.values.iter().zip(&begin.slopes).zip(end.values.iter().zip(&end.slopes));
        for (number, ((first, leaving), (last, arriving))) in numbers.iter_mut().zip(ends) {
            let difference = last - first;
            let (leaving, arriving) = (leaving * length - difference, difference - arriving * length);
            *number = rest * first + part * last + inner * (rest * leaving + part * arriving + inner * *number);
        }
        let [area, factor, difference, share] = numbers;
        Slow { area, recovery: Recovery { factor, difference }, share }
    }
}

/// A knot, and the piece that begins there.
#[derive(Clone, Copy, PartialEq)]
struct Row {
    /// Indentation \[m\].
    lower: f64,
    /// Work up to the knot \[J\].
    work: f64,
    /// Coefficients of the [segment](Segment): `c0`, `c1`, `c2` and `c3`.
    coefficients: [f64; 4],
    end: End,
    bumps: Numbers,
}

impl Row {
    const NOTHING: Row = Row { lower: 0.0, work: 0.0, coefficients: [0.0; 4], end: End::NOTHING, bumps: [0.0; SLOW] };

    #[inline(always)]
    fn piece(&self, next: &Row) -> Segment {
        let [constant, linear, power, square] = self.coefficients;
        Segment { lower: self.lower, upper: next.lower, origin: 0.0, constant, linear, power, square }
    }
}

/// The curve of a pair from first yield on, bit for bit that of a law without a table.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Table {
    /// The number of pieces: none in a law that is not prepared.
    pieces: usize,
    /// The bodies: no other ones are looked up.
    pair: Pair,
    bodies: TwoBodies,
    /// First yield.
    point: YieldPoint,
    /// Whether the slow numbers are there, too.
    has_slow: bool,
    /// Indentations at which the second region and the fully plastic one begin \[m\].
    regions: [f64; 2],
    rows: [Row; MOST],
}

impl core::fmt::Debug for Table {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Table").field("pieces", &self.pieces).finish_non_exhaustive()
    }
}

/// A knot of a table: indentation \[m\], slow numbers, and what there is of the piece that begins, with a point on it.
pub(super) type TableKnot = (f64, Option<End>, Option<(Segment, Option<Sample>)>);

impl Table {
    /// No piece: the construction is asked everywhere.
    pub const NONE: Table = Table {
        pieces: 0,
        pair: Pair { radius: 0.0, modulus: 0.0, yield_strength: 0.0, youngs_modulus: 0.0, poissons_ratio: 0.0 },
        bodies: TwoBodies::under_rigid(0.0),
        point: YieldPoint { indentation: 0.0, force: 0.0 },
        has_slow: false,
        regions: [0.0; 2],
        rows: [Row::NOTHING; MOST],
    };

    /// The table of these `knots` of the `bodies` of a `pair` that yields at `point`, with the `work` \[J\] up to there. It ends where the work
    /// exceeds `most` \[J\].
    pub fn of(
        (pair, bodies): (&Pair, &TwoBodies),
        point: YieldPoint,
        (mut work, most): (f64, f64),
        regions: [f64; 2],
        knots: impl Iterator<Item = TableKnot>,
    ) -> Table {
        let mut table = Table { pair: *pair, bodies: *bodies, point, regions, ..Table::NONE };
        let mut middles = [None; MOST];
        let mut count: usize = 0;
        for ((row, middle), (lower, end, begins)) in table.rows.iter_mut().zip(&mut middles).zip(knots) {
            table.has_slow = end.is_some();
            *row = Row { lower, work, end: end.unwrap_or(End::NOTHING), ..Row::NOTHING };
            count += 1;
            if work > most {
                break;
            }
            if let Some((piece, sample)) = begins {
                row.coefficients = [piece.constant, piece.linear, piece.power, piece.square];
                work += piece.work(piece.upper);
                *middle = sample;
            }
        }
        // the last knot only ends a piece
        table.pieces = count.saturating_sub(1);
        if table.has_slow {
            let ends = table.rows.map(|row| row.end);
            for ((row, next), middle) in table.rows.iter_mut().zip(ends.iter().skip(1)).zip(middles).take(table.pieces)
            {
                row.bumps = Interpolant::through(&row.end, middle, next).bumps;
            }
        }
        table
    }

    /// Whether it is the table of these bodies.
    pub fn is_of(&self, pair: &Pair, bodies: &TwoBodies) -> bool {
        self.has_slow && self.pieces > 0 && self.pair == *pair && self.bodies == *bodies
    }

    /// First yield of `pair`, if the table is its own.
    pub fn yield_point(&self, pair: &Pair) -> Option<&YieldPoint> {
        (self.pieces > 0 && self.pair == *pair).then_some(&self.point)
    }

    /// Whether the second region and the fully plastic one have begun at `indentation` \[m\]; `None` outside of the table.
    pub fn regions(&self, pair: &Pair, indentation: f64) -> Option<[bool; 2]> {
        self.row(pair, indentation).filter(|_| self.has_slow).map(|_| self.regions.map(|begin| indentation >= begin))
    }

    /// The row of the piece that holds at and just above `indentation` \[m\], and the next one.
    #[inline(never)]
    fn row(&self, pair: &Pair, indentation: f64) -> Option<(&Row, &Row)> {
        self.yield_point(pair)?;
        let rows = self.rows.get(..=self.pieces)?;
        let index = rows.partition_point(|row| row.lower <= indentation).checked_sub(1)?;
        Some((rows.get(index)?, rows.get(index + 1)?))
    }

    /// The piece that holds at and just above `indentation` \[m\]; `None` outside of the table.
    pub fn piece(&self, pair: &Pair, indentation: f64) -> Option<Segment> {
        self.row(pair, indentation).map(|(row, next)| row.piece(next))
    }

    /// Work \[J\] up to `indentation` \[m\]; `None` outside of the table.
    pub fn work(&self, pair: &Pair, indentation: f64) -> Option<f64> {
        self.row(pair, indentation).map(|(row, next)| row.work + row.piece(next).work(indentation))
    }

    /// The slow numbers at `indentation` \[m\]; `None` outside of the table.
    pub fn slow(&self, pair: &Pair, indentation: f64) -> Option<Slow> {
        let (row, next) = self.row(pair, indentation).filter(|_| self.has_slow)?;
        Some(Interpolant { begin: &row.end, end: &next.end, bumps: row.bumps }.at(sqrt(indentation)))
    }
}
