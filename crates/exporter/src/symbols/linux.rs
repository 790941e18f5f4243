//! The requirements of Linux for a library.

use super::SymbolError;
use object::Endianness;
use object::elf;
use object::read::elf::{Dyn, ElfFile64};

/// The library needs no other library and no symbol version.
pub fn check(library: &[u8]) -> Result<(), SymbolError> {
    let file = ElfFile64::<Endianness>::parse(library)?;
    let endian = file.endian();
    let sections = file.elf_section_table();
    let Some((entries, strings)) = sections.dynamic(endian, library)? else { return Ok(()) };
    let strings = sections.strings(endian, library, strings)?;
    for entry in entries {
        match entry.tag(endian) {
            elf::DT_NEEDED => {
                let name = entry.string(endian, strings).map(String::from_utf8_lossy)?;
                return Err(SymbolError::Library(name.into_owned()));
            }
            elf::DT_VERNEED => return Err(SymbolError::Version),
            _ => {}
        }
    }
    Ok(())
}
