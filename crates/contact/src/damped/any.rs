//! Every rate-dependent law in one type.

use super::*;

impl Damped for AnyDamped {
    fn factors(&self, pair: &Pair, restitution: f64, mass: f64) -> Factors {
        self.law().factors(pair, restitution, mass)
    }

    fn elastic(&self, indentation: f64) -> Shape {
        self.law().elastic(indentation)
    }

    fn damping(&self, indentation: f64) -> Shape {
        self.law().damping(indentation)
    }

    fn needs_restitution(&self) -> bool {
        self.law().needs_restitution()
    }

    fn needs_mass(&self) -> bool {
        self.law().needs_mass()
    }

    fn scaled_by_touch(&self) -> bool {
        self.law().scaled_by_touch()
    }

    fn borders(&self) -> [f64; 2] {
        self.law().borders()
    }
}
