//! The block of a prebuilt library: a section of its own, which the exporter overwrites in the finished file.

use crate::kind::{Library, MADE_FROM};
use brinell_fmu::scene::identity_of;
use brinell_fmu::scene::library::block::{Block, Contents};
use brinell_fmu::scene::library::{LibraryScene, Memory};

/// The scene of this library.
pub type Exported = LibraryScene<Library, Section>;

/// The section that holds the block.
pub struct Section;

#[cfg(not(target_arch = "wasm32"))]
#[used]
#[cfg_attr(target_vendor = "apple", unsafe(link_section = "__TEXT,__brinell"))]
#[cfg_attr(not(target_vendor = "apple"), unsafe(link_section = ".brinell"))]
static BLOCK: Block = Block::unfilled(Section::LIBRARY);

// the numbers in the block have the byte order in which the exporter writes them
const _: () = assert!(cfg!(target_endian = "little"));

impl Section {
    const LIBRARY: u64 = identity_of(MADE_FROM);

    /// The block. The compiler must not know its contents.
    #[cfg(target_arch = "wasm32")]
    #[inline(always)]
    fn block() -> &'static Block {
        crate::module::block()
    }

    /// The block. The compiler must not know its contents.
    #[cfg(not(target_arch = "wasm32"))]
    #[inline(always)]
    #[expect(clippy::pointers_in_nomem_asm_block, reason = "there is nothing that could read what it points to")]
    fn block() -> &'static Block {
        let mut block = &raw const BLOCK;
        // SAFETY: it does nothing. The compiler must assume that the pointer may have changed, so it makes no use of the
        // contents of the block at compile time.
        unsafe { core::arch::asm!("/* {} */", inout(reg) block, options(pure, nomem, nostack, preserves_flags)) };
        // SAFETY: it is still the pointer to the block. The block never changes while the library is loaded, and any bits are
        // valid numbers.
        unsafe { &*block }
    }

    /// The same block as words.
    fn words() -> &'static [u64; Block::WORDS] {
        // SAFETY: a block consists of words without padding, as its size proves.
        unsafe { &*core::ptr::from_ref(Section::block()).cast() }
    }
}

impl Memory for Section {
    #[inline(always)]
    fn contents() -> Contents<'static> {
        Section::block().contents()
    }

    fn verify() -> Result<(), &'static str> {
        Section::block().check(Section::words(), Section::LIBRARY)
    }
}
