//! A row of the table that compares an impact with its prediction.

use serde::Serialize;

/// One quantity, predicted and from the co-simulation. Those of an oblique impact are predicted by the springs of the
/// library.
#[derive(Debug, Serialize)]
pub struct Row {
    pub quantity: &'static str,
    pub unit: &'static str,
    pub predicted: f64,
    pub simulated: f64,
    /// Difference relative to the predicted value or to `scale`.
    pub difference: f64,
}

impl Row {
    /// A row whose difference is relative to `scale`.
    pub fn new(quantity: &'static str, unit: &'static str, predicted: f64, simulated: f64, scale: f64) -> Row {
        Row { quantity, unit, predicted, simulated, difference: (simulated - predicted) / scale }
    }
}
