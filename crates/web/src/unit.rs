//! The FMU of a scene in the page: the code of the libraries, on data that the exporter would write into one of them.
//!
//! A scene of a library is a type, and its data stay where they are as long as the library is loaded. So each scene that runs here takes
//! some memory for ever: the page loads its module anew for each. Tests of instances in Rust run the same code, compiled once.

use brinell_exporter::prebuilt::PrebuiltUnit;
use brinell_fmu::fmi2::component::{instance_in, words_of_instance};
use brinell_fmu::for_library;
use brinell_fmu::instance::{Fault, Instance, Warning};
use brinell_fmu::scene::Real;
use brinell_fmu::scene::Scene;
use brinell_fmu::scene::library::Memory;
use brinell_fmu::scene::library::block::Block;
use brinell_fmu::scene::library::block::Contents;
use std::cell::Cell;

thread_local! {
    /// The block of the scene that runs.
    static BLOCK: Cell<&'static Block> = Cell::new(Box::leak(Box::new(Block::unfilled(LIBRARY))));
}

/// Identifies the library: the data are not checked, since nothing but this page writes them.
const LIBRARY: u64 = 1;

/// The place of the block.
pub struct Place;

impl Memory for Place {
    fn contents() -> Contents<'static> {
        BLOCK.get().contents()
    }

    fn verify() -> Result<(), &'static str> {
        Ok(())
    }
}

/// An instance of the FMU, of whatever kind.
pub trait Unit {
    fn start(&mut self) -> Result<(), Fault>;
    fn set(&mut self, variable: Real, contact: usize, value: f64) -> Result<(), Fault>;
    fn set_derivative(&mut self, contact: usize, order: i32, value: f64) -> Result<(), Fault>;
    fn step(&mut self, time: f64, step: f64) -> Result<(), Fault>;
    fn get(&self, variable: Real, contact: usize) -> f64;
    fn slope(&self, contact: usize) -> Result<f64, Fault>;
    /// What it warns of since the last step.
    fn warning(&mut self) -> Option<Warning>;
}

impl<S: Scene> Unit for Instance<S> {
    fn start(&mut self) -> Result<(), Fault> {
        self.reset()?;
        self.set_experiment(0.0, None)?;
        self.enter_initialization()?;
        self.exit_initialization()
    }

    fn set(&mut self, variable: Real, contact: usize, value: f64) -> Result<(), Fault> {
        self.check_real((variable, contact), value)?;
        self.set_real((variable, contact), value);
        Ok(())
    }

    fn set_derivative(&mut self, contact: usize, order: i32, value: f64) -> Result<(), Fault> {
        let variable = (Real::IndentationRate, contact);
        self.check_input_derivative(variable, order, value)?;
        self.set_input_derivative(variable, order, value);
        Ok(())
    }

    fn step(&mut self, time: f64, step: f64) -> Result<(), Fault> {
        self.do_step(time, step)
    }

    fn get(&self, variable: Real, contact: usize) -> f64 {
        self.real((variable, contact))
    }

    fn slope(&self, contact: usize) -> Result<f64, Fault> {
        self.output_derivative((Real::Force, contact), 1)
    }

    fn warning(&mut self) -> Option<Warning> {
        self.take_miswired().or_else(|| self.take_deep())
    }
}

/// Has the FMU `unit` as the scene of [`Place`] in this thread. Instances of another one must not be used any more.
pub fn place(unit: &PrebuiltUnit) {
    BLOCK.set(Box::leak(Box::new(unit.block(LIBRARY))));
}

/// An instance, or why there is none.
type Made = Result<&'static mut dyn Unit, String>;

/// As many instances of the FMU `unit`, before their start. Those of another FMU must not be used any more.
///
/// # Errors
/// A reason in words, if the page does not know its library.
pub fn instances(unit: &PrebuiltUnit, count: usize) -> Result<Vec<&'static mut dyn Unit>, String> {
    place(unit);
    let name = unit.library.name;
    let make: Option<fn() -> Made> = for_library!(name, Place, made);
    let make = make.ok_or_else(|| format!("the page does not know the library `{name}`"))?;
    (0..count).map(|_| make()).collect()
}

/// An instance of a scene in memory that is never freed, since the scene isn't either.
fn made<S: Scene + 'static>() -> Made {
    S::verify()?;
    let memory = Vec::leak(vec![0; words_of_instance::<S>()]);
    Ok(instance_in::<S>(memory).expect("the memory is as long as it has to be"))
}
