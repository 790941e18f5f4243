//! Derivatives: of inputs and outputs with respect to time, and of outputs with respect to the input.

use super::variables::of_state;
use super::*;
use crate::scene::Real;
use brinell_contact::Regime;
use brinell_contact::behaviour::slopes;
use brinell_contact::history::path::RatePolynomial;
use brinell_contact::numerics::largest;
use brinell_contact::tangential::Quantity;
use core::f64::consts::PI;

impl<S: Scene> Instance<S> {
    /// The highest order of the derivative of an input.
    #[inline(always)]
    pub fn input_order() -> i32 {
        if S::moves() { 1 } else { 2 }
    }

    /// Checks whether the derivative of this `order` of an input may be set to `value` now.
    ///
    /// # Errors
    /// [`Fault::NoDerivative`] for another variable, [`Fault::DerivativeOrder`], [`Fault::NotFinite`],
    /// [`Fault::AccelerationOutOfRange`];
    /// [`Fault::NoInputDerivatives`] for a rate-dependent law, where the acceleration is an input, and where the scene doesn't want
    /// them.
    pub fn check_input_derivative(&self, (variable, _): (Real, usize), order: i32, value: f64) -> Result<(), Fault> {
        if !S::has_course() || S::has_input(Real::ExternalAcceleration) {
            return Err(Fault::NoInputDerivatives);
        }
        let (inputs, name) = match variable {
            _ if !S::Contact::HAS_FRICTION => ("indentation_rate", "a derivative of indentation_rate"),
            _ if variable.tangential_rate().is_some() => ("", "a derivative of tangential_rate"),
            _ => ("indentation_rate and tangential_rate", "a derivative of indentation_rate"),
        };
        let is_tangential = S::has_input(variable) && variable.tangential_rate().is_some();
        if variable != Real::IndentationRate && !is_tangential {
            return Err(Fault::NoDerivative { of: inputs });
        }
        check_order(order, Self::input_order())?;
        check_acceleration(name, if order == 1 { "m/s^2" } else { "m/s^3" }, value)
    }

    /// Sets a derivative that [`Instance::check_input_derivative`] has accepted. It applies to the next step.
    pub fn set_input_derivative(&mut self, (variable, contact): (Real, usize), order: i32, value: f64) {
        if value != 0.0 || self.clock.curved {
            self.curve();
            if S::Contact::HAS_FRICTION
                && let Some(direction) = variable.tangential_rate()
            {
                return self.set_tangential_derivative(contact, direction, order, value);
            }
            if let Some(curve) = self.contacts.curves.as_mut().get_mut(contact) {
                *(if order == 1 { &mut curve.slope } else { &mut curve.bend }) = value;
            }
        }
    }

    /// Sets derivatives of the input of a single contact, given with their orders, and returns true, provided that no further
    /// checks are needed: they may be set now and are in range. Otherwise it sets none and returns false.
    #[inline(always)]
    pub fn set_plain_derivatives(&mut self, derivatives: impl Iterator<Item = (i32, f64)>) -> bool {
        let phases = Phase::Instantiated as u8 | Phase::Initialization as u8 | Phase::StepComplete as u8;
        let has_derivatives = !S::has_input(Real::ExternalAcceleration);
        let in_order = has_derivatives && self.phase() as u8 & phases != 0;
        let before = self.contacts.curves.as_ref().first().filter(|_| self.clock.curved).copied().unwrap_or_default();
        let mut numbers = [before.slope, before.bend];
        for (order, value) in derivatives {
            match numbers.get_mut((order as u32).wrapping_sub(1) as usize) {
                Some(number) if order <= Self::input_order() && value.abs() <= SWIFTEST => *number = value,
                _ => return false,
            }
        }
        let [slope, bend] = numbers;
        if in_order && (self.clock.curved || slope != 0.0 || bend != 0.0) {
            self.curve();
            for curve in self.contacts.curves.as_mut() {
                (curve.slope, curve.bend) = (slope, bend);
            }
        }
        in_order
    }

    /// Prepares the inputs for derivatives; none is set yet.
    #[inline(always)]
    fn curve(&mut self) {
        if self.clock.curved {
            return;
        }
        let Contacts { curves, rates, .. } = &mut self.contacts;
        for (curve, &rate) in curves.as_mut().iter_mut().zip(rates.as_ref()) {
            *curve = Curve { end_rate: rate, ..Curve::default() };
        }
        self.clock.curved = true;
        self.clock.hold();
    }

    /// The derivative of this `order` of an output with respect to time, at the end of the last step. At a corner of the law,
    /// it is one-sided, in the direction of the last motion. Variables of a whole step, `mean_force` and `predicted_force`, do
    /// not change within it.
    ///
    /// # Errors
    /// [`Fault::NoDerivative`] for a variable that is not an output, [`Fault::DerivativeOrder`],
    /// [`Fault::DerivativeNotFinite`].
    #[inline(always)]
    pub fn output_derivative(&self, (variable, contact): (Real, usize), order: i32) -> Result<f64, Fault> {
        if !variable.is_output() {
            return Err(Fault::NoDerivative { of: "outputs" });
        }
        check_order(order, S::derivatives())?;
        let derivative = self.derivatives(variable, contact).map_or(f64::NAN, |(first, second)| match order {
            1 => first,
            _ => second,
        });
        if derivative.is_finite() { Ok(derivative) } else { Err(Fault::DerivativeNotFinite) }
    }

    /// First and second derivative of an output with respect to time.
    #[inline(always)]
    fn derivatives(&self, output: Real, contact: usize) -> Option<(f64, f64)> {
        let history = self.histories().get(contact)?;
        let (rate, slope) = self.end_of(contact);
        let model = self.model(contact);
        let (force, stiffness) = (history.force(rate), history.stiffness(rate));
        let work = (force * rate, stiffness * rate * rate + force * slope);
        // for a function of the indentation with these derivatives
        let by_time = |(first, second): (f64, f64)| (first * rate, second * rate * rate + first * slope);
        if let (true, Some(quantity)) = (S::Contact::HAS_FRICTION, output.quantity()) {
            let normal = RatePolynomial { rate, slope, bend: 0.0 };
            let tangential = [0, 1].map(|direction| self.tangential_end_of(contact, direction));
            return Some(history.tangential_derivatives(&model, quantity, &normal, &tangential));
        }
        let variable = match output {
            Real::Force if S::derivatives() < 2 => {
                return Some((stiffness * rate + history.damping(rate) * slope, 0.0));
            }
            Real::Force => return Some(by_time((stiffness, history.curvature(&model, rate)))),
            Real::Indentation => return Some((rate, slope)),
            Real::MaxIndentation => {
                let deepest = history.indentation() > 0.0 && history.indentation() >= history.max_indentation();
                return Some(if deepest && rate > 0.0 { (rate, slope) } else { (0.0, 0.0) });
            }
            Real::Work => return Some(work),
            Real::Impulse => return Some((force, stiffness * rate)),
            Real::RegimeNumber
            | Real::SlidingNumber
            | Real::MeanForce
            | Real::ImpulseMoment
            | Real::TangentialImpulseMoment
            | Real::SecondTangentialImpulseMoment
            | Real::PredictedForce
            | Real::PredictedTangentialForce
            | Real::SecondPredictedTangentialForce => return Some((0.0, 0.0)),
            // the force changes with the distance
            Real::ClosingSpeed if S::moves() => {
                return Some((slope, -self.response(contact, |other| self.growth_of_force(other))));
            }
            Real::TangentialSpeed | Real::SecondTangentialSpeed => {
                let direction = usize::from(output == Real::SecondTangentialSpeed);
                let slope = self.tangential_end_of(contact, direction).slope;
                let row = (1 + direction) * S::contacts() + contact;
                return Some((slope, -self.response(row, |other| self.growth_of_force(other))));
            }
            // the heat is not a function of the indentation, but the remaining part of the work is
            Real::DissipatedEnergy if S::follows_rate() => Real::ElasticEnergy,
            variable => variable,
        };
        if history.regime() == Regime::Apart {
            return Some((0.0, 0.0));
        }
        let (first, second) =
            by_time(slopes(history, &model, |contact| of_state::<S>(variable, contact, &model, rate)));
        // the rate of bodies that the FMU moves changes, too
        let accelerates = S::follows_rate() && slope != 0.0;
        let first = first + if accelerates { Self::by_rate(history, &model, output, rate) * slope } else { 0.0 };
        let rest = output == Real::DissipatedEnergy && S::follows_rate();
        Some(if rest { (work.0 - first, work.1 - second) } else { (first, second) })
    }

    /// The derivative of the force of a row with respect to time \[N/s\]; for a force that depends on the rate, without that part.
    fn growth_of_force(&self, row: usize) -> f64 {
        let (contact, direction) = Self::place_of(row);
        let Some(history) = self.histories().get(contact) else { return 0.0 };
        let (rate, slope) = self.end_of(contact);
        let Some(direction) = direction else { return history.stiffness(rate) * rate };
        let normal = RatePolynomial { rate, slope, bend: 0.0 };
        let tangential = [0, 1].map(|direction| self.tangential_end_of(contact, direction));
        history.tangential_derivatives(&self.model(contact), Quantity::Force(direction), &normal, &tangential).0
    }

    /// The derivative of a variable with respect to the input of contact `by` at the present time. It is zero except for
    /// `predicted_force` and, with a rate-dependent law, the force, the mean pressure and the stiffness.
    ///
    /// # Errors
    /// [`Fault::NoDerivative`] for a variable that is not an output, [`Fault::NotAnInput`], [`Fault::DerivativeNotFinite`].
    #[inline(always)]
    pub fn derivative_by_input(
        &self,
        (variable, contact): (Real, usize),
        (input, by): (Real, usize),
    ) -> Result<f64, Fault> {
        if !variable.is_output() {
            return Err(Fault::NoDerivative { of: "outputs" });
        }
        self.check_known(input)?;
        let derivative = match (contact == by, input) {
            (true, Real::IndentationRate) => self.by_own_input(variable, contact).unwrap_or(f64::NAN),
            (true, input) if S::Contact::HAS_FRICTION => match input.tangential_rate() {
                Some(direction) => self.by_tangential_rate(variable, contact, direction).unwrap_or(f64::NAN),
                None => 0.0,
            },
            _ => 0.0,
        };
        if derivative.is_finite() { Ok(derivative) } else { Err(Fault::DerivativeNotFinite) }
    }

    /// Checks that a variable is one by which derivatives exist now: an input, and before the initialization ends a parameter.
    ///
    /// # Errors
    /// [`Fault::NotAnInput`]
    #[inline(always)]
    pub fn check_known(&self, known: Real) -> Result<(), Fault> {
        let is_known = match known {
            Real::Parameter(_) => self.phase() == Phase::Initialization,
            _ => known == Real::IndentationRate || S::has_input(known),
        };
        if is_known { Ok(()) } else { Err(Fault::NotAnInput) }
    }

    /// The value of the parameter with this `index`, and two others at which to differentiate an output of `contact`: on both
    /// sides, and on one side where the parameter is at a limit, or where bodies just touch and the derivative is that of bodies
    /// apart. `None` if there is no such parameter.
    ///
    /// A parabola through the three has the derivative within 1e-6 of the output over the parameter, or over what the parameter is
    /// compared with if it may be zero: 1, or the modulus for hardening. At a corner of the law it is the mean of both sides.
    pub fn neighbours(&self, contact: usize, index: usize) -> Option<[f64; 3]> {
        /// Distance of the neighbours, as a fraction: near the cube root of the rounding error.
        const WIDTH: f64 = 1.0 / 131_072.0;
        let (Settable { unit, minimum, maximum, .. }, _) = S::settable(index)?;
        let value = *self.settings.values.as_ref().get(index)?;
        let least = match unit {
            _ if minimum > 0.0 => 0.0,
            b"" => 1.0,
            b"Pa" => self.settings.bodies.as_ref().get(S::group(contact))?.modulus,
            _ => 0.0,
        };
        let size = largest(value.abs(), least);
        let width = if size > 0.0 { WIDTH * size } else { SLOW };
        let (below, above) = (value - width, value + width);
        Some(match () {
            () if above > maximum => [value, below, below - width],
            () if below < minimum || size == 0.0 => [value, above, above + width],
            () => [value, below, above],
        })
    }

    #[inline(always)]
    fn by_own_input(&self, variable: Real, contact: usize) -> Option<f64> {
        let history = self.histories().get(contact)?;
        let rate = *self.rates().get(contact)?;
        if variable == Real::PredictedForce {
            return self.prediction_by_input(contact, &self.model(contact), rate);
        }
        if S::Contact::HAS_FRICTION
            && let Some(of) = variable.predicted_direction()
        {
            let force = |rate| self.tangential_prediction_at(contact, of, rate, None);
            return if self.clock.curved { Some(0.0) } else { slope_at(rate, force) };
        }
        if S::moves() && variable == Real::ClosingSpeed && self.phase() == Phase::Initialization {
            return Some(1.0);
        }
        // bodies that the FMU moves have their own speed
        if !S::follows_rate() || S::moves() && self.own_speed(contact).is_some() {
            return Some(0.0);
        }
        Some(Self::by_rate(history, &self.model(contact), variable, rate))
    }

    /// The derivative of an output with respect to the rate, of a contact whose law depends on it.
    fn by_rate(history: &S::Contact, model: &S::Model, variable: Real, rate: f64) -> f64 {
        let (damping, radius) = (history.damping(rate), history.contact_radius(model));
        match variable {
            Real::Force => damping,
            Real::MeanPressure if radius > 0.0 => damping / (PI * radius * radius),
            Real::Stiffness if damping != 0.0 => slopes(history, model, |contact| contact.damping(rate)).0,
            _ => 0.0,
        }
    }
}

impl<S: Scene> Instance<S> {
    /// dF/d(rate) of the predicted force \[N.s/m\].
    fn prediction_by_input(&self, contact: usize, model: &S::Model, rate: f64) -> Option<f64> {
        if self.clock.curved {
            // after a step with derivatives, the prediction continues from its end, whatever the input is now
            return Some(0.0);
        }
        // of the other contacts, the indentation isn't the distance, or the force follows the rate
        let finds_strength = S::Contact::FINDS_STRENGTH && self.histories().get(contact)?.regime() == Regime::Apart;
        if S::derivatives() == 2 && !finds_strength {
            return Some(self.predicted(contact, model, rate)?.stiffness(rate) * self.last_step());
        }
        // the speed of a first touch within the step also depends on the input
        slope_at(rate, |rate| Some(self.predicted(contact, model, rate)?.force(rate)))
    }

    /// The derivative of `variable` with respect to the tangential rate of its `contact` in this `direction`: of the predicted
    /// tangential force \[N.s/m\], otherwise zero.
    fn by_tangential_rate(&self, variable: Real, contact: usize, direction: usize) -> Option<f64> {
        let speed = [Real::TangentialSpeed, Real::SecondTangentialSpeed].get(direction).copied();
        if Some(variable) == speed && self.phase() == Phase::Initialization {
            return Some(1.0);
        }
        let Some(of) = variable.predicted_direction() else { return Some(0.0) };
        if self.clock.curved {
            return Some(0.0);
        }
        let rate = *self.rates().get(contact)?;
        let force = |changed| self.tangential_prediction_at(contact, of, rate, Some((direction, changed)));
        slope_at(self.tangential_end_of(contact, direction).rate, force)
    }

    /// The predicted tangential force \[N\] of `contact` in the direction `of`, at this rate along the normal and with the
    /// tangential rate of one direction `changed` \[m/s\].
    fn tangential_prediction_at(
        &self,
        contact: usize,
        of: usize,
        rate: f64,
        changed: Option<(usize, f64)>,
    ) -> Option<f64> {
        let (mut next, model) = (*self.histories().get(contact)?, self.model(contact));
        for direction in 0..S::Contact::DIRECTIONS {
            let held = match changed {
                Some((other, rate)) if other == direction => rate,
                _ => self.tangential_end_of(contact, direction).rate,
            };
            next.set_tangential_course(direction, &RatePolynomial::held(held));
        }
        // where the law ends, the state does not change
        let _ = next.step_held(rate, self.last_step(), &S::Contact::kept(&model), || &*model);
        Some(next.tangential(&model, Quantity::Force(of), rate))
    }
}

/// The derivative of a function at `rate` \[m/s\], by a central difference.
#[inline(always)]
fn slope_at(rate: f64, of: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let width = if rate == 0.0 { SLOW } else { NEAR * rate.abs() };
    Some((of(rate + width)? - of(rate - width)?) / (2.0 * width))
}

/// The difference between two rates, as a fraction of them, for the slope of a force.
const NEAR: f64 = 1e-5;

/// The same for a rate of zero \[m/s\].
const SLOW: f64 = 1e-6;

fn check_order(order: i32, largest: i32) -> Result<(), Fault> {
    if order >= 1 && order <= largest { Ok(()) } else { Err(Fault::DerivativeOrder { order, largest }) }
}
