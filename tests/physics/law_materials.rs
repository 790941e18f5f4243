//! The law `brinell` for targets that harden and for other Poisson's ratios.

use crate::physics::{
    AnyModel, MASS, Random, advance, brinell, construction, corners, elastic_partner, logarithmic, mild, model,
    pressed, random_bodies, unit,
};
use brinell_contact::impact::{Impact, Prediction, predict};
use brinell_contact::loading::AnyLoading;
use brinell_contact::loading::two_bodies::{Construction, KNOTS};
use brinell_contact::{
    Body, Contact, History, Loading, Model, Pair, Peak, Surface, TwoBodies, Unloading, loading, unloading,
};
use brinell_testing::long;
use std::fs;
use std::path::Path;

pub fn read(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The law `brinell` of a rigid body on one with this hardening modulus [Pa].
fn under_rigid(pair: Pair, hardening_modulus: f64) -> AnyModel {
    brinell(pair, TwoBodies::under_rigid(hardening_modulus))
}

/// A yield strength of steel at which the strain stays small \[Pa\], as in the finite elements.
pub const WEAK: f64 = 0.1;

/// The mild pair with a weak target of this Poisson's ratio and the same plane-strain modulus.
fn of_ratio(poissons_ratio: f64) -> Pair {
    let pair = Pair { yield_strength: WEAK, ..mild() };
    Pair { poissons_ratio, youngs_modulus: pair.modulus * (1.0 - poissons_ratio * poissons_ratio), ..pair }
}

/// A rigid sphere on a weak target with the modulus of [`mild`], with this Poisson's ratio and `H/E`.
pub fn on_steel(poissons_ratio: f64, hardening: f64) -> AnyModel {
    let sphere = Body { radius: 0.005, youngs_modulus: f64::INFINITY, poissons_ratio: 0.3 };
    let target = Body { radius: f64::INFINITY, youngs_modulus: 206e9, poissons_ratio };
    under_rigid(Pair::new(&sphere, &target, WEAK).unwrap(), hardening * 206e9)
}

pub fn force(model: &AnyModel, indentation: f64) -> f64 {
    model.loading.segment(&model.pair, indentation).force(indentation)
}

/// The start of unloading with contact radius and recovery of the construction at this very indentation \[m\], which an FMU has at the knots.
fn constructed(model: &AnyModel, largest: f64) -> Peak {
    let AnyLoading::PairedBrinell(law) = model.loading else { panic!("{model:?}") };
    let (peak, radius) = (model.peak(largest), model.pair.radius);
    let construction = Construction::of(&law.law, &model.pair, &law.bodies);
    let point = construction.at_indentation(largest / radius, peak.force / (radius * radius));
    Peak { contact_radius: radius * point.radius, recovery: model.unloading.recovery(&construction, &point), ..peak }
}

/// Results of the program that made the fit, with all its printed digits.
#[test]
fn the_law_equals_the_fitted_one() {
    // nu, eta, k, phi, work, alpha, dent, g
    let table = [
        [0.3, 0.05, 1.5, 1.821616537, 1.099643996, 1.516339891, 5.246159327e-2, 6.465092304e-2],
        [0.3, 0.05, 100.0, 5.036633536e2, 2.220634770e4, 1.600181381e2, 6.712352574e1, 5.610145028e-1],
        [0.2, 0.0, 10.0, 2.524126022e1, 1.075819941e2, 1.243763499e1, 3.940499141, 4.055765464e-1],
        [0.45, 0.0, 600.0, 3.352047590e3, 9.455550211e5, 1.380727955e3, 5.221530578e2, 4.600819542e-1],
        [0.4, 0.1, 100.0, 5.437491235e2, 2.364610845e4, 1.544492611e2, 6.404108164e1, 6.564878554e-1],
        [0.4, 0.1, 600.0, 5.538596912e3, 1.446391129e6, 9.031156092e2, 4.562349952e2, 7.500000000e-1],
    ];
    for [ratio, eta, k, phi, work, alpha, dent, g] in table {
        let pair = of_ratio(ratio);
        let model = construction(pair, TwoBodies::under_rigid(eta * pair.modulus));
        let point = model.yield_point();
        let largest = k * point.indentation;
        let peak = constructed(&model, largest);
        let (path, radius) = (model.unloading.path(&pair, &peak), peak.contact_radius);
        let shape = -path.square * (path.upper - path.lower).powi(2) / force(&model, largest);
        let pairs = [
            ("phi", force(&model, largest) / point.force, phi),
            ("work", model.loading.work(&pair, largest) / (point.force * point.indentation), work),
            ("alpha", radius * radius / (pair.radius * point.indentation), alpha),
            ("dent", path.lower / point.indentation, dent),
            ("g", shape, g),
        ];
        for (name, got, expected) in pairs {
            let error = (got - expected).abs() / expected;
            assert!(error < 1e-9, "{name} at nu = {ratio}, eta = {eta}, k = {k}: {got} instead of {expected}");
        }
    }
}

#[test]
fn the_constants_in_the_source_equal_those_of_the_fit() {
    let written: serde_json::Value = serde_json::from_str(&read("data/fit/materials_law.json")).unwrap();
    let source = read("crates/contact/src/material/strength.rs");
    let has = |line: &str| assert!(source.contains(line), "crates/contact/src/material/strength.rs lacks {line}");
    for (name, value) in written.as_object().unwrap() {
        match value.as_f64() {
            Some(value) if name == "largest_g" => has(&format!("const LARGEST_SHAPE: f64 = {value};")),
            Some(value) => has(&format!("const {}: f64 = {value};", name.to_uppercase())),
            None if name == "growth" => has(&format!("const GROWTH: [f64; 2] = {value};").replace(',', ", ")),
            None => {
                let knots: Vec<f64> = value.as_array().unwrap().iter().map(|knot| knot.as_f64().unwrap()).collect();
                assert!(KNOTS.starts_with(&knots), "the fit was made with the first knots");
            }
        }
    }
}

/// Any bodies that an FMU accepts, with a hardening modulus from a millionth of `E*` to a million times `E*`, or none.
pub fn random_materials(count: usize) -> impl Iterator<Item = AnyModel> {
    let mut random = Random(7);
    (0..count).map(move |index| {
        let pair = random_bodies(&mut random);
        let ratio = 10f64.powf(-6.0 + 12.0 * random.next());
        let hardening_modulus = if index % 5 == 0 { 0.0 } else { ratio * pair.modulus };
        let mut other = elastic_partner(&pair);
        // every other one may yield, too
        if index % 2 == 0 {
            other.yield_strength = pair.yield_strength * 10f64.powf(2.0 * random.next());
            other.poissons_ratio = -0.99 + 1.49 * random.next();
            other.hardening_modulus =
                if index % 3 == 0 { 0.0 } else { pair.modulus * 10f64.powf(-6.0 + 12.0 * random.next()) };
        }
        let curvature = 2.0 * random.next() - 0.5;
        brinell(pair, TwoBodies { hardening_modulus, curvature, other })
    })
}

#[test]
fn at_0_3_without_hardening_and_for_small_strain_it_is_the_law_itself() {
    let mut random = Random(3);
    for _ in 0..40 {
        let any = random_bodies(&mut random);
        let (yield_strength, youngs_modulus) = (1e-12 * any.modulus, 0.91 * any.modulus);
        let pair = Pair { poissons_ratio: 0.3, yield_strength, youngs_modulus, ..any };
        let (plain, form) =
            (AnyModel { pair, ..model("brinell", "brinell") }, construction(pair, TwoBodies::under_rigid(0.0)));
        let unit = unit(&pair).indentation;
        assert_eq!(plain.yield_point(), form.yield_point());
        let knots = KNOTS.iter().take(14).map(|knot| (knot * unit, 1e-9));
        for (largest, allowed) in knots.chain(logarithmic(1e-3 * unit, 1e4 * unit, 60).map(|largest| (largest, 2e-4))) {
            let of = |model: &AnyModel| {
                let path = model.unloading_path(largest);
                let middle = 0.5 * (path.lower + path.upper);
                let mut back = pressed(model, largest);
                // a dent is a part of the indentation
                let recovered = largest - path.lower;
                let numbers = [force(model, largest), model.loading.contact_radius(&pair, largest), recovered];
                advance(&mut back, model, middle - largest);
                let more = [back.contact_radius(model), model.loading.work(&pair, largest), back.force()];
                (numbers, more, model.loading.regime(&pair, largest))
            };
            let ((one, more, regime), (other, others, same)) = (of(&plain), of(&form));
            // at a knot, rounding decides which region has begun
            assert!(regime == same || allowed < 1e-8, "{regime:?} {same:?} at {largest:e} of {pair:?}");
            for (one, other) in one.into_iter().chain(more).zip(other.into_iter().chain(others)) {
                assert!((one - other).abs() <= allowed * one.abs(), "{one:e} {other:e} at {largest:e} of {pair:?}");
            }
        }
    }
}

#[test]
fn force_and_slope_are_continuous_at_every_knot_of_any_material() {
    for model in random_materials(300) {
        let all = corners(&model);
        assert!(all.len() > 20, "{model:?}");
        for border in all {
            let below = model.loading.segment(&model.pair, border.next_down().next_down());
            let above = model.loading.segment(&model.pair, border);
            assert!(below.upper == border && above.lower == border, "{border} is no knot: {below:?} {above:?}");
            let (left, right) = (below.force(border), above.force(border));
            // far beyond everything, the curve is a small difference
            let allowed = if border < 1e6 * model.yield_point().indentation { 1e-12 } else { 1e-8 };
            assert!((left - right).abs() < allowed * right, "force at {border:e} of {model:?}: {left:e} {right:e}");
            let (left, right) = (below.stiffness(border), above.stiffness(border));
            assert!((left - right).abs() < allowed * right, "slope at {border:e} of {model:?}: {left:e} {right:e}");
        }
    }
}

#[test]
fn no_material_returns_more_energy_than_it_received_and_a_deeper_dent_costs_more() {
    for model in random_materials(long::cases(300) as usize) {
        let pair = &model.pair;
        let unit = model.yield_point().indentation;
        let (mut dent, mut lost) = (0.0, 0.0);
        for largest in logarithmic(0.5 * unit, 1e7 * unit, 200) {
            let work = model.loading.work(pair, largest);
            let path = model.unloading_path(largest);
            let more = work - model.recovered_work(largest, largest);
            assert!(more >= lost - 1e-13 * work, "at {largest:e} of {model:?}: {more:e} after {lost:e} of {work:e}");
            assert!(path.lower >= dent, "at {largest:e} of {model:?}: the dent falls");
            let hertz = pair.hertz_stiffness() * largest.powf(1.5);
            assert!(force(&model, largest) <= hertz * (1.0 + 1e-14), "at {largest:e} of {model:?}");
            for part in [0.01, 0.3, 0.7, 0.99] {
                let way = path.lower + part * (path.upper - path.lower);
                let (back, there) = (path.force(way), force(&model, way));
                assert!(back <= there * (1.0 + 1e-12) && back >= 0.0, "from {largest:e} at {way:e} of {model:?}");
            }
            (dent, lost) = (path.lower, lost.max(more));
        }
    }
}

#[test]
fn a_law_with_a_table_of_its_pair_is_the_law_without_one_to_the_last_bit() {
    for model in random_materials(100) {
        let AnyLoading::PairedBrinell(law) = model.loading else { panic!("{model:?}") };
        let (pair, bare) = (model.pair, AnyModel { loading: AnyLoading::PairedBrinell(law.unprepared()), ..model });
        let unit = model.yield_point().indentation;
        assert_eq!(model.yield_point(), bare.yield_point());
        for largest in logarithmic(0.5 * unit, 1e4 * unit, 40) {
            let [one, other] = [&model, &bare].map(|model| {
                let Model { loading, .. } = model;
                let (segment, work) = (loading.segment(&pair, largest), loading.work(&pair, largest));
                let (peak, path) = (model.peak(largest), model.unloading_path(largest));
                let radius = loading.contact_radius(&pair, largest);
                let rest = (radius, loading.share(&pair, largest), loading.regime(&pair, largest));
                // the work of a peak is not a number
                (segment, work, (peak.force, peak.contact_radius, peak.recovery), path, rest)
            });
            assert_eq!(one, other, "at {largest:e} of {model:?}");
        }
    }
}

/// Of random materials, the part that finite elements cover: contacts below 0.3 of the radius.
#[test]
fn contact_radius_and_recovery_between_the_knots_are_near_the_construction() {
    let (mut radii, mut recoveries) = (Vec::new(), Vec::new());
    for model in random_materials(300) {
        let pair = model.pair;
        let unit = model.yield_point().indentation;
        for largest in logarithmic(1.001 * unit, 1000.0 * unit, 60).take_while(|d| *d < 0.1 * pair.radius) {
            let (peak, exact) = (model.peak(largest), constructed(&model, largest));
            radii.push((peak.contact_radius / exact.contact_radius - 1.0).abs());
            let [own, exact] = [peak, exact].map(|peak| largest - model.unloading.path(&pair, &peak).lower);
            recoveries.push((own / exact - 1.0).abs());
        }
    }
    for (errors, within, most) in [(&mut radii, 1e-3, 5e-3), (&mut recoveries, 1e-3, 5e-3)] {
        errors.sort_by(f64::total_cmp);
        let [typical, worst] = [errors[errors.len() * 99 / 100], errors[errors.len() - 1]];
        assert!(typical < within && worst < most, "99 % within {typical:e}, all within {worst:e}");
    }
}

#[test]
fn hardening_and_a_higher_poissons_ratio_make_an_impact_harder_and_its_dent_shallower() {
    let impact = Impact { mass: MASS, speed: 2.0 };
    let mut before: Option<Prediction> = None;
    let materials = [(0.2, 0.0), (0.3, 0.0), (0.4, 0.0), (0.4, 0.01), (0.4, 0.05), (0.4, 0.1)];
    for (ratio, hardening) in materials {
        // the same effective modulus: only the plastic law differs
        let pair = Pair { yield_strength: 300e6, ..of_ratio(ratio) };
        let prediction = predict(&under_rigid(pair, hardening * 206e9), &impact).expect("an ordinary impact");
        if let Some(before) = before {
            assert!(prediction.restitution > before.restitution && prediction.max_force > before.max_force);
            assert!(prediction.residual_indentation < before.residual_indentation);
        }
        before = Some(prediction);
    }
}

/// An FMU names its laws, without the enums that the other tests use.
#[test]
fn the_loading_law_also_combines_with_another_unloading_law() {
    let pair = Pair { poissons_ratio: 0.4, ..mild() };
    let law = loading::Paired::new(loading::Brinell::REFERENCE, TwoBodies::under_rigid(5e9));
    let model = Model { pair, loading: law, unloading: unloading::ContactRadius, surface: Surface::Dented };
    const { assert!(!unloading::ContactRadius::SQUARES, "its path has no quadratic term, and that of the loading has") };
    let mut history = History::start(&model, 0.0).unwrap();
    let unit = model.yield_point().indentation;
    for x in [0.5, 3.0, 50.0, 40.0, 45.0, 300.0] {
        history.advance(&model, x * unit - history.indentation()).unwrap();
        let shown = Contact::<Model<loading::Paired, unloading::ContactRadius>>::force(&history, 0.0);
        assert_eq!(shown, history.force(), "at {x}");
    }
}
