//! The whole way of a user without a compiler: an empty Python environment, the wheel, exports of all scenes for every machine and
//! as C source, and their FMUs on Linux, Windows and arm64 Linux and from their source.
//!
//! packaging/release.py makes the wheel of the program under test, with the prebuilt libraries of `brinell prebuild` and the toolchain
//! of BRINELL_TOOLCHAIN.
#![cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]

use crate::unpacked::Unpacked;
use brinell_testing::command::{contents, empty_folder, output, scene};
use brinell_testing::courses;
use brinell_testing::hosts::Host;
use brinell_testing::python;
use brinell_testing::skips;
use brinell_testing::systems;
use brinell_testing::toolchain;
use std::fs;
use std::io::{Write, stderr};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// The wheel.
fn wheel(folder: &Path) -> Option<PathBuf> {
    let mut release = Command::new("python3");
    release.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("packaging/release.py"));
    release.args(["--program", env!("CARGO_BIN_EXE_brinell"), "--prebuilt"]).arg(toolchain::store("all,c-code")?);
    release.arg("--scratch").arg(python::target_folder().join("packaging")).arg("-o").arg(folder.join("dist"));
    output(release.env("PYTHONDONTWRITEBYTECODE", "1")).with_status(0);
    let names = contents(&folder.join("dist"));
    let name = names.into_iter().find(|name| name.ends_with(".whl")).expect("a wheel");
    Some(folder.join("dist").join(name))
}

/// The folders of an FMU for every system, and C source.
const PLATFORMS: [&str; 5] = ["aarch64-linux", "c-code", "darwin64", "linux64", "win64"];

/// Every scene of the repository, by the program of a wheel alone, for every system and as C source.
#[test]
#[ignore = "350 MB to download: cargo test --release --test platforms first_export -- --ignored --nocapture"]
fn a_wheel_in_an_empty_environment_makes_fmus_that_run_on_every_system_here() {
    let folder = empty_folder();
    let folder = folder.path();
    let Some(wheel) = wheel(folder) else { return };
    let environment = folder.join("environment");
    output(Command::new("python3").args(["-m", "venv"]).arg(&environment)).with_status(0);
    let mut pip = Command::new(environment.join("bin/python"));
    output(pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps"]).arg(&wheel))
        .with_status(0);
    let others = [("aarch64-linux", systems::arm64_linux()), ("win64", systems::windows())];
    let mut scenes = contents(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes"));
    scenes.retain(|name| name.ends_with(".toml"));
    assert!(scenes.len() > 10, "{scenes:?}");
    for name in scenes.iter().map(|name| name.trim_end_matches(".toml")) {
        // nothing of a compiler, and nothing of the environment of this test
        let program = |unpacked: &Path| {
            let mut program = Command::new(environment.join("bin/brinell"));
            program.env_clear().env("PATH", folder.join("nothing")).env("HOME", folder).current_dir(unpacked);
            program
        };
        let text = fs::read_to_string(scene(name)).expect("a scene of the project");
        let start = Instant::now();
        let fmu = Unpacked::of(&text, program, &["--platforms", &PLATFORMS.join(",")]);
        assert_eq!(fmu.platforms, PLATFORMS, "{name}: darwin64 is for two processors");
        let (size, seconds) = (fs::metadata(fmu.file()).expect("an FMU").len(), start.elapsed().as_secs_f64());
        let _ = writeln!(stderr(), "{name}: {size} bytes, exported and unpacked in {seconds:.2} s");
        let compiled = fmu.path().join("compiled.so");
        let headers = format!("-I{}", python::site_packages_file("fmpy/c-code").display());
        let options = ["-O1", "-shared", "-fPIC", "-DFMI2_OVERRIDE_FUNCTION_PREFIX", &headers, "-o"];
        output(Command::new("gcc").args(options).args([&compiled, &fmu.source()])).with_status(0);
        assert_eq!(fmu.difference(&Host::ordinary(), &compiled), None, "{name} from C source");
        for (platform, system) in &others {
            match system {
                Err(why) => skips::skipped(platform, why),
                Ok(system) => {
                    let found = fmu.difference(&system.host, &fmu.library(platform));
                    assert_eq!(found, None, "{name} on {}", system.name);
                }
            }
        }
        if name == "steel_ball" {
            let by_fmpy =
                systems::by_fmpy(&fmu.file(), &courses::history(), None).unwrap_or_else(|why| panic!("fmpy: {why}"));
            assert!(by_fmpy.lines().count() > 400, "{} lines", by_fmpy.lines().count());
        }
    }
}
