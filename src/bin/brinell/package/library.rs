//! The library of an FMU: input and arguments of the compiler.

use super::compiler::Compilers;
use super::error::ExportError;
use super::folder::Cache;
use super::link::{self, Linker};
use super::parts::Parts;
use super::rustc::Rustc;
use super::{resource, universal};
use crate::files::FileError;
use crate::interrupt::Folder;
use crate::parallel;
use crate::plan::Plan;
use crate::platform::{self, Platform, System, Target};
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Options of the crate of an FMU, which is optimized as one unit with the crates that it uses.
const UNIT: [&str; 5] =
    ["--crate-name=unit", "--crate-type=cdylib", "--edition=2024", "--cfg=feature=\"fmu\"", "-Clto=fat"];

/// Additional option of a prebuilt library.
const PREBUILT: &str = "--cfg=feature=\"prebuilt\"";

/// Additional options of all crates of a prebuilt library. LLVM does not promise to keep its own options; a prebuilt library is
/// compiled by a compiler that is known, an FMU by any. Without these optimizations, which copy code or keep values in more
/// registers, a compressed library is 1 % smaller.
const COMPACT: [&str; 3] =
    ["-Cllvm-args=--disable-machine-licm", "-Cllvm-args=--enable-pre=false", "-Cllvm-args=--inline-threshold=60"];

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

    /// Additional options of the compiler for all crates.
    fn options(&self, target: &Target) -> Vec<&'static str> {
        match self {
            Source::Scene { .. } => Vec::new(),
            Source::Kind { .. } if target.triple.starts_with("aarch64-unknown-linux") => {
                [COMPACT.as_slice(), &[IN_ORDER_OF_SOURCE]].concat()
            }
            Source::Kind { .. } => COMPACT.to_vec(),
        }
    }
}

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
        let parts = Parts { cache, folder, rustc, target };
        parts.create()?;
        let options = [&[optimization(source)], source.options(target).as_slice()].concat();
        parts.make_crates(&options, source.is_standalone())?;
        parts.write(Parts::unit_source().chain([source.file()]).chain(link::files()))?;
        let mut objects = Vec::new();
        if target.system == System::Windows || source.is_standalone() {
            objects.push(parts.make_bytes()?);
        }
        if target.system == System::Windows {
            let version = "version.res";
            parts.write([(version, resource::version(source.name()))].into_iter())?;
            objects.push(version);
        }
        let library = format!("{}.{}", source.name(), target.system.extension());
        let prebuilt = matches!(source, Source::Kind { .. });
        let plain = parts.settings().into_iter().chain(options).chain(UNIT);
        let plain = plain.chain(prebuilt.then_some(PREBUILT)).chain(Parts::USED).map(String::from);
        let linked = link::arguments(target, linker, &library, &objects, prebuilt);
        let named = [Parts::UNIT_ROOT, "-o", &library].map(String::from);
        rustc.run(folder, plain.chain(linked).chain(named), &link::variables(target, folder))?;
        let library = folder.join(library);
        Ok(fs::read(&library).map_err(FileError::at(&library))?)
    }
}
