//! `brinell export`: builds the FMU of a scene and lists what it contains.

use crate::files;
use crate::package::{self, ExportError};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::summary::Summary;
use std::path::{Path, PathBuf};

/// The command: writes the FMU of `scene` to `output`, or into the current folder; gives its path.
pub fn run(scene: &Scene, output: Option<&Path>, as_json: bool) -> Result<PathBuf, ExportError> {
    let path = output.map_or_else(|| format!("{}.fmu", scene.name).into(), Path::to_path_buf);
    // what would fail at the end fails before the work
    files::check_goal(&path)?;
    eprintln!("building {} ...", path.display());
    let plan = Plan::of(scene);
    let exported = package::export(&plan, &path)?;
    let summary = Summary::of(&plan);
    if as_json {
        println!("{}", summary.json(&exported));
    } else {
        summary.print(&exported);
    }
    Ok(exported.path)
}
