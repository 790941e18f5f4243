//! The program as a user calls it: commands, reports, and difficult surroundings. Each file is a topic.
//!
//! `cargo test --release --test program commands` runs one of them.

#[path = "../support/command.rs"]
mod command;
#[path = "../support/laws.rs"]
#[allow(dead_code)] // the topics use a part of it
mod laws;
#[path = "../support/skips.rs"]
mod skips;
#[path = "../support/unit.rs"]
mod unit;

mod build_failures;
mod commands;
mod isolation;
mod report;
mod report_page;
mod report_peers;
mod strangers;
mod two_bodies_that_yield;
mod writing;
