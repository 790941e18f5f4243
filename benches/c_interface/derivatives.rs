//! Steps with two derivatives of the input: set the input, set its derivatives, step, read.

use super::build::export_text;
use super::corners::{self, Place, STEP, STEPS_BEFORE, before_corners, on_branches};
use super::exchange::{follow, time_of_exchange, timed};
use super::fleet::Fleet;
use super::paths;
use super::sampling::interleaved;
use super::table::{Goal, Row};
use super::trio::Trio;
use super::unit::{FORCE, INPUT, Instance, Status, Unit};
use std::hint::black_box;

/// Number of instances at each position. All of them make one step in a sample.
const INSTANCES: usize = 16;

/// Number of samples.
const ROUNDS: usize = 5000;

/// The rate at the start of a step [m/s], and its derivatives.
struct Course {
    rate: f64,
    derivatives: [f64; 2],
}

impl Course {
    /// The rate decreases and bends so that the step ends as required. A step back from the loading curve goes deeper first.
    fn of(place: &Place) -> Course {
        let [slope, bend] = if place.turns_back() { [-3.0, 0.1] } else { [-0.5, 0.1] };
        let rate = place.step / STEP / (1.0 + slope / 2.0 + bend / 6.0);
        Course { rate, derivatives: [slope * rate / STEP, bend * rate / (STEP * STEP)] }
    }

    /// Makes the step.
    #[inline]
    fn step(&self, instance: &Instance) -> Status {
        let time = STEPS_BEFORE as f64 * STEP;
        instance.set(INPUT, self.rate) | instance.set_derivatives(INPUT, &self.derivatives) | instance.step(time, STEP)
    }
}

/// The default scene with one more output.
fn with_mean_force() -> String {
    include_str!("../../scenes/steel_ball.toml").replacen("outputs = [", "outputs = [\"mean_force\", ", 1)
}

pub fn print(trio: &Trio) {
    let with_mean = export_text("mean_force", &with_mean_force(), &trio.folder);
    let mean_unit = Unit::open(&with_mean.library, &with_mean.guid);
    let empty = Fleet::of(&trio.units[2], 1);
    let ways = [
        ("on one branch", on_branches(), Goal::OverEmpty(8.0, 5.0)),
        ("across a corner", before_corners(trio), Goal::OverEmpty(20.0, 12.0)),
    ];
    for (name, places, goal) in ways {
        corners::check(trio, &places, |instance, place| Course::of(place).step(instance));
        let courses: Vec<Course> = places.iter().map(Course::of).collect();
        let default = fleet(&trio.units[0], &places);
        let mean = fleet(&mean_unit, &places);
        let sample = |number: usize, _| match number {
            0 => time(&default, &courses, FORCE),
            1 => time(&mean, &courses, with_mean.reference("mean_force")),
            _ => time_of_exchange(&empty, &paths::impact(), paths::STEP),
        };
        let [default, mean, empty] = interleaved(ROUNDS, sample).map(Some);
        let name = format!("step with two input derivatives, {name}");
        Row { name: &name, unit: "ns", decimals: 1, goal }.print([default, None, empty]);
        let name = format!("{name}, with `mean_force`");
        Row { name: &name, unit: "ns", decimals: 1, goal }.print([mean, None, empty]);
    }
}

/// The same number of instances at each position.
fn fleet<'unit>(unit: &'unit Unit, places: &[Place]) -> Fleet<'unit> {
    let prepare = |index: usize, instance: &Instance| follow(instance, &places[index % places.len()].before, STEP);
    Fleet::placed(unit, INSTANCES * places.len(), prepare)
}

/// Time of a step of each instance, including reading the variable `output` [ns].
fn time(fleet: &Fleet, courses: &[Course], output: u32) -> f64 {
    fleet.restore();
    let time = timed(|| steps(fleet, black_box(courses), output));
    time.as_nanos() as f64 / fleet.instances.len() as f64
}

fn steps(fleet: &Fleet, courses: &[Course], output: u32) -> Status {
    let (mut status, mut value) = (0, 0.0);
    for (instance, course) in fleet.instances.iter().zip(courses.iter().cycle()) {
        status |= course.step(instance) | instance.get(output, &mut value);
        black_box(value);
    }
    status
}
