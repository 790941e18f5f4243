//! Numbers as 64-bit words for saved states, and back. Everything that is saved uses this loop.

/// Passes each of `numbers` to `store`.
#[inline(never)]
pub fn store_numbers(numbers: &[f64], store: &mut impl FnMut(u64)) {
    for number in numbers {
        store(number.to_bits());
    }
}

/// The numbers that [`store_numbers`] has stored; `None` if one is missing or not finite.
#[inline(always)]
pub fn load_numbers<const COUNT: usize>(words: &mut impl Iterator<Item = u64>) -> Option<[f64; COUNT]> {
    let mut numbers = [0.0; COUNT];
    if fill_with_numbers(&mut numbers, words) { Some(numbers) } else { None }
}

/// The number of numbers that are `kept`.
pub const fn count<const COUNT: usize>(kept: [bool; COUNT]) -> usize {
    let (mut sum, mut rest) = (0, kept.as_slice());
    while let [first, others @ ..] = rest {
        sum += *first as usize;
        rest = others;
    }
    sum
}

/// Passes those of `numbers` that are `kept` to `store`.
pub fn store_kept<const COUNT: usize>(numbers: [f64; COUNT], kept: [bool; COUNT], store: &mut impl FnMut(u64)) {
    numbers.into_iter().zip(kept).filter(|(_, kept)| *kept).for_each(|(number, _)| store(number.to_bits()));
}

/// The numbers that [`store_kept`] has stored, and zeros for the others; `None` if one is missing or not finite.
pub fn load_kept<const COUNT: usize>(
    kept: [bool; COUNT],
    words: &mut impl Iterator<Item = u64>,
) -> Option<[f64; COUNT]> {
    let mut numbers = [0.0; COUNT];
    for (slot, _) in numbers.iter_mut().zip(kept).filter(|(_, kept)| *kept) {
        [*slot] = load_numbers(words)?;
    }
    Some(numbers)
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
