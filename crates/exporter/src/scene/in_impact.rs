//! The strength of the bodies in an impact: at its strain and its strain rate.

use super::checked::{Group, Parameter, Scene};
use super::strength::Flow;
use crate::body::{Body, Both};
use crate::measured::{MeasuredStrength, STEEL_RATE};
use crate::model::{AnyModel, paired};
use crate::numbers::{cell, quantity};
use brinell_contact::impact::{Impact, Prediction};
use brinell_contact::loading::AnyLoading;
use brinell_contact::material::hardening::{Hardening, PowerLaw, StraightLine};
use brinell_contact::rate::{self, Factors, Rate, Strains};
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Model, OtherBody, Pair, TwoBodies};
use serde::Serialize;

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
            *self.contacts[0].flows.of_mut(body) = Some(scaled);
            return Some(self);
        }
        self.group_value(0, body.yield_strength())?;
        let strengths = [body.yield_strength(), body.hardening_modulus()];
        let own = self.contacts[0].own.iter_mut();
        for parameter in self.parameters.iter_mut().chain(own).filter(|parameter| strengths.contains(&parameter.name)) {
            parameter.value *= factor;
        }
        let slow = self.quasi_static[0].of_mut(body);
        *slow = slow.times(factor);
        self.yield_strength = self.yield_strength.map(|strength| if is_softer { factor * strength } else { strength });
        Some(self)
    }

    /// The constant `target.rate.c` or `d` of a body's rate model in `rates`.
    fn constant_in<'a>(rates: &'a mut Both<Option<Rate>>, name: &str) -> Option<&'a mut f64> {
        let (body, constant) = name.split_once(".rate.")?;
        let body = Body::ALL.into_iter().find(|known| known.name() == body)?;
        match (rates.of_mut(body), constant) {
            (Some(Rate::JohnsonCook { c, .. }), "c") => Some(c),
            (Some(Rate::CowperSymonds { d, .. }), "d") => Some(d),
            _ => None,
        }
    }

    /// The constant of a body's rate model with this `name`, if the body has it.
    pub fn rate_constant(&self, name: &str) -> Option<f64> {
        Self::constant_in(&mut self.rates.clone(), name).copied()
    }

    /// The scene with these values of parameters of its first contact, whether or not it names them. A strength is that under a slow
    /// load, in place of any reading or power law. `None` if the bodies then don't touch in one point.
    pub fn with_values(mut self, values: &[(&'static str, f64)]) -> Option<Scene> {
        for &(name, value) in values {
            if let Some(constant) = Self::constant_in(&mut self.rates, name) {
                *constant = value;
                continue;
            }
            let own = self.contacts[0].own.iter_mut();
            if let Some(parameter) = own.chain(&mut self.parameters).find(|parameter| parameter.name == name) {
                parameter.value = value;
            } else {
                self.contacts[0].own.push(Parameter::shared(name, value, false));
            }
        }
        for body in Body::ALL {
            let names = [body.yield_strength(), body.hardening_modulus()];
            if values.iter().any(|(name, _)| names.contains(name)) {
                let [strength, hardening] = names.map(|name| self.group_value(0, name));
                let (yield_strength, hardening_modulus) = (strength.unwrap_or(f64::INFINITY), hardening.unwrap_or(0.0));
                *self.quasi_static[0].of_mut(body) = Hardening { yield_strength, hardening_modulus };
                *self.contacts[0].flows.of_mut(body) = None;
            }
        }
        self.yield_strength = self.group_value(0, self.softer(0).yield_strength()).or(self.yield_strength);
        self.pair_of(0)?;
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
        let set = |parameters: &mut [Parameter], flow: &Both<Hardening>| {
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
            let has_own = |group: &Group| group.own.iter().any(|own| own.name == body.yield_strength());
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
