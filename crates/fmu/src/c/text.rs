//! Text without allocation or panic, for log messages.

use core::ffi::c_char;

/// Whether the string at `text` is equal to `own`. It does not use the C library, whose functions the loader would have to
/// bind.
///
/// # Safety
/// `text` is null-terminated.
#[inline(never)]
pub unsafe fn is_same(text: *const c_char, own: &[u8]) -> bool {
    let mut bytes = own.iter().copied().chain([0]).enumerate();
    // SAFETY: there is a next byte if all bytes before were equal to those of `own`, and not the terminating 0.
    bytes.all(|(place, byte)| unsafe { *text.add(place) } as u8 == byte)
}

/// Length of the string at `text` with its terminating 0 \[bytes\], and whether it contains anything but white space.
///
/// # Safety
/// `text` is null-terminated.
pub unsafe fn extent(text: *const c_char) -> (usize, bool) {
    let (mut length, mut says_something) = (0, false);
    loop {
        // SAFETY: no byte before was the terminating 0.
        let byte = unsafe { *text.add(length) } as u8;
        length += 1;
        if byte == 0 {
            return (length, says_something);
        }
        says_something |= !byte.is_ascii_whitespace();
    }
}

/// Capacity for a message with its terminating 0.
const CAPACITY: usize = 320;

/// A message for the importer's logger: a null-terminated printf format without arguments.
pub struct Text {
    bytes: [u8; CAPACITY],
    length: usize,
}

impl Text {
    /// An empty text.
    pub(crate) fn new() -> Text {
        Text { bytes: [0; CAPACITY], length: 0 }
    }

    /// The text as a C string.
    pub fn as_ptr(&self) -> *const c_char {
        self.bytes.as_ptr().cast()
    }

    /// Appends `text`; what does not fit is cut off.
    pub fn string(&mut self, text: &str) -> &mut Text {
        self.bytes(text.as_bytes())
    }

    /// Appends a `text` in UTF-8; what does not fit is cut off. `%` and `#` are doubled, because they are special to printf and
    /// to the importer's logger (FMI 2.0.5, section 2.1.5).
    #[inline(never)]
    pub fn bytes(&mut self, text: &[u8]) -> &mut Text {
        for &byte in text {
            if byte == b'%' || byte == b'#' {
                self.byte(byte);
            }
            self.byte(byte);
        }
        self
    }

    /// Appends `byte`, if it fits.
    #[inline(never)]
    pub(crate) fn byte(&mut self, byte: u8) -> &mut Text {
        // the last byte remains 0
        if self.length < CAPACITY - 1
            && let Some(slot) = self.bytes.get_mut(self.length)
        {
            *slot = byte;
            self.length += 1;
        }
        self
    }

    /// Appends `value` in decimal.
    pub fn integer(&mut self, value: u32) -> &mut Text {
        self.digits(value, 0)
    }

    /// Appends the digits of `value`, with a decimal point after the first `before_point` of them. Zeros are added if there are
    /// fewer digits. There is no point if `before_point` is not positive.
    #[inline(never)]
    fn digits(&mut self, mut value: u32, before_point: i32) -> &mut Text {
        let mut reversed = [0; MOST_DIGITS];
        let mut count = 0;
        for slot in &mut reversed {
            *slot = (value % 10) as u8;
            value /= 10;
            count += 1;
            if value == 0 {
                break;
            }
        }
        let last = if before_point > count { before_point } else { count };
        for place in 0..last {
            if place == before_point && place > 0 {
                self.byte(b'.');
            }
            // after the last digit there is none
            let digit = reversed.get((count - 1 - place) as usize);
            self.byte(b'0' + digit.copied().unwrap_or(0));
        }
        self
    }

    /// Appends `value` like `%.9g`, except that the last digit may be off by one, because scaling by powers of ten rounds.
    #[inline(never)]
    pub fn number(&mut self, value: f64) -> &mut Text {
        if value.is_nan() {
            return self.string("NaN");
        }
        if value.is_sign_negative() {
            self.byte(b'-');
        }
        let magnitude = value.abs();
        if magnitude.is_infinite() {
            return self.string("infinity");
        }
        if magnitude == 0.0 {
            return self.byte(b'0');
        }
        let (digits, exponent) = nine_digits(magnitude);
        if !(-5..9).contains(&exponent) {
            let sign = if exponent < 0 { "e-" } else { "e" };
            return self.digits(digits, 1).string(sign).integer(exponent.unsigned_abs());
        }
        if exponent < 0 {
            self.string("0.");
        }
        for _ in exponent..-1 {
            self.byte(b'0');
        }
        self.digits(digits, exponent + 1)
    }
}

/// Number of digits of the largest value, 2^32.
const MOST_DIGITS: usize = 10;

/// The digits of a positive finite number, without trailing zeros, and the power of ten of the first digit.
fn nine_digits(mut mantissa: f64) -> (u32, i32) {
    let mut exponent = 0;
    while mantissa >= 10.0 {
        mantissa /= 10.0;
        exponent += 1;
    }
    while mantissa < 1.0 {
        mantissa *= 10.0;
        exponent -= 1;
    }
    let mut digits = (mantissa * 1e8 + 0.5) as u32;
    if digits >= 1_000_000_000 {
        digits /= 10;
        exponent += 1;
    }
    while digits > 9 && digits.is_multiple_of(10) {
        digits /= 10;
    }
    (digits, exponent)
}
