//! The program as a user calls it: commands, reports, and difficult surroundings. Each file is a topic.
//!
//! `cargo test --release --test program commands` runs one of them.

use brinell_testing::{archive, command, laws, prebuilt};

mod build_failures;
mod calls;
mod commands;
mod isolation;
mod own_data;
mod parts;
mod plates;
mod report;
mod report_page;
mod rods;
mod sentences;
mod strangers;
mod two_bodies_that_yield;
mod writing;
