//! What a step costs through the C interface: Brinell's library, the same contact written by hand in C, and a unit
//! without physics, which is the floor of FMI itself. And what a contact costs that shares its unit with many.
//!
//! All are loaded as an importer loads them. Samples are taken in turns, so that whatever else the machine does hits all
//! alike; the tables at the end have their medians, in Markdown.

mod build;
mod figure;
mod heap;
mod instructions;
mod many;
mod sampling;
mod table;
mod unit;

use build::{Exported, compile, export, size, stripped_size};
use criterion::{BenchmarkId, Criterion, SamplingMode};
use figure::{FORCE, Figure, STEP, STEPS, rates};
use many::{Many, ManyUnits};
use sampling::interleaved;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;
use table::{NOTHING, Row, number};
use unit::{Fleet, INPUT, Unit, ok};

const NAMES: [&str; 3] = ["Brinell", "C", "empty"];

/// Samples of the load time, which needs a file each.
const LOAD_ROUNDS: usize = 200;

/// Instances to find the memory of one.
const HEAP_INSTANCES: usize = 1000;

/// Contacts in the one unit of the first table.
const CONTACTS: usize = 10_000;

/// Contacts in the unit in C whose contacts are checked first: whole blocks of its arrays, and a rest.
const FEW: usize = 37;

/// Contacts in the units of the second table.
const GROWTH: [usize; 6] = [1, 10, 100, 1000, 10_000, 100_000];

/// So many instances of each unit, and how they are sampled: impacts in one sample, long enough for the clock and short
/// enough that an interruption spoils few; and samples of each unit.
struct Crowd {
    instances: usize,
    impacts: u64,
    rounds: usize,
    figures: &'static [Figure],
    /// Bounds of the times of an impact and of the step alone, as ratios to the empty unit: what must be, and the aim.
    limits: [[&'static str; 2]; 2],
}

const CROWDS: [Crowd; 3] = [
    Crowd {
        instances: 1,
        impacts: 10,
        rounds: 2000,
        figures: &Figure::ALL,
        limits: [["1.4", "1.25"], ["1.25", "1.2"]],
    },
    Crowd {
        instances: 100,
        impacts: 1,
        rounds: 200,
        figures: &[Figure::Impact, Figure::StepsAlone],
        limits: [["1.6", "1.25"]; 2],
    },
    Crowd {
        instances: 10_000,
        impacts: 1,
        rounds: 40,
        figures: &[Figure::Impact, Figure::StepsAlone],
        limits: [["2.3", "1.6"]; 2],
    },
];

impl Crowd {
    fn title(&self, figure: Figure) -> String {
        match self.instances {
            1 => figure.name().to_owned(),
            instances => format!("{}, {} instances in turn", figure.name(), number(instances as f64, 0)),
        }
    }

    fn limits(&self, figure: Figure) -> [&'static str; 2] {
        match figure {
            Figure::Impact => self.limits[0],
            Figure::StepsAlone => self.limits[1],
            Figure::SaveAndRestore | Figure::Rollback => ["1.5", "1.2"],
        }
    }
}

/// The comparison means something only if all calls succeed and both contacts are the same one.
fn check_agreement(units: &[Unit; 3], rates: &[f64]) {
    let instances = units.each_ref().map(Unit::instance);
    let mut peak: f64 = 0.0;
    for (index, &rate) in rates.iter().enumerate() {
        let [force, expected, echo] = instances.each_ref().map(|instance| {
            let mut value = f64::NAN;
            ok(instance.set(INPUT, rate) | instance.step(index as f64 * STEP, STEP) | instance.get(FORCE, &mut value));
            value
        });
        assert_eq!(echo, rate, "the empty unit gives back its input");
        check_force(index, force, expected);
        peak = peak.max(force);
    }
    // full plasticity begins at 128 N
    assert!(peak > 200.0, "the impact hardly touched: {peak} N");
}

fn check_force(step: usize, force: f64, expected: f64) {
    assert!((force - expected).abs() <= 1e-12 * expected.abs(), "step {step}: {force} N, and not {expected} N");
}

/// A contact among many is the contact that it would be alone.
fn check_many(many: &mut Many, alone: &Unit, rates: &[f64]) {
    let last = figure::share(many.contacts() - 1);
    let expected = [1.0, last].map(|share| (alone.instance(), share));
    let mut index = 0;
    many.impact(rates, |forces| {
        for ((instance, share), force) in expected.iter().zip(forces) {
            let mut value = f64::NAN;
            let rate = rates[index] * share;
            ok(instance.set(INPUT, rate) | instance.step(index as f64 * STEP, STEP) | instance.get(FORCE, &mut value));
            check_force(index, force, value);
        }
        index += 1;
    });
}

fn criterion(units: &[Unit; 3], rates: &[f64]) {
    let short = Duration::from_millis(500);
    let mut criterion = Criterion::default().warm_up_time(short).measurement_time(2 * short).configure_from_args();
    for crowd in &CROWDS {
        let fleets = units.each_ref().map(|unit| Fleet::of(unit, crowd.instances));
        for &figure in crowd.figures {
            let mut group = criterion.benchmark_group(format!("{}, {STEPS} times", crowd.title(figure)));
            if crowd.instances > 1 {
                group.sampling_mode(SamplingMode::Flat).sample_size(10);
            }
            for (name, fleet) in NAMES.into_iter().zip(&fleets) {
                group.bench_function(BenchmarkId::from_parameter(name), |bencher| {
                    bencher.iter_custom(|impacts| figure.measure(fleet, rates, impacts));
                });
            }
        }
    }
    criterion.final_summary();
}

/// The times; that of set, step and get of Brinell's one contact [ns] is given back.
fn print_times(units: &[Unit; 3], rates: &[f64]) -> f64 {
    let mut one_contact = f64::NAN;
    for crowd in &CROWDS {
        let fleets = units.each_ref().map(|unit| Fleet::of(unit, crowd.instances));
        let operations = (crowd.impacts as usize * STEPS * crowd.instances) as f64;
        for &figure in crowd.figures {
            let sample = |unit: usize, _| figure.measure(&fleets[unit], rates, crowd.impacts).as_nanos() as f64;
            let times = interleaved(crowd.rounds, sample).map(|time| time / operations);
            if crowd.instances == 1 && figure == Figure::Impact {
                one_contact = times[0];
            }
            let [must, aim] = crowd.limits(figure);
            Row { name: &crowd.title(figure), unit: "ns", decimals: 2, must, aim }.print(times.map(Some));
        }
    }
    one_contact
}

fn print_instructions(libraries: &[PathBuf; 3], guid: &str, folder: &Path) {
    const ALL: &[&str] = &["fmi2SetReal", "fmi2DoStep", "fmi2GetReal"];
    const STEP_ALONE: &[&str] = &["fmi2DoStep"];
    for (figure, functions, must, aim) in
        [(Figure::Impact, ALL, "83", "68"), (Figure::StepsAlone, STEP_ALONE, "37", "26")]
    {
        let name = format!("instructions of {}", figure.name());
        if instructions::can_be_counted() {
            let count = |library: &PathBuf| Some(instructions::count(figure, functions, library, guid, folder));
            Row { name: &name, unit: "", decimals: 1, must, aim }.print(libraries.each_ref().map(count));
        } else {
            Row { name: &format!("{name} (needs valgrind)"), unit: "", decimals: 1, must, aim }.print([None; 3]);
        }
    }
}

fn print_memory(units: &[Unit; 3]) {
    let heap = |unit: &Unit| {
        let mut instances = Vec::with_capacity(2 * HEAP_INSTANCES);
        // the first ones may take what others have left
        instances.extend((0..HEAP_INSTANCES).map(|_| unit.instance()));
        let before = heap::in_use()?;
        instances.extend((0..HEAP_INSTANCES).map(|_| unit.instance()));
        Some((heap::in_use()? - before) as f64 / HEAP_INSTANCES as f64)
    };
    let heaps = units.each_ref().map(heap);
    let name = if heaps[0].is_some() { "heap per instance" } else { "heap per instance (needs glibc)" };
    Row { name, unit: "B", decimals: 0, must: "320 B", aim: "128 B" }.print(heaps);
}

fn print_load_time(libraries: &[PathBuf; 3], exported: &Exported, folder: &Path) {
    let times = interleaved(LOAD_ROUNDS, |number, _| {
        // a library that is open already isn't loaded again, hence a fresh copy
        let copy = folder.join("copy.so");
        fs::copy(&libraries[number], &copy).expect("the folder can be written to");
        let time = figure::load(|| Unit::open(&copy, &exported.guid)).as_nanos() as f64 / 1e3;
        fs::remove_file(&copy).expect("the copy can be removed");
        time
    });
    let row = Row { name: "load to first step", unit: "us", decimals: 1, must: "100 us", aim: "70 us" };
    row.print(times.map(Some));
}

fn print_sizes(libraries: &[PathBuf; 3], exported: &Exported, folder: &Path) {
    let sizes = libraries.each_ref().map(|library| stripped_size(library, folder).map(|size| size as f64));
    let [_, c, empty] = sizes;
    let library = Some(size(&libraries[0]) as f64);
    let name = "library, those in C stripped";
    Row { name, unit: "B", decimals: 0, must: NOTHING, aim: "16 KB" }.print([library, c, empty]);
    let archive = Some(exported.archive as f64);
    Row { name: ".fmu", unit: "B", decimals: 0, must: NOTHING, aim: "20 KB" }.print([archive, None, None]);
}

fn print_many(one_contact: f64, alone: &Unit, rates: &[f64], folder: &Path) -> Result<(), String> {
    let ManyUnits { units, .. } = ManyUnits::build(CONTACTS, folder)?;
    let mut many = units.each_ref().map(|unit| Many::of(unit, CONTACTS));
    for unit in &mut many {
        check_many(unit, alone, rates);
    }
    let [brinell, c] = many::times(&mut many, rates);
    let name = format!("one unit with {} contacts, per contact", number(CONTACTS as f64, 0));
    let [must, aim] = [1.0, 0.25].map(|part| format!("{:.2} ns", part * one_contact));
    Row { name: &name, unit: "ns", decimals: 2, must: &must, aim: &aim }.print([Some(brinell), Some(c), None]);
    Ok(())
}

fn print_growth(rates: &[f64], folder: &Path) -> Result<(), String> {
    table::head(&["contacts", "step", "per contact", "in C", "heap per contact", "XML", "library", ".fmu", "export"]);
    for contacts in GROWTH {
        let ManyUnits { exported, units } = ManyUnits::build(contacts, folder)?;
        let mut many = units.each_ref().map(|unit| Many::of(unit, contacts));
        let [time, c] = many::times(&mut many, rates);
        let bytes = |size: u64| format!("{} B", number(size as f64, 0));
        table::row(&[
            number(contacts as f64, 0),
            format!("{} us", number(time * contacts as f64 / 1e3, 3)),
            format!("{} ns", number(time, 2)),
            format!("{} ns", number(c, 2)),
            many[0].heap.map_or(NOTHING.to_owned(), |heap| format!("{} B", number(heap as f64 / contacts as f64, 0))),
            bytes(exported.xml),
            bytes(size(&exported.library)),
            bytes(exported.archive),
            format!("{} s", number(exported.time.as_secs_f64(), 1)),
        ]);
    }
    Ok(())
}

fn print_tables(units: &[Unit; 3], libraries: &[PathBuf; 3], exported: &Exported, folder: &Path, rates: &[f64]) {
    table::head(&["figure", "Brinell", "C", "empty", "Brinell / C", "Brinell / empty", "must", "aim"]);
    let one_contact = print_times(units, rates);
    print_instructions(libraries, exported.guid.to_str().expect("a GUID is plain text"), folder);
    print_memory(units);
    print_load_time(libraries, exported, folder);
    print_sizes(libraries, exported, folder);
    let many = print_many(one_contact, &units[0], rates, folder).and_then(|()| print_growth(rates, folder));
    if let Err(refusal) = many {
        println!("\nUnits with many contacts are not measured, because the program refuses to export one:\n{refusal}");
    }
}

fn main() {
    if instructions::was_counted() {
        return;
    }
    let folder = tempfile::tempdir().expect("there is room for temporary files");
    let folder = folder.path();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/steel_ball.toml");
    let exported = export(&scene, folder).unwrap_or_else(|refusal| panic!("{refusal}"));
    let libraries =
        [exported.library.clone(), compile("contact", 1, &exported, folder), compile("empty", 1, &exported, folder)];
    let units = libraries.each_ref().map(|library| Unit::open(library, &exported.guid));
    let rates = rates();
    check_agreement(&units, &rates);
    let c = Unit::open(&compile("contacts", FEW, &exported, folder), &exported.guid);
    check_many(&mut Many::of(&c, FEW), &units[0], &rates);
    criterion(&units, &rates);
    // `cargo test` runs this program without the argument, to see that it works
    if std::env::args().any(|argument| argument == "--bench") {
        print_tables(&units, &libraries, &exported, folder, &rates);
    }
}
