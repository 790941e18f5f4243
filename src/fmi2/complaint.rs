//! Why a call is rejected.

use crate::instance::{Fault, Phase};

/// A refused call.
#[derive(Clone, Copy, Debug)]
pub enum Complaint {
    /// The instance refuses it.
    Instance(Fault),
    /// An instance can't be made.
    BadInstance {
        /// Why.
        reason: &'static str,
    },
    /// The call doesn't belong in this phase.
    OutOfOrder {
        /// The phase the instance is in.
        phase: Phase,
    },
    /// A pointer that must not be null is.
    NullPointer {
        /// Name of the argument.
        argument: &'static str,
    },
    /// No variable of this type has this reference.
    UnknownReference {
        /// Type of the call.
        kind: &'static str,
        /// The reference.
        reference: u32,
    },
    /// The unit doesn't have this capability.
    Unsupported,
    /// There is no such information.
    Unavailable,
    /// Logging of a category that isn't declared.
    UnknownCategory,
    /// A state that this unit didn't make, or a damaged one.
    BadState {
        /// What is wrong with it.
        reason: &'static str,
    },
    /// The host gave no memory.
    NoMemory,
}

impl From<Fault> for Complaint {
    fn from(fault: Fault) -> Complaint {
        Complaint::Instance(fault)
    }
}
