//! Units on Windows, arm64 Linux and macOS, as far as they can be had here: the same bits as on this system, by every law.
//!
//! This downloads 350 MB and takes minutes, so that it runs when it is asked for:
//! `BRINELL_PLATFORMS=all cargo test --release --test other_systems`. With `BRINELL_WRITE=1` docs/platforms.md is written. All that
//! is fetched stays in the target folder.
#![cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]

#[path = "support/courses.rs"]
mod courses;
#[path = "support/debian.rs"]
mod debian;
#[path = "support/digests.rs"]
mod digests;
#[path = "support/hosts.rs"]
mod hosts;
#[path = "platforms/laws.rs"]
mod laws;
#[path = "support/laws_library.rs"]
mod laws_library;
#[path = "support/other_targets.rs"]
mod other_targets;
#[path = "support/physics.rs"]
mod physics;
#[path = "support/platform_table.rs"]
mod platform_table;
#[path = "support/python.rs"]
mod python;
#[path = "support/standalone.rs"]
mod standalone;
#[path = "support/systems.rs"]
mod systems;
#[path = "support/unit.rs"]
mod unit;

use hosts::{Host, Interface, Loading, Said, cc, compile, skipped};
use platform_table::{Row, Table};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};
use systems::System;

/// The scenes that are run: the default, one that knows the mass, one with every output, and all of them standalone.
const SCENES: [&str; 3] = ["steel_ball", "mass_known", "everything"];

/// Histories of each kind for each pairing of laws. An emulator takes a hundred times as long as the processor.
const SEEDS: u64 = 4;

/// Whether the tests of this file were asked for.
fn asked_for() -> bool {
    let asked = env::var("BRINELL_PLATFORMS").is_ok_and(|value| value == "all");
    if !asked {
        skipped("units on other systems", "large; with BRINELL_PLATFORMS=all");
    }
    asked
}

/// Where the compiler for all platforms is, or is put.
fn toolchain() -> PathBuf {
    env::var_os("BRINELL_TOOLCHAIN").map_or_else(|| python::target_folder().join("toolchain"), PathBuf::from)
}

/// Runs the program, which must succeed.
#[track_caller]
fn brinell<'a>(arguments: impl IntoIterator<Item = &'a str>) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_brinell"));
    command.args(arguments).env("BRINELL_TOOLCHAIN", toolchain());
    command.env("BRINELL_CACHE", Path::new(env!("CARGO_TARGET_TMPDIR")).join("cache"));
    let output = command.output().expect("cargo has built the program");
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// A unit for all platforms, unpacked.
struct Unit {
    name: String,
    folder: PathBuf,
    interface: Interface,
    /// What the program says of the libraries.
    libraries: serde_json::Value,
    size: usize,
    expected: Said,
}

impl Unit {
    /// Exports `scene` for `platforms`, and runs it on this system.
    fn of(scene: &Path, platforms: &str, host: &Host) -> Unit {
        let name = scene.file_stem().expect("a scene has a name").to_string_lossy().into_owned();
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("all_platforms").join(format!("{name}-{platforms}"));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("the target folder can be written to");
        let file = folder.with_extension("fmu");
        let text = |path: &Path| path.to_str().expect("plain characters").to_string();
        let said = brinell(["export", &text(scene), "--platforms", platforms, "-o", &text(&file), "--json"]);
        let said: serde_json::Value = serde_json::from_str(&said).expect("JSON");
        let mut unzip = Command::new("python3");
        assert!(
            unzip.args(["-m", "zipfile", "-e"]).args([&file, &folder]).status().is_ok_and(|status| status.success())
        );
        let description = fs::read_to_string(folder.join("modelDescription.xml")).expect("just unpacked");
        let interface = Interface::of(&description);
        let library = library(&folder, "linux64");
        let expected =
            host.run(&library, &interface, &courses::history()).unwrap_or_else(|why| panic!("{name}: {why}"));
        courses::assert_rich(&expected.bits);
        let size = said["size"].as_u64().expect("a number") as usize;
        Unit { name, folder, interface, libraries: said["libraries"].clone(), size, expected }
    }
}

/// The one file in the folder of `platform`.
fn library(folder: &Path, platform: &str) -> PathBuf {
    let folder = folder.join("binaries").join(platform);
    let mut files = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    files.next().expect("a library").expect("a readable folder").path()
}

/// Runs the units on `system`; what is wrong.
fn run_units(system: &System, units: &[Unit]) -> Result<String, String> {
    for unit in units {
        let library = library(&unit.folder, system.platform);
        let said = system.units.run(&library, &unit.interface, &courses::history());
        let said = said.map_err(|why| format!("{}: {why}", unit.name))?;
        if said.bits != unit.expected.bits {
            return Err(format!("{}: other bits", unit.name));
        }
        if (said.memory, &said.message) != (unit.expected.memory, &unit.expected.message) {
            return Err(format!("{}: {said:?}", unit.name).chars().take(300).collect());
        }
    }
    let steps = units[0].expected.bits.lines().count();
    Ok(format!("same bits: {} units, {steps} steps", units.len()))
}

/// Runs the laws on `system`, compiled for the target `triple`.
fn run_laws(system: &System, triple: &str) -> Result<String, String> {
    let library = other_targets::of(&toolchain(), triple).build()?;
    let cases = digests::cases(SEEDS);
    let (found, _) = digests::by(&system.laws, &library, &cases)?;
    digests::assert_same(&cases, &found, &system.name);
    Ok(format!("same bits: {} histories", cases.len()))
}

#[test]
fn units_and_laws_give_the_same_bits_on_every_platform() {
    if !asked_for() {
        return;
    }
    brinell(["toolchain"]);
    let ordinary =
        compile("ordinary", "host.c", Loading::BySystem, &cc(), &["-ldl"]).unwrap_or_else(|why| panic!("{why}"));
    let ordinary = Host::program(ordinary);
    let scenes = SCENES.map(unit::scene).into_iter().chain(SCENES.map(|name| standalone::scene(&unit::scene(name))));
    let units: Vec<_> = scenes.map(|scene| Unit::of(&scene, "all", &ordinary)).collect();
    let systems = [
        ("aarch64-unknown-linux-gnu", systems::arm64_linux()),
        ("x86_64-pc-windows-msvc", systems::windows()),
        ("x86_64-apple-darwin", systems::macos("darwin64", "x86_64")),
        ("aarch64-apple-darwin", systems::macos("darwin64", "arm64")),
        ("aarch64-apple-darwin", systems::macos("aarch64-darwin", "arm64")),
    ];
    let mut table = Table::of(&units[0].libraries, units[0].size);
    for (triple, system) in systems {
        let system = match system {
            Ok(system) => system,
            Err(why) => {
                table.missing(triple, &why);
                continue;
            }
        };
        let results = [run_units(&system, &units), run_laws(&system, triple)];
        table.rows.push(Row { platform: system.platform, tested_by: system.name, results });
    }
    table.print();
    assert!(table.wrong().is_empty(), "{:#?}", table.wrong());
    assert!(table.is_complete(), "not every system could be had");
    if env::var_os("BRINELL_WRITE").is_some() {
        let compiler =
            Command::new(toolchain().join("usr/bin/rustc")).arg("--version").output().expect("it has compiled");
        table.write(&String::from_utf8_lossy(&compiler.stdout));
    }
}

/// fmpy on Linux starts the library by a program for Windows, and wine runs that.
#[test]
fn fmpy_gets_the_same_bits_from_windows() {
    if !asked_for() {
        return;
    }
    brinell(["toolchain"]);
    let system = match systems::windows() {
        Ok(system) => system,
        Err(why) => return skipped("fmpy through wine", &why),
    };
    for name in SCENES {
        let scene = unit::scene(name);
        let (here, there) = (export_for(&scene, "linux64"), export_for(&scene, "win64"));
        let history = courses::history();
        let expected = systems::by_fmpy(&here, &history, None).unwrap_or_else(|why| panic!("{name}: {why}"));
        assert!(expected.lines().count() > 400, "{name}: {} lines", expected.lines().count());
        let found = systems::by_fmpy(&there, &history, Some(("win64", &system.units)));
        let found = found.unwrap_or_else(|why| panic!("{name}: {why}"));
        assert!(found == expected, "{name}: other bits");
    }
}

/// The unit of `scene` for one platform.
fn export_for(scene: &Path, platform: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("one_platform").join(platform);
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    let file = folder.join(scene.file_stem().expect("a name")).with_extension("fmu");
    let text = |path: &Path| path.to_str().expect("plain characters").to_string();
    brinell(["export", &text(scene), "--platforms", platform, "-o", &text(&file)]);
    file
}
