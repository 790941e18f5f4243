//! The numbers of a scene: their units, and the values that are allowed.

use crate::mistake::{Mistake, POSITIVE, Spanned, check_range};
use crate::table::{VARIABLES, Variable};
use std::ops::RangeInclusive;

/// What a number of a scene is.
pub struct Quantity {
    /// Its SI unit; dimensionless numbers have none.
    pub unit: Option<&'static str>,
    /// The allowed values, as far as they depend on no other key.
    pub allowed: RangeInclusive<f64>,
}

/// Any number.
const ANY: RangeInclusive<f64> = f64::MIN..=f64::MAX;

/// A product of inertia, a number without a key.
pub const PRODUCT: &str = "product of inertia";

/// Stresses \[Pa\].
const STRESSES: RangeInclusive<f64> = 1e-6..=1e18;

/// Hardening exponents of tension.
const EXPONENTS: RangeInclusive<f64> = 0.0..=0.6;

/// The number `key` in a table that is called `table`, or `""` at the top.
pub fn quantity_of(table: &str, key: &str) -> Quantity {
    let (unit, allowed) = match (table, key) {
        // a law has its own constants
        ("loading_parameters" | "unloading_parameters", _) => ("", ANY),
        ("power_law" | "tension", "coefficient") | (_, "tensile_strength" | "proof_stress" | "true_stress") => {
            ("Pa", STRESSES)
        }
        (_, "true_strain" | "plastic_strain") => ("", 1e-9..=10.0),
        ("power_law", "exponent") => ("", 0.0..=0.9),
        ("tension", "exponent") | (_, "hardening_exponent") => ("", EXPONENTS),
        // and below Young's modulus
        (_, "tangent_modulus") => ("Pa", 0.0..=f64::MAX),
        ("rate", "c") => ("", 0.0..=1.0),
        ("rate", "reference_rate") => ("1/s", 1e-9..=1e9),
        ("rate", "d") => ("1/s", 1e-9..=1e15),
        ("rate", "q") => ("", 0.5..=100.0),
        // from thin gases to beyond any solid
        (_, "density") => ("kg/m^3", 1e-3..=1e9),
        ("body", "mass") => return quantity_of("", "effective_mass"),
        (_, "mass") => ("kg", POSITIVE),
        (_, "speed") => ("m/s", POSITIVE),
        (_, "drop_height") => ("m", POSITIVE),
        (_, "length" | "gauge_length" | "thickness") => ("m", 1e-9..=1e6),
        // below, a contact at first yield is as wide as the body
        (_, "size_constant") => ("", 3.0..=100.0),
        (_, "area" | "section") => ("m^2", 1e-18..=1e12),
        (_, "arms") => ("m", -1e6..=1e6),
        (_, "step_size" | "stop_time") => ("s", 1e-30..=1e30),
        (_, "inertia") => ("kg.m^2", 1e-60..=1e60),
        (_, PRODUCT) => ("kg.m^2", -1e60..=1e60),
        _ => {
            let is = |name: &str| name.split_once('.').unwrap_or(("", name)) == (table, key);
            let is_key = |name: &str| name.rsplit('.').next() == Some(key);
            let find = |is: &dyn Fn(&str) -> bool| VARIABLES.iter().find(|variable| is(&variable.name));
            let found = find(&is).or_else(|| find(&is_key));
            let limit = |limit: fn(&Variable) -> Option<f64>| found.and_then(limit);
            let allowed = limit(|of| of.minimum).unwrap_or(f64::MIN)..=limit(|of| of.maximum).unwrap_or(f64::MAX);
            (found.and_then(|of| of.unit.as_deref()).unwrap_or(""), allowed)
        }
    };
    Quantity { unit: Some(unit).filter(|unit| !unit.is_empty()), allowed }
}

/// Rejects a value of the number `name`, with or without its table, unless it is allowed. `owner` precedes the name in the message.
pub fn check_quantity(name: &str, owner: &str, value: &Spanned<f64>) -> Result<(), Mistake> {
    let (table, key) = name.rsplit_once('.').unwrap_or(("", name));
    let Quantity { unit, allowed } = quantity_of(table, key);
    check_range((name, unit.unwrap_or("")), owner, value, allowed)
}
