//! The physics: laws, paths, motion, friction and losses, as called from Rust. Each file is a topic.
//!
//! `cargo test --release --test physics law_suite` runs one of them.

use brinell_testing::{arithmetic, friction, physics, printed};

mod arithmetic_modes;
mod corners;
mod damped_laws;
mod dents;
mod ends_of_laws;
mod equal_bodies;
mod friction_contact;
mod friction_growth;
mod friction_histories;
mod friction_impact;
mod friction_measured;
mod friction_passive;
mod friction_plastic;
mod friction_properties;
mod friction_tables;
mod friction_two;
mod friction_two_growth;
mod friction_two_steps;
mod guard;
mod hardening;
mod input_courses;
mod law_big_alabo;
mod law_both;
mod law_brinell;
mod law_brizmer;
mod law_johnson;
mod law_large_strain;
mod law_luding;
mod law_materials;
mod law_pairs;
mod law_suite;
mod law_table;
mod laws_everywhere;
mod losses;
mod losses_cuts;
mod momentum;
mod motion;
mod motion_cuts;
mod motion_events;
mod motion_extremes;
mod motion_flags;
mod motion_mean_force;
mod paths;
mod predictions;
mod properties;
mod published_laws;
mod published_laws_fitted;
mod rate_motion;
mod reference_impacts;
mod reference_values;
mod scale_of_mass;
mod two_roundings;
mod work_counters;
