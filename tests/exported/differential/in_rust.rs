//! The instance of a scene in Rust: the type of a prebuilt library over the scene's data, in this process. It takes the path with all checks
//! where the C interface has short ones.

use brinell_exporter::{plan::Plan, prebuilt::PrebuiltUnit, scene};
use brinell_fmu::fmi2::component::{instance_in, words_of_instance};
use brinell_fmu::for_library;
use brinell_fmu::instance::{Fault, Instance, Plain};
use brinell_fmu::scene::{Real, Scene};
use brinell_testing::histories::{Answer, Call, Detour, Way};
use brinell_web::unit::{self, Place};

/// An instance, with two others for its detours and what it keeps.
struct InRust<S: Scene + 'static> {
    instance: &'static mut Instance<S>,
    other: &'static mut Instance<S>,
    kept: &'static mut Instance<S>,
}

/// A scene as a way, and the name of its kind.
pub fn of(scene: &scene::Scene) -> (Box<dyn Way>, &'static str) {
    let prebuilt = PrebuiltUnit::of(&Plan::of(scene), "").expect("a scene for a prebuilt library");
    unit::place(&prebuilt);
    let way: Option<fn() -> Box<dyn Way>> = for_library!(prebuilt.library.name, Place, way);
    (way.expect("a kind of the list")(), prebuilt.library.name)
}

/// An instance in memory that is never freed, since its scene isn't either.
fn made<S: Scene + 'static>() -> &'static mut Instance<S> {
    let memory = Vec::leak(vec![0; words_of_instance::<S>()]);
    let instance = instance_in::<S>(memory).expect("the memory is as long as it has to be");
    instance.reset().expect("the bodies of a scene fit");
    instance
}

fn way<S: Scene + 'static>() -> Box<dyn Way> {
    Box::new(InRust::<S> { instance: made(), other: made(), kept: made() })
}

impl<S: Scene> InRust<S> {
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
            Call::Detour(detour) => self.go_round(*detour),
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
