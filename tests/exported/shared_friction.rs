//! FMUs whose contacts share bodies with friction, called like by an importer: the body that it moves by their forces keeps momentum
//! and energy, in either order of execution, and a saved state continues with the same bits.

use crate::loaded::{Instance, OK, Unit};
use crate::unit::write_scene;

type Vector = [f64; 3];

const MASS: f64 = 0.3;
const INERTIA: Vector = [2e-4, 3e-4, 4e-4];
const FEET: [Vector; 3] = [[0.03, 0.02, -0.015], [0.03, -0.02, -0.015], [-0.03, 0.0, -0.015]];
/// Gravity on a slope [m/s^2].
const GRAVITY: Vector = [2.0, 0.0, -9.6];

/// A crate on three feet: friction in so many directions, with more lines under `[law]` and `[coupling]`.
fn crate_on_feet(name: &str, directions: usize, law: &str, coupling: &str) -> String {
    let mut text = format!(
        "name = {name:?}\n[impactor]\nradius = 5e-3\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\n\
         [target]\nmaterial = \"mild steel\"\n[law]\n{law}[friction]\ncoefficient = 0.3\ndirections = {directions}\n\
         [coupling]\ninputs = [\"external_acceleration\"]\n{coupling}[fmu]\noutputs = [\"indentation\", \"impulse\", \
         \"elastic_energy\", \"dissipated_energy\", \"closing_speed\", \"tangential_speed\", \"tangential_energy\", \
         \"friction_work\", \"tangential_impulse\"]\n\
         [[body]]\nname = \"crate\"\nmass = {MASS}\ninertia = {INERTIA:?}\n"
    );
    for (foot, arm) in FEET.iter().enumerate() {
        text += &format!(
            "[[contact]]\nname = \"f{foot}\"\nbetween = [\"crate\", \"ground\"]\nnormal = [0, 0, -1]\n\
             tangent = [1, 0, 0]\narms = [{arm:?}, []]\n"
        );
    }
    text
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The crate that an importer moves. It does not turn as far as its feet tell: directions and arms stay.
#[derive(Clone)]
struct Crate {
    directions: usize,
    speed: Vector,
    spin: Vector,
    place: Vector,
    time: f64,
}

impl Crate {
    fn new(directions: usize) -> Crate {
        Crate { directions, speed: [0.2, 0.1, -0.15], spin: [0.5, -1.0, 2.0], place: [0.0; 3], time: 0.0 }
    }

    /// The directions of the rows: normal, first and second tangent.
    fn axes(&self) -> &'static [Vector] {
        &[[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]][..=self.directions]
    }

    /// The names of a quantity of the rows.
    fn names(&self, normal: &str, tangential: &str) -> Vec<String> {
        match self.directions {
            1 => vec![normal.into(), tangential.into()],
            _ => vec![normal.into(), format!("{tangential}[1]"), format!("{tangential}[2]")],
        }
    }

    fn rate(&self, axis: Vector, arm: Vector) -> f64 {
        dot(axis, self.speed) + dot(cross(arm, axis), self.spin)
    }

    /// Sets rates and accelerations, makes a step, and applies these forces.
    fn step(&mut self, instance: &mut Instance, length: f64, forces: &[f64]) {
        let before = self.clone();
        let (rates, accelerations) = (
            self.names("indentation_rate", "tangential_rate"),
            self.names("external_acceleration", "external_tangential_acceleration"),
        );
        for (foot, arm) in FEET.iter().enumerate() {
            for (index, axis) in self.axes().iter().enumerate() {
                instance.set_one(&format!("f{foot}.{}", rates[index]), before.rate(*axis, *arm));
                instance.set_one(&format!("f{foot}.{}", accelerations[index]), dot(*axis, GRAVITY));
            }
        }
        assert_eq!(instance.step(self.time, length), OK, "{}", instance.message());
        self.time += length;
        let now = self.forces(instance);
        self.apply(if forces.is_empty() { &now } else { forces }, length);
    }

    /// The mean forces of all rows: those of a foot behind each other.
    fn forces(&self, instance: &Instance) -> Vec<f64> {
        self.read(instance, "mean_force", "mean_tangential_force")
    }

    fn read(&self, instance: &Instance, normal: &str, tangential: &str) -> Vec<f64> {
        let names = self.names(normal, tangential);
        (0..FEET.len())
            .flat_map(|foot| names.iter().map(move |name| format!("f{foot}.{name}")))
            .map(|name| instance.real(&name))
            .collect()
    }

    fn apply(&mut self, forces: &[f64], length: f64) {
        let rows = 1 + self.directions;
        for ((place, speed), gravity) in self.place.iter_mut().zip(&mut self.speed).zip(GRAVITY) {
            *place += length * (*speed + 0.5 * length * gravity);
            *speed += length * gravity;
        }
        for (index, force) in forces.iter().enumerate() {
            let (arm, axis) = (FEET[index / rows], self.axes()[index % rows]);
            for k in 0..3 {
                self.speed[k] -= length * force * axis[k] / MASS;
                self.spin[k] -= length * force * cross(arm, axis)[k] / INERTIA[k];
            }
        }
    }

    fn energy(&self) -> f64 {
        let turning: f64 = (0..3).map(|k| INERTIA[k] * self.spin[k] * self.spin[k]).sum();
        0.5 * (MASS * dot(self.speed, self.speed) + turning) - MASS * dot(GRAVITY, self.place)
    }

    /// The largest difference of the rates of all rows from the speeds that the FMU tells [m/s].
    fn difference(&self, instance: &Instance) -> f64 {
        let told = self.read(instance, "closing_speed", "tangential_speed");
        let own = FEET.iter().flat_map(|arm| self.axes().iter().map(|axis| self.rate(*axis, *arm)));
        told.iter().zip(own).map(|(told, own)| (told - own).abs()).fold(0.0, f64::max)
    }
}

const KINDS: [(usize, &str); 4] = [
    (1, "loading = \"big-alabo\"\n"),
    (2, "loading = \"thornton\"\nunloading = \"thornton\"\n"),
    (1, "loading = \"brinell\"\nelastic_restitution = 0.8\n"),
    (2, "loading = \"hertz\"\nelastic_restitution = 0.8\n"),
];

const STEPS: [f64; 6] = [1e-5, 3e-5, 1e-4, 1e-6, 1e-3, 2e-3];

#[test]
fn a_crate_loses_what_its_feet_take_up() {
    for (index, (directions, law)) in KINDS.into_iter().enumerate() {
        let name = format!("crate{index}");
        let unit = Unit::load(&write_scene(&name, &crate_on_feet(&name, directions, law, "")));
        let (mut instance, mut body) = (unit.ready(), Crate::new(directions));
        let begin = body.energy();
        for length in STEPS {
            body.step(&mut instance, length, &[]);
            assert!(body.difference(&instance) < 1e-12, "{name} after {}", body.time);
            // the bodies are displaced by the moments of the impulses
            let moments = body.read(&instance, "impulse_moment", "tangential_impulse_moment");
            for (index, moment) in moments.iter().enumerate() {
                let axis = body.axes()[index % (1 + directions)];
                (0..3).for_each(|k| body.place[k] -= moment * axis[k] / MASS);
            }
            let names = ["elastic_energy", "dissipated_energy", "tangential_energy", "friction_work"];
            let taken: f64 = names
                .iter()
                .flat_map(|name| (0..3).map(move |foot| format!("f{foot}.{name}")))
                .map(|name| instance.real(&name))
                .sum();
            let off = begin - body.energy() - taken;
            assert!(off.abs() < 1e-10 * begin, "{name} after {}: {off:e} of {begin:e} J", body.time);
        }
    }
}

#[test]
fn an_importer_that_applies_the_forces_one_step_late_ends_with_the_same_speeds() {
    for (index, (directions, law)) in KINDS.into_iter().enumerate() {
        let ends = ["", "master = \"parallel\"\n"].map(|master| {
            let name = format!("late{index}_{}", master.len());
            let unit = Unit::load(&write_scene(&name, &crate_on_feet(&name, directions, law, master)));
            let (mut instance, mut body) = (unit.ready(), Crate::new(directions));
            let mut before = body.forces(&instance);
            // the same steps until all feet are in the air, and two more
            for _ in 0..12 {
                let late: &[f64] = if master.is_empty() { &[] } else { &before };
                body.step(&mut instance, 2e-4, late);
                before = body.forces(&instance);
            }
            let owed = before.iter().map(|force| force.abs()).sum::<f64>();
            (body, owed)
        });
        let [(serial, _), (parallel, owed)] = ends;
        assert!(owed < 1e-9, "the feet still push, {owed} N");
        for k in 0..3 {
            assert!(
                (serial.speed[k] - parallel.speed[k]).abs() < 1e-9,
                "{index}: {:?} {:?}",
                serial.speed,
                parallel.speed
            );
            assert!((serial.spin[k] - parallel.spin[k]).abs() < 1e-7, "{index}: {:?} {:?}", serial.spin, parallel.spin);
        }
    }
}
