//! Scene files: reading them, and warnings about what is in them.

use crate::files::{self, CONFIGURATION, user_folder};
use crate::importer::{self, ImportError};
use crate::messages::warn;
use brinell_exporter::layout::shown;
use brinell_exporter::mistake::{self, SceneError};
use brinell_exporter::scene::{self, MaterialTable, ReferencedFiles, Scene};
use std::collections::BTreeMap;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The name of a table of materials of one's own, and where it may lie.
const TABLE: &str = "materials.toml";
const BESIDE: &str = "materials.toml beside the scene";
const OF_USER: &str = "materials.toml in the user's configuration folder";

/// The variable by which Python says where the texts of workbooks are, by the names that a scene gives them.
const WORKBOOKS: &str = "BRINELL_WORKBOOKS";

/// The largest table of materials or tensile test [bytes]. A machine that writes three numbers a thousand times a second for ten minutes
/// makes half of it.
const LARGEST_BESIDE: u64 = 40_000_000;

const DEFAULT_SCENE: &str = include_str!("../scenes/steel_ball.toml");

/// The scene for a program without arguments.
///
/// # Errors
/// As for [`read`].
pub fn default_scene() -> Result<Scene, SceneError> {
    Scene::parse(DEFAULT_SCENE.into(), Path::new("scenes/steel_ball.toml"))
}

/// Reads and checks the scene at `path`.
///
/// # Errors
/// [`SceneError`] with line and column of the first error, and what is allowed there.
pub fn read(path: &Path) -> Result<Scene, SceneError> {
    Ok(read_with_warnings(path)?.0)
}

/// The same, with plausibility warnings on standard error.
///
/// # Errors
/// As for [`read`].
pub fn read_aloud(path: &Path) -> Result<Scene, SceneError> {
    let (scene, warnings) = read_with_warnings(path)?;
    warnings.iter().for_each(|warning| warn(&warning.to_string()));
    Ok(scene)
}

fn read_with_warnings(path: &Path) -> Result<(Scene, Vec<SceneError>), SceneError> {
    let source = Source::read(path)?;
    Scene::parse_with_files(&source.text, &source.path, &source.referenced_files()?)
}

/// A scene's text, and where it is from.
struct Source {
    text: String,
    /// In messages: that of the file, or one in an FMU.
    path: PathBuf,
    /// An FMU's scene has taken in all that it uses.
    is_alone: bool,
}

impl Source {
    /// The scene at `path`, or that of the FMU there.
    fn read(path: &Path) -> Result<Source, SceneError> {
        let unreadable = |source| SceneError::Unreadable { path: path.into(), source };
        files::check_readable(path, &files::SCENE).map_err(unreadable)?;
        let bytes = bytes(path, importer::LARGEST_SCENE, "scene")?;
        if !bytes.starts_with(ARCHIVE) {
            return Ok(Source { text: mistake::text(bytes, path)?, path: path.into(), is_alone: false });
        }
        let none =
            || io::Error::other("this is an archive without a scene: no FMU of brinell, nor the text of a scene");
        let found = importer::scene_in(path, None).map_err(|error| match error {
            ImportError::Unreadable(error) => error,
            other => io::Error::other(other.to_string()),
        });
        let text = found.and_then(|text| text.ok_or_else(none)).map_err(unreadable)?;
        Ok(Source { text, path: path.join(importer::SCENE), is_alone: true })
    }

    fn referenced_files(&self) -> Result<ReferencedFiles, SceneError> {
        if self.is_alone { Ok(ReferencedFiles::default()) } else { referenced_files(&self.text, &self.path) }
    }
}

/// How an archive begins (APPNOTE.TXT, section 4.3.7).
const ARCHIVE: &[u8] = b"PK\x03\x04";

/// What lies beside the scene with this `text` at `path`.
fn referenced_files(text: &str, path: &Path) -> Result<ReferencedFiles, SceneError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let workbooks: BTreeMap<String, PathBuf> =
        std::env::var(WORKBOOKS).map_or(BTreeMap::new(), |texts| serde_json::from_str(&texts).unwrap_or_default());
    let read = |name: String| {
        let path = workbooks.get(&name).cloned().unwrap_or_else(|| folder.join(&name));
        let found = bytes(&path, LARGEST_BESIDE, "tensile test").map_err(|error| match error {
            SceneError::Unreadable { source, .. } => format!("{} can't be read: {source}", shown(&path)),
            other => other.to_string(),
        });
        (name, found)
    };
    let files = scene::files_named(text).into_iter().map(read).collect();
    Ok(ReferencedFiles { files, materials: materials(folder)? })
}

/// The tables of materials of one's own: that in the `folder` of a scene, then that of the user.
///
/// # Errors
/// A mistake in a table, with its place.
pub fn materials(folder: &Path) -> Result<Vec<MaterialTable>, SceneError> {
    let of_user = user_folder(|name| std::env::var_os(name), std::env::consts::OS, &CONFIGURATION).ok();
    let tables = [(Some(folder.join(TABLE)), BESIDE), (of_user.map(|folder| folder.join(TABLE)), OF_USER)];
    let tables = tables.into_iter().filter_map(|(path, place)| Some((path?, place)));
    let read = |(path, place): (std::path::PathBuf, &'static str)| {
        let text = mistake::text(bytes(&path, LARGEST_BESIDE, "table of materials")?, &path)?;
        MaterialTable::parse(&text, &path, place)
    };
    tables.filter(|(path, _)| path.is_file()).map(read).collect()
}

/// The text of the scene at `path` with all numbers in SI units.
///
/// # Errors
/// As for [`read`].
pub fn in_si(path: &Path) -> Result<String, SceneError> {
    let source = Source::read(path)?;
    scene::in_si(&source.text, &source.path, &source.referenced_files()?)
}

/// The contents of the table at `path`, or of standard input.
///
/// # Errors
/// A file that can't be read, or is too large.
pub fn bytes_or_standard_input(path: Option<&Path>) -> Result<Vec<u8>, SceneError> {
    match path {
        Some(path) => bytes(path, LARGEST_BESIDE, "table"),
        None => limited(io::stdin(), Path::new("standard input"), LARGEST_BESIDE, "table"),
    }
}

/// The contents of the file at `path`, which may be a device that never ends: at most `most` bytes, which are enough for `what` it is.
fn bytes(path: &Path, most: u64, what: &str) -> Result<Vec<u8>, SceneError> {
    let unreadable = |source| SceneError::Unreadable { path: path.into(), source };
    let file = std::fs::File::open(path).map_err(unreadable)?;
    // what a file says is told before it is read
    let size = file.metadata().map_err(unreadable)?.len();
    if size > most {
        return Err(too_large(path, importer::size(size), most, what));
    }
    limited(file, path, most, what)
}

fn too_large(path: &Path, size: String, most: u64, what: &str) -> SceneError {
    let allowed = importer::size(most);
    let source = io::Error::other(format!("it has {size}; allowed for a {what} is {allowed}"));
    SceneError::Unreadable { path: path.into(), source }
}

/// All that comes from a `source`.
fn limited(source: impl Read, path: &Path, most: u64, what: &str) -> Result<Vec<u8>, SceneError> {
    let mut bytes = Vec::new();
    let read = source.take(most + 1).read_to_end(&mut bytes);
    read.map_err(|source| SceneError::Unreadable { path: path.into(), source })?;
    if bytes.len() as u64 > most {
        let size = format!("more than {}", importer::size(most));
        return Err(too_large(path, size, most, what));
    }
    Ok(bytes)
}
