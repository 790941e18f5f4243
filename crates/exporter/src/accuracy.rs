//! How near the law of a scene is to finite elements of two bodies like its own, and what those bodies do in an impact.

use crate::numbers::{cell, quantity};
use crate::scene::{Body, Scene};
use brinell_contact::impact::Prediction;
use brinell_contact::loading::{AnyLoading, Paired};
use std::f64::consts::PI;

/// Mean pressure over yield strength at first yield of the law `brinell`, rounded down: the harder body is elastic below.
const FIRST_YIELD: f64 = 1.07;

/// Strengths this close to each other count as equal.
const EQUAL: f64 = 0.01;

/// Notes on the bodies of the first contact in an impact with this `prediction` by the scene's own laws.
pub fn notes(scene: &Scene, prediction: &Prediction) -> Vec<String> {
    if prediction.residual_indentation <= 0.0 || scene.yield_strength.is_none() {
        // the elastic depth of a line contact depends on its size, too
        let is_said = scene.law_words.is_some();
        return is_said.then(|| accuracy(scene, prediction)).flatten().into_iter().collect();
    }
    let softer = scene.softer(0);
    let (name, other) = (softer.name(), softer.other().name());
    let mut notes = Vec::new();
    match Partner::of(scene, prediction) {
        Partner::Alike => notes.push(
            "Both bodies are equally strong and yield alike: force over indentation is the same, and each of them has half of the \
             dent."
                .into(),
        ),
        Partner::Yields => notes.push(format!(
            "Both bodies yield. The dent is the sum of two; the larger part is in the {name}, which is softer. How much of it the \
             {other} has is known roughly only."
        )),
        _ if softer == Body::Impactor => {
            notes.push("The impactor is the softer body: it yields, and the dent is in the impactor.".into());
        }
        _ => {}
    }
    notes.extend(accuracy(scene, prediction));
    notes
}

/// The parts of the dent that impactor and target have in an impact with this `prediction`, and whether that is known: where both yield, it
/// is all given to the softer one.
pub fn dented(scene: &Scene, prediction: &Prediction) -> ([f64; 2], bool) {
    let partner = Partner::of(scene, prediction);
    let parts = match (partner, scene.softer(0)) {
        (Partner::Alike, _) => [0.5, 0.5],
        (_, Body::Impactor) => [1.0, 0.0],
        (_, Body::Target) => [0.0, 1.0],
    };
    (parts, partner != Partner::Yields)
}

/// What the harder body does while the softer one yields.
#[derive(Clone, Copy, PartialEq)]
enum Partner {
    Rigid,
    /// It stays elastic. The modulus of the softer body over its own.
    Elastic(f64),
    /// It yields, too.
    Yields,
    /// It is as strong as the other one.
    Alike,
}

/// Below this ratio of the moduli an elastic body is nearly rigid.
const NEARLY_RIGID: f64 = 0.1;

impl Partner {
    /// The harder body of the first contact in an impact with this `prediction`.
    fn of(scene: &Scene, prediction: &Prediction) -> Partner {
        let model = scene.model();
        let two = scene.two_bodies(0);
        let strengths = two.other.yield_strength / model.pair.yield_strength;
        let ratio = model.pair.yielding_modulus() / two.other.modulus;
        if (strengths - 1.0).abs() <= EQUAL {
            Partner::Alike
        } else if takes_both(&model.loading).is_some_and(|law| law.both_yield(&model.pair, prediction.max_indentation))
        {
            Partner::Yields
        } else if ratio < NEARLY_RIGID {
            Partner::Rigid
        } else {
            Partner::Elastic(ratio)
        }
    }
}

/// The law that takes each of the two bodies for itself.
fn takes_both(loading: &AnyLoading) -> Option<&Paired> {
    match loading {
        AnyLoading::PairedBrinell(law) => Some(law),
        _ => None,
    }
}

/// The largest errors of the law `brinell` against finite elements \[%\]: force at a given depth, restitution and dent of an impact.
type Errors = (&'static str, &'static str, &'static str);

/// Those beside an elastic body: modulus of the softer body over that of the elastic one, and the same in words.
/// `tests/physics/finite_elements.csv` has them as limits.
const BESIDE_ELASTIC: [(f64, &str, Errors); 3] = [
    (1.0 / 3.0, "three times the modulus", ("0.6", "0.4", "0.6")),
    (1.0, "the same modulus", ("1.2", "0.9", "2")),
    (3.0, "a third of the modulus", ("1.7", "1.1", "4.5")),
];

/// Those of two bodies that yield, and of two that are alike.
const BOTH_YIELD: Errors = ("1.1", "0.6", "1.8");
const ALIKE: Errors = ("0.4", "0.3", "1.1");

/// How much too soft the laws are that take both bodies as one of the effective modulus, beside those elastic bodies \[%\]: force and
/// restitution.
const AS_ONE: [(&str, &str); 3] = [("4.5", "2"), ("9", "5"), ("15", "9")];

/// Above this ratio of the moduli no finite elements of pairs are near.
const SOFTEST: f64 = 4.5;

/// How near the law of the scene is to finite elements of two bodies like those of the first contact; `None` if no body yields, or if
/// the law is another one and the harder body rigid.
pub fn accuracy(scene: &Scene, prediction: &Prediction) -> Option<String> {
    let loading = scene.laws.loading().1;
    if let (true, Some(size)) = (loading.is_line(), &scene.law_words) {
        return Some(of_line(scene, size));
    }
    if let Some(elliptic) = &scene.contacts[0].ellipse {
        let [impactor, target] = scene.bodies(0);
        let softer = if scene.softer(0) == Body::Impactor { impactor } else { target };
        return Some(elliptic.words(scene.laws.unloading().map(|_| softer.poissons_ratio)));
    }
    if let Some((words, law)) = scene.law_words.as_ref().zip(loading.table()) {
        let last = law.knots().last().map_or(0.0, |knot| knot.depth * scene.model().pair.radius);
        let beyond = if prediction.max_indentation > last { " This impact goes deeper." } else { "" };
        return Some(format!("{words}{beyond}"));
    }
    if prediction.residual_indentation <= 0.0 || scene.is_damped() {
        return None;
    }
    let (softer, name) = (scene.softer(0), scene.laws.loading().0);
    let partner = Partner::of(scene, prediction);
    let nearest = |ratio: f64| {
        let distance = |place: &usize| (ratio / BESIDE_ELASTIC[*place].0).ln().abs();
        (0..BESIDE_ELASTIC.len()).min_by(|one, other| distance(one).total_cmp(&distance(other))).unwrap_or_default()
    };
    if name != "brinell" {
        if let Some(hard) = scene.harder_strength(0).filter(|_| partner != Partner::Alike) {
            let radius = prediction.max_contact_radius;
            let pressure = prediction.max_force / (PI * radius * radius);
            if pressure > FIRST_YIELD * hard {
                return Some(format!(
                    "The mean pressure reaches {} times the yield strength of the {}, {}. From {FIRST_YIELD} on it yields, too, and \
                     the law {name} takes it to be as soft as the {}. The law brinell takes each body for itself.",
                    cell(pressure / hard, 1.0),
                    softer.other().name(),
                    quantity(hard, "Pa"),
                    softer.name(),
                ));
            }
        }
        let Partner::Elastic(ratio) = partner else { return None };
        let place = nearest(ratio);
        let (force, restitution) = AS_ONE[place];
        return Some(format!(
            "The {} stays elastic, and its modulus is {} times that of the {}. The law {name} takes both bodies as one of the \
             effective modulus. Against finite elements with {} that alone makes the force up to {force} % too low at the same depth \
             and the restitution up to {restitution} %. The law brinell takes each body for itself.",
            softer.other().name(),
            cell(1.0 / ratio, 1.0),
            softer.name(),
            BESIDE_ELASTIC[place].1,
        ));
    }
    Some(of_brinell(&partner, softer, nearest) + &of_large_strain(scene, prediction))
}

/// How near the law of a line contact is, with the size that its depth depends on.
fn of_line(scene: &Scene, size: &str) -> String {
    let rigid = scene.group_value(0, Body::Impactor.youngs_modulus()).is_none();
    let errors = match rigid {
        true => "depth within 0.8 %, half-width 0.9 %, restitution 0.4 %, dent 1 %",
        false => "depth within 1 % (1.6 % beside an elastic body of a third of the modulus), restitution 0.4 %",
    };
    let walls = match scene.group_value(0, Body::Target.radius()) {
        Some(radius) if radius < 0.0 => {
            " The wall around the bore counts as a plate of its thickness, which has not been compared."
        }
        _ => "",
    };
    format!(
        "Line contact: {size}.{walls} Against finite elements in plane strain: {errors}. Not in the law: the ends of the cylinder, \
         misalignment, a bore that is hardly wider than the cylinder, and discs that are thin beside the half-width."
    )
}

/// The sentence on the law `brinell` at small strain.
fn of_brinell(partner: &Partner, softer: Body, nearest: impl Fn(f64) -> usize) -> String {
    let (bodies, (force, restitution, dent)) = match *partner {
        Partner::Rigid => {
            return "Accuracy for these bodies: against finite elements of a rigid sphere (small strain), the law brinell has the force \
                    within 0.5 % up to 3000 yield indentations and the restitution within 0.2 %; with hardening or a Poisson's ratio \
                    other than 0.3 within 0.7 % and 0.8 %."
                .into();
        }
        Partner::Elastic(ratio) if ratio > SOFTEST => {
            return format!(
                "Accuracy for these bodies: the {} stays elastic, and its modulus is {} times that of the {}. No finite elements of \
                 such a pair are known; with a third of the modulus, the law brinell has the force within 1.7 %.",
                softer.other().name(),
                cell(1.0 / ratio, 1.0),
                softer.name(),
            );
        }
        Partner::Elastic(ratio) => {
            let (_, words, errors) = BESIDE_ELASTIC[nearest(ratio)];
            (format!("a yielding body beside an elastic one of {words}"), errors)
        }
        Partner::Yields => ("two bodies that yield".into(), BOTH_YIELD),
        Partner::Alike => ("two bodies that are alike".into(), ALIKE),
    };
    format!(
        "Accuracy for these bodies: against finite elements of {bodies} (small strain, up to 150 or 200 yield indentations), the law \
         brinell has the force within {force} %, the restitution within {restitution} % and the dent within {dent} %."
    )
}

/// Contact radius over effective radius from which large strain is spoken of.
const WIDE: f64 = 0.1;

/// The sentence on large strain, if the contact is wide.
fn of_large_strain(scene: &Scene, prediction: &Prediction) -> String {
    let ratio = prediction.max_contact_radius / scene.model().pair.radius;
    if ratio < WIDE {
        return String::new();
    }
    format!(
        " The contact radius reaches {} effective radii, and large strain is included: for one body that yields, within 1.4 % (a plane, up \
         to 0.36) and 1.6 % (a sphere, up to 0.3) of the force by finite elements with large deformation that it isn't fitted to.",
        cell(ratio, 1.0)
    )
}
