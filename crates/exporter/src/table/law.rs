//! Laws in the tables.

use serde::Deserialize;
use serde::de::IgnoredAny;
use std::collections::BTreeMap;

/// The documentation of a law; see `modelDescription/laws.toml`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Law {
    pub name: String,
    /// Of an unloading law: largest error of the tangential force of one step that grows the dent, relative to Coulomb's
    /// limit.
    pub friction_error: Option<f64>,
    /// The same for loading laws with another one.
    #[serde(default)]
    pub friction_error_of: BTreeMap<String, f64>,
    /// Of an unloading law: the reason why it has no tangential force.
    pub no_friction: Option<String>,
    pub title: String,
    pub formulas: Vec<String>,
    pub notes: String,
    /// The range in which the law was derived or holds, for loading laws.
    #[serde(default)]
    pub validity: String,
    /// Largest and root mean square error of the force of a loading law against finite elements, in words.
    #[serde(default)]
    pub accuracy: String,
    pub reference: String,
    /// The unloading law with which a loading law was published, if any.
    pub unloading: Option<String>,
    /// The reason why a loading law can be combined with no other unloading law.
    pub no_other_unloading: Option<String>,
    /// Whether a loading law is above Hertz's curve in places.
    #[serde(default)]
    pub above_hertz: bool,
    /// Whether an unloading law lowers Hertz's curve to the peak.
    #[serde(default)]
    pub lowers_hertz: bool,
    /// The only loading law with which an unloading law can be combined.
    pub made_for: Option<MadeFor>,
    /// Whether the force of a loading law jumps.
    #[serde(default)]
    pub jumps: bool,
    /// The fraction by which its contact radius falls there: for the tests.
    #[serde(default, rename = "radius_falls_by")]
    _radius_falls_by: IgnoredAny,
    /// Whether the normalised curve of a loading law depends on `E*/S`.
    #[serde(default)]
    pub depends_on_modulus_ratio: bool,
    /// For a loading law that is not passive.
    pub energy: Option<MakesEnergy>,
    /// The constants that a scene can change.
    #[serde(default)]
    pub parameters: Vec<LawParameter>,
    /// Constants that depend on each other, so that a scene cannot change them.
    #[serde(default)]
    pub fixed: Vec<String>,
}

impl Law {
    /// Largest error of the tangential force of one step that grows the dent with this unloading law after the law
    /// `loading`, relative to Coulomb's limit.
    pub fn friction_error_after(&self, loading: &str) -> Option<f64> {
        self.friction_error_of.get(loading).copied().or(self.friction_error)
    }
}

/// The loading law for which an unloading law was made.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MadeFor {
    pub loading: String,
    /// The relation of the unloading law to it: "was fitted to".
    pub because: String,
    /// Constants that both laws have, and that must be equal.
    #[serde(default)]
    pub same: Vec<String>,
    /// Constants of the loading law that the unloading law assumes as published.
    #[serde(default)]
    pub as_published: Vec<String>,
}

/// The range in which a loading law is not passive, and by how much.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MakesEnergy {
    pub why: String,
    /// Largest restitution for targets with a Poisson's ratio of at least 0, with the unloading law with which it was
    /// published, otherwise contact-radius.
    pub restitution: f64,
    /// For targets with a Poisson's ratio below 0.
    pub auxetic_restitution: f64,
    /// Unloading laws with which the dent may be above the original surface where it is not passive.
    #[serde(default)]
    pub dents_above_surface: Vec<String>,
    /// Unloading laws with which it is passive.
    pub passive: Vec<PassiveWith>,
}

/// An unloading law with which a loading law is passive.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PassiveWith {
    pub unloading: String,
    /// The Poisson's ratio of the target from which this holds; `None` if it holds for all.
    pub from_poissons_ratio: Option<f64>,
}

/// A constant of a law that a scene can change.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LawParameter {
    pub name: String,
    /// Unit; empty for a dimensionless number.
    #[serde(default)]
    pub unit: String,
    pub minimum: f64,
    pub maximum: f64,
    /// The parameter of the same law that must be larger.
    pub below: Option<String>,
    pub description: String,
}
