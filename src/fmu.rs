//! The crate of an FMU: the C functions for one scene.
//!
//! The exporter compiles the library of this package once for each system, as the crate `brinell`, and then this small crate for
//! each scene. The compiler optimizes both as one unit. With feature `fmu`, cargo compiles the same files as modules of the library.
#![no_std]

pub use brinell::contact;

/// The scene of this FMU, among the others of the library.
pub mod scene {
    pub use brinell::scene::*;

    #[cfg(not(feature = "prebuilt"))]
    pub mod exported;
    #[cfg(feature = "prebuilt")]
    pub mod kind;
}

/// The C symbols, beside the functions for any scene.
pub mod fmi2 {
    pub use brinell::fmi2::*;

    #[cfg(feature = "prebuilt")]
    pub mod block;
    pub mod exports;
    mod panic;
}
