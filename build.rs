//! Two things that the program carries inside itself: the library's source, and the C header of its functions.
//!
//! Without the exporter (a build of the library alone) there is nothing to do.

fn main() {
    #[cfg(feature = "exporter")]
    exporter::prepare();
}

#[cfg(feature = "exporter")]
mod exporter {
    use std::fmt::Write;
    use std::path::{Path, PathBuf};
    use std::{env, fs};

    /// The file with the exported functions.
    const INTERFACE: &str = "src/fmi2/exports.rs";

    /// The exporter's own files, and the one that it writes anew for every scene.
    const NOT_EMBEDDED: [&str; 2] = ["src/bin", "src/scene/exported.rs"];

    pub fn prepare() {
        let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
        let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
        println!("cargo::rerun-if-changed=src");
        println!("cargo::rerun-if-changed=build.rs");
        write_header(&root, &out.join("brinell.h"));
        write_sources(&root, &out.join("library_source.rs"));
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
    fn write_sources(root: &Path, list: &Path) {
        let mut files = Vec::new();
        collect(&root.join("src"), root, &mut files);
        files.sort();
        let mut text = String::from("pub const LIBRARY_SOURCE: &[(&str, &str)] = &[\n");
        for (name, path) in files {
            writeln!(text, "    ({name:?}, include_str!({path:?})),").expect("a String takes everything");
        }
        text.push_str("];\n");
        fs::write(list, text).expect("OUT_DIR can be written");
    }

    fn collect(folder: &Path, root: &Path, files: &mut Vec<(String, PathBuf)>) {
        for entry in fs::read_dir(folder).expect("src is readable") {
            let path = entry.expect("src is readable").path();
            let inside = path.strip_prefix(root).expect("below the root");
            let name = inside.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/");
            if NOT_EMBEDDED.contains(&name.as_str()) {
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
