//! The tables of this folder as texts, and what every FMU has besides: so that packages of the crates carry them.
#![no_std]

/// The variables, their units, ranges and descriptions.
pub const VARIABLES: &str = include_str!("variables.toml");

/// The units, and what they are in base units.
pub const UNITS: &str = include_str!("units.toml");

/// The materials, each with its source.
pub const MATERIALS: &str = include_str!("materials.toml");

/// The contact laws: titles, references, constants, pairings.
pub const LAWS: &str = include_str!("laws.toml");

/// The licenses of the code in the library of an FMU.
pub const LICENSES: &str = include_str!("licenses.txt");

/// The picture of an FMU, as PNG.
pub const ICON: &[u8] = include_bytes!("model.png");
