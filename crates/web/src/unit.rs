//! The FMU of a scene in the page: the code of the libraries, on data that the exporter would write into one of them.
//!
//! A scene of a library is a type, and its data stay where they are as long as the library is loaded. So each scene that runs here takes
//! some memory for ever: the page loads its module anew for each.

use brinell_exporter::prebuilt::PrebuiltUnit;
use brinell_fmu::c::span::Free;
use brinell_fmu::fmi2::component::Component;
use brinell_fmu::instance::{Fault, Instance, Warning};
use brinell_fmu::scene::Real;
use brinell_fmu::scene::Scene;
use brinell_fmu::scene::prebuilt::block::Block;
use brinell_fmu::scene::prebuilt::kinds::{
    Damped, Lossy, LossyPlane, LossyRough, Momentum, Moved, Plane, Rated, Rough, State,
};
use brinell_fmu::scene::prebuilt::{Memory, Prebuilt};
use std::cell::Cell;

/// The data of a scene, as what they are and as words.
type Scenery = (Block, [u64; Block::WORDS]);

thread_local! {
    /// Those of the scene that runs.
    static SCENERY: Cell<&'static Scenery> = Cell::new(leaked(Block::unfilled(Place::LIBRARY)));
}

fn leaked(block: Block) -> &'static Scenery {
    let mut words = block.words();
    Box::leak(Box::new((block, std::array::from_fn(|_| words.next().unwrap_or(0)))))
}

/// The place of the block.
struct Place;

impl Memory for Place {
    const LIBRARY: u64 = 1;

    fn block() -> &'static Block {
        &SCENERY.get().0
    }

    fn words() -> &'static [u64; Block::WORDS] {
        &SCENERY.get().1
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

/// As many instances of the FMU `unit`, before their start. Those of another FMU must not be used any more.
///
/// # Errors
/// A reason in words, if the page does not know its library.
pub fn instances(unit: &PrebuiltUnit, count: usize) -> Result<Vec<&'static mut dyn Unit>, String> {
    SCENERY.set(leaked(unit.block(Place::LIBRARY)));
    let make = match unit.library.name {
        "state" => made::<Prebuilt<State, Place>>,
        "momentum" => made::<Prebuilt<Momentum, Place>>,
        "moved" => made::<Prebuilt<Moved, Place>>,
        "lossy" => made::<Prebuilt<Lossy, Place>>,
        "rate" => made::<Prebuilt<Rated, Place>>,
        "damped" => made::<Prebuilt<Damped, Place>>,
        "friction" => made::<Prebuilt<Rough, Place>>,
        "friction-2" => made::<Prebuilt<Plane, Place>>,
        "lossy-friction" => made::<Prebuilt<LossyRough, Place>>,
        "lossy-friction-2" => made::<Prebuilt<LossyPlane, Place>>,
        other => return Err(format!("the page does not know the library `{other}`")),
    };
    (0..count).map(|_| make()).collect()
}

/// An instance of a scene in memory that is never freed, since the scene isn't either.
#[allow(unsafe_code, reason = "arrays of a length that the scene says lie behind the instance")]
fn made<S: Scene + 'static>() -> Result<&'static mut dyn Unit, String> {
    S::verify()?;
    let _ = Component::<S>::ZEROS;
    let outside = Instance::<S>::outside_with_models();
    let words = (size_of::<Instance<S>>() + outside).div_ceil(8);
    const { assert!(align_of::<Instance<S>>() <= 8) };
    let memory: &'static mut [u64] = Vec::leak(vec![0; words]);
    let start = memory.as_mut_ptr();
    start.expose_provenance();
    // SAFETY: the memory is large enough for the instance and its arrays, aligned, and nothing else uses it. Zeros are a valid
    // instance, as `ZEROS` proves.
    let instance = unsafe { &mut *start.cast::<Instance<S>>() };
    // SAFETY: the bytes behind it are zeros of the same allocation, its provenance is exposed, and the instance is never moved.
    let free = unsafe { Free::behind(instance, outside) };
    instance.place(free);
    Ok(instance)
}
