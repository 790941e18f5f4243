//! Text without allocation and without panic, for log messages.

use core::ffi::c_char;

/// Room for a message with its final 0.
const CAPACITY: usize = 320;

/// A message as the importer's logger takes it: a format of printf without arguments, ended by 0.
pub struct Text {
    bytes: [u8; CAPACITY],
    length: usize,
}

impl Text {
    /// No text yet.
    pub(super) fn new() -> Text {
        Text { bytes: [0; CAPACITY], length: 0 }
    }

    /// The text as C sees it.
    pub fn as_ptr(&self) -> *const c_char {
        self.bytes.as_ptr().cast()
    }

    /// Appends `text`; what doesn't fit is cut off. `%` and `#` are doubled: they are commands to printf and to the
    /// importer's logger (FMI 2.0.5, section 2.1.5).
    #[inline(never)]
    pub fn string(&mut self, text: &str) -> &mut Text {
        for &byte in text.as_bytes() {
            if byte == b'%' || byte == b'#' {
                self.byte(byte);
            }
            self.byte(byte);
        }
        self
    }

    /// Appends `byte`, if it fits.
    #[inline(never)]
    pub(super) fn byte(&mut self, byte: u8) -> &mut Text {
        // the last byte stays 0
        if self.length < CAPACITY - 1
            && let Some(slot) = self.bytes.get_mut(self.length)
        {
            *slot = byte;
            self.length += 1;
        }
        self
    }

    /// Appends `value` in decimal.
    #[inline(never)]
    pub fn integer(&mut self, value: u32) -> &mut Text {
        let digits = Digits::of(value.into());
        for place in 0..digits.count {
            self.byte(digits.at(place));
        }
        self
    }

    /// Appends `value` as `%.9g` would, up to the last digit, which may be off by one: scaling by powers of ten rounds.
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
            return self.string("0");
        }
        let (digits, exponent) = nine_digits(magnitude);
        let plain = (-5..9).contains(&exponent);
        let before_point = if plain { exponent + 1 } else { 1 };
        if before_point <= 0 {
            self.string("0.");
        }
        for _ in before_point..0 {
            self.byte(b'0');
        }
        for place in 0..digits.count {
            if place == before_point && place > 0 {
                self.byte(b'.');
            }
            self.byte(digits.at(place));
        }
        for _ in digits.count..before_point {
            self.byte(b'0');
        }
        if !plain {
            self.string(if exponent < 0 { "e-" } else { "e" }).integer(exponent.unsigned_abs());
        }
        self
    }
}

/// The digits of a positive finite number, without trailing zeros, and the power of ten of the first one.
fn nine_digits(mut mantissa: f64) -> (Digits, i32) {
    let mut exponent = 0;
    while mantissa >= 10.0 {
        mantissa /= 10.0;
        exponent += 1;
    }
    while mantissa < 1.0 {
        mantissa *= 10.0;
        exponent -= 1;
    }
    let mut digits = (mantissa * 1e8 + 0.5) as u64;
    if digits >= 1_000_000_000 {
        digits /= 10;
        exponent += 1;
    }
    while digits > 9 && digits.is_multiple_of(10) {
        digits /= 10;
    }
    (Digits::of(digits), exponent)
}

/// A number in decimal, first digit first.
struct Digits {
    reversed: [u8; Digits::MOST],
    count: i32,
}

impl Digits {
    /// Digits of the largest number that occurs, 2^32.
    const MOST: usize = 10;

    fn of(mut value: u64) -> Digits {
        let mut digits = Digits { reversed: [0; Digits::MOST], count: 0 };
        for slot in &mut digits.reversed {
            *slot = (value % 10) as u8;
            value /= 10;
            digits.count += 1;
            if value == 0 {
                break;
            }
        }
        digits
    }

    /// The digit at `place`, counted from the first, as a character.
    fn at(&self, place: i32) -> u8 {
        let index = (self.count - 1 - place) as usize;
        b'0' + self.reversed.get(index).copied().unwrap_or(0)
    }
}
