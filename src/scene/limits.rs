//! Ranges of numbers.

use super::error::Mistake;
use crate::numbers::{in_message, out_of_range};
use crate::table;
use std::ops::RangeInclusive;
use toml::Spanned;

/// Rejects a value of the parameter `name` outside its range. `owner` precedes the name in the message.
pub fn check_limits(name: &str, owner: &str, value: &Spanned<f64>) -> Result<(), Mistake> {
    let variable = table::variable(name);
    let allowed = variable.minimum.unwrap_or(f64::MIN)..=variable.maximum.unwrap_or(f64::MAX);
    check_range((name, variable.unit.as_deref().unwrap_or("")), owner, value, allowed)
}

/// Rejects a value with this name and unit unless it is `allowed`. `owner` precedes the name in the message.
pub fn check_range(
    (name, unit): (&str, &str),
    owner: &str,
    value: &Spanned<f64>,
    allowed: RangeInclusive<f64>,
) -> Result<(), Mistake> {
    if allowed.contains(value.get_ref()) {
        return Ok(());
    }
    Err(Mistake(value.span(), format!("{owner}{name} {}", out_of_range(*value.get_ref(), &allowed, unit))))
}

/// Rejects a value with this name unless it is positive and finite.
pub fn positive(name: &str, value: &Spanned<f64>) -> Result<f64, Mistake> {
    let number = *value.get_ref();
    if number > 0.0 && number.is_finite() {
        return Ok(number);
    }
    Err(Mistake(value.span(), format!("{name} = {} must be positive and finite", in_message(number))))
}
