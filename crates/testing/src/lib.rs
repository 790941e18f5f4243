//! What the tests share.

pub mod mutations;
