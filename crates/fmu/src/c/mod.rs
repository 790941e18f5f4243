//! What every version of FMI needs at a C interface.
//!
//! | module | content |
//! |---|---|
//! | `bytes` | copying and comparing bytes, compiled separately, for systems without a C library to rely on |
//! | [`complaint`] | the reason why a call is rejected |
//! | [`handle`] | the pointers that importers get, each with its type, and those that they give |
//! | [`memory`] | memory from the process, or from the importer |
//! | [`span`] | arrays in the memory behind an object |
//! | [`state`] | FMU states and their bytes |
//! | [`text`] | text without allocation or panic |
//! | [`words`] | words of memory as numbers and as bytes |
#![allow(unsafe_code)]

#[cfg(test)]
mod bytes;
pub mod complaint;
pub mod handle;
pub mod memory;
pub mod span;
pub mod state;
pub mod text;
pub mod words;
