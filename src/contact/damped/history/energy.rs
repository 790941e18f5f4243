//! The energies of a rate-dependent contact: what becomes of the work done on it.

use super::History;
use crate::contact::damped::Damped;

impl<D: Damped + Copy> History<D> {
    /// What the elastic force would give back on a slow way out \[J\].
    pub(super) fn stored(&self) -> f64 {
        let indentation = self.indentation.total();
        if indentation > 0.0 { self.factors.elastic * self.law.elastic(indentation).integral } else { 0.0 }
    }

    /// Work turned into heat on the way `from`..`to` \[m\], both >= 0, with `rate` \[m/s\], \[J\]: that of the damping, and where the
    /// surface would have to pull the elastic energy that nobody takes.
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
            // the pieces on the way back, from above to below
            let begin = end;
            end = if border > to { border } else { to };
            if end >= begin {
                end = begin;
                continue;
            }
            // inside a piece the force changes its sign at most once
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
