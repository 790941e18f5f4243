//! Why a call is rejected.

use crate::instance::{Fault, Phase};

/// A rejected call.
#[derive(Clone, Copy, Debug)]
pub enum Complaint {
    /// The instance rejects it.
    Instance(Fault),
    /// An instance cannot be created.
    BadInstance {
        /// The reason.
        reason: &'static str,
    },
    /// The call is not allowed in this phase.
    OutOfOrder {
        /// The phase the instance is in.
        phase: Phase,
    },
    /// A pointer that must not be null is null.
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
    /// The FMU does not have this capability.
    Unsupported,
    /// This information does not exist.
    Unavailable,
    /// The log category is not declared.
    UnknownCategory,
    /// A state that this FMU did not create, or a damaged state.
    BadState {
        /// The defect.
        reason: &'static str,
    },
    /// The host provided no memory.
    NoMemory,
}

impl From<Fault> for Complaint {
    fn from(fault: Fault) -> Complaint {
        Complaint::Instance(fault)
    }
}
