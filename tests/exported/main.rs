//! Exported FMUs, and the program that exports them. Each file is a topic.
//!
//! `cargo test --release --test exported every_law` runs one of them.

use brinell_testing::{
    archive, both_ways, command, courses, hostile, hosts, kinds, loaded, physics, prebuilt, skips, unit, written,
};

/// Cargo builds the program before these tests; without its feature they do not compile.
const _: &str = env!("CARGO_BIN_EXE_brinell");

mod bad_units;
mod contact_groups;
mod contacts;
mod cylinders;
mod descriptions;
mod elastic_unit;
mod ellipses;
mod every_law;
mod export;
mod friction_derivatives;
mod friction_two_unit;
mod friction_unit;
mod guarded_units;
mod hardening;
mod law_energy;
mod law_parameters;
mod library;
mod long_messages;
mod loss_parameters;
mod own_curve;
mod prebuilt_libraries;
mod prebuilt_refusals;
mod rebounds;
mod several_contacts;
mod shared_bodies;
mod shared_friction;
mod ssp;
mod standalone_unit;
mod strain_rate;
mod two_strengths;
mod validity;
