//! `brinell export`: builds the FMU of a scene and lists what it contains.

use crate::files::{self, FileError, folder_of};
use crate::importer;
use crate::messages::tell;
use crate::package::{self, ExportError, LibraryWay};
use crate::summary::Summary;
use brinell_exporter::layout::{json_line, shown};
use brinell_exporter::plan::Plan;
use brinell_exporter::platform::Platform;
use brinell_exporter::scene::Scene;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// The command: makes the FMU of `scene`, the file at `source`, in this `way` for `platforms`, and writes it to `output` or to the
/// current folder. Returns its path.
pub fn run(
    (scene, source): (&Scene, Option<&Path>),
    (way, platforms): (LibraryWay, &[Platform]),
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
        check_own(&path, None, &scene.text, source)?;
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

/// Rejects a `path` that nobody has named if another file is there than an FMU of the scene with this `text`, which is in the
/// file `source`, or a system with that FMU as its `unit`. What was made from an earlier text of the scene is replaced, but not what
/// belongs to a scene beside it which has the same name.
///
/// # Errors
/// [`FileError`]
pub fn check_own(path: &Path, unit: Option<&str>, text: &str, source: Option<&Path>) -> Result<(), FileError> {
    let what = if unit.is_some() { "system" } else { "FMU" };
    let kept = |whose: &str| {
        let said = format!("this is {whose}, which isn't replaced; `-o FILE` names the file to write");
        Err(FileError::at(path)(io::Error::new(io::ErrorKind::AlreadyExists, said)))
    };
    if !path.exists() {
        return Ok(());
    }
    let Ok(Some(old)) = importer::scene_in(path, unit) else { return kept(&format!("no {what} of a scene")) };
    if old == text {
        return Ok(());
    }
    let folders = [Some(path), source].into_iter().flatten().map(folder_of);
    let files = folders.filter_map(|folder| fs::read_dir(folder).ok()).flatten().flatten().map(|entry| entry.path());
    // the scene itself has another text
    let mut scenes = files.filter(|file| file.extension().is_some_and(|ending| ending == "toml"));
    match scenes.find(|file| file.is_file() && fs::read(file).is_ok_and(|bytes| bytes == old.as_bytes())) {
        Some(other) => kept(&format!("the {what} of {}, which has the same name", shown(&other))),
        None => Ok(()),
    }
}
