//! FMUs in other tools: the drivers in tests/importers/, each in its own process.
//!
//! Every tool runs the same history of rates, whose forces must be those of the C interface. A co-simulation tool also runs a
//! ball that hits the block, whose restitution must be the predicted one. The result is a table, including tools that did not
//! run and the reason. A usual run takes one of another make than fmpy, `BRINELL_LONG=1` those that are light, and
//! `BRINELL_IMPORTERS=all` the larger ones too (two gigabytes). `BRINELL_IMPORTER_PYTHON` names an interpreter with tools that no registry
//! provides, `BRINELL_WRITE=1` writes the table to docs/importers.md.
#![cfg(target_os = "linux")]

use brinell_testing::command;
use brinell_testing::fmi_crate;
use brinell_testing::importer_table::{self, Row, Table};
use brinell_testing::loaded::{OK, Unit};
use brinell_testing::long;
use brinell_testing::places::temporary;
use brinell_testing::python;
use brinell_testing::skips;
use brinell_testing::unit;
use serde_json::Value;
use std::collections::BTreeSet;
use std::env;
use std::f64::consts::TAU;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// The source of the interpreter of a driver.
enum Interpreter {
    /// The environment of all tests.
    Common,
    /// A virtual environment with the packages of that and those of this requirements file. Some platforms have no package of
    /// the tool, whose module this is.
    Beside { requirements: &'static str, module: &'static str, large: bool },
    /// A virtual environment with this requirements file only, because it wants other versions.
    Own { requirements: &'static str },
    /// The interpreter in `BRINELL_IMPORTER_PYTHON` with this Python package, if no registry provides an installable one.
    Given { package: &'static str, since: &'static str },
}

use Interpreter::{Beside, Common, Given, Own};

struct Driver {
    name: &'static str,
    interpreter: Interpreter,
}

impl Interpreter {
    /// Whether it is tested only with `BRINELL_IMPORTERS=all`.
    fn is_large(&self) -> bool {
        matches!(self, Beside { large: true, .. } | Own { .. })
    }
}

const fn light(module: &'static str) -> Interpreter {
    Beside { requirements: "light", module, large: false }
}

const fn more(module: &'static str) -> Interpreter {
    Beside { requirements: "more", module, large: true }
}

const DRIVERS: [Driver; 11] = [
    Driver { name: "fmpy", interpreter: Common },
    Driver { name: "libcosim", interpreter: light("libcosimpy") },
    Driver { name: "ecos", interpreter: light("ecospy") },
    Driver { name: "fmuloader", interpreter: light("fmuloader") },
    Driver { name: "container", interpreter: more("fmu_manipulation_toolbox") },
    Driver { name: "pathsim", interpreter: more("pathsim_fmi") },
    Driver { name: "cofmupy", interpreter: Own { requirements: "cofmupy" } },
    Driver { name: "gemseo", interpreter: Own { requirements: "gemseo" } },
    Driver {
        name: "fmipp",
        interpreter: Given {
            package: "fmipp",
            since: "PyPI has its source only, which needs SWIG, Boost and SUNDIALS 3.1.2 (Debian 12 has 6.4.1)",
        },
    },
    Driver {
        name: "pyfmi",
        interpreter: Given {
            package: "pyfmi",
            since: "PyPI has the source of version 2.5 only, which needs FMI Library and Assimulo; the current one is on conda-forge",
        },
    },
    Driver {
        name: "omsimulator",
        interpreter: Given {
            package: "OMSimulator",
            since: "its package on PyPI has no binary and downloads one from build.openmodelica.org when it is installed",
        },
    },
];

/// Those of a usual run.
const USUAL: [&str; 1] = ["libcosim"];

/// Tools without a driver.
const NOT_RUN: [(&str, &str); 1] = [("fmi-sim", "not tried: it is the program of the `fmi` crate, which is run")];

/// More time than any driver needs: one that takes longer hangs.
const HANGS: Duration = Duration::from_secs(300);

/// Of the heavy ball, towards the block [m/s^2].
const GRAVITY: f64 = 9.81;

/// Steps of the balls [s], and how many there are of them, as in importers/driver.py.
const BALL_SIZES: [f64; 3] = [1e-6, 1e-4, 2e-3];
const BALL_STEPS: f64 = 100.0;

const STEPS: u32 = 2000;
const STEP: f64 = 1e-6;

/// The closing rate [m/s] of a step: load, unload until separation, and load deeper, five times.
fn rate(index: u32) -> f64 {
    0.06 * (TAU * f64::from(index) / 400.3).sin() + 0.006
}

/// The folder with all files of the drivers. `swapped` gives each kind of importer the FMU for the other kind.
fn folder(name: &str, swapped: bool) -> PathBuf {
    let folder = temporary().join("importers").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let lines: String = (0..STEPS).map(|index| format!("{:?} {STEP:?}\n", rate(index))).collect();
    fs::write(folder.join("history.txt"), lines).unwrap();
    let (serial, parallel) = if swapped { ("parallel", "serial") } else { ("serial", "parallel") };
    // its regime is a Real: some tools read no enumeration
    let text = fs::read_to_string(unit::scene("steel_ball")).unwrap();
    let text = text.replacen("outputs = [", "outputs = [\"regime_number\", ", 1);
    fs::copy(unit::export(&unit::write_scene("steel_ball", &text)), folder.join("contact.fmu")).unwrap();
    fs::copy(unit::export(&ball("serial")), folder.join(serial).with_extension("fmu")).unwrap();
    fs::copy(unit::export(&ball("parallel")), folder.join(parallel).with_extension("fmu")).unwrap();
    pack_mass(&folder, "mass", 0.0);
    pack_mass(&folder, "heavy", GRAVITY);
    // the ball as a system
    let scene = ball(if swapped { "serial" } else { "parallel" }).display().to_string();
    let system = ["ssp", &scene, "-o", "ball.ssp", "--with", "mass.fmu"];
    let connections = ["--connect", "contact.mean_force=mass.force", "--connect", "mass.rate=contact.indentation_rate"];
    command::run(&folder, system.into_iter().chain(connections)).with_status(0);
    folder
}

/// The ball of scenes/mass_known.toml for this kind of importer. It touches the block within the second microsecond.
fn ball(master: &str) -> PathBuf {
    let text = fs::read_to_string(unit::scene("mass_known")).unwrap();
    let text = text.replacen("\"mass_known\"", &format!("\"{master}\""), 1);
    let text = text.replacen("[fmu]\n", "[fmu]\ninitial_gap = 1.3e-6\n", 1);
    unit::write_scene(master, &format!("{text}master = \"{master}\"\ninputs = [\"external_acceleration\"]\n"))
}

/// Compiles c/mass.c with this gravity [m/s^2] and packs it as `NAME.fmu`.
fn pack_mass(folder: &Path, name: &str, gravity: f64) {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let parts = folder.join(name);
    fs::create_dir_all(parts.join("binaries/linux64")).unwrap();
    let text = include_str!("../importers/mass.xml")
        .replace("start=\"0\"/></ScalarVariable>\n  </Model", "start=\"GRAVITY\"/></ScalarVariable>\n  </Model");
    let text = text.replace("{mass}", &format!("{{{name}}}")).replace("GRAVITY", &gravity.to_string());
    fs::write(parts.join("modelDescription.xml"), text).unwrap();
    let mut compiler = Command::new("cc");
    compiler.args(["-shared", "-fPIC", "-O2", "-Wall", "-Wextra", "-Werror", &format!("-DGRAVITY={gravity:?}"), "-o"]);
    compiler.arg(parts.join("binaries/linux64/mass.so")).arg(tests.join("c/mass.c"));
    command::output(&mut compiler).with_status(0);
    let mut zip = Command::new("python3");
    zip.args(["-m", "zipfile", "-c", &format!("../{name}.fmu"), "binaries", "modelDescription.xml"])
        .current_dir(&parts);
    command::output(&mut zip).with_status(0);
}

/// The forces [N] after each step through the C interface; the history must pass through every regime.
fn reference() -> Vec<f64> {
    let unit = Unit::load(&unit::steel_ball_with_regime());
    let mut instance = unit.ready();
    let mut regimes = BTreeSet::new();
    let forces = (0..STEPS).map(|index| {
        instance.set_one("indentation_rate", rate(index));
        assert_eq!(instance.step(f64::from(index) * STEP, STEP), OK);
        regimes.insert(instance.integer("regime"));
        instance.real("force")
    });
    let forces = forces.collect();
    assert_eq!(regimes.into_iter().collect::<Vec<_>>(), [0, 1, 2, 3, 4, 5]);
    forces
}

fn python_of(driver: &Driver) -> Result<PathBuf, String> {
    if driver.name == "ecos" {
        can_unpack()?;
    }
    let name = |requirements| format!("importers-{requirements}");
    let file = |requirements| {
        Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/importers/requirements-{requirements}.txt"))
    };
    let failed = |reason: String| format!("can't be installed: {}", last_line(&reason));
    match driver.interpreter {
        Common => Ok(python::python()),
        Beside { requirements: of, module, .. } => {
            let python = python::environment_beside(&name(of), &file(of), None).map_err(failed)?;
            // not imported: the driver may have to load libraries before
            let found = format!("import importlib.util; assert importlib.util.find_spec('{module}')");
            let output = Command::new(&python).args(["-c", &found]).output().map_err(|error| error.to_string())?;
            output.status.success().then_some(python).ok_or_else(|| format!("can't be installed: there is no {module}"))
        }
        Own { requirements: of } => python::environment_of(&name(of), &file(of)).map_err(failed),
        Given { package, since } => {
            let python = PathBuf::from(env::var_os("BRINELL_IMPORTER_PYTHON").unwrap_or_default());
            let imports = Command::new(&python).args(["-c", &format!("import {package}")]).output();
            let has = imports.is_ok_and(|output| output.status.success());
            has.then_some(python).ok_or_else(|| format!("can't be installed: {since}"))
        }
    }
}

/// Ecos calls a program to unpack FMUs. A small system does not have it.
///
/// # Errors
/// What is missing.
fn can_unpack() -> Result<(), String> {
    let missing =
        |_| "it calls the program `unzip`, which isn't installed (Debian and Ubuntu: apt install unzip)".into();
    Command::new("unzip").arg("-v").stdin(Stdio::null()).output().map(|_| ()).map_err(missing)
}

/// Runs a driver to its end. Its result is in `result`, possibly incomplete.
fn run(driver: &Driver, interpreter: &Path, folder: &Path) -> Result<Value, String> {
    let importers = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/importers");
    let [result, log] = ["json", "log"].map(|ending| folder.join(driver.name).with_extension(ending));
    let written = File::create(&log).unwrap();
    let mut process = python::keeping_modules(&mut Command::new(interpreter))
        .arg(importers.join(format!("with_{}.py", driver.name)))
        .args([folder, &result])
        .stdin(Stdio::null())
        .stdout(written.try_clone().unwrap())
        .stderr(written)
        .spawn()
        .map_err(|error| format!("can't be started: {error}"))?;
    let start = Instant::now();
    let status = loop {
        match process.try_wait().map_err(|error| error.to_string())? {
            Some(status) => break status,
            None if start.elapsed() > HANGS => {
                process.kill().and_then(|()| process.wait()).map_err(|error| error.to_string())?;
                return Err(format!("hangs, see {}", log.display()));
            }
            None => sleep(Duration::from_millis(20)),
        }
    };
    if !status.success() {
        let text = String::from_utf8_lossy(&fs::read(&log).unwrap_or_default()).into_owned();
        return Err(format!("{status}: {}", last_line(&text)));
    }
    result_of(driver, folder)
}

/// The result that a driver has written.
fn result_of(driver: &Driver, folder: &Path) -> Result<Value, String> {
    let text = fs::read_to_string(folder.join(driver.name).with_extension("json"));
    let text = text.map_err(|error| format!("no result: {error}"))?;
    serde_json::from_str(&text).map_err(|error| format!("no result: {error}"))
}

fn last_line(text: &str) -> String {
    text.lines().rfind(|line| !line.trim().is_empty()).unwrap_or_default().to_string()
}

/// The restitution of the ball according to `brinell predict`.
fn predicted() -> f64 {
    let run =
        command::run(command::empty_folder().path(), [Path::new("predict"), &ball("serial"), Path::new("--json")]);
    run.with_status(0).json()["laws"][0]["restitution"].as_f64().expect("a number")
}

/// What is right: the forces of the history [N], the restitution of the ball, and the closing speeds of the heavy one when it has
/// made all its steps [m/s], by an FMU that goes there in one.
struct Right {
    forces: Vec<f64>,
    restitution: f64,
    speeds: [f64; 3],
}

impl Right {
    fn found() -> Right {
        let unit = Unit::load(&ball("serial"));
        let speed = |step: f64| {
            let mut instance = unit.ready();
            instance.set_one("external_acceleration", GRAVITY);
            instance.set_one("indentation_rate", 1.0);
            assert_eq!(instance.step(0.0, BALL_STEPS * step), OK);
            1.0 + BALL_STEPS * step * (GRAVITY - instance.real("mean_force") / 4e-3)
        };
        Right { forces: reference(), restitution: predicted(), speeds: BALL_SIZES.map(speed) }
    }

    fn rows<'a>(&'a self, result: &'a Value) -> impl Iterator<Item = Row> + 'a {
        importer_table::rows(result, &self.forces, self.restitution, &self.speeds)
    }
}

/// The row of the `fmi` crate.
fn fmi_crate(folder: &Path, forces: &[f64]) -> Row {
    let bits = fmi_crate::forces_by_fmi_crate(&folder.join("contact.fmu"), &folder.join("history.txt"));
    let found: Vec<_> = bits.lines().map(|line| f64::from_bits(u64::from_str_radix(line, 16).unwrap())).collect();
    let (_, version) =
        include_str!("../importers/Cargo.toml").split_once("fmi = { version = \"").expect("its requirement");
    let version = version.split('"').next().unwrap_or_default();
    Row {
        agreement: Some(importer_table::difference(&found, forces)),
        ..Row::named("`fmi` crate (Rust)", version, "-")
    }
}

/// Tools that don't show the warnings of an FMU unless they are told to.
const SILENT: [&str; 4] = ["Ecos", "Ecos, SSP 1.0", "FMI++", "PyFMI"];

/// Adds the rows of `driver` to `table`. With the FMUs for the other kind of importer, the ball has a large error, so that the
/// table can fail; and the user of the tool reads why, with its settings as they are.
fn add(table: &mut Table, driver: &Driver, interpreter: &Path, [folder, swapped]: [&Path; 2], right: &Right) {
    let all_rows = |folder| match run(driver, interpreter, folder) {
        Ok(result) => right.rows(&result).collect(),
        Err(reason) => {
            // the results before the crash
            let done = result_of(driver, folder).unwrap_or_default();
            let failed = Row { failure: Some(reason), ..Row::named(driver.name, "", "-") };
            right.rows(&done).chain([failed]).collect::<Vec<_>>()
        }
    };
    let (rows, wrong) = (all_rows(folder), all_rows(swapped));
    assert_eq!(rows.len(), wrong.len(), "{wrong:?}");
    for (mut row, wrong) in rows.into_iter().zip(wrong) {
        assert!(!row.told.contains(&true), "{row:?} is warned of an order that is right");
        if row.failure.is_none() && !row.errors.is_empty() {
            assert!(wrong.errors.iter().any(|error| error.abs() > 0.1), "{wrong:?}");
            assert!(wrong.heavy.is_none_or(|error| error > 0.1), "{wrong:?}");
            let shows = !SILENT.contains(&&*row.name);
            assert!(wrong.told.iter().all(|told| *told == shows), "{wrong:?}");
        }
        row.told = wrong.told;
        table.rows.push(row);
    }
}

#[test]
fn every_importer_gets_the_same_forces_and_every_master_the_predicted_restitution() {
    let (folder, swapped, right) = (folder("right", false), folder("swapped", true), Right::found());
    let mut table = Table::default();
    let all = env::var("BRINELL_IMPORTERS").is_ok_and(|value| value == "all");
    let light = all || long::is_asked();
    if light {
        table.rows.push(fmi_crate(&folder, &right.forces));
    }
    for driver in &DRIVERS {
        if !light && !driver.interpreter.is_large() && !USUAL.contains(&driver.name) {
            table.not_run.push((driver.name.into(), "light; BRINELL_LONG=1 adds it".into()));
            continue;
        }
        if driver.interpreter.is_large() && !all {
            table.not_run.push((driver.name.into(), "large; BRINELL_IMPORTERS=all adds it".into()));
            continue;
        }
        match python_of(driver) {
            Ok(interpreter) => add(&mut table, driver, &interpreter, [&folder, &swapped], &right),
            Err(reason) => table.not_run.push((driver.name.into(), reason)),
        }
    }
    table.not_run.extend(NOT_RUN.map(|(tool, reason)| (tool.to_string(), reason.to_string())));
    table.print();
    table.not_run.iter().for_each(|(tool, reason)| skips::skipped(&format!("the importer {tool}"), reason));
    let wrong = table.wrong();
    assert!(wrong.is_empty(), "{wrong:#?}; logs are in {}", folder.display());
    assert!(table.rows.len() > 1, "no importer could be installed");
    if env::var_os("BRINELL_WRITE").is_some() {
        table.write(&Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/importers.md"));
    }
}
