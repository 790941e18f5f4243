//! Saving, restoring and serializing the state of an instance.

use super::abi::*;
use super::component::{array, array_mut, call, component, object};
use super::order;
use super::state::{SERIALIZED_SIZE, Snapshot};
use crate::fault::Fault;

/// Copies the instance into a state; memory is allocated only if `FMUstate` points to null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(c: fmi2Component, FMUstate: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: the caller's component and state.
    unsafe {
        if let (Some(component), Some(state)) = (component(c), FMUstate.as_ref())
            && let Ok(snapshot) = Snapshot::at(*state)
            // in order in every phase
            && snapshot.instance.copy_alike(&component.instance)
        {
            return fmi2OK;
        }
        get_any_state(c, FMUstate)
    }
}

/// Every saving that isn't plain, with all checks.
///
/// # Safety
/// The caller's component and state.
#[inline(never)]
unsafe fn get_any_state(c: fmi2Component, FMUstate: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: as the caller promises.
    unsafe {
        call(c, order::GET_FMU_STATE, |component| Snapshot::store(object(FMUstate, "FMUstate")?, &component.instance))
    }
}

/// Makes the instance as it was when the state was saved, parameters and phase included.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(c: fmi2Component, FMUstate: fmi2FMUstate) -> fmi2Status {
    // SAFETY: the caller's component and state.
    unsafe {
        if let (Some(component), Ok(snapshot)) = (component(c), Snapshot::at(FMUstate))
            // in order in every phase
            && component.instance.copy_alike(&snapshot.instance)
        {
            return fmi2OK;
        }
        set_any_state(c, FMUstate)
    }
}

/// Every restoring that isn't plain, with all checks.
///
/// # Safety
/// The caller's component and state.
#[cold]
#[inline(never)]
unsafe fn set_any_state(c: fmi2Component, state: fmi2FMUstate) -> fmi2Status {
    // SAFETY: as the caller promises.
    unsafe {
        call(c, order::SET_FMU_STATE, |component| {
            component.instance.copy(&Snapshot::at(state)?.instance);
            Ok(())
        })
    }
}

/// Frees a state and sets the pointer to null; null and a pointer to null are ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(c: fmi2Component, FMUstate: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: the caller's component and state.
    unsafe { call(c, order::FREE_FMU_STATE, |_| FMUstate.as_mut().map_or(Ok(()), |state| Snapshot::free(state))) }
}

/// The length of a serialized state [bytes]; the same for every state of this unit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    c: fmi2Component,
    FMUstate: fmi2FMUstate,
    size: *mut usize,
) -> fmi2Status {
    // SAFETY: the caller's component, state and pointer.
    unsafe {
        call(c, order::SERIALIZED_FMU_STATE_SIZE, |_| {
            Snapshot::at(FMUstate)?;
            *object(size, "size")? = SERIALIZED_SIZE;
            Ok(())
        })
    }
}

/// Writes a state as bytes that work in another instance and in another process.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    c: fmi2Component,
    FMUstate: fmi2FMUstate,
    serializedState: *mut fmi2Byte,
    size: usize,
) -> fmi2Status {
    // SAFETY: the caller's component and state, and an array as long as announced.
    unsafe {
        call(c, order::SERIALIZE_FMU_STATE, |_| {
            let snapshot = Snapshot::at(FMUstate)?;
            let bytes = array_mut(serializedState.cast::<u8>(), size, "serializedState")?;
            let room = bytes.first_chunk_mut().ok_or(Fault::BadState { reason: "the buffer is too short" })?;
            snapshot.serialize(room);
            Ok(())
        })
    }
}

/// Makes a state from bytes. If they are refused `FMUstate` is left alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: fmi2Component,
    serializedState: *const fmi2Byte,
    size: usize,
    FMUstate: *mut fmi2FMUstate,
) -> fmi2Status {
    // SAFETY: the caller's component and state, and an array as long as announced.
    unsafe {
        call(c, order::DESERIALIZE_FMU_STATE, |_| {
            let bytes = array(serializedState.cast::<u8>(), size, "serializedState")?;
            Snapshot::deserialize(object(FMUstate, "FMUstate")?, bytes)
        })
    }
}
