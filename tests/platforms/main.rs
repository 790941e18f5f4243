//! Libraries for other systems, unusual hosts, and the program as it is installed. Each file is a topic.
//!
//! `cargo test --release --test platforms cross_compiled wheel` runs one of them.

#[path = "../support/command.rs"]
mod command;
#[path = "../support/courses.rs"]
mod courses;
#[path = "../support/debian.rs"]
mod debian;
#[path = "../support/hosts.rs"]
mod hosts;
#[path = "../support/kinds.rs"]
mod kinds;
#[path = "../support/prebuilt.rs"]
mod prebuilt;
#[path = "../support/programs.rs"]
mod programs;
#[path = "../support/python.rs"]
mod python;
#[path = "../support/skips.rs"]
mod skips;
#[path = "../support/standalone.rs"]
mod standalone;
#[path = "../support/systems.rs"]
mod systems;
#[path = "../support/toolchain.rs"]
mod toolchain;
#[path = "../support/unit.rs"]
mod unit;

mod arm64_program;
mod cross_compiled;
mod first_export;
mod kinds_of_hosts;
mod other_systems;
mod wheel;
mod windows_program;
