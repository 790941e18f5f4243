//! Downloads with curl, which knows the proxies and certificates of the system and resumes partial downloads.
//!
//! A library for HTTPS would add more code than the rest of the program, some of it in C or assembler, for a command that is
//! used once on a machine.

use super::ToolchainError;
use super::deb;
use super::package::Package;
use crate::files::FileError;
use crate::interrupt;
use indicatif::{ProgressBar, ProgressStyle};
use sha2::{Digest, Sha256};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

/// The origin of files, and the folder for them.
pub struct Source<'a> {
    pub mirror: &'a str,
    pub folder: &'a Path,
}

/// Interval of the progress display.
const TICK: Duration = Duration::from_millis(100);

impl Source<'_> {
    /// The text of an xz file.
    ///
    /// # Errors
    /// [`ToolchainError`]
    pub fn index(&self, path: &str) -> Result<String, ToolchainError> {
        let (url, file) = (self.url(path), self.folder.join("index.xz"));
        // a file from an earlier call may be outdated
        let _ = fs::remove_file(&file);
        crate::layout::tell(&format!("reading {url} ..."));
        curl(&url, &file, |_| {})?;
        let bytes = fs::read(&file).map_err(FileError::at(&file))?;
        let text = deb::unxz(&bytes).and_then(|bytes| String::from_utf8(bytes).map_err(io::Error::other));
        text.map_err(|error| ToolchainError::Package { package: url, reason: error.to_string() })
    }

    /// Downloads the packages that are missing. Returns their files, whose hashes have been verified.
    ///
    /// # Errors
    /// [`ToolchainError`]; complete downloads are kept, unless they are damaged.
    pub fn packages(&self, packages: &[Package]) -> Result<Vec<PathBuf>, ToolchainError> {
        let all: u64 = packages.iter().map(|package| package.size).sum();
        let style = ProgressStyle::with_template("{bar:30} {bytes} of {total_bytes}, {eta} left  {wide_msg}");
        let bar = ProgressBar::new(all).with_style(style.expect("a good template"));
        if bar.is_hidden() {
            crate::layout::tell(&format!("downloading {} packages, {} MB ...", packages.len(), all / 1_000_000));
        }
        let (mut files, mut before) = (Vec::new(), 0);
        for package in packages {
            bar.set_message(package.name.clone());
            if bar.is_hidden() {
                crate::layout::tell(&format!("downloading {}, {} MB ...", package.name, package.size / 1_000_000));
            }
            files.push(self.package(package, |there| bar.set_position(before + there))?);
            before += package.size;
        }
        bar.finish_and_clear();
        Ok(files)
    }

    fn package(&self, package: &Package, progress: impl Fn(u64)) -> Result<PathBuf, ToolchainError> {
        let url = self.url(&package.path);
        let file = self.folder.join(format!("{}_{}.deb", package.name, &package.sha256));
        if !file.is_file() {
            let part = file.with_extension("part");
            let there = || fs::metadata(&part).map_or(0, |metadata| metadata.len());
            if there() < package.size {
                curl(&url, &part, &progress).map_err(|error| with_progress(error, there(), package.size))?;
            }
            let found = hash(&part).map_err(FileError::at(&part))?;
            if found != package.sha256 {
                let size = there();
                fs::remove_file(&part).map_err(FileError::at(&part))?;
                let found = format!("{size} bytes with the hash {found}");
                let wanted = format!("{} bytes with {}", package.size, package.sha256);
                return Err(ToolchainError::Damaged { url, found, wanted });
            }
            fs::rename(&part, &file).map_err(FileError::at(&file))?;
        }
        progress(package.size);
        Ok(file)
    }

    fn url(&self, path: &str) -> String {
        format!("{}/{path}", self.mirror.trim_end_matches('/'))
    }
}

/// Downloads `url` to `file`, and resumes a partial file.
fn curl(url: &str, file: &Path, progress: impl Fn(u64)) -> Result<(), ToolchainError> {
    let mut curl = Command::new("curl");
    curl.args(["--fail", "--location", "--silent", "--show-error", "--retry", "3", "--connect-timeout", "30"]);
    // a stalled connection is closed; the user can try again
    curl.args(["--speed-limit", "1", "--speed-time", "60", "--continue-at", "-", "--output"]).arg(file).arg(url);
    curl.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    let child = interrupt::Child::spawn(&mut curl).map_err(ToolchainError::NoCurl)?;
    while child.try_wait().map_err(ToolchainError::NoCurl)?.is_none() {
        progress(fs::metadata(file).map_or(0, |metadata| metadata.len()));
        thread::sleep(TICK);
    }
    if child.wait().map_err(ToolchainError::NoCurl)?.success() {
        return Ok(());
    }
    let mut said = String::new();
    if let Some(mut stderr) = child.take_stderr() {
        // what isn't text says nothing
        let _ = stderr.read_to_string(&mut said);
    }
    let said = said.lines().last().unwrap_or("curl says nothing").trim().to_string();
    Err(ToolchainError::Download { url: url.into(), said, progress: String::new() })
}

/// The `error`, which says of a download how many of its bytes are there.
fn with_progress(error: ToolchainError, there: u64, size: u64) -> ToolchainError {
    match error {
        ToolchainError::Download { url, said, .. } => {
            ToolchainError::Download { url, said, progress: format!("{there} of {size} bytes are there, and ") }
        }
        other => other,
    }
}

/// SHA-256 of a file, in hexadecimal digits.
fn hash(path: &Path) -> io::Result<String> {
    let mut file = File::open(path)?;
    let (mut hash, mut bytes) = (Sha256::new(), vec![0; 1 << 16]);
    loop {
        match file.read(&mut bytes)? {
            0 => return Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()),
            count => hash.update(&bytes[..count]),
        }
    }
}
