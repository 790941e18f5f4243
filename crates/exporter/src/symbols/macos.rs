//! The requirements of macOS for a library.

use super::SymbolError;
use crate::platform::Target;
use crate::signature;
use object::Endianness;
use object::macho::Version;
use object::read::macho::{LoadCommandVariant, MachOFile64};

/// The library runs on the oldest supported macOS, loads from any folder, and has a valid signature.
pub fn check(library: &[u8], target: &Target) -> Result<(), SymbolError> {
    let file = MachOFile64::<Endianness>::parse(library)?;
    let endian = file.endian();
    let mut commands = file.macho_load_commands()?;
    let (mut oldest, mut is_relative) = (None, false);
    while let Some(command) = commands.next()? {
        match command.variant()? {
            LoadCommandVariant::BuildVersion(version, _) => oldest = Some(version.minos.get(endian)),
            LoadCommandVariant::VersionMin(version) => oldest = Some(version.version.get(endian)),
            LoadCommandVariant::IdDylib(name) => {
                is_relative = command.string(endian, name.dylib.name)?.starts_with(b"@rpath/");
            }
            _ => {}
        }
    }
    let (major, minor) = target.oldest_macos();
    if oldest != Some(Version::new(major, minor, 0)) {
        let found = oldest.map_or("of no version".into(), |oldest| format!("{}.{}", oldest.major(), oldest.minor()));
        return Err(SymbolError::MacOs { found, wanted: format!("{major}.{minor}") });
    }
    if !is_relative {
        return Err(SymbolError::Library("by the path of the machine that built it".into()));
    }
    Ok(signature::check(library)?)
}
