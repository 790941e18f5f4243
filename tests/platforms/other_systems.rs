//! FMUs on Windows, arm64 Linux and macOS, as far as they are available: for every law, the same history gives the
//! same bits as on this system. docs/platforms.md has the results.
//!
//! The libraries are the prebuilt ones that `brinell prebuild` makes with the toolchain of BRINELL_TOOLCHAIN. Wine, QEMU, a C
//! compiler for all systems and an emulator for macOS are unpacked in the target folder (350 MB to download). Systems that
//! are not available are skipped with a message.
#![cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]

use crate::unpacked::Unpacked;
use brinell_testing::courses;
use brinell_testing::kinds;
use brinell_testing::prebuilt;
use brinell_testing::skips::skipped;
use brinell_testing::systems::{self, System};
use brinell_testing::toolchain;
use std::io::{Write, stderr};

/// Runs FMUs of these scenes on each available system.
fn assert_same_bits(scenes: &[(&str, String)], systems: Vec<(&str, Result<System, String>)>) {
    let Some(store) = toolchain::store("all") else { return };
    let fmus = scenes
        .iter()
        .map(|(name, text)| (name, Unpacked::of(text, |folder| prebuilt::without_compiler(folder, &store), &[])));
    let fmus: Vec<_> = fmus.collect();
    let mut wrong = Vec::new();
    for (name, system) in systems {
        match system {
            Err(why) => skipped(name, &why),
            Ok(System { platform, name: system, host }) => {
                for (scene, fmu) in &fmus {
                    let found = fmu.difference(&host, &fmu.library(platform));
                    wrong.extend(found.map(|why| format!("{scene} on {system}: {why}")));
                }
                let (count, steps) = (fmus.len(), fmus[0].1.here().bits.lines().count());
                let _ = writeln!(stderr(), "{name} ({system}): {count} FMUs, {steps} steps");
            }
        }
    }
    assert!(wrong.is_empty(), "{} wrong: {wrong:#?}", wrong.len());
}

#[test]
#[ignore = "350 MB to download: cargo test --release --test platforms other_systems -- --ignored --nocapture"]
fn every_kind_and_law_gives_the_same_bits_on_windows_and_on_arm64() {
    let systems = vec![("Linux on arm64", systems::arm64_linux()), ("Windows", systems::windows())];
    assert_same_bits(&[kinds::of_each_kind(), kinds::of_every_law()].concat(), systems);
}

/// The emulation is a thousand times slower than the processor: for each law, it runs the library with all outputs.
#[test]
#[ignore = "350 MB to download: cargo test --release --test platforms other_systems -- --ignored --nocapture"]
fn every_law_gives_the_same_bits_in_the_code_for_macos() {
    let systems = vec![("macOS, x86-64", systems::macos("x86_64")), ("macOS, arm64", systems::macos("arm64"))];
    assert_same_bits(&kinds::of_every_law(), systems);
}

/// fmpy on Linux starts the library through a Windows program, which runs in wine.
#[test]
#[ignore = "350 MB to download: cargo test --release --test platforms other_systems -- --ignored --nocapture"]
fn fmpy_gets_the_same_bits_from_windows() {
    let Some(store) = toolchain::store("all") else { return };
    let system = match systems::windows() {
        Ok(system) => system,
        Err(why) => return skipped("fmpy through wine", &why),
    };
    let (scene, history) = (&kinds::of_each_kind()[3].1, courses::history());
    let export =
        |arguments: &[&str]| Unpacked::of(scene, |folder| prebuilt::without_compiler(folder, &store), arguments);
    let fmu = export(&[]);
    let expected = systems::by_fmpy(&fmu.file(), &history, None).unwrap_or_else(|why| panic!("{why}"));
    assert!(expected.lines().count() > 400, "{} lines", expected.lines().count());
    // fmpy uses the other system only if there is no library for its own
    let for_windows = export(&["--platforms", "win64"]);
    let found = systems::by_fmpy(&for_windows.file(), &history, Some(("win64", &system.host)));
    assert!(found.unwrap_or_else(|why| panic!("{why}")) == expected, "other bits");
}
