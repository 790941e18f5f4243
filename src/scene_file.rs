//! Scene files: reading them, and warnings about what is in them.

use crate::files::{CONFIGURATION, user_folder};
use crate::messages::warn;
use brinell_exporter::layout::shown;
use brinell_exporter::mistake::{self, SceneError};
use brinell_exporter::scene::{self, Beside, MaterialTable, Scene};
use std::collections::BTreeMap;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The name of a table of materials of one's own, and where it may lie.
const TABLE: &str = "materials.toml";
const BESIDE: &str = "materials.toml beside the scene";
const OF_USER: &str = "materials.toml in the user's configuration folder";

/// The variable by which Python says where the texts of workbooks are, by the names that a scene gives them.
const WORKBOOKS: &str = "BRINELL_WORKBOOKS";

/// The largest scene [bytes]. One with 100,000 contacts, each with its own numbers, takes a tenth of it.
const LARGEST: u64 = 256 << 20;

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
    Ok(read_with_doubts(path)?.0)
}

/// The same, with plausibility warnings on standard error.
///
/// # Errors
/// As for [`read`].
pub fn read_aloud(path: &Path) -> Result<Scene, SceneError> {
    let (scene, doubts) = read_with_doubts(path)?;
    doubts.iter().for_each(|doubt| warn(&doubt.to_string()));
    Ok(scene)
}

fn read_with_doubts(path: &Path) -> Result<(Scene, Vec<SceneError>), SceneError> {
    let text = mistake::text(bytes(path)?, path)?;
    Scene::parse_beside(&text, path, &beside(&text, path)?)
}

/// What lies beside the scene with this `text` at `path`.
fn beside(text: &str, path: &Path) -> Result<Beside, SceneError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let workbooks: BTreeMap<String, PathBuf> =
        std::env::var(WORKBOOKS).map_or(BTreeMap::new(), |texts| serde_json::from_str(&texts).unwrap_or_default());
    let read = |name: String| {
        let path = workbooks.get(&name).cloned().unwrap_or_else(|| folder.join(&name));
        let found = bytes(&path).map_err(|error| match error {
            SceneError::Unreadable { source, .. } => format!("{} can't be read: {source}", shown(&path)),
            other => other.to_string(),
        });
        (name, found)
    };
    let files = scene::files_named(text).into_iter().map(read).collect();
    Ok(Beside { files, materials: materials(folder)? })
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
        let text = mistake::text(bytes(&path)?, &path)?;
        MaterialTable::parse(&text, &path, place)
    };
    tables.filter(|(path, _)| path.is_file()).map(read).collect()
}

/// The text of the scene at `path` with all numbers in SI units.
///
/// # Errors
/// As for [`read`].
pub fn in_si(path: &Path) -> Result<String, SceneError> {
    let text = mistake::text(bytes(path)?, path)?;
    scene::in_si(&text, path, &beside(&text, path)?)
}

/// The contents of the file at `path`, or of standard input.
///
/// # Errors
/// A file that can't be read, or is too large.
pub fn bytes_or_standard_input(path: Option<&Path>) -> Result<Vec<u8>, SceneError> {
    path.map_or_else(|| limited(io::stdin(), Path::new("standard input")), bytes)
}

/// The contents of the file at `path`.
fn bytes(path: &Path) -> Result<Vec<u8>, SceneError> {
    let file = std::fs::File::open(path);
    limited(file.map_err(|source| SceneError::Unreadable { path: path.into(), source })?, path)
}

/// All that comes from a `source`, which may be a device that never ends.
fn limited(source: impl Read, path: &Path) -> Result<Vec<u8>, SceneError> {
    let unreadable = |source| SceneError::Unreadable { path: path.into(), source };
    let mut bytes = Vec::new();
    source.take(LARGEST + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST {
        let message = format!("it is larger than {} MB, which no scene needs", LARGEST >> 20);
        return Err(unreadable(io::Error::other(message)));
    }
    Ok(bytes)
}
