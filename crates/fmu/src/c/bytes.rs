//! The functions to which compilers translate copies and loops over memory, for systems without a C library that an FMU can
//! rely on.
//!
//! The exporter compiles this file as a separate crate in which the compiler does not know these functions (`no_builtins`).
//! Otherwise the compiler would replace their loops by calls of themselves. The linker takes only what the library uses.
//!
//! # Safety
//! As in the C standard: the pointers are valid for the given number of bytes, and those of `memcpy` do not overlap.

/// Number of bytes moved at once.
const WORD: usize = size_of::<u64>();

/// Copies `count` bytes.
#[cfg_attr(not(test), unsafe(no_mangle))]
pub unsafe extern "C" fn memcpy(to: *mut u8, from: *const u8, count: usize) -> *mut u8 {
    let mut at = 0;
    while count - at >= WORD {
        // SAFETY: `at + WORD <= count`.
        unsafe { to.add(at).cast::<u64>().write_unaligned(from.add(at).cast::<u64>().read_unaligned()) };
        at += WORD;
    }
    while at < count {
        // SAFETY: `at < count`.
        unsafe { to.add(at).write(from.add(at).read()) };
        at += 1;
    }
    to
}

/// Copies `count` bytes; the two ranges may overlap.
#[cfg_attr(not(test), unsafe(no_mangle))]
pub unsafe extern "C" fn memmove(to: *mut u8, from: *const u8, count: usize) -> *mut u8 {
    if to.addr().wrapping_sub(from.addr()) >= count {
        // SAFETY: the target does not begin within the source, and an ascending copy reads every word before it is overwritten.
        return unsafe { memcpy(to, from, count) };
    }
    let mut end = count;
    while end >= WORD {
        end -= WORD;
        // SAFETY: `end + WORD <= count`.
        unsafe { to.add(end).cast::<u64>().write_unaligned(from.add(end).cast::<u64>().read_unaligned()) };
    }
    while end > 0 {
        end -= 1;
        // SAFETY: `end < count`.
        unsafe { to.add(end).write(from.add(end).read()) };
    }
    to
}

/// Sets `count` bytes to the lowest byte of `value`.
#[cfg_attr(not(test), unsafe(no_mangle))]
pub unsafe extern "C" fn memset(to: *mut u8, value: i32, count: usize) -> *mut u8 {
    let byte = value as u8;
    let word = u64::from_ne_bytes([byte; WORD]);
    let mut at = 0;
    while count - at >= WORD {
        // SAFETY: `at + WORD <= count`.
        unsafe { to.add(at).cast::<u64>().write_unaligned(word) };
        at += WORD;
    }
    while at < count {
        // SAFETY: `at < count`.
        unsafe { to.add(at).write(byte) };
        at += 1;
    }
    to
}

/// Sets `count` bytes to zero: what compilers call on macOS on x86-64.
#[cfg(any(test, target_vendor = "apple"))]
#[cfg_attr(not(test), unsafe(no_mangle))]
pub unsafe extern "C" fn __bzero(to: *mut u8, count: usize) {
    // SAFETY: guaranteed by the caller.
    unsafe { memset(to, 0, count) };
}

/// The same for macOS on arm64.
#[cfg(any(test, target_vendor = "apple"))]
#[cfg_attr(not(test), unsafe(no_mangle))]
pub unsafe extern "C" fn bzero(to: *mut u8, count: usize) {
    // SAFETY: guaranteed by the caller.
    unsafe { memset(to, 0, count) };
}

/// Fills `count` bytes with the 16 bytes of `pattern`, again and again: what compilers call on macOS for a repeated number.
#[cfg(any(test, target_vendor = "apple"))]
#[cfg_attr(not(test), unsafe(no_mangle))]
pub unsafe extern "C" fn memset_pattern16(to: *mut u8, pattern: *const u8, count: usize) {
    let mut at = 0;
    while at < count {
        // SAFETY: `at < count`, and a pattern has 16 bytes.
        unsafe { to.add(at).write(pattern.add(at % 16).read()) };
        at += 1;
    }
}

/// The difference of the first two bytes that differ, or 0.
#[cfg_attr(not(test), unsafe(no_mangle))]
pub unsafe extern "C" fn memcmp(one: *const u8, other: *const u8, count: usize) -> i32 {
    let mut at = 0;
    while at < count {
        // SAFETY: `at < count`.
        let (first, second) = unsafe { (one.add(at).read(), other.add(at).read()) };
        if first != second {
            return i32::from(first) - i32::from(second);
        }
        at += 1;
    }
    0
}

/// 0 if the bytes are equal.
#[cfg_attr(not(test), unsafe(no_mangle))]
pub unsafe extern "C" fn bcmp(one: *const u8, other: *const u8, count: usize) -> i32 {
    // SAFETY: guaranteed by the caller.
    unsafe { memcmp(one, other, count) }
}

/// Number of bytes before the null byte that ends `text`.
#[cfg_attr(not(test), unsafe(no_mangle))]
pub unsafe extern "C" fn strlen(text: *const u8) -> usize {
    let mut count = 0;
    // SAFETY: no byte after the null byte is read.
    while unsafe { text.add(count).read() } != 0 {
        count += 1;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::{__bzero, bcmp, bzero, memcmp, memcpy, memmove, memset, memset_pattern16, strlen};
    use std::vec::Vec;

    /// longer than several words
    const LENGTH: usize = 40;

    fn bytes() -> Vec<u8> {
        (1..=LENGTH as u8).collect()
    }

    #[test]
    fn every_length_is_copied_and_set_from_and_to_every_place() {
        for count in 0..=24 {
            for from in 0..=16 {
                for to in 0..=16 {
                    let (source, mut copy, mut moved, mut set) = (bytes(), bytes(), bytes(), bytes());
                    // SAFETY: both places end before LENGTH.
                    unsafe {
                        memcpy(copy.as_mut_ptr().add(to), source.as_ptr().add(from), count);
                        let start = moved.as_mut_ptr();
                        memmove(start.add(to), start.add(from), count);
                        memset(set.as_mut_ptr().add(to), 0x1ff, count);
                    }
                    let mut expected = bytes();
                    expected.copy_within(from..from + count, to);
                    assert_eq!(copy, expected, "memcpy of {count} from {from} to {to}");
                    assert_eq!(moved, expected, "memmove of {count} from {from} to {to}");
                    expected = bytes();
                    expected[to..to + count].fill(0xff);
                    assert_eq!(set, expected, "memset of {count} at {to}");
                }
            }
        }
    }

    #[test]
    fn the_functions_of_macos_fill_any_range() {
        let pattern = bytes();
        for count in 0..=35 {
            for to in 0..=5 {
                let mut filled = [bytes(), bytes(), bytes()];
                let [zero, zero_too, repeated] = filled.each_mut().map(|bytes| bytes[to..].as_mut_ptr());
                // SAFETY: `to + count` is at most LENGTH, and the pattern is longer than 16 bytes.
                unsafe {
                    __bzero(zero, count);
                    bzero(zero_too, count);
                    memset_pattern16(repeated, pattern.as_ptr(), count);
                }
                let [mut zeroed, mut expected] = [bytes(), bytes()];
                zeroed[to..to + count].fill(0);
                (0..count).for_each(|at| expected[to + at] = pattern[at % 16]);
                assert_eq!(filled, [zeroed.clone(), zeroed, expected], "{count} bytes at {to}");
            }
        }
    }

    #[test]
    fn the_first_different_byte_decides() {
        for count in 0..LENGTH {
            for at in 0..LENGTH {
                let (one, mut other) = (bytes(), bytes());
                other[at] = 200;
                // SAFETY: both are longer than `count`.
                let results = unsafe {
                    let [one, other] = [one.as_ptr(), other.as_ptr()];
                    [memcmp(one, other, count), memcmp(other, one, count), bcmp(one, other, count)]
                };
                let difference = if at < count { i32::from(one[at]) - 200 } else { 0 };
                assert_eq!(results, [difference, -difference, difference], "{count} bytes, other at {at}");
            }
        }
    }

    #[test]
    fn a_text_ends_before_its_zero() {
        for length in 0..LENGTH {
            let mut text = bytes();
            text[length] = 0;
            // SAFETY: the null byte exists.
            assert_eq!(unsafe { strlen(text.as_ptr()) }, length);
        }
    }
}
