//! Scene files: reading them, and warnings about what is in them.

use crate::messages::warn;
use brinell_exporter::mistake::{Mistake, SceneError};
use brinell_exporter::scene::Scene;
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
    let unreadable = |source| SceneError::Unreadable { path: path.into(), source };
    Scene::of_bytes(bytes(path).map_err(unreadable)?, path)
}

/// The contents of the file at `path`, which may be a device that never ends.
fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    std::fs::File::open(path)?.take(LARGEST + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > LARGEST {
        return Err(io::Error::other(format!("it is larger than {} MB, which no scene needs", LARGEST >> 20)));
    }
    Ok(bytes)
}
