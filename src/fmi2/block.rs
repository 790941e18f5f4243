//! The block of a prebuilt library: a section of its own, which the exporter writes into the finished file.

use crate::scene::kind::Library;
use crate::scene::prebuilt::block::Block;
use crate::scene::prebuilt::{Kind, Prebuilt, Source};

/// The scene of this library.
pub type Exported = Prebuilt<Library, Section>;

/// The section that holds the block.
pub struct Section;

#[used]
#[cfg_attr(target_vendor = "apple", unsafe(link_section = "__TEXT,__brinell"))]
#[cfg_attr(not(target_vendor = "apple"), unsafe(link_section = ".brinell"))]
static BLOCK: Block = Block::unfilled(Library::LIBRARY);

// the numbers in it lie there as the exporter writes them
const _: () = assert!(cfg!(target_endian = "little"));

impl Source for Section {
    #[inline(always)]
    #[expect(clippy::pointers_in_nomem_asm_block, reason = "there is nothing that could read what it points to")]
    fn block() -> &'static Block {
        let mut block = &raw const BLOCK;
        // SAFETY: nothing is done. But for all that the compiler knows the pointer could be any other afterwards, so that it
        // makes no use of what the block is at compile time.
        unsafe { core::arch::asm!("/* {} */", inout(reg) block, options(pure, nomem, nostack, preserves_flags)) };
        // SAFETY: it is still the pointer to the block. That is never written to while the library is in memory, and any bits in
        // it are numbers.
        unsafe { &*block }
    }

    fn words() -> &'static [u64; Block::WORDS] {
        // SAFETY: a block is made of words without gaps, which its size proves.
        unsafe { &*core::ptr::from_ref(Section::block()).cast() }
    }
}
