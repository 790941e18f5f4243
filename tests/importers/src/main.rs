//! Runs an FMU with the `fmi` crate: `second-importer UNIT HISTORY`.
//!
//! Each line of HISTORY contains an indentation rate [m/s] and a step [s]. For each step, the program prints the force at its
//! end, as the 16 hexadecimal digits of its bits.

use fmi::fmi2::import::Fmi2Import;
use fmi::fmi2::instance::{CoSimulation, Common};
use fmi::traits::FmiImport;
use std::env;
use std::error::Error;
use std::fs;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<_> = env::args().skip(1).collect();
    let [unit, history] = &arguments[..] else { return Err("usage: second-importer UNIT HISTORY".into()) };
    let import: Fmi2Import = fmi::import::from_path(unit)?;
    let reference = |name: &str| {
        let variables = &import.model_description().model_variables.variables;
        // of the first contact, if there are several
        let found = variables.iter().find(|variable| variable.name.rsplit('.').next() == Some(name));
        found.map(|variable| variable.value_reference).ok_or(format!("{unit} has no variable {name}"))
    };
    let (rate, force) = (reference("indentation_rate")?, reference("force")?);

    let mut instance = import.instantiate_cs("second importer", false, true)?;
    instance.setup_experiment(None, 0.0, None)?;
    instance.enter_initialization_mode()?;
    instance.exit_initialization_mode()?;
    let mut time = 0.0;
    for line in fs::read_to_string(history)?.lines() {
        let (speed, step) = line.split_once(' ').ok_or("a line is a rate and a step")?;
        let (speed, step): (f64, f64) = (speed.parse()?, step.parse()?);
        instance.set_real(&[rate], &[speed])?;
        instance.do_step(time, step, true)?;
        time += step;
        let mut value = [0.0];
        instance.get_real(&[force], &mut value)?;
        println!("{:016x}", value[0].to_bits());
    }
    instance.terminate()?;
    Ok(())
}
