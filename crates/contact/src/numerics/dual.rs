//! A number with its derivative. It gives the slope of a long formula without a second formula.

use crate::numerics::saturation;
use core::ops::{Add, Mul, Sub};
use libm::{cos, exp, pow, sin, sqrt};

/// `value` and its derivative with respect to the one variable of the formula.
///
/// Reference: A. Griewank, A. Walther, *Evaluating Derivatives*, SIAM 2008, section 3.1 (forward mode).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual {
    /// The number.
    pub value: f64,
    /// Its derivative.
    pub slope: f64,
}

impl Dual {
    /// The variable itself.
    pub fn variable(value: f64) -> Dual {
        Dual { value, slope: 1.0 }
    }

    /// A number that does not depend on the variable.
    pub fn constant(value: f64) -> Dual {
        Dual { value, slope: 0.0 }
    }

    /// `e^u`.
    pub fn exp(self) -> Dual {
        let value = exp(self.value);
        Dual { value, slope: value * self.slope }
    }

    /// `1 - e^(-u)` without cancellation.
    pub fn saturation(self) -> Dual {
        Dual { value: saturation(self.value), slope: exp(-self.value) * self.slope }
    }

    /// `u^exponent` for `u > 0`.
    pub fn power(self, exponent: f64) -> Dual {
        let value = pow(self.value, exponent);
        Dual { value, slope: exponent * (value / self.value) * self.slope }
    }

    /// `1/u` for `u > 0`.
    pub fn inverse(self) -> Dual {
        let value = 1.0 / self.value;
        Dual { value, slope: -value * value * self.slope }
    }

    /// `sqrt u` for `u > 0`.
    pub fn root(self) -> Dual {
        let value = sqrt(self.value);
        Dual { value, slope: 0.5 / value * self.slope }
    }

    /// `cos u`.
    pub fn cos(self) -> Dual {
        Dual { value: cos(self.value), slope: -sin(self.value) * self.slope }
    }

    /// `1 / cosh u` for `u >= 0`: with `e = e^(-u)`, `2 e / (1 + e^2)`; its slope is `-tanh u / cosh u`.
    pub fn sech(self) -> Dual {
        let decayed = exp(-self.value);
        let whole = 1.0 + decayed * decayed;
        let value = 2.0 * decayed / whole;
        Dual { value, slope: -value * (saturation(2.0 * self.value) / whole) * self.slope }
    }

    /// `1 - 1 / cosh u` for `u >= 0`, without cancellation: with `e = e^(-u)`, `(1 - e)^2 / (1 + e^2)`.
    pub fn one_less_sech(self) -> Dual {
        let (decayed, growing) = (exp(-self.value), saturation(self.value));
        Dual { value: growing * growing / (1.0 + decayed * decayed), slope: -self.sech().slope }
    }
}

impl Add for Dual {
    type Output = Dual;
    fn add(self, other: Dual) -> Dual {
        Dual { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Sub for Dual {
    type Output = Dual;
    fn sub(self, other: Dual) -> Dual {
        Dual { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl Mul for Dual {
    type Output = Dual;
    fn mul(self, other: Dual) -> Dual {
        Dual { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
}

impl Mul<Dual> for f64 {
    type Output = Dual;
    fn mul(self, other: Dual) -> Dual {
        Dual { value: self * other.value, slope: self * other.slope }
    }
}
