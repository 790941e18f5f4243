//! The parts that libraries share: the crates that the crate of an FMU uses, and functions that copy bytes. Each is compiled once
//! for a compiler, a target and its options, and is then in the cache.

use super::error::ExportError;
use super::folder::Cache;
use super::rustc::Rustc;
use crate::files::FileError;
use crate::sources::{CONTACT_SOURCE, FMU_SOURCE, LIBM_SOURCE, UNIT_SOURCE};
use brinell_exporter::package::Hash;
use brinell_exporter::platform::Target;
use std::path::Path;
use std::{fs, io};

/// Options of every compilation: no unwinding, and optimization of all code as one unit.
const SETTINGS: [&str; 4] = ["-Cpanic=abort", "-Ccodegen-units=1", "-Cdebuginfo=0", "--cap-lints=allow"];

/// An option of crates that are compiled to bitcode only: the crate of an FMU is optimized together with them.
const BITCODE: &str = "-Clinker-plugin-lto";

/// A crate that the crate of an FMU uses.
struct Crate {
    file: &'static str,
    root: &'static str,
    options: &'static [&'static str],
    source: &'static [(&'static str, &'static str)],
}

/// These crates; each uses those before it.
const CRATES: [Crate; 3] = [
    Crate { file: "liblibm.rlib", root: "libm/src/lib.rs", options: &LIBM, source: LIBM_SOURCE },
    Crate {
        file: "libbrinell_contact.rlib",
        root: "contact/src/lib.rs",
        options: &["--crate-name=brinell_contact", "--crate-type=rlib", "--edition=2024", "--extern=libm=liblibm.rlib"],
        source: CONTACT_SOURCE,
    },
    Crate {
        file: "libbrinell_fmu.rlib",
        root: "fmu/src/lib.rs",
        options: &[
            "--crate-name=brinell_fmu",
            "--crate-type=rlib",
            "--edition=2024",
            "--extern=brinell_contact=libbrinell_contact.rlib",
            DEPENDENCIES,
        ],
        source: FMU_SOURCE,
    },
];

/// The folder of the crates that others use.
const DEPENDENCIES: &str = "-Ldependency=.";

/// Options of `libm`: the output of its build script for these features.
pub const LIBM: [&str; 6] = [
    "--crate-name=libm",
    "--crate-type=rlib",
    "--edition=2021",
    "--cfg=feature=\"arch\"",
    "--cfg=arch_enabled",
    "--cfg=optimizations_enabled",
];

/// An option of the functions of an FMU that imports nothing from its process.
const STANDALONE: &str = "--cfg=feature=\"standalone\"";

/// The functions that copy and compare bytes, for a system without a reliable C library, as one object file for the
/// linker.
const BYTES: [&str; 6] =
    ["--crate-name=bytes", "--crate-type=lib", "--edition=2024", "--emit=obj", "-Copt-level=s", "-o"];

/// The root of the crate of [`BYTES`]. Without `no_builtins` the compiler would replace the functions with calls of
/// themselves.
const BYTES_ROOT: (&str, &str) =
    ("bytes.rs", "#![no_std]\n#![no_builtins]\n#[path = \"fmu/src/c/bytes.rs\"]\nmod bytes;\n");

/// The module of that crate.
const BYTES_SOURCE: &str = "fmu/src/c/bytes.rs";

/// The parts of one library for one target.
pub struct Parts<'a> {
    pub cache: &'a Cache,
    /// The folder in which the library is built.
    pub folder: &'a Path,
    pub rustc: &'a Rustc,
    pub target: &'a Target,
}

impl Parts<'_> {
    /// The root of the crate of an FMU.
    pub const UNIT_ROOT: &'static str = "unit/src/lib.rs";

    /// The files of that crate; that of its scene is only an example.
    pub const UNIT: &'static [(&'static str, &'static str)] = UNIT_SOURCE;

    /// The arguments with which that crate finds those that it uses.
    pub const USED: [&'static str; 2] = ["--extern=brinell_fmu=libbrinell_fmu.rlib", DEPENDENCIES];

    /// The options of every compilation for the target.
    pub fn settings(&self) -> Vec<&'static str> {
        [SETTINGS.as_slice(), &["--target", self.target.triple]].concat()
    }

    /// Creates the folder.
    ///
    /// # Errors
    /// [`ExportError`]
    pub fn create(&self) -> Result<(), ExportError> {
        let made = fs::create_dir_all(self.folder).map_err(FileError::at(self.folder));
        made.map_err(|error| self.no_space(error))
    }

    /// Puts the crates that an FMU uses into the folder, compiled with these options.
    ///
    /// # Errors
    /// [`ExportError`]
    pub fn make_crates(&self, optimization: &str, standalone: bool) -> Result<(), ExportError> {
        let mut sources = Vec::new();
        for Crate { file, root, options, source } in CRATES {
            let memory = (standalone && file == "libbrinell_fmu.rlib").then_some(STANDALONE);
            let arguments = [&[optimization, BITCODE], options, memory.as_slice(), &[root, "-o", file]].concat();
            // with another version of a crate that it uses it would not fit
            sources.extend(source);
            self.make(file, &arguments, &sources)?;
        }
        Ok(())
    }

    /// The file of the functions that copy and compare bytes.
    pub const BYTES_OBJECT: &'static str = "bytes.obj";

    /// Puts the functions that copy and compare bytes into the folder.
    ///
    /// # Errors
    /// [`ExportError`]
    pub fn make_bytes(&self) -> Result<(), ExportError> {
        let file = Parts::BYTES_OBJECT;
        let source = FMU_SOURCE.iter().find(|(name, _)| *name == BYTES_SOURCE).expect("the crate has this file");
        self.make(file, &[BYTES.as_slice(), &[file, BYTES_ROOT.0]].concat(), &[BYTES_ROOT, *source])
    }

    /// Puts `file` into the folder: from the cache, otherwise compiled from `sources` with these `arguments` and
    /// added to the cache.
    fn make(&self, file: &str, arguments: &[&str], sources: &[(&str, &str)]) -> Result<(), ExportError> {
        let Parts { cache, folder, rustc, .. } = self;
        let arguments = [self.settings().as_slice(), arguments].concat();
        let made_from = [rustc.identity.as_str()].into_iter().chain(arguments.iter().copied());
        let made_from = made_from.chain(sources.iter().flat_map(|(name, text)| [*name, *text]));
        let (name, ending) = file.split_at(file.find('.').unwrap_or(file.len()));
        let name = format!("{name}-{}", Hash::default().with_all(made_from).digits());
        let here = folder.join(file);
        if let Some((known, _)) = cache.part(&name, ending) {
            let copied = fs::hard_link(&known, &here).or_else(|_| fs::copy(&known, &here).map(drop));
            return copied.map_err(FileError::at(&known)).map_err(|error| self.no_space(error));
        }
        self.write(sources.iter().copied())?;
        // one crate refers to another by a hash of all that it holds, so the name of the folder must not be in it
        let anywhere = format!("--remap-path-prefix={}=.", folder.display());
        rustc.run(folder, arguments.into_iter().chain([anywhere.as_str()]), &[])?;
        if let Ok(bytes) = fs::read(&here) {
            cache.keep(&here, &bytes, &name, ending);
        }
        Ok(())
    }

    /// Writes files to the folder.
    ///
    /// # Errors
    /// [`ExportError`]
    pub fn write<'b, T: AsRef<[u8]>>(&self, files: impl Iterator<Item = (&'b str, T)>) -> Result<(), ExportError> {
        for (name, text) in files {
            let path = self.folder.join(name);
            let parent = path.parent().unwrap_or(self.folder);
            let written = fs::create_dir_all(parent).and_then(|()| fs::write(&path, text));
            written.map_err(FileError::at(&path)).map_err(|error| self.no_space(error))?;
        }
        Ok(())
    }

    /// The error of a file in the cache; for a full disk it names the folder.
    fn no_space(&self, error: FileError) -> ExportError {
        match error.source.kind() {
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded | io::ErrorKind::FileTooLarge => {
                ExportError::NoSpace { folder: self.cache.folder.clone(), said: error.source.to_string() }
            }
            _ => error.into(),
        }
    }
}
