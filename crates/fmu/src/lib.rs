//! Co-simulation of contacts, and the C functions of an FMU for any scene.
//!
//! | module | content |
//! |---|---|
//! | [`scene`] | the contacts, laws and variables: a trait, and the scene of a prebuilt library |
//! | [`instance`] | co-simulation as safe Rust: phase, time, variables, step, reset |
//! | [`c`] | what every C interface needs: pointers, memory, text, states |
//! | [`fmi2`] | the C interface of FMI 2.0 |
//!
//! Each uses only the ones above it, and the physics, [`brinell_contact`]. Only [`c`] and [`fmi2`] have `unsafe` code. The crate
//! needs neither `std` nor `alloc`, and cannot panic.
//!
//! # Reference
//! *Functional Mock-up Interface for Model Exchange and Co-Simulation*, version 2.0.5.
#![cfg_attr(not(test), no_std)]
#![deny(unsafe_code)]
#![deny(rustdoc::broken_intra_doc_links)]
#![warn(missing_docs)]

/// The physics: the macros for scenes name it.
#[doc(hidden)]
pub use brinell_contact as contact;

pub mod c;
pub mod fmi2;
pub mod instance;
pub mod scene;
