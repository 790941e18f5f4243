//! Importers in plain Rust: a mass that moves against one contact, with both orders of execution and steps of any length.
//!
//! A *serial* importer steps the contact first and applies its mean force over the same step. A *parallel* importer steps
//! contact and bodies at once and exchanges values afterwards.

use super::physics::{AnyModel, Random};
use super::scenes::{Choice, Chosen, Massive, choose, ready, set_rate};
use brinell_contact::Surface;
use brinell_fmu::instance::Instance;
use brinell_fmu::scene::{Absent, Coupled, Present, Real, Scene};

pub type Serial = Chosen<Massive, 1, Present>;
pub type Parallel = Chosen<Massive<Coupled<Present>>, 1, Present>;
pub type WiredSerial = Chosen<Massive<Coupled<Absent, Present, Present>>, 1, Present>;
pub type WiredParallel = Chosen<Massive<Coupled<Present, Present, Present>>, 1, Present>;

pub const MASS: f64 = 4e-3;

/// The sequence of the steps of an importer, as multiples of their size.
#[derive(Clone, Copy, Debug)]
pub enum Pattern {
    Equal,
    /// 1:3
    Alternating,
    /// Two short steps and one three times as long.
    OneInThree,
    /// From a third to three times the size.
    Any,
}

pub const PATTERNS: [Pattern; 4] = [Pattern::Equal, Pattern::Alternating, Pattern::OneInThree, Pattern::Any];

impl Pattern {
    pub fn factor(self, count: usize, random: &mut Random) -> f64 {
        match self {
            Pattern::Equal => 1.0,
            Pattern::Alternating => [0.5, 1.5][count % 2],
            Pattern::OneInThree => [0.6, 0.6, 1.8][count % 3],
            Pattern::Any => 3f64.powf(2.0 * random.next() - 1.0),
        }
    }
}

/// A mass that an importer moves against one contact.
pub struct Master<S: Scene> {
    pub instance: Instance<S>,
    pub parallel: bool,
    pub wired: bool,
    pub mass: f64,
    /// Closing speed that the importer knows \[m/s\].
    pub speed: f64,
    /// Acceleration by all forces except the contact force \[m/s^2\].
    pub acceleration: f64,
    /// A further one of which it doesn't tell \[m/s^2\].
    pub untold: f64,
    /// The part of the contact force that it applies.
    pub share: f64,
}

impl<S: Scene> Master<S> {
    pub fn new(choice: Choice, parallel: bool, wired: bool, speed: f64, acceleration: f64) -> Master<S> {
        choose(choice);
        let (instance, mass) = (ready::<S>(), choice.effective_mass);
        Master { instance, parallel, wired, mass, speed, acceleration, untold: 0.0, share: 1.0 }
    }

    pub fn get(&self, output: Real) -> f64 {
        self.instance.real((output, 0))
    }

    pub fn step(&mut self, step: f64) {
        set_rate(&mut self.instance, 0, self.speed);
        if self.wired {
            self.instance.set_real((Real::ExternalAcceleration, 0), self.acceleration);
            self.instance.set_real((Real::EffectiveMass, 0), self.mass);
        } else if self.acceleration != 0.0 {
            self.instance.set_input_derivative((Real::IndentationRate, 0), 1, self.acceleration);
        }
        let before = self.get(Real::MeanForce);
        let time = self.instance.time();
        self.instance.do_step(time, step).expect("the bodies can be followed");
        let force = if self.parallel { before } else { self.get(Real::MeanForce) };
        self.speed += step * (self.acceleration + self.untold - self.share * force / self.mass);
    }

    /// Whether the bodies are apart and separating, and the importer knows their speed.
    pub fn has_parted(&self) -> bool {
        let speed = self.get(Real::ClosingSpeed);
        self.get(Real::Force) == 0.0 && speed < 0.0 && (self.speed - speed).abs() < 1e-13
    }
}

pub fn choice(model: &AnyModel, surface: Surface, gap: f64) -> Choice {
    let choice = Choice::of(model.loading, model.unloading);
    Choice { surface, initial_gap: gap, effective_mass: MASS, target_radius: f64::INFINITY, ..choice }
}
