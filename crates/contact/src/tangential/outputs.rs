//! Output quantities of the springs.

/// Slip state of a contact. The numbers are those of the variable `sliding`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sliding {
    /// No contact.
    Apart = 0,
    /// No spring has slipped since the contact last grew or reversed.
    Stick = 1,
    /// An annulus at the edge has slipped.
    PartialSlip = 2,
    /// The whole contact has slipped: Coulomb's limit.
    Sliding = 3,
}

/// A quantity of the friction of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Tangential force in this direction, counted from 0 \[N\].
    Force(usize),
    /// Mean tangential force of the last step in this direction \[N\].
    MeanForce(usize),
    /// Integral of the tangential force in this direction over time since the start \[N.s\].
    Impulse(usize),
    /// Elastic energy of the tangential strain \[J\].
    Energy,
    /// Energy lost by slip since the start \[J\].
    FrictionWork,
    /// Radius of the stick area \[m\].
    StickRadius,
}

impl Sliding {
    /// All states, in the order of their numbers.
    pub const ALL: [Sliding; 4] = [Sliding::Apart, Sliding::Stick, Sliding::PartialSlip, Sliding::Sliding];
}
