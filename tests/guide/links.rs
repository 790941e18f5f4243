//! Links and file names.

use crate::markdown::Page;
use crate::{pages, read, root};
use std::path::{Component, Path, PathBuf};

/// `path` without `.` and `..`.
fn normal(path: &Path) -> PathBuf {
    path.components().fold(PathBuf::new(), |mut normal, component| {
        match component {
            Component::ParentDir => assert!(normal.pop(), "{} leaves the repository", path.display()),
            Component::CurDir => {}
            other => normal.push(other),
        }
        normal
    })
}

/// The error in the link from `page` to `target`, if any.
fn mistake(page: &Path, target: &str) -> Option<String> {
    if target.starts_with("http://") || target.starts_with("https://") {
        return None;
    }
    let (path, anchor) = target.split_once('#').map_or((target, None), |(path, anchor)| (path, Some(anchor)));
    let file = match path {
        "" => page.to_path_buf(),
        path => normal(&page.parent().expect("a page is in a folder").join(path)),
    };
    if !root().join(&file).exists() {
        return Some(format!("there is no {}", file.display()));
    }
    // the book contains no other files
    if page.starts_with("docs") && !file.starts_with("docs") {
        return Some(format!("{} isn't in the book: name it in `code`", file.display()));
    }
    let anchor = anchor.filter(|_| file.extension().is_some_and(|extension| extension == "md"))?;
    let anchors = Page::parse(&read(&file)).anchors;
    (!anchors.iter().any(|known| known == anchor)).then(|| format!("{} has {anchors:?}", file.display()))
}

#[test]
fn links_lead_to_files_and_headings() {
    let mut mistakes = Vec::new();
    for page in pages() {
        for link in Page::parse(&read(&page)).links {
            let found = mistake(&page, &link);
            mistakes.extend(found.map(|what| format!("{}: {link}: {what}", page.display())));
        }
    }
    assert!(mistakes.is_empty(), "{}", mistakes.join("\n"));
}

#[test]
fn wrong_links_are_found() {
    let page = Path::new("docs/guide/laws.md");
    for wrong in ["nowhere.md", "limits.md#nowhere", "#nowhere", "../../README.md"] {
        assert!(mistake(page, wrong).is_some(), "{wrong}");
    }
    for right in ["limits.md", "limits.md#limits-of-validity", "#energy", "../laws.svg", "https://example.org/#x"] {
        assert_eq!(mistake(page, right), None, "{right}");
    }
}

/// Folders whose files are named in the text.
const FOLDERS: [&str; 10] =
    ["benches/", "crates/", "data/", "docs/", "examples/", "modelDescription/", "python/", "scenes/", "src/", "tests/"];

#[test]
fn files_that_are_named_exist() {
    let mut missing = Vec::new();
    for page in pages() {
        // the changelog also names files that no longer exist
        if page.ends_with("CHANGELOG.md") {
            continue;
        }
        for name in Page::parse(&read(&page)).code {
            // patterns and commands are not names
            let is_name = FOLDERS.iter().any(|folder| name.starts_with(folder)) && !name.contains(['*', ' ', '{']);
            // the page of promises names tests from their folder on
            let is_there =
                [root().to_path_buf(), root().join("tests")].iter().any(|folder| folder.join(&name).exists());
            if is_name && !is_there {
                missing.push(format!("{}: {name}", page.display()));
            }
        }
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

#[test]
fn every_chapter_is_in_the_contents_of_the_book() {
    let summary = Path::new("docs/SUMMARY.md");
    let links = Page::parse(&read(summary)).links;
    let chapters: Vec<_> = links.iter().map(|link| normal(&Path::new("docs").join(link))).collect();
    for page in pages().into_iter().filter(|page| page.starts_with("docs") && page != summary) {
        assert!(chapters.contains(&page), "{} isn't in {}", page.display(), summary.display());
    }
}
