//! Scene files: reading them, and warnings about what is in them.

use crate::messages::warn;
use brinell_exporter::mistake::{self, Mistake, SceneError};
use brinell_exporter::scene::{self, Scene};
use std::io::{self, Read};
use std::path::Path;

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
    for doubt in doubts {
        warn(&doubt.in_file(&scene.text, path).to_string());
    }
    Ok(scene)
}

fn read_with_doubts(path: &Path) -> Result<(Scene, Vec<Mistake>), SceneError> {
    Scene::of_bytes(bytes(path)?, path)
}

/// The text of the scene at `path` with all numbers in SI units.
///
/// # Errors
/// As for [`read`].
pub fn in_si(path: &Path) -> Result<String, SceneError> {
    scene::in_si(&mistake::text(bytes(path)?, path)?, path)
}

/// The contents of the file at `path`, which may be a device that never ends.
fn bytes(path: &Path) -> Result<Vec<u8>, SceneError> {
    let unreadable = |source| SceneError::Unreadable { path: path.into(), source };
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(unreadable)?;
    file.take(LARGEST + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST {
        let message = format!("it is larger than {} MB, which no scene needs", LARGEST >> 20);
        return Err(unreadable(io::Error::other(message)));
    }
    Ok(bytes)
}
