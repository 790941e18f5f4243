//! Rebound hardness devices: a carbide ball on steel, by every law, with the strength that the steel's hardness says.

use crate::comparisons::{larger, numbers, unloading_with};
use crate::physics::AnyModel;
use brinell_contact::impact::{Impact, Prediction, predict};
use brinell_contact::rate::{self, FIRST_STRAIN, Rate, STEPS};
use brinell_contact::{Body, Model, Numbered, OtherBody, Pair, Surface, TwoBodies};
use brinell_exporter::measured::{self, Metal, STEEL_RATE};
use brinell_exporter::table::Class;
use brinell_testing::physics;

const CARBIDE: Body = Body { radius: f64::INFINITY, youngs_modulus: 620e9, poissons_ratio: 0.22 };
pub const STEEL: Body = Body { radius: f64::INFINITY, youngs_modulus: 210e9, poissons_ratio: 0.3 };

/// A ball of carbide with its impact.
#[derive(Clone, Copy)]
pub struct Device {
    /// Radius of the ball \[m\].
    pub radius: f64,
    pub impact: Impact,
}

impl Device {
    /// The device D, whose rebounds are known.
    pub const D: Device = Device { radius: 1.5e-3, impact: Impact { mass: 5.45e-3, speed: 2.05 } };

    /// Its impact by a law on steel of this strength \[Pa\].
    pub fn on(&self, law: &str, yield_strength: f64) -> Prediction {
        let model = on_steel(law, &Body { radius: self.radius, ..CARBIDE }, yield_strength);
        predict(&model, &self.impact).expect("within the range of every law")
    }
}

/// A ball on steel of this strength \[Pa\].
pub fn on_steel(law: &str, ball: &Body, yield_strength: f64) -> AnyModel {
    let (loading, unloading) = (physics::loading(law), physics::unloading(unloading_with(law)));
    let other =
        OtherBody { modulus: ball.plane_strain_modulus(), poissons_ratio: ball.poissons_ratio, ..OtherBody::RIGID };
    let bodies = TwoBodies { hardening_modulus: 0.0, curvature: 0.0, other };
    Model {
        pair: Pair::new(ball, &STEEL, yield_strength).expect("a ball on a plane touches in one point"),
        loading: loading.of_bodies(bodies),
        unloading,
        surface: Surface::Dented,
    }
    .prepared()
}

/// The flow stress that a Vickers hardness says.
#[derive(Clone, Copy, PartialEq)]
pub enum Stress {
    /// A third of the hardness.
    Third,
    /// That of the test.
    OfTest,
    /// That of the test, taken along the hardening to the strain of the impact.
    OfImpact,
}

/// How a strength follows from a Vickers hardness.
#[derive(Clone, Copy)]
pub struct Way {
    pub stress: Stress,
    pub rate: Rate,
}

/// A third of the hardness.
pub const THIRD: Way = Way { stress: Stress::Third, rate: Rate::NONE };
/// By the constraint of the test and the hardening, under a slow load.
pub const SLOW: Way = Way { stress: Stress::OfImpact, rate: Rate::NONE };
/// What a scene makes of a hardness.
pub const SCENE: Way = Way { stress: Stress::OfImpact, rate: STEEL_RATE };

/// The metal of a scene with this steel.
pub fn steel() -> Metal {
    let Body { youngs_modulus, poissons_ratio, .. } = STEEL;
    Metal { youngs_modulus, poissons_ratio, class: Class::Steel, exponent: None }
}

/// A strength in an impact.
#[derive(Clone, Copy)]
pub struct Found {
    /// \[Pa\].
    pub strength: f64,
    /// By the strain rate, relative to a slow load.
    pub factor: f64,
    /// \[1/s\].
    pub strain_rate: f64,
}

impl Way {
    /// The strength in the impact of a device on steel of this hardness \[HV\]: a fixed point by the law `brinell`, as in a scene.
    pub fn strength(&self, vickers: f64, device: &Device) -> Found {
        let reading = measured::of_hardness(&format!("{vickers} HV10"), &steel()).expect("a hardness of steel");
        let slow = |strain: f64| match self.stress {
            Stress::Third => third(vickers),
            Stress::OfTest => reading.stress,
            Stress::OfImpact => reading.at(strain),
        };
        let (mut strain, mut factor) = (FIRST_STRAIN, 1.0);
        for _ in 0..STEPS {
            let strength = factor * slow(strain);
            let model = on_steel("brinell", &Body { radius: device.radius, ..CARBIDE }, strength);
            let prediction = predict(&model, &device.impact).expect("within the range of the law");
            let next = rate::strains(&model, &prediction).softer;
            let strain_rate = next / prediction.loading_time;
            let more = self.rate.factor(strain_rate);
            if (more * slow(next) / strength - 1.0).abs() < 1e-10 {
                return Found { strength, factor, strain_rate };
            }
            (strain, factor) = (next, more);
        }
        panic!("{vickers} HV: no strength with {:?}", self.rate)
    }
}

/// A third of a Vickers hardness \[Pa\], by Tabor.
pub fn third(vickers: f64) -> f64 {
    vickers * 9.80665e6 / 3.0
}

/// The measured restitutions of the device D, with their Vickers hardness.
pub fn rebounds() -> Vec<(f64, f64)> {
    numbers("data/experiment/leeb_restitution.csv", "").iter().map(|row| (row[1], row[0])).collect()
}

/// The measured restitution, straight between two points.
pub fn measured(vickers: f64) -> f64 {
    let points = rebounds();
    let pair =
        points.windows(2).find(|pair| (pair[0].0..=pair[1].0).contains(&vickers)).expect("it was measured there");
    pair[0].1 + (pair[1].1 - pair[0].1) * (vickers - pair[0].0) / (pair[1].0 - pair[0].0)
}

/// Relative errors of the restitutions of a law with the strength by this way.
pub fn errors(law: &str, way: &Way) -> Vec<f64> {
    let error = |(vickers, measured): (f64, f64)| {
        Device::D.on(law, way.strength(vickers, &Device::D).strength).restitution / measured - 1.0
    };
    rebounds().into_iter().map(error).collect()
}

/// The largest of these errors, with its sign.
pub fn worst(law: &str) -> f64 {
    errors(law, &SCENE).into_iter().fold(0.0, larger)
}
