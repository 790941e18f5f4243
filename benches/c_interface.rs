//! What a step costs through the C interface: Brinell's library, the same contact written by hand in C, and a unit
//! without physics, which is the floor of FMI itself.
//!
//! All three are loaded as an importer loads them. Samples are taken in turns, so that whatever else the machine does
//! hits all alike; the table at the end has their medians.

use criterion::{BenchmarkId, Criterion};
use libloading::Library;
use std::ffi::{CStr, CString, c_char, c_int, c_uint, c_void};
use std::fs;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::ptr::{null, null_mut};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// The GUID of the exported unit; the units in C get the same.
static GUID: OnceLock<CString> = OnceLock::new();

const INPUT: c_uint = 0;
const OUTPUT: c_uint = 1;

/// Steps of an impact, half of them closing.
const STEPS: usize = 1000;

/// Size of a step [s].
const STEP: f64 = 1e-6;

/// Largest indentation of the impact [m]: about 200 yield indentations of the ball on steel that the units are.
const PEAK: f64 = 200.0 * 5.9e-8;

/// Impacts in one sample: long enough for the clock, short enough that an interruption spoils few.
const IMPACTS: u64 = 10;

/// Samples of each unit for the table.
const ROUNDS: usize = 2000;

/// Samples of the load time, which needs a file each.
const LOAD_ROUNDS: usize = 200;

type Component = *mut c_void;
type State = *mut c_void;
type Status = c_int;

/// The importer's functions: none of the units needs any.
#[repr(C)]
struct Callbacks {
    functions: [*const c_void; 4],
    environment: *mut c_void,
}

/// Copied function pointers, as an importer has them in a table.
struct Functions {
    instantiate: unsafe extern "C" fn(
        *const c_char,
        c_int,
        *const c_char,
        *const c_char,
        *const Callbacks,
        c_int,
        c_int,
    ) -> Component,
    free: unsafe extern "C" fn(Component),
    setup_experiment: unsafe extern "C" fn(Component, c_int, f64, f64, c_int, f64) -> Status,
    enter_initialization: unsafe extern "C" fn(Component) -> Status,
    exit_initialization: unsafe extern "C" fn(Component) -> Status,
    terminate: unsafe extern "C" fn(Component) -> Status,
    set_real: unsafe extern "C" fn(Component, *const c_uint, usize, *const f64) -> Status,
    get_real: unsafe extern "C" fn(Component, *const c_uint, usize, *mut f64) -> Status,
    do_step: unsafe extern "C" fn(Component, f64, f64, c_int) -> Status,
    get_state: unsafe extern "C" fn(Component, *mut State) -> Status,
    set_state: unsafe extern "C" fn(Component, State) -> Status,
    free_state: unsafe extern "C" fn(Component, *mut State) -> Status,
}

impl Functions {
    fn of(library: &Library) -> Functions {
        /// # Safety
        /// `T` is the type of the function with this name.
        unsafe fn get<T: Copy>(library: &Library, name: &CStr) -> T {
            // SAFETY: as the caller promises.
            unsafe { *library.get(name).unwrap_or_else(|error| panic!("{error}")) }
        }
        // SAFETY: the types are those of the standard.
        unsafe {
            Functions {
                instantiate: get(library, c"fmi2Instantiate"),
                free: get(library, c"fmi2FreeInstance"),
                setup_experiment: get(library, c"fmi2SetupExperiment"),
                enter_initialization: get(library, c"fmi2EnterInitializationMode"),
                exit_initialization: get(library, c"fmi2ExitInitializationMode"),
                terminate: get(library, c"fmi2Terminate"),
                set_real: get(library, c"fmi2SetReal"),
                get_real: get(library, c"fmi2GetReal"),
                do_step: get(library, c"fmi2DoStep"),
                get_state: get(library, c"fmi2GetFMUstate"),
                set_state: get(library, c"fmi2SetFMUstate"),
                free_state: get(library, c"fmi2FreeFMUstate"),
            }
        }
    }
}

/// An initialized instance of a unit.
struct Unit {
    functions: Functions,
    component: Component,
    /// The state after initialization: an untouched surface.
    untouched: State,
    // closed after the instance is freed, hence last
    _library: Library,
}

impl Unit {
    /// What an importer does up to the first step.
    fn load(path: &Path) -> Unit {
        // SAFETY: the libraries built here run no code when they are loaded.
        let library = unsafe { Library::new(path) }.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let functions = Functions::of(&library);
        let callbacks = Callbacks { functions: [null(); 4], environment: null_mut() };
        const CO_SIMULATION: c_int = 1;
        let guid = GUID.get().expect("the unit was exported").as_ptr();
        // SAFETY: strings end with 0, and callbacks are copied by the unit.
        let component =
            unsafe { (functions.instantiate)(c"bench".as_ptr(), CO_SIMULATION, guid, null(), &callbacks, 0, 0) };
        assert!(!component.is_null(), "{}: no instance", path.display());
        // SAFETY: a component of this library, in the order of the standard.
        unsafe {
            ok((functions.setup_experiment)(component, 0, 0.0, 0.0, 0, 0.0));
            ok((functions.enter_initialization)(component));
            ok((functions.exit_initialization)(component));
        }
        Unit { functions, component, untouched: null_mut(), _library: library }
    }

    /// A unit that can be brought back to an untouched surface.
    fn load_restorable(path: &Path) -> Unit {
        let mut unit = Unit::load(path);
        // SAFETY: the unit's component; the state is null, so that it is made.
        unsafe { ok((unit.functions.get_state)(unit.component, &mut unit.untouched)) };
        unit
    }

    fn set(&self, value: f64) -> Status {
        // SAFETY: the unit's component, and arrays of one element.
        unsafe { (self.functions.set_real)(self.component, &INPUT, 1, &value) }
    }

    fn step(&self, index: usize) -> Status {
        // SAFETY: the unit's component.
        unsafe { (self.functions.do_step)(self.component, index as f64 * STEP, STEP, 1) }
    }

    fn get(&self, value: &mut f64) -> Status {
        // SAFETY: the unit's component, and arrays of one element.
        unsafe { (self.functions.get_real)(self.component, &OUTPUT, 1, value) }
    }

    fn restore(&self) -> Status {
        // SAFETY: the unit's component and state.
        unsafe { (self.functions.set_state)(self.component, self.untouched) }
    }

    /// An impact with an input and an output for every step; the status of all calls together, and the last output.
    fn impact(&self, rates: &[f64]) -> (Status, f64) {
        let (mut status, mut force) = (0, 0.0);
        for (index, &rate) in rates.iter().enumerate() {
            status |= self.set(rate) | self.step(index) | self.get(&mut force);
            black_box(force);
        }
        (status, force)
    }

    /// There and back at constant speed, without looking at the force.
    fn steps_alone(&self) -> Status {
        let speed = PEAK / (STEPS / 2) as f64 / STEP;
        let mut status = self.set(speed);
        for index in 0..STEPS / 2 {
            status |= self.step(index);
        }
        status |= self.set(-speed);
        for index in STEPS / 2..STEPS {
            status |= self.step(index);
        }
        status
    }

    /// Saves the state over an older one and restores it.
    fn save_and_restore(&self, state: &mut State) -> Status {
        // SAFETY: the unit's component and state.
        unsafe {
            (self.functions.get_state)(self.component, state) | (self.functions.set_state)(self.component, *state)
        }
    }
}

impl Drop for Unit {
    fn drop(&mut self) {
        // SAFETY: the unit's component and state, which nobody uses afterwards.
        unsafe {
            ok((self.functions.free_state)(self.component, &mut self.untouched));
            ok((self.functions.terminate)(self.component));
            (self.functions.free)(self.component);
        }
    }
}

#[track_caller]
fn ok(status: Status) {
    assert_eq!(status, 0, "a call was refused");
}

/// Rates [m/s] of an impact whose force is thought constant: they fall linearly from closing to opening, so that each
/// step has another one. Half of the steps load the contact, a quarter unloads it, the rest is flight.
fn rates() -> Vec<f64> {
    let largest = 4.0 * PEAK / (STEPS as f64 * STEP);
    (0..STEPS).map(|index| largest * (1.0 - (2 * index + 1) as f64 / STEPS as f64)).collect()
}

/// What is measured, in the order of the table.
#[derive(Clone, Copy)]
enum Figure {
    Impact,
    StepsAlone,
    SaveAndRestore,
}

impl Figure {
    const ALL: [Figure; 3] = [Figure::Impact, Figure::StepsAlone, Figure::SaveAndRestore];

    fn name(self) -> &'static str {
        match self {
            Figure::Impact => "set + step + get",
            Figure::StepsAlone => "step alone",
            Figure::SaveAndRestore => "get + set state",
        }
    }

    /// Time of `impacts` times [`STEPS`] operations; what leads back to the start isn't part of it.
    fn measure(self, unit: &Unit, rates: &[f64], impacts: u64) -> Duration {
        let mut total = Duration::ZERO;
        let mut state = null_mut();
        // SAFETY: the unit's component; the state is null, so that it is made.
        unsafe { ok((unit.functions.get_state)(unit.component, &mut state)) };
        for _ in 0..impacts {
            ok(unit.restore());
            let rates = black_box(rates);
            let start = Instant::now();
            let status = match self {
                Figure::Impact => unit.impact(rates).0,
                Figure::StepsAlone => unit.steps_alone(),
                Figure::SaveAndRestore => rates.iter().fold(0, |status, _| status | unit.save_and_restore(&mut state)),
            };
            total += start.elapsed();
            ok(status);
        }
        // SAFETY: the unit's component and state, which nobody uses afterwards.
        unsafe { ok((unit.functions.free_state)(unit.component, &mut state)) };
        total
    }
}

/// From opening the library to the end of the first step, with a fresh copy of the file: a library that is open already
/// isn't loaded again.
fn load_time(library: &Path, folder: &Path, round: usize) -> Duration {
    let copy = folder.join(format!("{round}-{}", file_name(library)));
    fs::copy(library, &copy).expect("the folder can be written to");
    let start = Instant::now();
    let unit = Unit::load(&copy);
    let status = unit.set(1e-3) | unit.step(0);
    let time = start.elapsed();
    ok(status);
    drop(unit);
    fs::remove_file(&copy).expect("the copy can be removed");
    time
}

fn file_name(path: &Path) -> &str {
    path.file_name().and_then(|name| name.to_str()).expect("a library has a name")
}

fn run(command: &mut Command) -> Vec<u8> {
    let output = command.stderr(Stdio::inherit()).output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert!(output.status.success(), "{command:?}: {}", output.status);
    output.stdout
}

/// Exports the default scene as a user would; the path of the library in it.
fn export_brinell(folder: &Path) -> PathBuf {
    let unit = folder.join("steel_ball.fmu");
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/steel_ball.toml");
    let mut brinell = Command::new(env!("CARGO_BIN_EXE_brinell"));
    brinell.arg("export").arg(scene).arg("-o").arg(&unit).arg("--json");
    brinell.env("BRINELL_CACHE", Path::new(env!("CARGO_TARGET_TMPDIR")).join("cache"));
    let exported: serde_json::Value = serde_json::from_slice(&run(&mut brinell)).expect("the program prints JSON");
    let guid = CString::new(exported["guid"].as_str().expect("a unit has a GUID")).expect("a GUID is plain text");
    GUID.set(guid).expect("one unit is exported");
    let mut archive = zip::ZipArchive::new(fs::File::open(unit).expect("the unit was written")).expect("it is a zip");
    archive.extract(folder).expect("it can be unpacked");
    let binaries = folder.join("binaries");
    let platform = fs::read_dir(binaries).expect("a unit has binaries").next().expect("of one platform").unwrap();
    fs::read_dir(platform.path()).expect("a folder").next().expect("a library").unwrap().path()
}

/// Compiles `units/<name>.c`; the path of the library.
fn build_c(name: &str, folder: &Path) -> PathBuf {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/units").join(name).with_extension("c");
    let library = folder.join(name).with_extension("so");
    let mut cc = Command::new("cc");
    // square roots need no errno: without that option each carries a branch to the library's function
    let guid = GUID.get().expect("the unit was exported").to_str().expect("a GUID is plain text");
    cc.arg(format!("-DUNIT_GUID=\"{guid}\""));
    cc.args(["-O3", "-shared", "-fPIC", "-fno-math-errno", "-o"]).arg(&library).arg(source).arg("-lm");
    run(&mut cc);
    library
}

/// Size of a library without its symbol table [bytes]; `None` where there is no `strip`.
fn stripped_size(library: &Path, folder: &Path) -> Option<u64> {
    let stripped = folder.join("stripped");
    let done =
        Command::new("strip").arg("-o").arg(&stripped).arg(library).status().is_ok_and(|status| status.success());
    done.then(|| fs::metadata(&stripped).expect("strip has written it").len())
}

/// The comparison means something only if all calls succeed and both contacts are the same one.
fn check_agreement(units: &[Unit; 3], rates: &[f64]) {
    let [brinell, c, empty] = units;
    for unit in units {
        ok(unit.restore());
    }
    let mut peak: f64 = 0.0;
    for (index, &rate) in rates.iter().enumerate() {
        let [force, expected, echo] = [brinell, c, empty].map(|unit| {
            let mut value = f64::NAN;
            ok(unit.set(rate) | unit.step(index) | unit.get(&mut value));
            value
        });
        assert_eq!(echo, rate, "the empty unit gives back its input");
        assert!((force - expected).abs() <= 1e-12 * expected.abs(), "step {index}: {force} N, in C {expected} N");
        peak = peak.max(force);
    }
    // full plasticity begins at 128 N
    assert!(peak > 200.0, "the impact hardly touched: {peak} N");
}

fn median(mut samples: Vec<f64>) -> f64 {
    samples.sort_by(f64::total_cmp);
    samples[samples.len() / 2]
}

/// Medians of `rounds` samples of each of three, taken in turns.
fn interleaved(rounds: usize, mut sample: impl FnMut(usize, usize) -> f64) -> [f64; 3] {
    let mut samples = [const { Vec::new() }; 3];
    for round in 0..rounds {
        for turn in 0..3 {
            // whoever is first differs from round to round
            let unit = (round + turn) % 3;
            samples[unit].push(sample(unit, round));
        }
    }
    samples.map(median)
}

fn print_table(units: &[Unit; 3], libraries: &[PathBuf; 3], folder: &Path, rates: &[f64]) {
    println!("\n{:18}{:>10}{:>10}{:>10}{:>12}{:>16}", "", "Brinell", "C", "empty", "Brinell/C", "Brinell/empty");
    let row = |name: &str, [brinell, c, empty]: [f64; 3], decimals: usize| {
        let (to_c, to_empty) = (brinell / c, brinell / empty);
        println!("{name:18}{brinell:10.decimals$}{c:10.decimals$}{empty:10.decimals$}{to_c:12.2}{to_empty:16.2}");
    };
    for figure in Figure::ALL {
        let operations = (IMPACTS * STEPS as u64) as f64;
        let medians =
            interleaved(ROUNDS, |unit, _| figure.measure(&units[unit], rates, IMPACTS).as_nanos() as f64 / operations);
        row(&format!("{} [ns]", figure.name()), medians, 2);
    }
    let loading =
        interleaved(LOAD_ROUNDS, |unit, round| load_time(&libraries[unit], folder, round).as_nanos() as f64 / 1e3);
    row("load to step [us]", loading, 1);
    let size = |library: &PathBuf| fs::metadata(library).expect("the library was built").len();
    row("size [bytes]", libraries.each_ref().map(|library| size(library) as f64), 0);
    if let [Some(brinell), Some(c), Some(empty)] = libraries.each_ref().map(|library| stripped_size(library, folder)) {
        row("stripped [bytes]", [brinell, c, empty].map(|size| size as f64), 0);
    }
}

fn main() {
    let folder = tempfile::tempdir().expect("there is room for temporary files");
    let folder = folder.path();
    let libraries = [export_brinell(folder), build_c("contact", folder), build_c("empty", folder)];
    let units = libraries.each_ref().map(|library| Unit::load_restorable(library));
    let rates = rates();
    check_agreement(&units, &rates);

    let short = Duration::from_millis(500);
    let mut criterion = Criterion::default().warm_up_time(short).measurement_time(2 * short).configure_from_args();
    for figure in Figure::ALL {
        let mut group = criterion.benchmark_group(format!("{}, {STEPS} times", figure.name()));
        for (name, unit) in ["Brinell", "C", "empty"].into_iter().zip(&units) {
            group.bench_function(BenchmarkId::from_parameter(name), |bencher| {
                bencher.iter_custom(|impacts| figure.measure(unit, &rates, impacts));
            });
        }
    }
    criterion.final_summary();
    // `cargo test` runs this program without the argument, to see that it works
    if std::env::args().any(|argument| argument == "--bench") {
        print_table(&units, &libraries, folder, &rates);
    }
}
