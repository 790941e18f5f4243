//! What the tables say of laws.

use serde::Deserialize;
use serde::de::IgnoredAny;

/// What the documentation says of a law; see `modelDescription/laws.toml`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Law {
    pub name: String,
    /// What the law is in Rust, and whether it has a form with the passivity guard: for `build/laws.rs`.
    #[serde(rename = "rust")]
    _rust: IgnoredAny,
    #[serde(default, rename = "guarded")]
    _guarded: IgnoredAny,
    pub title: String,
    pub formulas: Vec<String>,
    pub notes: String,
    /// In which range the law was made, or holds; of loading laws.
    #[serde(default)]
    pub validity: String,
    pub reference: String,
    /// The unloading law that a loading law was published with, if it was with one.
    pub unloading: Option<String>,
    /// Why a loading law goes with no other unloading law.
    pub no_other_unloading: Option<String>,
    /// Whether a loading law is above Hertz's curve in places.
    #[serde(default)]
    pub above_hertz: bool,
    /// Whether an unloading law lowers Hertz's curve to the largest load.
    #[serde(default)]
    pub lowers_hertz: bool,
    /// The one loading law that an unloading law goes with.
    pub made_for: Option<MadeFor>,
    /// Whether the force of a loading law jumps, and by which part its contact radius falls: for the tests.
    #[serde(default, rename = "jumps")]
    _jumps: IgnoredAny,
    #[serde(default, rename = "radius_falls_by")]
    _radius_falls_by: IgnoredAny,
    /// Whether the normalised curve of a loading law depends on `E*/S`.
    #[serde(default)]
    pub depends_on_modulus_ratio: bool,
    /// Of a loading law that makes energy.
    pub energy: Option<MakesEnergy>,
    /// What a scene can change.
    #[serde(default)]
    pub parameters: Vec<LawParameter>,
    /// Constants that belong together, so that a scene can't change them.
    #[serde(default)]
    pub fixed: Vec<String>,
}

/// The loading law that an unloading law was made for.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MadeFor {
    pub loading: String,
    /// What the unloading law did with it: "was fitted to".
    pub because: String,
    /// Constants that both have, and that must be the same.
    #[serde(default)]
    pub same: Vec<String>,
    /// Constants of the loading law that the unloading law takes as published.
    #[serde(default)]
    pub as_published: Vec<String>,
}

/// Where a loading law makes energy, and how much.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MakesEnergy {
    pub why: String,
    /// The largest with the unloading law that it was published with, or else contact-radius, of targets with a Poisson's
    /// ratio from 0 on.
    pub restitution: f64,
    /// Of targets with a Poisson's ratio below 0.
    pub auxetic_restitution: f64,
    /// Unloading laws with which it makes none.
    pub passive: Vec<PassiveWith>,
}

/// An unloading law with which a loading law makes no energy.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PassiveWith {
    pub unloading: String,
    /// From which Poisson's ratio of the target on; none if it is so for all.
    pub from_poissons_ratio: Option<f64>,
}

/// A constant of a law that a scene can change.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LawParameter {
    pub name: String,
    /// Empty for a pure number.
    #[serde(default)]
    pub unit: String,
    pub minimum: f64,
    pub maximum: f64,
    /// The parameter of the same law that it must be below.
    pub below: Option<String>,
    pub description: String,
}
