//! Scenes whose FMUs need nothing from their process.

use super::unit;
use std::fs;
use std::path::{Path, PathBuf};

/// A standalone copy of the scene in the file `scene`.
pub fn scene(scene: &Path) -> PathBuf {
    let text = fs::read_to_string(scene).expect("a scene file");
    assert!(text.contains("[fmu]\n"), "{} has a table for the unit", scene.display());
    let text = text.replacen("[fmu]\n", "[fmu]\nstandalone = true\n", 1);
    let folder = scene.file_stem().expect("a scene file has a name").to_str().expect("plain characters");
    unit::write_scene(&format!("standalone_{folder}"), &text)
}

/// Whether the model description of the FMU from which `library` was unpacked declares this.
pub fn is_standalone(library: &Path) -> bool {
    let root = library.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
    let description = fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library");
    description.contains("canNotUseMemoryManagementFunctions=\"false\"")
}
