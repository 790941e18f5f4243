//! tests/platforms/laws.rs as a library, compiled for any target as the exporter compiles units: see tests/same_bits.rs.
#![allow(dead_code, reason = "each test file uses what it needs")]

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What compiles for a target, and how that links.
pub struct Target<'a> {
    pub triple: &'a str,
    pub rustc: PathBuf,
    /// The name of the library.
    pub file: &'a str,
    /// Arguments of the compiler.
    pub linking: Vec<String>,
    /// Whether the functions of C that loops are made into must be in the library.
    pub needs_bytes: bool,
    pub variables: Vec<(&'a str, String)>,
}

const SETTINGS: [&str; 5] =
    ["-Copt-level=s", "-Cpanic=abort", "-Ccodegen-units=1", "-Cdebuginfo=0", "--cap-lints=allow"];

/// The root of the project.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The compiler of the cargo that runs the tests.
pub fn own_rustc() -> PathBuf {
    Path::new(env!("CARGO")).with_file_name("rustc")
}

/// How a library for this system is linked.
pub fn here() -> Target<'static> {
    let linking = ["-Clink-arg=-nostartfiles", "-Clink-arg=-nodefaultlibs", "-Clink-arg=-Wl,-z,now,-Bsymbolic"];
    Target {
        triple: "x86_64-unknown-linux-gnu",
        rustc: own_rustc(),
        file: "liblaws.so",
        linking: linking.map(String::from).into(),
        needs_bytes: false,
        variables: Vec::new(),
    }
}

/// The folder of the source of `libm`.
fn libm() -> PathBuf {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(root()).args(["metadata", "--format-version=1", "--locked", "--offline", "--filter-platform"]);
    let output = cargo.arg("x86_64-unknown-linux-gnu").output().expect("cargo runs the tests");
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let libm = metadata["packages"].as_array().expect("packages").iter().find(|package| package["name"] == "libm");
    let manifest = libm.expect("the library needs libm")["manifest_path"].as_str().expect("a path");
    Path::new(manifest).parent().expect("a folder").into()
}

impl Target<'_> {
    fn compile(&self, folder: &Path, arguments: &[&str], more: &[String]) -> Result<(), String> {
        let mut rustc = Command::new(&self.rustc);
        rustc.current_dir(folder).args(SETTINGS).args(["--target", self.triple]).args(arguments).args(more);
        // the build script of the project has written the lists of laws there
        rustc.env("OUT_DIR", env!("OUT_DIR")).env("CARGO_PKG_VERSION", env!("CARGO_PKG_VERSION"));
        let output = rustc.envs(self.variables.iter().map(|(name, value)| (name, value))).output();
        let output = output.map_err(|error| format!("{rustc:?}: {error}"))?;
        match output.status.success() {
            true => Ok(()),
            false => Err(String::from_utf8_lossy(&output.stderr).into_owned()),
        }
    }

    /// The library.
    ///
    /// # Errors
    /// What the compiler says.
    pub fn build(&self) -> Result<PathBuf, String> {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("laws").join(self.triple);
        fs::create_dir_all(&folder).expect("the target folder can be written to");
        let source = |name: &str| root().join(name).display().to_string();
        let libm = libm().join("src/lib.rs").display().to_string();
        let of_libm = ["--crate-name=libm", "--crate-type=rlib", "--edition=2021", "--cfg=feature=\"arch\""];
        let configured = ["--cfg=arch_enabled", "--cfg=optimizations_enabled", "-o", "libm.rlib", &libm];
        self.compile(&folder, &[of_libm.as_slice(), &configured].concat(), &[])?;
        let physics = source("src/lib.rs");
        let of_physics = ["--crate-name=brinell", "--crate-type=rlib", "--edition=2024", "--extern=libm=libm.rlib"];
        self.compile(&folder, &[of_physics.as_slice(), &["-o", "libbrinell.rlib", &physics]].concat(), &[])?;
        let mut linking = self.linking.clone();
        if self.needs_bytes {
            let path = source("src/fmi2/bytes.rs");
            let text = format!("#![no_std]\n#![no_builtins]\n#[path = {path:?}]\nmod bytes;\n");
            fs::write(folder.join("bytes.rs"), text).expect("the target folder can be written to");
            let how = ["--crate-type=lib", "--edition=2024", "--emit=obj", "-o", "bytes.obj", "bytes.rs"];
            self.compile(&folder, &how, &[])?;
            linking.push("-Clink-arg=bytes.obj".into());
        }
        let laws = source("tests/platforms/laws.rs");
        let of_laws =
            ["--crate-name=laws", "--crate-type=cdylib", "--edition=2024", "--extern=brinell=libbrinell.rlib"];
        let where_to = ["-L", ".", "-o", self.file, &laws];
        self.compile(&folder, &[of_laws.as_slice(), &where_to].concat(), &linking)?;
        Ok(folder.join(self.file))
    }
}
