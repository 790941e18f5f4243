//! The library of an FMU: input and arguments of the compiler.

use super::compiler::Compilers;
use super::error::ExportError;
use super::folder::{Cache, LIBRARY};
use super::link::{self, Linker};
use super::parts::Parts;
use super::rustc::Rustc;
use crate::files::FileError;
use crate::parallel;
use crate::sources;
use crate::temporary::PrivateFolder;
use brinell_exporter::package::{Hash, join, resource};
use brinell_exporter::plan::Plan;
use brinell_exporter::platform::{self, Platform, System, Target};
use brinell_exporter::scene::Scene;
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Options of the crate of an FMU, which is optimized as one unit with the crates that it uses.
const UNIT: [&str; 5] =
    ["--crate-name=unit", "--crate-type=cdylib", "--edition=2024", "--cfg=feature=\"cdylib\"", "-Clto=fat"];

/// Additional option of a prebuilt library.
const PREBUILT: &str = "--cfg=feature=\"prebuilt\"";

/// The ending of a library's name in the cache.
const ENDING: &str = ".bin";

/// The file of the version resource.
const VERSION: &str = "version.res";

/// Number of contacts from which the loops are optimized for speed instead of size.
const MANY_CONTACTS: usize = 16;

/// Whether the steps of the FMU are more than a few lines: loops over many contacts, or the integration of bodies that contacts share,
/// which takes a third of the time at the higher level.
fn is_busy(scene: &Scene) -> bool {
    scene.contact_count() >= MANY_CONTACTS || scene.inverse_masses().is_some()
}

/// Optimized for size: the few lines of a plain step are the same at any level.
fn optimization(source: &Source) -> &'static str {
    match source {
        Source::Scene { plan, .. } if is_busy(plan.scene) => "-Copt-level=3",
        _ => "-Copt-level=s",
    }
}

/// The source file that differs between libraries.
pub enum Source<'a> {
    /// Kind and data of a scene.
    Scene { plan: &'a Plan<'a>, text: &'a str },
    /// The kind of a prebuilt library.
    Kind { text: &'a str },
}

impl Source<'_> {
    /// Path and text of the file.
    fn file(&self) -> (&'static str, &str) {
        match self {
            Source::Scene { text, .. } => ("unit/src/exported.rs", text),
            Source::Kind { text } => ("unit/src/kind.rs", text),
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
}

/// Compiles libraries. Shared parts are compiled once.
pub struct Builder {
    cache: Cache,
    compilers: Compilers,
    folder: PrivateFolder,
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
    let joined = |platform: &Platform| join(&platform.targets.iter().map(slice).collect::<Vec<_>>());
    Ok(platforms.iter().map(joined).collect())
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
        let arguments = self.arguments(source);
        // a prebuilt library is made once, and compared with others
        let known = matches!(source, Source::Scene { .. }).then(|| self.name_in_cache(source, &arguments));
        if let Some((_, library)) = known.as_deref().and_then(|name| self.cache.part(name, ENDING)) {
            return Ok(library);
        }
        self.compile(source, &arguments)?;
        let library = self.folder.join(self.file_name(source));
        let bytes = fs::read(&library).map_err(FileError::at(&library))?;
        if let Some(name) = known {
            self.cache.keep(&library, &bytes, &name, ENDING);
        }
        Ok(bytes)
    }

    fn file_name(&self, source: &Source) -> String {
        format!("{}.{}", source.name(), self.target.system.extension())
    }

    /// The objects that are linked to the crate of the FMU.
    fn objects(&self, source: &Source) -> Vec<&'static str> {
        let windows = self.target.system == System::Windows;
        let alone = windows || source.is_standalone() || self.target.system == System::WebAssembly;
        let bytes = alone.then_some(Parts::BYTES_OBJECT);
        bytes.into_iter().chain(windows.then_some(VERSION)).collect()
    }

    /// The arguments of the compiler for the crate of the FMU.
    fn arguments(&self, source: &Source) -> Vec<String> {
        let Build { folder, rustc, linker, target, cache } = self;
        let parts = Parts { cache, folder, rustc, target };
        let library = self.file_name(source);
        let prebuilt = matches!(source, Source::Kind { .. });
        let plain = parts.settings().into_iter().chain([optimization(source)]).chain(UNIT);
        let plain = plain.chain(prebuilt.then_some(PREBUILT)).chain(Parts::USED).map(String::from);
        let linked = link::arguments(target, linker, &library, &self.objects(source));
        plain.chain(linked).chain([Parts::UNIT_ROOT, "-o", &library].map(String::from)).collect()
    }

    /// The name of the library in the cache, without its ending: a hash of all that it is made of.
    fn name_in_cache(&self, source: &Source, arguments: &[String]) -> String {
        let memory = if source.is_standalone() { "standalone" } else { "" };
        let (file, text) = source.file();
        let all = [self.rustc.identity.as_str(), memory, file, text].into_iter();
        let all = all
            .chain(arguments.iter().map(String::as_str))
            .chain(link::files().into_iter().flat_map(|(name, text)| [name, text]));
        format!("{LIBRARY}{}", Hash::default().with_all(all.chain([sources::hash()])).digits())
    }

    /// Compiles the library in the folder.
    fn compile(&self, source: &Source, arguments: &[String]) -> Result<(), ExportError> {
        let Build { cache, folder, rustc, target, .. } = self;
        let parts = Parts { cache, folder, rustc, target };
        parts.create()?;
        parts.make_crates(optimization(source), source.is_standalone())?;
        parts.write(Parts::UNIT.iter().copied().chain([source.file()]).chain(link::files()))?;
        for object in self.objects(source) {
            match object {
                VERSION => parts.write([(VERSION, resource::version(source.name()))].into_iter())?,
                _ => parts.make_bytes()?,
            }
        }
        rustc.run(folder, arguments, &link::variables(target, folder))
    }
}
