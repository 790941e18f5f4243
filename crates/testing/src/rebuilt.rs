//! Libraries of FMUs that are built from a copy of the sources: with a change in them, or for another purpose than use.

use super::unit;
use crate::command::settled;
use crate::places::{program, root, temporary};
use crate::toolchain::{TestProgram, test_programs};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A copy of what an FMU is compiled from, with its own target folder.
pub struct Sources {
    folder: PathBuf,
    target: PathBuf,
}

/// A way to build the library.
#[derive(Clone, Copy, Default)]
pub struct Way<'a> {
    /// A toolchain, such as `+nightly`; the one of the tests if empty.
    pub toolchain: &'a str,
    /// Settings of the profile, beside those of an export.
    pub profile: &'a [&'a str],
    /// Flags of the compiler for this platform alone.
    pub flags: &'a str,
    /// Objects that are linked with the library.
    pub objects: &'a [&'a Path],
    /// Whether it is a prebuilt library.
    pub prebuilt: bool,
}

/// The platform of the tests, for cargo.
#[cfg(target_arch = "x86_64")]
pub const TRIPLE: &str = "x86_64-unknown-linux-gnu";
#[cfg(target_arch = "aarch64")]
pub const TRIPLE: &str = "aarch64-unknown-linux-gnu";

/// The settings of an export.
const PROFILE: [&str; 4] = ["opt-level='s'", "lto='fat'", "codegen-units=1", "panic='abort'"];

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("the target folder can be written to");
    for entry in fs::read_dir(from).expect("a readable folder") {
        let path = entry.expect("a readable folder").path();
        let goal = to.join(path.file_name().expect("an entry has a name"));
        match path.is_dir() {
            true => copy(&path, &goal),
            false => fs::copy(&path, goal).map(drop).expect("the target folder can be written to"),
        }
    }
}

impl Sources {
    /// A copy in the folder `name` of the target folder; what is compiled there is kept for the next time.
    pub fn copied(name: &str) -> Sources {
        let root = root();
        let all = temporary().join(name);
        let sources = Sources { folder: all.join("source"), target: all.join("target") };
        let _ = fs::remove_dir_all(&sources.folder);
        for part in ["crates", "modelDescription"] {
            copy(&root.join(part), &sources.folder.join(part));
        }
        for part in ["Cargo.toml", "Cargo.lock"] {
            fs::copy(root.join(part), sources.folder.join(part)).expect("the target folder can be written to");
        }
        for part in ["src", "build.rs", "benches", "examples", "tests", "docs", "scenes", "data", "LICENSE"] {
            std::os::unix::fs::symlink(root.join(part), sources.folder.join(part)).expect("the folder is new");
        }
        sources
    }

    /// Makes the library that of `scene`, with the GUID of its FMU; the place of the FMU's own library.
    pub fn use_scene(&self, scene: &Path) -> PathBuf {
        let place = unit::library(&unit::compiled(scene));
        let root = place.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
        let description = fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library");
        let guid = description.split(" guid=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a GUID");
        let mut program = Command::new(program());
        let output =
            settled(&mut program).arg("constants").arg(scene).arg(guid).output().expect("cargo has built the program");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let constants = String::from_utf8(output.stdout).expect("UTF-8");
        self.write("crates/unit/src/exported.rs", &constants);
        place
    }

    /// Makes the library a prebuilt one by the source file of its kind.
    pub fn use_kind(&self, text: &str) {
        self.write("crates/unit/src/kind.rs", text);
    }

    /// The text of `file`.
    pub fn read(&self, file: &str) -> String {
        fs::read_to_string(self.folder.join(file)).expect("it was copied")
    }

    /// Writes `text` into `file`.
    pub fn write(&self, file: &str, text: &str) {
        let path = self.folder.join(file);
        // an unchanged file isn't compiled again
        if fs::read_to_string(&path).is_ok_and(|old| old == text) {
            return;
        }
        fs::write(path, text).expect("the target folder can be written to");
    }

    /// What `build` makes of the sources with `new` in place of the only `old` in `file`.
    ///
    /// # Errors
    /// If `old` isn't there exactly once, or what `build` says.
    pub fn changed<T>(
        &self,
        (file, old, new): (&str, &str, &str),
        build: impl FnOnce() -> Result<T, String>,
    ) -> Result<T, String> {
        let text = self.read(file);
        let count = text.matches(old).count();
        if count != 1 {
            return Err(format!("{file} has this text {count} times, not once:\n{old}"));
        }
        self.write(file, &text.replacen(old, new, 1));
        let made = build();
        self.write(file, &text);
        made
    }

    /// cargo in the copy, without settings of the tests.
    fn cargo(&self, toolchain: &str) -> Command {
        // with a toolchain, rustup's cargo
        let mut cargo = Command::new(if toolchain.is_empty() { env!("CARGO") } else { "cargo" });
        cargo.args((!toolchain.is_empty()).then_some(toolchain)).current_dir(&self.folder);
        cargo.env("CARGO_TARGET_DIR", &self.target);
        for variable in ["CARGO_ENCODED_RUSTFLAGS", "RUSTFLAGS", "RUSTUP_TOOLCHAIN", "RUSTC", "CARGO"] {
            cargo.env_remove(variable);
        }
        // rustup's rustc would follow the file of a toolchain that a crate may have in its folder
        let rustc = Path::new(env!("CARGO")).with_file_name("rustc");
        if toolchain.is_empty() && rustc.is_file() {
            cargo.env("RUSTC", rustc);
        }
        cargo
    }

    /// Builds the library and copies it to the file `name` beside the sources.
    ///
    /// # Errors
    /// The messages of the compiler.
    pub fn library(&self, name: &str, way: &Way) -> Result<PathBuf, String> {
        let mut cargo = self.cargo(way.toolchain);
        cargo.args(["rustc", "--release", "--package", "brinell-unit", "--locked", "--features"]);
        cargo.arg(if way.prebuilt { "cdylib,prebuilt" } else { "cdylib" });
        for setting in PROFILE.iter().chain(way.profile) {
            cargo.arg("--config").arg(format!("profile.release.{setting}"));
        }
        cargo.args(["--target", TRIPLE]).env("CARGO_ENCODED_RUSTFLAGS", way.flags.replace(' ', "\u{1f}"));
        cargo.args(["--crate-type", "cdylib", "--", "-Clink-arg=-nostartfiles"]);
        if way.flags.is_empty() {
            cargo.arg("-Clink-arg=-nodefaultlibs");
        }
        for object in way.objects {
            cargo.arg(format!("-Clink-arg={}", object.display()));
        }
        let output = cargo.output().map_err(|error| error.to_string())?;
        if !output.status.success() {
            return Err(String::from_utf8_lossy(&output.stderr).into_owned());
        }
        let made = self.target.join(TRIPLE).join("release/libbrinell_unit.so");
        let library = self.target.join(name).with_extension("so");
        fs::copy(&made, &library).map_err(|error| error.to_string())?;
        Ok(library)
    }

    /// The test programs `names`, compiled quickly.
    pub fn test_programs<'a>(&self, names: impl IntoIterator<Item = &'a &'a str>) -> Vec<TestProgram> {
        let mut cargo = self.cargo("");
        cargo.args(["test", "--profile", "quick", "--locked", "--no-default-features"]);
        cargo.args(names.into_iter().flat_map(|name| ["--test", *name]));
        test_programs(&mut cargo)
    }
}
