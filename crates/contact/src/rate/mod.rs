//! Strain rate: the strength of a target in an impact, from its closing speed.
//!
//! The strength is constant within an impact. It is that at the mean strain rate of the loading: Tabor's strain,
//! `0.2 a/R_y` at the largest contact radius, over the time from first contact to that radius. Both depend on the strength,
//! so that it is a fixed point. `R_y` is the radius of the [rigid sphere](super::Pair::indenter_radius) that the yielding body
//! meets.

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

/// Whether a contact may have this strength, relative to the quasi-static one.
fn is_factor(factor: f64) -> bool {
    // a NaN is in no range
    (1.0..=STRONGEST).contains(&factor)
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
    /// Flow stress at a strain rate \[1/s\] relative to the quasi-static one: 1 at least.
    pub fn factor(&self, rate: f64) -> f64 {
        match *self {
            Rate::JohnsonCook { c, reference_rate } => 1.0 + c * largest(log(rate / reference_rate), 0.0),
            Rate::CowperSymonds { d, q } => 1.0 + pow(rate / d, 1.0 / q),
        }
    }
}

/// The strength in an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InImpact {
    /// Flow stress relative to the quasi-static one.
    pub factor: f64,
    /// Tabor's strain.
    pub strain: f64,
    /// Mean strain rate of the loading \[1/s\].
    pub strain_rate: f64,
    /// Number of predictions that it took: at most [`STEPS`].
    pub steps: u32,
}

/// The strength in an impact, for a rigid indenter of this `radius` \[m\] on the body that yields. `predict` is the prediction
/// of the impact for a strain and a factor. Without a `rate` model the factor is 1 and only the strain is found. `None` where a
/// prediction fails.
pub fn in_impact(
    rate: Option<&Rate>,
    radius: f64,
    mut predict: impl FnMut(f64, f64) -> Option<Prediction>,
) -> Option<InImpact> {
    let mut found = InImpact { factor: 1.0, strain: FIRST_STRAIN, strain_rate: 0.0, steps: 0 };
    while found.steps < STEPS {
        let prediction = predict(found.strain, found.factor)?;
        let strain = TABOR * prediction.max_contact_radius / radius;
        let strain_rate = strain / prediction.loading_time;
        let factor = rate.map_or(1.0, |rate| rate.factor(strain_rate));
        let change = largest(fabs(strain / found.strain - 1.0), fabs(factor / found.factor - 1.0));
        found = InImpact { factor, strain, strain_rate, steps: found.steps + 1 };
        if change < CLOSE {
            break;
        }
    }
    Some(found)
}

/// The bodies in contact, their quasi-static law, and how the target resists fast indentation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model<L, U> {
    /// The bodies and the law under a slow load.
    pub slow: super::Model<L, U>,
    /// The strength over the strain rate.
    pub rate: Rate,
}

impl<L: Loading + Copy, U: Unloading + Copy> Model<L, U> {
    /// The law of a target that is `factor` times as strong.
    pub fn at(&self, factor: f64) -> super::Model<L, U> {
        let mut model = self.slow;
        model.pair.yield_strength *= factor;
        model.loading = model.loading.strengthened_by(factor);
        model.unloading = model.unloading.strengthened_by(factor);
        model
    }

    /// The strength in an `impact`; `None` where it cannot be predicted.
    pub fn in_impact(&self, impact: &Impact) -> Option<InImpact> {
        in_impact(Some(&self.rate), self.slow.pair.indenter_radius(), |_, factor| {
            impact::predict(&self.at(factor), impact)
        })
    }
}
