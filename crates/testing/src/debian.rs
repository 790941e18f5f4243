//! Debian packages for tests, unpacked in the target folder: other C libraries, emulators.
//!
//! `apt-get` and `dpkg-deb` do this as any user, with their own package lists. Versions cannot be pinned, because the archive
//! keeps only the last one. Releases are pinned, and apt checks signature and hash of every package.

use super::python::target_folder;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};

/// Some packages of one release.
pub struct Packages {
    /// The folder in which they are unpacked.
    pub folder: PathBuf,
    /// Their names and versions, one on each line.
    pub versions: String,
}

/// The `packages` of `release` in the folder `name`; if `with_dependencies`, with all dependencies that this system has not
/// installed. They are downloaded once.
///
/// # Errors
/// The reason why they are not available.
pub fn packages(name: &str, release: &str, packages: &[&str], with_dependencies: bool) -> Result<Packages, String> {
    // one program at a time, and one thread in it: both would download the same lists
    static FETCHING: Mutex<()> = Mutex::new(());
    let _alone = FETCHING.lock().unwrap_or_else(PoisonError::into_inner);
    let root = target_folder().join("debian");
    fs::create_dir_all(&root).map_err(|error| format!("{}: {error}", root.display()))?;
    let lock = File::create(root.join("lock")).expect("the target folder can be written to");
    lock.lock().expect("the target folder is on a file system with locks");
    let folder = root.join(name);
    // written last: a folder without it is incomplete
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

/// Unpacks all `archives`; returns their names and versions.
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

/// apt with the lists of a single release.
struct Apt {
    options: Vec<String>,
}

impl Apt {
    /// It knows what is `installed`, or nothing.
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
            // the folders belong to the user, who also downloads
            "APT::Sandbox::User=".into(),
            "APT::Architecture=amd64".into(),
            // for `package:arm64`
            "APT::Architectures::=amd64".into(),
            "APT::Architectures::=arm64".into(),
        ];
        let mut apt = Apt { options: options.into() };
        if !installed {
            // apt would otherwise download packages that are installed in another version
            apt.options.push("Dir::State::Status=/dev/null".into());
        }
        // old lists contain versions that no longer exist
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

/// The location of Debian's keys.
const KEYS: &str = "/usr/share/keyrings/debian-archive-keyring.gpg";

/// The Debian archive configured on this system, with its keys.
fn archive() -> Result<String, String> {
    let format = "$(REPO_URI)";
    let sources = succeed(Command::new("apt-get").args(["indextargets", "--format", format, "Created-By: Packages"]))?;
    let found = sources.lines().find(|archive| archive.trim_end_matches('/').ends_with("/debian"));
    let archive = found.ok_or("this system has no package source of Debian")?;
    // otherwise with the keys that apt trusts
    let keys = if Path::new(KEYS).exists() { format!("[signed-by={KEYS}] ") } else { String::new() };
    Ok(format!("{keys}{archive}"))
}

/// The output of `command`.
///
/// # Errors
/// Its error message.
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
