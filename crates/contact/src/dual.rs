//! A number with its derivative. It gives the slope of a long formula without a second formula.

use core::ops::{Add, Mul, Sub};
use libm::{cos, cosh, exp, expm1, pow, sin, sinh, sqrt};

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
        Dual { value: -expm1(-self.value), slope: exp(-self.value) * self.slope }
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

    /// `1 / cosh u` for `u >= 0`.
    pub fn sech(self) -> Dual {
        let cosine = cosh(self.value);
        let value = 1.0 / cosine;
        // beyond 40 the hyperbolic tangent is 1, and sinh may overflow
        let tangent = if self.value < 40.0 { sinh(self.value) / cosine } else { 1.0 };
        Dual { value, slope: -value * tangent * self.slope }
    }

    /// `1 - 1 / cosh u` for `u >= 0`, without cancellation: `2 sinh(u/2)^2 / cosh u`. `u` must be below 700.
    pub fn one_less_sech(self) -> Dual {
        let half = sinh(0.5 * self.value);
        Dual { value: 2.0 * half * half / cosh(self.value), slope: -self.sech().slope }
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
