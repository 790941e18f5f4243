//! Random calls of the C interface with hostile arguments: no crash, no hang, no NaN, no force without contact, and
//! balanced energies.
//!
//! Each FMU runs its scripts in a separate process. A number determines a script, which is the same on every machine.
//! A failing script is reduced to the necessary calls and printed.
//!
//! `cargo test --release --test fuzz` makes about 100,000 calls. `BRINELL_FUZZ=1e8 cargo test --release --test fuzz`
//! makes 1e8 calls. `BRINELL_FUZZ_SEED` sets the first script.

mod call;
mod run;

use brinell_testing::{arithmetic, child, face, importer, judge, targets, unit};
use call::{Call, script};
use child::Failure;
use face::Face;
use run::Runner;
use std::env;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Duration;
use tempfile::TempDir;

/// Cargo builds the program before these tests; without its feature they do not compile.
const _: &str = env!("CARGO_BIN_EXE_brinell");

/// Number of calls over all FMUs in a usual run.
const CALLS: u64 = 100_000;

/// Number of calls in a script, besides those at its start.
const LENGTH: usize = 80;

/// The longest time for about a thousand calls of a process [s].
const LIMIT: Duration = Duration::from_secs(120);

/// Number of scripts in one process.
const CHUNK: u64 = 2000;

/// The environment variables that control a process.
const LIBRARY: &str = "BRINELL_FUZZ_LIBRARY";
/// The place of another library whose model description applies to this one.
const PLACE: &str = "BRINELL_FUZZ_PLACE";
const FIRST: &str = "BRINELL_FUZZ_FIRST";
const COUNT: &str = "BRINELL_FUZZ_COUNT";
/// The numbers of the calls to make; all, if it isn't set.
const KEPT: &str = "BRINELL_FUZZ_KEPT";
/// The file for the number of the current script.
const PROGRESS: &str = "BRINELL_FUZZ_PROGRESS";

/// A number from an environment variable, such as `1e8`.
fn number(name: &str) -> Option<u64> {
    let text = env::var(name).ok()?;
    let value: f64 = text.parse().unwrap_or_else(|_| panic!("{name}={text} is no number"));
    Some(value as u64)
}

/// The process: runs scripts, and ends with the message of the first failure.
#[test]
#[ignore = "the tests below start it in processes of their own"]
fn worker() {
    let Ok(library) = env::var(LIBRARY) else { return };
    let place = env::var(PLACE).unwrap_or_else(|_| library.clone());
    let face = Face::of(Path::new(&library), Path::new(&place));
    let (first, count) = (number(FIRST).expect("a number"), number(COUNT).expect("a number"));
    let kept: Option<Vec<usize>> =
        env::var(KEPT).ok().map(|text| text.split(',').filter_map(|number| number.parse().ok()).collect());
    let progress = env::var(PROGRESS).expect("a file");
    let mut calls = 0;
    for seed in first..first + count {
        std::fs::write(&progress, seed.to_string()).expect("the target folder can be written to");
        let mut calls_of_it = script(seed, &face, LENGTH);
        if let Some(kept) = &kept {
            calls_of_it = kept.iter().filter_map(|&number| calls_of_it.get(number).cloned()).collect();
        }
        let mut runner = Runner::new(&face);
        let result = runner.run(&calls_of_it);
        calls += runner.calls;
        drop(runner);
        if let Err(wrong) = result {
            panic!("{wrong}");
        }
    }
    std::fs::write(&progress, format!("made {calls}")).expect("the target folder can be written to");
}

/// An FMU under test.
struct Target {
    name: String,
    library: PathBuf,
    /// For the files of its processes.
    scratch: TempDir,
}

impl Target {
    /// Runs `count` scripts starting with `first`; returns the number of calls, or the script that failed.
    fn run(&self, first: u64, count: u64, kept: Option<&[usize]>) -> Result<u64, (u64, Failure)> {
        let progress = self.scratch.path().join("progress");
        let mut command = child::worker(&env::current_exe().expect("a test program"));
        command.env(LIBRARY, &self.library).env(FIRST, first.to_string()).env(COUNT, count.to_string());
        command.env(PROGRESS, &progress);
        if let Some(kept) = kept {
            command.env(KEPT, kept.iter().map(usize::to_string).collect::<Vec<_>>().join(","));
        }
        let result = child::run(&mut command, &self.scratch.path().join("log"), LIMIT);
        let reached = std::fs::read_to_string(&progress).unwrap_or_default();
        match result {
            Ok(()) => {
                Ok(reached.strip_prefix("made ").and_then(|calls| calls.parse().ok()).expect("a number of calls"))
            }
            Err(failure) => Err((reached.parse().unwrap_or(first), failure)),
        }
    }

    /// The numbers of the calls that the script of `seed` needs to fail.
    fn shrink(&self, seed: u64) -> Vec<Call> {
        let face = Face::load(&self.library);
        let whole = script(seed, &face, LENGTH);
        let mut kept: Vec<usize> = (0..whole.len()).collect();
        let mut size = kept.len() / 2;
        while size > 0 {
            let mut begin = 0;
            while begin < kept.len() {
                let end = (begin + size).min(kept.len());
                let fewer: Vec<usize> = kept[..begin].iter().chain(&kept[end..]).copied().collect();
                match self.run(seed, 1, Some(&fewer)) {
                    Err(_) => kept = fewer,
                    Ok(_) => begin = end,
                }
            }
            size /= 2;
        }
        kept.into_iter().map(|number| whole[number].clone()).collect()
    }

    /// Makes about `calls` calls, starting with the script `first`.
    fn fuzz(&self, first: u64, calls: u64) -> u64 {
        let (mut made, mut seed) = (0, first);
        while made < calls {
            // a script makes at least as many calls as its length, except calls without an instance
            let count = ((calls - made) / LENGTH as u64 + 1).min(CHUNK);
            match self.run(seed, count, None) {
                Ok(calls) => made += calls,
                Err((seed, failure)) => {
                    let mut text =
                        format!("{}: the script {seed} fails: {failure}\nits calls that matter:\n", self.name);
                    for call in self.shrink(seed) {
                        let _ = writeln!(text, "    {call:?}");
                    }
                    panic!("{text}");
                }
            }
            seed += count;
        }
        made
    }
}

/// All FMUs: those of the project's own scenes, of additional laws and keys, and of each kind of prebuilt library.
fn targets() -> Vec<Target> {
    // a thousand contacts show no more than two, and take longer
    let scenes = targets::compiled().into_iter().filter(|scene| !scene.ends_with("many_contacts.toml"));
    let compiled = scenes.map(|scene| {
        let name = scene.file_stem().expect("a name").to_string_lossy().into_owned();
        (name, unit::compiled(&scene))
    });
    let target = |(name, fmu): (String, PathBuf)| Target {
        name,
        library: unit::library(&fmu),
        scratch: tempfile::tempdir().expect("a folder for temporary files"),
    };
    compiled.chain(targets::from_prebuilt()).map(target).collect()
}

#[test]
fn no_call_crashes_hangs_or_returns_nan() {
    let targets = targets();
    let calls = number("BRINELL_FUZZ").unwrap_or(CALLS) / targets.len() as u64 + 1;
    let first = number("BRINELL_FUZZ_SEED").unwrap_or(1);
    let mut all = 0;
    for target in &targets {
        let made = target.fuzz(first, calls);
        println!("{}: {made} calls", target.name);
        all += made;
    }
    println!("{all} calls of {} FMUs", targets.len());
}
