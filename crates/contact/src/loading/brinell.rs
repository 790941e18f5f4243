//! The law `brinell`: a fit to finite-element results for a rigid sphere on an elastic, perfectly plastic half-space.

use super::{Loading, hertz, work_over_segments};
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::sqrt;

/// Number of pieces of the curve above yield.
const PIECES: usize = 9;

/// Force and contact area fitted to finite-element indentation (`data/truth/loading.csv` and, beyond `x = 250`,
/// `data/truth/pairs/one_body_loading_to_3000.csv`; fitted by `data/fit/fit_brinell.py`), with
/// `x = d/d_y`, `f = F/F_y`, `A = a^2/(R d_y)`:
///
/// - `x < 1`: Hertz, `f = x^1.5`, `A = x`;
/// - above: `f` and `A` are each a chain of pieces `c0 + c1 x + c2 x^1.5` on the same knots, with continuous value
///   and slope; the slope is linear in `sqrt(x)` between knots;
/// - beyond the last knot both are linear: the mean pressure tends to 3.06 S, that of the last slopes.
///
/// Value and slope are continuous everywhere; force, area and mean pressure are monotone. Each piece has its origin
/// at `x = 0`. With the origin at its knot, the curvature would be infinite just after the knot, and the force would
/// rise above Hertz's just after yield.
///
/// Within 0.32 % of the first table from first contact to `x = 1000` (0.11 % rms). Of the second one within 0.52 % to `x = 1000`
/// and 0.23 % from there to 3000 (0.18 % rms in all). These are also the errors of the tables. Contact radius within 0.6 %
/// and 0.2 %. Deeper, the curve is extrapolated. Small strain, nu = 0.3, no hardening; [`Paired`](super::Paired)
/// covers hardening, other Poisson's ratios, any two bodies and large strain.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Brinell {
    /// Mean pressure at yield over the yield strength.
    pub yield_pressure_factor: f64,
    /// Start of each piece \[d_y\]; the first knot is the yield point.
    #[cfg_attr(feature = "serde", serde(with = "fixed"))]
    pub knots: [f64; PIECES],
    /// Slope of the force at each knot \[F_y/d_y\].
    #[cfg_attr(feature = "serde", serde(with = "fixed"))]
    pub force_slopes: [f64; PIECES],
    /// Slope of `a^2` at each knot `[R]`.
    #[cfg_attr(feature = "serde", serde(with = "fixed"))]
    pub area_slopes: [f64; PIECES],
    /// Start of the second elastoplastic region \[d_y\]: mean pressure 2.19 S.
    pub second_region: f64,
    /// Start of the fully plastic regime \[d_y\]: mean pressure 2.92 S, within 5 % of its limit.
    pub fully_plastic: f64,
}

/// Lists of the fit as a whole, which only its reference has.
#[cfg(feature = "serde")]
mod fixed {
    use super::{Brinell, PIECES};
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

    pub fn serialize<S: Serializer>(list: &[f64; PIECES], serializer: S) -> Result<S::Ok, S::Error> {
        list.serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f64; PIECES], D::Error> {
        let Brinell { knots, force_slopes, area_slopes, .. } = Brinell::REFERENCE;
        let list = <[f64; PIECES]>::deserialize(deserializer)?;
        let known = [knots, force_slopes, area_slopes].into_iter().find(|known| *known == list);
        known.ok_or_else(|| D::Error::custom("another list than that of the fit"))
    }
}

/// A piece `c0 + c1 x + c2 x^1.5` from one knot to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    from: f64,
    to: f64,
    c0: f64,
    c1: f64,
    c2: f64,
}

impl Piece {
    fn value(&self, x: f64) -> f64 {
        self.c0 + x * (self.c1 + self.c2 * sqrt(x))
    }

    fn slope(&self, x: f64) -> f64 {
        self.c1 + 1.5 * self.c2 * sqrt(x)
    }
}

/// A chain of pieces.
type Chain = [Piece; PIECES];

/// The pieces with these slopes at these knots; the first one begins at the value 1.
const fn chain(knots: &[f64; PIECES], slopes: &[f64; PIECES]) -> Chain {
    let mut chain = [Piece { from: 0.0, to: f64::INFINITY, c0: 0.0, c1: 0.0, c2: 0.0 }; PIECES];
    let (mut value, mut index) = (1.0, 0);
    while index < PIECES {
        let (from, slope, next) = (knots[index], slopes[index], index + 1);
        let (root, mut to, mut c2, mut end) = (root_of(from), f64::INFINITY, 0.0, 0.0);
        if next < PIECES {
            (to, end) = (knots[next], root_of(knots[next]));
            c2 = (slopes[next] - slope) / (1.5 * (end - root));
        }
        let c1 = slope - 1.5 * c2 * root;
        let c0 = value - from * (c1 + c2 * root);
        chain[index] = Piece { from, to, c0, c1, c2 };
        value = c0 + to * (c1 + c2 * end);
        index = next;
    }
    chain
}

/// The square root, rounded like that of a processor, which the compiler can't ask: by Newton's method, whose last step takes the error of
/// the square from the exact product of its halves (T. J. Dekker, *Numerische Mathematik* 18 (1971) 224-242).
const fn root_of(square: f64) -> f64 {
    const SPLIT: f64 = 134_217_729.0;
    let (mut root, mut left) = (square, 20);
    while left > 0 {
        root = 0.5 * (root + square / root);
        left -= 1;
    }
    let scaled = SPLIT * root;
    let high = scaled - (scaled - root);
    let (low, product) = (root - high, root * root);
    let rest = ((high * high - product) + 2.0 * high * low) + low * low;
    root - ((product - square) + rest) / (2.0 * root)
}

/// The chains of force and area of the reference.
static CHAINS: [Chain; 2] = {
    let Brinell { knots, force_slopes, area_slopes, .. } = Brinell::REFERENCE;
    [chain(&knots, &force_slopes), chain(&knots, &area_slopes)]
};

impl Brinell {
    /// The constants from `data/fit/fit_brinell.py`, for a Poisson's ratio of 0.3 of the yielding body and no hardening, whatever
    /// the pair has. An FMU has [`Paired`](super::Paired) for any other ratio.
    ///
    /// The last slopes correspond to a mean pressure of 3.06 S; the finite-element results have 3.01 S at `x = 1000` and 3.04 S
    /// at 3000. The area grows by `2.62 R d` there. A rigid, perfectly plastic solid has `2.86 R d` (B. Storåkers, S. Biwa,
    /// P.-L. Larsson, *Int. J. Solids Struct.* 34 (1997) 3061-3083): far beyond the tables, force and area are up to 8.4 %
    /// below that.
    pub const REFERENCE: Brinell = Brinell {
        yield_pressure_factor: 1.1,
        knots: [1.0, 2.0, 5.0, 12.0, 30.0, 80.0, 250.0, 700.0, 2000.0],
        force_slopes: [1.5, 2.0032, 2.7348, 3.5094, 4.3243, 5.1693, 6.1383, 6.8128, 7.2932],
        area_slopes: [1.0, 1.1219, 1.3539, 1.5692, 1.7436, 1.9257, 2.2391, 2.4721, 2.6205],
        second_region: 12.0,
        fully_plastic: 250.0,
    };

    /// The piece for `x >= 1` of the chain with these slopes.
    #[inline(never)]
    fn piece(&self, slopes: &[f64; PIECES], x: f64) -> Piece {
        let Brinell { knots, force_slopes, area_slopes, .. } = Brinell::REFERENCE;
        let [force, area] = &CHAINS;
        let other;
        let chain = match () {
            () if self.knots == knots && *slopes == force_slopes => force,
            () if self.knots == knots && *slopes == area_slopes => area,
            // the lists belong to the fit, and no scene has others
            () => {
                other = chain(&self.knots, slopes);
                &other
            }
        };
        let [first, ..] = chain;
        let mut found = first;
        for piece in chain {
            found = piece;
            if x < piece.to {
                break;
            }
        }
        *found
    }

    /// Mean pressure of deep dents, over that at yield.
    pub(crate) fn plastic_pressure(&self) -> f64 {
        self.force_slopes[PIECES - 1] / self.area_slopes[PIECES - 1]
    }

    /// Force and slope at `x >= 1` \[F_y, F_y/d_y\].
    pub(crate) fn force_and_slope(&self, x: f64) -> (f64, f64) {
        let piece = self.piece(&self.force_slopes, x);
        (piece.value(x), piece.slope(x))
    }

    /// Contact area at `x >= 1`, `a^2/(R d_y)`, and its slope.
    pub(crate) fn area_and_slope(&self, x: f64) -> (f64, f64) {
        let piece = self.piece(&self.area_slopes, x);
        (piece.value(x), piece.slope(x))
    }

    /// The regime at `indentation` \[m\] of a contact that yields at `d_y` \[m\].
    pub(super) fn regime_in(&self, d_y: f64, indentation: f64) -> Regime {
        if indentation < d_y {
            Regime::Elastic
        } else if indentation < self.second_region * d_y {
            Regime::ElastoplasticFirst
        } else if indentation < self.fully_plastic * d_y {
            Regime::ElastoplasticSecond
        } else {
            Regime::FullyPlastic
        }
    }
}

impl Loading for Brinell {
    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        pair.yield_point(self.yield_pressure_factor)
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        let YieldPoint { indentation: d_y, force: f_y } = self.yield_point(pair);
        if indentation < d_y {
            return hertz::segment(pair, d_y);
        }
        // the comparison uses the knots in metres: a segment then begins exactly at the end of the one before it
        let knot_below = self.knots.iter().copied().filter(|knot| knot * d_y <= indentation).fold(1.0, f64::max);
        let Piece { from, to, c0, c1, c2 } = self.piece(&self.force_slopes, knot_below);
        let upper = if to < f64::INFINITY { to * d_y } else { LARGEST_INDENTATION };
        let slope_unit = f_y / d_y;
        Segment {
            lower: from * d_y,
            upper,
            constant: c0 * f_y,
            linear: c1 * slope_unit,
            power: c2 * slope_unit / sqrt(d_y),
            ..Segment::NOTHING
        }
    }

    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        work_over_segments(self, pair, indentation)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_y = self.yield_point(pair).indentation;
        let x = indentation / d_y;
        let area = if x < 1.0 { x } else { self.piece(&self.area_slopes, x).value(x) };
        sqrt(pair.radius * d_y * area)
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        self.regime_in(self.yield_point(pair).indentation, indentation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_compiler_takes_the_roots_of_the_knots_as_libm_does() {
        for knot in Brinell::REFERENCE.knots {
            assert_eq!(root_of(knot), sqrt(knot));
        }
    }
}
