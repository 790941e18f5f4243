//! What a module for WebAssembly has beside the functions: a place for the block at an exported address, and the sizes that tell
//! how much memory an instance needs. C source is made from such modules.

use crate::block::Exported;
use brinell_fmu::c::state::Snapshot;
use brinell_fmu::fmi2::component::Component;
use brinell_fmu::instance::Instance;
use brinell_fmu::scene::library::block::Block;
use core::cell::UnsafeCell;
use core::mem::MaybeUninit;

/// The block. In a section of its own it would be outside of the module's memory. It is the only variable, so nothing is behind it in
/// memory, and has no contents in the module: who runs the module puts them there.
#[repr(transparent)]
pub struct Place(UnsafeCell<MaybeUninit<Block>>);

// SAFETY: nothing in the module writes to it.
unsafe impl Sync for Place {}

/// The only one.
#[unsafe(no_mangle)]
pub static brinell_block: Place = Place(UnsafeCell::new(MaybeUninit::zeroed()));

/// The block in memory.
#[inline(always)]
pub fn block() -> &'static Block {
    // SAFETY: it is zeros or what was put there before the first call; any bits are valid numbers.
    unsafe { (*brinell_block.0.get()).assume_init_ref() }
}

/// Size of an instance in every scene of this kind, without its arrays and its name \[bytes\].
#[unsafe(no_mangle)]
pub extern "C" fn brinell_fixed_size() -> usize {
    size_of::<Component<Exported>>()
}

/// Size of an instance of this scene without its name \[bytes\].
#[unsafe(no_mangle)]
pub extern "C" fn brinell_instance_size() -> usize {
    size_of::<Component<Exported>>() + Instance::<Exported>::outside_with_models()
}

/// Size of a state of this scene \[bytes\].
#[unsafe(no_mangle)]
pub extern "C" fn brinell_state_size() -> usize {
    size_of::<Snapshot<Exported>>() + Instance::<Exported>::outside()
}

/// Size of a state of this scene as bytes \[bytes\].
#[unsafe(no_mangle)]
pub extern "C" fn brinell_serialized_size() -> usize {
    Snapshot::<Exported>::serialized_size()
}
