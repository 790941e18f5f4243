//! Generates the C header, and the list of the sources that the program embeds: those of the library and of `libm`, which
//! together make up an FMU.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    #[cfg(feature = "exporter")]
    exporter::prepare();
}

#[cfg(feature = "exporter")]
mod exporter {
    use serde_json::Value;
    use std::env;
    use std::fmt::Write;
    use std::fs;
    use std::path::{Path, PathBuf};
    use std::process::Command;

    /// The file with the exported functions.
    const INTERFACE: &str = "src/fmi2/exports.rs";

    /// The exporter's own files, and the file that it generates for every prebuilt library.
    const NOT_EMBEDDED: [&str; 2] = ["src/bin", "src/scene/kind.rs"];

    pub fn prepare() {
        let folder = |variable: &str| PathBuf::from(env::var_os(variable).expect("cargo sets it"));
        let (root, out) = (folder("CARGO_MANIFEST_DIR"), folder("OUT_DIR"));
        println!("cargo::rerun-if-changed=src");
        println!("cargo::rerun-if-changed=Cargo.lock");
        write_header(&root, &out.join("brinell.h"));
        let mut text = sources("LIBRARY_SOURCE", &root, "");
        text.push_str(&sources("LIBM_SOURCE", &libm(&root, &out.join("libm")), "libm/"));
        fs::write(out.join("library_source.rs"), text).expect("OUT_DIR can be written");
    }

    /// The folder of the `libm` of `Cargo.lock`: in cargo's registry, or among vendored sources. It is found through a package
    /// that depends on `libm` only. Nothing has to be downloaded, because this program itself needs `libm`.
    fn libm(root: &Path, folder: &Path) -> PathBuf {
        let lock = fs::read_to_string(root.join("Cargo.lock")).expect("Cargo.lock stands beside build.rs");
        let entry = lock.split("[[package]]").find(|entry| entry.contains("\nname = \"libm\"\n"));
        let entry = entry.expect("the library needs libm").trim();
        let version =
            entry.lines().find_map(|line| line.strip_prefix("version = ")).expect("every package has a version");
        let package = "[package]\nname = \"where\"\nversion = \"0.0.0\"\nedition = \"2024\"\n[workspace]\n";
        let manifest = format!("{package}[dependencies.libm]\nversion = {}\n", version.replacen('"', "\"=", 1));
        let locked = "[[package]]\nname = \"where\"\nversion = \"0.0.0\"\ndependencies = [\"libm\"]\n";
        fs::create_dir_all(folder.join("src")).expect("OUT_DIR can be written");
        let files = [
            ("Cargo.toml", manifest),
            ("Cargo.lock", format!("version = 4\n\n[[package]]\n{entry}\n\n{locked}")),
            ("src/lib.rs", String::new()),
        ];
        for (name, text) in files {
            fs::write(folder.join(name), text).expect("OUT_DIR can be written");
        }
        // if the program was installed without its lock file, it may have been compiled with a newer libm; the locked one is
        // then downloaded
        let found = metadata(root, folder, &["--offline"]).or_else(|_| metadata(root, folder, &[]));
        found.unwrap_or_else(|error| panic!("cargo doesn't say where libm {version} is:\n{error}"))
    }

    /// The folder of `libm` according to `cargo metadata` for the package in `folder`.
    fn metadata(root: &Path, folder: &Path, more: &[&str]) -> Result<PathBuf, String> {
        let mut cargo = Command::new(env::var_os("CARGO").expect("cargo sets it"));
        cargo.args(["metadata", "--format-version=1", "--locked"]).args(more);
        // cargo settings in folders above the project also apply
        let output = cargo.arg("--manifest-path").arg(folder.join("Cargo.toml")).current_dir(root).output();
        let output = output.map_err(|error| error.to_string())?;
        if !output.status.success() {
            return Err(String::from_utf8_lossy(&output.stderr).into_owned());
        }
        let metadata: Value = serde_json::from_slice(&output.stdout).map_err(|error| error.to_string())?;
        let packages = metadata["packages"].as_array().ok_or("no list of packages")?;
        let libm = packages.iter().find(|package| package["name"] == "libm").ok_or("no libm among the packages")?;
        let manifest = Path::new(libm["manifest_path"].as_str().ok_or("libm has no manifest")?);
        Ok(manifest.parent().ok_or("libm has no folder")?.into())
    }

    /// The prototypes of the functions. A C program that includes the standard's header and then this one compiles only if
    /// every signature agrees; `tests/importing/abi.rs` checks this.
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

    /// A constant of this `name` with the path (after `prefix`) and the text of every file of the library in `root`.
    fn sources(name: &str, root: &Path, prefix: &str) -> String {
        let mut files = Vec::new();
        collect(&root.join("src"), root, &mut files);
        files.sort();
        let mut text = format!("pub const {name}: &[(&str, &str)] = &[\n");
        for (name, path) in files {
            writeln!(text, "    ({:?}, include_str!({path:?})),", format!("{prefix}{name}"))
                .expect("a String takes everything");
        }
        text.push_str("];\n");
        text
    }

    fn collect(folder: &Path, root: &Path, files: &mut Vec<(String, PathBuf)>) {
        for entry in fs::read_dir(folder).expect("sources are readable") {
            let path = entry.expect("sources are readable").path();
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
