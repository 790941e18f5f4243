//! The program, called like by a user, with a separate folder for each test.

use crate::places::{program, temporary};
use crate::prebuilt;
pub use crate::unit::scene;
use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// The result of a run of the program.
#[derive(Debug)]
pub struct Run {
    pub status: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Run {
    /// The run, which must have ended with `status`.
    #[track_caller]
    pub fn with_status(self, status: i32) -> Run {
        assert_eq!(self.status, Some(status), "wrong exit status of {self:#?}");
        self
    }

    /// The single JSON document on standard output.
    #[track_caller]
    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.out).unwrap_or_else(|error| panic!("no JSON ({error}): {self:#?}"))
    }
}

/// The program, to run in `folder` with a separate cache and without a downloaded toolchain.
pub fn brinell(folder: &Path) -> Command {
    let mut command = Command::new(program());
    settled(&mut command).current_dir(folder).env("BRINELL_TOOLCHAIN", cache().join("none"));
    command
}

/// `command`, for which the program has the cache of the tests, and neither libraries nor materials of the user.
pub fn settled(command: &mut Command) -> &mut Command {
    let none = temporary().join("no-settings");
    command.env("BRINELL_CACHE", cache()).env_remove("BRINELL_PREBUILT");
    command.env("XDG_CONFIG_HOME", &none).env("APPDATA", none)
}

/// The cache of the tests.
pub fn cache() -> PathBuf {
    temporary().join("cache")
}

/// A cache with those files of the tests' whose names have this ending: `.rlib` are the parts of libraries, with which an export compiles
/// its library alone.
pub fn cache_with(ending: &str) -> TempDir {
    let new = empty_folder();
    let names = if cache().is_dir() { contents(&cache()) } else { Vec::new() };
    for name in names.iter().filter(|name| name.ends_with(ending)) {
        // another test may have removed it: then the export makes it
        let _ = fs::hard_link(cache().join(name), new.path().join(name));
    }
    new
}

/// Runs `command` to its end. What our program says on standard error must fit the width of a page; `err` is without the ends of lines
/// that come from that.
#[track_caller]
pub fn output(command: &mut Command) -> Run {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?} can't be started: {error}"));
    let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    // what another program asks for stays as it is
    let for_people = !command.get_args().any(|argument| argument == "--json");
    if for_people && command.get_program() == program() {
        check_width(&err);
    }
    Run { status: output.status.code(), out, err: if for_people { unwrapped(&err) } else { err } }
}

/// Commands that make a library.
const EXPORTING: [&str; 3] = ["export", "ssp", "report"];

/// Runs the program in `folder` with `arguments`. It finds no compiler: a prebuilt library gives an FMU with the same bits in a hundredth
/// of the time.
#[track_caller]
pub fn run<A: AsRef<OsStr>>(folder: &Path, arguments: impl IntoIterator<Item = A>) -> Run {
    let mut command = brinell(folder);
    command.args(arguments).env_remove("CARGO").env("PATH", "/no/path");
    if command.get_args().any(|argument| EXPORTING.iter().any(|exporting| argument == *exporting)) {
        command.env("BRINELL_PREBUILT", prebuilt::store());
    }
    output(&mut command)
}

/// The same, where an FMU is compiled.
#[track_caller]
pub fn compile<A: AsRef<OsStr>>(folder: &Path, arguments: impl IntoIterator<Item = A>) -> Run {
    output(brinell(folder).args(arguments))
}

/// Whether the lines of a message fit a page, but for lines of a scene and for single words, such as paths.
#[track_caller]
fn check_width(text: &str) {
    for line in text.lines().filter(|line| line.chars().count() > WIDTH) {
        let is_shown = line.trim_start().trim_start_matches(|c: char| c.is_ascii_digit() || c == ' ').starts_with('|');
        assert!(is_shown || !line.trim().contains(' '), "{} columns: {line}", line.chars().count());
    }
}

/// The widest line of a message.
const WIDTH: usize = 100;

/// `text` with those lines put together again that one line was too short for.
fn unwrapped(text: &str) -> String {
    let (mut all, mut last, mut depth) = (String::new(), 0, 0);
    for line in text.lines() {
        let (words, size) = (line.trim_start(), line.chars().count());
        let indent = line.len() - words.len();
        let word = words.split(' ').next().unwrap_or_default().chars().count();
        if indent == depth + 2 && last + 1 + word > WIDTH && !words.is_empty() {
            all += &format!(" {words}");
        } else {
            all += &format!("{}{line}", if all.is_empty() { "" } else { "\n" });
            depth = indent;
        }
        last = size;
    }
    if text.ends_with('\n') { all + "\n" } else { all }
}

/// An empty folder, which nobody else can write to, whatever the umask: the program builds in no other.
pub fn empty_folder() -> TempDir {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o700));
    builder.prefix("brinell-test-").tempdir().expect("a folder for temporary files")
}

/// The names of the entries of `folder`, including hidden files.
pub fn contents(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a readable folder");
    let mut names: Vec<_> = entries.map(|e| e.expect("a readable folder").file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// What the operating system says of a file that isn't there.
pub fn missing() -> String {
    io::Error::from_raw_os_error(2).to_string()
}

/// The bytes of an FMU of the default scene, exported under other circumstances.
#[track_caller]
pub fn exported(circumstances: impl FnOnce(&mut Command) -> &mut Command) -> Vec<u8> {
    let folder = empty_folder();
    let mut command = brinell(folder.path());
    command.arg("export").arg(scene("steel_ball"));
    circumstances(&mut command);
    output(&mut command).with_status(0);
    fs::read(folder.path().join("steel_ball.fmu")).expect("NAME.fmu in the current folder")
}

/// `assert_eq` would print both archives.
#[track_caller]
pub fn assert_same(left: &[u8], right: &[u8]) {
    let first = left.iter().zip(right).position(|(left, right)| left != right);
    assert!(left == right, "{} and {} bytes, different from byte {first:?} on", left.len(), right.len());
}
