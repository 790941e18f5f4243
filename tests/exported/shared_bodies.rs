//! FMUs whose contacts share bodies, called like by an importer: a body that it moves by their forces keeps momentum and energy, in either
//! order of execution; and what is told of masses that are not those of the bodies.

use crate::loaded::{ERROR, Instance, OK, Unit};
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
    angle: Vector,
    time: f64,
}

impl Crate {
    fn new(directions: usize) -> Crate {
        let (speed, spin) = ([0.2, 0.1, -0.15], [0.5, -1.0, 2.0]);
        Crate { directions, speed, spin, place: [0.0; 3], angle: [0.0; 3], time: 0.0 }
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
        self.angle.iter_mut().zip(self.spin).for_each(|(angle, spin)| *angle += length * spin);
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
                let (arm, axis) = (FEET[index / (1 + directions)], body.axes()[index % (1 + directions)]);
                for k in 0..3 {
                    body.place[k] -= moment * axis[k] / MASS;
                    body.angle[k] -= moment * cross(arm, axis)[k] / INERTIA[k];
                }
            }
            for (foot, arm) in FEET.into_iter().enumerate() {
                let axis = body.axes()[0];
                let off = dot(axis, body.place) + dot(cross(arm, axis), body.angle)
                    - instance.real(&format!("f{foot}.indentation"));
                assert!(
                    off.abs() < 1e-15 * (1.0 + 1e4 * body.time),
                    "{name}: foot {foot} is off by {off:e} m after {}",
                    body.time
                );
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

/// The scene of two contacts of a ball with this coupling.
fn walls(name: &str, coupling: &str) -> Unit {
    let text = format!(
        "name = {name:?}\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n[impact]\nspeed = 1.0\n[fmu]\n\
         outputs = [\"indentation\"]\n[coupling]\n{coupling}\n[[contact]]\nname = \"c1\"\n[[contact]]\nname = \"c2\"\n"
    );
    let mass = if coupling.contains("inverse_masses") { "mass = 4e-3\nspeed = 1.0" } else { "speed = 1.0" };
    Unit::load(&write_scene(name, &text.replace("speed = 1.0", mass)))
}

fn set(instance: &mut Instance, values: &[(&str, f64)]) {
    values.iter().for_each(|(name, value)| instance.set_one(name, *value));
}

/// Importers that connect FMUs, such as containers, pass on a zero during initialization before another FMU knows the bodies.
#[test]
fn masses_of_zero_during_initialization_are_refused_by_the_first_step_only() {
    let masses = [("c1.effective_mass", 0.1), ("c2.effective_mass", 0.1)];
    let inverse = [("inverse_mass[1,1]", 10.0), ("inverse_mass[1,2]", 0.0), ("inverse_mass[2,2]", 10.0)];
    for (coupling, inputs, words) in [
        (
            "effective_mass = 0.1\ninputs = [\"effective_mass\"]",
            &masses[..],
            "c1: effective_mass = 0 kg: it isn't known yet",
        ),
        ("inverse_masses = \"input\"", &inverse[..], "inverse_mass[1,1] = 0 1/kg: it isn't known yet"),
    ] {
        let unit = walls("late", coupling);
        for are_known in [false, true] {
            let mut instance = unit.instantiate();
            inputs.iter().for_each(|(name, _)| instance.set_one(name, 0.0));
            instance.enter_initialization();
            inputs.iter().for_each(|(name, _)| instance.set_one(name, 0.0));
            assert_eq!(instance.exit(), OK, "{}", instance.message());
            if are_known {
                inputs.iter().for_each(|(name, value)| instance.set_one(name, *value));
            }
            instance.set_one("c1.indentation_rate", 1.0);
            let (status, expected) = (instance.step(0.0, 1e-6), if are_known { OK } else { ERROR });
            let message = instance.message();
            assert!(status == expected && message.contains(words) != are_known, "{coupling}: {status} {message}");
        }
    }
}

#[test]
fn a_matrix_of_no_bodies_is_refused_before_anything_moves() {
    let unit = walls("inputs", "inverse_masses = \"input\"");
    let names = ["inverse_mass[1,1]", "inverse_mass[1,2]", "inverse_mass[2,2]"];
    let all = |entries: [f64; 3]| [(names[0], entries[0]), (names[1], entries[1]), (names[2], entries[2])];
    for (entries, words) in [
        // an importer may pass on a zero before the bodies are known
        ([0.0, 0.0, 10.0], "inverse_mass[1,1] = 0 1/kg: it isn't known yet"),
        ([10.0, 20.0, 10.0], "those of no bodies"),
        ([10.0, -11.0, 10.0], "positive semidefinite"),
    ] {
        let mut instance = unit.ready();
        set(&mut instance, &all(entries));
        instance.set_one("c1.indentation_rate", 1.0);
        assert_eq!(instance.step(0.0, 1e-3), ERROR, "{entries:?}");
        let message = instance.take_message();
        assert!(message.contains(words), "{entries:?}: {message}");
        assert_eq!(instance.real("c1.indentation"), 0.0);
    }
}

#[test]
fn a_step_with_too_many_events_is_refused_with_the_step_that_would_do() {
    let unit = walls("bounces", "inverse_masses = \"input\"");
    let press = || {
        let mut instance = unit.ready();
        // as of three balls in a row
        instance.set_one("inverse_mass[1,2]", -125.0);
        let derivatives = ["c1.indentation_rate", "c2.indentation_rate"].map(|name| instance.real_of(name));
        assert_eq!(instance.set_derivatives(&derivatives, 1, &[1e6, 1e6]), OK);
        instance
    };
    let instance = press();
    assert_eq!(instance.step(0.0, 10.0), ERROR);
    let message = instance.take_message();
    assert!(message.contains("too often to be followed within communicationStepSize = 10 s: a step of"), "{message}");
    assert_eq!(instance.real("c1.indentation"), 0.0);
    let possible: f64 = message.split("a step of ").nth(1).unwrap().split(" s").next().unwrap().parse().unwrap();
    let instance = press();
    assert_eq!(instance.step(0.0, possible), OK, "{}", instance.message());
}

/// A ball between two walls, whose FMU knows one mass for each of the two contacts, or inverse masses that nobody has set.
#[test]
fn a_body_that_two_contacts_share_is_told_where_the_fmu_does_not_know_it() {
    let alone = "the force of contact number 1 moves a body of this one, too";
    let otherwise = "the force of contact number 1 moves a body of this one otherwise than the inputs inverse_mass say";
    for (coupling, is_late, words) in [
        ("effective_mass = 4e-3", false, alone),
        ("effective_mass = 4e-3\nmaster = \"parallel\"", true, alone),
        ("inverse_masses = \"input\"", false, otherwise),
    ] {
        let unit = walls("walls", coupling);
        for is_wrong in [true, false] {
            let mut instance = unit.ready();
            // the other wall is out of reach
            let (mut first, mut second, mut before) = (1.0, -1.0, 0.0);
            if words == otherwise && !is_wrong {
                instance.set_one("inverse_mass[1,2]", -250.0);
            }
            let is_shared = is_wrong || words == otherwise;
            for step in 0..12 {
                set(&mut instance, &[("c1.indentation_rate", first), ("c2.indentation_rate", second)]);
                assert_eq!(instance.step(f64::from(step) * 1e-6, 1e-6), OK, "{}", instance.message());
                let force = instance.real("c1.mean_force");
                let applied = if is_late { before } else { force };
                before = force;
                first -= applied * 1e-6 / 4e-3;
                second += if is_shared { applied * 1e-6 / 4e-3 } else { 0.0 };
            }
            let said = instance.message();
            assert_eq!(said.contains(words), is_wrong, "{coupling}: {said}");
        }
    }
}
