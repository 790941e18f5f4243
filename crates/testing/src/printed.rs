//! Agreement with printed numbers, and the models used in the tables.
//!
//! A number agrees if it differs from the printed one by no more than half a unit of the last printed digit, which is the
//! accuracy of the print. Four rounding errors of `f64` are added, which matters for 15 printed digits.

use super::physics::{AnyModel, MASS, mild, model, unit};
use brinell_contact::Model;
use brinell_contact::unloading::{AnyUnloading, DeformedRadius};

/// Checks that `got` agrees with a number printed with this number of `decimals`.
pub fn agrees(what: &str, got: f64, printed: f64, decimals: i32) {
    let half_unit = 0.5 * 10f64.powi(-decimals) + 4.0 * f64::EPSILON * printed.abs();
    assert!((got - printed).abs() <= half_unit, "{what}: {got:.17e} is not the printed {printed:e} (+-{half_unit:e})");
}

/// Checks that `got` agrees with a number printed with this number of significant `digits` (without trailing zeros).
pub fn agrees_in_digits(what: &str, got: f64, printed: f64, digits: i32) {
    agrees(what, got, printed, digits - 1 - printed.abs().log10().floor() as i32);
}

/// The section's law with the closure that a table calls `closure`; `rd165` is the deformed radius with 1.65 S.
pub fn closure(closure: &str) -> AnyModel {
    match closure {
        "rd165" => {
            let unloading = AnyUnloading::DeformedRadius(DeformedRadius { pressure_factor: 1.65 });
            Model { unloading, ..model("big-alabo", "contact-radius") }
        }
        _ => model("big-alabo", closure),
    }
}

/// Speed at which the mild sphere just yields: `m v_y^2/2 = (2/5) F_y d_y` \[m/s\].
pub fn yield_speed() -> f64 {
    let unit = unit(&mild());
    (0.8 * unit.force * unit.indentation / MASS).sqrt()
}
