//! Where something begins to hold, to the last bit.

/// The number nearest to `outside`, where something doesn't hold, at which it `holds`, as it does at `inside`. Both are at least zero: the
/// bits of such numbers, read as integers, keep their order, so that few steps lead from any size to any other.
pub fn border((outside, inside): (f64, f64), holds: impl Fn(f64) -> bool) -> f64 {
    let (mut outside, mut inside) = (outside.to_bits(), inside.to_bits());
    loop {
        let middle = outside.midpoint(inside);
        if middle == outside || middle == inside {
            return f64::from_bits(inside);
        }
        *(if holds(f64::from_bits(middle)) { &mut inside } else { &mut outside }) = middle;
    }
}
