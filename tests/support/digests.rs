//! Which contacts tests/platforms/laws.rs runs, and what a host says of them.
#![allow(dead_code, reason = "each test file uses what it needs")]

use super::hosts::Host;
use super::laws::{WAYS, elastoplastic, rate_dependent};
use super::physics::belong_together;
use brinell::contact::damped::AnyDamped;
use brinell::contact::loading::AnyLoading;
use brinell::contact::unloading::AnyUnloading;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::path::Path;
use std::process::Command;

/// In place of an unloading law, for a rate-dependent law.
const RATE_DEPENDENT: usize = 1000;

/// More than any unloading law's place, for its guarded form.
const GUARDED: usize = 100;

/// A contact on a history.
pub struct Case {
    pub name: String,
    law: usize,
    unloading: usize,
    way: u32,
    seed: u64,
}

impl Case {
    /// What comes out of it in this program.
    pub fn here(&self) -> u64 {
        let Case { law, unloading, way, seed, .. } = *self;
        match unloading {
            RATE_DEPENDENT => rate_dependent(law, way, seed),
            _ => elastoplastic(law, unloading % GUARDED, unloading >= GUARDED, way, seed),
        }
    }
}

/// Every pairing of laws that makes sense, in its guarded form too, and every rate-dependent law, each on `seeds` histories of
/// each kind.
pub fn cases(seeds: u64) -> Vec<Case> {
    let mut laws = Vec::new();
    for (law, (loading, _)) in AnyLoading::ALL.iter().enumerate() {
        for (unloading, (name, its)) in AnyUnloading::ALL.iter().enumerate() {
            if belong_together(loading, name) {
                laws.push((format!("{loading} with {name}"), law, unloading));
                if its.guarded().is_some() {
                    laws.push((format!("{loading} with {name}, guarded"), law, GUARDED + unloading));
                }
            }
        }
    }
    let damped = AnyDamped::ALL.iter().enumerate();
    laws.extend(damped.map(|(law, (name, _))| (name.to_string(), law, RATE_DEPENDENT)));
    let mut cases = Vec::new();
    for (name, law, unloading) in laws {
        for way in 0..WAYS {
            // no two cases have the same history
            let first = (cases.len() as u64) << 8;
            let all = (0..seeds).map(|seed| Case { name: name.clone(), law, unloading, way, seed: first + seed });
            cases.extend(all);
        }
    }
    cases
}

/// What `host` makes of `cases` by the library of laws.
///
/// # Errors
/// What it says if it fails.
pub fn by(host: &Host, library: &Path, cases: &[Case]) -> Result<(Vec<u64>, String), String> {
    let list = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}-cases.txt", env!("CARGO_CRATE_NAME")));
    let mut text = String::new();
    for Case { law, unloading, way, seed, .. } in cases {
        writeln!(text, "{law} {unloading} {way} {seed}").expect("a String takes everything");
    }
    fs::write(&list, text).expect("the target folder can be written to");
    let mut command = Command::new(&host.command[0]);
    command.args(&host.command[1..]).envs(host.variables.iter().map(|(name, value)| (name, value))).arg(library);
    let output = command.arg("digests").stdin(File::open(&list).expect("just written")).output();
    let output = output.map_err(|error| format!("{command:?}: {error}"))?;
    let said = String::from_utf8_lossy(&output.stdout).replace('\r', "");
    let Some((numbers, name)) = said.split_once("end\n").filter(|_| output.status.success()) else {
        return Err(format!("{}: {said}{}", output.status, String::from_utf8_lossy(&output.stderr)));
    };
    let numbers = numbers.lines().map(|line| u64::from_str_radix(line, 16).map_err(|error| error.to_string()));
    Ok((numbers.collect::<Result<_, _>>()?, name.trim().into()))
}

/// That `found` is what this program finds, case by case.
#[track_caller]
pub fn assert_same(cases: &[Case], found: &[u64], by: &str) {
    assert_eq!(found.len(), cases.len(), "{by}");
    let wrong = cases.iter().zip(found).filter(|(case, found)| case.here() != **found);
    let wrong: Vec<_> = wrong.map(|(case, _)| format!("{}, history {} {}", case.name, case.way, case.seed)).collect();
    assert!(
        wrong.is_empty(),
        "{by}: {} of {} have other bits: {:?}",
        wrong.len(),
        cases.len(),
        &wrong[..wrong.len().min(20)]
    );
}
