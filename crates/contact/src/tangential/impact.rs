//! Oblique impact of a free ball: its rebound with friction.
//!
//! The normal motion does not depend on friction, and is exact at the ends of all steps. The tangential motion is
//! computed in steps: the contact moves over `(v0 + v1)/2` times the step, with `v1 = v0 - step T/m_t` for the mean
//! force `T` of the step. With this, the kinetic energy changes by exactly the work of the tangential force.

use super::{FrictionalContact, FrictionalModel, Mean, Normal, Sliding, Springs};
use crate::behaviour::Contact;
use crate::history::History;
use crate::impact::{self, Impact};
use crate::loading::Loading;
use crate::motion::{ExternalLoad, follow};
use crate::numerics::{largest, quotient};
use crate::shared::{InverseMasses, Work, follow as follow_together};
use crate::unloading::Unloading;
use libm::fabs;

/// Number of segments of the springs: a few more than in a unit.
const SEGMENTS: usize = 16;

/// Steps of [`predict`] for each of loading and unloading. The error of the tangential restitution is then about 1e-5 for
/// an elastic contact; where the dent grows, it is at most the `friction_error` of the law plus 5e-4.
const STEPS: u32 = 500;

/// Largest number of iterations for the mean force of a step. Each reduces the error by `(step omega/2)^2`, with the
/// tangential frequency `omega`.
const ITERATIONS: u32 = 20;

/// A change of the mean force that is rounding, relative to Coulomb's limit.
const CLOSE: f64 = 1e-14;

/// A ball that is about to touch a body at rest. Only forces of the contact act on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// \[kg\] > 0
    pub mass: f64,
    /// Moment of inertia \[kg.m^2\] > 0: `0.4 m R^2` for a solid sphere.
    pub inertia: f64,
    /// Distance of the contact from the centre \[m\] > 0.
    pub radius: f64,
    /// Closing speed of the centre along the normal \[m/s\] > 0.
    pub normal: f64,
    /// Tangential speed of the centre \[m/s\].
    pub tangential: f64,
    /// Spin \[rad/s\]; positive if it moves the contact point as a positive tangential speed does. A ball that rolls
    /// has `-tangential/radius`.
    pub spin: f64,
}

impl Ball {
    /// Tangential speed of the contact point \[m/s\].
    pub fn slip(&self) -> f64 {
        self.tangential + self.spin * self.radius
    }

    /// Kinetic energy of the tangential motion and of the spin \[J\].
    pub fn tangential_energy(&self) -> f64 {
        0.5 * (self.mass * self.tangential * self.tangential + self.inertia * self.spin * self.spin)
    }

    /// Mass of the contact point in the tangential direction \[kg\]: `1/m_t = 1/m + R^2/I`.
    pub fn tangential_mass(&self) -> f64 {
        1.0 / (1.0 / self.mass + self.radius * self.radius / self.inertia)
    }

    /// The ball after the tangential `impulse` \[N.s\] of the contact, which opposes a positive slip.
    fn after(&self, impulse: f64) -> Ball {
        Ball {
            tangential: self.tangential - impulse / self.mass,
            spin: self.spin - impulse * self.radius / self.inertia,
            ..*self
        }
    }
}

/// The ball after its impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebound {
    /// The ball; its closing speed is negative.
    pub ball: Ball,
    /// Energy lost by slip \[J\].
    pub friction_work: f64,
    /// Largest size of the tangential force \[N\].
    pub max_tangential_force: f64,
    /// Time in which the whole contact slipped, over the contact time.
    pub sliding_part: f64,
    /// Duration of the contact \[s\].
    pub contact_time: f64,
}

/// The contact at the end of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Time since first contact \[s\].
    pub time: f64,
    /// \[m\]
    pub indentation: f64,
    /// \[N\]
    pub force: f64,
    /// \[N\]
    pub tangential_force: f64,
    /// Tangential speed of the contact point \[m/s\].
    pub slip: f64,
    /// Slip state.
    pub sliding: Sliding,
}

/// The impact of `ball` on an untouched contact; `None` beyond the range of the law, or for numbers that are not finite
/// or positive as [`Ball`] requires.
pub fn predict<L: Loading, U: Unloading>(model: &FrictionalModel<L, U>, ball: &Ball) -> Option<Rebound> {
    in_steps(model, ball, STEPS, |_| {})
}

/// The same, with `steps` steps for the loading and as many for the unloading. Calls `each` at the end of each step.
pub fn in_steps<L: Loading, U: Unloading>(
    model: &FrictionalModel<L, U>,
    ball: &Ball,
    steps: u32,
    mut each: impl FnMut(&Moment),
) -> Option<Rebound> {
    let is_possible = ball.inertia > 0.0 && ball.radius > 0.0 && fabs(ball.slip()) + ball.inertia < f64::INFINITY;
    if !is_possible || steps == 0 {
        return None;
    }
    let prediction = impact::predict(&model.normal, &Impact { mass: ball.mass, speed: ball.normal })?;
    let mut run = Run::start(model, ball)?;
    for half in [prediction.loading_time, prediction.unloading_time] {
        let (start, step) = (run.time, half / f64::from(steps));
        for index in 1..=steps {
            run.step(step)?;
            run.time = start + half * (f64::from(index) / f64::from(steps));
            each(&run.moment());
        }
    }
    let Run { ball, work, strongest, slid, time, .. } = run;
    Some(Rebound {
        ball: Ball { normal: run.speed, ..ball },
        // no tangential energy is left in a contact that has opened
        friction_work: work,
        max_tangential_force: strongest,
        sliding_part: slid / time,
        contact_time: time,
    })
}

/// Steps of [`meet`] in the time that the impact would last without friction; it follows the motion within each.
const PARTS: u32 = 200;

/// Most of these times that an impact with friction may last.
const LONGEST: u32 = 20;

/// Halvings of the last step until the end of the contact is known.
const HALVINGS: u32 = 40;

/// Two bodies after they have met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Closing rate along the normal, and rate along the tangent, of the contact points \[m/s\].
    pub rates: [f64; 2],
    /// Impulses of the normal and of the tangential force \[N.s\].
    pub impulses: [f64; 2],
    /// Energy lost by slip \[J\].
    pub friction_work: f64,
    /// Largest size of the tangential force \[N\].
    pub max_tangential_force: f64,
    /// Time in which the whole contact slipped, over the contact time.
    pub sliding_part: f64,
    /// Duration of the contact \[s\].
    pub contact_time: f64,
}

/// The impact of two bodies whose contact points meet with these `rates` along the normal and the tangent \[m/s\], as units move them that
/// share bodies: with any inverse `masses` of the normal, of both together and of the tangent \[1/kg\], and with a loss in the normal part
/// `N`. `time` \[s\] is about how long it takes. `None` beyond the range of the law.
///
/// Only forces of the contact act on them. The accuracy is that of [`shared`](crate::shared).
pub fn meet<L: Loading + Copy, U: Unloading + Copy, N: Normal>(
    model: &FrictionalModel<L, U, N::Loss>,
    masses: &[f64; 3],
    rates: [f64; 2],
    time: f64,
) -> Option<Meeting> {
    let masses = InverseMasses::new(2, masses).ok()?;
    let mut contact: [FrictionalContact<SEGMENTS, true, N>; 1] = [Contact::start(model, 0.0).ok()?];
    let mut now = Meeting {
        rates,
        impulses: [0.0; 2],
        friction_work: 0.0,
        max_tangential_force: 0.0,
        sliding_part: 0.0,
        contact_time: 0.0,
    };
    let go = |contact: &mut [FrictionalContact<SEGMENTS, true, N>; 1], rates: &mut [f64; 2], step: f64| {
        let mut work = [Work::new(contact[0])];
        follow_together(contact, |_| model, &masses, &[0.0; 2], rates, &mut work, step).ok()?;
        let [work] = work;
        Some([work.impulse(), work.tangential_impulse(0)])
    };
    let has_ended = |contact: &[FrictionalContact<SEGMENTS, true, N>; 1], rates: &[f64; 2]| {
        let [contact] = contact;
        contact.normal.force(rates[0]) == 0.0 && rates[0] <= 0.0
    };
    let (mut slid, step) = (0.0, time / f64::from(PARTS));
    for _ in 0..LONGEST * PARTS {
        let (before, rates_before) = (contact, now.rates);
        let impulses = go(&mut contact, &mut now.rates, step)?;
        let mut length = step;
        let ends = has_ended(&contact, &now.rates);
        if ends {
            // bodies that have parted keep their rates
            let mut shorter = 0.0;
            for _ in 0..HALVINGS {
                let middle = 0.5 * (shorter + length);
                let (mut contact, mut rates) = (before, rates_before);
                go(&mut contact, &mut rates, middle)?;
                *(if has_ended(&contact, &rates) { &mut length } else { &mut shorter }) = middle;
            }
        }
        let [own] = &contact;
        let [state] = &before;
        now.impulses = [now.impulses[0] + impulses[0], now.impulses[1] + impulses[1]];
        now.contact_time += length;
        let [force] = own.tangential_forces(model, now.rates[0]);
        now.max_tangential_force = largest(now.max_tangential_force, fabs(force));
        // the state before the bodies separate is that of their last step
        let sliding = if ends { state.sliding() } else { own.sliding() };
        slid += if sliding == Sliding::Sliding { length } else { 0.0 };
        if ends {
            now.friction_work = own.friction_work(model);
            now.sliding_part = slid / now.contact_time;
            return Some(now);
        }
    }
    None
}

/// An impact under way.
struct Run<'a, L, U> {
    model: &'a FrictionalModel<L, U>,
    /// The exact normal motion.
    normal: History,
    /// Closing speed \[m/s\].
    speed: f64,
    /// The contact of the springs, which moves in straight steps between the points of the exact motion.
    contact: History,
    springs: Springs<SEGMENTS>,
    ball: Ball,
    time: f64,
    work: f64,
    strongest: f64,
    slid: f64,
}

impl<'a, L: Loading, U: Unloading> Run<'a, L, U> {
    fn start(model: &'a FrictionalModel<L, U>, ball: &Ball) -> Option<Self> {
        let normal = History::start(&model.normal, 0.0).ok()?;
        let springs = Springs::start(model, &normal);
        let (speed, contact, ball) = (ball.normal, normal, *ball);
        Some(Run { model, normal, speed, contact, springs, ball, time: 0.0, work: 0.0, strongest: 0.0, slid: 0.0 })
    }

    /// Moves the ball through `step` \[s\].
    fn step(&mut self, step: f64) -> Option<()> {
        let load = ExternalLoad { mass: self.ball.mass, acceleration: 0.0 };
        let (from, before) = (self.contact.indentation(), self.springs.sliding());
        let outcome = follow(&mut self.normal, &self.model.normal, &load, self.speed, step).ok()?;
        self.speed = outcome.speed;
        let increment = self.normal.indentation() - from;
        // friction follows the impulse of the exact motion, which a straight step misses slightly
        let straight = self.contact.mean_force(&self.model.normal, increment / step, step).ok()?;
        let part = quotient(outcome.speed_removed * self.ball.mass, straight * step, straight > 0.0, 1.0);
        let limit = self.model.friction.coefficient * straight;
        let (slip, stiffness) = (self.ball.slip(), 0.5 * step / self.ball.tangential_mass());
        let mut mean = self.springs.force(&self.model.friction, from);
        for _ in 0..ITERATIONS {
            let (mut contact, mut springs) = (self.contact, self.springs);
            let way = (increment, step * (slip - stiffness * mean));
            let found = part * springs.advance(&mut contact, self.model, way, way, Mean::Exact).ok()?;
            let change = fabs(found - mean);
            mean = found;
            if change <= CLOSE * limit {
                break;
            }
        }
        let way = (increment, step * (slip - stiffness * mean));
        self.springs.advance(&mut self.contact, self.model, way, way, Mean::Skipped).ok()?;
        self.ball = self.ball.after(mean * step);
        self.work += mean * way.1;
        let end = self.springs.sliding();
        let force = self.springs.force(&self.model.friction, self.contact.indentation());
        self.strongest = largest(self.strongest, fabs(force));
        // the state before the bodies separate is that of their last step
        let sliding = if end == Sliding::Apart { before } else { end };
        self.slid += if sliding == Sliding::Sliding { step } else { 0.0 };
        Some(())
    }

    fn moment(&self) -> Moment {
        let indentation = self.contact.indentation();
        Moment {
            time: self.time,
            indentation,
            force: self.contact.force(),
            tangential_force: self.springs.force(&self.model.friction, indentation),
            slip: self.ball.slip(),
            sliding: self.springs.sliding(),
        }
    }
}
