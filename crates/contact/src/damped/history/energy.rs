//! The energies of a rate-dependent contact: where the work done on it goes.

use super::History;
use crate::damped::Damped;

impl<D: Damped + Copy> History<D> {
    /// Energy that the elastic force would return in a slow separation \[J\].
    pub(super) fn stored(&self) -> f64 {
        let indentation = self.indentation.total();
        if indentation > 0.0 { self.factors.elastic * self.law.elastic(indentation).integral } else { 0.0 }
    }

    /// Energy dissipated on the way from `from` to `to` \[m\], both >= 0, at `rate` \[m/s\], in J. It is the work of the
    /// damping. Where the surface would have to pull, it is the elastic energy that is released without force.
    pub(super) fn dissipation(&self, from: f64, to: f64, rate: f64) -> f64 {
        let damping = |from: f64, to: f64| {
            let way = self.law.damping(to).integral - self.law.damping(from).integral;
            self.damping_force(rate) * way
        };
        if rate >= 0.0 {
            return damping(from, to);
        }
        let elastic = |from: f64, to: f64| {
            self.factors.elastic * (self.law.elastic(from).integral - self.law.elastic(to).integral)
        };
        let mut energy = 0.0;
        let mut end = from;
        let [first, second] = self.law.borders();
        for border in [second, first, to] {
            // the pieces of a separation, from the deepest on
            let begin = end;
            end = if border > to { border } else { to };
            if end >= begin {
                end = begin;
                continue;
            }
            // within a piece the force changes its sign at most once
            let change = self.sign_change(end, begin, rate);
            let (above, below) = (0.5 * (begin + change), 0.5 * (change + end));
            for (middle, high, low) in [(above, begin, change), (below, change, end)] {
                let pushes = self.sum_of_forces(middle, rate) > 0.0;
                energy += if pushes { damping(high, low) } else { elastic(high, low) };
            }
        }
        energy
    }
}
