//! An FMU that knows the mass: an impact in few steps, and its restitution.

use super::build::{export_text, write_text};
use super::exchange::{time_of_exchange, timed};
use super::fleet::Fleet;
use super::paths;
use super::sampling::interleaved;
use super::table::{Goal, Row};
use super::trio::{SCENE, Trio, both_yield, default_law};
use super::unit::{INPUT, Instance, Status, Unit, ok};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// Mass [kg] and speed [m/s] of the impact of the default scene.
const MASS: f64 = 4.11e-3;
const SPEED: f64 = 1.0;

/// Number of instances that make an impact in a sample.
const INSTANCES: usize = 16;

/// Number of samples.
const ROUNDS: usize = 1000;

/// Time before first contact, and total time, in contact times.
const FLIGHT: f64 = 0.1;
const SPAN: f64 = 1.25;

/// Largest error of the restitution for which a time is meaningful.
const ALLOWED: f64 = 1e-12;

/// The prediction of the program from the energy balance.
struct Prediction {
    restitution: f64,
    /// Contact time [s].
    contact_time: f64,
}

fn predict(scene: &Path) -> Prediction {
    let mut brinell = Command::new(env!("CARGO_BIN_EXE_brinell"));
    brinell.arg("predict").arg(scene).arg("--json");
    let output = brinell.output().unwrap_or_else(|error| panic!("{brinell:?}: {error}"));
    assert!(output.status.success(), "{brinell:?}: {}", String::from_utf8_lossy(&output.stderr));
    let printed: Value = serde_json::from_slice(&output.stdout).expect("the program prints JSON");
    let number = |name: &str| printed["laws"][0][name].as_f64().unwrap_or_else(|| panic!("{name} is predicted"));
    Prediction { restitution: number("restitution"), contact_time: number("loading_time") + number("unloading_time") }
}

/// The scene `one` with bodies that the FMU moves, at this initial gap.
fn scene(one: &str, gap: f64) -> String {
    let one = one.replacen("outputs = [", &format!("initial_gap = {gap:e}\noutputs = [\"mean_force\", "), 1);
    format!("{one}\n[coupling]\neffective_mass = {MASS:e}\n")
}

/// The block's strength over the strain rate.
const RATE: &str = "rate = { model = \"cowper-symonds\", d = 40.4, q = 5 }";

pub fn print(trio: &Trio) {
    let at_rate = |text: String| text.replacen("[target]\n", &format!("[target]\n{RATE}\n"), 1);
    let value = |must: f64| [(1, Goal::Value(must, 0.5 * must)), (32, Goal::None)];
    let over_empty = [(1, 1200.0, 400.0), (2, 1400.0, 500.0), (32, 2400.0, 1000.0)];
    let over_empty = over_empty.map(|(steps, must, aim)| (steps, Goal::OverEmpty(must, aim)));
    print_of(trio, "rigid", "brinell", &default_law(), &value(4000.0));
    print_of(trio, "yielding", "brinell, both can yield", &both_yield(), &value(8000.0));
    print_of(trio, "rated", "brinell, strength at the rate", &at_rate(default_law()), &value(15_000.0));
    print_of(trio, "with_mass", "big-alabo", SCENE, &over_empty);
}

/// Prints the times of an impact of the bodies of the scene `one`, in these numbers of steps.
fn print_of(trio: &Trio, name: &str, law: &str, one: &str, goals: &[(u32, Goal)]) {
    // what it predicts of the impact does not depend on the gap
    let Prediction { restitution, contact_time } =
        predict(&write_text(&format!("{name}_first"), &scene(one, 0.0), &trio.folder));
    let exported = export_text(name, &scene(one, FLIGHT * contact_time * SPEED), &trio.folder);
    let unit = Unit::open(&exported.library, &exported.guid);
    let mean_force = exported.reference("mean_force");
    let [fleet, empty] = [Fleet::of(&unit, INSTANCES), Fleet::of(&trio.units[2], 1)];
    for &(steps, goal) in goals {
        let impact = Impact { steps, step: SPAN * contact_time / f64::from(steps), mean_force };
        let (status, speed) = impact.run(&unit.instance());
        ok(status);
        let error = (-speed / SPEED / restitution - 1.0).abs();
        let sample = |number: usize, _| match number {
            0 => impact.time(&fleet),
            _ => time_of_exchange(&empty, &paths::impact(), paths::STEP),
        };
        let [time, empty]: [f64; 2] = interleaved(ROUNDS, sample);
        let steps = if steps == 1 { "one step".to_owned() } else { format!("{steps} steps") };
        // the time of a wrong result is meaningless
        let is_right = error <= ALLOWED;
        let verdict = if is_right { "restitution within" } else { "NO TIME: restitution wrong by" };
        let name = format!("mass known, {law}, a whole impact in {steps} ({verdict} {error:.0e})");
        Row { name: &name, unit: "ns", decimals: 0, goal }.print([is_right.then_some(time), None, Some(empty)]);
    }
}

/// An impact in this number of steps of this length [s].
struct Impact {
    steps: u32,
    step: f64,
    /// Reference of the output `mean_force`.
    mean_force: u32,
}

impl Impact {
    /// The impact with an importer that moves the bodies by the impulse of the force. Returns the combined status of all calls,
    /// and the closing speed at the end [m/s].
    fn run(&self, instance: &Instance) -> (Status, f64) {
        let (mut status, mut speed, mut force) = (0, SPEED, 0.0);
        for index in 0..self.steps {
            status |= instance.set(INPUT, speed) | instance.step(f64::from(index) * self.step, self.step);
            status |= instance.get(self.mean_force, &mut force);
            speed -= self.step * force / MASS;
        }
        (status, speed)
    }

    /// Mean time over the instances [ns].
    fn time(&self, fleet: &Fleet) -> f64 {
        fleet.restore();
        let time = timed(|| fleet.instances.iter().fold(0, |status, instance| status | self.run(instance).0));
        time.as_nanos() as f64 / fleet.instances.len() as f64
    }
}
