//! The library of an FMU: input and arguments of the compiler.

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

/// Options of every compilation: no unwinding, and optimization of all code as one unit.
const SETTINGS: [&str; 4] = ["-Cpanic=abort", "-Ccodegen-units=1", "-Cdebuginfo=0", "--cap-lints=allow"];

/// Options of `libm`: the output of its build script for these features. It is compiled to bitcode only, since it is
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

/// Options of the library.
const LIBRARY: [&str; 6] = [
    "--crate-name=unit",
    "--crate-type=cdylib",
    "--edition=2024",
    "--cfg=feature=\"fmu\"",
    "--cfg=feature=\"c-interface\"",
    "-Clto=fat",
];

/// Additional options of prebuilt libraries. LLVM does not promise to keep its own options; a prebuilt library is compiled by a
/// compiler that is known, an FMU by any. Without these optimizations, which copy code or keep values in more registers, a
/// compressed library is 1 % smaller.
const PREBUILT: [&str; 4] = [
    "--cfg=feature=\"prebuilt\"",
    "-Cllvm-args=--disable-machine-licm",
    "-Cllvm-args=--enable-pre=false",
    "-Cllvm-args=--inline-threshold=60",
];

/// Another one for arm64 Linux: code in the order of the source compresses better by 2 %. For macOS, which has another model of
/// its processors, it doesn't.
const IN_ORDER_OF_SOURCE: &str = "-Cllvm-args=--enable-misched=false";

/// Number of contacts from which the loops are optimized for speed instead of size.
const MANY_CONTACTS: usize = 16;

/// Optimized for size: the few lines of a plain step are the same at any level. With many contacts: loops that
/// process several contacts at once.
fn optimization(source: &Source) -> &'static str {
    match source {
        Source::Scene { plan, .. } if plan.scene.contact_count() >= MANY_CONTACTS => "-Copt-level=3",
        _ => "-Copt-level=s",
    }
}

/// The source file that differs between libraries.
pub enum Source<'a> {
    /// The constants of a scene.
    Scene { plan: &'a Plan<'a>, constants: &'a str },
    /// The kind of a prebuilt library.
    Kind { text: &'a str },
}

impl Source<'_> {
    /// Path and text of the file.
    fn file(&self) -> (&'static str, &str) {
        match self {
            Source::Scene { constants, .. } => ("src/scene/exported.rs", constants),
            Source::Kind { text } => ("src/scene/kind.rs", text),
        }
    }

    /// Name of the library during the build.
    fn name(&self) -> &str {
        match self {
            Source::Scene { plan, .. } => &plan.scene.name,
            Source::Kind { .. } => "prebuilt",
        }
    }

    /// Whether it imports nothing from its process.
    fn is_standalone(&self) -> bool {
        matches!(self, Source::Scene { plan, .. } if plan.scene.standalone)
    }

    /// Additional arguments of the compiler.
    fn arguments(&self, target: &Target) -> Vec<&'static str> {
        match self {
            Source::Scene { .. } => Vec::new(),
            Source::Kind { .. } if target.triple.starts_with("aarch64-unknown-linux") => {
                [PREBUILT.as_slice(), &[IN_ORDER_OF_SOURCE]].concat()
            }
            Source::Kind { .. } => PREBUILT.to_vec(),
        }
    }
}

/// The functions that copy and compare bytes, for a system without a reliable C library, as one object file for the
/// linker.
const BYTES: [&str; 6] =
    ["--crate-name=bytes", "--crate-type=lib", "--edition=2024", "--emit=obj", "-Copt-level=s", "-o"];

/// Arguments for a library that imports nothing from its process, besides [`BYTES`].
const STANDALONE: &str = "--cfg=feature=\"standalone\"";

/// The root of the crate of [`BYTES`]. Without `no_builtins` the compiler would replace the functions with calls of
/// themselves.
const BYTES_ROOT: (&str, &str) =
    ("bytes.rs", "#![no_std]\n#![no_builtins]\n#[path = \"src/fmi2/bytes.rs\"]\nmod bytes;\n");

/// The module of that crate.
const BYTES_SOURCE: (&str, &str) = ("src/fmi2/bytes.rs", include_str!("../../../fmi2/bytes.rs"));

/// Compiles libraries. Shared parts are compiled once.
pub struct Builder {
    cache: Cache,
    compilers: Compilers,
    folder: Folder,
    /// Number of libraries started so far.
    count: AtomicUsize,
}

impl Builder {
    /// Finds the compilers, and creates a build folder.
    ///
    /// # Errors
    /// [`ExportError`]
    pub fn new() -> Result<Builder, ExportError> {
        let cache = Cache::open()?;
        let compilers = Compilers::find(&cache.folder);
        let folder = cache.build_folder()?;
        Ok(Builder { cache, compilers, folder, count: AtomicUsize::new(0) })
    }

    /// Checks that there is a compiler for each target.
    ///
    /// # Errors
    /// [`ExportError`] of the first target without a compiler.
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
        // removed here, since many libraries would take much space
        let _ = fs::remove_dir_all(&folder);
        library
    }
}

/// Compiles the libraries of `platforms` with `source` and returns their bytes. Parts shared by two platforms are
/// compiled once; several targets are compiled in parallel.
///
/// # Errors
/// [`ExportError`]
pub fn build(source: &Source, platforms: &[Platform]) -> Result<Vec<Vec<u8>>, ExportError> {
    let targets = platform::targets(platforms);
    let builder = Builder::new()?;
    // report a missing compiler before anything is compiled
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
        let compressed = matches!(source, Source::Kind { .. });
        let arguments = optimized
            .iter()
            .chain(&LIBRARY)
            .chain(standalone)
            .copied()
            .chain(source.arguments(target))
            .map(String::from);
        let arguments = arguments.chain(link::arguments(target, linker, &library, &objects, compressed)).chain(named);
        rustc.run(folder, arguments, &link::variables(target, folder))?;
        let library = folder.join(library);
        Ok(fs::read(&library).map_err(FileError::at(&library))?)
    }

    /// Puts `file` into the folder: from the cache, otherwise compiled from `sources` with these `arguments` and
    /// added to the cache.
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
        // atomic; harmless on a file system without links, and if another export was faster
        let _ = fs::hard_link(&here, &known);
        Ok(())
    }

    /// Writes files to the folder.
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

/// The error of a file in the cache; for a full disk it names the folder.
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

    /// The output of `command`.
    fn printed(command: &mut Command) -> String {
        let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("UTF-8")
    }

    /// A new version of `libm` may need other options.
    #[test]
    fn libm_is_compiled_as_its_own_build_script_says() {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.current_dir(env!("CARGO_MANIFEST_DIR")).args(["metadata", "--format-version=1", "--locked", "--offline"]);
        // the dependencies of other systems are not downloaded
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
