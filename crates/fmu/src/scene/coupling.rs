//! The coupling between a scene that moves its bodies and the importer that steps it.

use super::storage::{Absent, Presence, Present};
use core::marker::PhantomData;

/// The properties of the coupling with the importer. [`Absent`] for a scene that does not move its bodies.
pub trait Coupling {
    /// Whether the end of the last step is stored. A scene that moves its bodies uses it to detect how the importer applies the
    /// force.
    type Ending: Presence;
    /// Whether the importer applies the force of a step over the next step, as importers do that step all FMUs at once. The
    /// scene then keeps an account of the momentum in transit.
    type Account: Presence;
    /// Whether the acceleration by all forces except the contact force is an input.
    type Acceleration: Presence;
    /// Whether the effective mass is an input.
    type Mass: Presence;
}

impl Coupling for Absent {
    type Ending = Absent;
    type Account = Absent;
    type Acceleration = Absent;
    type Mass = Absent;
}

/// The coupling of a scene that moves its bodies: `D` for the account of momentum, `A` for the acceleration as an input, `M`
/// for the mass as an input.
pub struct Coupled<D = Absent, A = Absent, M = Absent>(PhantomData<(D, A, M)>);

impl<D: Presence, A: Presence, M: Presence> Coupling for Coupled<D, A, M> {
    type Ending = Present;
    type Account = D;
    type Acceleration = A;
    type Mass = M;
}
