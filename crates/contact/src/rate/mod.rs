//! Strain rate: the strength of a target in an impact, from its closing speed.
//!
//! The strength is constant within an impact. It is that at the mean strain rate of the loading: Tabor's strain,
//! `0.2 a/R_i` at the largest contact radius, over the time from first contact to that radius. Both depend on the strength,
//! so that it is a fixed point. `R_i` is the radius of the rigid sphere that a body [sees](Loading::share): each of the two bodies has
//! its own strain, strain rate and strength.

mod behaviour;
mod follow;
pub mod history;

pub use follow::follow;
pub use history::History;

use super::impact::{self, Impact, Prediction};
use super::loading::Loading;
use super::numbers::largest;
use super::unloading::Unloading;
use libm::{fabs, log, pow};

/// Factor of Tabor's representative strain: strain over (contact radius over radius of the rigid indenter).
///
/// Reference: D. Tabor, *The Hardness of Metals*, Oxford 1951, chapter V.
pub const TABOR: f64 = 0.2;

/// The initial strain of the search.
pub const FIRST_STRAIN: f64 = 0.05;

/// Relative tolerance of the fixed point for factor and strain.
const CLOSE: f64 = 1e-12;

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

/// The strength in an impact, by the rate models of the softer and of the harder body. `predict` gives the prediction of the impact
/// for strains and factors, and the strains that it has. Without a model the factor is 1 and only the strain is found. `None` where a
/// prediction fails.
pub fn in_impact(
    [softer, harder]: [Option<&Rate>; 2],
    mut predict: impl FnMut(Strains, Factors) -> Option<(Prediction, Strains)>,
) -> Option<InImpact> {
    let strains = Strains { softer: FIRST_STRAIN, harder: FIRST_STRAIN };
    let mut found = InImpact { factors: Factors::SLOW, strains, loading_time: 0.0, steps: 0 };
    while found.steps < STEPS {
        let (Prediction { loading_time, .. }, strains) = predict(found.strains, found.factors)?;
        let factor = |rate: Option<&Rate>, strain: f64| rate.map_or(1.0, |rate| rate.factor(strain / loading_time));
        let factors = Factors { softer: factor(softer, strains.softer), harder: factor(harder, strains.harder) };
        let is_close = |one: f64, other: f64| fabs(one - other) <= CLOSE * other;
        let is_found = is_close(strains.softer, found.strains.softer)
            && is_close(strains.harder, found.strains.harder)
            && is_close(factors.softer, found.factors.softer)
            && is_close(factors.harder, found.factors.harder);
        found = InImpact { factors, strains, loading_time, steps: found.steps + 1 };
        if is_found {
            break;
        }
    }
    Some(found)
}

/// Tabor's strains of the two bodies at the largest indentation of a `prediction` with this model.
pub fn strains<L: Loading, U>(model: &super::Model<L, U>, prediction: &Prediction) -> Strains {
    let share = model.loading.share(&model.pair, prediction.max_indentation);
    let whole = TABOR * prediction.max_contact_radius / model.pair.radius;
    Strains { softer: share * whole, harder: (1.0 - share) * whole }
}

/// The bodies in contact, their quasi-static law, and how they resist fast indentation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model<L, U> {
    /// The bodies and the law under a slow load.
    pub slow: super::Model<L, U>,
    /// The strength of the softer body over the strain rate.
    pub rate: Rate,
    /// That of the harder body, which only the law `brinell` asks for.
    pub harder: Rate,
}

impl<L: Loading + Copy, U: Unloading + Copy> Model<L, U> {
    /// The law of bodies with these factors on their strengths.
    pub fn at(&self, Factors { softer, harder }: Factors) -> super::Model<L, U> {
        let mut model = self.slow;
        model.pair.yield_strength *= softer;
        model.loading = model.loading.strengthened_by(softer, harder);
        model.unloading = model.unloading.strengthened_by(softer, harder);
        model
    }

    /// The strength in an `impact`; `None` where it cannot be predicted.
    pub fn in_impact(&self, impact: &Impact) -> Option<InImpact> {
        in_impact([Some(&self.rate), Some(&self.harder)], |_, factors| {
            let model = self.at(factors);
            let prediction = impact::predict(&model, impact)?;
            Some((prediction, strains(&model, &prediction)))
        })
    }
}
