//! Yield strength and hardening of the bodies: the ways to give them, and what they are in the scene's impact.

use super::Scene;
use super::bodies::{Body, Both};
use super::file::{BodyTable, PowerLawTable, RateTable, TensileTestTable};
use super::quantities::quantity_of;
use crate::layout::shortened;
use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::model::{AnyModel, paired};
use crate::nearest::unknown;
use crate::numbers::{cell, in_message, in_range, quantity};
use crate::table::{Class, Material};
use crate::tension::{self, Curve};
use brinell_contact::hardening::{Hardening, StraightLine, modulus_of_tangent};
use brinell_contact::impact::{Impact, Prediction};
use brinell_contact::loading::AnyLoading;
use brinell_contact::rate::{self, FIRST_STRAIN, Factors, Strains};
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Model, OtherBody, Pair, TwoBodies};
use serde::Serialize;
use std::ops::Range;

use crate::measured::{self, MeasuredStrength, Metal, STEEL_RATE, TEST_RATE};
pub use brinell_contact::hardening::PowerLaw;
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
    fn line(&self, strain: f64) -> Option<StraightLine> {
        match self {
            Flow::Line(law) => Some(law.up_to(strain)),
            Flow::Measured(_) => None,
        }
    }

    /// The same at a flow stress of `factor` times this one, at every strain.
    fn times(&self, factor: f64) -> Flow {
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
    fn at(&self, strain: f64) -> Hardening {
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
                        measured::SCALES
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

/// The strength of the softer body of a group in an impact.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct InImpact {
    /// Yield strength and hardening modulus \[Pa\], including the factor.
    pub yield_strength: f64,
    pub hardening_modulus: f64,
    /// The straight line that approximates a power law, without the factor.
    pub line: Option<StraightLine>,
    /// Mean strain rate of the softer body while loading [1/s].
    pub strain_rate: f64,
    /// Flow stress of the softer body relative to the quasi-static one.
    pub factor: f64,
    /// The same of both bodies.
    #[serde(skip)]
    pub factors: Factors,
    /// Tabor's strains of both bodies.
    #[serde(skip)]
    pub strains: Strains,
    /// Radius of the rigid sphere that the softer body sees \[m\].
    #[serde(skip)]
    pub indenter_radius: f64,
}

impl Scene {
    /// The strain-rate dependence of the strength of the softer body of `group`.
    pub fn rate(&self, group: usize) -> Option<Rate> {
        *self.rates.of(self.softer(group))
    }

    /// The power law by which the softer body of `group` hardens, if it has no strength of its own.
    pub fn power_law(&self, group: usize) -> Option<PowerLaw> {
        match self.flow_of(group, self.softer(group))? {
            Flow::Line(law) => Some(*law),
            Flow::Measured(_) => None,
        }
    }

    /// The reading from which a `body` of `group` has its strength, if it has no strength of its own.
    pub fn measured(&self, group: usize, body: Body) -> Option<&MeasuredStrength> {
        match self.flow_of(group, body)? {
            Flow::Line(_) => None,
            Flow::Measured(measured) => Some(measured),
        }
    }

    /// The yield strength \[Pa\] of the softer body of the first contact for a law that the scene needn't have: a law without hardening
    /// takes the flow stress of a tensile test, rather than its tangent.
    pub fn yield_strength_for(&self, law: &AnyLoading) -> Option<f64> {
        let strength = self.yield_strength?;
        let measured = self.measured(0, self.softer(0)).filter(|_| !law.takes_both_bodies());
        Some(measured.map_or(strength, |measured| measured.without_hardening(strength)))
    }

    /// What was made of the reading of a `body` of `group`, and of the softer one its flow stress at the strain `found`.
    pub fn measured_words(&self, group: usize, body: Body, found: &InImpact) -> Option<String> {
        let measured = self.measured(group, body)?;
        let words = format!("{}: {}.", body.name(), measured.words());
        if body != self.softer(group) {
            return Some(words);
        }
        let strain = found.strains.softer;
        let beyond = measured
            .tension
            .as_ref()
            .map(|test| test.range)
            .filter(|(least, most)| !(*least..=*most).contains(&strain));
        let beyond = beyond.map_or(String::new(), |(least, most)| {
            format!(" The test has strains of {} to {}; this one is outside.", cell(least, 1.0), cell(most, 1.0))
        });
        let tangent = if measured.hardens() {
            let Hardening { yield_strength, hardening_modulus } = measured.hardening(strain);
            let [strength, modulus] = [yield_strength, hardening_modulus].map(|stress| quantity(stress, "Pa"));
            format!("; its tangent there is S = {strength}, H = {modulus}")
        } else {
            String::new()
        };
        let (at, strain) = (quantity(measured.at(strain), "Pa"), cell(strain, 1.0));
        Some(format!("{words} At the strain of this impact, Tabor's 0.2 a/R = {strain}, it is {at}{tangent}.{beyond}"))
    }

    /// Whether the rate of the softer body of `group` is that which its class of metal has if the scene says nothing.
    pub fn assumes_rate(&self, group: usize) -> bool {
        let softer = self.softer(group);
        self.measured(group, softer).is_some_and(MeasuredStrength::is_slow_steel)
            && *self.rates.of(softer) == Some(STEEL_RATE)
    }

    /// The hardening of a `body` of `group` that depends on the strain of the impact.
    fn flow_of(&self, group: usize, body: Body) -> Option<&Flow> {
        self.contacts[group].flows.of(body).as_deref()
    }

    /// The hardening that the scene gives for the softer body of `group`.
    pub fn quasi_static(&self, group: usize) -> Hardening {
        *self.quasi_static[group].of(self.softer(group))
    }

    /// Whether the strength of a body depends on the impact.
    pub fn depends_on_impact(&self) -> bool {
        let has_flow = |body: Body| self.contacts.iter().any(|group| group.flows.of(body).is_some());
        Body::ALL.into_iter().any(|body| self.rates.of(body).is_some() || has_flow(body))
    }

    /// The strength of the softer body of `group` in an `impact`. It is a fixed point, since depth and duration of the
    /// impact depend on the strength. The strain of each body is Tabor's, `0.2 a/R_i` at the largest contact radius. The strain rate
    /// is this strain over the loading time. `None` beyond the range of the law.
    pub fn in_impact(&self, group: usize, impact: &Impact) -> Option<InImpact> {
        let softer = self.softer(group);
        let predict = |strains, factors| {
            let model = self.with_strengths_at(group, strains, factors);
            // that of an impact without the loss, as an FMU finds it
            let prediction = AnyModel::Elastoplastic(model).predict(impact)?;
            Some((prediction.loading_time, rate::strains(&model, &prediction)))
        };
        let rates = [softer, softer.other()].map(|body| self.rates.of(body).as_ref());
        let found = rate::in_impact(rates, (rate::FIRST, Factors::SLOW), predict)?;
        let rate::InImpact { strains, factors, .. } = found;
        let line = self.flow_of(group, softer).and_then(|flow| flow.line(strains.softer));
        let Hardening { yield_strength, hardening_modulus } =
            self.flow_at(group, softer, strains.softer).times(factors.softer);
        let share = strains.softer / (strains.softer + strains.harder);
        Some(InImpact {
            yield_strength,
            hardening_modulus,
            line,
            strain_rate: found.strain_rate(),
            factor: factors.softer,
            factors,
            strains,
            indenter_radius: self.pair_of(group)?.radius / share,
        })
    }

    /// The hardening of a `body` of `group` under a slow load: what belongs to this `strain`, or what the scene gives.
    fn flow_at(&self, group: usize, body: Body, strain: f64) -> Hardening {
        self.flow_of(group, body).map_or(*self.quasi_static[group].of(body), |flow| flow.at(strain))
    }

    /// The contacts of `group` with the hardening of their bodies for these strains, and these factors on it.
    pub fn with_strengths_at(
        &self,
        group: usize,
        strains: Strains,
        factors: Factors,
    ) -> Model<AnyLoading, AnyUnloading> {
        let softer = self.softer(group);
        let own = self.flow_at(group, softer, strains.softer).times(factors.softer);
        let other = self.flow_at(group, softer.other(), strains.harder).times(factors.harder);
        let model = self.unpaired_model_of(group);
        let pair = Pair { yield_strength: own.yield_strength, ..model.pair };
        let Hardening { yield_strength, hardening_modulus } = other;
        let (bodies, hardening) = (self.two_bodies(group), self.hardening_factor(group));
        let hardening_modulus = hardening * hardening_modulus;
        let other = OtherBody { yield_strength, hardening_modulus, ..bodies.other };
        let bodies = TwoBodies { hardening_modulus: hardening * own.hardening_modulus, other, ..bodies };
        paired(&Model { pair, ..model }, bodies, softer).prepared()
    }

    /// The prediction of `impact` on the first contact with the straight lines for `part` of the strains `found`.
    pub fn predict_with_strain(&self, impact: &Impact, found: &InImpact, part: f64) -> Option<Prediction> {
        let Strains { softer, harder } = found.strains;
        let strains = Strains { softer: part * softer, harder: part * harder };
        self.with_loss(0, self.with_strengths_at(0, strains, found.factors)).predict(impact)
    }

    /// The scene with the strengths that its softer bodies have in its own impact, or all of them in the given one. `None`
    /// beyond the range of the law.
    pub fn with_strengths_for(self, given: Option<&Impact>) -> Option<Scene> {
        if !self.depends_on_impact() {
            return Some(self);
        }
        let impact = |group: usize| given.copied().unwrap_or_else(|| self.impact_of(group));
        let found = self.by_bodies(|group| self.in_impact(group, &impact(group)));
        let found: Vec<InImpact> = found.into_iter().collect::<Option<_>>()?;
        Some(self.with_strengths(&found))
    }

    /// The scene's first contact alone, with a `body` whose strength is so many times as high at every strain. `None` if it has none.
    pub fn with_strength_of(mut self, body: Body, factor: f64) -> Option<Scene> {
        let is_strength = factor > 0.0;
        if !is_strength {
            return None;
        }
        self.contacts.truncate(1);
        let is_softer = body == self.softer(0);
        if let Some(flow) = self.flow_of(0, body) {
            let scaled = flow.times(factor).into();
            let flows = &mut self.contacts[0].flows;
            *(if body == Body::Impactor { &mut flows.impactor } else { &mut flows.target }) = Some(scaled);
            return Some(self);
        }
        self.group_value(0, body.yield_strength())?;
        let strengths = [body.yield_strength(), body.hardening_modulus()];
        let own = self.contacts[0].own.iter_mut();
        for parameter in self.parameters.iter_mut().chain(own).filter(|parameter| strengths.contains(&parameter.name)) {
            parameter.value *= factor;
        }
        let slow = &mut self.quasi_static[0];
        let slow = if body == Body::Impactor { &mut slow.impactor } else { &mut slow.target };
        *slow = slow.times(factor);
        self.yield_strength = self.yield_strength.map(|strength| if is_softer { factor * strength } else { strength });
        Some(self)
    }

    /// The scene with the strengths that its bodies have under a slow load. A power law keeps the straight line of the
    /// scene's impact. `None` beyond the range of the law.
    pub fn under_slow_load(self) -> Option<Scene> {
        if !self.depends_on_impact() {
            return Some(self);
        }
        let slow = |group: usize| {
            let found = self.in_impact(group, &self.impact_of(group))?;
            let hardening = self.flow_at(group, self.softer(group), found.strains.softer);
            let Hardening { yield_strength, hardening_modulus } = hardening;
            let factors = Factors::SLOW;
            Some(InImpact { yield_strength, hardening_modulus, factor: 1.0, factors, strain_rate: 0.0, ..found })
        };
        let found: Vec<InImpact> = self.by_bodies(slow).into_iter().collect::<Option<_>>()?;
        Some(self.with_strengths(&found))
    }

    /// The scene with the strengths `found` for the softer body of each group.
    fn with_strengths(mut self, found: &[InImpact]) -> Scene {
        let finds = self.finds_strength();
        let flows = |group| Both::each(|body| self.flow_in(group, body, &found[group]));
        let flows: Vec<_> = (0..self.contacts.len()).map(flows).collect();
        let set = |parameters: &mut [super::Parameter], flow: &Both<Hardening>| {
            for parameter in parameters {
                for (body, flow) in Body::ALL.map(|body| (body, flow.of(body))) {
                    match parameter.name {
                        name if name == body.yield_strength() => parameter.value = flow.yield_strength,
                        name if name == body.hardening_modulus() => parameter.value = flow.hardening_modulus,
                        _ => {}
                    }
                }
            }
        };
        // the strength of all contacts is that of the first one without its own
        let shared = Both::each(|body| {
            let has_own = |group: &super::Group| group.own.iter().any(|own| own.name == body.yield_strength());
            let first = self.contacts.iter().position(|group| !has_own(group));
            *flows[first.unwrap_or(0)].of(body)
        });
        set(&mut self.parameters, &shared);
        for (contacts, flow) in self.contacts.iter_mut().zip(&flows) {
            set(&mut contacts.own, flow);
        }
        if finds {
            self.factors = found.iter().map(|found| found.factors).collect();
        }
        self.yield_strength = Some(found[0].yield_strength);
        self
    }

    /// Yield strength and hardening modulus of a `body` of `group` as parameters of the unit, for the strain and the strain rate
    /// `found` in the impact.
    fn flow_in(&self, group: usize, body: Body, found: &InImpact) -> Hardening {
        let (strain, factor) = match body == self.softer(group) {
            true => (found.strains.softer, found.factors.softer),
            false => (found.strains.harder, found.factors.harder),
        };
        self.flow_at(group, body, strain).times(if self.finds_strength() { 1.0 } else { factor })
    }

    /// The scene under a slow load, of which a unit finds the strengths.
    pub fn without_factors(mut self) -> Scene {
        self.factors.fill(Factors::SLOW);
        self
    }

    /// The contacts of `group`, of the model `slow` under a slow load, as they resist fast indentation.
    pub fn at_any_rate<M>(&self, group: usize, slow: M) -> rate::Model<M> {
        let softer = self.softer(group);
        let [rate, harder] = [softer, softer.other()].map(|body| self.rates.of(body).unwrap_or(Rate::NONE));
        rate::Model { slow, rate, harder }
    }

    /// Whether the unit finds the strength of its bodies by itself, at the first touch of each impact: it knows the mass and
    /// moves the bodies.
    pub fn finds_strength(&self) -> bool {
        let has_rate = self.rates.impactor.is_some() || self.rates.target.is_some();
        has_rate && self.coupling.is_some()
    }
}
