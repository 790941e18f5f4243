//! Packages of Debian for tests, unpacked in the target folder: other C libraries, emulators.
//!
//! `apt-get` and `dpkg-deb` do it, as any user, with lists of their own. Versions can't be pinned, since the archive keeps the
//! last one only; releases are, and apt checks signature and hash of whatever it gets.
#![allow(dead_code, reason = "each test file uses what it needs")]

use super::python::target_folder;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};

/// Some packages of one release.
pub struct Packages {
    /// The folder they are unpacked in.
    pub folder: PathBuf,
    /// Their names and versions, a line each.
    pub versions: String,
}

/// The `packages` of `release` in the folder `name`; with everything they depend on that this system hasn't installed, if
/// `with_dependencies`. They are fetched once.
///
/// # Errors
/// Why they can't be had.
pub fn packages(name: &str, release: &str, packages: &[&str], with_dependencies: bool) -> Result<Packages, String> {
    // one program at a time, and in it one thread: both would fetch the same lists
    static FETCHING: Mutex<()> = Mutex::new(());
    let _alone = FETCHING.lock().unwrap_or_else(PoisonError::into_inner);
    let root = target_folder().join("debian");
    fs::create_dir_all(&root).map_err(|error| format!("{}: {error}", root.display()))?;
    let lock = File::create(root.join("lock")).expect("the target folder can be written to");
    lock.lock().expect("the target folder is on a file system with locks");
    let folder = root.join(name);
    // written last: a folder without it is unfinished
    let marker = folder.join("packages.txt");
    if let Ok(versions) = fs::read_to_string(&marker) {
        return Ok(Packages { folder, versions });
    }
    let apt = Apt::of(&root, release, with_dependencies)?;
    let _ = fs::remove_dir_all(&folder);
    let archives = folder.join("archives");
    fs::create_dir_all(&archives).map_err(|error| format!("{}: {error}", archives.display()))?;
    let wanted = if with_dependencies { apt.missing(packages)? } else { packages.iter().map(|&p| p.into()).collect() };
    succeed(apt.command("apt-get").arg("download").args(&wanted).current_dir(&archives))?;
    let versions = unpack(&archives, &folder)?;
    let _ = fs::remove_dir_all(&archives);
    fs::write(&marker, &versions).map_err(|error| format!("{}: {error}", marker.display()))?;
    Ok(Packages { folder, versions })
}

/// Unpacks all `archives`; their names and versions.
fn unpack(archives: &Path, folder: &Path) -> Result<String, String> {
    let mut versions = Vec::new();
    for entry in fs::read_dir(archives).map_err(|error| format!("{}: {error}", archives.display()))? {
        let archive = entry.map_err(|error| error.to_string())?.path();
        succeed(Command::new("dpkg-deb").arg("--extract").arg(&archive).arg(folder))?;
        let fields = ["--showformat", "${Package} ${Version}\n", "--show"].map(OsStr::new);
        versions.push(succeed(Command::new("dpkg-deb").args(fields).arg(&archive))?);
    }
    versions.sort();
    Ok(versions.concat())
}

/// apt with lists of one release only.
struct Apt {
    options: Vec<String>,
}

impl Apt {
    /// It knows what is `installed`, or of nothing.
    fn of(root: &Path, release: &str, installed: bool) -> Result<Apt, String> {
        let state = root.join(format!("apt-{release}"));
        let (lists, cache, sources) = (state.join("lists"), state.join("cache"), state.join("sources.list"));
        for folder in [lists.join("partial"), cache.join("archives/partial")] {
            fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        }
        fs::write(&sources, format!("deb {} {release} main\n", archive()?)).map_err(|error| error.to_string())?;
        let options = [
            format!("Dir::State::Lists={}", lists.display()),
            format!("Dir::Cache={}", cache.display()),
            format!("Dir::Etc::SourceList={}", sources.display()),
            "Dir::Etc::SourceParts=/dev/null".into(),
            "Acquire::Languages=none".into(),
            "Acquire::IndexTargets::deb::DEP-11::DefaultEnabled=false".into(),
            // the folders are the user's, and so is who fetches
            "APT::Sandbox::User=".into(),
            "APT::Architecture=amd64".into(),
        ];
        let mut apt = Apt { options: options.into() };
        if !installed {
            // of what is installed in another version apt would fetch that one
            apt.options.push("Dir::State::Status=/dev/null".into());
        }
        // old lists name versions that are gone
        succeed(apt.command("apt-get").args(["--error-on=any", "update"]))?;
        Ok(apt)
    }

    fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.arg("--quiet").args(self.options.iter().flat_map(|option| ["-o", option]));
        command
    }

    /// What installing `packages` here would install.
    fn missing(&self, packages: &[&str]) -> Result<Vec<String>, String> {
        let mut apt = self.command("apt-get");
        let plan =
            succeed(apt.args(["install", "--simulate", "--no-install-recommends", "--reinstall"]).args(packages))?;
        let planned = plan.lines().filter_map(|line| line.strip_prefix("Inst "));
        Ok(planned.filter_map(|rest| rest.split(' ').next()).map(String::from).collect())
    }
}

/// Where Debian has its keys.
const KEYS: &str = "/usr/share/keyrings/debian-archive-keyring.gpg";

/// The archive of Debian that this system is set up for, with the keys that it is signed with.
fn archive() -> Result<String, String> {
    let format = "$(REPO_URI)";
    let sources = succeed(Command::new("apt-get").args(["indextargets", "--format", format, "Created-By: Packages"]))?;
    let found = sources.lines().find(|archive| archive.trim_end_matches('/').ends_with("/debian"));
    let archive = found.ok_or("this system has no package source of Debian")?;
    // otherwise with those that apt trusts anyway
    let keys = if Path::new(KEYS).exists() { format!("[signed-by={KEYS}] ") } else { String::new() };
    Ok(format!("{keys}{archive}"))
}

/// What `command` prints.
///
/// # Errors
/// What it says if it fails.
fn succeed(command: &mut Command) -> Result<String, String> {
    let output = command.env("LC_ALL", "C").output().map_err(|error| format!("{command:?}: {error}"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    let last = said.lines().rfind(|line| line.starts_with("E:")).or(said.lines().last()).unwrap_or_default();
    let program = command.get_program().to_string_lossy();
    match output.status.success() {
        true => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        false => Err(format!("{program} fails ({}): {last}", output.status)),
    }
}
