//! How a scene that moves its bodies is coupled with the importer that steps it.

use super::storage::{Absent, Presence, Present};
use core::marker::PhantomData;

/// What a scene knows of its master. A scene that doesn't move its bodies knows nothing: [`Absent`].
pub trait Coupling {
    /// Whether the end of the last step is remembered: a scene that moves its bodies tells by it what a master does with its force.
    type Ending: Presence;
    /// Whether the master applies the force of a step over the next one, as one does that steps all units at once: an account is
    /// kept of the momentum that is on its way.
    type Account: Presence;
    /// Whether the acceleration by all other forces is an input.
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

/// The coupling of a scene that moves its bodies: with an account `D` of momentum, and with the inputs `A`, the acceleration,
/// and `M`, the mass.
pub struct Coupled<D = Absent, A = Absent, M = Absent>(PhantomData<(D, A, M)>);

impl<D: Presence, A: Presence, M: Presence> Coupling for Coupled<D, A, M> {
    type Ending = Present;
    type Account = D;
    type Acceleration = A;
    type Mass = M;
}
