//! The library of a unit: what the compiler is given, and how it is called.

use super::compiler::Compilers;
use super::error::ExportError;
use super::folder::Cache;
use super::link::{self, Linker};
use super::rustc::Rustc;
use super::{Hash, LIBM_SOURCE, LIBRARY_SOURCE, resource, universal};
use crate::files::FileError;
use crate::interrupt::Folder;
use crate::parallel;
use crate::plan::Plan;
use crate::platform::{self, Platform, System, Target};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::{fs, io};

/// How everything is compiled. There is nothing to unwind, and one piece of code is optimized as one.
const SETTINGS: [&str; 4] = ["-Cpanic=abort", "-Ccodegen-units=1", "-Cdebuginfo=0", "--cap-lints=allow"];

/// How `libm` is: what the build script of `libm` says for these features. What is made of it is bitcode alone, since it is
/// optimized together with the library.
const LIBM: [&str; 7] = [
    "--crate-name=libm",
    "--crate-type=rlib",
    "--edition=2021",
    "--cfg=feature=\"arch\"",
    "--cfg=arch_enabled",
    "--cfg=optimizations_enabled",
    "-Clinker-plugin-lto",
];

/// How the library is.
const LIBRARY: [&str; 6] = [
    "--crate-name=unit",
    "--crate-type=cdylib",
    "--edition=2024",
    "--cfg=feature=\"fmu\"",
    "--cfg=feature=\"c-interface\"",
    "-Clto=fat",
];

/// Contacts from which on their loops are worth being fast instead of small.
const MANY_CONTACTS: usize = 16;

/// As small as it can be, since the few lines of a plain step are the same in any case; or, for many contacts, with loops that
/// work on several at once.
fn optimization(source: &Source) -> &'static str {
    match source {
        Source::Scene { plan, .. } if plan.scene.contact_count() >= MANY_CONTACTS => "-Copt-level=3",
        _ => "-Copt-level=s",
    }
}

/// The source file that a library has of its own.
pub enum Source<'a> {
    /// The constants of a scene.
    Scene { plan: &'a Plan<'a>, constants: &'a str },
    /// The kind of a prebuilt library.
    Kind { text: &'a str },
}

impl Source<'_> {
    /// Its path and its text.
    fn file(&self) -> (&'static str, &str) {
        match self {
            Source::Scene { constants, .. } => ("src/scene/exported.rs", constants),
            Source::Kind { text } => ("src/scene/kind.rs", text),
        }
    }

    /// What the library is called while it is made.
    fn name(&self) -> &str {
        match self {
            Source::Scene { plan, .. } => &plan.scene.name,
            Source::Kind { .. } => "prebuilt",
        }
    }

    /// Whether it takes nothing from its process.
    fn is_standalone(&self) -> bool {
        matches!(self, Source::Scene { plan, .. } if plan.scene.standalone)
    }

    /// What else the compiler is told.
    fn arguments(&self) -> &'static [&'static str] {
        match self {
            Source::Scene { .. } => &[],
            Source::Kind { .. } => &["--cfg=feature=\"prebuilt\""],
        }
    }
}

/// The functions that copy and compare bytes, for a system whose C library can't be relied on: one object file for the linker.
const BYTES: [&str; 6] =
    ["--crate-name=bytes", "--crate-type=lib", "--edition=2024", "--emit=obj", "-Copt-level=s", "-o"];

/// What a library that takes nothing from its process is compiled with, beside [`BYTES`].
const STANDALONE: &str = "--cfg=feature=\"standalone\"";

/// The root of the crate of [`BYTES`]. Without `no_builtins` the functions would be made into calls of themselves.
const BYTES_ROOT: (&str, &str) =
    ("bytes.rs", "#![no_std]\n#![no_builtins]\n#[path = \"src/fmi2/bytes.rs\"]\nmod bytes;\n");

/// The module of that crate.
const BYTES_SOURCE: (&str, &str) = ("src/fmi2/bytes.rs", include_str!("../../../fmi2/bytes.rs"));

/// Compiles libraries. What they share is compiled once.
pub struct Builder {
    cache: Cache,
    compilers: Compilers,
    folder: Folder,
    /// How many libraries have been begun.
    count: AtomicUsize,
}

impl Builder {
    /// Looks for compilers, and makes a folder to build in.
    ///
    /// # Errors
    /// [`ExportError`]
    pub fn new() -> Result<Builder, ExportError> {
        let cache = Cache::open()?;
        let compilers = Compilers::find(&cache.folder);
        let folder = cache.build_folder()?;
        Ok(Builder { cache, compilers, folder, count: AtomicUsize::new(0) })
    }

    /// Looks whether there is a compiler for each of the targets.
    ///
    /// # Errors
    /// [`ExportError`] of the first target that there is none for.
    pub fn check(&self, targets: &[&Target]) -> Result<(), ExportError> {
        targets.iter().try_for_each(|target| self.compilers.for_target(target).map(drop))
    }

    /// Compiles the library of `source` for `target`.
    ///
    /// # Errors
    /// [`ExportError`]
    pub fn build(&self, source: &Source, target: &Target) -> Result<Vec<u8>, ExportError> {
        let (rustc, linker) = self.compilers.for_target(target)?;
        let count = self.count.fetch_add(1, Ordering::Relaxed);
        let folder = self.folder.path().join(format!("{}-{count}", target.triple));
        let build = Build { cache: &self.cache, folder: &folder, rustc, linker, target };
        let library = build.run(source);
        // with many libraries it would be much; all goes in the end
        let _ = fs::remove_dir_all(&folder);
        library
    }
}

/// Compiles the libraries of `platforms` with `source` and gives their bytes. What two platforms share is compiled once, and
/// several targets at the same time.
///
/// # Errors
/// [`ExportError`]
pub fn build(source: &Source, platforms: &[Platform]) -> Result<Vec<Vec<u8>>, ExportError> {
    let targets = platform::targets(platforms);
    let builder = Builder::new()?;
    // what is missing is told before anything is compiled
    builder.check(&targets)?;
    let slices = parallel::each(&targets, |target| builder.build(source, target))?;
    let slice = |target: &Target| {
        let at = targets.iter().position(|other| *other == target).expect("every target was built");
        slices[at].as_slice()
    };
    let join = |platform: &Platform| universal::join(&platform.targets.iter().map(slice).collect::<Vec<_>>());
    Ok(platforms.iter().map(join).collect())
}

/// One library for one target.
struct Build<'a> {
    cache: &'a Cache,
    folder: &'a Path,
    rustc: &'a Rustc,
    linker: Linker,
    target: &'a Target,
}

impl Build<'_> {
    fn run(&self, source: &Source) -> Result<Vec<u8>, ExportError> {
        let Build { cache, folder, rustc, linker, target } = self;
        let settings = [SETTINGS.as_slice(), &["--target", target.triple]].concat();
        let optimized = [settings.as_slice(), &[optimization(source)]].concat();
        fs::create_dir_all(folder).map_err(FileError::at(folder)).map_err(|error| no_space(cache, error))?;
        let libm = ["libm/src/lib.rs", "-o", "libm.rlib"];
        self.make("libm.rlib", &[optimized.as_slice(), &LIBM, &libm].concat(), LIBM_SOURCE)?;
        self.write(LIBRARY_SOURCE.iter().copied().chain([source.file()]).chain(link::files()))?;
        let mut objects = Vec::new();
        if target.system == System::Windows || source.is_standalone() {
            let bytes = "bytes.obj";
            self.make(
                bytes,
                &[settings.as_slice(), &BYTES, &[bytes, BYTES_ROOT.0]].concat(),
                &[BYTES_ROOT, BYTES_SOURCE],
            )?;
            objects.push(bytes);
        }
        if target.system == System::Windows {
            let version = "version.res";
            self.write([(version, resource::version(source.name()))].into_iter())?;
            objects.push(version);
        }
        let library = format!("{}.{}", source.name(), target.system.extension());
        let named = ["src/lib.rs", "--extern=libm=libm.rlib", "-o", &library].map(String::from);
        let standalone = source.is_standalone().then_some(&STANDALONE);
        let arguments = optimized
            .iter()
            .chain(&LIBRARY)
            .chain(standalone)
            .chain(source.arguments())
            .map(|argument| (*argument).to_string());
        let arguments = arguments.chain(link::arguments(target, linker, &library, &objects)).chain(named);
        rustc.run(folder, arguments, &link::variables(target, folder))?;
        let library = folder.join(library);
        Ok(fs::read(&library).map_err(FileError::at(&library))?)
    }

    /// Puts `file` into the folder: out of the cache, or else compiled from `sources` with these `arguments` and then put into the
    /// cache.
    fn make(&self, file: &str, arguments: &[&str], sources: &[(&str, &str)]) -> Result<(), ExportError> {
        let Build { cache, folder, rustc, .. } = self;
        let made_from = [rustc.identity.as_str()].into_iter().chain(arguments.iter().copied());
        let made_from = made_from.chain(sources.iter().flat_map(|(name, text)| [*name, *text]));
        let (name, ending) = file.split_once('.').unwrap_or((file, ""));
        let known = cache.folder.join(format!("{name}-{}.{ending}", Hash::new().with_all(made_from).digits()));
        let here = folder.join(file);
        if known.is_file() {
            let copied = fs::hard_link(&known, &here).or_else(|_| fs::copy(&known, &here).map(drop));
            return copied.map_err(FileError::at(&known)).map_err(|error| no_space(cache, error));
        }
        self.write(sources.iter().copied())?;
        rustc.run(folder, arguments, &[])?;
        // whole, or not at all; a file system without links, and another export that was as far, do no harm
        let _ = fs::hard_link(&here, &known);
        Ok(())
    }

    /// Writes files into the folder.
    fn write<'b, T: AsRef<[u8]>>(&self, files: impl Iterator<Item = (&'b str, T)>) -> Result<(), ExportError> {
        for (name, text) in files {
            let path = self.folder.join(name);
            let parent = path.parent().unwrap_or(self.folder);
            let written = fs::create_dir_all(parent).and_then(|()| fs::write(&path, text));
            written.map_err(FileError::at(&path)).map_err(|error| no_space(self.cache, error))?;
        }
        Ok(())
    }
}

/// The error of a file in the cache, with the folder to make room in if that is what is missing.
fn no_space(cache: &Cache, error: FileError) -> ExportError {
    match error.source.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded | io::ErrorKind::FileTooLarge => {
            ExportError::NoSpace { folder: cache.folder.clone(), said: error.source.to_string() }
        }
        _ => error.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::LIBM;
    use serde_json::Value;
    use std::collections::BTreeSet;
    use std::path::Path;
    use std::process::Command;

    /// What `command` prints.
    fn printed(command: &mut Command) -> String {
        let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("UTF-8")
    }

    /// A new version of `libm` may be configured otherwise.
    #[test]
    fn libm_is_compiled_as_its_own_build_script_says() {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.current_dir(env!("CARGO_MANIFEST_DIR")).args(["metadata", "--format-version=1", "--locked", "--offline"]);
        // what other systems need has not been downloaded
        cargo.args(["--filter-platform", crate::platform::here().expect("a known system").targets[0].triple]);
        let metadata: Value = serde_json::from_str(&printed(&mut cargo)).expect("JSON");
        let libm = metadata["packages"].as_array().unwrap().iter().find(|package| package["name"] == "libm").unwrap();
        let folder = Path::new(libm["manifest_path"].as_str().unwrap()).parent().unwrap();
        let new = tempfile::tempdir().unwrap();
        let script = new.path().join("build");
        let mut rustc = Command::new(Path::new(env!("CARGO")).with_file_name("rustc"));
        rustc.args(["--cfg=feature=\"arch\"", "--cap-lints=allow", "--edition=2021"]).arg(folder.join("build.rs"));
        printed(rustc.arg("-o").arg(&script));
        let mut script = Command::new(script);
        script.env("CARGO_MANIFEST_DIR", folder).env("OUT_DIR", new.path()).env("OPT_LEVEL", "s").env("TARGET", "any");
        for name in ["ARCH", "ENV", "OS", "VENDOR"] {
            script.env(format!("CARGO_CFG_TARGET_{name}"), "any");
        }
        let said = printed(script.env("CARGO_FEATURE_ARCH", "1"));
        let said: BTreeSet<_> = said.lines().filter_map(|line| line.strip_prefix("cargo:rustc-cfg=")).collect();
        let ours =
            LIBM.iter().filter_map(|argument| argument.strip_prefix("--cfg=")).filter(|cfg| !cfg.contains("feature"));
        assert_eq!(ours.collect::<BTreeSet<_>>(), said);
        assert!(LIBM.contains(&format!("--edition={}", libm["edition"].as_str().unwrap()).as_str()));
    }
}
