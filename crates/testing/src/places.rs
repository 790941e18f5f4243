//! Where things are: the project, the program, and a folder for what tests make.

use std::env;
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::time::UNIX_EPOCH;

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

/// The folder `target/PROFILE` of the test program.
fn made_in() -> &'static Path {
    TEST.ancestors().nth(2).expect("a test program is in target/PROFILE/deps")
}

/// The profile of cargo in which the test program was built.
pub fn profile() -> &'static str {
    match made_in().file_name().and_then(|name| name.to_str()).expect("a profile has a plain name") {
        "debug" => "dev",
        name => name,
    }
}

/// The program `brinell`, which cargo builds before the tests.
pub fn program() -> &'static Path {
    static PROGRAM: LazyLock<PathBuf> =
        LazyLock::new(|| made_in().join("brinell").with_extension(env::consts::EXE_EXTENSION));
    &PROGRAM
}

/// The folder that cargo keeps for the files of tests. They have fixed names: a second run of tests in the same target folder waits
/// until this test program has ended.
pub fn temporary() -> &'static Path {
    static FOLDER: LazyLock<(PathBuf, Option<File>)> = LazyLock::new(|| {
        let target = made_in().parent().expect("a test program is in target/PROFILE/deps");
        let folder = target.join("tmp");
        fs::create_dir_all(&folder).expect("the target folder can be written to");
        let lock = env::var_os(WORKER).is_none().then(|| for_this_run(&folder.join("in-use")));
        (folder, lock)
    });
    &FOLDER.0
}

/// Set for the workers of a test program, which share its folder.
pub const WORKER: &str = "BRINELL_WORKER";

/// The lock in `file`, which ends with the process.
fn for_this_run(file: &Path) -> File {
    let lock = File::create(file).expect("the target folder can be written to");
    if lock.try_lock().is_err() {
        // past the harness, which hides the output of a test
        let _ = writeln!(io::stderr(), "\nanother run of the tests uses {}: waiting for its end", file.display());
        lock.lock().expect("the target folder is on a file system with locks");
    }
    lock
}

/// The name of the test program.
pub fn test_name() -> &'static str {
    static NAME: LazyLock<String> = LazyLock::new(|| {
        let name = TEST.file_stem().expect("a program has a name").to_string_lossy();
        name.rsplit_once('-').map_or(&*name, |(name, _hash)| name).into()
    });
    &NAME
}
