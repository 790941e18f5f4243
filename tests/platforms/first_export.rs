//! The whole way of a user without a compiler: an empty Python environment, the wheel, an export for every machine, and
//! its FMU on Linux, Windows and arm64 Linux.
//!
//! The wheel is that of BRINELL_WHEEL, otherwise packaging/release.py makes one of the program under test. The prebuilt libraries
//! in it are those of BRINELL_PREBUILT, otherwise of `brinell prebuild` with the toolchain of BRINELL_TOOLCHAIN.
#![cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]

use crate::command::{brinell, contents, empty_folder, output, scene};
use crate::courses;
use crate::hosts::{Host, Interface, Loading, cc, compile};
use crate::python;
use crate::skips;
use crate::systems;
use crate::toolchain;
use std::io::{Write, stderr};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;
use std::{env, fs};

/// The path that an environment variable names.
fn named(variable: &str) -> Option<PathBuf> {
    env::var_os(variable).filter(|value| !value.is_empty()).map(Into::into)
}

/// The prebuilt libraries for all platforms; `None` without a toolchain to make them.
fn store(folder: &Path) -> Option<PathBuf> {
    if let Some(store) = named("BRINELL_PREBUILT") {
        return Some(store);
    }
    let toolchain = toolchain::toolchain()?;
    let store = folder.join("store");
    let mut prebuild = brinell(folder);
    prebuild.env("BRINELL_TOOLCHAIN", toolchain).args(["prebuild", "--platforms", "all", "-o"]);
    output(prebuild.arg(&store)).with_status(0);
    Some(store)
}

/// The wheel.
fn wheel(folder: &Path) -> Option<PathBuf> {
    if let Some(wheel) = named("BRINELL_WHEEL") {
        return Some(wheel);
    }
    let mut release = Command::new("python3");
    release.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("packaging/release.py"));
    release.args(["--program", env!("CARGO_BIN_EXE_brinell"), "--prebuilt"]).arg(store(folder)?);
    release.arg("--scratch").arg(python::target_folder().join("packaging")).arg("-o").arg(folder.join("dist"));
    output(release.env("PYTHONDONTWRITEBYTECODE", "1")).with_status(0);
    let names = contents(&folder.join("dist"));
    let name = names.into_iter().find(|name| name.ends_with(".whl")).expect("a wheel");
    Some(folder.join("dist").join(name))
}

#[test]
#[ignore = "350 MB to download: cargo test --release --test platforms first_export -- --ignored --nocapture"]
fn a_wheel_in_an_empty_environment_makes_an_fmu_that_runs_on_every_system_here() {
    let folder = empty_folder();
    let folder = folder.path();
    let Some(wheel) = wheel(folder) else { return };
    let environment = folder.join("environment");
    output(Command::new("python3").args(["-m", "venv"]).arg(&environment)).with_status(0);
    let mut pip = Command::new(environment.join("bin/python"));
    output(pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps"]).arg(&wheel))
        .with_status(0);
    // nothing of a compiler, and nothing of the environment of this test
    let mut export = Command::new(environment.join("bin/brinell"));
    export.env_clear().env("PATH", folder.join("nothing")).env("HOME", folder).current_dir(folder);
    let start = Instant::now();
    let said = output(export.arg("export").arg(scene("steel_ball")).args(["--json", "-o", "unit.fmu"])).with_status(0);
    let seconds = start.elapsed().as_secs_f64();
    let libraries = said.json()["libraries"].as_object().expect("libraries").keys().cloned().collect::<Vec<_>>();
    assert_eq!(libraries, ["aarch64-linux", "darwin64", "linux64", "win64"], "darwin64 is for two processors");
    let fmu = folder.join("unit.fmu");
    let size = fs::metadata(&fmu).expect("an FMU").len();
    let _ = writeln!(stderr(), "{}: {size} bytes in {seconds:.2} s", wheel.display());

    let unpacked = folder.join("unpacked");
    output(Command::new("python3").args(["-m", "zipfile", "-e"]).args([&fmu, &unpacked])).with_status(0);
    let interface = Interface::of(&fs::read_to_string(unpacked.join("modelDescription.xml")).expect("unpacked"));
    let library = |platform: &str, ending: &str| unpacked.join(format!("binaries/{platform}/steel_ball.{ending}"));
    let history = courses::history();
    let ordinary =
        compile("ordinary", "host.c", Loading::BySystem, &cc(), &["-ldl"]).unwrap_or_else(|why| panic!("{why}"));
    let run = |host: &Host, library: &Path| {
        host.run(library, &interface, &history).unwrap_or_else(|why| panic!("{}: {why}", library.display()))
    };
    let expected = run(&Host::program(ordinary), &library("linux64", "so"));
    courses::assert_rich(&expected.bits);
    let by_fmpy = systems::by_fmpy(&fmu, &history, None).unwrap_or_else(|why| panic!("fmpy: {why}"));
    assert!(by_fmpy.lines().count() > 400, "{} lines", by_fmpy.lines().count());
    let others = [("aarch64-linux", "so", systems::arm64_linux()), ("win64", "dll", systems::windows())];
    for (platform, ending, system) in others {
        match system {
            Err(why) => skips::skipped(platform, &why),
            Ok(system) => {
                assert!(
                    run(&system.host, &library(platform, ending)).bits == expected.bits,
                    "{}: other bits",
                    system.name
                );
                let _ = writeln!(stderr(), "{platform} by {}: the same bits as here", system.name);
            }
        }
    }
}
