//! FMUs with friction in two directions, through the C interface.

use crate::loaded::{Instance, OK, Unit};
use crate::physics::Random;
use crate::unit;
use brinell_contact::tangential::{Friction, FrictionalModel, PlaneContact};
use brinell_contact::{Body, Contact, Model, Pair, Surface, loading, unloading};

const STEP: f64 = 1e-6;

/// The outputs that friction determines.
const FRICTION: [&str; 11] = [
    "tangential_force[1]",
    "tangential_force[2]",
    "mean_tangential_force[1]",
    "mean_tangential_force[2]",
    "tangential_impulse[1]",
    "tangential_impulse[2]",
    "tangential_energy",
    "friction_work",
    "stick_radius",
    "predicted_tangential_force[1]",
    "predicted_tangential_force[2]",
];

/// An FMU of the bodies of the scene `oblique` with friction in two directions, and more text.
fn unit_of(name: &str, more: &str) -> Unit {
    let outputs = "\"mean_tangential_force\", \"tangential_impulse\", \"tangential_energy\", \"friction_work\", \
                   \"stick_radius\", \"predicted_tangential_force\", \"sliding\"";
    let text = format!(
        "name = \"{name}\"\n[impactor]\nradius = 2.5e-3\nyoungs_modulus = 380e9\npoissons_ratio = 0.23\n[target]\n\
         youngs_modulus = 70e9\npoissons_ratio = 0.25\n[law]\nloading = \"hertz\"\n[friction]\ncoefficient = 0.092\n\
         directions = 2\n[fmu]\noutputs = [{outputs}]\n[impact]\nmass = 2.6e-4\nspeed = 3.9\n{more}"
    );
    Unit::load(&unit::write_scene(name, &text))
}

/// The contact of [`unit_of`].
fn model() -> FrictionalModel<loading::Hertz, unloading::ContactRadius> {
    let ball = Body { radius: 2.5e-3, youngs_modulus: 380e9, poissons_ratio: 0.23 };
    let glass = Body { radius: f64::INFINITY, youngs_modulus: 70e9, poissons_ratio: 0.25 };
    let pair = Pair::new(&ball, &glass, f64::INFINITY).expect("a ball on a plane");
    let friction = Friction::between(&ball, &glass, pair.modulus, 0.092);
    let (loading, unloading) = (loading::Hertz, unloading::ContactRadius);
    FrictionalModel { normal: Model { pair, loading, unloading, surface: Surface::Dented }, friction, loss: () }
}

/// Rates along the normal and in the tangential directions [m/s]: an indentation between -1 and 5 um.
fn rates(seed: u64, length: usize) -> Vec<(f64, [f64; 2])> {
    let mut random = Random(seed);
    let mut indentation = 0.0;
    let step = |_| {
        let target = 6e-6 * random.next() - 1e-6;
        let rate = (target - indentation) / STEP;
        indentation = target;
        (rate, [4.0 * (random.next() - 0.5), 4.0 * (random.next() - 0.5)])
    };
    (0..length).map(step).collect()
}

fn go(instance: &mut Instance, time: &mut f64, (normal, [one, two]): (f64, [f64; 2]), step: f64) {
    instance.set_one("indentation_rate", normal);
    instance.set_one("tangential_rate[1]", one);
    instance.set_one("tangential_rate[2]", two);
    assert_eq!(instance.step(*time, step), OK, "{}", instance.message());
    *time += step;
}

/// Both components of this output.
fn both(instance: &Instance, name: &str) -> [f64; 2] {
    [1, 2].map(|component| instance.real(&format!("{name}[{component}]")))
}

fn bits(instance: &Instance) -> Vec<u64> {
    FRICTION.iter().map(|name| instance.real(name).to_bits()).collect()
}

#[test]
fn the_unit_gives_the_same_bits_as_the_library() {
    let (unit, model) = (unit_of("two_elastic", ""), model());
    let (mut instance, mut time) = (unit.ready(), 0.0);
    let mut contact = PlaneContact::<16>::start(&model, 0.0).expect("within range");
    for (normal, tangential) in rates(5, 200) {
        go(&mut instance, &mut time, (normal, tangential), STEP);
        contact.set_tangential_rates(tangential);
        contact.step_held(normal, STEP, &model.normal.yield_point(), || model).expect("within range");
        let predicted = contact.predicted_tangential_forces(&model, normal, STEP).expect("within range");
        let vectors =
            [contact.tangential_forces(&model, 0.0), contact.mean_tangential_forces(), contact.tangential_impulses()];
        let scalars = [contact.tangential_energy(&model), contact.friction_work(&model), contact.stick_radius(&model)];
        let expected = vectors.as_flattened().iter().chain(&scalars).chain(&predicted).map(|value| value.to_bits());
        assert_eq!(bits(&instance), expected.collect::<Vec<_>>());
        assert_eq!(instance.integer("sliding"), contact.sliding() as i32);
        assert_eq!(both(&instance, "tangential_rate"), tangential);
    }
}
