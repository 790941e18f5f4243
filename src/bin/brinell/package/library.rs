//! The library of a unit: what cargo is given, and how it is called.

use super::{ExportError, LIBRARY_SOURCE};
use crate::files::FileError;
use crate::scene::Scene;
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

const LOCK: &str = include_str!("../../../../Cargo.lock");

/// The manifest of the package that cargo builds: the library alone, with nothing but `libm`.
fn manifest(guid: &str) -> String {
    let libm = libm();
    let version = env!("CARGO_PKG_VERSION");
    // the name is unique for each unit, so that units built at the same time don't overwrite each other
    format!(
        r#"[package]
name = "fmu-{guid}"
version = "{version}"
edition = "2024"

[lib]
crate-type = ["cdylib"]

[features]
default = ["fmu"]
fmu = ["c-interface"]
c-interface = []
# named in the source, and never on
exporter = []

[dependencies]
libm = {{ version = "={}", default-features = false, features = ["arch"] }}

[workspace]
"#,
        libm.version
    )
}

/// How the library is compiled, given on the command line, where nothing in the user's configuration stands before it.
const PROFILE: [&str; 6] = [
    "profile.release.lto='fat'",
    "profile.release.codegen-units=1",
    "profile.release.panic='abort'",
    "profile.release.strip='symbols'",
    "profile.release.debug=false",
    "profile.release.overflow-checks=false",
];

/// Contacts from which on their loops are worth being fast instead of small.
const MANY_CONTACTS: usize = 16;

/// As small as it can be, since the few lines of a plain step are the same in any case; or, for many contacts, with loops that
/// work on several at once.
fn optimization(scene: &Scene) -> &'static str {
    if scene.contact_count() < MANY_CONTACTS { "profile.release.opt-level='s'" } else { "profile.release.opt-level=3" }
}

/// Leaves out what unwinding would need, and the compiler's name. Nothing unwinds through a library that cannot panic.
const LINKER_SCRIPT: (&str, &str) =
    ("unit.ld", "SECTIONS { /DISCARD/ : { *(.eh_frame) *(.comment) } } INSERT AFTER .text;\n");

#[derive(Deserialize)]
struct LockFile {
    package: Vec<Locked>,
}

#[derive(Clone, Deserialize)]
struct Locked {
    name: String,
    version: String,
    source: Option<String>,
    checksum: Option<String>,
}

/// The version of `libm` that this program was tested with.
fn libm() -> Locked {
    let lock: LockFile = toml::from_str(LOCK).expect("Cargo.lock is written by cargo");
    lock.package.into_iter().find(|package| package.name == "libm").expect("the library needs libm")
}

/// Pins `libm` to exactly the tested text, so that the same scene gives the same binary everywhere.
fn lock_file(guid: &str) -> String {
    let Locked { version, source, checksum, .. } = libm();
    let (source, checksum) = (source.unwrap_or_default(), checksum.unwrap_or_default());
    let own = env!("CARGO_PKG_VERSION");
    format!(
        "version = 4\n\n[[package]]\nname = \"fmu-{guid}\"\nversion = \"{own}\"\ndependencies = [\n \"libm\",\n]\n\n\
         [[package]]\nname = \"libm\"\nversion = \"{version}\"\nsource = \"{source}\"\nchecksum = \"{checksum}\"\n"
    )
}

/// Arguments for the linker: no start files and no library, symbols bound inside the unit first and at once.
fn link_arguments() -> &'static [&'static str] {
    match env::consts::OS {
        "linux" => &[
            "-Clink-arg=-nostartfiles",
            "-Clink-arg=-nodefaultlibs",
            "-Clink-arg=-Wl,-z,now,-Bsymbolic,--build-id=none,--hash-style=gnu,--no-eh-frame-hdr,-T,unit.ld",
        ],
        "windows" => &["-Clink-arg=/NOENTRY", "-Clink-arg=/DEBUG:NONE", "-Clink-arg=/Brepro"],
        _ => &[],
    }
}

/// One line of `cargo --message-format=json`.
#[derive(Deserialize)]
struct Message {
    reason: String,
    target: Option<Target>,
    #[serde(default)]
    filenames: Vec<PathBuf>,
}

#[derive(Deserialize)]
struct Target {
    crate_types: Vec<String>,
}

/// Compiles the library with `constants` as its scene and gives its bytes.
pub fn build(scene: &Scene, constants: &str, guid: &str) -> Result<Vec<u8>, ExportError> {
    let folder = tempfile::Builder::new().prefix("brinell-").tempdir();
    let folder = folder.map_err(FileError::at(&env::temp_dir()))?;
    let root = folder.path();
    let (manifest, lock_file) = (manifest(guid), lock_file(guid));
    let own =
        [("src/scene/exported.rs", constants), ("Cargo.toml", &manifest), ("Cargo.lock", &lock_file), LINKER_SCRIPT];
    for (name, text) in LIBRARY_SOURCE.iter().copied().chain(own) {
        write_file(&root.join(name), text.as_bytes())?;
    }
    let cache = Cache::lock()?;
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.current_dir(root).env("CARGO_TARGET_DIR", &cache.folder);
    let settings = [optimization(scene)].into_iter().chain(PROFILE);
    command.args(settings.flat_map(|setting| ["--config", setting]));
    command.args(["rustc", "--release", "--lib", "--locked", "--message-format=json", "--"]).args(link_arguments());
    isolate(&mut command);
    let output = command.output().map_err(ExportError::NoCargo)?;
    if !output.status.success() {
        return Err(ExportError::Build(String::from_utf8_lossy(&output.stderr).into_owned()));
    }
    let messages = String::from_utf8_lossy(&output.stdout);
    let built = messages.lines().filter_map(|line| serde_json::from_str::<Message>(line).ok());
    let is_library = |message: &Message| {
        let cdylib = |target: &Target| target.crate_types.iter().any(|kind| kind == "cdylib");
        message.reason == "compiler-artifact" && message.target.as_ref().is_some_and(cdylib)
    };
    let missing = || ExportError::Build(format!("cargo named no library for {}", scene.name));
    let path = built.filter(is_library).flat_map(|message| message.filenames).next().ok_or_else(missing)?;
    let library = fs::read(&path).map_err(FileError::at(&path))?;
    cache.forget(guid);
    Ok(library)
}

/// Keeps the user's own flags, wrappers and profiles from the unit: the same scene gives the same bytes.
fn isolate(command: &mut Command) {
    for name in ["CARGO_ENCODED_RUSTFLAGS", "RUSTC_WRAPPER", "RUSTC_WORKSPACE_WRAPPER"] {
        // empty is none, and stands before the configuration
        command.env(name, "");
    }
    command.env("CARGO_INCREMENTAL", "0");
    let ours = |name: &str| {
        name.starts_with("CARGO_PROFILE_")
            || ["RUSTFLAGS", "RUSTC_BOOTSTRAP", "CARGO_BUILD_TARGET", "CARGO_BUILD_INCREMENTAL"].contains(&name)
    };
    for (name, _) in env::vars_os() {
        if ours(&name.to_string_lossy()) {
            command.env_remove(name);
        }
    }
}

/// Where compiled dependencies stay between exports; one export at a time.
struct Cache {
    folder: PathBuf,
    // the lock ends when the file is closed
    _lock: fs::File,
}

impl Cache {
    fn lock() -> Result<Cache, FileError> {
        let folder = cache_folder();
        fs::create_dir_all(&folder).map_err(FileError::at(&folder))?;
        let lock = fs::File::create(folder.join("lock")).map_err(FileError::at(&folder))?;
        lock.lock().map_err(FileError::at(&folder))?;
        Ok(Cache { folder, _lock: lock })
    }

    /// Removes what belongs to one unit: it is rebuilt in a second, and units would pile up. Dependencies stay.
    fn forget(&self, guid: &str) {
        for folder in ["release", "release/deps", "release/.fingerprint"] {
            let Ok(entries) = fs::read_dir(self.folder.join(folder)) else { continue };
            for path in entries.flatten().map(|entry| entry.path()) {
                if path.file_name().is_some_and(|name| name.to_string_lossy().contains(guid)) {
                    // what can't be removed is only in the way
                    let _ = if path.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
                }
            }
        }
    }
}

/// `BRINELL_CACHE`, or the user's cache.
fn cache_folder() -> PathBuf {
    if let Some(chosen) = env::var_os("BRINELL_CACHE") {
        // cargo runs in another folder than the user
        return std::path::absolute(&chosen).unwrap_or_else(|_| chosen.into());
    }
    let home = |name: &str| env::var_os(name).map(PathBuf::from);
    let base = home("XDG_CACHE_HOME").or_else(|| home("LOCALAPPDATA")).or_else(|| Some(home("HOME")?.join(".cache")));
    base.unwrap_or_else(env::temp_dir).join("brinell")
}

fn write_file(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let file_error = FileError::at(path);
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(&file_error)?;
    }
    fs::write(path, bytes).map_err(&file_error)
}
