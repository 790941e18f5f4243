//! Random histories of calls, played on several ways to run one FMU: every answer is the same to the bit, and so is every message.
//!
//! A way is a library through its C interface, or whatever else answers a [`Call`]. One of them is [restored](Detour) again and again, so
//! that a state that forgets something shows.

use super::face::{Face, attribute};
use super::loaded::{Instance, OK, Unit};
use super::physics::Random;
use super::prebuilt::{export, export_by_kind};
use super::unit;
use brinell_fmu::fmi2::abi::fmi2FMUstate;
use std::ffi::c_char;
use std::fs;
use std::path::Path;

/// A call of an instance.
#[derive(Clone, Debug)]
pub enum Call {
    /// Defines an experiment from 0 s, and enters Initialization Mode.
    Enter,
    Exit,
    Reset,
    Set(Vec<(u32, f64)>),
    /// Derivatives of this order of inputs.
    Derivatives(i32, Vec<(u32, f64)>),
    /// A step from this time, of this length \[s\].
    Step(f64, f64),
    Reals(Vec<u32>),
    Integers(Vec<u32>),
    /// Derivatives of this order of outputs over time.
    Slopes(i32, Vec<u32>),
    /// Derivatives of outputs by this input.
    By(u32, Vec<u32>),
    /// The words of the state, which is kept.
    Save,
    /// Back to the state that was kept.
    Restore,
    /// A [`Detour`], if this way makes them.
    Detour(Detour),
}

/// What must change nothing.
#[derive(Clone, Copy, Debug)]
pub enum Detour {
    /// The state goes into another instance, as bytes.
    Bytes,
    /// The instance goes on, and returns to its state.
    Away,
}

/// What a way answers.
#[derive(Debug, PartialEq)]
pub struct Answer {
    pub is_done: bool,
    pub bits: Vec<u64>,
    /// The last message, of a way that has words.
    pub words: Option<String>,
}

/// A way to run an FMU.
pub trait Way {
    fn answer(&mut self, call: &Call) -> Answer;
}

/// The words of the instance in a serialized state, between magic, identity, count and checksum.
fn words_of(bytes: &[c_char]) -> Vec<u64> {
    let words = bytes.chunks_exact(8).map(|word| u64::from_le_bytes(std::array::from_fn(|at| word[at] as u8)));
    let all: Vec<u64> = words.collect();
    all[3..all.len() - 1].into()
}

/// The bits of numbers; those of derivatives don't tell the sign of zero.
fn bits(numbers: impl IntoIterator<Item = f64>) -> Vec<u64> {
    numbers.into_iter().map(|number| (number + 0.0).to_bits()).collect()
}

/// An instance of a library, through its C interface.
pub struct ByC<'a> {
    unit: &'a Unit,
    instance: Instance<'a>,
    kept: Option<fmi2FMUstate>,
    makes_detours: bool,
}

impl ByC<'_> {
    pub fn new(unit: &Unit, makes_detours: bool) -> ByC<'_> {
        let mut instance = unit.instantiate();
        instance.log_everything();
        ByC { unit, instance, kept: None, makes_detours }
    }

    fn forget(&mut self) {
        self.kept.take().into_iter().for_each(|state| self.instance.free(state));
    }

    /// The bytes of the present state.
    fn bytes(&self) -> Vec<c_char> {
        let state = self.instance.save();
        let bytes = self.instance.bytes(state);
        self.instance.free(state);
        bytes
    }

    /// Keeps the present state: as it is if there are detours, and otherwise as what another library makes of its bytes, which are the same.
    fn keep(&mut self) -> Vec<u64> {
        self.forget();
        let bytes = self.bytes();
        self.kept = Some(match self.makes_detours {
            true => self.instance.save(),
            false => self.instance.deserialize(&bytes).expect("its own bytes"),
        });
        words_of(&bytes)
    }

    fn go_round(&mut self, detour: Detour) {
        let bytes = self.bytes();
        match detour {
            Detour::Bytes => {
                let kept = self.kept.take().map(|state| self.instance.bytes(state));
                let mut other = self.unit.instantiate();
                let state = other.deserialize(&bytes).expect("a state of the same FMU");
                other.restore(state);
                other.free(state);
                self.kept = kept.map(|bytes| other.deserialize(&bytes).expect("a state of the same FMU"));
                self.instance = other;
            }
            Detour::Away => {
                let state = self.instance.save();
                let rates = &self.unit.face.rates;
                // whatever they answer
                self.instance.set(rates, &vec![0.3; rates.len()]);
                let _ = self.instance.step(0.0, 1e-7);
                self.instance.restore(state);
                self.instance.free(state);
            }
        }
        assert!(self.bytes() == bytes, "{detour:?} changes the state");
    }
}

impl Way for ByC<'_> {
    fn answer(&mut self, call: &Call) -> Answer {
        self.instance.take_message();
        let instance = &mut self.instance;
        let parts = |pairs: &[(u32, f64)]| pairs.iter().copied().unzip::<u32, f64, Vec<_>, Vec<_>>();
        let mut values = match call {
            Call::Reals(references) | Call::Slopes(_, references) | Call::By(_, references) => {
                vec![0.0; references.len()]
            }
            _ => Vec::new(),
        };
        let mut shown = Vec::new();
        let status = match call {
            Call::Enter => instance.setup(0.0, None).max(instance.enter()),
            Call::Exit => instance.exit(),
            Call::Reset => {
                self.forget();
                self.instance.reset();
                OK
            }
            Call::Set(pairs) => {
                let (references, values) = parts(pairs);
                instance.set(&references, &values)
            }
            Call::Derivatives(order, pairs) => {
                let (references, values) = parts(pairs);
                instance.set_derivatives(&references, *order, &values)
            }
            Call::Step(time, step) => instance.step(*time, *step),
            Call::Reals(references) => instance.get(references, &mut values),
            Call::Integers(references) => {
                let mut values = vec![-1; references.len()];
                let status = instance.get_integers(references, &mut values);
                shown.extend(values.into_iter().map(|value| value as u64));
                status
            }
            Call::Slopes(order, references) => instance.output_derivatives(references, *order, &mut values),
            Call::By(known, references) => instance.directional(references, *known, &mut values),
            Call::Save => {
                shown = self.keep();
                OK
            }
            Call::Restore => {
                let state = self.kept.expect("a state was saved");
                self.instance.restore(state);
                OK
            }
            Call::Detour(detour) => {
                if self.makes_detours {
                    self.go_round(*detour);
                }
                OK
            }
        };
        // a warning is no refusal
        let is_done = status <= 1;
        if is_done {
            shown.extend(bits(values));
        }
        // an instance that was made anew warns anew
        let words = (!self.makes_detours).then(|| self.instance.take_message());
        Answer { is_done, bits: if is_done { shown } else { Vec::new() }, words }
    }
}

impl Drop for ByC<'_> {
    fn drop(&mut self) {
        self.forget();
    }
}

/// What happened in histories.
#[derive(Debug, Default)]
pub struct Tally {
    pub messages: usize,
    pub refused: usize,
    /// Steps after which a contact pushed.
    pub pushed: usize,
}

/// A history in the making.
struct Player<'a, 'b> {
    face: &'a Face,
    ways: Vec<Box<dyn Way + 'b>>,
    random: &'a mut Random,
    calls: Vec<Call>,
    tally: &'a mut Tally,
    /// Whether a step has had a warning. A contact then looks for the next limit, and one that was restored for the first.
    was_warned: bool,
}

/// Plays a random history of some calls on all `ways`; what the FMU has is on its `face`.
pub fn play(face: &Face, ways: Vec<Box<dyn Way + '_>>, calls: usize, random: &mut Random, tally: &mut Tally) {
    let mut player = Player { face, ways, random, calls: Vec::new(), tally, was_warned: false };
    player.play(calls);
}

impl Player<'_, '_> {
    /// The answer of all ways.
    fn ask(&mut self, call: Call) -> Answer {
        self.calls.push(call.clone());
        let mut answers = self.ways.iter_mut().map(|way| way.answer(&call)).collect::<Vec<_>>().into_iter();
        let first = answers.next().expect("there are ways");
        for (place, other) in answers.enumerate() {
            let is_alike = first.bits == other.bits || (self.was_warned && matches!(call, Call::Save));
            let same =
                first.is_done == other.is_done && is_alike && (other.words.is_none() || other.words == first.words);
            if !same {
                let last = self.calls.iter().skip(self.calls.len().saturating_sub(30));
                let last: Vec<String> = last.map(|call| format!("{call:?}")).collect();
                let pairs = first.bits.iter().zip(&other.bits).enumerate().filter(|(_, (one, other))| one != other);
                let differ: Vec<_> =
                    pairs.map(|(at, (one, other))| (at, f64::from_bits(*one), f64::from_bits(*other))).collect();
                panic!(
                    "way {} answers otherwise: {:?} and {:?}, {:?} and {:?}, in {differ:?}, after\n{}",
                    place + 1,
                    first.is_done,
                    other.is_done,
                    first.words,
                    other.words,
                    last.join("\n")
                );
            }
        }
        let is_warned = first.is_done && first.words.as_ref().is_some_and(|words| !words.is_empty());
        self.was_warned = !matches!(call, Call::Reset) && (self.was_warned || is_warned);
        self.tally.messages += usize::from(first.words.as_ref().is_some_and(|words| !words.is_empty()));
        self.tally.refused += usize::from(!first.is_done);
        first
    }

    fn is_done(&mut self, call: Call) -> bool {
        self.ask(call).is_done
    }

    /// The variables of this causality, with the last part of their names.
    fn variables(&self, causality: &str) -> Vec<(u32, String)> {
        let of = self.face.variables.iter().filter(|variable| variable.causality == causality && variable.is_real);
        of.map(|variable| (variable.reference, variable.name.rsplit('.').next().unwrap_or_default().into())).collect()
    }

    /// Sets parameters and initializes, until the parameters are accepted.
    fn begin(&mut self) {
        let face = self.face;
        let parameters: Vec<_> = face.variables.iter().filter(|variable| variable.causality == "parameter").collect();
        loop {
            let mut is_taken = true;
            for parameter in &parameters {
                if below(self.random, 3) == 0 {
                    continue;
                }
                let value = match parameter.name.rsplit('.').next().unwrap_or_default() {
                    "poissons_ratio" => between(self.random, -0.2, 0.5),
                    "initial_gap" => signed(self.random, -8.0, -5.0),
                    "restitution" | "elastic_restitution" => between(self.random, 0.2, 1.0),
                    _ => parameter.start.expect("every parameter has one") * positive(self.random, -0.5, 0.5),
                };
                let (minimum, maximum) = parameter.limits();
                let value = match below(self.random, 40) {
                    0 => 2.0 * maximum + 1.0,
                    1 => minimum,
                    _ => value.clamp(minimum, maximum),
                };
                is_taken = self.is_done(Call::Set(vec![(parameter.reference, value)]));
                if !is_taken {
                    break;
                }
            }
            if is_taken && self.is_done(Call::Enter) && self.look(true).is_some() && self.is_done(Call::Exit) {
                return;
            }
            self.ask(Call::Reset);
        }
    }

    /// All outputs and some derivatives of them: before the first step, there are none over time. `None` if one is refused.
    fn look(&mut self, is_first: bool) -> Option<Vec<u64>> {
        let outputs: Vec<u32> = self.face.outputs.clone();
        let shown = self.ask(Call::Reals(outputs.clone()));
        let integers = self.face.integers.clone();
        let call = match below(self.random, 12) {
            order @ 1..=2 if !is_first => Call::Slopes(order as i32, outputs),
            3 => Call::By(self.face.inputs[below(self.random, self.face.inputs.len())], outputs),
            _ => Call::Integers(integers),
        };
        (shown.is_done && self.is_done(call)).then_some(shown.bits)
    }

    /// The speeds at the end of the last step that the FMU tells, for the rates of the next one.
    fn speeds(&mut self) -> Vec<(u32, f64)> {
        let of =
            |name: &str| self.face.variables.iter().find(|variable| variable.name == name).map(|one| one.reference);
        let pairs: Vec<(u32, u32)> = (self.face.variables.iter())
            .filter(|variable| variable.name.ends_with("indentation_rate"))
            .filter_map(|rate| Some((rate.reference, of(&rate.name.replace("indentation_rate", "closing_speed"))?)))
            .collect();
        let told = self.ask(Call::Reals(pairs.iter().map(|pair| pair.1).collect()));
        pairs.iter().map(|pair| pair.0).zip(told.bits.into_iter().map(f64::from_bits)).collect()
    }

    /// Values of the inputs for the next step.
    fn inputs(&mut self) -> Vec<(u32, f64)> {
        let mut given = Vec::new();
        for (reference, name) in self.variables("input") {
            let value = match &*name {
                "effective_mass" => positive(self.random, -6.0, 2.0),
                _ if name.starts_with("inverse_mass") => match is_diagonal(&name) {
                    true => positive(self.random, 0.0, 3.0),
                    false => signed(self.random, -3.0, -1.0),
                },
                // a contact that is moved far at once costs time and tells nothing
                _ => signed(self.random, -6.0, 1.0),
            };
            let value = match below(self.random, 600) {
                0 => [0.0, 5e-324, -1e41, f64::MAX, f64::NAN, f64::INFINITY][below(self.random, 6)],
                _ => value,
            };
            if below(self.random, 4) != 0 || name == "indentation_rate" {
                given.push((reference, value));
            }
        }
        given
    }

    fn play(&mut self, calls: usize) {
        let is_led = below(self.random, 2) == 0;
        // outputs that the scene does not request are missing, whatever the library supports
        let beyond = self.face.variables.len() as u32;
        assert!(!self.is_done(Call::Set(vec![(beyond, 1.0)])));
        self.ask(Call::Reset);
        self.begin();
        let (mut time, mut step, mut kept) = (0.0, 1e-6, None);
        for _ in 0..calls {
            let mut inputs = self.inputs();
            if is_led && below(self.random, 5) != 0 {
                let speeds = self.speeds();
                inputs.extend(speeds);
            }
            let is_set = match below(self.random, 2) {
                0 => self.is_done(Call::Set(inputs)),
                _ => inputs.into_iter().all(|input| self.is_done(Call::Set(vec![input]))),
            };
            if below(self.random, 3) == 0 {
                step = positive(self.random, -9.0, -4.0);
            }
            let goes_on = is_set && self.bend() && {
                let is_done = self.is_done(Call::Step(time, step));
                time += step;
                is_done
            };
            let shown = if goes_on { self.look(false) } else { None };
            let goes_on = shown.is_some_and(|shown| {
                self.tally.pushed += usize::from(self.pushes(&shown));
                self.turn(&mut time, &mut kept)
            });
            if !goes_on {
                // too deep, too long or not allowed: only a reset is possible
                self.ask(Call::Reset);
                self.begin();
                (time, kept) = (0.0, None);
            }
        }
    }

    /// Whether the first contact pushes, according to the values of all outputs.
    fn pushes(&self, shown: &[u64]) -> bool {
        let force = self.face.variables.iter().find(|variable| variable.name.ends_with("force"));
        let place = force.and_then(|force| self.face.outputs.iter().position(|one| *one == force.reference));
        place.and_then(|place| shown.get(place)).is_some_and(|bits| f64::from_bits(*bits) > 0.0)
    }

    /// Derivatives of an input now and then.
    fn bend(&mut self) -> bool {
        if below(self.random, 5) != 0 {
            return true;
        }
        let all: Vec<u32> = self.face.rates.iter().chain(&self.face.sideways).copied().collect();
        let reference = all[below(self.random, all.len())];
        let order = 1 + below(self.random, 2) as i32;
        let value = signed(self.random, 0.0, if order == 1 { 6.0 } else { 11.0 });
        self.is_done(Call::Derivatives(order, vec![(reference, value)]))
    }

    /// What comes between two steps.
    fn turn(&mut self, time: &mut f64, kept: &mut Option<f64>) -> bool {
        match below(self.random, 14) {
            0 => {
                *kept = Some(*time);
                self.is_done(Call::Save)
            }
            1 => kept.is_none_or(|saved| {
                *time = saved;
                self.is_done(Call::Restore)
            }),
            2 => self.is_done(Call::Detour(Detour::Bytes)),
            3 => self.is_done(Call::Detour(Detour::Away)),
            4 => {
                // most are refused between steps
                let parameters = self.variables("parameter");
                let any = below(self.random, parameters.len().max(1));
                let reference = parameters.get(any).map_or(99, |parameter| parameter.0);
                let value = positive(self.random, -9.0, 12.0);
                self.is_done(Call::Set(vec![(reference, value)]))
            }
            _ => true,
        }
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

/// The model description of an FMU.
fn description(fmu: &Path) -> String {
    let library = unit::library(fmu);
    let root = library.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
    fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library")
}

/// Two libraries of one scene.
pub struct Both {
    /// The kind of the prebuilt one.
    pub kind: String,
    pub units: [Unit; 2],
}

impl Both {
    /// The prebuilt FMU of a scene, and the compiled one, which has the same description.
    pub fn of(text: &str, store: &Path) -> Both {
        let (compiled, (prebuilt, kind)) = (export(text, None), export_by_kind(text, store));
        let [one, other] = [&prebuilt, &compiled].map(|fmu| description(fmu));
        assert!(one == other, "the model descriptions differ: {text}");
        assert_eq!(attribute(&one, "guid").expect("a GUID").len(), 32);
        Both { kind, units: [Unit::open(&prebuilt), Unit::open(&compiled)] }
    }

    /// Two libraries of one FMU, which was unpacked at the place of the first.
    pub fn between(native: &Path, other: &Path, kind: &str) -> Both {
        Both { kind: kind.into(), units: [native, other].map(|library| Unit::open_library(library, native)) }
    }

    /// Both, and the first one by detours.
    pub fn ways(&self) -> Vec<Box<dyn Way + '_>> {
        let [one, other] = &self.units;
        vec![Box::new(ByC::new(one, false)), Box::new(ByC::new(other, false)), Box::new(ByC::new(one, true))]
    }

    /// Plays a history on them; the number of messages.
    pub fn compare(&self, calls: usize, random: &mut Random) -> usize {
        let mut tally = Tally::default();
        play(&self.units[0].face, self.ways(), calls, random, &mut tally);
        tally.messages
    }
}
