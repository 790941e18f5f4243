//! Bodies of known mass on a target whose strength depends on the strain rate, without FMI.

use crate::moved_bodies::{Group, LosingModel, RATES};
use crate::physics::{AnyModel, Random, elastic_partner};
use brinell_contact::impact::{self, Impact};
use brinell_contact::loading::{self, AnyLoading, Loading};
use brinell_contact::losses::{self, AnyLoss, RestitutionFitted};
use brinell_contact::motion::{self, ExternalLoad};
use brinell_contact::rate::{self, History, Rate, Slow};
use brinell_contact::shared::SharedContact;
use brinell_contact::unloading::{self, AnyUnloading, Unloading};
use brinell_contact::{Contact, Pair, Surface, TwoBodies};

const MASS: f64 = 4.11e-3;

fn pair() -> Pair {
    Pair { radius: 5e-3, modulus: 115e9, yield_strength: 300e6, youngs_modulus: 210e9, poissons_ratio: 0.3 }
}

type Model<L, U> = rate::Model<brinell_contact::Model<L, U>>;

type Hard = (loading::Paired, unloading::Brinell);

fn hardening() -> Hard {
    let bodies = TwoBodies { hardening_modulus: 2e9, curvature: 0.0, other: elastic_partner(&pair()) };
    (loading::Paired::new(loading::Brinell::REFERENCE, bodies), unloading::Brinell::REFERENCE)
}

fn model<L, U>((loading, unloading): (L, U), rate: Rate, surface: Surface) -> Model<L, U> {
    rate::Model { slow: brinell_contact::Model { pair: pair(), loading, unloading, surface }, rate, harder: Rate::NONE }
}

/// Moves the bodies from `speed` in steps of `step` until they part; returns their closing speed then.
fn bounce<L: Loading + Copy, U: Unloading + Copy>(
    model: &Model<L, U>,
    history: &mut History,
    mut speed: f64,
    step: f64,
) -> f64 {
    for _ in 0..1_000_000 {
        let drive = ExternalLoad { mass: MASS, acceleration: 0.0 };
        speed = motion::follow(history, model, &drive, speed, step).expect("within range").speed;
        if speed < 0.0 && history.contact().force() == 0.0 {
            return speed;
        }
    }
    panic!("the bodies do not part");
}

/// The restitution of an impact on a target of `factor` times the strength.
fn restitution<L: Loading + Copy, U: Unloading + Copy>(model: &Model<L, U>, speed: f64) -> (f64, f64) {
    let impact = Impact { mass: MASS, speed };
    let found = model.in_impact(&impact).expect("within range");
    assert!(found.steps < 60, "{found:?}");
    (impact::restitution(&model.at(found.factors), &impact).expect("within range"), found.factors.softer)
}

#[test]
fn every_impact_has_the_strength_of_its_closing_speed() {
    fn check<L: Loading + Copy, U: Unloading + Copy>(laws: (L, U)) {
        for rate in RATES {
            for speed in [0.01, 0.1, 1.0, 10.0, 100.0] {
                let model = model((laws.0, laws.1), rate, Surface::Dented);
                let (expected, factor) = restitution(&model, speed);
                for step in [1e-6, 17e-6, 2e-3] {
                    let mut history: History = Contact::start(&model, 0.3 * speed * step).unwrap();
                    let found = -bounce(&model, &mut history, speed, step) / speed;
                    assert!((found / expected - 1.0).abs() < 1e-11, "{rate:?} {speed} {step}: {found} {expected}");
                    assert!(factor > 1.0);
                    assert!((history.factors().softer / factor - 1.0).abs() < 1e-11, "{rate:?} {speed} {step}");
                }
            }
        }
    }
    check(hardening());
    check((loading::Brinell::REFERENCE, unloading::Brinell::REFERENCE));
    let (loading, unloading) = hardening();
    let any = AnyLoading::PairedBrinell(loading);
    check((any, AnyUnloading::Brinell(unloading)));
    check((loading::Johnson::REFERENCE, unloading::HertzShift));
}

/// Tabor: a fifth of the largest contact radius over that of the ball, in the time that it takes to grow.
#[test]
fn the_strain_rate_under_a_rigid_ball_is_tabors() {
    let slow = brinell_contact::Model {
        pair: Pair { modulus: pair().youngs_modulus / 0.91, ..pair() },
        loading: loading::Johnson::REFERENCE,
        unloading: unloading::HertzShift,
        surface: Surface::Dented,
    };
    for rate in RATES {
        for speed in [0.1, 1.0, 10.0] {
            let (model, impact) = (rate::Model { slow, rate, harder: Rate::NONE }, Impact { mass: MASS, speed });
            let found = model.in_impact(&impact).expect("within range");
            let of = impact::predict(&model.at(found.factors), &impact).expect("within range");
            let expected = 0.2 * of.max_contact_radius / pair().radius / of.loading_time;
            let found = found.strain_rate();
            assert!((found / expected - 1.0).abs() < 1e-9, "{found} /s, not {expected} /s");
        }
    }
}

#[test]
fn the_deepest_indentation_of_a_step_is_that_of_all_its_impacts() {
    for rate in RATES {
        let model = model(hardening(), rate, Surface::Fresh);
        let drive = ExternalLoad { mass: MASS, acceleration: 50.0 };
        // three impacts, each slower than the one before
        let deepest = |parts: u32| {
            let mut history: History = Contact::start(&model, 1e-6).unwrap();
            let (mut speed, mut deepest) = (0.3, 0.0_f64);
            for _ in 0..parts {
                let step = 0.02 / f64::from(parts);
                let outcome = motion::follow(&mut history, &model, &drive, speed, step).expect("within range");
                (speed, deepest) = (outcome.speed, deepest.max(outcome.deepest));
            }
            deepest
        };
        let (whole, parts) = (deepest(1), deepest(1000));
        assert!((whole / parts - 1.0).abs() < 1e-9, "{whole:e} m, {parts:e} m in parts");
    }
}

/// Bodies of nearly the same strength, one of which follows the rate steeply, are the hard ones.
#[test]
fn the_strength_of_an_impact_takes_few_predictions_whatever_the_bodies() {
    let mut random = Random(7);
    let (mut all, mut most, mut many, count) = (0, 0, 0, 1000);
    for index in 0..count {
        let yields = index % 2 == 0;
        let (modulus, softness) = (random.log_uniform(1e9, 1e12), random.log_uniform(1.01, 10.0));
        let pair = Pair {
            radius: random.log_uniform(1e-6, 1.0),
            modulus,
            yield_strength: modulus / random.log_uniform(30.0, 3000.0),
            youngs_modulus: 0.91 * softness * modulus,
            poissons_ratio: 0.3,
        };
        let mut other = elastic_partner(&pair);
        if yields {
            other.yield_strength = pair.yield_strength * random.log_uniform(1.0, 10.0);
            other.hardening_modulus = if index % 4 == 0 { 0.0 } else { modulus * random.log_uniform(1e-4, 0.1) };
        }
        let hardening_modulus = if index % 3 == 0 { 0.0 } else { modulus * random.log_uniform(1e-4, 0.1) };
        let loading = loading::Paired::new(
            loading::Brinell::REFERENCE,
            TwoBodies { hardening_modulus, curvature: random.next(), other },
        );
        let mut rate = || match random.next() < 0.5 {
            true => Rate::JohnsonCook { c: random.next(), reference_rate: random.log_uniform(1e-6, 1e6) },
            false => Rate::CowperSymonds { d: random.log_uniform(1e-6, 1e9), q: random.log_uniform(0.5, 20.0) },
        };
        let (rate, harder) = (rate(), if yields { rate() } else { Rate::NONE });
        let slow = brinell_contact::Model {
            pair,
            loading,
            unloading: unloading::Brinell::REFERENCE,
            surface: Surface::Dented,
        };
        // speeds from a ten-millionth to a tenth of that of waves
        let mass = 3e4 * pair.radius.powi(3) * random.log_uniform(0.1, 10.0);
        let speed = (modulus / 8000.0).sqrt() * random.log_uniform(1e-7, 0.1);
        let found = rate::Model { slow, rate, harder }.in_impact(&Impact { mass, speed });
        let steps = found.unwrap_or_else(|| panic!("{pair:?} {other:?} {rate:?} {harder:?} {mass} {speed}")).steps;
        (all, most, many) = (all + steps, most.max(steps), many + u32::from(steps > 16));
    }
    assert!(many <= 5 && most <= 120 && all < 5 * count, "{most} at most, {many} above 16, {all} of {count} impacts");
}

#[test]
fn below_the_reference_rate_the_factor_is_one() {
    let rate = Rate::JohnsonCook { c: 0.5, reference_rate: 1e8 };
    let model = model(hardening(), rate, Surface::Dented);
    let mut history: History = Contact::start(&model, 0.0).unwrap();
    bounce(&model, &mut history, 20.0, 1e-5);
    assert_eq!(history.factors().softer, 1.0);
}

#[test]
fn a_dent_keeps_the_strength_that_made_it_and_a_fresh_surface_has_that_of_each_impact() {
    for rate in RATES {
        for (surface, keeps) in [(Surface::Dented, true), (Surface::Fresh, false)] {
            for (first, second) in [(5.0, 0.3), (0.3, 5.0)] {
                let model = model(hardening(), rate, surface);
                let mut history: History = Contact::start(&model, 1e-6).unwrap();
                bounce(&model, &mut history, first, 1e-5);
                let made = history.factors().softer;
                // away beyond the original surface, and back
                bounce(&model, &mut history, -1.0, 1e-3);
                assert_eq!(history.factors().softer, made);
                let before = history.dissipated_energy(&model);
                let end = bounce(&model, &mut history, second, 1e-5);
                assert_eq!(history.factors().softer == made, keeps, "{rate:?} {surface:?} {first} {second}");
                let lost = 0.5 * MASS * (second * second - end * end);
                let spent = history.dissipated_energy(&model) - before;
                let scale = 0.5 * MASS * first.max(second).powi(2);
                assert!((spent - lost).abs() < 1e-10 * scale, "{rate:?} {surface:?}: {spent} {lost}");
                if !keeps {
                    assert!((-end / second / restitution(&model, second).0 - 1.0).abs() < 1e-11);
                }
            }
        }
    }
}

#[test]
fn an_elastic_impact_makes_no_dent_for_a_slower_one() {
    // a strength that grows fast: the first impact stays elastic, the second one is slower and yields earlier
    let model = model(hardening(), Rate::CowperSymonds { d: 1e-6, q: 5.0 }, Surface::Dented);
    let mut history: History = Contact::start(&model, 1e-6).unwrap();
    for speed in [1.0, 0.1, 0.01] {
        let end = bounce(&model, &mut history, speed, 1e-5);
        assert!((end / -speed - 1.0).abs() < 1e-11, "{speed}: {end}");
        assert!((history.factors().softer / restitution(&model, speed).1 - 1.0).abs() < 1e-11, "{speed}");
        bounce(&model, &mut history, -1.0, 1e-3);
    }
}

/// The second contact is far away, so that the first one moves as if it were alone, but by the motion of bodies that share contacts.
#[test]
fn an_impact_of_bodies_that_share_contacts_is_that_of_a_single_contact() {
    fn check<M: Slow, C: Contact<M> + SharedContact<M>>(slow: M, name: &str, allowed: f64) {
        for rate in RATES {
            for speed in [0.01, 0.1, 1.0, 10.0, 100.0] {
                let model = rate::Model { slow, rate, harder: Rate::NONE };
                let drive = ExternalLoad { mass: MASS, acceleration: 0.0 };
                let mut alone: History<C> = Contact::start(&model, 1e-6).unwrap();
                let end = losses::follow(&mut alone, &model, &drive, speed, 1e-3).unwrap().speed;
                for parts in [1, 10, 1000] {
                    let entries = vec![1.0 / MASS, 1e-9 / MASS, 1.0 / MASS];
                    let (gaps, rates) = ([1e-6, 1.0], vec![speed, 0.0]);
                    let mut group: Group<_, History<C>> =
                        Group::new(vec![model; 2], &gaps, entries, vec![0.0; 2], rates);
                    (0..parts).for_each(|_| group.step(1e-3 / f64::from(parts)));
                    let error = (group.rates[0] - end).abs() / speed;
                    let factors = [alone, group.contacts[0]].map(|contact| contact.factors().softer);
                    assert!(error < allowed, "{name}, {rate:?}, {speed} in {parts}: {error:e}");
                    assert!((factors[0] / factors[1] - 1.0).abs() < 1e-10, "{name}, {rate:?}, {speed}: {factors:?}");
                    assert!(factors[1] > 1.0);
                }
            }
        }
    }
    let (loading, unloading) = hardening();
    let hard = (AnyLoading::PairedBrinell(loading), AnyUnloading::Brinell(unloading));
    let johnson = (AnyLoading::Johnson(loading::Johnson::REFERENCE), AnyUnloading::HertzShift(unloading::HertzShift));
    for ((loading, unloading), name) in [(hard, "brinell"), (johnson, "johnson")] {
        let plastic = AnyModel { pair: pair(), loading, unloading, surface: Surface::Dented };
        check::<_, brinell_contact::History>(plastic, name, 1e-10);
        let loss = AnyLoss::RestitutionFitted(RestitutionFitted { restitution: 0.7 });
        check::<LosingModel, losses::History<AnyLoss>>(losses::Model { plastic, loss }, name, 1e-10);
    }
}
