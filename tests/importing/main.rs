//! FMUs as importers use them: C programs, fmpy and other tools, engines, and the Python module. Each file is a topic.
//!
//! `cargo test --release --test importing fmpy` runs one of them.

#[path = "../support/command.rs"]
mod command;
#[path = "../support/driver.rs"]
mod driver;
#[path = "../support/fmi_crate.rs"]
mod fmi_crate;
#[path = "../support/importer_table.rs"]
mod importer_table;
#[path = "../support/loaded.rs"]
mod loaded;
#[path = "../support/pytest.rs"]
mod pytest;
#[path = "../support/python.rs"]
mod python;
#[path = "../support/skips.rs"]
mod skips;
#[path = "../support/unit.rs"]
mod unit;

mod abi;
mod c_interface;
mod engines;
mod every_importer;
mod examples;
mod fmpy;
mod friction_importers;
mod python_module;
mod second_importer;
