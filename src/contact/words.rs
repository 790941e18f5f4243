//! Numbers as words for saved states, and back. Everything that is saved uses this loop.

/// Passes each of `numbers` to `store`.
#[inline(never)]
pub(crate) fn store_numbers(numbers: &[f64], store: &mut impl FnMut(u64)) {
    for number in numbers {
        store(number.to_bits());
    }
}

/// The numbers that [`store_numbers`] has stored; `None` if one is missing or not finite.
#[inline(always)]
pub(crate) fn load_numbers<const COUNT: usize>(words: &mut impl Iterator<Item = u64>) -> Option<[f64; COUNT]> {
    let mut numbers = [0.0; COUNT];
    if fill_with_numbers(&mut numbers, words) { Some(numbers) } else { None }
}

/// The same for any count; false if one is missing or not finite.
#[inline(never)]
fn fill_with_numbers(numbers: &mut [f64], words: &mut impl Iterator<Item = u64>) -> bool {
    for slot in numbers {
        match words.next().map(f64::from_bits) {
            Some(number) if number.is_finite() => *slot = number,
            _ => return false,
        }
    }
    true
}
