//! Yield strength and hardening of the bodies: the ways to give them, and what they are in the scene's impact.

use super::file::{BodyTable, PowerLawTable, RateTable, TensileTestTable};
use super::quantities::quantity_of;
use crate::body::Body;
use crate::layout::shortened;
use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::nearest::unknown;
use crate::numbers::{in_message, in_range, quantity};
use crate::reading;
use crate::table::{Class, Material};
use crate::tension::{self, Curve};
use brinell_contact::material::hardening::{Hardening, StraightLine, modulus_of_tangent};
use brinell_contact::rate::FIRST_STRAIN;
use std::ops::Range;

use crate::measured::{self, MeasuredStrength, Metal, TEST_RATE};
pub use brinell_contact::material::hardening::PowerLaw;
pub use brinell_contact::rate::Rate;

/// A hardening that stands in each impact for yield strength and hardening modulus, by its strain.
#[derive(Clone, Debug)]
pub enum Flow {
    /// A power law, as a straight line up to the strain.
    Line(PowerLaw),
    /// The flow stress at the strain, and of a tensile test the tangent there.
    Measured(MeasuredStrength),
}

impl Flow {
    /// The straight line up to this `strain`, if it is one.
    pub(super) fn line(&self, strain: f64) -> Option<StraightLine> {
        match self {
            Flow::Line(law) => Some(law.up_to(strain)),
            Flow::Measured(_) => None,
        }
    }

    /// The same at a flow stress of `factor` times this one, at every strain.
    pub(super) fn times(&self, factor: f64) -> Flow {
        match self {
            Flow::Line(law) => Flow::Line(PowerLaw { coefficient: factor * law.coefficient, ..*law }),
            Flow::Measured(measured) => {
                let mut scaled = measured.clone();
                scaled.stress *= factor;
                Flow::Measured(scaled)
            }
        }
    }

    /// The reading that it is from, if it is from one.
    pub fn measured(&self) -> Option<&MeasuredStrength> {
        match self {
            Flow::Line(_) => None,
            Flow::Measured(measured) => Some(measured),
        }
    }

    /// The hardening in an impact with this `strain`.
    pub(super) fn at(&self, strain: f64) -> Hardening {
        match self {
            Flow::Line(law) => law.up_to(strain).hardening(),
            Flow::Measured(measured) => measured.hardening(strain),
        }
    }
}

/// Young's modulus, Poisson's ratio and the class of a body, by which a reading is understood.
pub struct Elastic<'a> {
    pub youngs_modulus: Option<&'a Spanned<f64>>,
    pub poissons_ratio: Option<&'a Spanned<f64>>,
    pub material: Option<&'a Material>,
    /// Whether the law of the scene takes hardening.
    pub hardens: bool,
    /// Whether the body hardens in all contacts, so that a contact where it doesn't says so.
    pub hardens_above: bool,
}

impl Elastic<'_> {
    fn metal(&self, exponent: Option<f64>) -> Option<Metal> {
        let (youngs_modulus, poissons_ratio) = (*self.youngs_modulus?.get_ref(), *self.poissons_ratio?.get_ref());
        let class = self.material.and_then(|material| material.class).unwrap_or(Class::of_modulus(youngs_modulus));
        Some(Metal { youngs_modulus, poissons_ratio, class, exponent })
    }
}

impl BodyTable {
    /// The places of its readings, with their keys.
    fn readings(&self) -> impl Iterator<Item = (&'static str, Range<usize>)> {
        let hardness = self.hardness.as_ref().map(|hardness| ("hardness", hardness.span()));
        let strength = self.tensile_strength.as_ref().map(|strength| ("tensile_strength", strength.span()));
        let test = self.tensile_test.as_ref().map(|test| ("tensile_test", test.span()));
        hardness.into_iter().chain(strength).chain(test)
    }

    /// The strength that its hardness, tensile strength or tensile test says, with its place.
    pub fn measured(&self, body: Body, elastic: &Elastic) -> Result<Option<Spanned<MeasuredStrength>>, Mistake> {
        let name = body.name();
        let mut readings = self.readings();
        let Some((key, span)) = readings.next() else {
            let has_other = self.strengths().iter().any(|(_, value)| value.is_some()) || self.power_law.is_some();
            let material = self.material.as_ref().zip(elastic.material).filter(|_| !has_other);
            return Ok(material.and_then(|(place, material)| {
                let found = measured::of_material(material, &elastic.metal(None)?)?;
                Some(Spanned::new(place.span(), found))
            }));
        };
        let wrong = |why: String| Mistake(span.clone(), format!("{name}.{key}{why}"));
        let exponent = self.hardening_exponent.as_ref().map(|exponent| *exponent.get_ref());
        // a body without moduli is against the rules
        let Some(metal) = elastic.metal(exponent) else { return Ok(None) };
        let found = match (&self.hardness, &self.tensile_strength) {
            (Some(hardness), _) => match hardness.get_ref() {
                toml::Value::String(text) => measured::of_hardness(text, &metal)
                    .map_err(|why| wrong(format!(" = \"{}\": {why}", shortened(text))))?,
                other => {
                    return Err(wrong(format!(
                        " = {other}: write the number with its scale, such as {}",
                        reading::SCALES
                    )));
                }
            },
            (None, Some(strength)) => {
                measured::of_tensile_strength(*strength.get_ref(), &metal).map_err(|why| wrong(format!(": {why}")))?
            }
            (None, None) => {
                let Some(test) = &self.tensile_test else { return Ok(None) };
                test.get_ref()
                    .strength(&format!("{name}.tensile_test"), &metal, elastic.hardens)
                    .map_err(|TestMistake(place, why)| Mistake(place.unwrap_or(span.clone()), why))?
            }
        };
        Ok(Some(Spanned::new(span, found)))
    }

    fn strengths(&self) -> [(&'static str, Option<&Spanned<f64>>); 3] {
        [
            ("yield_strength", self.yield_strength.as_ref()),
            ("hardening_modulus", self.hardening_modulus.as_ref()),
            ("tangent_modulus", self.tangent_modulus.as_ref()),
        ]
    }

    /// Whether it says anything about the strength, beside a material.
    pub fn gives_strength(&self) -> bool {
        let given = self.strengths().iter().any(|(_, value)| value.is_some()) || self.readings().next().is_some();
        given || self.power_law.is_some() || self.rate.is_some()
    }

    /// Yield strength and hardening modulus \[Pa\] of this `body`. They are given by two numbers, by a tangent modulus, by a power law,
    /// or by a reading; until the impact is known, what belongs to the first strain represents these two.
    pub fn flow(&self, body: Body, elastic: &Elastic) -> Result<[Option<Spanned<f64>>; 2], Mistake> {
        if let Some(measured) = self.measured(body, elastic)? {
            let Hardening { yield_strength, hardening_modulus } = measured.get_ref().hardening(FIRST_STRAIN);
            let modulus = Some(hardening_modulus).filter(|_| measured.get_ref().hardens() || elastic.hardens_above);
            return Ok([Some(yield_strength), modulus].map(|value| Some(Spanned::new(measured.span(), value?))));
        }
        if let Some(table) = &self.power_law {
            let line = power_law(table).up_to(FIRST_STRAIN);
            return Ok(
                [line.yield_strength, line.hardening_modulus].map(|value| Some(Spanned::new(table.span(), value)))
            );
        }
        let hardening_modulus = match &self.tangent_modulus {
            Some(tangent) => Some(self.of_tangent(body, tangent, elastic.youngs_modulus)?),
            None => self.hardening_modulus.clone(),
        };
        Ok([self.yield_strength.clone(), hardening_modulus])
    }

    /// The hardening modulus for a `tangent` modulus.
    fn of_tangent(
        &self,
        body: Body,
        tangent: &Spanned<f64>,
        youngs_modulus: Option<&Spanned<f64>>,
    ) -> Result<Spanned<f64>, Mistake> {
        let body = body.name();
        let wrong = |message: String| Err(Mistake(tangent.span(), message));
        let modulus = youngs_modulus.map_or(f64::INFINITY, |modulus| *modulus.get_ref());
        let given = *tangent.get_ref();
        // NaN is outside every range
        if !(0.0..modulus).contains(&given) {
            return wrong(format!(
                "{body}.tangent_modulus = {} is out of range: allowed is 0 to below youngs_modulus = {} Pa",
                in_message(given),
                in_message(modulus)
            ));
        }
        Ok(Spanned::new(tangent.span(), modulus_of_tangent(given, modulus)))
    }
}

/// What is wrong with a tensile test: its place, if that isn't the whole table, and why.
struct TestMistake(Option<Range<usize>>, String);

impl TensileTestTable {
    /// The strength of a `metal` by this test, whose key is called `name`.
    fn strength(&self, name: &str, metal: &Metal, hardens: bool) -> Result<MeasuredStrength, TestMistake> {
        let wrong = |why: String| TestMistake(None, format!("{name}: {why}"));
        let Metal { youngs_modulus, .. } = *metal;
        let curve = self.curve().map_err(wrong)?;
        let corrects = self.compliance_correction.as_ref();
        if let Some(key) = corrects.filter(|_| curve.is_none()) {
            let why = format!("{name}.compliance_correction belongs to a curve");
            return Err(TestMistake(Some(key.span()), why));
        }
        let (given, test) = match (self, curve) {
            (TensileTestTable { proof_stress: None, tensile_strength: None, .. }, Some(curve)) => {
                let corrects = corrects.is_some_and(|corrects| *corrects.get_ref());
                let test = tension::through_curve(&curve, youngs_modulus, corrects).map_err(wrong)?;
                ("A tensile test".into(), test)
            }
            (TensileTestTable { proof_stress: Some(proof), tensile_strength: Some(strength), .. }, None) => {
                let [proof, strength] = [*proof.get_ref(), *strength.get_ref()];
                let test = tension::through_two(proof, strength, youngs_modulus).map_err(wrong)?;
                let [proof, strength] = [proof, strength].map(|stress| quantity(stress, "Pa"));
                (format!("A tensile test with a proof stress of {proof} and a tensile strength of {strength}"), test)
            }
            _ => return Err(wrong(WAYS.into())),
        };
        measured::of_tensile_test(&given, test, hardens, metal).map_err(wrong)
    }

    /// The points of its curve, if it has one.
    pub fn curve(&self) -> Result<Option<Curve>, String> {
        let of_file = self.curve.as_ref().map(Spanned::get_ref);
        let own = (&self.true_strain, &self.plastic_strain, &self.true_stress);
        let keys = match (of_file, own) {
            (Some(curve), (None, None, None)) => (&curve.true_strain, &curve.plastic_strain, &curve.true_stress),
            (None, _) if self.section.is_some() || self.gauge_length.is_some() => {
                return Err(
                    "section and gauge_length belong to the force and the travel of a curve = \"test.csv\"".into()
                );
            }
            (None, own) => own,
            _ => return Err(WAYS.into()),
        };
        let (strain, stress, is_plastic) = match keys {
            (None, None, None) => return Ok(None),
            (Some(strain), None, Some(stress)) => (strain.get_ref(), stress.get_ref(), false),
            (None, Some(strain), Some(stress)) => (strain.get_ref(), stress.get_ref(), true),
            _ => return Err(WAYS.into()),
        };
        if strain.len() != stress.len() {
            return Err(format!("{} strains and {} stresses: each point has both", strain.len(), stress.len()));
        }
        let points: Vec<_> = strain.iter().copied().zip(stress.iter().copied()).collect();
        let [strains, stresses] = ["true_strain", "true_stress"].map(|key| quantity_of("tensile_test", key).allowed);
        let is_one = |(strain, stress): &(f64, f64)| strains.contains(strain) && stresses.contains(stress);
        if let Some((strain, stress)) = points.iter().find(|point| !is_one(point)) {
            let [strain, stress] = [*strain, *stress].map(in_message);
            return Err(format!(
                "the point with a strain of {strain} and a stress of {stress} Pa is out of range: allowed are {}, and {} Pa",
                in_range(&strains),
                in_range(&stresses)
            ));
        }
        Ok(Some(Curve { points, is_plastic }))
    }
}

/// The ways to give a tensile test.
const WAYS: &str = "it is the name of a file; or has curve, the name of a file; or proof_stress and tensile_strength; or true_strain (or \
                    plastic_strain) and true_stress";

fn power_law(table: &Spanned<PowerLawTable>) -> PowerLaw {
    let PowerLawTable { coefficient, exponent } = table.get_ref();
    PowerLaw { coefficient: *coefficient.get_ref(), exponent: *exponent.get_ref() }
}

/// The names of the models in scenes.
pub const MODELS: [&str; 2] = ["johnson-cook", "cowper-symonds"];

/// The rate model of a `body` of the scene.
pub fn check_rate(
    body: Body,
    table: &Spanned<RateTable>,
    measured: Option<&MeasuredStrength>,
) -> Result<Spanned<Rate>, Mistake> {
    let RateTable { model, c, reference_rate, d, q } = table.get_ref();
    let owner = format!("{}.rate", body.name());
    if let Some(MeasuredStrength { given, .. }) = measured.filter(|measured| measured.has_rate) {
        let message =
            format!("{owner} has no place beside {given}: the test was an impact, whose rate is in the strength");
        return Err(Mistake(table.span(), message));
    }
    let slow = Spanned::new(table.span(), TEST_RATE);
    let reference_rate = &match (measured, reference_rate) {
        (Some(_), None) if model.get_ref() == "johnson-cook" => Some(slow),
        (Some(MeasuredStrength { given, .. }), Some(other)) if *other.get_ref() != TEST_RATE => {
            let message = format!(
                "{owner}.reference_rate = {}: the strength from {given} is that of a test at about {TEST_RATE} 1/s, so leave it out",
                in_message(*other.get_ref())
            );
            return Err(Mistake(other.span(), message));
        }
        _ => reference_rate.clone(),
    };
    let number = |value: &Option<Spanned<f64>>| value.as_ref().map_or(f64::NAN, |value| *value.get_ref());
    let rate = match (model.get_ref().as_str(), reference_rate) {
        ("johnson-cook", Some(reference)) => Rate::JohnsonCook { c: number(c), reference_rate: *reference.get_ref() },
        ("johnson-cook", None) => {
            let message = format!("{owner} with model = \"johnson-cook\" needs reference_rate");
            return Err(Mistake(table.span(), message));
        }
        ("cowper-symonds", _) => Rate::CowperSymonds { d: number(d), q: number(q) },
        (other, _) => return Err(Mistake(model.span(), unknown(&format!("{owner}.model"), other, MODELS.into_iter()))),
    };
    Ok(Spanned::new(table.span(), rate))
}

/// The hardening of a `body` that depends on the strain, by its `table`.
pub fn flow_of(body: Body, table: &BodyTable, elastic: &Elastic) -> Result<Option<Flow>, Mistake> {
    let measured = table.measured(body, elastic)?;
    let power_law = table.power_law.as_ref().map(power_law);
    Ok(power_law.map(Flow::Line).or(measured.map(|measured| Flow::Measured(measured.into_inner()))))
}
