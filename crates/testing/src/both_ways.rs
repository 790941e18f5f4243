//! A compiled and a prebuilt FMU of one scene, or two libraries of one FMU: the same calls give the same bits and the same messages.

use super::face::{Variable, attribute};
use super::loaded::{Instance, OK, Unit};
use super::physics::Random;
use super::prebuilt::{export, export_by_kind};
use super::unit;
use std::ffi::c_char;
use std::fs;
use std::path::Path;

/// The two FMUs of a scene.
pub struct Both {
    /// The prebuilt one.
    pub kind: String,
    compiled: Unit,
    prebuilt: Unit,
}

/// The model description of an FMU.
fn description(fmu: &Path) -> String {
    let library = unit::library(fmu);
    let root = library.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
    fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library")
}

impl Both {
    pub fn of(text: String, store: &Path) -> Both {
        let (compiled, (prebuilt, kind)) = (export(&text, None), export_by_kind(&text, store));
        let [one, other] = [&compiled, &prebuilt].map(|fmu| description(fmu));
        assert!(one == other, "the model descriptions differ: {text}");
        assert_eq!(attribute(&one, "guid").expect("a GUID").len(), 32);
        Both { kind, compiled: Unit::open(&compiled), prebuilt: Unit::open(&prebuilt) }
    }

    /// Two libraries of one FMU, which was unpacked at the place of the first.
    pub fn between(native: &Path, other: &Path, kind: &str) -> Both {
        let [compiled, prebuilt] = [native, other].map(|library| Unit::open_library(library, native));
        Both { kind: kind.into(), compiled, prebuilt }
    }

    fn of_causality(&self, causality: &str) -> Vec<&Variable> {
        self.compiled.face.variables.iter().filter(|variable| variable.causality == causality).collect()
    }

    /// Makes the same calls, `calls` in number, on both, and compares all messages and outputs. Returns the number of
    /// messages.
    pub fn compare(&self, calls: usize, random: &mut Random) -> usize {
        let outputs = self.of_causality("output");
        let reals: Vec<u32> = outputs.iter().filter(|output| output.is_real).map(|output| output.reference).collect();
        let numbers: Vec<_> = outputs.iter().filter(|output| !output.is_real).collect();
        let parameters = self.of_causality("parameter");
        let inputs = self.of_causality("input");
        let mut pair = Pair::new(&self.compiled, &self.prebuilt);
        // outputs that the scene does not request are missing, whatever the library supports
        let beyond = self.compiled.face.variables.len() as u32;
        assert_ne!(pair.both(|unit| unit.set(&[beyond], &[1.0])), OK);
        pair.both(|unit| unit.reset());
        pair.begin(&parameters, random);
        let (mut time, mut step) = (0.0, 1e-6);
        let mut depth_of_state = None;
        for _ in 0..calls {
            for input in &inputs {
                let name = input.name.rsplit('.').next().unwrap_or_default();
                let value = match name {
                    "effective_mass" => positive(random, -6.0, 2.0),
                    _ if name.starts_with("inverse_mass") => match is_diagonal(name) {
                        true => positive(random, 0.0, 3.0),
                        false => signed(random, -3.0, -1.0),
                    },
                    // a contact that is moved far at once costs time and tells nothing
                    _ => signed(random, -6.0, 1.0),
                };
                if below(random, 4) != 0 || name == "indentation_rate" {
                    pair.both(|unit| unit.set(&[input.reference], &[value]));
                }
            }
            if below(random, 5) == 0 {
                let derivative = signed(random, 0.0, 6.0);
                pair.both(|unit| unit.set_derivatives(&[0], 1, &[derivative]));
            }
            if below(random, 3) == 0 {
                step = positive(random, -9.0, -4.0);
            }
            if pair.both(|unit| unit.step(time, step)) == OK {
                time += step;
            } else {
                // too deep, or too long: only a reset is possible
                pair.both(|unit| unit.reset());
                pair.begin(&parameters, random);
                (time, depth_of_state) = (0.0, None);
                continue;
            }
            pair.read(|unit, values| unit.get(&reals, values), reals.len());
            for number in &numbers {
                pair.both(|unit| unit.integer(&number.name));
            }
            match below(random, 12) {
                0 => pair.read(|unit, values| unit.output_derivatives(&reals, 1, values), reals.len()),
                1 => pair.read(|unit, values| unit.output_derivatives(&reals, 2, values), reals.len()),
                2 => pair.read(|unit, values| unit.directional(&reals, 0, values), reals.len()),
                3 => {
                    pair.save();
                    depth_of_state = Some(time);
                }
                4 => {
                    if let Some(saved) = depth_of_state {
                        pair.restore();
                        time = saved;
                    }
                }
                5 => {
                    // rejected with the same message
                    let any = &parameters.get(below(random, parameters.len().max(1)));
                    let reference = any.map_or(99, |parameter| parameter.reference);
                    let value = positive(random, -9.0, 12.0);
                    if pair.both(|unit| unit.set(&[reference], &[value])) != OK {
                        pair.both(|unit| unit.reset());
                        pair.begin(&parameters, random);
                        (time, depth_of_state) = (0.0, None);
                    }
                }
                _ => {}
            }
        }
        pair.messages
    }
}

/// Whether this is the name of an inverse mass on the diagonal.
fn is_diagonal(name: &str) -> bool {
    let cell = name.trim_start_matches("inverse_mass").trim_matches(['[', ']']);
    cell.split_once(',').is_some_and(|(row, column)| row == column)
}

/// A random number below `count`.
fn below(random: &mut Random, count: usize) -> usize {
    (random.next() * count as f64) as usize
}

/// A random number between two others.
fn between(random: &mut Random, from: f64, to: f64) -> f64 {
    from + (to - from) * random.next()
}

/// A number of random size, between powers of ten.
fn positive(random: &mut Random, from: f64, to: f64) -> f64 {
    10f64.powf(between(random, from, to))
}

/// The same with a random sign.
fn signed(random: &mut Random, from: f64, to: f64) -> f64 {
    let size = positive(random, from, to);
    if below(random, 2) == 0 { size } else { -size }
}

/// Two instances that receive the same calls.
struct Pair<'a> {
    compiled: Instance<'a>,
    prebuilt: Instance<'a>,
    states: Option<[*mut std::ffi::c_void; 2]>,
    /// Number of messages.
    messages: usize,
}

impl<'a> Pair<'a> {
    fn new(compiled: &'a Unit, prebuilt: &'a Unit) -> Pair<'a> {
        let [mut compiled, mut prebuilt] = [compiled, prebuilt].map(Unit::instantiate);
        compiled.log_everything();
        prebuilt.log_everything();
        Pair { compiled, prebuilt, states: None, messages: 0 }
    }

    /// Makes the same call on both; result and message must be equal.
    fn both<T: PartialEq + std::fmt::Debug>(&mut self, call: impl Fn(&mut Instance) -> T) -> T {
        let [one, other] = [&mut self.compiled, &mut self.prebuilt].map(|unit| {
            unit.take_message();
            (call(unit), unit.take_message())
        });
        assert_eq!(one, other);
        self.messages += usize::from(!one.1.is_empty());
        one.0
    }

    /// Reads the same variables of both; the bits must be equal.
    fn read(&mut self, call: impl Fn(&mut Instance, &mut [f64]) -> i32, count: usize) {
        self.both(|unit| {
            let mut values = vec![0.0; count];
            let status = call(unit, &mut values);
            (status, values.into_iter().map(f64::to_bits).collect::<Vec<_>>())
        });
    }

    /// Sets parameters and initializes, until the parameters are accepted.
    fn begin(&mut self, parameters: &[&Variable], random: &mut Random) {
        self.states = None;
        loop {
            let mut taken = true;
            for parameter in parameters {
                if below(random, 3) == 0 {
                    continue;
                }
                let value = match parameter.name.rsplit('.').next().unwrap() {
                    "poissons_ratio" => between(random, -0.2, 0.5),
                    "initial_gap" => signed(random, -8.0, -5.0),
                    "restitution" => between(random, 0.2, 1.0),
                    _ => parameter.start.expect("every parameter has one") * positive(random, -0.5, 0.5),
                };
                // occasionally beyond the limits
                let (minimum, maximum) = parameter.limits();
                let value = if below(random, 40) == 0 { 2.0 * maximum + 1.0 } else { value.clamp(minimum, maximum) };
                taken &= self.both(|unit| unit.set(&[parameter.reference], &[value])) == OK;
            }
            if taken {
                self.both(|unit| unit.enter_initialization());
                if self.both(|unit| unit.exit()) == OK {
                    return;
                }
            }
            self.both(|unit| unit.reset());
        }
    }

    fn save(&mut self) {
        self.forget();
        let [one, other] = [&self.compiled, &self.prebuilt].map(|unit| {
            let state = unit.save();
            let bytes = unit.bytes(state);
            unit.free(state);
            bytes
        });
        // each goes on from the state of the other
        let taken = |unit: &Instance, bytes: &[c_char]| unit.deserialize(bytes).expect("a state of the same FMU");
        self.states = Some([taken(&self.compiled, &other), taken(&self.prebuilt, &one)]);
    }

    fn restore(&mut self) {
        let [one, other] = self.states.expect("a saved state");
        self.compiled.restore(one);
        self.prebuilt.restore(other);
    }

    fn forget(&mut self) {
        if let Some([one, other]) = self.states.take() {
            self.compiled.free(one);
            self.prebuilt.free(other);
        }
    }
}

impl Drop for Pair<'_> {
    fn drop(&mut self) {
        self.forget();
    }
}
