//! FMUs with friction, through the C interface.

use crate::loaded::{ERROR, Instance, OK, Unit};
use crate::physics::Random;
use crate::unit;
use brinell_contact::tangential::{Friction, FrictionalContact, FrictionalModel};
use brinell_contact::{Body, Contact, Model, Pair, Surface, loading, unloading};

const STEP: f64 = 1e-6;

/// Outputs of the scene `oblique` that friction determines.
const FRICTION: [&str; 7] = [
    "tangential_force",
    "mean_tangential_force",
    "tangential_impulse",
    "tangential_energy",
    "friction_work",
    "stick_radius",
    "predicted_tangential_force",
];

/// The FMU of a scene file of the project.
fn project(name: &str) -> Unit {
    Unit::load(&unit::scene(name))
}

/// Rates along the normal and in the tangential direction [m/s]: an indentation between -1 and 5 um.
fn rates(seed: u64, length: usize) -> Vec<(f64, f64)> {
    let mut random = Random(seed);
    let mut indentation = 0.0;
    (0..length)
        .map(|_| {
            let target = 6e-6 * random.next() - 1e-6;
            let rate = (target - indentation) / STEP;
            indentation = target;
            (rate, 4.0 * (random.next() - 0.5))
        })
        .collect()
}

/// Sets both rates and makes a step.
fn go(instance: &mut Instance, time: &mut f64, (normal, tangential): (f64, f64), step: f64) {
    instance.set_one("indentation_rate", normal);
    instance.set_one("tangential_rate", tangential);
    assert_eq!(instance.step(*time, step), OK, "{}", instance.message());
    *time += step;
}

/// The values of these outputs, as bits.
fn bits(instance: &Instance, names: &[&str]) -> Vec<u64> {
    names.iter().map(|name| instance.real(name).to_bits()).collect()
}

/// The contact of the scene `oblique`.
fn oblique() -> FrictionalModel<loading::Hertz, unloading::ContactRadius> {
    let ball = Body { radius: 2.5e-3, youngs_modulus: 380e9, poissons_ratio: 0.23 };
    let glass = Body { radius: f64::INFINITY, youngs_modulus: 70e9, poissons_ratio: 0.25 };
    let pair = Pair::new(&ball, &glass, f64::INFINITY).expect("a ball on a plane");
    let friction = Friction::between(&ball, &glass, pair.modulus, 0.092);
    let (loading, unloading) = (loading::Hertz, unloading::ContactRadius);
    FrictionalModel { normal: Model { pair, loading, unloading, surface: Surface::Dented }, friction, loss: () }
}

#[test]
fn the_unit_gives_the_same_bits_as_the_library() {
    let (unit, model) = (project("oblique"), oblique());
    let mut instance = unit.ready();
    let mut contact = FrictionalContact::<16>::start(&model, 0.0).expect("within range");
    let mut time = 0.0;
    for (normal, tangential) in rates(5, 200) {
        go(&mut instance, &mut time, (normal, tangential), STEP);
        contact.set_tangential_rate(tangential);
        contact.step_held(normal, STEP, &model.normal.yield_point(), || model).expect("within range");
        let predicted = contact.predicted_tangential_force(&model, normal, STEP).expect("within range");
        let expected = [
            contact.tangential_force(&model),
            contact.mean_tangential_force(),
            contact.tangential_impulse(),
            contact.tangential_energy(&model),
            contact.friction_work(&model),
            contact.stick_radius(&model),
            predicted,
        ];
        assert_eq!(bits(&instance, &FRICTION), expected.map(f64::to_bits));
        assert_eq!(instance.integer("sliding"), contact.sliding() as i32);
        assert_eq!(instance.real("tangential_rate").to_bits(), tangential.to_bits());
    }
}

#[test]
fn inputs_can_be_set_in_any_order_and_survive_parameters() {
    let unit = project("oblique");
    let mut instance = unit.instantiate();
    // before initialization, and before a parameter that makes the contact anew
    instance.set_one("tangential_rate", 0.4);
    instance.set_one("indentation_rate", 0.5);
    instance.set_one("friction.coefficient", 0.2);
    instance.initialize();
    let other = unit.ready_with(&[("friction.coefficient", 0.2)]);
    let [one, two] = ["tangential_rate", "indentation_rate"].map(|name| other.real_of(name));
    assert_eq!(other.set(&[two, one], &[0.5, 0.4]), OK);
    assert_eq!((instance.step(0.0, STEP), other.step(0.0, STEP)), (OK, OK));
    assert!(instance.real("tangential_force") > 0.0);
    assert_eq!(bits(&instance, &FRICTION), bits(&other, &FRICTION));
    // a rate holds until it is set again
    assert_eq!(other.set(&[one], &[0.4]), OK);
    assert_eq!((instance.step(STEP, STEP), other.step(STEP, STEP)), (OK, OK));
    assert_eq!(bits(&instance, &FRICTION), bits(&other, &FRICTION));
    instance.reset();
    instance.initialize();
    assert_eq!(instance.real("tangential_rate"), 0.0);
    assert_eq!(instance.real("friction.coefficient"), 0.092);
}

#[test]
fn a_rejected_set_changes_nothing() {
    let unit = project("oblique");
    for (value, said) in [
        (f64::NAN, "tangential_rate = NaN is not finite"),
        (f64::INFINITY, "tangential_rate = infinity is not finite"),
        (-2e40, "tangential_rate = -2e40 is out of range: allowed is -1e40 to 1e40 m/s"),
    ] {
        let instance = unit.ready();
        let references = ["indentation_rate", "tangential_rate"].map(|name| instance.real_of(name));
        instance.take_message();
        assert_eq!(instance.set(&references, &[1.0, value]), ERROR);
        let message = instance.take_message();
        assert!(message.contains(said), "{message}");
        assert_eq!(instance.real("indentation_rate"), 0.0);
    }
    for (value, said) in [
        (-1e-3, "friction.coefficient = -0.001 is out of range: allowed is 0 to 10"),
        (10.1, "friction.coefficient = 10.1 is out of range: allowed is 0 to 10"),
    ] {
        let instance = unit.instantiate();
        let reference = instance.real_of("friction.coefficient");
        instance.take_message();
        assert_eq!(instance.set(&[reference], &[value]), ERROR);
        let message = instance.take_message();
        assert!(message.contains(said), "{message}");
    }
}
