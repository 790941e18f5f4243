//! FMUs as importers use them: C programs, fmpy and other tools, engines, and the Python module. Each file is a topic.
//!
//! `cargo test --release --test importing fmpy` runs one of them.

use brinell_testing::{debian, prebuilt, pytest, python, skips, unit};

// the C compiler of Unix has one name
#[cfg(unix)]
mod abi;
// among the first in the order of names: making the page takes minutes, beside which the others run
mod browser;
mod c_interface;
mod engines;
mod every_importer;
mod examples;
mod fmpy;
mod numbers_in_engines;
mod python_module;
