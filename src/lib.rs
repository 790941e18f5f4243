//! Elastoplastic contact of a sphere and a half-space.
#![cfg_attr(not(test), no_std)]
#![warn(missing_docs)]

pub mod contact;
pub mod fault;
#[cfg(feature = "fmu")]
pub mod fmi2;
pub mod instance;
pub mod scene;
