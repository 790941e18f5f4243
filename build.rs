//! Generates the sources that the program embeds: those of the crates of an FMU, and of `libm`. All of it is compiled before the program,
//! so it takes no other crate.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    #[cfg(feature = "exporter")]
    exporter::prepare();
}

#[cfg(feature = "exporter")]
mod exporter {
    use std::collections::BTreeMap;
    use std::env;
    use std::fmt::Write;
    use std::fs;
    use std::path::{Path, PathBuf};
    use std::process::Command;

    /// The crates of an FMU.
    const CRATES: [&str; 3] = ["contact", "fmu", "unit"];

    pub fn prepare() {
        println!("cargo::rerun-if-changed=Cargo.lock");
        let (root, out) = (folder("CARGO_MANIFEST_DIR"), folder("OUT_DIR"));
        let mut text = String::new();
        for name in CRATES {
            text.push_str(&list(name, &sources(name)));
        }
        text.push_str(&list("libm", &libm(&root, &out.join("libm")).join("src")));
        fs::write(out.join("sources.rs"), text).expect("OUT_DIR can be written");
    }

    fn folder(variable: &str) -> PathBuf {
        PathBuf::from(env::var_os(variable).expect("cargo sets it"))
    }

    /// The folder of the sources of a crate, which its build script tells.
    fn sources(name: &str) -> PathBuf {
        folder(&format!("DEP_BRINELL_{}_SOURCES", name.to_uppercase()))
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
        let json = String::from_utf8_lossy(&output.stdout).into_owned();
        let manifests = json.split("\"manifest_path\":\"").skip(1).map(|rest| PathBuf::from(string(rest)));
        let mut folders = manifests.filter_map(|manifest| manifest.parent().map(Path::to_path_buf));
        folders.find(|found| is_libm(found)).ok_or_else(|| format!("no libm in {json}"))
    }

    fn is_libm(folder: &Path) -> bool {
        fs::read_to_string(folder.join("Cargo.toml")).is_ok_and(|text| text.contains("\nname = \"libm\"\n"))
    }

    /// A string of JSON, from behind its first quote.
    fn string(json: &str) -> String {
        let mut text = String::new();
        let mut characters = json.chars();
        while let Some(character) = characters.next() {
            match character {
                '"' => break,
                '\\' => text.extend(characters.next()),
                other => text.push(other),
            }
        }
        text
    }

    /// A constant with the path, in a folder of the name of the crate, and the text of every file of its sources.
    fn list(name: &str, folder: &Path) -> String {
        let mut files = BTreeMap::new();
        collect(folder, &format!("{name}/src"), &mut files);
        let mut text = format!("pub const {}_SOURCE: &[(&str, &str)] = &[\n", name.to_uppercase());
        for (name, path) in files {
            writeln!(text, "    ({name:?}, include_str!({path:?})),").expect("a String takes everything");
        }
        text.push_str("];\n");
        text
    }

    fn collect(folder: &Path, name: &str, files: &mut BTreeMap<String, PathBuf>) {
        println!("cargo::rerun-if-changed={}", folder.display());
        for entry in fs::read_dir(folder).expect("sources are readable") {
            let path = entry.expect("sources are readable").path();
            let name = format!("{name}/{}", path.file_name().expect("an entry has a name").to_string_lossy());
            if path.is_dir() {
                collect(&path, &name, files);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.insert(name, path);
            }
        }
    }
}
