//! One FMU with many contacts.

use super::build::{Exported, compile, export_text, size};
use super::exchange::time_of_exchange;
use super::fleet::Fleet;
use super::heap;
use super::paths::{STEP, STEPS, impact, share};
use super::sampling::interleaved;
use super::table::{self, Goal, NOTHING, Row, number};
use super::trio::{Trio, check_force};
use super::unit::{FORCE, INPUT, Instance, State, Unit, ok};
use std::hint::black_box;
use std::path::Path;
use std::ptr::null_mut;
use std::time::{Duration, Instant};

/// Number of contacts in the FMU of the first table.
const CONTACTS: usize = 10_000;

/// Number of contacts in the first FMU in C that is checked: complete blocks of its arrays, and a remainder.
const FEW: usize = 37;

/// Number of contacts in the FMUs of the second table.
const GROWTH: [usize; 6] = [1, 10, 100, 1000, 10_000, 100_000];

/// Number of contact steps in all samples of an FMU together.
const WORK: usize = 50_000_000;

/// Smallest and largest number of samples.
const ROUNDS: [usize; 2] = [5, 200];

/// The scene of the other FMUs, with `count` contacts.
fn scene(count: usize) -> String {
    let one = include_str!("../../scenes/steel_ball.toml");
    format!("{one}\n[[contact]]\nname = \"contact\"\ncount = {count}\n")
}

/// An FMU with many contacts, and the same written by hand in C.
struct ManyUnits {
    exported: Exported,
    units: [Unit; 2],
}

impl ManyUnits {
    fn build(count: usize, folder: &Path) -> ManyUnits {
        let exported = export_text(&format!("contacts_of_{count}"), &scene(count), folder);
        let c = compile("contacts", count, &exported, folder);
        let units = [&exported.library, &c].map(|library| Unit::open(library, &exported.guid));
        ManyUnits { exported, units }
    }
}

/// An instance with its references and values, as stored by its importer.
struct Many<'unit> {
    instance: Instance<'unit>,
    /// Memory of the instance [bytes].
    heap: Option<usize>,
    untouched: State,
    inputs: Vec<u32>,
    forces: Vec<u32>,
    shares: Vec<f64>,
    rates: Vec<f64>,
    results: Vec<f64>,
}

impl<'unit> Many<'unit> {
    fn of(unit: &'unit Unit, count: usize) -> Many<'unit> {
        let before = heap::in_use();
        let instance = unit.instance();
        let heap = heap::in_use().zip(before).map(|(after, before)| after - before);
        let mut untouched = null_mut();
        ok(instance.save(&mut untouched));
        // the inputs come first, then the forces
        let last = u32::try_from(count).expect("a number of contacts");
        Many {
            instance,
            heap,
            untouched,
            inputs: (0..last).collect(),
            forces: (last..2 * last).collect(),
            shares: (0..count).map(share).collect(),
            rates: vec![0.0; count],
            results: vec![0.0; count],
        }
    }

    fn contacts(&self) -> usize {
        self.inputs.len()
    }

    /// Time of an impact in [`STEPS`] steps of all contacts: set all rates, step, read all forces. It includes writing the
    /// rates. `look` gets the forces of the first and the last contact after each step.
    fn impact(&mut self, rates: &[f64], mut look: impl FnMut([f64; 2])) -> Duration {
        ok(self.instance.restore(self.untouched));
        let mut status = 0;
        let start = Instant::now();
        for (index, &rate) in rates.iter().enumerate() {
            for (value, share) in self.rates.iter_mut().zip(&self.shares) {
                *value = rate * share;
            }
            status |= self.instance.set_all(&self.inputs, &self.rates);
            status |= self.instance.step(index as f64 * STEP, STEP);
            status |= self.instance.get_all(&self.forces, &mut self.results);
            let forces = black_box(&self.results);
            look([forces[0], forces[forces.len() - 1]]);
        }
        let time = start.elapsed();
        ok(status);
        time
    }
}

impl Drop for Many<'_> {
    fn drop(&mut self) {
        self.instance.free(&mut self.untouched);
    }
}

/// Times per contact and step [ns].
fn times(units: &mut [Many; 2], rates: &[f64]) -> [f64; 2] {
    let steps = units[0].contacts() * STEPS;
    let rounds = (WORK / steps).clamp(ROUNDS[0], ROUNDS[1]);
    interleaved(rounds, |number, _| units[number].impact(rates, |_| ()).as_nanos() as f64 / steps as f64)
}

/// Prints an FMU with many contacts and the passivity guard, compared with the same one without the guard.
fn print_guarded(folder: &Path, rates: &[f64]) {
    let units = [("guarded", true), ("unguarded", false)].map(|(name, guard)| {
        let laws = format!("unloading = \"contact-radius\"\npassivity_guard = {guard}");
        let text = scene(CONTACTS).replace("unloading = \"contact-radius\"", &laws);
        let exported = export_text(name, &text.replace("big-alabo", "stronge"), folder);
        Unit::open(&exported.library, &exported.guid)
    });
    let [guarded, unguarded] = times(&mut units.each_ref().map(|unit| Many::of(unit, CONTACTS)), rates);
    let name = format!("the same with passivity guard; the goal is the time without, {unguarded:.2} ns");
    let goal = Goal::Value(1.1 * unguarded, unguarded);
    Row { name: &name, unit: "ns", decimals: 2, goal }.print([Some(guarded), None, None]);
}

/// Checks that a contact behaves the same among many and alone.
fn check_among(many: &mut Many, alone: &Unit, rates: &[f64]) {
    let last = share(many.contacts() - 1);
    let expected = [1.0, last].map(|share| (alone.instance(), share));
    let (mut index, mut peak) = (0, 0.0);
    many.impact(rates, |forces| {
        for ((instance, share), force) in expected.iter().zip(forces) {
            ok(instance.set(INPUT, rates[index] * share) | instance.step(index as f64 * STEP, STEP));
            let value = instance.value(FORCE);
            peak = value.max(peak);
            check_force(index, force, value, peak);
        }
        index += 1;
    });
}

/// Checks the FMU in C with complete blocks of its arrays and a remainder.
pub fn check(trio: &Trio) {
    let c = Unit::open(&compile("contacts", FEW, &trio.exported, &trio.folder), &trio.exported.guid);
    check_among(&mut Many::of(&c, FEW), &trio.units[0], &impact());
}

/// Prints an FMU with many contacts compared with one contact of the default scene.
pub fn print(trio: &Trio) {
    let rates = impact();
    let ManyUnits { units, .. } = ManyUnits::build(CONTACTS, &trio.folder);
    let mut many = units.each_ref().map(|unit| Many::of(unit, CONTACTS));
    for unit in &mut many {
        check_among(unit, &trio.units[0], &rates);
    }
    let [brinell, c] = times(&mut many, &rates);
    let alone = Fleet::of(&trio.units[0], 1);
    let [one_contact] = interleaved(ROUNDS[1], |_, _| time_of_exchange(&alone, &rates, STEP));
    let name = format!("one FMU with {} contacts, per contact", number(CONTACTS as f64, 0));
    let goal = Goal::Value(one_contact, 0.25 * one_contact);
    Row { name: &name, unit: "ns", decimals: 2, goal }.print([Some(brinell), Some(c), None]);
    print_guarded(&trio.folder, &rates);
}

/// Prints the quantities that grow with the number of contacts in an FMU.
pub fn print_growth(trio: &Trio) {
    let rates = impact();
    table::head(&["contacts", "step", "per contact", "in C", "heap per contact", "XML", "library", ".fmu", "export"]);
    for contacts in GROWTH {
        let ManyUnits { exported, units } = ManyUnits::build(contacts, &trio.folder);
        let mut many = units.each_ref().map(|unit| Many::of(unit, contacts));
        let [time, c] = times(&mut many, &rates);
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
}
