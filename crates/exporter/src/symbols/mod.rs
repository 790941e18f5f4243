//! Checks of a library before it is packed: the right processor, exactly the 44 exported functions, few imports, and
//! the requirements of its operating system.

mod linux;
mod macos;
mod windows;

use crate::platform::{Platform, Processor, System, Target};
use crate::signature::SignatureError;
use object::read::NameOrOrdinal;
use object::read::macho::{FatArch, MachOFatFile32};
use object::{Architecture, BinaryFormat, FileKind, Object, ObjectSegment, ObjectSymbol};
use std::collections::BTreeSet;

/// Every function of FMI 2.0; those of Model Exchange, the last ten, for loaders that ask for all.
pub const FUNCTIONS: [&str; 44] = [
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
    "fmi2EnterEventMode",
    "fmi2NewDiscreteStates",
    "fmi2EnterContinuousTimeMode",
    "fmi2CompletedIntegratorStep",
    "fmi2SetTime",
    "fmi2SetContinuousStates",
    "fmi2GetDerivatives",
    "fmi2GetEventIndicators",
    "fmi2GetContinuousStates",
    "fmi2GetNominalsOfContinuousStates",
];

/// Imports from the C library of the process that an FMU may have: memory functions, and what compilers make of loops
/// over memory.
const FROM_C: [&str; 8] = ["calloc", "free", "memcpy", "memmove", "memset", "memcmp", "bcmp", "strlen"];

/// Additional imports on macOS: `memset` to zero under its names there, `memset` for a repeated number (macOS 10.5), and the
/// function that binds the others.
const FROM_MACOS: [&str; 4] = ["bzero", "__bzero", "memset_pattern16", "dyld_stub_binder"];

/// Allowed imports on Windows.
const FROM_KERNEL32: [&str; 3] = ["GetProcessHeap", "HeapAlloc", "HeapFree"];

/// A library that must not be packed.
#[derive(Debug, thiserror::Error)]
pub enum SymbolError {
    #[error("it can't be read as a library: {0}")]
    Unreadable(#[from] object::Error),
    #[error("it has {found}, where there should be {wanted}")]
    Processors { found: String, wanted: String },
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
    #[error("it has memory that can be written and executed")]
    Writable,
    #[error("it lacks the mark {0}, by which Windows protects memory")]
    Unprotected(&'static str),
    #[error("it needs macOS {found}, and not {wanted}")]
    MacOs { found: String, wanted: String },
    #[error("its signature is not valid: {0}")]
    Signature(#[from] SignatureError),
}

/// Checks the library of `platform`; returns the names that it imports from the process. A `standalone` one imports none.
///
/// # Errors
/// [`SymbolError`] with the first violation.
pub fn check(library: &[u8], platform: &Platform, standalone: bool) -> Result<Vec<String>, SymbolError> {
    let slices = slices(library)?;
    let mut found = Vec::new();
    for slice in &slices {
        found.push(words(system(FileKind::parse(*slice)?), object::File::parse(*slice)?.architecture()));
    }
    let wanted: Vec<_> =
        platform.targets.iter().map(|target| words(Some(target.system), architecture(target))).collect();
    if found != wanted {
        return Err(SymbolError::Processors { found: found.join(" and "), wanted: wanted.join(" and ") });
    }
    let mut imports = BTreeSet::new();
    for (slice, target) in slices.iter().zip(platform.targets) {
        imports.extend(check_target(slice, target)?);
    }
    match imports.first() {
        Some(import) if standalone => Err(SymbolError::Import(import.clone())),
        _ => Ok(imports.into_iter().collect()),
    }
}

/// The libraries in a universal one; otherwise the library itself.
fn slices(library: &[u8]) -> Result<Vec<&[u8]>, SymbolError> {
    if FileKind::parse(library)? != FileKind::MachOFat32 {
        return Ok(vec![library]);
    }
    let file = MachOFatFile32::parse(library)?;
    Ok(file.arches().iter().map(|slice| slice.data(library)).collect::<Result<_, _>>()?)
}

fn system(kind: FileKind) -> Option<System> {
    match kind {
        FileKind::Elf64 => Some(System::Linux),
        FileKind::Pe64 => Some(System::Windows),
        FileKind::MachO64 => Some(System::MacOs),
        _ => None,
    }
}

fn architecture(target: &Target) -> Architecture {
    match target.processor {
        Processor::X86_64 => Architecture::X86_64,
        Processor::Arm64 => Architecture::Aarch64,
        Processor::Wasm32 => Architecture::Wasm32,
    }
}

/// A system and a processor in words.
fn words(system: Option<System>, processor: Architecture) -> String {
    let system = system.map_or("an unknown system".into(), |system| format!("{system:?}"));
    format!("code for {system} on {processor:?}")
}

/// Checks the requirements of every system, and those of the system of `target`.
fn check_target(library: &[u8], target: &Target) -> Result<BTreeSet<String>, SymbolError> {
    let file = object::File::parse(library)?;
    // Mach-O adds an underscore before every name
    let prefix = if file.format() == BinaryFormat::MachO { "_" } else { "" };
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
    check_exports(&exports)?;
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
    libraries.remove("");
    check_imports(&imports, &libraries, target.system)?;
    if file.segments().any(|segment| segment.permissions().writable() && segment.permissions().executable()) {
        return Err(SymbolError::Writable);
    }
    match target.system {
        System::Linux => linux::check(library)?,
        System::Windows => windows::check(library)?,
        System::MacOs => macos::check(library, target)?,
        System::WebAssembly => {}
    }
    Ok(imports)
}

fn check_exports(exports: &BTreeSet<String>) -> Result<(), SymbolError> {
    if let Some(missing) = FUNCTIONS.iter().find(|function| !exports.contains(**function)) {
        return Err(SymbolError::Missing((*missing).into()));
    }
    match exports.iter().find(|export| !FUNCTIONS.contains(&export.as_str())) {
        Some(extra) => Err(SymbolError::Extra(extra.clone())),
        None => Ok(()),
    }
}

fn check_imports(imports: &BTreeSet<String>, libraries: &BTreeSet<String>, system: System) -> Result<(), SymbolError> {
    let (functions, library): (Vec<&str>, Option<&str>) = match system {
        System::Linux => (FROM_C.to_vec(), None),
        System::Windows => (FROM_KERNEL32.to_vec(), Some("kernel32.dll")),
        System::MacOs => ([FROM_C.as_slice(), &FROM_MACOS].concat(), Some("/usr/lib/libSystem.B.dylib")),
        System::WebAssembly => (Vec::new(), None),
    };
    if let Some(import) = imports.iter().find(|import| !functions.contains(&import.as_str())) {
        return Err(SymbolError::Import(import.clone()));
    }
    match libraries.iter().find(|needed| Some(needed.as_str()) != library) {
        Some(other) => Err(SymbolError::Library(other.clone())),
        None => Ok(()),
    }
}
