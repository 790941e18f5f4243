//! Detects an importer whose steps are too long for the force that it applies.
//!
//! An explicit importer that moves a mass by the contact force is stable up to steps of `2 sqrt(m/K)`. Beyond, the mass gains
//! energy with every step. A prescribed motion is exact at any step. The difference: the rate of a coupled mass responds to the
//! force, by `-h F/m` from step to step.

use super::*;

/// Rounding of a master's own sums, as a part of the change of its rate.
const ROUNDING: f64 = 1e-9;

/// `h^2 K/m` of the largest stable step.
const STABLE: f64 = 4.0;

/// What stands for a contact in the place of one that is too deep: none, but a step that was too long.
pub(super) const UNSTABLE: u32 = u32::MAX;

/// Whether the step that a contact is about to make from `history`, `step` \[s\] long, is longer than a stable one, and its `rate`
/// \[m/s\] answers the force; `before` is the rate of the last step that was looked at. A mass in such steps throws the contact from
/// branch to branch: steps on one branch needn't be looked at.
#[cold]
#[inline(never)]
fn is_unstable<S: Scene>(before: &mut f64, history: &S::Contact, rate: f64, step: f64) -> bool {
    let change = rate - core::mem::replace(before, rate);
    let inverse_mass = 1.0 / S::impact_mass();
    // the speed that the force takes in such a step
    let kick = step * inverse_mass * history.force(rate);
    let long = step * step * inverse_mass * history.stiffness(rate) > STABLE;
    kick > 0.0 && long && (change + kick).abs() <= ROUNDING * kick
}

/// What is to be told of a step, if it [is unstable](is_unstable).
#[inline]
pub(super) fn watch<S: Scene>(
    watched: &mut IfPresent<S::Watch, S, f64>,
    contact: usize,
    history: &S::Contact,
    rate: f64,
    step: f64,
) -> Option<Deep> {
    let before = watched.as_mut().get_mut(contact)?;
    is_unstable::<S>(before, history, rate, step).then_some(Deep { contact: UNSTABLE, indentation: step })
}
