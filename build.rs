//! The lists of laws, from the table of laws; and two things that the program carries inside itself: the library's source,
//! and the C header of its functions.

use std::env;
use std::path::PathBuf;

#[path = "build/laws.rs"]
mod laws;

fn main() {
    let folder = |variable: &str| PathBuf::from(env::var_os(variable).expect("cargo sets it"));
    let (root, out) = (folder("CARGO_MANIFEST_DIR"), folder("OUT_DIR"));
    println!("cargo::rerun-if-changed=src");
    println!("cargo::rerun-if-changed=build.rs");
    laws::write(&root, &out);
    #[cfg(feature = "exporter")]
    exporter::prepare(&root, &out);
}

#[cfg(feature = "exporter")]
mod exporter {
    use crate::laws;
    use std::fmt::Write;
    use std::fs;
    use std::path::{Path, PathBuf};

    /// The file with the exported functions.
    const INTERFACE: &str = "src/fmi2/exports.rs";

    /// The exporter's own files, and the one that it writes anew for every scene.
    const NOT_EMBEDDED: [&str; 2] = ["src/bin", "src/scene/exported.rs"];

    pub fn prepare(root: &Path, out: &Path) {
        write_header(root, &out.join("brinell.h"));
        write_sources(root, out);
    }

    /// The prototypes of the 34 functions. A C program that includes the standard's header and then this one compiles
    /// only if every signature agrees; `tests/abi.rs` does that.
    fn write_header(root: &Path, header: &Path) {
        let config = cbindgen::Config {
            language: cbindgen::Language::C,
            style: cbindgen::Style::Type,
            cpp_compat: true,
            no_includes: true,
            usize_is_size_t: true,
            include_guard: Some("BRINELL_H".into()),
            header: Some("/* The functions of an exported unit. Include fmi2FunctionTypes.h before. */".into()),
            export: cbindgen::ExportConfig { item_types: vec![cbindgen::ItemType::Functions], ..Default::default() },
            ..Default::default()
        };
        let builder = cbindgen::Builder::new().with_config(config).with_src(root.join(INTERFACE));
        builder.generate().expect("the interface has a C header").write_to_file(header);
    }

    /// `LIBRARY_SOURCE`: path and text of every file of the library.
    fn write_sources(root: &Path, out: &Path) {
        let mut files = laws::write_for_units(root, out);
        collect(&root.join("src"), root, &mut files);
        files.sort();
        let mut text = String::from("pub const LIBRARY_SOURCE: &[(&str, &str)] = &[\n");
        for (name, path) in files {
            writeln!(text, "    ({name:?}, include_str!({path:?})),").expect("a String takes everything");
        }
        text.push_str("];\n");
        fs::write(out.join("library_source.rs"), text).expect("OUT_DIR can be written");
    }

    fn collect(folder: &Path, root: &Path, files: &mut Vec<(String, PathBuf)>) {
        for entry in fs::read_dir(folder).expect("src is readable") {
            let path = entry.expect("src is readable").path();
            let inside = path.strip_prefix(root).expect("below the root");
            let name = inside.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/");
            let is_there = files.iter().any(|(other, _)| *other == name);
            if is_there || NOT_EMBEDDED.contains(&name.as_str()) || laws::is_left_out_of_units(&name) {
                continue;
            }
            if path.is_dir() {
                collect(&path, root, files);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push((name, path));
            }
        }
    }
}
