//! The depths at which the growth of a dent is divided.

/// Bits of the mantissa below the first four.
const BELOW: u64 = (1 << 48) - 1;

/// The next point above `indentation` \[m\] of the lattice of the yield indentation `unit` \[m\]: a sixteenth of it
/// times `(16 + k) 2^n`, with `k` from 0 to 15. Infinite without a yield indentation.
///
/// A step that grows the dent over several of these depths is divided there. The error of a growth step is of second
/// order in its length. The result therefore depends little on the time steps.
pub(super) fn next_of_lattice(indentation: f64, unit: f64) -> f64 {
    if !(unit > 0.0 && unit < f64::INFINITY) {
        return f64::INFINITY;
    }
    let reached = (indentation / unit).to_bits() & !BELOW;
    let next = |steps: u64| f64::from_bits(reached.wrapping_add(steps * (BELOW + 1))) * unit;
    // rounding down of the product may lead back to where the quotient came from
    if next(1) > indentation { next(1) } else { next(2) }
}

#[cfg(test)]
mod tests {
    use super::next_of_lattice;

    #[test]
    fn the_lattice_has_sixteen_depths_for_each_doubling() {
        for unit in [1.0, 3.3e-8, 7e-20] {
            let mut depth = unit;
            for turn in 0..400 {
                let next = next_of_lattice(depth, unit);
                assert!(next > depth && next <= 1.0625 * depth * (1.0 + 1e-15), "{turn}: {depth:e} {next:e}");
                assert_eq!(next_of_lattice(0.5 * (depth + next), unit), next, "from anywhere below");
                depth = next;
            }
            assert!((depth / unit / 2f64.powi(25) - 1.0).abs() < 1e-13, "{depth:e}");
        }
        assert_eq!(next_of_lattice(1.0, 0.0), f64::INFINITY);
    }
}
