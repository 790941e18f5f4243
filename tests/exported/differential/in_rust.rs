//! The instance of a scene in Rust: the type of a prebuilt library over the scene's data, in this process. It takes the path with all checks
//! where the C interface has short ones.

use brinell_exporter::{plan::Plan, prebuilt::PrebuiltUnit, scene};
use brinell_fmu::c::span::Free;
use brinell_fmu::fmi2::component::Component;
use brinell_fmu::instance::{Fault, Instance, Plain};
use brinell_fmu::scene::library::block::{Block, Contents};
use brinell_fmu::scene::library::kinds::{
    Friction, Friction2, Losses, LossyFriction, LossyFriction2, LossyStrengths, Momentum, Moved, State, Strengths,
};
use brinell_fmu::scene::library::{LibraryScene, Memory};
use brinell_fmu::scene::{Real, Scene};
use brinell_testing::histories::{Answer, Call, Detour, Way};
use std::cell::Cell;

thread_local! {
    /// The block of the scene that this thread runs; a scene stays for ever.
    static BLOCK: Cell<&'static Block> = Cell::new(Box::leak(Box::new(Block::unfilled(LIBRARY))));
}

/// Identifies the library: nothing but this file writes the data.
const LIBRARY: u64 = 1;

/// The place of the block.
struct Place;

impl Memory for Place {
    fn contents() -> Contents<'static> {
        BLOCK.get().contents()
    }

    fn verify() -> Result<(), &'static str> {
        Ok(())
    }
}

/// An instance, with two others for its detours and what it keeps.
struct InRust<S: Scene + 'static> {
    instance: &'static mut Instance<S>,
    other: &'static mut Instance<S>,
    kept: &'static mut Instance<S>,
    makes_detours: bool,
}

/// A scene as a way, and the name of its kind.
pub fn of(scene: &scene::Scene, makes_detours: bool) -> (Box<dyn Way>, &'static str) {
    let unit = PrebuiltUnit::of(&Plan::of(scene), "").expect("a scene for a prebuilt library");
    BLOCK.set(Box::leak(Box::new(unit.block(LIBRARY))));
    let way: Box<dyn Way> = match unit.library.name {
        "state" => InRust::<LibraryScene<State, Place>>::boxed(makes_detours),
        "momentum" => InRust::<LibraryScene<Momentum, Place>>::boxed(makes_detours),
        "moved" => InRust::<LibraryScene<Moved, Place>>::boxed(makes_detours),
        "lossy" => InRust::<LibraryScene<Losses, Place>>::boxed(makes_detours),
        "rate" => InRust::<LibraryScene<Strengths, Place>>::boxed(makes_detours),
        "lossy-rate" => InRust::<LibraryScene<LossyStrengths, Place>>::boxed(makes_detours),
        "friction" => InRust::<LibraryScene<Friction, Place>>::boxed(makes_detours),
        "friction-2" => InRust::<LibraryScene<Friction2, Place>>::boxed(makes_detours),
        "lossy-friction" => InRust::<LibraryScene<LossyFriction, Place>>::boxed(makes_detours),
        "lossy-friction-2" => InRust::<LibraryScene<LossyFriction2, Place>>::boxed(makes_detours),
        other => panic!("no kind {other}"),
    };
    (way, unit.library.name)
}

/// An instance in memory that is never freed, since its scene isn't either.
#[allow(unsafe_code, reason = "arrays of a length that the scene says lie behind the instance")]
fn made<S: Scene + 'static>() -> &'static mut Instance<S> {
    let _ = Component::<S>::ZEROS;
    let outside = Instance::<S>::outside_with_models();
    const { assert!(align_of::<Instance<S>>() <= 8) };
    let memory: &'static mut [u64] = Vec::leak(vec![0; (size_of::<Instance<S>>() + outside).div_ceil(8)]);
    let start = memory.as_mut_ptr();
    start.expose_provenance();
    // SAFETY: the memory is large enough for the instance and its arrays, aligned, and nothing else uses it. Zeros are a valid
    // instance, as `ZEROS` proves.
    let instance = unsafe { &mut *start.cast::<Instance<S>>() };
    // SAFETY: the bytes behind it are zeros of the same allocation, its provenance is exposed, and the instance is never moved.
    let free = unsafe { Free::behind(instance, outside) };
    instance.place(free);
    instance.reset().expect("the bodies of a scene fit");
    instance
}

impl<S: Scene> InRust<S> {
    fn boxed(makes_detours: bool) -> Box<InRust<S>> {
        Box::new(InRust { instance: made(), other: made(), kept: made(), makes_detours })
    }

    fn words(&self) -> Vec<u64> {
        let mut words = Vec::new();
        self.instance.save(|word| words.push(word));
        words
    }

    /// The variable of a reference.
    fn real(reference: u32) -> Result<(Real, usize), Refused> {
        S::real(reference).ok_or(Refused)
    }

    fn set(&mut self, pairs: &[(u32, f64)]) -> Result<(), Refused> {
        for &(reference, value) in pairs {
            self.instance.check_real(Self::real(reference)?, value)?;
        }
        let mut are_parameters = false;
        for &(reference, value) in pairs {
            are_parameters |= self.instance.set_real(Self::real(reference)?, value);
        }
        if are_parameters {
            self.instance.parameters_are_set();
        }
        Ok(())
    }

    fn shown(&mut self, call: &Call) -> Result<Vec<u64>, Refused> {
        let bits = |numbers: Vec<f64>| numbers.into_iter().map(|number| (number + 0.0).to_bits()).collect::<Vec<_>>();
        let instance = &mut *self.instance;
        match call {
            Call::Enter => {
                instance.set_experiment(0.0, None)?;
                instance.enter_initialization()?;
            }
            Call::Exit => instance.exit_initialization()?,
            Call::Reset => instance.reset()?,
            Call::Set(pairs) => self.set(pairs)?,
            Call::Derivatives(order, pairs) => {
                for &(reference, value) in pairs {
                    instance.check_input_derivative(Self::real(reference)?, *order, value)?;
                    instance.set_input_derivative(Self::real(reference)?, *order, value);
                }
            }
            Call::Step(time, step) => {
                instance.do_step(*time, *step)?;
                // as an importer does: what has been told changes what is looked at
                let _ = (instance.take_guard(), instance.take_miswired(), instance.take_deep());
            }
            Call::Reals(references) => {
                let values = references.iter().map(|&reference| Ok(instance.real(Self::real(reference)?)));
                return Ok(bits(values.collect::<Result<_, Refused>>()?));
            }
            Call::Integers(references) => {
                let value = |&reference| Ok(instance.integer(S::integer(reference).ok_or(Refused)?) as u64);
                return references.iter().map(value).collect();
            }
            Call::Slopes(order, references) => {
                let slope = |&reference| Ok(instance.output_derivative(Self::real(reference)?, *order)?);
                return Ok(bits(references.iter().map(slope).collect::<Result<_, Refused>>()?));
            }
            Call::By(known, references) => {
                let known = Self::real(*known)?;
                let slope = |&reference| Ok(instance.derivative_by_input(Self::real(reference)?, known)?);
                return Ok(bits(references.iter().map(slope).collect::<Result<_, Refused>>()?));
            }
            Call::Save => {
                self.kept.copy(self.instance);
                return Ok(self.words());
            }
            Call::Restore => self.instance.copy(self.kept),
            Call::Detour(detour) if self.makes_detours => self.go_round(*detour),
            Call::Detour(_) => {}
        }
        Ok(Vec::new())
    }

    fn go_round(&mut self, detour: Detour) {
        let before = self.words();
        match detour {
            Detour::Bytes => {
                let bytes: Vec<[u8; 8]> = before.iter().map(|word| word.to_le_bytes()).collect();
                assert!(self.other.load(&bytes), "its own words are refused");
                std::mem::swap(&mut self.instance, &mut self.other);
            }
            Detour::Away => {
                self.other.copy(self.instance);
                // whatever it answers
                let _ = self.instance.do_step(self.instance.time(), 3e-7);
                let plain = self.other.time();
                assert!(self.instance.do_plain_step(plain, f64::NAN) != Plain::Done);
                self.instance.copy(self.other);
            }
        }
        assert!(self.words() == before, "{detour:?} changes the state");
    }
}

/// A refusal, whose words are the C interface's.
struct Refused;

impl From<Fault> for Refused {
    fn from(_: Fault) -> Refused {
        Refused
    }
}

impl<S: Scene> Way for InRust<S> {
    fn answer(&mut self, call: &Call) -> Answer {
        let shown = self.shown(call);
        Answer { is_done: shown.is_ok(), bits: shown.unwrap_or_default(), words: None }
    }
}
