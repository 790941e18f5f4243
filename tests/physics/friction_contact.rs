//! A contact with friction behaves like every contact: steps on courses, momentum, prediction, saved states.

use crate::friction::assert_close;
use crate::physics::{MASS, Random, all_models, mild};
use brinell_contact::damped::{AnyDamped, Damped};
use brinell_contact::history::path::RatePolynomial;
use brinell_contact::loading::AnyLoading;
use brinell_contact::tangential::{Friction, FrictionalContact, FrictionalModel, Mean, Quantity, Sliding, Springs};
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Contact, History, Surface, loading, losses, rate, unloading};

const FRICTION: Friction = Friction { coefficient: 0.3, stiffness_ratio: 1.4 / 1.7 };
const STEP: f64 = 1e-6;

type Model<L, U> = FrictionalModel<L, U>;
type Elastic = Model<loading::Hertz, unloading::ContactRadius>;
type Plastic = Model<loading::Brinell, unloading::Brinell>;
type Frictional = FrictionalContact<12>;

fn model<L, U>(loading: L, unloading: U) -> Model<L, U> {
    let surface = brinell_contact::Surface::Dented;
    FrictionalModel {
        normal: brinell_contact::Model { pair: mild(), loading, unloading, surface },
        friction: FRICTION,
        loss: (),
    }
}

fn elastic() -> Elastic {
    model(loading::Hertz, unloading::ContactRadius)
}

fn plastic() -> Plastic {
    model(loading::Brinell::REFERENCE, unloading::Brinell::REFERENCE)
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

#[test]
fn held_rates_give_the_same_bits_as_springs_advanced_by_hand() {
    let model = plastic();
    let mut contact = Frictional::start(&model, 0.0).expect("within range");
    let mut normal = History::start(&model.normal, 0.0).expect("within range");
    let mut springs = Springs::<12>::start(&model, &normal);
    for (rate, slip) in rates(1, 60) {
        contact.set_tangential_rate(slip);
        let predicted = contact.predicted_tangential_force(&model, rate, STEP).expect("within range");
        let kept = <Frictional as Contact<Plastic>>::kept(&model);
        contact.step_held(rate, STEP, &kept, || model).expect("within range");
        springs
            .advance(&mut normal, &model, (rate * STEP, slip * STEP), (rate, slip), Mean::Skipped)
            .expect("within range");
        let force = springs.force(&FRICTION, normal.indentation());
        assert_eq!(contact.tangential_force(&model).to_bits(), force.to_bits());
        assert_eq!(predicted.to_bits(), force.to_bits());
        assert_eq!(contact.normal(), &normal);
        assert_eq!(contact.sliding() == Sliding::Apart, normal.force() == 0.0);
        assert!(contact.stick_radius(&model) >= 0.0);
    }
}

#[test]
fn a_contact_without_mean_force_has_the_same_forces_and_computes_no_mean() {
    let model = plastic();
    let mut contact = Frictional::start(&model, 0.0).expect("within range");
    let mut other = FrictionalContact::<12, false>::start(&model, 0.0).expect("within range");
    let kept = <Frictional as Contact<Plastic>>::kept(&model);
    for (rate, slip) in rates(3, 100) {
        contact.set_tangential_rate(slip);
        other.set_tangential_rate(slip);
        contact.step_held(rate, STEP, &kept, || model).expect("within range");
        other.step_held(rate, STEP, &kept, || model).expect("within range");
        assert_eq!(other.tangential_force(&model).to_bits(), contact.tangential_force(&model).to_bits());
        assert_eq!(other.tangential_energy(&model).to_bits(), contact.tangential_energy(&model).to_bits());
        assert_eq!([other.mean_tangential_force(), other.tangential_impulse()], [0.0; 2]);
    }
    assert!(contact.tangential_impulse() != 0.0);
}

#[test]
fn impulse_and_work_are_those_of_the_mean_force_and_friction_work_never_falls() {
    let model = elastic();
    let mut contact = Frictional::start(&model, 0.0).expect("within range");
    let (mut impulse, mut lost) = (0.0, 0.0_f64);
    for (rate, slip) in rates(2, 400) {
        contact.set_tangential_rate(slip);
        Contact::step(&mut contact, &RatePolynomial::held(rate), STEP, || model).expect("within range");
        impulse += contact.mean_tangential_force() * STEP;
        assert_close("impulse", contact.tangential_impulse(), impulse, 1e-4, 1e-12);
        let now = contact.friction_work(&model);
        assert!(now >= lost * (1.0 - 1e-12), "{now:e} after {lost:e}");
        lost = now;
    }
    assert!(lost > 0.0);
}

/// The tangential force after a course that reverses within the step, for this number of parts.
fn behind_course(parts: u32) -> f64 {
    let model = elastic();
    let mut contact = FrictionalContact::<512>::start(&model, -2e-6).expect("within range");
    contact.set_tangential_rate(0.1);
    let part = STEP / f64::from(parts);
    // in at 3 m/s, and out at 1 m/s
    let mut course = RatePolynomial { rate: 3.0, slope: -4.0 / STEP, bend: 0.0 };
    for _ in 0..parts {
        Contact::step(&mut contact, &course, part, || model).expect("within range");
        course = course.after(part);
    }
    contact.tangential_force(&model)
}

#[test]
fn a_course_is_followed_to_second_order_of_the_step() {
    let exact = behind_course(4096);
    let limit = 0.3 * plastic().normal.peak(3e-6).force;
    let errors = [1, 4, 16, 64].map(|parts| (behind_course(parts) - exact).abs() / limit);
    println!("{errors:?}");
    assert!(errors[0] < 3e-2, "{errors:?}");
    for pair in errors.windows(2) {
        assert!(pair[1] < 0.15 * pair[0], "{errors:?}");
    }
}

#[test]
fn a_rejected_step_leaves_the_contact_unchanged() {
    let model = plastic();
    let mut contact = Frictional::start(&model, -1e-6).expect("within range");
    contact.set_tangential_rate(1.0);
    let before = contact;
    Contact::step(&mut contact, &RatePolynomial::held(1e200), 1.0, || model).expect_err("too deep");
    assert_eq!(contact, before);
}

#[test]
fn a_contact_without_friction_has_no_tangential_quantities_whatever_its_law() {
    fn check<M, C: Contact<M> + Copy>(name: &str, model: &M) {
        let mut contact = C::start(model, -1e-6).expect("within range");
        let course = RatePolynomial { rate: 1.0, slope: 2.0, bend: 3.0 };
        for direction in [0, 1] {
            contact.set_tangential_course(direction, &course);
            let none = RatePolynomial::held(0.0);
            assert_eq!(
                (contact.tangential_course(direction), contact.tangential_end(direction)),
                (none, none),
                "{name}"
            );
        }
        let of_direction = [0, 1].map(|direction| {
            [Quantity::Force(direction), Quantity::MeanForce(direction), Quantity::Impulse(direction)]
        });
        let others = [Quantity::Energy, Quantity::FrictionWork, Quantity::StickRadius];
        for quantity in of_direction.into_iter().flatten().chain(others) {
            let (first, second) = contact.tangential_derivatives(model, quantity, &course, &[course; 2]);
            let all = [contact.tangential(model, quantity, 0.0), first, second];
            assert!(all.iter().all(|number| number.is_nan()), "{name}: {all:?}");
        }
        assert_eq!(contact.sliding(), Sliding::Apart, "{name}");
    }
    let slow = plastic().normal;
    check::<_, History>("elastoplastic", &slow);
    check::<_, rate::History>(
        "rate",
        &rate::Model { slow, rate: rate::Rate::CowperSymonds { d: 40.4, q: 5.0 }, harder: rate::Rate::NONE },
    );
    let loss = losses::RestitutionFitted { restitution: 0.9 };
    check::<_, losses::History<_>>("losses", &losses::Model { plastic: slow, loss });
    for (name, law) in AnyDamped::ALL {
        check::<_, losses::History<_>>(name, &law.model(mild(), 0.6, MASS));
    }
}

/// A contact knows no more than its words say, wherever it is: also on a fresh surface whose dent lies above it, as it can with some laws.
#[test]
fn a_contact_that_is_loaded_from_its_words_goes_on_alike_wherever_bodies_part() {
    type Any = Model<AnyLoading, AnyUnloading>;
    let words = |contact: &Frictional| {
        let mut words = Vec::new();
        Contact::<Any>::save(contact, &mut |word| words.push(word));
        words
    };
    for surface in [Surface::Dented, Surface::Fresh] {
        for (name, normal) in all_models(mild()) {
            let normal = brinell_contact::Model { surface, ..normal };
            let model = FrictionalModel { normal, friction: FRICTION, loss: () };
            let kept = <Frictional as Contact<Any>>::kept(&model);
            let go_to = |contact: &mut Frictional, goal: f64| {
                contact.set_tangential_rate(0.02 * goal / STEP);
                let way = goal - contact.normal().indentation();
                contact.step_held(way / STEP, STEP, &kept, || model).expect("within range");
            };
            // an elastic law has no yield point
            let yields_at = normal.yield_point().indentation.min(1e-6);
            for depth in [0.5, 1.5, 4.0, 30.0].map(|part| part * yields_at) {
                let mut contact = Frictional::start(&model, 0.0).expect("within range");
                for part in [0.6, 1.0, 0.3, 0.1, 1e-3, 0.0, -1e-3, -1e-2, -0.1, -0.5, -1.0, 0.2] {
                    go_to(&mut contact, part * depth);
                    let (mut here, mut loaded) = (contact, Frictional::load(&mut words(&contact).into_iter(), &model));
                    let loaded = loaded.as_mut().expect("its own words");
                    for goal in [0.8 * depth, 0.4 * depth] {
                        go_to(&mut here, goal);
                        go_to(loaded, goal);
                        assert_eq!(words(loaded), words(&here), "{name}, {surface:?}: from {depth} m at {part} of it");
                    }
                }
            }
        }
    }
}
