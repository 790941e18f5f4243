//! The conformance suite and the random calls, run on any library.

use super::child;
use crate::places::{profile, root};
use crate::toolchain::test_programs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;
use tempfile::TempDir;

/// The test programs.
pub struct Suites {
    conformance: PathBuf,
    fuzz: PathBuf,
    scratch: TempDir,
}

/// A library to test.
pub struct Subject<'a> {
    pub library: &'a Path,
    /// The place of the library whose model description applies.
    pub place: &'a Path,
    /// Variables of the environment.
    pub environment: &'a [(&'a str, String)],
    pub limit: Duration,
}

impl Suites {
    /// The programs in the profile of this one.
    pub fn build() -> Suites {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.current_dir(root()).args(["test", "--profile", profile(), "--test", "conformance", "--test", "fuzz"]);
        let programs = test_programs(&mut cargo);
        let program = |name: &str| {
            let found = programs.iter().find(|program| program.name == name);
            found.unwrap_or_else(|| panic!("no program {name}")).file.clone()
        };
        let scratch = tempfile::tempdir().expect("a folder for temporary files");
        Suites { conformance: program("conformance"), fuzz: program("fuzz"), scratch }
    }

    fn run(&self, mut command: Command, subject: &Subject) -> Result<(), String> {
        command.envs(subject.environment.iter().map(|(name, value)| (name, value)));
        let log = self.scratch.path().join("log");
        child::run(&mut command, &log, subject.limit).map_err(|failure| failure.to_string())
    }

    /// Makes one check of the conformance suite, or all.
    ///
    /// # Errors
    /// What fails.
    pub fn conform(&self, subject: &Subject, check: Option<&str>) -> Result<(), String> {
        let mut command = child::worker(&self.conformance);
        command.env("BRINELL_CONFORMANCE_LIBRARY", subject.library).env("BRINELL_CONFORMANCE_PLACE", subject.place);
        if let Some(check) = check {
            command.env("BRINELL_CONFORMANCE_CHECK", check);
        }
        self.run(command, subject)
    }

    /// Makes the calls of the first `count` random scripts.
    ///
    /// # Errors
    /// What fails.
    pub fn fuzz(&self, subject: &Subject, count: u64) -> Result<(), String> {
        let mut command = child::worker(&self.fuzz);
        command.env("BRINELL_FUZZ_LIBRARY", subject.library).env("BRINELL_FUZZ_PLACE", subject.place);
        command.env("BRINELL_FUZZ_FIRST", "1").env("BRINELL_FUZZ_COUNT", count.to_string());
        command.env("BRINELL_FUZZ_PROGRESS", self.scratch.path().join("progress"));
        self.run(command, subject)
    }
}
