//! Hardening: the straight line in place of a power law, and the modulus that belongs to a tangent.

use brinell_contact::hardening::{PowerLaw, modulus_of_tangent};
use proptest::prelude::*;

proptest! {
    /// Of all straight lines, the closest one by least squares leaves an error whose mean and whose moment are zero.
    #[test]
    fn the_error_of_the_straight_line_has_neither_mean_nor_moment(
        (coefficient, exponent, magnitude) in (1e-6..1e18, 0.0..0.9, -6.0..1.0f64)
    ) {
        let strain = 10f64.powf(magnitude);
        let line = PowerLaw { coefficient, exponent }.up_to(strain);
        let stress = coefficient * strain.powf(exponent);
        let [strength, rise] = [line.yield_strength, line.hardening_modulus * strain].map(|value| value / stress);
        let mean = strength + rise / 2.0 - 1.0 / (exponent + 1.0);
        let moment = strength / 2.0 + rise / 3.0 - 1.0 / (exponent + 2.0);
        prop_assert!(mean.abs() < 1e-14 && moment.abs() < 1e-14, "{mean:e} {moment:e}");
        prop_assert!((strength + rise - 1.0 - line.error).abs() < 1e-14);
    }

    /// Elastic and plastic strains add.
    #[test]
    fn a_tangent_has_the_strain_of_both_moduli((youngs_modulus, part) in (1e-6..1e18, 1e-9..0.999)) {
        let tangent = part * youngs_modulus;
        let both = 1.0 / youngs_modulus + 1.0 / modulus_of_tangent(tangent, youngs_modulus);
        prop_assert!((both * tangent - 1.0).abs() < 1e-12);
    }
}
