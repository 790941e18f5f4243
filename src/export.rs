//! `brinell export`: builds the FMU of a scene and lists what it contains.

use crate::files;
use crate::messages::tell;
use crate::package::{self, ExportError, Way};
use crate::summary::Summary;
use brinell_exporter::layout::{json_line, shown};
use brinell_exporter::plan::Plan;
use brinell_exporter::platform::Platform;
use brinell_exporter::scene::Scene;
use std::path::{Path, PathBuf};

/// The command: makes the FMU of `scene`, the file at `source`, in this `way` for `platforms`, and writes it to `output` or to the
/// current folder. Returns its path.
pub fn run(
    (scene, source): (&Scene, Option<&Path>),
    (way, platforms): (Way, &[Platform]),
    output: Option<&Path>,
    as_json: bool,
) -> Result<PathBuf, ExportError> {
    let path = output.map_or_else(|| format!("{}.fmu", scene.name).into(), Path::to_path_buf);
    // errors that would occur at the end are reported before the work
    files::check_goal(&path)?;
    if let Some(source) = source {
        files::check_kept(&path, source)?;
    }
    if output.is_none() {
        files::check_own(&path, None, &scene.text, source)?;
    }
    tell(&format!("building {} ...", shown(&path)));
    let plan = Plan::of(scene);
    let exported = package::export(&plan, way, platforms, &path)?;
    let summary = Summary::of(&plan);
    // the stream may be standard output itself, where the summary would be behind the archive
    if files::is_stream(&path) {
        return Ok(exported.path);
    }
    if as_json {
        print!("{}", json_line(&summary.json(&exported)));
    } else {
        summary.print(&exported);
    }
    Ok(exported.path)
}
