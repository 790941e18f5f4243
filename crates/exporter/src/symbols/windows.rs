//! The requirements of Windows for a library.

use super::SymbolError;
use object::pe::{
    IMAGE_DLLCHARACTERISTICS_DYNAMIC_BASE, IMAGE_DLLCHARACTERISTICS_HIGH_ENTROPY_VA,
    IMAGE_DLLCHARACTERISTICS_NX_COMPAT, IMAGE_FILE_RELOCS_STRIPPED,
};
use object::read::pe::{ImageNtHeaders, ImageOptionalHeader, PeFile64};

/// The library loads at any address, and its data can't be executed.
pub fn check(library: &[u8]) -> Result<(), SymbolError> {
    let file = PeFile64::parse(library)?;
    let headers = file.nt_headers();
    let marks = headers.optional_header().dll_characteristics();
    for (mark, name) in [
        (IMAGE_DLLCHARACTERISTICS_DYNAMIC_BASE, "DYNAMIC_BASE"),
        (IMAGE_DLLCHARACTERISTICS_HIGH_ENTROPY_VA, "HIGH_ENTROPY_VA"),
        (IMAGE_DLLCHARACTERISTICS_NX_COMPAT, "NX_COMPAT"),
    ] {
        if !marks.contains(mark) {
            return Err(SymbolError::Unprotected(name));
        }
    }
    let file_marks = headers.file_header().characteristics.get(object::LittleEndian);
    match file_marks.contains(IMAGE_FILE_RELOCS_STRIPPED) {
        true => Err(SymbolError::Unprotected("of relocations")),
        false => Ok(()),
    }
}
