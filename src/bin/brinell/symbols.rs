//! The symbols of a library: it must export the 34 functions and nothing else, and need next to nothing.

use object::elf;
use object::read::NameOrOrdinal;
use object::read::elf::{Dyn, ElfFile64};
use object::{Endianness, Object, ObjectSymbol};
use std::collections::BTreeSet;

/// Every function of FMI 2.0 for co-simulation.
pub const FUNCTIONS: [&str; 34] = [
    "fmi2GetTypesPlatform",
    "fmi2GetVersion",
    "fmi2SetDebugLogging",
    "fmi2Instantiate",
    "fmi2FreeInstance",
    "fmi2SetupExperiment",
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
    "fmi2Terminate",
    "fmi2Reset",
    "fmi2GetReal",
    "fmi2GetInteger",
    "fmi2GetBoolean",
    "fmi2GetString",
    "fmi2SetReal",
    "fmi2SetInteger",
    "fmi2SetBoolean",
    "fmi2SetString",
    "fmi2GetFMUstate",
    "fmi2SetFMUstate",
    "fmi2FreeFMUstate",
    "fmi2SerializedFMUstateSize",
    "fmi2SerializeFMUstate",
    "fmi2DeSerializeFMUstate",
    "fmi2GetDirectionalDerivative",
    "fmi2SetRealInputDerivatives",
    "fmi2GetRealOutputDerivatives",
    "fmi2DoStep",
    "fmi2CancelStep",
    "fmi2GetStatus",
    "fmi2GetRealStatus",
    "fmi2GetIntegerStatus",
    "fmi2GetBooleanStatus",
    "fmi2GetStringStatus",
];

/// What a unit may take from the process: memory, and what compilers make of loops over it.
const ALLOWED_IMPORTS: [&str; 10] = [
    "calloc",
    "free",
    "memcpy",
    "memmove",
    "memset",
    "memcmp",
    "bcmp",
    "strlen",
    "dyld_stub_binder",
    "__tlv_bootstrap",
];

/// What a unit may take on Windows, all from kernel32.
const ALLOWED_ON_WINDOWS: [&str; 3] = ["GetProcessHeap", "HeapAlloc", "HeapFree"];

/// Libraries that every process has.
const ALLOWED_LIBRARIES: [&str; 2] = ["libSystem.B.dylib", "kernel32.dll"];

/// A library that must not be packed.
#[derive(Debug, thiserror::Error)]
pub enum SymbolError {
    #[error("it can't be read as a library: {0}")]
    Unreadable(#[from] object::Error),
    #[error("it doesn't export {0}")]
    Missing(String),
    #[error("it exports {0}, which is no function of FMI 2.0")]
    Extra(String),
    #[error("it needs {0} from the process (a panic path has survived, or a library function has crept in)")]
    Import(String),
    #[error("it needs the library {0}")]
    Library(String),
    #[error("it needs a version of a symbol, so that it doesn't load everywhere")]
    Version,
}

/// Checks a library for any of the platforms; gives the names it takes from the process. A `standalone` one takes none.
///
/// # Errors
/// [`SymbolError`] with the first thing that is wrong.
pub fn check(library: &[u8], standalone: bool) -> Result<Vec<String>, SymbolError> {
    let file = object::File::parse(library)?;
    // Mach-O puts an underscore before every name
    let prefix = if file.format() == object::BinaryFormat::MachO { "_" } else { "" };
    let plain = |bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes).into_owned();
        text.strip_prefix(prefix).map_or(text.clone(), str::to_string)
    };
    let name = |name: NameOrOrdinal<&[u8]>| match name {
        NameOrOrdinal::Name(bytes) => plain(bytes),
        NameOrOrdinal::Ordinal(ordinal) => format!("ordinal {ordinal}"),
    };
    let mut exports = BTreeSet::new();
    for export in file.exports()? {
        exports.insert(name(export?.name()));
    }
    if let Some(missing) = FUNCTIONS.iter().find(|function| !exports.contains(**function)) {
        return Err(SymbolError::Missing((*missing).into()));
    }
    if let Some(extra) = exports.iter().find(|export| !FUNCTIONS.contains(&export.as_str())) {
        return Err(SymbolError::Extra(extra.clone()));
    }
    let (mut imports, mut libraries) = (BTreeSet::new(), BTreeSet::new());
    for import in file.imports()? {
        let import = import?;
        imports.insert(name(import.name()));
        libraries.insert(String::from_utf8_lossy(import.library()).into_owned());
    }
    for symbol in file.dynamic_symbols().filter(|symbol| symbol.is_undefined()) {
        imports.insert(plain(symbol.name_bytes()?));
    }
    imports.remove("");
    let allowed = |import: &str| {
        let on_windows = file.format() == object::BinaryFormat::Pe && ALLOWED_ON_WINDOWS.contains(&import);
        !standalone && (ALLOWED_IMPORTS.contains(&import) || on_windows)
    };
    if let Some(import) = imports.iter().find(|import| !allowed(import)) {
        return Err(SymbolError::Import(import.clone()));
    }
    for library in libraries {
        let short = library.rsplit('/').next().unwrap_or(&library);
        if !short.is_empty() && !ALLOWED_LIBRARIES.contains(&short) {
            return Err(SymbolError::Library(library));
        }
    }
    if file.format() == object::BinaryFormat::Elf {
        check_elf(library)?;
    }
    Ok(imports.into_iter().collect())
}

/// On Linux no library at all is needed, and no version of a symbol.
fn check_elf(library: &[u8]) -> Result<(), SymbolError> {
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
