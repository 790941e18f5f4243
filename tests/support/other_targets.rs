//! How the library of laws is compiled for other systems, by the toolchain that `brinell toolchain` has fetched.

use super::laws_library::Target;
use std::fs;
use std::path::Path;

/// What macOS's own library has of the functions that the library of laws takes from it.
const LIB_SYSTEM: &str = "--- !tapi-tbd
tbd-version: 4
targets: [ x86_64-macos, arm64-macos ]
install-name: '/usr/lib/libSystem.B.dylib'
exports:
  - targets: [ x86_64-macos, arm64-macos ]
    symbols: [ _memcpy, _memmove, _memset, _memcmp, _bzero, _strlen, dyld_stub_binder ]
...
";

/// The target `triple` with the compiler in the folder `toolchain`.
pub fn of<'a>(toolchain: &Path, triple: &'a str) -> Target<'a> {
    let lld = toolchain.join("usr/lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld");
    let by = |linker: &Path, flavor: &str, arguments: &[&str]| {
        let mut linking = vec![format!("-Clinker={}", linker.display()), format!("-Clinker-flavor={flavor}")];
        linking.extend(arguments.iter().map(|argument| format!("-Clink-arg={argument}")));
        linking
    };
    let (file, linking) = match triple {
        "x86_64-pc-windows-msvc" => {
            let arguments = ["/NOENTRY", "/NODEFAULTLIB", "/ALTERNATENAME:_fltused=__ImageBase", "/DEBUG:NONE"];
            ("laws.dll", by(&lld, "lld-link", &arguments))
        }
        "x86_64-apple-darwin" | "aarch64-apple-darwin" => {
            let arguments = ["-adhoc_codesign", "-lSystem", "-install_name", "@rpath/liblaws.dylib"];
            ("liblaws.dylib", by(&lld, "ld64.lld", &arguments))
        }
        _ => ("liblaws.so", by(&toolchain.join("usr/bin/cc-lld"), "gcc", &["-nostartfiles", "-nodefaultlibs"])),
    };
    let mut variables = Vec::new();
    if triple.ends_with("darwin") {
        let kit = Path::new(env!("CARGO_TARGET_TMPDIR")).join("macos-kit");
        fs::create_dir_all(kit.join("usr/lib")).expect("the target folder can be written to");
        fs::write(kit.join("usr/lib/libSystem.tbd"), LIB_SYSTEM).expect("the target folder can be written to");
        let oldest = if triple.starts_with("x86_64") { "10.12" } else { "11.0" };
        variables = vec![("SDKROOT", kit.display().to_string()), ("MACOSX_DEPLOYMENT_TARGET", oldest.into())];
    }
    Target {
        triple,
        rustc: toolchain.join("usr/bin/rustc"),
        file,
        linking,
        needs_bytes: triple.ends_with("msvc"),
        variables,
    }
}
