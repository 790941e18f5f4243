//! The kind of this library, if it is a prebuilt one.
//!
//! `brinell prebuild` writes this file for every library that it builds. The file in the source tree is that of the kind `state`,
//! without identification; a test compares it with the output of the program.

/// The kind.
pub type Library = brinell_fmu::scene::library::kinds::State;

/// A hash of the sources of the library.
pub const MADE_FROM: &str = "unpacked";
