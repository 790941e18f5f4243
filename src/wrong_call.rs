//! A wrong command line, which has its own exit status.

use std::fmt::Display;

/// Description of the error in the arguments.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct WrongCall(pub String);

impl WrongCall {
    /// For `map_err`.
    pub fn of(error: impl Display) -> WrongCall {
        WrongCall(error.to_string())
    }
}
