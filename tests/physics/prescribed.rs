//! Contacts of every kind whose rate is given: what holds on any history, however time is cut.

use crate::law_materials::random_materials;
use crate::moved_bodies::{LosingModel, STEEL};
use crate::physics::{AnyModel, MASS, Random, all_models, is_passive, is_scale_free, mild, some_models, unit};
use brinell_contact::damped::hunt_crossley::DampingFactor;
use brinell_contact::damped::{Adams, AnyDamped, Damped, HuntCrossley};
use brinell_contact::losses::{self, AnyLoss, HalfSpaceRadiation, Plate, RestitutionFitted};
use brinell_contact::{Body, Contact, History, Pair, Surface};

/// Part of a history: a rate [m/s] and its time [s].
type Leg = (f64, f64);

/// Ten legs between places up to `depth` [m], over three decades, each at a rate of its own. One place in five is apart.
fn any_history(random: &mut Random, depth: f64) -> Vec<Leg> {
    let mut from = -1e-3 * depth;
    let mut leg = || {
        let sign = if random.next() < 0.2 { -0.1 } else { 1.0 };
        let to = sign * depth * random.log_uniform(1e-3, 1.0);
        let way = to - std::mem::replace(&mut from, to);
        let rate = random.log_uniform(1e-2, 10.0).copysign(way);
        (rate, way / rate)
    };
    (0..10).map(|_| leg()).collect()
}

/// What is allowed, as a part of the largest force, energy or area so far.
#[derive(Clone, Copy)]
struct Allowed {
    /// Between a step and its parts.
    cut: f64,
    /// Between the mean force times the way and the work.
    work: f64,
    /// Of heat that comes back; a law that is not passive makes energy.
    heat: f64,
    /// Numbers of parts.
    parts: &'static [u32],
}

/// Few parts, for a law whose every step takes an integral.
const FEW: &[u32] = &[2, 30];
const MANY: &[u32] = &[2, 30, 1000];

/// The largest values so far; before the touch, next to nothing.
struct Largest {
    force: f64,
    energy: f64,
    area: f64,
}

/// Follows a history, and checks each leg.
fn check<M: Copy, C: Contact<M>>(name: &str, model: &M, depth: f64, legs: &[Leg], allowed: Allowed) {
    let kept = C::kept(model);
    let mut contact = C::start(model, 1e-3 * depth).expect("within range");
    let mut largest = Largest { force: f64::MIN_POSITIVE, energy: f64::MIN_POSITIVE, area: f64::MIN_POSITIVE };
    for &(rate, time) in legs {
        let before = contact;
        let mean = contact.mean_force(model, rate, time).expect("within range");
        contact.step_held(rate, time, &kept, || model).expect("within range");
        let what = format!("{name} at {rate} m/s for {time:e} s");
        largest.force = largest.force.max(mean).max(contact.force(rate));
        largest.energy = largest.energy.max((mean * rate * time).abs()).max(contact.work(model));
        largest.area = largest.area.max(contact.contact_area(model));
        let done = contact.work(model) - before.work(model);
        let off = (mean * rate * time - done).abs() / largest.energy;
        assert!(off <= allowed.work, "{what}: work is off by {off:e}");
        let back = (before.dissipated_energy(model) - contact.dissipated_energy(model)) / largest.energy;
        assert!(back <= allowed.heat, "{what}: {back:e} of the energy comes back from heat");
        let pulls = [mean, contact.force(rate), contact.force(-100.0 * rate)].into_iter().fold(0.0, f64::min);
        assert!(pulls >= -1e-15 * largest.force, "{what}: it pulls with {pulls:e} N");
        // a fitted damping has a kink at the largest speed so far
        check_slopes(&what, model, &contact, 0.5 * rate, &largest);
        for &parts in allowed.parts {
            let (mut cut, mut sum) = (before, 0.0);
            for _ in 0..parts {
                let part = time / f64::from(parts);
                sum += cut.mean_force(model, rate, part).expect("within range") / f64::from(parts);
                cut.step_held(rate, part, &kept, || model).expect("within range");
            }
            let differences = [
                (contact.indentation() - cut.indentation()) / depth,
                (contact.force(rate) - cut.force(rate)) / largest.force,
                (mean - sum) / largest.force,
                (contact.work(model) - cut.work(model)) / largest.energy,
                (contact.dissipated_energy(model) - cut.dissipated_energy(model)) / largest.energy,
                (contact.residual_indentation(model) - cut.residual_indentation(model)) / depth,
                (contact.contact_area(model) - cut.contact_area(model)) / largest.area,
            ];
            assert!(
                differences.iter().all(|off| off.abs() <= allowed.cut),
                "{what}, in {parts} parts: {differences:?}"
            );
        }
    }
}

/// Stiffness and damping are the slopes of the force.
fn check_slopes<M, C: Contact<M>>(what: &str, model: &M, contact: &C, rate: f64, largest: &Largest) {
    let near = 1e-6 * rate.abs();
    let slope = (contact.force(rate + near) - contact.force(rate - near)) / (2.0 * near);
    let off = (contact.damping(rate) - slope).abs() * rate.abs() / largest.force;
    assert!(off <= 1e-6, "{what}: damping is off by {off:e}");
    let d = contact.indentation();
    let (width, (lower, upper)) = (1e-5 * d, contact.smooth_piece(model));
    let is_inside = d > 0.0 && (lower == d || lower < d - width) && upper > d + width;
    let at = |d: f64| contact.moved_to(model, d).force(rate);
    // no slope where the surface would have to pull
    if is_inside && at(d - width) > 0.0 {
        let slope = (at(d + width) - at(d - width)) / (2.0 * width);
        let off = (contact.stiffness(rate) - slope).abs() / (slope.abs() + contact.force(rate) / d);
        assert!(off <= 2e-5, "{what}, {d:e} m: stiffness is off by {off:e} of {slope:e} N/m");
    }
}

/// Any bodies: E from rubber to beyond diamond, S/E from lead to glass, spheres from a grain of powder to a boulder.
fn any_bodies(random: &mut Random, laws: &AnyModel) -> AnyModel {
    let youngs_modulus = random.log_uniform(1e6, 3e12);
    let (strain, radius) = (random.log_uniform(1e-5, 0.1), random.log_uniform(1e-6, 10.0));
    let (poissons_ratio, is_rigid, is_fresh) = (0.5 * random.next(), random.next() < 0.5, random.next() < 0.5);
    let impactor_modulus = if is_rigid { f64::INFINITY } else { 3.0 * youngs_modulus };
    let sphere = Body { radius, youngs_modulus: impactor_modulus, poissons_ratio: 0.3 };
    // these laws depend on the contact radius over R, and hold where it is small
    let strain = if is_scale_free(laws) { strain } else { strain.min(1e-3) };
    let target = Body { radius: f64::INFINITY, youngs_modulus, poissons_ratio };
    let pair = Pair::new(&sphere, &target, strain * youngs_modulus).expect("a sphere on a plane");
    AnyModel { pair, surface: if is_fresh { Surface::Fresh } else { Surface::Dented }, ..*laws }
}

/// Of a law: where it makes energy, so much of it.
fn heat_of(model: &AnyModel) -> f64 {
    if is_passive(model) { 1e-13 } else { 10.0 }
}

#[test]
fn work_heat_slopes_and_parts_of_any_elastoplastic_history_agree() {
    let mut random = Random(1900);
    for (name, laws) in all_models(mild()) {
        let ordinary = AnyModel { surface: if random.next() < 0.5 { Surface::Fresh } else { Surface::Dented }, ..laws };
        for model in [ordinary, any_bodies(&mut random, &laws), any_bodies(&mut random, &laws)] {
            let depth = random.log_uniform(1.0, 300.0) * unit(&model.pair).indentation;
            let allowed = Allowed { cut: 1e-12, work: 1e-9, heat: heat_of(&model), parts: MANY };
            check::<_, History>(&name, &model, depth, &any_history(&mut random, depth), allowed);
        }
    }
    for model in random_materials(60) {
        let depth = random.log_uniform(1.0, 3000.0) * unit(&model.pair).indentation;
        let allowed = Allowed { cut: 1e-12, work: 1e-9, heat: 1e-13, parts: MANY };
        check::<_, History>("brinell of any materials", &model, depth, &any_history(&mut random, depth), allowed);
    }
}

#[test]
fn work_heat_slopes_and_parts_of_any_history_with_a_loss_agree() {
    let mut random = Random(1);
    let losses = [
        AnyLoss::RestitutionFitted(RestitutionFitted { restitution: 0.98 }),
        AnyLoss::HalfSpaceRadiation(HalfSpaceRadiation { target: STEEL }),
        AnyLoss::Plate(Plate { target: STEEL, thickness: 0.01 }),
    ];
    for (name, plastic) in some_models(mild()) {
        for loss in losses {
            let surface = if random.next() < 0.5 { Surface::Fresh } else { Surface::Dented };
            let model = LosingModel { plastic: AnyModel { surface, ..plastic }, loss };
            let depth = 30.0 * unit(&mild()).indentation;
            let parts = if plastic.is_segmented() { MANY } else { FEW };
            // without segments, and on a plate that gives way, forces are integrated
            let is_integrated = !plastic.is_segmented() || matches!(loss, AnyLoss::Plate(_));
            let cut = if is_integrated { 1e-8 } else { 1e-10 };
            let allowed = Allowed { cut, work: 1e-9, heat: heat_of(&plastic), parts };
            let name = format!("{name} with {loss:?}");
            check::<_, losses::History<AnyLoss>>(&name, &model, depth, &any_history(&mut random, depth), allowed);
        }
    }
}

/// Every rate-dependent law, in its different variants.
pub fn rate_dependent_laws() -> Vec<(String, AnyDamped)> {
    let mut laws: Vec<_> = AnyDamped::ALL.iter().map(|(name, law)| ((*name).to_string(), *law)).collect();
    let of_factor = |damping_factor| AnyDamped::HuntCrossley(HuntCrossley { damping_factor });
    laws.extend(DampingFactor::ALL.iter().map(|(name, factor)| ((*name).to_string(), of_factor(*factor))));
    laws.extend([(1.0, 1e-5), (1.2, 1e-5), (1.5, 1e-4), (1.9, 3e-5), (2.0, 1e-5), (3.0, 1e-5)].map(
        |(exponent, damping_depth)| {
            let law = Adams { exponent, damping_depth, ..Adams::REFERENCE };
            (format!("adams with {exponent}"), AnyDamped::Adams(law))
        },
    ));
    laws
}

#[test]
fn work_heat_slopes_and_parts_of_any_history_of_a_rate_dependent_law_agree() {
    let mut random = Random(2);
    for (name, law) in rate_dependent_laws() {
        for restitution in [0.1, 0.4, 0.9] {
            let (model, depth) = (law.model(mild(), restitution, MASS), random.log_uniform(1e-7, 1e-3));
            let allowed = Allowed { cut: 1e-11, work: 1e-9, heat: 1e-13, parts: MANY };
            check::<_, losses::History<_>>(&name, &model, depth, &any_history(&mut random, depth), allowed);
        }
    }
}
