//! The lists of modules.

use super::root;
use std::fs;
use std::path::Path;

/// A law whose file has no `mod` line would be left out without a word.
#[test]
fn every_source_file_is_a_module() {
    fn check(folder: &Path) {
        let named = |name: &str| folder.join(name);
        let own = ["mod.rs", "lib.rs", "main.rs"].map(named).into_iter().find(|path| path.is_file());
        let parent = folder.with_extension("rs");
        let text = fs::read_to_string(own.unwrap_or(parent)).expect("a folder of sources has a file that lists them");
        for entry in fs::read_dir(folder).expect("sources can be read") {
            let path = entry.expect("sources can be read").path();
            let name = path.file_stem().expect("a file has a name").to_string_lossy().into_owned();
            let is_source = path.extension().is_some_and(|ending| ending == "rs");
            let is_root = ["mod", "lib", "main"].contains(&name.as_str());
            if path.is_dir() {
                check(&path);
            } else if is_source && !is_root {
                assert!(text.contains(&format!("mod {name};")), "{} is in no list of modules", path.display());
            }
        }
    }

    for sources in
        ["src", "crates/contact/src", "crates/fmu/src", "crates/unit/src", "crates/exporter/src", "crates/testing/src"]
    {
        check(&root().join(sources));
    }
}
