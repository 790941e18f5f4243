//! Exported FMUs, and the program that exports them. Each file is a topic.
//!
//! `cargo test --release --test exported differential` runs one of them.

use brinell_testing::{
    archive, command, courses, histories, hostile, hosts, kinds, loaded, physics, prebuilt, skips, unit, written,
};

/// Cargo builds the program before these tests; without its feature they do not compile.
const _: &str = env!("CARGO_BIN_EXE_brinell");

mod any_scene;
mod bad_units;
mod descriptions;
mod differential;
mod equalities;
mod export;
mod laws;
mod library;
mod long_messages;
mod prebuilt_libraries;
mod several_contacts;
mod shared_bodies;
mod ssp;
mod standalone_unit;
