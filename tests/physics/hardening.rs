//! Hardening: the straight line in place of a power law, and the modulus that belongs to a tangent.

use crate::physics::Random;
use brinell_contact::material::hardening::{PowerLaw, modulus_of_tangent};

/// Of all straight lines, the closest one by least squares leaves an error whose mean and whose moment are zero.
#[test]
fn the_error_of_the_straight_line_has_neither_mean_nor_moment() {
    let mut random = Random(1861);
    for _ in 0..256 {
        let (coefficient, exponent) = (random.log_uniform(1e-6, 1e18), 0.9 * random.next());
        let strain = random.log_uniform(1e-6, 10.0);
        let law = PowerLaw { coefficient, exponent };
        let line = law.up_to(strain);
        let stress = coefficient * strain.powf(exponent);
        let [strength, rise] = [line.yield_strength, line.hardening_modulus * strain].map(|value| value / stress);
        let mean = strength + rise / 2.0 - 1.0 / (exponent + 1.0);
        let moment = strength / 2.0 + rise / 3.0 - 1.0 / (exponent + 2.0);
        assert!(mean.abs() < 1e-14 && moment.abs() < 1e-14, "{law:?} to {strain:e}: {mean:e} {moment:e}");
        assert!((strength + rise - 1.0 - line.error).abs() < 1e-14, "{law:?} to {strain:e}");
    }
}

/// Elastic and plastic strains add.
#[test]
fn a_tangent_has_the_strain_of_both_moduli() {
    let mut random = Random(1909);
    for _ in 0..256 {
        let (youngs_modulus, part) = (random.log_uniform(1e-6, 1e18), random.log_uniform(1e-9, 0.999));
        let tangent = part * youngs_modulus;
        let both = 1.0 / youngs_modulus + 1.0 / modulus_of_tangent(tangent, youngs_modulus);
        assert!((both * tangent - 1.0).abs() < 1e-12, "{part:e} of {youngs_modulus:e}");
    }
}
