//! Linking a library: with LLVM's linker for every system, or with the installed C compiler for the host on Linux.

use brinell_exporter::platform::{System, Target};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The linker of a library.
pub enum Linker {
    /// The C compiler `cc`, which calls the system's own linker.
    Driver,
    /// A program that takes the arguments of a C compiler and passes those of the linker to LLVM's linker.
    DriverOf(PathBuf),
    /// LLVM's linker for all systems; `-flavor` selects the system.
    Lld(PathBuf),
}

/// Omits unwinding tables and the name of the compiler. Nothing unwinds through a library that cannot panic.
const SCRIPT: (&str, &str) = ("unit.ld", "SECTIONS { /DISCARD/ : { *(.eh_frame) *(.comment) } } INSERT AFTER .text;\n");

/// The functions of macOS's C library that an FMU may use. This replaces Apple's development kit.
const LIB_SYSTEM: (&str, &str) = (
    "sdk/usr/lib/libSystem.tbd",
    "--- !tapi-tbd
tbd-version:     4
targets:         [ x86_64-macos, arm64-macos ]
install-name:    '/usr/lib/libSystem.B.dylib'
exports:
  - targets:     [ x86_64-macos, arm64-macos ]
    symbols:     [ _calloc, _free, _memcpy, _memmove, _memset, _memcmp, _bcmp, _bzero, ___bzero, _memset_pattern16, _strlen, dyld_stub_binder ]
...
",
);

/// Symbols are bound at load time, first within the library.
const ELF: [&str; 8] =
    ["-z", "now", "-Bsymbolic", "--hash-style=gnu", "--build-id=none", "--no-eh-frame-hdr", "-T", "unit.ld"];

/// No start code and no C library. `_fltused` only marks the use of floating point.
const WINDOWS: [&str; 6] =
    ["/NOENTRY", "/NODEFAULTLIB", "/ALTERNATENAME:_fltused=__ImageBase", "/DEBUG:NONE", "/Brepro", "/OPT:REF,ICF"];

/// The linker omits local symbols, those for debuggers, and the list of functions, because the file must not change after it
/// is signed.
const MACOS: [&str; 6] = ["-adhoc_codesign", "-lSystem", "-x", "-S", "-no_function_starts", "-install_name"];

/// The stack is below the data, and large enough to find out how much of it is needed.
const WEB_ASSEMBLY: [&str; 3] = ["--stack-first", "-z", "stack-size=262144"];

/// The input files of the linker.
pub fn files() -> [(&'static str, &'static str); 2] {
    [SCRIPT, LIB_SYSTEM]
}

/// Environment variables for rustc, which compiles in `folder`.
pub fn variables(target: &Target, folder: &Path) -> Vec<(&'static str, OsString)> {
    let (major, minor) = target.oldest_macos();
    match target.system {
        System::MacOs => {
            vec![
                // rustc rejects relative paths
                ("SDKROOT", folder.join("sdk").into()),
                ("MACOSX_DEPLOYMENT_TARGET", format!("{major}.{minor}").into()),
            ]
        }
        System::Linux | System::Windows | System::WebAssembly => Vec::new(),
    }
}

/// Arguments for rustc.
pub fn arguments(target: &Target, linker: &Linker, name: &str, objects: &[&str]) -> Vec<String> {
    let mut arguments = Vec::new();
    let install_name = format!("@rpath/{name}");
    let (flavor, mut plain) = match target.system {
        System::Linux => ("ld.lld", ELF.to_vec()),
        System::Windows => ("lld-link", WINDOWS.to_vec()),
        System::MacOs => ("ld64.lld", [MACOS.as_slice(), &[&install_name]].concat()),
        System::WebAssembly => ("wasm-ld", WEB_ASSEMBLY.to_vec()),
    };
    plain.extend(objects);
    let named = |linker: &Path, flavor| [format!("-Clinker={}", linker.display()), format!("-Clinker-flavor={flavor}")];
    match linker {
        Linker::Lld(lld) => arguments.extend(named(lld, flavor)),
        Linker::Driver => {}
        Linker::DriverOf(driver) => arguments.extend(named(driver, "gcc")),
    }
    if matches!(linker, Linker::Driver | Linker::DriverOf(_)) {
        arguments.extend(["-nostartfiles", "-nodefaultlibs"].map(|argument| format!("-Clink-arg={argument}")));
        arguments.push(format!("-Clink-arg=-Wl,{}", plain.join(",")));
    } else {
        arguments.extend(plain.iter().map(|argument| format!("-Clink-arg={argument}")));
    }
    arguments.push(match target.system {
        // rustc would call an external program to strip a Mach-O file, which invalidates the signature
        System::MacOs => "-Cstrip=none".into(),
        // square roots are found by their name
        System::WebAssembly => "-Cstrip=debuginfo".into(),
        System::Linux | System::Windows => "-Cstrip=symbols".into(),
    });
    arguments
}
