//! A wrong command line, which ends the program with a status of its own.

use std::fmt::Display;

/// What is wrong with the arguments of the program, in words.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct WrongCall(pub String);

impl WrongCall {
    /// For `map_err`.
    pub fn of(error: impl Display) -> WrongCall {
        WrongCall(error.to_string())
    }
}
