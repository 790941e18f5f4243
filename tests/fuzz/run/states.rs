//! Saving, restoring and serializing states, and a step against its parts.

use super::{Instance, Runner, State};
use crate::importer::{ERROR, OK, Phase, WARNING};
use crate::judge::same_values;
use std::ptr::null_mut;

impl Runner<'_> {
    pub(super) fn save(&mut self, at: usize, place: usize) -> Result<(), String> {
        let Some(instance) = &self.instances[at] else { return Ok(()) };
        self.calls += 1;
        let mut pointer = self.states[place].take().map_or(null_mut(), |state| state.pointer);
        // SAFETY: the component lives, and the state, if it isn't null
        let status = unsafe { (self.face.functions.get_fmu_state)(instance.component, &raw mut pointer) };
        if status != OK || pointer.is_null() {
            return Err(format!("status {status} in the phase {:?}", instance.known.phase));
        }
        self.states[place] = Some(State { pointer, known: instance.known.clone() });
        Ok(())
    }

    pub(super) fn restore(&mut self, at: usize, place: usize) -> Result<(), String> {
        let (Some(instance), Some(state)) = (&mut self.instances[at], &self.states[place]) else { return Ok(()) };
        self.calls += 1;
        // SAFETY: component and state live
        let status = unsafe { (self.face.functions.set_fmu_state)(instance.component, state.pointer) };
        if status != OK {
            return Err(format!("status {status}"));
        }
        instance.known = state.known.clone();
        Ok(())
    }

    pub(super) fn free_state(&mut self, at: usize, place: usize) -> Result<(), String> {
        let Some(instance) = &self.instances[at] else { return Ok(()) };
        let mut pointer = self.states[place].take().map_or(null_mut(), |state| state.pointer);
        self.calls += 1;
        // SAFETY: it isn't used again
        let status = unsafe { (self.face.functions.free_fmu_state)(instance.component, &raw mut pointer) };
        if status == OK && pointer.is_null() { Ok(()) } else { Err(format!("status {status}, {pointer:?} remains")) }
    }

    pub(super) fn serialize(&mut self, at: usize, place: usize, short_by: usize) -> Result<(), String> {
        let (Some(instance), Some(state)) = (&mut self.instances[at], &self.states[place]) else { return Ok(()) };
        self.calls += 2;
        let (functions, mut size) = (&self.face.functions, 0);
        // SAFETY: component and state live
        let status = unsafe { (functions.serialized_fmu_state_size)(instance.component, state.pointer, &raw mut size) };
        if status != OK || size == 0 {
            return Err(format!("status {status}, {size} bytes"));
        }
        let mut bytes = vec![0; size.saturating_sub(short_by)];
        // SAFETY: the same, and the array is as long as announced
        let status = unsafe {
            (functions.serialize_fmu_state)(instance.component, state.pointer, bytes.as_mut_ptr(), bytes.len())
        };
        match (status, short_by) {
            (OK, 0) => {
                self.bytes = Some((bytes, state.known.clone()));
                Ok(())
            }
            (ERROR, 1..) => {
                instance.known.phase = Phase::Error;
                Ok(())
            }
            _ => Err(format!("status {status} with {short_by} bytes too few")),
        }
    }

    pub(super) fn deserialize(
        &mut self,
        at: usize,
        place: usize,
        flip: Option<usize>,
        length: Option<usize>,
    ) -> Result<(), String> {
        let (Some(instance), Some((bytes, known))) = (&mut self.instances[at], &self.bytes) else { return Ok(()) };
        let mut changed = bytes.clone();
        if let Some(bit) = flip {
            let bit = bit % (8 * changed.len());
            changed[bit / 8] ^= (1u8 << (bit % 8)).cast_signed();
        }
        if let Some(length) = length {
            changed.resize(length, 0);
        }
        let mut pointer = null_mut();
        self.calls += 1;
        // SAFETY: the component lives, and the array is as long as announced
        let status = unsafe {
            let (bytes, count) = (changed.as_ptr(), changed.len());
            (self.face.functions.deserialize_fmu_state)(instance.component, bytes, count, &raw mut pointer)
        };
        if changed != *bytes {
            if status != ERROR || !pointer.is_null() {
                return Err(format!("status {status} with damaged bytes"));
            }
            instance.known.phase = Phase::Error;
            return Ok(());
        }
        if status != OK || pointer.is_null() {
            return Err(format!("status {status} with good bytes"));
        }
        let state = State { pointer, known: known.clone() };
        if let Some(mut old) = self.states[place].replace(state) {
            // SAFETY: it isn't used again
            unsafe { (self.face.functions.free_fmu_state)(instance.component, &raw mut old.pointer) };
        }
        Ok(())
    }

    /// A step from one state, whole and in parts. An FMU that moves the bodies itself uses only the rate at the start
    /// of a step: its parts would need other rates.
    pub(super) fn split(&mut self, at: usize, step: f64, parts: u32) -> Result<(), String> {
        let Some(mut instance) = self.instances[at].take() else { return Ok(()) };
        let moves_bodies = self.face.named.keys().any(|name| name.ends_with("mean_force"));
        let result = if instance.known.phase == Phase::StepComplete && !moves_bodies && !instance.known.has_course {
            self.split_of(&mut instance, step, parts)
        } else {
            Ok(())
        };
        self.instances[at] = Some(instance);
        result
    }

    fn split_of(&mut self, instance: &mut Instance, step: f64, parts: u32) -> Result<(), String> {
        let functions = &self.face.functions;
        let (c, mut start) = (instance.component, null_mut());
        // times without rounding errors: parts of a power of two of the step
        let part = step / f64::from(parts);
        // SAFETY: component and state live
        let (whole, pieces) = unsafe {
            (functions.get_fmu_state)(c, &raw mut start);
            let whole = (functions.do_step)(c, instance.known.time, step, 1);
            let whole = if whole <= WARNING { Some(self.values(instance)?) } else { None };
            (functions.set_fmu_state)(c, start);
            let mut status = OK;
            for index in 0..parts {
                status = status.max((functions.do_step)(c, instance.known.time + f64::from(index) * part, part, 1));
            }
            let pieces = if status <= WARNING { Some(self.values(instance)?) } else { None };
            (functions.set_fmu_state)(c, start);
            (functions.free_fmu_state)(c, &raw mut start);
            (whole, pieces)
        };
        self.calls += u64::from(parts) + 5;
        match (whole, pieces) {
            (Some(whole), Some(pieces)) => same_values(self.face, &whole, &pieces),
            _ => Ok(()),
        }
    }
}
