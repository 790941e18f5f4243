//! The platforms for which an FMU can have a library.

use crate::layout::shortened;
use crate::nearest::nearest;
use std::env;

/// A platform of FMI 2.0: a folder of an FMU.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Platform {
    /// Folder of the library, below `binaries`.
    pub folder: &'static str,
    /// Extension of the library.
    pub extension: &'static str,
    /// The compilation targets of the library. Several targets make a universal library.
    pub targets: &'static [Target],
}

/// One processor architecture of one operating system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Target {
    /// The target name of rustc. It is always passed to rustc, so that no other target is the default, such as that of a
    /// toolchain for another C library.
    pub triple: &'static str,
    pub system: System,
    pub processor: Processor,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum System {
    Linux,
    Windows,
    MacOs,
    /// None: a module for any host, which C source is made from.
    WebAssembly,
}

impl System {
    /// Extension of a library.
    pub const fn extension(self) -> &'static str {
        match self {
            System::Linux => "so",
            System::Windows => "dll",
            System::MacOs => "dylib",
            System::WebAssembly => "wasm",
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Processor {
    X86_64,
    Arm64,
    Wasm32,
}

const fn platform(folder: &'static str, targets: &'static [Target]) -> Platform {
    Platform { folder, extension: targets[0].system.extension(), targets }
}

const LINUX_X86_64: Target = target("x86_64-unknown-linux-gnu", System::Linux, Processor::X86_64);
const LINUX_ARM64: Target = target("aarch64-unknown-linux-gnu", System::Linux, Processor::Arm64);
const WINDOWS_X86_64: Target = target("x86_64-pc-windows-msvc", System::Windows, Processor::X86_64);
const MACOS_X86_64: Target = target("x86_64-apple-darwin", System::MacOs, Processor::X86_64);
const MACOS_ARM64: Target = target("aarch64-apple-darwin", System::MacOs, Processor::Arm64);

const WEB_ASSEMBLY: Target = target("wasm32-unknown-unknown", System::WebAssembly, Processor::Wasm32);

const fn target(triple: &'static str, system: System, processor: Processor) -> Target {
    Target { triple, system, processor }
}

impl Target {
    /// The oldest macOS for the library: the first with arm64, and the oldest that the Rust compiler supports.
    pub fn oldest_macos(&self) -> (u16, u8) {
        match self.processor {
            Processor::Arm64 => (11, 0),
            Processor::X86_64 => (10, 12),
            Processor::Wasm32 => (0, 0),
        }
    }

    /// A platform whose library is for this target alone, called as rustc calls it.
    pub const fn alone(&'static self) -> Platform {
        Platform { folder: self.triple, extension: self.system.extension(), targets: std::slice::from_ref(self) }
    }

    /// Whether the program itself runs on this target.
    pub fn is_here(&self) -> bool {
        let system = match self.system {
            System::Linux => "linux",
            System::Windows => "windows",
            System::MacOs => "macos",
            System::WebAssembly => "none",
        };
        let processor = match self.processor {
            Processor::X86_64 => "x86_64",
            Processor::Arm64 => "aarch64",
            Processor::Wasm32 => "wasm32",
        };
        (system, processor) == (env::consts::OS, env::consts::ARCH)
    }
}

impl Platform {
    /// Whether its library has that of `other` in it, and more.
    pub fn has(&self, other: &Platform) -> bool {
        self.targets.len() > other.targets.len() && other.targets.iter().all(|target| self.targets.contains(target))
    }

    /// All platforms. The folders are those of FMI 2.0.5, section 2.3: `linux64`, `win64` and `darwin64` mean x86; other
    /// processors have the names of FMI 3.0. The library in `darwin64` is universal, because importers on Apple silicon also
    /// look there.
    pub const ALL: [Platform; 5] = [
        platform("linux64", &[LINUX_X86_64]),
        platform("aarch64-linux", &[LINUX_ARM64]),
        platform("win64", &[WINDOWS_X86_64]),
        platform("darwin64", &[MACOS_X86_64, MACOS_ARM64]),
        platform("aarch64-darwin", &[MACOS_ARM64]),
    ];

    /// The arm64 library in the folder of x86-64. Importers on ARM Linux look only in `linux64`, and there are no universal ELF
    /// files.
    pub const ARM64_IN_LINUX64: Platform = platform("linux64", &[LINUX_ARM64]);

    /// C source for every other processor: the folder `sources` instead of one below `binaries`. It is made from prebuilt libraries
    /// only.
    pub const C_CODE: Platform = Platform { folder: "c-code", extension: "c", targets: &[WEB_ASSEMBLY] };

    /// Whether it is [`Platform::C_CODE`].
    pub fn is_source(&self) -> bool {
        *self == Platform::C_CODE
    }
}

/// A platform without FMUs.
#[derive(Debug, thiserror::Error)]
#[error("FMUs for {os} on {arch} can't be made: FMI 2.0 has no folder for this platform")]
pub struct NoPlatform {
    os: &'static str,
    arch: &'static str,
}

/// The platform on which the program runs.
///
/// # Errors
/// [`NoPlatform`]
pub fn here() -> Result<Platform, NoPlatform> {
    let (os, arch) = (env::consts::OS, env::consts::ARCH);
    let is_here = |platform: &&Platform| platform.targets[0].is_here();
    Platform::ALL.iter().find(is_here).copied().ok_or(NoPlatform { os, arch })
}

/// The platforms whose library may run here, the most likely one first.
///
/// # Errors
/// [`NoPlatform`]
pub fn loadable() -> Result<Vec<Platform>, NoPlatform> {
    let here = here()?;
    let others = Platform::ALL.into_iter().chain([Platform::ARM64_IN_LINUX64]);
    let others = others.filter(|other| *other != here && other.targets.contains(&here.targets[0]));
    Ok([here].into_iter().chain(others).collect())
}

/// The targets of `platforms`, each once.
pub fn targets(platforms: &[Platform]) -> Vec<&'static Target> {
    let mut targets = Vec::new();
    for target in platforms.iter().flat_map(|platform| platform.targets) {
        if !targets.contains(&target) {
            targets.push(target);
        }
    }
    targets
}

/// The platform with this folder.
///
/// # Errors
/// A sentence with the existing folders.
pub fn named(folder: &str) -> Result<Platform, String> {
    let known = Platform::ALL.into_iter().chain([Platform::C_CODE]);
    known.into_iter().find(|platform| platform.folder == folder).ok_or_else(|| {
        let folders = Platform::ALL.map(|platform| platform.folder);
        let plain = folder.trim().to_lowercase().replace([' ', '_'], "-");
        let meant = OTHER_NAMES.iter().find(|(others, _)| others.contains(&plain.as_str())).map(|(_, meant)| *meant);
        let names = || folders.into_iter().chain([Platform::C_CODE.folder, "all"]);
        let meant = meant.or_else(|| nearest(&plain, names()));
        let question = meant.map_or(String::new(), |meant| format!("; did you mean {meant}?"));
        let all = "`all` for all of these, and c-code for C source";
        let there = if question.is_empty() { ", only" } else { " There are" };
        format!("there is no platform `{}`{question}{there} {}, {all}", shortened(folder), folders.join(", "))
    })
}

/// What users, other tools, Rust and FMI 3.0 call the platforms.
const OTHER_NAMES: [(&[&str], &str); 6] = [
    (&["linux", "linux-64", "x86-64-linux", "linux-x86-64", "x86-64-unknown-linux-gnu", "ubuntu", "gnu"], "linux64"),
    (
        &[
            "arm",
            "arm64",
            "aarch64",
            "linux-arm64",
            "linuxarm64",
            "arm64-linux",
            "aarch64-unknown-linux-gnu",
            "raspberry",
        ],
        "aarch64-linux",
    ),
    (
        &["windows", "windows64", "win", "win32", "win-64", "x64", "x86-64-windows", "x86-64-pc-windows-msvc", "msvc"],
        "win64",
    ),
    (&["mac", "macos", "osx", "darwin", "apple", "x86-64-darwin", "x86-64-apple-darwin"], "darwin64"),
    (&["apple-silicon", "m1", "macos-arm64", "arm64-darwin", "darwin-arm64", "aarch64-apple-darwin"], "aarch64-darwin"),
    (&["c", "source", "sources", "c-source", "wasm", "wasm32"], "c-code"),
];
