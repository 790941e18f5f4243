//! Reading and setting variables of every kind.

use super::Runner;
use crate::call::Kind;
use crate::importer::WARNING;
use brinell_fmu::fmi2::abi::{fmi2Component, fmi2String};
use std::ffi::{CString, c_int};
use std::ptr::{null, null_mut};

impl Runner<'_> {
    pub(super) fn get(
        &self,
        c: fmi2Component,
        kind: Kind,
        references: &[u32],
        no_array: bool,
    ) -> Result<c_int, String> {
        let functions = &self.face.functions;
        let count = references.len();
        let (mut reals, mut integers) = (vec![0.0; count], vec![0; count]);
        let mut strings: Vec<fmi2String> = vec![null(); count];
        let references = references.as_ptr();
        // SAFETY: arrays as long as announced, or null
        let status = unsafe {
            match kind {
                Kind::Real => (functions.get_real)(c, references, count, or_null(&mut reals, no_array)),
                Kind::Integer => (functions.get_integer)(c, references, count, or_null(&mut integers, no_array)),
                Kind::Boolean => (functions.get_boolean)(c, references, count, or_null(&mut integers, no_array)),
                Kind::String => (functions.get_string)(c, references, count, or_null(&mut strings, no_array)),
            }
        };
        if no_array && count > 0 && status <= WARNING {
            return Err("success without an array".into());
        }
        finite(status, &reals)?;
        Ok(status)
    }

    pub(super) fn set(
        &self,
        c: fmi2Component,
        kind: Kind,
        references: &[u32],
        values: &[f64],
        no_array: bool,
    ) -> c_int {
        let functions = &self.face.functions;
        let count = references.len();
        let mut reals = values.to_vec();
        let mut integers: Vec<c_int> = values.iter().map(|value| *value as c_int).collect();
        let text = CString::default();
        let mut strings: Vec<fmi2String> = vec![text.as_ptr(); count];
        let references = references.as_ptr();
        // SAFETY: arrays as long as announced, or null
        unsafe {
            match kind {
                Kind::Real => (functions.set_real)(c, references, count, or_null(&mut reals, no_array)),
                Kind::Integer => (functions.set_integer)(c, references, count, or_null(&mut integers, no_array)),
                Kind::Boolean => (functions.set_boolean)(c, references, count, or_null(&mut integers, no_array)),
                Kind::String => (functions.set_string)(c, references, count, or_null(&mut strings, no_array)),
            }
        }
    }
}

/// The array, or null.
fn or_null<T>(values: &mut [T], is_null: bool) -> *mut T {
    if is_null { null_mut() } else { values.as_mut_ptr() }
}

/// Checks that a successful call returns finite values.
pub(super) fn finite(status: c_int, values: &[f64]) -> Result<(), String> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(value) if status <= WARNING => Err(format!("{value} with status {status}")),
        _ => Ok(()),
    }
}
