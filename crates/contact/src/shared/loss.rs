//! The loss of a contact during a step: its force, and the events at which the force has a kink.

use super::branch::{Event, Watched};
use crate::losses::{Damping, Form};
use crate::numerics::{largest, quotient};
use libm::fabs;

/// A border so near, as a part of its depth, is here.
const BESIDE: f64 = 1e-9;

/// A jump of the force that is rounding, as a part of it.
const JUMP: f64 = 1e-9;

/// The loss of a contact. Its force is continuous at every event, so that none can hold the motion.
#[derive(Clone, Copy, Debug)]
pub struct Loss {
    /// With the largest rate since the touch, in either direction, `v0` \[m/s\].
    pub damping: Damping,
    /// The direction in which the rate itself leads, so that it is `v0`; 0 if it does not.
    pub leads: f64,
    /// Whether the surface would have to pull, so that there is no force; of a target that gives way, whether it [holds](Loss::hold).
    pub slack: bool,
    /// The largest force of a target that holds \[N\].
    pub most: f64,
    /// Elastic energy and plastic work of the contact at the start of the step \[J\].
    pub before: f64,
}

impl Loss {
    /// Force \[N\] at the indentation `d` \[m\] for the `elastic` force \[N\] at the closing rate of the bodies \[m/s\], and the rate of indentation
    /// \[m/s\]. In trials the force may be negative. `stiffness` \[N/m\] matters for some forms only.
    #[inline(always)]
    pub fn force_and_approach(&self, d: f64, elastic: f64, stiffness: f64, rate: f64) -> (f64, f64) {
        let Loss { damping, leads, slack, .. } = self;
        match damping.form {
            Form::Mobility => {
                let force = if *slack { self.held_force(elastic, rate) } else { elastic };
                (force, rate - damping.factor * force)
            }
            _ if *slack => (0.0, rate),
            Form::Proportional if *leads != 0.0 => (elastic * (1.0 + leads * damping.factor), rate),
            _ => {
                // a step that tries to exceed the largest speed must not overflow
                let damping = Damping { swiftest: largest(0.5 * fabs(rate), damping.swiftest), ..*damping };
                (damping.pull(d, elastic, || stiffness, rate), rate)
            }
        }
    }

    /// Whether the stiffness matters.
    pub fn needs_stiffness(&self) -> bool {
        match self.damping.form {
            Form::Proportional => false,
            Form::Viscous(growth) => growth.needs_stiffness(),
            Form::Mobility => true,
        }
    }

    /// The rate at which a target gives way per rate of indentation \[1/s\].
    pub fn easing(&self, stiffness: f64) -> f64 {
        self.damping.retreat(stiffness)
    }

    /// The fastest decay that the loss brings in, for a contact of this stiffness \[N/m\] and inverse mass \[1/kg\], in 1/s.
    pub fn decay(&self, stiffness: f64, inverse_mass: f64) -> f64 {
        match self.damping.form {
            Form::Proportional => 0.0,
            Form::Viscous(growth) => growth.times(self.damping.factor, f64::INFINITY, || stiffness) * inverse_mass,
            Form::Mobility => self.damping.factor * stiffness,
        }
    }

    /// What the loss waits for while the contact is pressed at the indentation `d` \[m\] and its rate is `approach` \[m/s\].
    pub fn watched(&self, d: f64, approach: f64) -> [Option<Watched>; 3] {
        let Damping { form, factor, swiftest } = self.damping;
        let rate = |event, threshold, sign| Some(Watched::Rate { event, threshold, sign });
        match form {
            Form::Mobility => [self.slack.then_some(Watched::Pull { event: Event::Grip, sign: 1.0 }), None, None],
            Form::Viscous(growth) => {
                let (event, sign) = if self.slack { (Event::Grip, -1.0) } else { (Event::Slack, 1.0) };
                // within a longer step the surface could let go and grip again unseen
                let [deep, shallow] = growth.borders();
                let ahead =
                    |border: &f64| *border > 0.0 && (border - d) * approach > 0.0 && fabs(border - d) > BESIDE * border;
                let order = if approach > 0.0 { [shallow, deep] } else { [deep, shallow] };
                let border = order.into_iter().find(ahead);
                let border = border.map(|threshold| Watched::Indentation {
                    event: Event::Border,
                    threshold,
                    sign: approach.signum(),
                });
                [Some(Watched::Pull { event, sign }), border, None]
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
            // a step may begin where the surface lags behind bodies that leave faster than ever
            Event::Lead => (self.leads, self.slack) = (sign, self.slack || sign < 0.0 && self.damping.factor > 1.0),
            Event::Peak => {
                self.damping.swiftest = largest(self.damping.swiftest, fabs(approach));
                self.leads = 0.0;
            }
            Event::Slack => self.slack = true,
            Event::Grip | Event::End => self.slack = false,
            Event::Turn | Event::Corner | Event::Joint | Event::Forget | Event::Border => (),
        }
    }

    /// Holds a target that gives way where the indentation has turned, if the force jumps there: on the `loading` curve \[N\] the target
    /// would give way faster than the bodies come at `rate` \[m/s\], on the `path` back \[N\] slower. In between it gives way just as
    /// fast.
    pub fn hold(&mut self, loading: f64, path: f64, rate: f64) {
        let jumps = self.damping.form == Form::Mobility && rate > (1.0 + JUMP) * self.easing(path);
        (self.slack, self.most) = (self.slack || jumps, loading);
    }

    /// The force \[N\] of a target that holds, not below that of the path.
    fn held_force(&self, path: f64, rate: f64) -> f64 {
        let (slow, swift) = (rate <= self.easing(path), rate >= self.easing(self.most));
        quotient(rate, self.damping.factor, !slow && !swift, if slow { path } else { self.most })
    }

    /// The largest rate since the touch \[m/s\], at the rate of indentation `approach` \[m/s\].
    pub fn swiftest(&self, approach: f64) -> f64 {
        if self.leads == 0.0 { self.damping.swiftest } else { largest(self.damping.swiftest, fabs(approach)) }
    }

    /// A number with the sign of the force before it is cut at zero, of a viscous damping at the indentation `d` \[m\]. It is
    /// `F_s/psi + C v`, which also at the surface does not touch zero. For a target that holds it is the rate of indentation.
    pub fn pull(&self, d: f64, elastic: f64, stiffness: f64, approach: f64) -> f64 {
        let Form::Viscous(growth) = self.damping.form else { return approach };
        if d <= 0.0 && growth.grips_again() {
            return fabs(self.damping.factor * approach);
        }
        let psi = growth.times(1.0, d, || stiffness);
        quotient(elastic, psi, psi > 1e-100 * fabs(elastic), 0.0) + self.damping.factor * approach
    }
}
