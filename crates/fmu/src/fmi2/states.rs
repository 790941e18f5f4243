//! Saving, restoring and serializing the state of an instance.

use super::abi::*;
use super::component::{Component, call};
use super::order;
use crate::c::handle::{Handle, are_given, array, array_mut, object};
use crate::c::state::Snapshot;
use crate::scene::Scene;

/// Copies the instance to a state. Memory is allocated only if `FMUstate` points to null.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_fmu_state<S: Scene>(c: fmi2Component, FMUstate: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: the caller's component and state.
    unsafe {
        // a state of another FMU isn't alike
        if are_given(c.addr() & FMUstate.addr())
            && let Some(snapshot) = Snapshot::<S>::behind(*FMUstate)
            // allowed in every phase
            && snapshot.instance.copy_alike(&(*Component::<S>::pointer(c)).instance)
        {
            return fmi2OK;
        }
        get_any_state::<S>(c, FMUstate)
    }
}

/// Saves a state in all other cases, with all checks.
///
/// # Safety
/// The caller's component and state.
#[inline(never)]
unsafe fn get_any_state<S: Scene>(c: fmi2Component, FMUstate: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        call::<S>(c, order::GET_FMU_STATE, |component| {
            Snapshot::<S>::store(object(FMUstate, "FMUstate")?, &component.instance, component.memory)
        })
    }
}

/// Resets the instance to the saved state, including parameters and phase.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn set_fmu_state<S: Scene>(c: fmi2Component, FMUstate: fmi2FMUstate) -> fmi2Status {
    // SAFETY: the caller's component and state.
    unsafe {
        // a state of another FMU isn't alike
        if are_given(c.addr() & FMUstate.addr())
            // allowed in every phase
            && (*Component::<S>::pointer(c)).instance.copy_alike(&(*Snapshot::<S>::pointer(FMUstate)).instance)
        {
            return fmi2OK;
        }
        set_any_state::<S>(c, FMUstate)
    }
}

/// Restores a state in all other cases, with all checks.
///
/// # Safety
/// The caller's component and state.
#[cold]
#[inline(never)]
unsafe fn set_any_state<S: Scene>(c: fmi2Component, state: fmi2FMUstate) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        call::<S>(c, order::SET_FMU_STATE, |component| {
            component.instance.copy(&Snapshot::<S>::at(state)?.instance);
            Ok(())
        })
    }
}

/// Frees a state and sets the pointer to null. Null and a pointer to null are ignored.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn free_fmu_state<S: Scene>(c: fmi2Component, FMUstate: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: the caller's component and state.
    unsafe {
        call::<S>(c, order::FREE_FMU_STATE, |component| {
            FMUstate.as_mut().map_or(Ok(()), |state| Snapshot::<S>::free(state, component.memory))
        })
    }
}

/// The length of a serialized state \[bytes\]. It is the same for every state of this FMU.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn serialized_fmu_state_size<S: Scene>(
    c: fmi2Component,
    FMUstate: fmi2FMUstate,
    size: *mut usize,
) -> fmi2Status {
    // SAFETY: the caller's component, state and pointer.
    unsafe {
        call::<S>(c, order::SERIALIZED_FMU_STATE_SIZE, |_| {
            Snapshot::<S>::at(FMUstate)?;
            *object(size, "size")? = Snapshot::<S>::serialized_size();
            Ok(())
        })
    }
}

/// Writes a state as bytes that another instance or another process can read.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn serialize_fmu_state<S: Scene>(
    c: fmi2Component,
    FMUstate: fmi2FMUstate,
    serializedState: *mut fmi2Byte,
    size: usize,
) -> fmi2Status {
    // SAFETY: the caller's component and state, and an array of the given length.
    unsafe {
        call::<S>(c, order::SERIALIZE_FMU_STATE, |_| {
            let snapshot = Snapshot::<S>::at(FMUstate)?;
            snapshot.serialize(array_mut(serializedState.cast::<u8>(), size, "serializedState")?)
        })
    }
}

/// Creates a new state from bytes. If they are rejected, `FMUstate` does not change.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn deserialize_fmu_state<S: Scene>(
    c: fmi2Component,
    serializedState: *const fmi2Byte,
    size: usize,
    FMUstate: *mut fmi2FMUstate,
) -> fmi2Status {
    // SAFETY: the caller's component and state, and an array of the given length.
    unsafe {
        call::<S>(c, order::DESERIALIZE_FMU_STATE, |component| {
            let bytes = array(serializedState.cast::<u8>(), size, "serializedState")?;
            let state = object(FMUstate, "FMUstate")?;
            // the old pointer is not read: the standard does not require it to be valid
            *state = Snapshot::<S>::deserialize(bytes, component.memory)?;
            Ok(())
        })
    }
}
