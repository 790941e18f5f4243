//! The processor's floating-point arithmetic, of which a host may have changed the mode: to bound errors of rounding, or by
//! loading a library that was compiled with `-ffast-math`.

#[cfg(target_arch = "x86_64")]
mod register {
    use std::arch::asm;

    /// Results below the normal numbers become zero, and such operands are taken as zero.
    const FLUSHED: u32 = 1 << 15 | 1 << 6;
    const DOWN: u32 = 1 << 13;
    const UP: u32 = 1 << 14;

    /// Modes beside that of a new process, as bits of the register of flags and modes.
    pub const MODES: &[u32] = &[DOWN, UP, DOWN | UP, FLUSHED, FLUSHED | UP];

    /// The exception flags, their masks, and the mode.
    pub fn control() -> u32 {
        let mut control = 0;
        // SAFETY: it stores the register, and nothing else
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut control, options(nostack)) };
        control
    }

    /// Sets flags, masks and mode of this thread.
    pub fn set_control(control: u32) {
        // SAFETY: a value from `control`, without flags or with another mode; no test relies on either in its own computations
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const control, options(nostack)) };
    }
}

/// Other processors: no mode is changed.
#[cfg(not(target_arch = "x86_64"))]
mod register {
    pub const MODES: &[u32] = &[];

    pub fn control() -> u32 {
        0
    }

    pub fn set_control(_: u32) {}
}

pub use register::*;
