//! Where things are: the project, the program, and a folder for what tests make.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::time::UNIX_EPOCH;
use std::{env, fs};

/// The folder of the project.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).expect("this crate is in crates/testing")
}

/// Which build of the program it is: what was made with another one is stale.
pub fn build() -> String {
    let program = fs::metadata(program()).expect("cargo has built the program");
    let since = program.modified().ok().and_then(|time| time.duration_since(UNIX_EPOCH).ok());
    format!("{}-{}", since.expect("a time").as_nanos(), program.len())
}

/// The test program that is running: `target/PROFILE/deps/NAME-HASH`.
static TEST: LazyLock<PathBuf> = LazyLock::new(|| env::current_exe().expect("a test program knows where it is"));

/// The program `brinell`, which cargo builds before the tests.
pub fn program() -> &'static Path {
    static PROGRAM: LazyLock<PathBuf> = LazyLock::new(|| {
        let profile = TEST.ancestors().nth(2).expect("a test program is in target/PROFILE/deps");
        profile.join("brinell").with_extension(env::consts::EXE_EXTENSION)
    });
    &PROGRAM
}

/// The folder that cargo keeps for the files of tests.
pub fn temporary() -> &'static Path {
    static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
        let target = TEST.ancestors().nth(3).expect("a test program is in target/PROFILE/deps");
        target.join("tmp")
    });
    &FOLDER
}

/// The name of the test program.
pub fn test_name() -> &'static str {
    static NAME: LazyLock<String> = LazyLock::new(|| {
        let name = TEST.file_stem().expect("a program has a name").to_string_lossy();
        name.rsplit_once('-').map_or(&*name, |(name, _hash)| name).into()
    });
    &NAME
}
