//! A user's own measurement, and the parameters of a scene that explain it.

mod fit;
mod flow;
mod parameter;
mod problem;
mod read;
#[cfg(test)]
mod tests;

pub use fit::{Estimate, Fitted, fit};
pub use flow::Flow;
pub use parameter::Fit;
pub use read::{Kind, Measured, MeasuredError, read};
