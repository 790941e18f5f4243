//! Warnings about numbers that are allowed but implausible: a radius of 5 m, a Young's modulus of 210 Pa.

use super::file::{BodyTable, PowerLawTable, SceneFile, TensileTestTable};
use super::own_materials::{self, OwnMaterial};
use super::shared_bodies::number_in;
use crate::body::Body;
use crate::layout::shortened;
use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::numbers::{plain, quantity};
use std::f64::consts::PI;
use std::ops::RangeInclusive;
use toml::Value;

/// Assumed density of the ball without an `[impact]` \[kg/m^3\].
pub const STEEL: f64 = 7850.0;

/// The plausible range of a number of a contact.
struct Expected<'a> {
    range: RangeInclusive<f64>,
    unit: &'static str,
    /// Factors of units that the user may have had in mind, the most likely one first.
    factors: &'static [f64],
    /// Origin of the range.
    why: &'a str,
}

/// From some micrometres, where continuum mechanics ends, to the size of a machine.
const RADIUS: Expected<'static> =
    Expected { range: 1e-6..=2.0, unit: "m", factors: &[1e-3, 1e-6], why: "balls and tips have 1 um to 2 m" };

/// From soft rubber to diamond. A gel is softer, but the moduli of metals in MPa are below, too.
const MODULUS: Expected<'static> = Expected {
    range: 4.6e5..=1.3e12,
    unit: "Pa",
    factors: &[1e9, 1e6, 1e-3, 1e-6],
    why: "metals have 10 to 450 GPa, stones, glasses and ceramics 5 to 600 GPa, polymers 0.5 MPa to 10 GPa",
};

/// From soft polymers to ceramics.
const STRENGTH: Expected<'static> = Expected {
    range: 1e5..=3e10,
    unit: "Pa",
    factors: &[1e6, 1e9, 1e-3, 1e-6],
    why: "metals have 5 MPa to 3 GPa, stones, glasses and ceramics 0.1 to 30 GPa, polymers 1 to 200 MPa",
};

/// The slope of the flow stress over the strain, from soft polymers to the elastic slope of the stiffest solids.
const HARDENING: Expected<'static> = Expected {
    range: 1e5..=1.3e12,
    unit: "Pa",
    factors: &[1e6, 1e9],
    why: "metals harden with 10 MPa to 50 GPa, polymers with 0.1 MPa to 1 GPa",
};

/// From foam to osmium.
const DENSITY: Expected<'static> = Expected {
    range: 20.0..=23_000.0,
    unit: "kg/m^3",
    factors: &[1e3, 1e-3],
    why: "metals have 500 to 23000 kg/m^3, stones and glasses 2000 to 8000, polymers 800 to 2300",
};

/// From a needle to the longest piles.
const LENGTH: Expected<'static> =
    Expected { range: 1e-4..=100.0, unit: "m", factors: &[1e-3, 1e-6], why: "rods have 0.1 mm to 100 m" };

/// From a foil to the wall of a pressure vessel.
const THICKNESS: Expected<'static> =
    Expected { range: 1e-6..=2.0, unit: "m", factors: &[1e-3, 1e-6], why: "plates have 1 um to 2 m" };

/// From a fibre to the cross-section of a building.
const AREA: Expected<'static> =
    Expected { range: 1e-11..=100.0, unit: "m^2", factors: &[1e-6, 1e-4], why: "rods have 4 um to 10 m across" };

/// A yield strength above this fraction of Young's modulus is implausible: no solid with defects has more.
const STRENGTH_OVER_MODULUS: f64 = 0.2;

/// From a ball of the smallest plausible radius and density to one of the largest.
const MASS: Expected<'static> = Expected {
    range: 1e-16..=1e6,
    unit: "kg",
    factors: &[1e-3, 1e-6],
    why: "balls of 1 um to 2 m have 1e-16 kg to 1000 t",
};

/// Up to the highest drop towers; a body may also fall by a fraction of its size.
const DROP_HEIGHT: Expected<'static> =
    Expected { range: 0.0..=200.0, unit: "m", factors: &[1e-3, 1e-6], why: "drop towers have up to 200 m" };

/// The warnings about `file`, each with its place.
pub fn warnings(file: &SceneFile) -> Vec<Mistake> {
    let mut warnings = Vec::new();
    if let Some(impactor) = &file.impactor {
        warnings.extend(of_body("", Body::Impactor, &impactor.get_ref().0, &file.own));
    }
    if let Some(target) = &file.target {
        warnings.extend(of_body("", Body::Target, target.get_ref(), &file.own));
    }
    for contact in file.contact.iter().flat_map(|contacts| contacts.get_ref()) {
        let contact = contact.get_ref();
        let owner = format!("{}.", contact.name.get_ref());
        warnings.extend(of_body(&owner, Body::Impactor, &contact.impactor.0, &file.own));
        warnings.extend(of_body(&owner, Body::Target, &contact.target, &file.own));
        let mass = contact.effective_mass.as_ref();
        warnings.extend(mass.and_then(|mass| MASS.warning(&format!("{owner}effective_mass"), mass)));
    }
    let impact = file.impact.as_ref().map(Spanned::get_ref);
    warnings.extend(impact.and_then(|impact| SPEED.warning("impact.speed", impact.speed.as_ref()?)));
    warnings.extend(impact.and_then(|impact| DROP_HEIGHT.warning("impact.drop_height", impact.drop_height.as_ref()?)));
    warnings.extend(impact.and_then(|impact| MASS.warning("impact.mass", impact.mass.as_ref()?)));
    let coupling = file.coupling.as_ref().map(Spanned::get_ref);
    let mass = coupling.and_then(|coupling| coupling.effective_mass.as_ref());
    warnings.extend(mass.and_then(|mass| MASS.warning("coupling.effective_mass", mass)));
    warnings.extend(without_strength(file));
    if let Some((radius, density)) = ball(file) {
        let masses =
            [("coupling.effective_mass", mass), ("impact.mass", impact.and_then(|impact| impact.mass.as_ref()))];
        // both are the same mass
        let warning = masses.into_iter().find_map(|(name, mass)| {
            let mass = mass?;
            Some(Mistake(mass.span(), of_ball(name, *mass.get_ref(), radius, density)?))
        });
        warnings.extend(warning);
    }
    for body in file.body.iter().flat_map(|bodies| bodies.get_ref()).map(Spanned::get_ref) {
        let name = format!("body `{}`: ", body.name.get_ref());
        warnings.extend(MASS.warning(&format!("{name}mass"), &body.mass));
        let inertia = body.inertia.as_ref();
        warnings
            .extend(inertia.and_then(|inertia| of_inertia(&format!("{name}inertia"), inertia, *body.mass.get_ref())));
    }
    warnings
}

/// The warning about a target of a metal that has a strength only by its condition, in a scene that gives none and asks for no law.
fn without_strength(file: &SceneFile) -> Option<Mistake> {
    let target = file.target.as_ref()?.get_ref();
    let mut contacts = file.contact.iter().flat_map(|contacts| contacts.get_ref());
    let gives = target.gives_strength() || contacts.any(|contact| contact.get_ref().target.gives_strength());
    let name = target.material.as_ref().filter(|_| !gives && file.law.loading.is_none())?;
    let material = own_materials::find(name, &file.own).ok()?;
    // a brittle one says so itself
    let is_elastic = material.yield_strength.is_none() && material.tension.is_none() && material.hardness.is_none();
    let is_silent = is_elastic && material.warning.is_none();
    let message = format!(
        "target.material = \"{}\" has no strength, so nothing yields (law hertz); hardness, yield_strength or tensile_test gives \
         it one",
        name.get_ref()
    );
    is_silent.then(|| Mistake(name.span(), message))
}

/// Radius \[m\] and density \[kg/m^3\], if it is given, of the impactor of `file`, unless it is a rod.
fn ball(file: &SceneFile) -> Option<(f64, Option<f64>)> {
    let table = &file.impactor.as_ref()?.get_ref().0;
    let of_material = || Some(own_materials::find(table.material.as_ref()?, &file.own).ok()?.density);
    let density = table.density.as_ref().map(|density| *density.get_ref()).or_else(of_material);
    let radius = *table.one_radius()?.get_ref();
    // whoever is wrong about these is asked about them
    let is_known = density.is_none_or(|density| DENSITY.range.contains(&density)) && RADIUS.range.contains(&radius);
    (is_known && table.length.is_none()).then_some((radius, density))
}

/// The warning about the first moment of inertia of a body with this `mass` \[kg\], from its radius of gyration.
fn of_inertia(key: &str, inertia: &Spanned<Value>, mass: f64) -> Option<Mistake> {
    let (first, place) = match inertia.get_ref() {
        Value::Array(moments) => (moments.first()?, "[1]"),
        moment => (moment, ""),
    };
    let moment = number_in(first).ok().filter(|_| mass > 0.0)?;
    let why = format!("the mass is {}, and radii of gyration are 1 um to 10 m", quantity(mass, "kg"));
    // g mm^2 and kg mm^2 of drawing programs, and g cm^2
    let expected =
        Expected { range: 1e-12 * mass..=100.0 * mass, unit: "kg m^2", factors: &[1e-9, 1e-6, 1e-7], why: &why };
    expected.question(&format!("{key}{place}"), moment).map(|message| Mistake(inertia.span(), message))
}

/// The warnings about a `body`. `owner` precedes its name.
fn of_body(owner: &str, body: Body, table: &BodyTable, own: &[OwnMaterial]) -> Vec<Mistake> {
    let radius = table.one_radius();
    let numbers = [
        ("radius", &radius, &RADIUS),
        ("youngs_modulus", &table.youngs_modulus, &MODULUS),
        ("yield_strength", &table.yield_strength, &STRENGTH),
        ("hardening_modulus", &table.hardening_modulus, &HARDENING),
        ("tangent_modulus", &table.tangent_modulus, &HARDENING),
        ("tensile_strength", &table.tensile_strength, &STRENGTH),
        ("plate_thickness", &table.plate_thickness, &THICKNESS),
        ("thickness", &table.thickness, &LENGTH),
        ("density", &table.density, &DENSITY),
        ("length", &table.length, &LENGTH),
        ("area", &table.area, &AREA),
    ];
    let name = format!("{owner}{}", body.name());
    let of_material = table.material.as_ref().and_then(|material| {
        let warning = own_materials::find(material, own).ok()?.warning.as_ref()?;
        Some(Mistake(material.span(), format!("{name}.material = \"{}\": {warning}", material.get_ref())))
    });
    let of_own = table.material.iter().flat_map(|material| of_own_material(material, own));
    // a wide target is nearly flat
    let is_flat = |key: &str, value: f64| key == "radius" && body == Body::Target && value.abs() > *RADIUS.range.end();
    let warning = |(key, value, expected): (&str, &Option<Spanned<f64>>, &Expected)| {
        let value = value.as_ref().filter(|value| !is_flat(key, *value.get_ref()))?;
        expected.warning(&format!("{name}.{key}"), value)
    };
    let mut warnings: Vec<Mistake> = numbers.into_iter().filter_map(warning).collect();
    warnings.extend(of_material);
    warnings.extend(of_own);
    let of_material = || Some(own_materials::find(table.material.as_ref()?, own).ok()?.youngs_modulus);
    let modulus = table.youngs_modulus.as_ref().map(|modulus| *modulus.get_ref()).or_else(of_material);
    warnings.extend(table.tensile_test.iter().flat_map(|test| of_test(&name, test, modulus)));
    warnings.extend(of_power_law(&name, table.power_law.as_ref()));
    if let (Body::Target, true, Some(strength), Some(modulus)) =
        (body, warnings.is_empty(), &table.yield_strength, &table.youngs_modulus)
    {
        warnings.extend(too_strong(owner, strength, modulus));
    }
    warnings
}

/// The warning about the power law of a `body`: its coefficient is the flow stress at a strain of 1.
fn of_power_law(body: &str, law: Option<&Spanned<PowerLawTable>>) -> Option<Mistake> {
    STRENGTH.warning(&format!("{body}.power_law.coefficient"), &law?.get_ref().coefficient)
}

/// The warnings about the tensile test of a `body` with this Young's modulus \[Pa\].
fn of_test(body: &str, test: &Spanned<TensileTestTable>, modulus: Option<f64>) -> Vec<Mistake> {
    let TensileTestTable { proof_stress, tensile_strength, compliance_correction, .. } = test.get_ref();
    let key = |key: &str| format!("{body}.tensile_test.{key}");
    let corrects = compliance_correction.as_ref().is_some_and(|corrects| *corrects.get_ref());
    let numbers = [("proof_stress", proof_stress), ("tensile_strength", tensile_strength)];
    let of_numbers = numbers.into_iter().filter_map(|(name, value)| STRENGTH.warning(&key(name), value.as_ref()?));
    // the largest of many
    let curve = test.get_ref().curve().ok().flatten();
    let most = curve.as_ref().and_then(|curve| curve.points.iter().map(|point| point.1).reduce(f64::max));
    let of_curve = most.and_then(|most| STRENGTH.question(&key("true_stress"), most));
    // whoever is wrong about the stress is asked about that
    let slope = curve.zip(modulus).filter(|_| !corrects && of_curve.is_none());
    let slope = slope.and_then(|(curve, modulus)| curve.slope_off(modulus));
    let of_slope = slope.map(|(_, why)| format!("{body}.tensile_test: {why}"));
    of_numbers.chain(of_curve.into_iter().chain(of_slope).map(|message| Mistake(test.span(), message))).collect()
}

/// The warnings about the numbers of a material that isn't built in, where it is used.
fn of_own_material(name: &Spanned<String>, own: &[OwnMaterial]) -> Vec<Mistake> {
    let Ok(material) = own_materials::find(name, own) else { return Vec::new() };
    if !own.iter().any(|own| std::ptr::eq(&own.material, material)) {
        return Vec::new();
    }
    let numbers = [
        ("youngs_modulus", Some(material.youngs_modulus), &MODULUS),
        ("yield_strength", material.yield_strength, &STRENGTH),
        ("tension.coefficient", material.tension.map(|tension| tension.coefficient), &STRENGTH),
        ("density", Some(material.density), &DENSITY),
    ];
    let warning = |(key, value, expected): (&str, Option<f64>, &Expected)| {
        let message = expected.question(&format!("material `{}`: {key}", shortened(&material.name)), value?)?;
        Some(Mistake(name.span(), message))
    };
    numbers.into_iter().filter_map(warning).collect()
}

impl Expected<'_> {
    /// The warning about the value of `key`, if it is implausible.
    fn warning(&self, key: &str, value: &Spanned<f64>) -> Option<Mistake> {
        self.question(key, *value.get_ref()).map(|message| Mistake(value.span(), message))
    }

    /// The same in words.
    fn question(&self, key: &str, number: f64) -> Option<String> {
        let size = number.abs();
        // numbers that are not allowed are rejected elsewhere
        if !size.is_finite() || size == 0.0 || self.range.contains(&size) {
            return None;
        }
        let meant = self.factors.iter().map(|factor| number * factor).find(|meant| self.range.contains(&meant.abs()));
        let question = meant.map_or(String::new(), |meant| format!("; did you mean {}?", plain(meant)));
        Some(format!("{key} = {} {}{question} ({})", plain(number), self.unit, self.why))
    }
}

/// The warning about a yield strength near Young's modulus, or about a modulus that would fit the strength in another unit.
fn too_strong(owner: &str, strength: &Spanned<f64>, modulus: &Spanned<f64>) -> Option<Mistake> {
    let (number, of_modulus) = (*strength.get_ref(), *modulus.get_ref());
    if !(number > STRENGTH_OVER_MODULUS * of_modulus && number.is_finite() && of_modulus > 0.0) {
        return None;
    }
    let fits = |meant: &f64| MODULUS.range.contains(meant) && number <= STRENGTH_OVER_MODULUS * meant;
    if let Some(meant) = MODULUS.factors.iter().map(|factor| factor * of_modulus).find(fits) {
        let (said, meant) = (plain(of_modulus), plain(meant));
        let message = format!("{owner}target.youngs_modulus = {said} Pa; did you mean {meant}? ({})", MODULUS.why);
        return Some(Mistake(modulus.span(), message));
    }
    let (said, modulus) = (quantity(number, "Pa"), quantity(of_modulus, "Pa"));
    let message = format!(
        "{owner}target.yield_strength = {} ({said}) is more than a fifth of youngs_modulus ({modulus}); no material is as \
         strong as that",
        plain(number)
    );
    Some(Mistake(strength.span(), message))
}

/// Up to the fastest projectiles; the slowest contacts creep.
const SPEED: Expected<'static> =
    Expected { range: 0.0..=3e3, unit: "m/s", factors: &[1e-3], why: "bodies meet at up to 3 km/s" };

/// The warning about a `value` on the command line of the quantity `name`: a speed, or a parameter of the scene.
pub fn of_quantity(name: &str, value: f64) -> Option<String> {
    let expected = match name.rsplit('.').next()? {
        // a wide target is nearly flat
        "radius" if name.starts_with("target") && value.abs() > *RADIUS.range.end() => return None,
        "radius" => &RADIUS,
        "youngs_modulus" => &MODULUS,
        "yield_strength" => &STRENGTH,
        "hardening_modulus" | "tangent_modulus" => &HARDENING,
        "density" => &DENSITY,
        "plate_thickness" => &THICKNESS,
        "speed" => &SPEED,
        "mass" | "effective_mass" => &MASS,
        "drop-height" | "drop_height" => &DROP_HEIGHT,
        _ => return None,
    };
    expected.question(name, value)
}

/// A mass this near to a thousand times that of the ball is one in grams.
const SAME_BALL: f64 = 0.15;

/// The warning about a `mass` \[kg\] that would be that of a solid ball with this radius \[m\] in another unit: grams, milligrams, tonnes.
/// Without a `density` \[kg/m^3\] the ball is of steel. `name` is the name of the mass.
pub fn of_ball(name: &str, mass: f64, radius: f64, density: Option<f64>) -> Option<String> {
    let solid = density.unwrap_or(STEEL) * 4.0 / 3.0 * PI * radius * radius * radius;
    let factors = [(1e-3, "1000 times"), (1e-6, "a million times"), (1e3, "a thousandth of")];
    let (factor, times) = factors.into_iter().find(|(factor, _)| (mass * factor / solid - 1.0).abs() < SAME_BALL)?;
    let ball = if density.is_some() { "a solid ball" } else { "a solid ball of steel" };
    Some(format!(
        "{name} = {} kg is {times} the mass of {ball} of this radius, {}; did you mean {}?",
        plain(mass),
        quantity(solid, "kg"),
        plain(mass * factor)
    ))
}

/// The warning about a kinetic `energy` \[J\] of a `mass` \[kg\]: the speed that it gives; `name` is its name on the command line.
pub fn of_energy(name: &str, energy: f64, mass: f64) -> Option<String> {
    let most = 0.5 * mass * SPEED.range.end() * SPEED.range.end();
    let why = format!("the mass is {}, and {}", quantity(mass, "kg"), SPEED.why);
    Expected { range: 0.0..=most, unit: "J", factors: &[1e-3, 1e-6], why: &why }.question(name, energy)
}

/// The warning about the depth \[m\] of a dent by an impactor with this `radius` \[m\]; `name` is its name on the command line.
pub fn of_depth(name: &str, depth: f64, radius: f64) -> Option<String> {
    let why = "an atom has 0.1 nm, and no dent is deeper than the impactor's radius";
    Expected { range: 1e-10..=radius, unit: "m", factors: &[1e-3, 1e-6], why }.question(name, depth)
}
