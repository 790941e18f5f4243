//! One unit with many contacts.

use super::build::{Exported, compile, export};
use super::figure::{STEP, STEPS, share};
use super::heap;
use super::sampling::interleaved;
use super::unit::{Instance, State, Unit, ok};
use std::fs;
use std::hint::black_box;
use std::path::Path;
use std::ptr::null_mut;
use std::time::{Duration, Instant};

/// Contact steps in all samples of a unit together.
const WORK: usize = 50_000_000;

/// The fewest and the most samples.
const ROUNDS: [usize; 2] = [5, 200];

/// The scene of the other units, with `count` contacts.
fn scene(count: usize) -> String {
    let one = include_str!("../../scenes/steel_ball.toml");
    format!("{one}\n[[contact]]\nname = \"contact\"\ncount = {count}\n")
}

/// A unit with many contacts, and the one that is written by hand in C.
pub struct ManyUnits {
    pub exported: Exported,
    pub units: [Unit; 2],
}

impl ManyUnits {
    /// # Errors
    /// What the program says if it refuses the scene.
    pub fn build(count: usize, folder: &Path) -> Result<ManyUnits, String> {
        let path = folder.join(format!("contacts_of_{count}.toml"));
        fs::write(&path, scene(count)).expect("the folder can be written to");
        let exported = export(&path, folder)?;
        let c = compile("contacts", count, &exported, folder);
        let units = [&exported.library, &c].map(|library| Unit::open(library, &exported.guid));
        Ok(ManyUnits { exported, units })
    }
}

/// An instance with what its importer keeps for it: references and values, side by side.
pub struct Many<'unit> {
    instance: Instance<'unit>,
    /// Memory that the instance has taken [bytes].
    pub heap: Option<usize>,
    untouched: State,
    inputs: Vec<u32>,
    forces: Vec<u32>,
    shares: Vec<f64>,
    rates: Vec<f64>,
    results: Vec<f64>,
}

impl<'unit> Many<'unit> {
    pub fn of(unit: &'unit Unit, count: usize) -> Many<'unit> {
        let before = heap::in_use();
        let instance = unit.instance();
        let heap = heap::in_use().zip(before).map(|(after, before)| after - before);
        let mut untouched = null_mut();
        ok(instance.save(&mut untouched));
        // inputs come first, forces next
        let last = u32::try_from(count).expect("a number of contacts");
        Many {
            instance,
            heap,
            untouched,
            inputs: (0..last).collect(),
            forces: (last..2 * last).collect(),
            shares: (0..count).map(share).collect(),
            rates: vec![0.0; count],
            results: vec![0.0; count],
        }
    }

    pub fn contacts(&self) -> usize {
        self.inputs.len()
    }

    /// Time of an impact in [`STEPS`] steps of all contacts: set all rates, step, get all forces. Writing the rates down
    /// is part of it. `look` sees the forces of the first and of the last contact after each step.
    pub fn impact(&mut self, rates: &[f64], mut look: impl FnMut([f64; 2])) -> Duration {
        ok(self.instance.restore(self.untouched));
        let mut status = 0;
        let start = Instant::now();
        for (index, &rate) in rates.iter().enumerate() {
            for (value, share) in self.rates.iter_mut().zip(&self.shares) {
                *value = rate * share;
            }
            status |= self.instance.set_all(&self.inputs, &self.rates);
            status |= self.instance.step(index as f64 * STEP, STEP);
            status |= self.instance.get_all(&self.forces, &mut self.results);
            let forces = black_box(&self.results);
            look([forces[0], forces[forces.len() - 1]]);
        }
        let time = start.elapsed();
        ok(status);
        time
    }
}

/// Times for each contact and step [ns].
pub fn times(units: &mut [Many; 2], rates: &[f64]) -> [f64; 2] {
    let steps = units[0].contacts() * STEPS;
    let rounds = (WORK / steps).clamp(ROUNDS[0], ROUNDS[1]);
    interleaved(rounds, |number, _| units[number].impact(rates, |_| ()).as_nanos() as f64 / steps as f64)
}

impl Drop for Many<'_> {
    fn drop(&mut self) {
        self.instance.free(&mut self.untouched);
    }
}
