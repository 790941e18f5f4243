//! The scales of a motion, by which its errors are measured: its energy, and the shortest time of an oscillation.

use super::SharedContact;
use super::block::Block;
use super::branch::Kind;
use crate::loading::hertz::EXPONENT as HERTZ;
use crate::numerics::{largest, quotient, root, smallest};
use crate::segment::Segment;
use core::borrow::Borrow;
use libm::{fabs, pow, sqrt};

/// The scales of a motion.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Scales {
    /// The root of twice the energy \[J^0.5\]. No rate is above its product with the root of the inverse mass.
    pub root_energy: f64,
    /// The shortest time of an oscillation \[s\].
    pub time: f64,
}

/// Energies grow by this factor before the time is computed again.
pub(super) const GROWN: f64 = 1.2;

/// The indentation \[m\] at which both parts of a segment that are given, of the first power and of the other one, are below
/// a limit: `(limit/linear)^first` and `(limit/power)^second`. Infinite for a segment without force.
fn indentation_at(segment: &Segment, (linear, first): (f64, f64), (power, second): (f64, f64)) -> f64 {
    let of_part = |limit: f64, part: f64, exponent: f64| {
        let exists = part > 1e-100 * limit;
        let ratio = quotient(limit, part, exists, 0.0);
        if exists { pow(ratio, exponent) } else { f64::INFINITY }
    };
    smallest(of_part(linear, segment.linear, first), of_part(power, segment.power, second))
}

/// Energy \[J\] of a contact under this `load` \[N\].
pub(super) fn energy_of_load((segment, exponent): (&Segment, f64), load: f64) -> f64 {
    let way = indentation_at(segment, (load, 1.0), (load, 1.0 / exponent));
    if load > 0.0 && way < f64::INFINITY { load * way } else { 0.0 }
}

/// Stiffness \[N/m\] of a contact that has taken up this `energy` \[J\].
pub(super) fn stiffness_at((segment, exponent): (&Segment, f64), energy: f64) -> f64 {
    let of_power = 1.0 + exponent;
    let way = indentation_at(segment, (2.0 * energy, 0.5), (of_power * energy, 1.0 / of_power));
    let way = if way < f64::INFINITY { way } else { 0.0 };
    // a path that softens ends before its stiffness does
    let way = if segment.square < 0.0 { smallest(way, segment.upper - segment.origin) } else { way };
    let power = if exponent == HERTZ { root(way) } else { pow(way, exponent - 1.0) };
    segment.linear + exponent * segment.power * power + 2.0 * segment.square * way
}

impl<C: SharedContact<M>, M, B: Borrow<M>, F: Fn(usize) -> B> Block<'_, C, M, B, F> {
    /// The scales of the motion, from the largest energy so far.
    pub(super) fn rescale(&mut self) {
        let (mut moving, mut stored, mut least) = (0.0, 0.0, 0.0);
        for (place, member) in self.members() {
            let (rate, inverse_mass) = (member.now.rate(), member.inverse_mass);
            let kinetic = 0.5 * rate * rate / inverse_mass;
            moving = largest(if member.is_held { 0.0 } else { kinetic }, moving);
            if member.branch.kind != Kind::Apart {
                // of Hertz's contact, and not more than that of a spring over the whole indentation
                let (force, stiffness) = (fabs(member.now.elastic), self.stiffness(place, member));
                let spring = quotient(0.6 * force * force, stiffness, stiffness > 1e-100 * force, 0.0);
                stored += smallest(spring, 0.5 * force * fabs(member.now.indentation()));
            }
            // bodies that are set down have no energy yet
            least = largest(energy_of_load(member.branch.scale(), fabs(member.acceleration) / inverse_mass), least);
        }
        let energy = largest(largest(moving + stored, least), self.energy);
        self.scales.root_energy = sqrt(2.0 * energy);
        if self.scales.time > 0.0 && energy <= GROWN * self.energy && !self.touched {
            return;
        }
        self.energy = energy;
        let mut fastest = 0.0;
        for (_, member) in self.members() {
            let stiffness = stiffness_at(member.branch.scale(), energy);
            let decay = member.loss.as_ref().map_or(0.0, |loss| loss.decay(stiffness, member.inverse_mass));
            fastest = largest(largest(member.inverse_mass * stiffness, decay * decay), fastest);
        }
        self.scales.time = quotient(1.0, sqrt(fastest), fastest > 0.0, self.left);
    }
}
