//! README and guide: links are valid, code runs with the output shown, tables agree with `modelDescription/` and with the laws
//! beside finite elements and measurements, and the book builds (on request).
//!
//! `BRINELL_WRITE=1 cargo test --release --test guide` rewrites tables and outputs instead of comparing them.

mod book;
mod code;
mod comparisons;
mod devices;
mod elsewhere;
mod large_strain;
mod links;
mod markdown;
mod measurements;
mod modules;
mod near_yield;
#[path = "../../src/parallel.rs"]
mod parallel;
mod promises;
mod record;
mod schema;
mod surface;
mod tables;
mod trades;

use brinell_testing::{physics, python, skips};
use std::env;
use std::fs;
use std::path::{Path, PathBuf};

/// The repository.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every Markdown file for readers, as a path in the repository.
fn pages() -> Vec<PathBuf> {
    let own = ["README.md", "CONTRIBUTING.md", "DESIGN.md", "CHANGELOG.md", "python/README.md", "data/truth/README.md"];
    let mut pages: Vec<_> = own.map(PathBuf::from).into();
    collect(Path::new("docs"), &mut pages);
    assert!(pages.len() > own.len() + 20, "the guide is missing: {pages:?}");
    pages
}

fn collect(folder: &Path, pages: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(root().join(folder)).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    for entry in entries.map(|entry| entry.expect("a readable folder")) {
        let path = folder.join(entry.file_name());
        if entry.path().is_dir() {
            collect(&path, pages);
        } else if path.extension().is_some_and(|extension| extension == "md") {
            pages.push(path);
        }
    }
}

/// The text of a page.
fn read(page: &Path) -> String {
    fs::read_to_string(root().join(page)).unwrap_or_else(|error| panic!("{}: {error}", page.display()))
}

/// Whether texts are written instead of compared.
fn is_writing() -> bool {
    env::var_os("BRINELL_WRITE").is_some()
}
