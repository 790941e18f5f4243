//! Ranges of numbers.

use super::error::Mistake;
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
    let (given, minimum, maximum) = (value.get_ref(), allowed.start(), allowed.end());
    let message = format!("{owner}{name} = {given:?} is out of range: allowed is {minimum:?} to {maximum:?} {unit}");
    Err(Mistake(value.span(), message.trim_end().into()))
}

/// Rejects a value with this name unless it is positive and finite.
pub fn positive(name: &str, value: &Spanned<f64>) -> Result<f64, Mistake> {
    let number = *value.get_ref();
    if number > 0.0 && number.is_finite() {
        return Ok(number);
    }
    Err(Mistake(value.span(), format!("{name} = {number:?} must be positive and finite")))
}
