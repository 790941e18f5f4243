//! What the tests share: places and commands, units for tests and their libraries, masters, models and random numbers.

pub mod archive;
pub mod arithmetic;
pub mod browser;
pub mod child;
pub mod command;
pub mod courses;
pub mod debian;
pub mod driver;
pub mod face;
pub mod fmi_crate;
pub mod folder;
pub mod friction;
pub mod functions;
pub mod histories;
pub mod hostile;
pub mod hosts;
pub mod importer;
pub mod importer_table;
pub mod judge;
pub mod kinds;
pub mod laws;
pub mod loaded;
pub mod long;
pub mod masters;
pub mod mutations;
pub mod physics;
pub mod places;
pub mod prebuilt;
pub mod printed;
pub mod programs;
pub mod pytest;
pub mod python;
#[cfg(target_os = "linux")]
pub mod rebuilt;
pub mod refusal;
pub mod scenes;
pub mod schema;
pub mod skips;
pub mod standalone;
pub mod suites;
#[cfg(unix)]
pub mod systems;
pub mod table;
pub mod targets;
pub mod toolchain;
pub mod unit;
#[cfg(unix)]
pub mod windows;
pub mod written;

/// The Rust code of the guide, as tests.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/guide/rust.md")]
mod guide {}

/// The Rust code of the page on friction, as a test.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/guide/friction.md")]
mod friction_in_the_guide {}
