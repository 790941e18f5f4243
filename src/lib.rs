//! Elastoplastic contact of a sphere and a half-space: the physics, and the library of an FMU (FMI 2.0 co-simulation).
//!
//! # Model
//! A sphere of effective radius `R` is pressed into a half-space of effective modulus `E*` and yield strength `S`. The
//! normal force `F` is a function of the indentation and of the largest indentation so far:
//!
//! - *loading* follows the curve of a [loading law](contact::loading): Hertz's until the mean pressure reaches 1.1 S, then
//!   the elastoplastic and the fully plastic branches of the law;
//! - *unloading* follows the curve of an [unloading law](contact::unloading) down to the dent that remains; reloading
//!   follows it back up, and continues along the loading curve.
//!
//! Work, elastic and dissipated energy are functions of the state; nothing is accumulated. At a constant rate over a step, the
//! result does not depend on how the time is divided into steps.
//!
//! # Validity
//! The model is a quasi-static normal contact of a paraboloid, with friction on top: `a/R` up to about 0.3, a contact time that is long
//! compared with the travel time of elastic waves, no hardening, no strain-rate effects. [`contact::validity`] gives the limits
//! as numbers; an FMU logs a warning when it leaves them.
//!
//! # Units
//! SI throughout: m, kg, s, N, Pa, J. The documentation of each public item states its unit.
//!
//! # Example
//! ```
//! use brinell::contact::{Body, History, Model, Pair, Surface, impact, loading::BigAlabo, unloading::ContactRadius};
//!
//! let ball = Body { radius: 5e-3, youngs_modulus: f64::INFINITY, poissons_ratio: 0.0 };
//! let block = Body { radius: f64::INFINITY, youngs_modulus: 206e9, poissons_ratio: 0.3 };
//! let pair = Pair::new(&ball, &block, 300e6).unwrap();
//! let model = Model { pair, loading: BigAlabo::REFERENCE, unloading: ContactRadius, surface: Surface::Dented };
//!
//! let mut history = History::start(&model, 0.0).unwrap();
//! history.advance(&model, 10e-6).unwrap(); // 10 um in
//! history.advance(&model, -1e-6).unwrap(); // 1 um back
//! assert!(history.force() > 0.0 && history.residual_indentation(&model) > 7e-6);
//!
//! let outcome = impact::predict(&model, &impact::Impact { mass: 4.11e-3, speed: 1.0 }).unwrap();
//! assert!((outcome.restitution - 0.4463).abs() < 1e-4);
//! ```
//!
//! # Modules
//! | module | content |
//! |---|---|
//! | [`contact`] | the physics, independent of FMI |
//! | [`scene`] | the contacts, laws and variables: a trait, and the scene of an exported FMU |
//! | [`instance`] | co-simulation as safe Rust: phase, time, variables, step, reset |
//! | `fmi2` (feature `c-interface`) | the C interface, and the only `unsafe` of the library |
//!
//! Each uses only the ones above it. For the physics alone, depend on this crate with `default-features = false`; its only
//! dependency is then `libm`.
//!
//! The library needs neither `std` nor `alloc`, and cannot panic.
//!
//! # References
//! - A. Big-Alabo, P. Harrison, M. P. Cartmell, "Contact model for elastoplastic analysis of half-space indentation by a
//!   spherical impactor", *Computers & Structures* 151 (2015) 20-29.
//! - K. L. Johnson, *Contact Mechanics*, Cambridge University Press, 1985.
//! - *Functional Mock-up Interface for Model Exchange and Co-Simulation*, version 2.0.5.
#![cfg_attr(not(test), no_std)]
#![deny(unsafe_code)]
#![deny(rustdoc::broken_intra_doc_links)]
#![warn(missing_docs)]

pub mod contact;
#[cfg(feature = "c-interface")]
pub mod fmi2;
pub mod instance;
pub mod scene;

/// The Rust code of the guide, as tests.
#[cfg(doctest)]
#[doc = include_str!("../docs/guide/rust.md")]
mod guide {}

/// The Rust code of the page on friction, as a test.
#[cfg(doctest)]
#[doc = include_str!("../docs/guide/friction.md")]
mod friction {}
