//! Saving, restoring and serializing the state of an instance.

use super::abi::*;
use super::component::{Component, array, array_mut, call, object};
use super::handle::Handle;
use super::order;
use super::state::Snapshot;
use crate::scene::Scene;

/// Copies the instance into a state; memory is allocated only if `FMUstate` points to null.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_fmu_state<S: Scene>(c: fmi2Component, FMUstate: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: the caller's component and state.
    unsafe {
        if let (Some(component), Some(state)) = (Component::<S>::behind(c), FMUstate.as_ref())
            && let Ok(snapshot) = Snapshot::<S>::at(*state)
            // in order in every phase
            && snapshot.instance.copy_alike(&component.instance)
        {
            return fmi2OK;
        }
        get_any_state::<S>(c, FMUstate)
    }
}

/// Every saving that isn't plain, with all checks.
///
/// # Safety
/// The caller's component and state.
#[inline(never)]
unsafe fn get_any_state<S: Scene>(c: fmi2Component, FMUstate: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: as the caller promises.
    unsafe {
        call::<S>(c, order::GET_FMU_STATE, |component| {
            Snapshot::<S>::store(object(FMUstate, "FMUstate")?, &component.instance, component.memory)
        })
    }
}

/// Makes the instance as it was when the state was saved, parameters and phase included.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn set_fmu_state<S: Scene>(c: fmi2Component, FMUstate: fmi2FMUstate) -> fmi2Status {
    // SAFETY: the caller's component and state.
    unsafe {
        if let (Some(component), Ok(snapshot)) = (Component::<S>::behind(c), Snapshot::<S>::at(FMUstate))
            // in order in every phase
            && component.instance.copy_alike(&snapshot.instance)
        {
            return fmi2OK;
        }
        set_any_state::<S>(c, FMUstate)
    }
}

/// Every restoring that isn't plain, with all checks.
///
/// # Safety
/// The caller's component and state.
#[cold]
#[inline(never)]
unsafe fn set_any_state<S: Scene>(c: fmi2Component, state: fmi2FMUstate) -> fmi2Status {
    // SAFETY: as the caller promises.
    unsafe {
        call::<S>(c, order::SET_FMU_STATE, |component| {
            component.instance.copy(&Snapshot::<S>::at(state)?.instance);
            Ok(())
        })
    }
}

/// Frees a state and sets the pointer to null; null and a pointer to null are ignored.
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

/// The length of a serialized state \[bytes\]; the same for every state of this unit.
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
            *object(size, "size")? = Snapshot::<S>::SERIALIZED_SIZE;
            Ok(())
        })
    }
}

/// Writes a state as bytes that work in another instance and in another process.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn serialize_fmu_state<S: Scene>(
    c: fmi2Component,
    FMUstate: fmi2FMUstate,
    serializedState: *mut fmi2Byte,
    size: usize,
) -> fmi2Status {
    // SAFETY: the caller's component and state, and an array as long as announced.
    unsafe {
        call::<S>(c, order::SERIALIZE_FMU_STATE, |_| {
            let snapshot = Snapshot::<S>::at(FMUstate)?;
            snapshot.serialize(array_mut(serializedState.cast::<u8>(), size, "serializedState")?)
        })
    }
}

/// Makes a new state from bytes. If they are refused `FMUstate` is left alone.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn deserialize_fmu_state<S: Scene>(
    c: fmi2Component,
    serializedState: *const fmi2Byte,
    size: usize,
    FMUstate: *mut fmi2FMUstate,
) -> fmi2Status {
    // SAFETY: the caller's component and state, and an array as long as announced.
    unsafe {
        call::<S>(c, order::DESERIALIZE_FMU_STATE, |component| {
            let bytes = array(serializedState.cast::<u8>(), size, "serializedState")?;
            let state = object(FMUstate, "FMUstate")?;
            // what was there before is not read: by the standard it need not be anything
            *state = Snapshot::<S>::deserialize(bytes, component.memory)?;
            Ok(())
        })
    }
}
