//! Strain rate: the strength of a target in an impact, from its closing speed.
//!
//! The strength is constant within an impact. It is that at the mean strain rate of the loading: Tabor's strain,
//! `0.2 a/R_i` at the largest contact radius, over the time from first contact to that radius. Both depend on the strength,
//! so that it is a fixed point. `R_i` is the radius of the rigid sphere that a body [sees](Loading::share): each of the two bodies has
//! its own strain, strain rate and strength.
//!
//! The [hook](super::motion::PlasticContact::strengthen) of a touch finds it, in any motion: of one contact, of those that share bodies,
//! with losses.

mod behaviour;
pub mod history;

pub use history::History;

use super::impact::{self, Impact, Prediction};
use super::loading::Loading;
use super::losses;
use super::motion::{ExternalLoad, time_to_turn};
use super::unloading::Unloading;
use crate::Pair;
use crate::numerics::{largest, quotient};
use core::f64::consts::PI;
use libm::{exp, fabs, log, pow, sqrt};

/// Factor of Tabor's representative strain: strain over (contact radius over radius of the rigid indenter).
///
/// Reference: D. Tabor, *The Hardness of Metals*, Oxford 1951, chapter V.
pub const TABOR: f64 = 0.2;

/// The strain of a body for a search to begin with.
pub const FIRST_STRAIN: f64 = 0.05;

/// The strains of both.
pub const FIRST: Strains = Strains { softer: FIRST_STRAIN, harder: FIRST_STRAIN };

/// Two changes span a plane if the square of the sine between them is larger.
const FLAT: f64 = 1e-10;

/// Largest change of a logarithm from guess to guess.
const FARTHEST: f64 = 1.0;

/// Number of improvements of the factors for a search to begin with.
const GUESSES: u32 = 3;

/// Relative tolerance of the fixed point for factor and strain.
const CLOSE: f64 = 1e-12;

/// The same after so many iterations that a strain is known to be far below that of the other body, and to have fewer digits.
const ROUGH: f64 = 1e-9;
const MANY: u32 = 16;

/// Largest number of iterations.
pub const STEPS: u32 = 200;

/// Larger than the factor of any impact, but small enough that no strength overflows.
const STRONGEST: f64 = 1e200;

/// Whether a contact may have these strengths, relative to the quasi-static ones.
fn are_factors(Factors { softer, harder }: Factors) -> bool {
    // a NaN is in no range
    (1.0..=STRONGEST).contains(&softer) && (1.0..=STRONGEST).contains(&harder)
}

/// Models of the flow stress over the strain rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rate {
    /// `1 + c ln(rate/reference)`; 1 below the reference rate.
    ///
    /// Reference: G. R. Johnson, W. H. Cook, *7th Int. Symp. on Ballistics*, The Hague 1983, 541-547.
    JohnsonCook {
        /// \[-\], from 0 to 1.
        c: f64,
        /// \[1/s\] > 0.
        reference_rate: f64,
    },
    /// `1 + (rate/d)^(1/q)`.
    ///
    /// Reference: G. R. Cowper, P. S. Symonds, Brown University, Division of Applied Mathematics, report 28 (1957).
    CowperSymonds {
        /// \[1/s\] > 0.
        d: f64,
        /// \[-\], 0.5 at least.
        q: f64,
    },
}

impl Rate {
    /// The same strength at any strain rate.
    pub const NONE: Rate = Rate::JohnsonCook { c: 0.0, reference_rate: 1.0 };

    /// Flow stress at a strain rate \[1/s\] relative to the quasi-static one: 1 at least.
    pub fn factor(&self, rate: f64) -> f64 {
        match *self {
            Rate::JohnsonCook { c, reference_rate } => 1.0 + c * log(largest(rate / reference_rate, 1.0)),
            Rate::CowperSymonds { d, q } => 1.0 + pow(rate / d, 1.0 / q),
        }
    }
}

/// Flow stresses relative to the quasi-static ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// Of the softer body, which the pair describes.
    pub softer: f64,
    /// Of the harder body.
    pub harder: f64,
}

impl Factors {
    /// Under a slow load.
    pub const SLOW: Factors = Factors { softer: 1.0, harder: 1.0 };
}

/// Tabor's strains of the two bodies \[-\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strains {
    /// Of the softer body.
    pub softer: f64,
    /// Of the harder body; zero for a rigid one.
    pub harder: f64,
}

/// The strength in an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InImpact {
    /// Flow stresses relative to the quasi-static ones.
    pub factors: Factors,
    /// Tabor's strains.
    pub strains: Strains,
    /// Time from first contact to the largest contact radius \[s\].
    pub loading_time: f64,
    /// Number of predictions that it took: at most [`STEPS`].
    pub steps: u32,
}

impl InImpact {
    /// Mean strain rate of the softer body while loading \[1/s\].
    pub fn strain_rate(&self) -> f64 {
        self.strains.softer / self.loading_time
    }
}

/// The strength in an impact, by the rate models of the softer and of the harder body, beginning with these strains and factors. `predict` gives
/// the loading time \[s\] of the impact for strains and factors, and the strains that it has. Without a model the factor is 1 and only the
/// strain is found. `None` where a prediction fails, or after [`STEPS`] of them.
///
/// Strains and factors are a fixed point, found on their logarithms. Two bodies of nearly the same strength take over strain from each
/// other, so that predictions alone may lead to and fro. Each guess is where the last three would be one if all depended linearly on each
/// other: the method of D. G. Anderson, *J. ACM* 12 (1965) 547-560, with two steps of memory.
pub fn in_impact(
    [softer, harder]: [Option<&Rate>; 2],
    (strains, factors): (Strains, Factors),
    mut predict: impl FnMut(Strains, Factors) -> Option<(f64, Strains)>,
) -> Option<InImpact> {
    let mut guess = Guess { strains, factors };
    let mut before: [Option<Trial>; 2] = [None; 2];
    for steps in 1..=STEPS {
        let (loading_time, strains) = predict(guess.strains, guess.factors)?;
        let factor = |rate: Option<&Rate>, strain: f64| rate.map_or(1.0, |rate| rate.factor(strain / loading_time));
        let factors = Factors { softer: factor(softer, strains.softer), harder: factor(harder, strains.harder) };
        let got = Guess { strains, factors };
        if got.is_close(&guess, if steps < MANY { CLOSE } else { ROUGH }) {
            return Some(InImpact { factors, strains, loading_time, steps });
        }
        let trial = Trial::new(&guess, &got);
        guess = trial.next(&before, &got, steps);
        before = [Some(trial), before[0]];
    }
    None
}

/// A guess at strains and factors, or what a prediction makes of it.
#[derive(Clone, Copy)]
struct Guess {
    strains: Strains,
    factors: Factors,
}

/// Strains and factors as a list, or their logarithms.
type Numbers = [f64; 4];

impl Guess {
    fn numbers(&self) -> Numbers {
        [self.strains.softer, self.strains.harder, self.factors.softer, self.factors.harder]
    }

    /// The logarithms; zero of a body that is not strained.
    fn logarithms(&self) -> Numbers {
        self.numbers().map(|number| log(if number > 0.0 { number } else { 1.0 }))
    }

    fn is_close(&self, other: &Guess, tolerance: f64) -> bool {
        let mut pairs = self.numbers().into_iter().zip(other.numbers());
        pairs.all(|(one, other)| fabs(one - other) <= tolerance * one)
    }
}

/// A guess, with what a prediction makes of it and the change.
#[derive(Clone, Copy)]
struct Trial {
    from: Numbers,
    to: Numbers,
    change: Numbers,
}

fn difference(one: &Numbers, other: &Numbers) -> Numbers {
    let mut difference = *one;
    difference.iter_mut().zip(other).for_each(|(one, other)| *one -= other);
    difference
}

fn product(one: &Numbers, other: &Numbers) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

impl Trial {
    fn new(guess: &Guess, got: &Guess) -> Trial {
        let (from, to) = (guess.logarithms(), got.logarithms());
        Trial { from, to, change: difference(&to, &from) }
    }

    /// The next guess, after those of `before`, the later one first, where `got` came of this one, the `steps`th.
    fn next(&self, before: &[Option<Trial>; 2], got: &Guess, steps: u32) -> Guess {
        let changes =
            before.map(|old| old.map(|old| (difference(&self.change, &old.change), difference(&self.to, &old.to))));
        let mut next = self.to;
        match changes {
            [None, _] => return *got,
            [Some((change, step)), None] => subtract(&mut next, &step, self.part(&change)),
            [Some((change, step)), Some((older_change, older_step))] => {
                let [one, both, other] = [(&change, &change), (&change, &older_change), (&older_change, &older_change)]
                    .map(|(one, other)| product(one, other));
                let determinant = one * other - both * both;
                let is_plane = determinant > FLAT * one * other;
                let [of_one, of_other] = [&change, &older_change].map(|change| product(&self.change, change));
                let part = |sum: f64, alone: f64| quotient(sum, determinant, is_plane, alone);
                subtract(&mut next, &step, part(of_one * other - of_other * both, self.part(&change)));
                subtract(&mut next, &older_step, part(of_other * one - of_one * both, 0.0));
            }
        }
        // where that leads nowhere, a part of the way, since the stronger a body, the less it is strained; smaller ones in every other
        // block of steps, to come near from far away
        let block = steps / MANY;
        let part = 1.0 / f64::from(2 + 3 * block);
        let falls =
            before[0].is_some_and(|old| product(&self.change, &self.change) < product(&old.change, &old.change));
        let mut numbers = next.into_iter().zip(self.from).zip(self.to).zip(got.numbers());
        let mut number = |least: f64| {
            let (((next, from), to), plain) = numbers.next()?;
            let next = if falls && block.is_multiple_of(2) && fabs(next - from) < FARTHEST {
                next
            } else {
                from + part * (to - from)
            };
            Some(if plain > 0.0 { largest(exp(next), least) } else { plain })
        };
        let mut number = |least: f64, plain: f64| number(least).unwrap_or(plain);
        Guess {
            strains: Strains { softer: number(0.0, got.strains.softer), harder: number(0.0, got.strains.harder) },
            factors: Factors { softer: number(1.0, got.factors.softer), harder: number(1.0, got.factors.harder) },
        }
    }

    /// The part of a `change` that comes nearest to the own one.
    fn part(&self, change: &Numbers) -> f64 {
        let square = product(change, change);
        quotient(product(&self.change, change), square, square > f64::MIN_POSITIVE, 0.0)
    }
}

fn subtract(numbers: &mut Numbers, step: &Numbers, part: f64) {
    numbers.iter_mut().zip(step).for_each(|(number, step)| *number -= part * step);
}

/// Tabor's strains of the two bodies at the largest indentation of a `prediction` with this model.
pub fn strains<L: Loading, U>(model: &super::Model<L, U>, prediction: &Prediction) -> Strains {
    let share = model.loading.share(&model.pair, prediction.max_indentation);
    strains_of(prediction.max_contact_radius / model.pair.radius, share)
}

/// Tabor's strains at a contact radius over `R`, where the softer body takes on this `share` of the curvature. That of a rigid other body
/// is 1 but for rounding.
fn strains_of(width: f64, share: f64) -> Strains {
    Strains { softer: share * TABOR * width, harder: largest(1.0 - share, 0.0) * TABOR * width }
}

/// The bodies in contact and their laws, with what else a contact of constant strength has.
pub trait Slow: Copy {
    /// The loading law.
    type Loading: Loading + Copy;

    /// The unloading law.
    type Unloading: Unloading + Copy;

    /// The elastoplastic part.
    fn plastic(&mut self) -> &mut super::Model<Self::Loading, Self::Unloading>;
}

impl<L: Loading + Copy, U: Unloading + Copy> Slow for super::Model<L, U> {
    type Loading = L;
    type Unloading = U;

    fn plastic(&mut self) -> &mut super::Model<L, U> {
        self
    }
}

impl<L: Loading + Copy, U: Unloading + Copy, X: Copy> Slow for losses::Model<L, U, X> {
    type Loading = L;
    type Unloading = U;

    fn plastic(&mut self) -> &mut super::Model<L, U> {
        &mut self.plastic
    }
}

/// The bodies in contact, their quasi-static law, and how they resist fast indentation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model<M> {
    /// The bodies and their laws under a slow load.
    pub slow: M,
    /// The strength of the softer body over the strain rate.
    pub rate: Rate,
    /// That of the harder body, which only the law `brinell` asks for.
    pub harder: Rate,
}

impl<M: Slow> Model<M> {
    /// The bodies with these factors on their strengths.
    pub fn at(&self, Factors { softer, harder }: Factors) -> M {
        let mut strong = self.slow;
        let plastic = strong.plastic();
        plastic.pair.yield_strength *= softer;
        plastic.loading = plastic.loading.strengthened_by(softer, harder);
        strong
    }

    /// The elastoplastic part of these bodies.
    pub fn plastic_at(&self, factors: Factors) -> super::Model<M::Loading, M::Unloading> {
        *self.at(factors).plastic()
    }

    /// About the strains and factors of an `impact` in which the softer body flows everywhere below the contact at [Tabor's](TABOR) mean
    /// pressure, three times its strength: `a^2 = 2 R d`, and a quarter of a period under a force that is proportional to `d`.
    fn guess(&self, impact: &Impact) -> (Strains, Factors) {
        let pair = { self.slow }.plastic().pair;
        let Pair { radius, yield_strength, .. } = pair;
        let (mut strains, mut factors) = (FIRST, Factors::SLOW);
        for _ in 0..GUESSES {
            let stiffness = 6.0 * PI * radius * yield_strength * factors.softer;
            let deepest = sqrt(2.0 * impact.energy() / stiffness);
            strains = strains_of(sqrt(2.0 * deepest / radius), pair.share());
            let time = 0.5 * PI * sqrt(impact.mass / stiffness);
            let factor = |rate: &Rate, strain: f64| {
                let factor = rate.factor(strain / time);
                if are_factors(Factors { softer: factor, harder: factor }) { factor } else { 1.0 }
            };
            factors =
                Factors { softer: factor(&self.rate, strains.softer), harder: factor(&self.harder, strains.harder) };
        }
        (strains, factors)
    }

    /// The strength in an `impact`, in which a loss below yield doesn't count; `None` where it cannot be predicted.
    pub fn in_impact(&self, impact: &Impact) -> Option<InImpact> {
        in_impact([Some(&self.rate), Some(&self.harder)], self.guess(impact), |_, factors| {
            let Impact { mass, speed } = *impact;
            let model = self.plastic_at(factors).prepared_for(impact.energy());
            let (_, deepest) = impact::turning_point(&model, impact)?;
            // with a constant force it would be twice as long as without any
            let longest = 4.0 * deepest / speed;
            let loading_time = time_to_turn(&model, &ExternalLoad { mass, acceleration: 0.0 }, speed, longest)?;
            let (radius, share) = model.loading.width(&model.pair, deepest);
            Some((loading_time, strains_of(radius / model.pair.radius, share)))
        })
    }
}
