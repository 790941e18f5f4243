//! The law `brinell` for any two bodies: an elastic partner, two that yield, hardening, any Poisson's ratio.

use super::table::{End, Interpolant, Sample, Slow, Table};
use super::{Brinell, Loading, MOST_SEGMENTS, RecoveryOf, hertz};
use crate::loading::two_bodies::{Construction, KNOTS, Lead, Together, TwoBodies};
use crate::material::{Pair, YieldPoint};
use crate::numerics::{largest, smallest};
use crate::regime::Regime;
use crate::segment::Segment;
use crate::unloading::Recovery;
use libm::sqrt;

/// [`Brinell`] of two bodies, [each by its own curve](crate::loading::two_bodies).
///
/// The curve has value and slope of this construction at the [knots](KNOTS), and is `c0 + c1 d + c2 d^1.5 + c3 d^2` between them,
/// within 0.35 % of it, and within 0.02 % where the other body stays elastic and none hardens. Beyond the last knot it is a straight
/// line. Value and slope are continuous everywhere. Below yield it is Hertz's law.
///
/// For a rigid sphere on a plane that does not harden and has a Poisson's ratio of 0.3 it is the law `brinell`, but for
/// [large strain](mod@crate::material::large_strain). For a rigid sphere on others: against the finite-element curves in `data/truth/materials`,
/// force within 0.5 % for `x` from 1.2 to 500, contact radius within 2.1 %.
///
/// The construction costs 1 to 20 us a point. A law that is [prepared](Loading::prepared) has its knots in a table.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Paired {
    /// The law of one body under a rigid sphere.
    pub law: Brinell,
    /// Hardening of the softer body, and the harder body.
    pub bodies: TwoBodies,
    /// The knots, if the law is prepared for a pair.
    #[cfg_attr(feature = "serde", serde(skip, default = "none"))]
    table: Table,
}

#[cfg(feature = "serde")]
fn none() -> Table {
    Table::NONE
}

/// Force and slope of the construction at one indentation \[m, N, N/m\].
#[derive(Clone, Copy)]
struct Knot {
    indentation: f64,
    force: f64,
    stiffness: f64,
    /// Depth of the body that yields second in yield depths of its own; zero if it stays elastic.
    hard_depth: f64,
    /// The body that is there at a depth `k` of its own, with this depth and the point of the construction; `None` at first yield.
    point: Option<(Lead, f64, Together)>,
}

/// Knots of the two bodies are not closer than this, as a ratio of their indentations.
const NEAREST: f64 = 1.02;

/// The distance from a knot, as a fraction of the depth, over which slopes there are taken.
const NEAR: f64 = 1e-4;

/// The construction on the bodies of a pair.
struct Curve<'a> {
    construction: Construction<'a>,
    radius: f64,
    point: YieldPoint,
}

impl Curve<'_> {
    /// The knot with this index of one of the bodies; `None` if it is never reached.
    #[inline(never)]
    fn knot(&self, lead: Lead, index: usize) -> Option<Knot> {
        if index == 0 && lead == Lead::Soft {
            // exactly where Hertz's law ends
            return Some(self.yield_knot());
        }
        self.at(lead, *KNOTS.get(index)?)
    }

    fn yield_knot(&self) -> Knot {
        let YieldPoint { indentation, force } = self.point;
        Knot { indentation, force, stiffness: 1.5 * (force / indentation), hard_depth: 0.0, point: None }
    }

    /// The construction where a body is at its own depth `k`.
    fn at(&self, lead: Lead, k: f64) -> Option<Knot> {
        let point = self.construction.led_by(lead, k)?;
        Some(Knot {
            indentation: self.radius * point.indentation,
            force: self.radius * self.radius * point.force,
            stiffness: self.radius * point.stiffness,
            hard_depth: point.depths[1].unwrap_or(0.0),
            point: Some((lead, k, point)),
        })
    }

    /// The knots of a body at or below and above `indentation` \[m\], which is beyond first yield, and the number of those below. The
    /// depth of the body there is about `k`.
    fn neighbours(&self, lead: Lead, indentation: f64, k: f64) -> (Option<Knot>, Option<Knot>, usize) {
        let mut count = KNOTS.partition_point(|&knot| knot <= k);
        let is_below = |knot: &Knot| knot.indentation <= indentation;
        let mut below = count.checked_sub(1).and_then(|index| self.knot(lead, index));
        let mut above = self.knot(lead, count);
        // the depth is known to rounding
        while count > 0 && !below.is_some_and(|knot| is_below(&knot)) {
            count -= 1;
            (above, below) = (below, count.checked_sub(1).and_then(|index| self.knot(lead, index)));
        }
        while above.is_some_and(|knot| is_below(&knot)) {
            count += 1;
            (below, above) = (above, self.knot(lead, count));
        }
        (below, above, count)
    }

    /// The knots at or below and above `indentation` \[m\], which is beyond first yield. They are those of the body that yields
    /// first, and between them those of the other one that are not too near.
    fn around(&self, indentation: f64) -> (Knot, Option<Knot>) {
        let [soft, hard] = self.construction.depths(indentation / self.radius);
        let (below, above, _) = self.neighbours(Lead::Soft, indentation, soft.unwrap_or(0.0));
        let below = below.unwrap_or(self.yield_knot());
        let Some(hard) = hard.filter(|_| above.is_none_or(|above| above.hard_depth > 1.0)) else {
            return (below, above);
        };
        let apart = |knot: &Knot| stands_apart(knot, &below, above.as_ref());
        let (lower, upper, count) = self.neighbours(Lead::Hard, indentation, hard);
        let own = |index: usize| self.knot(Lead::Hard, index).filter(apart);
        let lower = lower.filter(apart).or_else(|| count.checked_sub(2).and_then(own));
        let upper = upper.filter(apart).or_else(|| own(count + 1));
        (lower.unwrap_or(below), upper.or(above))
    }

    /// All knots from first yield on, each computed once.
    fn knots(&self) -> impl Iterator<Item = Knot> {
        let (mut begin, mut below) = (self.yield_knot(), self.yield_knot());
        let (mut soft, mut hard) = (1, 0);
        let mut above = self.knot(Lead::Soft, soft);
        core::iter::once(begin).chain(core::iter::from_fn(move || {
            let next = match self.next_hard(&below, above.as_ref(), &begin, &mut hard) {
                Some(knot) => knot,
                None => {
                    let next = above?;
                    soft += 1;
                    (below, above) = (next, self.knot(Lead::Soft, soft));
                    next
                }
            };
            begin = next;
            Some(next)
        }))
    }

    /// Work \[J\] up to `indentation` \[m\]: the sum over the pieces.
    #[inline(never)]
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        let elastic = hertz::segment(pair, self.point.indentation);
        if indentation <= self.point.indentation {
            return elastic.work(indentation);
        }
        let mut work = elastic.work(self.point.indentation);
        let mut knots = self.knots().take(MOST_SEGMENTS as usize).peekable();
        while let Some(begin) = knots.next() {
            let piece = knots.peek().map_or_else(|| beyond(&begin), |end| between(&begin, end));
            if indentation <= piece.upper {
                return work + piece.work(indentation);
            }
            work += piece.work(piece.upper);
        }
        work
    }

    /// The table of the knots up to an indentation of the radius, or up to this work \[J\]; without a law of the recovery for force and work
    /// alone.
    #[inline(never)]
    fn table(&self, pair: &Pair, bodies: &TwoBodies, recovery: Option<&RecoveryOf<'_>>, most: f64) -> Table {
        let begin = |k: f64| {
            let at = |lead| self.at(lead, k).map_or(f64::INFINITY, |knot| knot.indentation);
            smallest(at(Lead::Soft), at(Lead::Hard))
        };
        let law = self.construction.law;
        let work = hertz::segment(pair, self.point.indentation).work(self.point.indentation);
        let mut knots = self.knots().take_while(|knot| knot.indentation < self.radius).peekable();
        let knots = core::iter::from_fn(|| {
            let knot = knots.next()?;
            let piece = knots.peek().map(|next| {
                let middle = recovery.and_then(|recovery| self.middle(&knot, next, recovery));
                (between(&knot, next), middle)
            });
            Some((knot.indentation, recovery.map(|recovery| self.end(pair, &knot, recovery)), piece))
        });
        let regions =
            [law.second_region, law.fully_plastic].map(|k| if recovery.is_some() { begin(k) } else { f64::NAN });
        Table::of((pair, bodies), self.point, (work, most), regions, knots)
    }

    /// The slow numbers at a knot. A contact returns nearly all that it receives just after first yield: there the slopes are taken from
    /// two points.
    #[inline(never)]
    fn end(&self, pair: &Pair, knot: &Knot, recovery: &RecoveryOf<'_>) -> End {
        let near = |lead: Lead, k: f64| self.construction.led_by(lead, k).map(|point| self.sample(&point, recovery));
        match &knot.point {
            Some((lead, k, point)) => End::of(self.sample(point, recovery), [near(*lead, *k * (1.0 + NEAR)), None]),
            None => {
                let hertz = Slow { area: 1.0, recovery: Recovery::NONE, share: pair.share() };
                let near = [1.0, 2.0].map(|times| near(Lead::Soft, 1.0 + times * NEAR));
                End::of((sqrt(knot.indentation), hertz), near)
            }
        }
    }

    /// A point of the piece between two knots, with the force of this piece.
    #[inline(never)]
    fn middle(&self, begin: &Knot, end: &Knot, recovery: &RecoveryOf<'_>) -> Option<Sample> {
        let depth = |knot: &Knot| knot.point.map_or(Some(1.0), |(_, _, point)| point.depths[0]);
        let point = self.construction.led_by(Lead::Soft, sqrt(depth(begin)? * depth(end)?))?;
        let indentation = self.radius * point.indentation;
        let is_between = indentation > begin.indentation && indentation < end.indentation;
        let force = between(begin, end).force(indentation) / (self.radius * self.radius);
        is_between.then(|| self.sample(&point.with_force(force), recovery))
    }

    #[inline(never)]
    fn sample(&self, point: &Together, recovery: &RecoveryOf<'_>) -> Sample {
        let area = point.radius * point.radius / point.indentation;
        let slow = Slow { area, recovery: recovery(&self.construction, point), share: point.share };
        (sqrt(self.radius * point.indentation), slow)
    }

    /// The slow numbers at `indentation` \[m\], beyond first yield. Beyond the last knot they are those of the construction.
    #[inline(never)]
    fn slow(&self, pair: &Pair, indentation: f64, recovery: &RecoveryOf<'_>) -> Slow {
        match self.around(indentation) {
            (begin, Some(end)) => {
                let middle = self.middle(&begin, &end, recovery);
                let [begin, end] = [begin, end].map(|knot| self.end(pair, &knot, recovery));
                Interpolant::through(&begin, middle, &end).at(sqrt(indentation))
            }
            (last, None) => {
                let force = beyond(&last).force(indentation) / (self.radius * self.radius);
                self.sample(&self.construction.at_indentation(indentation / self.radius, force), recovery).1
            }
        }
    }

    /// The next knot of the body that yields second, from its number `hard` on, that lies beyond the knot `begin` and stands apart from
    /// those of the first one, `below` and `above`.
    fn next_hard(&self, below: &Knot, above: Option<&Knot>, begin: &Knot, hard: &mut usize) -> Option<Knot> {
        if above.is_some_and(|above| above.hard_depth <= 1.0) {
            return None;
        }
        while let Some(knot) = self.knot(Lead::Hard, *hard) {
            if above.is_some_and(|above| knot.indentation >= above.indentation) {
                return None;
            }
            *hard += 1;
            if knot.indentation > begin.indentation && stands_apart(&knot, below, above) {
                return Some(knot);
            }
        }
        None
    }

    /// The piece that holds at and just above `indentation` \[m\].
    #[inline(never)]
    fn piece(&self, pair: &Pair, indentation: f64) -> Segment {
        if indentation < self.point.indentation {
            return hertz::segment(pair, self.point.indentation);
        }
        match self.around(indentation) {
            (begin, Some(end)) => between(&begin, &end),
            (last, None) => beyond(&last),
        }
    }
}

/// Whether a knot of the body that yields second is not too near to those of the first one, `below` and `above`.
fn stands_apart(knot: &Knot, below: &Knot, above: Option<&Knot>) -> bool {
    let (from, to) = (NEAREST * below.indentation, NEAREST * knot.indentation);
    knot.indentation > from && above.is_none_or(|above| to < above.indentation)
}

impl Paired {
    /// The law of one body, for these bodies.
    pub const fn new(law: Brinell, bodies: TwoBodies) -> Paired {
        Paired { law, bodies, table: Table::NONE }
    }

    /// The same law, not [prepared](Loading::prepared) for any pair.
    pub fn unprepared(self) -> Paired {
        Paired::new(self.law, self.bodies)
    }

    /// Whether both bodies yield before `indentation` \[m\].
    pub fn both_yield(&self, pair: &Pair, indentation: f64) -> bool {
        let curve = self.curve(pair);
        let both = |[_, hard]: [Option<f64>; 2]| hard.is_some_and(|k| k > 1.0);
        indentation > curve.point.indentation && both(curve.construction.depths(indentation / pair.radius))
    }

    /// The slow numbers at `indentation` \[m\]; `None` before first yield.
    fn slow(&self, pair: &Pair, indentation: f64, recovery: &RecoveryOf<'_>) -> Option<Slow> {
        let known = self.table.slow(pair, indentation);
        if known.is_some() || indentation < self.yield_point(pair).indentation {
            return known;
        }
        Some(self.curve(pair).slow(pair, indentation, recovery))
    }

    /// The curve of the bodies of `pair`.
    fn curve(&self, pair: &Pair) -> Curve<'_> {
        let construction = Construction::of(&self.law, pair, &self.bodies);
        let point = construction.yield_point(pair);
        Curve { construction, radius: pair.radius, point }
    }
}

impl Knot {
    /// Indentation, force and stiffness.
    fn numbers(&self) -> [f64; 3] {
        [self.indentation, self.force, self.stiffness]
    }
}

/// The straight line beyond the last knot.
fn beyond(last: &Knot) -> Segment {
    Segment::beyond(last.numbers())
}

/// The piece between two knots.
fn between(begin: &Knot, end: &Knot) -> Segment {
    Segment::between(begin.numbers(), end.numbers())
}

impl Loading for Paired {
    fn has_squares() -> bool {
        true
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        let construct = || Construction::of(&self.law, pair, &self.bodies).yield_point(pair);
        self.table.yield_point(pair).copied().unwrap_or_else(construct)
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        if let Some(piece) = self.table.piece(pair, indentation) {
            return piece;
        }
        match self.table.yield_point(pair).filter(|point| indentation < point.indentation) {
            Some(point) => hertz::segment(pair, point.indentation),
            None => self.curve(pair).piece(pair, indentation),
        }
    }

    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        self.table.work(pair, indentation).unwrap_or_else(|| self.curve(pair).work(pair, indentation))
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        self.at_peak(pair, &YieldPoint::default(), indentation, 0.0, &|_, _| Recovery::NONE).0
    }

    fn at_peak(
        &self,
        pair: &Pair,
        _point: &YieldPoint,
        indentation: f64,
        _force: f64,
        recovery: &RecoveryOf<'_>,
    ) -> (f64, Recovery) {
        let Some(Slow { area, recovery, .. }) = self.slow(pair, indentation, recovery) else {
            return (sqrt(pair.radius * indentation), Recovery::NONE);
        };
        (sqrt(pair.radius * indentation * area), recovery)
    }

    /// The body with the larger depth is in its second region, and fully plastic, where its law alone would be.
    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        let of = |begins: [bool; 2]| match begins {
            [false, _] => Regime::ElastoplasticFirst,
            [_, false] => Regime::ElastoplasticSecond,
            _ => Regime::FullyPlastic,
        };
        if self.table.yield_point(pair).is_some_and(|point| indentation < point.indentation) {
            return Regime::Elastic;
        }
        if let Some(begun) = self.table.regions(pair, indentation) {
            return of(begun);
        }
        let curve = self.curve(pair);
        if indentation < curve.point.indentation {
            return Regime::Elastic;
        }
        let [soft, hard] = curve.construction.depths(indentation / pair.radius);
        let depth = largest(soft.unwrap_or(0.0), hard.unwrap_or(0.0));
        of([self.law.second_region, self.law.fully_plastic].map(|region| depth >= region))
    }

    fn share(&self, pair: &Pair, indentation: f64) -> f64 {
        self.width(pair, indentation).1
    }

    fn width(&self, pair: &Pair, indentation: f64) -> (f64, f64) {
        let slow = self.slow(pair, indentation, &|_, _| Recovery::NONE);
        let (area, share) = slow.map_or_else(|| (1.0, pair.share()), |slow| (slow.area, slow.share));
        (sqrt(pair.radius * indentation * area), share)
    }

    fn prepared(self, pair: &Pair, recovery: &RecoveryOf<'_>, before: Option<&Paired>) -> Paired {
        let known = before.map(|before| &before.table).filter(|table| table.is_of(pair, &self.bodies));
        let all = || self.curve(pair).table(pair, &self.bodies, Some(recovery), f64::INFINITY);
        Paired { table: known.copied().unwrap_or_else(all), ..self }
    }

    fn prepared_for(self, pair: &Pair, energy: f64) -> Paired {
        Paired { table: self.curve(pair).table(pair, &self.bodies, None, energy), ..self }
    }

    fn strengthened_by(self, factor: f64, others: f64) -> Paired {
        Paired::new(self.law, self.bodies.strengthened_by(factor, others))
    }
}
