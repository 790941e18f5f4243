//! `brinell app`: opens the page of Brinell in the browser. A program that was built in a clone of the repository makes the page first.

use crate::files::installed;
use crate::messages::tell;
use brinell_exporter::layout::{json_line, shown};
use serde_json::json;
use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::time::SystemTime;

/// Environment variable that names another page than the installed one.
const VARIABLE: &str = "BRINELL_PAGE";

/// Its name among what is installed.
const PAGE: &str = "brinell.html";

/// The arguments of `brinell app`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Print where the page is, and open nothing
    #[arg(long)]
    pub path: bool,
}

/// Why there is no page to see.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    #[error(
        "this program was installed without its page: a release has it, `cargo run --release -- app` in a clone of the repository makes and \
         opens it, and {VARIABLE} names it"
    )]
    Missing,
    #[error("{VARIABLE} = {} is no file", shown(.0))]
    NotAFile(PathBuf),
    #[error("{PYTHON} makes the page, and can't be started: {0}")]
    NoPython(io::Error),
    #[error("{PYTHON} {} has made no page: {status}", shown(script))]
    NotMade { script: PathBuf, status: ExitStatus },
    #[error(
        "no browser could be started here ({source}); the page is {}: open it as a file in any browser",
        shown(path)
    )]
    Unopened { path: PathBuf, source: io::Error },
}

/// Opens the page.
pub fn run(arguments: &Arguments, as_json: bool) -> Result<(), AppError> {
    let path = page()?;
    if !arguments.path {
        open::that_detached(&path).map_err(|source| AppError::Unopened { path: path.clone(), source })?;
    }
    if as_json {
        print!("{}", json_line(&json!({ "page": path.to_string_lossy() })));
    } else {
        println!("{}", shown(&path));
    }
    Ok(())
}

/// The page that the user names, the installed one, or that of the clone in which the program was built.
fn page() -> Result<PathBuf, AppError> {
    if let Some(named) = env::var_os(VARIABLE).filter(|named| !named.is_empty()) {
        let path = PathBuf::from(named);
        return if path.is_file() { Ok(path) } else { Err(AppError::NotAFile(path)) };
    }
    let program = env::current_exe().unwrap_or_default();
    match installed(PAGE).filter(|path| path.is_file()) {
        Some(path) => Ok(path),
        None => of_clone(&program)?.ok_or(AppError::Missing),
    }
}

/// What makes the page, in a clone.
const SCRIPT: &str = "packaging/page.py";

/// The interpreter that runs it.
const PYTHON: &str = if cfg!(windows) { "python" } else { "python3" };

/// The page of the clone in which `program` was built, as `target/PROFILE/brinell`; made if it isn't there, or older than the program or
/// its own sources.
fn of_clone(program: &Path) -> Result<Option<PathBuf>, AppError> {
    let Some(clone) = program.ancestors().nth(3).filter(|folder| folder.join(SCRIPT).is_file()) else {
        return Ok(None);
    };
    let page = clone.join("target/page").join(PAGE);
    let made = |path: &Path| fs::metadata(path).and_then(|file| file.modified()).ok();
    let sources = [changed(&clone.join("crates/web")), made(program)].into_iter().max().flatten();
    if made(&page).is_none_or(|made| Some(made) < sources) {
        tell("making the page for this system: some minutes, the first time ...");
        let script = clone.join(SCRIPT);
        let mut make = Command::new(PYTHON);
        make.arg(&script).arg("--program").arg(program).arg("-o").arg(&page).current_dir(clone);
        // what it says is none of this program's answer
        let status = make.stdin(Stdio::null()).stdout(io::stderr()).status().map_err(AppError::NoPython)?;
        if !status.success() {
            return Err(AppError::NotMade { script, status });
        }
    }
    Ok(Some(page))
}

/// When something in a folder of sources was changed last.
fn changed(folder: &Path) -> Option<SystemTime> {
    let entries = fs::read_dir(folder).ok()?.flatten();
    let sources = entries.filter(|entry| entry.file_name() != "node_modules");
    let times = sources.map(|entry| match entry.path() {
        path if path.is_dir() => changed(&path),
        path => fs::metadata(path).and_then(|file| file.modified()).ok(),
    });
    times.max().flatten()
}
