//! The C interface of FMI 2.0 for co-simulation: 34 functions, and the ten of Model Exchange as refusals.
//!
//! The functions are written once for any [`Scene`](crate::scene::Scene). The crate of an FMU instantiates
//! them as C symbols for the scene that the exporter has written, or for the one in the block of a prebuilt library.
//!
//! | module | content |
//! |---|---|
//! | [`abi`] | the types of the standard's headers |
//! | [`component`] | the object behind an `fmi2Component`; the guard that every call passes |
//! | [`order`] | which function may be called in which phase: the standard's state table |
//! | [`category`] | the categories of the log, and the status of a rejected call |
//! | [`report`] | the text of a rejected call or a warning |
//! | [`lifecycle`], [`variables`], [`stepping`], [`status`], [`states`] | the functions, for any scene |
//!
//! # Safety
//! Every function relies on its caller for what C cannot check: components that this library has created and not freed, arrays
//! of the given length, and null-terminated strings. Null pointers, unknown references, calls out of order and damaged states
//! are rejected.
#![allow(unsafe_code)]
#![allow(non_camel_case_types, non_snake_case, non_upper_case_globals, clippy::missing_safety_doc)]

pub mod abi;
pub mod category;
pub mod component;
pub mod lifecycle;
pub mod order;
pub mod report;
pub mod states;
pub mod status;
pub mod stepping;
pub mod variables;
