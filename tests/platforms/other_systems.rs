//! FMUs on Windows, arm64 Linux and macOS, as far as they are available: for every law, the same history gives the
//! same bits as on this system. docs/platforms.md has the results.
//!
//! The libraries are the prebuilt ones that `brinell prebuild` makes with the toolchain of BRINELL_TOOLCHAIN. Wine, QEMU, a C
//! compiler for all systems and an emulator for macOS are unpacked in the target folder (350 MB to download). Systems that
//! are not available are skipped with a message.
#![cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]

use brinell_testing::command;
use brinell_testing::courses;
use brinell_testing::hosts::{Host, Interface, Loading, Said, cc, compile};
use brinell_testing::kinds;
use brinell_testing::places::temporary;
use brinell_testing::prebuilt;
use brinell_testing::skips::skipped;
use brinell_testing::systems::{self, System};
use brinell_testing::toolchain;
use std::fs;
use std::io::{Write, stderr};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The folder of the prebuilt libraries for all platforms; `None` without a toolchain to make them. They are made once.
static STORE: LazyLock<Option<PathBuf>> = LazyLock::new(|| {
    let folder = toolchain::toolchain()?;
    let place = temporary().join("prebuilt").join("all");
    let mut command = command::brinell(temporary());
    command.env("BRINELL_TOOLCHAIN", folder).args(["prebuild", "--platforms", "all", "-o"]).arg(&place);
    command::output(&mut command).with_status(0);
    Some(place)
});

/// An FMU for all platforms, unpacked, and its results in an ordinary program on this system.
struct Fmu {
    name: String,
    file: PathBuf,
    folder: PathBuf,
    interface: Interface,
    expected: Said,
}

impl Fmu {
    fn of(name: &str, text: &str, store: &Path, host: &Host) -> Fmu {
        // tests run at the same time, and two of them may export the same scene
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed).to_string();
        let folder = temporary().join("all_platforms").join(number);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("the target folder can be written to");
        fs::write(folder.join("scene.toml"), text).expect("the target folder can be written to");
        let mut export = prebuilt::without_compiler(&folder, store);
        // for all platforms with libraries
        export.args(["export", "scene.toml", "-o", "unit.fmu"]);
        command::output(&mut export).with_status(0);
        let file = folder.join("unit.fmu");
        let mut unzip = Command::new("python3");
        command::output(unzip.args(["-m", "zipfile", "-e"]).args([&file, &folder])).with_status(0);
        let description = fs::read_to_string(folder.join("modelDescription.xml")).expect("just unpacked");
        let interface = Interface::of(&description);
        let expected = host.run(&library(&folder, "linux64"), &interface, &courses::history());
        let expected = expected.unwrap_or_else(|why| panic!("{name}: {why}"));
        courses::assert_moving(&expected.bits);
        Fmu { name: name.into(), file, folder, interface, expected }
    }
}

/// The only file in the folder of `platform`.
fn library(folder: &Path, platform: &str) -> PathBuf {
    let folder = folder.join("binaries").join(platform);
    let mut files = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    files.next().expect("a library").expect("a readable folder").path()
}

/// FMUs of these scenes with the libraries in `store`.
fn fmus(store: &Path, scenes: &[(&str, String)]) -> Vec<Fmu> {
    let host = compile("ordinary", "host.c", Loading::BySystem, &cc(), &["-ldl"]).unwrap_or_else(|why| panic!("{why}"));
    let host = Host::program(host);
    let fmu =
        |(number, (name, text)): (usize, &(&str, String))| Fmu::of(&format!("{number} {name}"), text, store, &host);
    scenes.iter().enumerate().map(fmu).collect()
}

/// Runs the FMUs on `system`; returns the differences.
fn run(system: &System, fmus: &[Fmu]) -> Vec<String> {
    let wrong = |fmu: &Fmu| {
        let library = library(&fmu.folder, system.platform);
        match system.host.run(&library, &fmu.interface, &courses::history()) {
            Err(why) => Some(format!("{} on {}: {why}", fmu.name, system.name)),
            Ok(said) if said.bits != fmu.expected.bits => Some(format!("{} on {}: other bits", fmu.name, system.name)),
            Ok(said) if said.message != fmu.expected.message => Some(format!("{}: {}", fmu.name, said.message)),
            Ok(_) => None,
        }
    };
    fmus.iter().filter_map(wrong).collect()
}

/// Runs FMUs of these scenes on each available system.
fn assert_same_bits(scenes: &[(&str, String)], systems: Vec<(&str, Result<System, String>)>) {
    let Some(store) = &*STORE else { return };
    let fmus = fmus(store, scenes);
    let mut wrong = Vec::new();
    for (name, system) in systems {
        match system {
            Err(why) => skipped(name, &why),
            Ok(system) => {
                wrong.extend(run(&system, &fmus));
                let (count, steps) = (fmus.len(), fmus[0].expected.bits.lines().count());
                let _ = writeln!(stderr(), "{name} ({}): {count} FMUs, {steps} steps", system.name);
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
    let Some(store) = &*STORE else { return };
    let system = match systems::windows() {
        Ok(system) => system,
        Err(why) => return skipped("fmpy through wine", &why),
    };
    let (scene, history) = (&kinds::of_each_kind()[3].1, courses::history());
    let ordinary = compile("ordinary", "host.c", Loading::BySystem, &cc(), &["-ldl"]).expect("a C compiler");
    let fmu = Fmu::of("by-fmpy", scene, store, &Host::program(ordinary));
    let expected = systems::by_fmpy(&fmu.file, &history, None).unwrap_or_else(|why| panic!("{why}"));
    assert!(expected.lines().count() > 400, "{} lines", expected.lines().count());
    // fmpy uses the other system only if there is no library for its own
    let mut export = prebuilt::without_compiler(&fmu.folder, store);
    export.args(["export", "scene.toml", "-o", "windows.fmu", "--platforms", "win64"]);
    command::output(&mut export).with_status(0);
    let for_windows = fmu.folder.join("windows.fmu");
    let found = systems::by_fmpy(&for_windows, &history, Some(("win64", &system.host)));
    assert!(found.unwrap_or_else(|why| panic!("{why}")) == expected, "other bits");
}
