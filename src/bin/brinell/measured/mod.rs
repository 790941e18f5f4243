//! A user's own measurement, and the parameters of a scene that explain it.

mod fit;
mod flow;
mod read;
#[cfg(test)]
mod tests;

pub use fit::{Estimate, Fit, Fitted, fit};
pub use flow::Flow;
pub use read::{Kind, Measured, MeasuredError, read};
