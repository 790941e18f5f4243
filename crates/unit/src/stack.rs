//! The probe of the stack on Windows.
//!
//! A stack there grows by one page at a time, behind a guard page. A function with more than a page of variables calls `__chkstk`, with
//! its number of bytes in `rax`, which must touch each page in turn and change no register. It belongs to the C library, which an
//! FMU doesn't need otherwise.

core::arch::global_asm!(
    ".def __chkstk; .scl 2; .type 32; .endef",
    ".globl __chkstk",
    ".seh_proc __chkstk",
    "__chkstk:",
    "push r10",
    ".seh_pushreg r10",
    "push r11",
    ".seh_pushreg r11",
    ".seh_endprologue",
    // the stack pointer of the caller, and the one that it is about to have
    "lea r10, [rsp + 24]",
    "mov r11, r10",
    "sub r11, rax",
    "2:",
    "sub r10, 4096",
    "cmp r10, r11",
    "jbe 3f",
    "test qword ptr [r10], r10",
    "jmp 2b",
    "3:",
    "test qword ptr [r11], r11",
    "pop r11",
    "pop r10",
    "ret",
    ".seh_endproc",
);
