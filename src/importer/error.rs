//! Why an FMU can't be loaded, and the limits of archives that the errors name.

use brinell_exporter::numbers::in_message;
use brinell_exporter::platform::NoPlatform;
use std::ffi::c_int;
use std::io;

/// What any archive may take when it is unpacked [bytes].
const FREE: u64 = 64_000_000;

/// How many times its size in the archive a file may take beyond that. XML of 100,000 contacts takes 41 times its size; a file of zeros
/// would take 1032 times, the most that deflate has (zlib, technical details).
const RATIO: u64 = 200;

/// The largest size of an archive, and of an unpacked one [bytes]. An FMU of 100,000 contacts with ten outputs takes a quarter of it.
pub const LARGEST: u64 = 2_000_000_000;

/// The largest number of files. Each takes a place in the file system, whatever its size.
pub const MOST_FILES: usize = 100_000;

/// What so many bytes of an archive may take when they are unpacked [bytes].
pub fn allowed(packed: u64) -> u64 {
    RATIO.saturating_mul(packed).saturating_add(FREE).min(LARGEST)
}

/// The rule of [`allowed`], in words.
pub fn rule() -> String {
    format!("{} and {RATIO} times what it takes in the archive, up to {}", size(FREE), size(LARGEST))
}

/// A number of bytes for people.
pub fn size(bytes: u64) -> String {
    match bytes {
        0..10_000 => format!("{bytes} bytes"),
        10_000..10_000_000 => format!("{} kB", bytes / 1000),
        _ => format!("{} MB", bytes / 1_000_000),
    }
}

/// An FMU that cannot be loaded, or a call that failed.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    #[error("{0}")]
    Unreadable(io::Error),
    #[error("it is no file: an archive is read from its end, which a pipe or a device doesn't show")]
    NoFile,
    #[error("{name:?} in it can't be unpacked: {source}")]
    Entry { name: String, source: io::Error },
    #[error("it has {}; allowed for an FMU is {}", self::size(*.0), self::size(LARGEST))]
    LargeFile(u64),
    #[error("it has more than {} files, which no FMU needs", MOST_FILES)]
    TooMany,
    #[error("{name:?} in it has {} when unpacked; allowed is {}: {}", self::size(*size), self::size(*allowed), rule())]
    LargePart { name: String, size: u64, allowed: u64 },
    #[error("it has {} when unpacked; allowed is {}: {}", self::size(*size), self::size(*allowed), rule())]
    TooLarge { size: u64, allowed: u64 },
    #[error("{name:?} in it has more than the {} that the archive declares", self::size(*declared))]
    Undeclared { name: String, declared: u64 },
    #[error("{0:?} in it is a symbolic link, which tools unpack differently; put the file itself there")]
    Link(String),
    #[error("modelDescription.xml is not of FMI 2.0 (fmiVersion is {0:?})")]
    Version(String),
    #[error("modelDescription.xml has no element CoSimulation with a modelIdentifier: it is no FMU for co-simulation")]
    NoCoSimulation,
    #[error("modelDescription.xml has modelIdentifier = {0:?}, which is no name of a library")]
    Identifier(String),
    #[error("binaries/{platform} has no {library}, which modelDescription.xml names")]
    OtherLibrary { platform: &'static str, library: String },
    #[error("{name} is missing or can't be read: {source}")]
    Part { name: &'static str, source: io::Error },
    #[error("it can't be unpacked: {0}")]
    Unpack(io::Error),
    #[error("it is no zip archive, as every FMU is, or an incomplete one; `brinell export` makes the FMU of a scene")]
    NoArchive,
    #[error("its zip archive is damaged: {0}")]
    Zip(#[from] zip::result::ZipError),
    #[error("the name {0:?} in it is no plain path inside the archive")]
    Path(String),
    #[error("two files in it have the same name")]
    Twice,
    #[error("modelDescription.xml can't be read: {0}")]
    Xml(String),
    #[error("there is no binary for this platform ({wanted}), {present}")]
    Binary { wanted: String, present: String },
    #[error("{0}")]
    Platform(#[from] NoPlatform),
    // Windows says what is wrong, but not with which file
    #[error("the library {name} can't be loaded: {}", chain(.source))]
    Library { name: String, source: libloading::Error },
    #[error("the library has no function {name}: {}", chain(.source))]
    Function { name: &'static str, source: libloading::Error },
    #[error("fmi2Instantiate gave no instance: {0}")]
    Instantiate(String),
    #[error("{function} returned status {status}: {message}")]
    Call { function: &'static str, status: c_int, message: String },
    #[error("there is no variable {0}")]
    Variable(String),
    #[error("the force is {} after {} s", in_message(*.force), in_message(*.time))]
    Force { force: f64, time: f64 },
    #[error("the impact hasn't ended after {steps} steps")]
    Endless { steps: u32 },
}

impl ImportError {
    /// Whether the FMU has refused a step.
    pub fn is_refused_step(&self) -> bool {
        matches!(self, ImportError::Call { function: "fmi2DoStep", .. })
    }
}

/// An error with its causes.
fn chain(error: &dyn std::error::Error) -> String {
    match error.source() {
        Some(source) => format!("{error}: {}", chain(source)),
        None => error.to_string(),
    }
}
