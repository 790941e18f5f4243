//! The loss of a contact during a step: its force, and the events at which the force has a kink.

use super::branch::{Event, Watched};
use crate::losses::{Damping, Form};
use crate::numbers::{largest, quotient};
use libm::fabs;

/// The loss of a contact. Its force is continuous at every event, so that none can hold the motion.
#[derive(Clone, Copy, Debug)]
pub struct Loss {
    /// With the largest rate since the touch, in either direction, `v0` \[m/s\].
    pub damping: Damping,
    /// The direction in which the rate itself leads, so that it is `v0`; 0 if it does not.
    pub leads: f64,
    /// Whether the surface would have to pull, so that there is no force.
    pub slack: bool,
    /// Elastic energy and plastic work of the contact at the start of the step \[J\].
    pub before: f64,
}

impl Loss {
    /// Force \[N\] for the `elastic` force \[N\] at the closing rate of the bodies \[m/s\], and the rate of indentation
    /// \[m/s\]. In trials the force may be negative. `stiffness` \[N/m\] matters for some forms only.
    #[inline(always)]
    pub fn force_and_approach(&self, elastic: f64, stiffness: f64, rate: f64) -> (f64, f64) {
        let Loss { damping, leads, slack, .. } = self;
        match damping.form {
            Form::Mobility => (elastic, rate - damping.factor * elastic),
            _ if *slack => (0.0, rate),
            Form::Proportional if *leads != 0.0 => (elastic * (1.0 + leads * damping.factor), rate),
            _ => (damping.pull(elastic, || stiffness, rate), rate),
        }
    }

    /// Whether the stiffness matters.
    pub fn needs_stiffness(&self) -> bool {
        self.damping.form != Form::Proportional
    }

    /// The rate at which a target gives way per rate of indentation \[1/s\].
    pub fn easing(&self, stiffness: f64) -> f64 {
        self.damping.retreat(stiffness)
    }

    /// The fastest decay that the loss brings in, for a contact of this stiffness \[N/m\] and inverse mass \[1/kg\], in 1/s.
    pub fn decay(&self, stiffness: f64, inverse_mass: f64) -> f64 {
        match self.damping.form {
            Form::Proportional => 0.0,
            Form::Radiation => self.damping.factor * stiffness * stiffness * inverse_mass,
            Form::Mobility => self.damping.factor * stiffness,
        }
    }

    /// What the loss waits for while the contact is pressed and its rate of indentation is `approach` \[m/s\].
    pub fn watched(&self, approach: f64) -> [Option<Watched>; 3] {
        let Damping { form, factor, swiftest } = self.damping;
        let rate = |event, threshold, sign| Some(Watched::Rate { event, threshold, sign });
        match form {
            Form::Mobility => [None; 3],
            Form::Radiation => {
                let (event, sign) = if self.slack { (Event::Grip, -1.0) } else { (Event::Slack, 1.0) };
                [Some(Watched::Pull { event, sign }), None, None]
            }
            Form::Proportional if self.leads != 0.0 => {
                // a contact that is set down does not move yet
                let moves = self.leads * approach > 0.0;
                [moves.then_some(Watched::Bend { sign: self.leads }), None, None]
            }
            Form::Proportional => {
                let loosens = quotient(-swiftest, factor, factor > 1.0, 0.0);
                let (event, sign) = if self.slack { (Event::Grip, 1.0) } else { (Event::Slack, -1.0) };
                let slack = if factor > 1.0 { rate(event, loosens, sign) } else { None };
                [rate(Event::Lead, swiftest, 1.0), rate(Event::Lead, -swiftest, -1.0), slack]
            }
        }
    }

    /// Lets the rate lead deeper: there was none since the touch.
    pub fn begin(&mut self) {
        self.leads = 1.0;
    }

    /// Changes the loss at an event, at the rate of indentation `approach` \[m/s\]. `sign` is the direction of a rate that
    /// begins to lead.
    pub fn happen(&mut self, event: Event, approach: f64, sign: f64) {
        match event {
            Event::Touch => {
                self.damping.swiftest = fabs(approach);
                (self.leads, self.slack) = (0.0, false);
            }
            Event::Part => {
                self.damping.swiftest = 0.0;
                (self.leads, self.slack) = (0.0, false);
            }
            Event::Lead => self.leads = sign,
            Event::Peak => {
                self.damping.swiftest = largest(self.damping.swiftest, fabs(approach));
                self.leads = 0.0;
            }
            Event::Slack => self.slack = true,
            Event::Grip => self.slack = false,
            Event::Turn | Event::Corner | Event::End | Event::Forget => (),
        }
    }

    /// The largest rate since the touch \[m/s\], at the rate of indentation `approach` \[m/s\].
    pub fn swiftest(&self, approach: f64) -> f64 {
        if self.leads == 0.0 { self.damping.swiftest } else { largest(self.damping.swiftest, fabs(approach)) }
    }

    /// A number with the sign of the force before it is cut at zero, for a force that follows the stiffness \[m/s\]. It is
    /// `F_s/K^2 + kappa v`, which also at the surface does not touch zero.
    pub fn pull(&self, elastic: f64, stiffness: f64, approach: f64) -> f64 {
        let square = stiffness * stiffness;
        quotient(elastic, square, square > 1e-100 * fabs(elastic), 0.0) + self.damping.factor * approach
    }
}
