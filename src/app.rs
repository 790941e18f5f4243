//! `brinell app`: opens the page of Brinell in the browser.

use crate::files::installed;
use brinell_exporter::layout::{json_line, shown};
use serde_json::json;
use std::env;
use std::path::PathBuf;

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
        "this program was installed without its page: a release has it, `python3 packaging/page.py` makes it from the sources, and {VARIABLE} names it"
    )]
    Missing,
    #[error("{VARIABLE} = {} is no file", shown(.0))]
    NotAFile(PathBuf),
    #[error("no browser opens {}: {source}", shown(path))]
    Unopened { path: PathBuf, source: std::io::Error },
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

/// The page that the user names, or the installed one.
fn page() -> Result<PathBuf, AppError> {
    let Some(named) = env::var_os(VARIABLE).filter(|named| !named.is_empty()) else {
        return installed(PAGE).filter(|path| path.is_file()).ok_or(AppError::Missing);
    };
    let path = PathBuf::from(named);
    if path.is_file() { Ok(path) } else { Err(AppError::NotAFile(path)) }
}
