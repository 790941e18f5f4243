//! Libraries for other systems, unusual hosts, and the program as it is installed. Each file is a topic.
//!
//! `cargo test --release --test platforms wheel` runs one of them.

mod c_source;
mod cross_compiled;
mod elsewhere;
mod first_export;
mod kinds_of_hosts;
mod other_systems;
mod portable;
#[cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]
mod unpacked;
mod wheel;
