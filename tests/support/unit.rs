//! Units for tests: a scene exported by the program itself, as a user would, and the library inside it.
#![allow(dead_code, reason = "each test file uses what it needs")]

use std::collections::HashMap;
use std::collections::hash_map::DefaultHasher;
use std::ffi::OsStr;
use std::fs;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{LazyLock, Mutex, PoisonError};

/// What has been made in this process, by what it was made from.
static MADE: LazyLock<Mutex<HashMap<PathBuf, PathBuf>>> = LazyLock::new(Mutex::default);

/// The folder for everything that tests export; cargo keeps it inside the target folder.
fn folder() -> PathBuf {
    // test programs may run at the same time, so each has its own
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("units").join(env!("CARGO_CRATE_NAME"))
}

/// The folder of the units that this very program has exported, by the text of their scenes, for all test programs. Those of other
/// programs are removed.
static KEPT: LazyLock<PathBuf> = LazyLock::new(|| {
    let all = Path::new(env!("CARGO_TARGET_TMPDIR")).join("kept");
    let program = fs::read(env!("CARGO_BIN_EXE_brinell")).expect("cargo has built the program");
    let own = format!("{:016x}", hash(&program));
    let others = fs::read_dir(&all).into_iter().flatten().flatten().filter(|entry| *entry.file_name() != *own);
    others.for_each(|entry| drop(fs::remove_dir_all(entry.path())));
    let folder = all.join(own);
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    folder
});

fn hash(bytes: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    hasher.finish()
}

/// What `make` makes from `source`, made once per process.
fn once(source: PathBuf, make: impl FnOnce(&Path) -> PathBuf) -> PathBuf {
    // the lock is held while something is made: a second test that asks for it waits. A failed export leaves nothing
    // in the table, so that the next test fails with its own message instead of "poisoned".
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(result) = made.get(&source) {
        return result.clone();
    }
    let result = make(&source);
    made.insert(source, result.clone());
    result
}

/// A scene file of the project by its name without `.toml`.
pub fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name).with_extension("toml")
}

/// The default scene with the output `regime`, which it hasn't got: some importers can't read an enumeration.
pub fn steel_ball_with_regime() -> PathBuf {
    let text = fs::read_to_string(scene("steel_ball")).expect("a scene file");
    write_scene("steel_ball", &text.replacen("outputs = [", "outputs = [\"regime\", ", 1))
}

/// All scene files of the project.
pub fn scenes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let entries = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut scenes: Vec<_> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    scenes.retain(|path| path.extension() == Some(OsStr::new("toml")));
    scenes.sort();
    assert!(!scenes.is_empty(), "no scene in {}", folder.display());
    scenes
}

/// Those with one contact, whose variables have plain names.
pub fn plain_scenes() -> Vec<PathBuf> {
    let is_plain = |path: &PathBuf| !fs::read_to_string(path).expect("a scene file").contains("[[contact]]");
    scenes().into_iter().filter(is_plain).collect()
}

/// A scene file that a test writes itself.
pub fn write_scene(name: &str, text: &str) -> PathBuf {
    let folder = folder().join("scenes");
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    let path = folder.join(name).with_extension("toml");
    // another test may be reading the same scene: it is never half written
    let draft = path.with_extension(format!("{:?}", std::thread::current().id()));
    fs::write(&draft, text).expect("the target folder can be written to");
    fs::rename(&draft, &path).expect("the target folder can be written to");
    path
}

/// The unit of a scene file: `brinell export SCENE -o FILE`.
pub fn export(scene: &Path) -> PathBuf {
    let scene = scene.canonicalize().unwrap_or_else(|error| panic!("{}: {error}", scene.display()));
    once(scene, |scene| {
        // two scenes of the same file name don't share a file
        let folder = folder().join(format!("{:016x}", hash(scene.as_os_str().as_encoded_bytes())));
        fs::create_dir_all(&folder).expect("the target folder can be written to");
        let unit = folder.join(scene.file_stem().expect("a scene file has a name")).with_extension("fmu");
        // a unit follows from the program and the text: another test program may have exported it
        let text = fs::read(scene).unwrap_or_else(|error| panic!("{}: {error}", scene.display()));
        let kept = KEPT.join(format!("{:016x}.fmu", hash(&text)));
        if fs::copy(&kept, &unit).is_ok() {
            return unit;
        }
        let output = Command::new(env!("CARGO_BIN_EXE_brinell"))
            .arg("export")
            .arg(scene)
            .arg("-o")
            .arg(&unit)
            // the user's own cache stays as it is
            .env("BRINELL_CACHE", Path::new(env!("CARGO_TARGET_TMPDIR")).join("cache"))
            .output()
            .expect("cargo has built the program");
        assert!(
            output.status.success(),
            "export of {} failed:\n{}",
            scene.display(),
            String::from_utf8_lossy(&output.stderr)
        );
        // whole, or not at all
        let draft = kept.with_extension(std::process::id().to_string());
        fs::copy(&unit, &draft).and_then(|_| fs::rename(&draft, &kept)).expect("the target folder can be written to");
        unit
    })
}

/// The library inside a unit, unpacked beside it.
pub fn library(fmu: &Path) -> PathBuf {
    once(fmu.to_path_buf(), |fmu| {
        let folder = fmu.with_extension("");
        let output = Command::new("python3")
            .args(["-m", "zipfile", "-e"])
            .args([fmu, &folder])
            .output()
            .unwrap_or_else(|error| panic!("python3 unpacks the unit, and it can't be started: {error}"));
        assert!(
            output.status.success(),
            "{} isn't unpacked:\n{}",
            fmu.display(),
            String::from_utf8_lossy(&output.stderr)
        );
        let platforms = fs::read_dir(folder.join("binaries")).expect("a unit has binaries");
        let files = platforms.flat_map(|platform| {
            fs::read_dir(platform.expect("a readable folder").path()).expect("a folder for each platform")
        });
        let mut libraries: Vec<_> = files.map(|file| file.expect("a readable folder").path()).collect();
        assert_eq!(libraries.len(), 1, "a unit exported here has one library: {libraries:?}");
        libraries.remove(0)
    })
}
