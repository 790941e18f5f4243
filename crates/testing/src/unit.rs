//! FMUs for tests: exports a scene with the program as a user does, and loads the library.

use crate::command::{brinell, output};
use crate::long;
use crate::places::{program, root, temporary, test_name};
use crate::prebuilt;
use std::collections::HashMap;
use std::collections::hash_map::DefaultHasher;
use std::ffi::OsStr;
use std::fs;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock, Mutex, OnceLock, PoisonError};

/// Results made in this process, by their sources.
static MADE: LazyLock<Mutex<HashMap<PathBuf, Arc<OnceLock<PathBuf>>>>> = LazyLock::new(Mutex::default);

/// The folder for everything that tests export; cargo keeps it inside the target folder.
fn folder() -> PathBuf {
    // test programs may run at the same time, so each has its own folder
    temporary().join("units").join(test_name())
}

/// The result of `make` for `source`, made once per process. Other threads wait for it, or make other results in the
/// meantime. After a failed export, the next test fails with its own message.
fn once(source: PathBuf, make: impl FnOnce(&Path) -> PathBuf) -> PathBuf {
    let made = Arc::clone(MADE.lock().unwrap_or_else(PoisonError::into_inner).entry(source.clone()).or_default());
    made.get_or_init(|| make(&source)).clone()
}

/// The folder for the exports of this program from `scene`, which other test programs may have made. It exists only
/// when it is complete.
fn shared_folder(scene: &Path) -> PathBuf {
    // one thread alone prepares the folder; another one would remove what the first has made
    static OURS: LazyLock<PathBuf> = LazyLock::new(|| {
        let program = fs::read(program()).expect("cargo has built the program");
        let all = temporary().join("exported");
        let ours = all.join(hash_of(&[&program]));
        if !ours.exists() {
            // exports of another build of the program are useless now
            let _ = fs::remove_dir_all(&all);
            fs::create_dir_all(&ours).expect("the target folder can be written to");
        }
        ours
    });
    let text = fs::read(scene).expect("a scene file");
    let name = scene.file_name().expect("a scene file has a name").as_encoded_bytes();
    OURS.join(hash_of(&[name, &text]))
}

/// 16 digits that identify these bytes.
fn hash_of(parts: &[&[u8]]) -> String {
    let mut hash = DefaultHasher::new();
    parts.hash(&mut hash);
    format!("{:016x}", hash.finish())
}

/// A scene file of the project by its name without `.toml`.
pub fn scene(name: &str) -> PathBuf {
    root().join("scenes").join(name).with_extension("toml")
}

/// The default scene with the output `regime`, which it does not have because some importers cannot read an enumeration.
pub fn steel_ball_with_regime() -> PathBuf {
    let text = fs::read_to_string(scene("steel_ball")).expect("a scene file");
    write_scene("steel_ball", &text.replacen("outputs = [", "outputs = [\"regime\", ", 1))
}

/// The scene files of the project, but for those in folders of their own.
pub fn scenes() -> Vec<PathBuf> {
    scenes_in("scenes")
}

/// Those whose libraries are compiled: in a usual run one of the default contact, with a known mass, with friction, with shared bodies,
/// and with both.
pub fn scenes_to_compile() -> Vec<PathBuf> {
    const USUAL: [&str; 5] = ["steel_ball", "mass_known", "oblique", "stack", "slope"];
    let mut scenes = scenes();
    scenes.retain(|path| long::is_asked() || USUAL.iter().any(|name| path.file_stem() == Some(OsStr::new(name))));
    assert!(scenes.len() >= USUAL.len(), "{scenes:?}");
    scenes
}

/// The scene files in this folder of the project.
pub fn scenes_in(folder: &str) -> Vec<PathBuf> {
    let folder = root().join(folder);
    let entries = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut scenes: Vec<_> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    scenes.retain(|path| path.extension() == Some(OsStr::new("toml")));
    scenes.sort();
    assert!(!scenes.is_empty(), "no scene in {}", folder.display());
    scenes
}

/// The scenes with one contact, whose variables have plain names.
pub fn plain_scenes() -> Vec<PathBuf> {
    let is_plain = |path: &PathBuf| !fs::read_to_string(path).expect("a scene file").contains("[[contact]]");
    scenes().into_iter().filter(is_plain).collect()
}

/// A scene file that a test writes itself.
pub fn write_scene(name: &str, text: &str) -> PathBuf {
    // two tests may give the same name to different scenes
    let folder = folder().join("scenes").join(hash_of(&[text.as_bytes()]));
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    let path = folder.join(name).with_extension("toml");
    // another test may be reading the same scene: it is written atomically
    let draft = path.with_extension(format!("{:?}", std::thread::current().id()));
    fs::write(&draft, text).expect("the target folder can be written to");
    fs::rename(&draft, &path).expect("the target folder can be written to");
    path
}

/// The FMU of a scene file: compiled if the scene needs it, and in a long run if it is one of the project; otherwise from a prebuilt library,
/// with which the same calls give the same bits and which takes a hundredth of the time.
pub fn export(scene: &Path) -> PathBuf {
    let text = fs::read_to_string(scene).unwrap_or_else(|error| panic!("{}: {error}", scene.display()));
    let compiled = text.contains("standalone") || long::is_asked() && scene.starts_with(root().join("scenes"));
    made(scene, (!compiled).then(prebuilt::store))
}

/// The FMU of a scene file, compiled: for what is in the library.
pub fn compiled(scene: &Path) -> PathBuf {
    made(scene, None)
}

/// The FMU of a scene file, compiled or with the libraries in `store`: `brinell export SCENE -o FILE`.
fn made(scene: &Path, store: Option<&Path>) -> PathBuf {
    let scene = scene.canonicalize().unwrap_or_else(|error| panic!("{}: {error}", scene.display()));
    let way = if store.is_some() { "prebuilt" } else { "compiled" };
    once(scene.join(way), |_| {
        let shared = shared_folder(&scene).with_extension(way);
        let unit = Path::new(scene.file_stem().expect("a scene file has a name")).with_extension("fmu");
        if !shared.exists() {
            let draft = draft_of(&shared);
            fs::create_dir_all(&draft).expect("the target folder can be written to");
            let mut command = store.map_or_else(|| brinell(&draft), |store| prebuilt::without_compiler(&draft, store));
            output(command.arg("export").arg(&scene).arg("-o").arg(&unit)).with_status(0);
            // another test program may have been faster
            if fs::rename(&draft, &shared).is_err() {
                let _ = fs::remove_dir_all(&draft);
            }
        }
        shared.join(unit)
    })
}

/// A place beside `path` for this thread alone.
fn draft_of(path: &Path) -> PathBuf {
    path.with_extension(format!("{}-{:?}", std::process::id(), std::thread::current().id()))
}

/// Unpacks `fmu` into `folder`.
pub fn unpack(fmu: &Path, folder: &Path) {
    let file = fs::File::open(fmu).unwrap_or_else(|error| panic!("{}: {error}", fmu.display()));
    let unpacked = zip::ZipArchive::new(file).and_then(|mut archive| archive.extract(folder));
    unpacked.unwrap_or_else(|error| panic!("{} isn't unpacked: {error}", fmu.display()));
}

/// The library inside an FMU, unpacked. Tests only read what is unpacked.
pub fn library(fmu: &Path) -> PathBuf {
    once(fmu.to_path_buf(), |fmu| {
        let folder = folder().join(hash_of(&[&fs::read(fmu).expect("an FMU")]));
        if !folder.exists() {
            let draft = draft_of(&folder);
            unpack(fmu, &draft);
            // another process may have been faster
            if fs::rename(&draft, &folder).is_err() {
                let _ = fs::remove_dir_all(&draft);
            }
        }
        let platforms = fs::read_dir(folder.join("binaries")).expect("a unit has binaries");
        let files = platforms.flat_map(|platform| {
            fs::read_dir(platform.expect("a readable folder").path()).expect("a folder for each platform")
        });
        let mut libraries: Vec<_> = files.map(|file| file.expect("a readable folder").path()).collect();
        assert_eq!(libraries.len(), 1, "a unit exported here has one library: {libraries:?}");
        libraries.remove(0)
    })
}
