//! The library of an FMU: the C functions for one scene.
//!
//! The exporter compiles the physics and the functions for any scene once for each system, and then this small crate for each
//! scene. The compiler optimizes all of them as one unit.
//!
//! # Example
//! The scene in the source tree is that of `scenes/steel_ball.toml`. Its instance is an ordinary value:
//! ```
//! use brinell_fmu::instance::Instance;
//! use brinell_fmu::scene::Real;
//! use brinell_unit::known::Exported;
//!
//! let mut instance = Instance::<Exported>::new().unwrap();
//! instance.set_experiment(0.0, None).unwrap();
//! instance.enter_initialization().unwrap();
//! instance.exit_initialization().unwrap();
//! instance.set_real((Real::IndentationRate, 0), 0.1);
//! instance.do_step(0.0, 1e-4).unwrap();
//! assert!(instance.real((Real::Force, 0)) > 200.0);
//! ```
#![no_std]
#![allow(non_snake_case, clippy::missing_safety_doc)]
#![warn(missing_docs)]

#[cfg(feature = "prebuilt")]
mod block;
#[cfg(not(feature = "prebuilt"))]
pub mod exported;
#[cfg(feature = "cdylib")]
mod exports;
#[cfg(feature = "prebuilt")]
pub mod kind;
#[cfg(not(feature = "prebuilt"))]
pub mod known;
#[cfg(all(feature = "prebuilt", target_arch = "wasm32"))]
mod module;
#[cfg(feature = "cdylib")]
mod panic;
#[cfg(all(feature = "cdylib", windows, target_env = "msvc", target_arch = "x86_64"))]
mod stack;
