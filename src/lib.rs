//! Elastoplastic contact of a sphere and a half-space.
#![no_std]
#![warn(missing_docs)]

pub mod contact;
