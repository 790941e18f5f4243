//! The numbers that a tool wants to be typed, from its law.

use super::law::Law;
use super::plastic::{POISSON, Plastic, Thornton};
use crate::bisection::border;
use libm::{exp, pow, sqrt};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// What a number may depend on.
pub struct Context<'a> {
    /// `None` where a restitution is all.
    pub law: Option<&'a Law>,
    pub radii: &'a Radii,
    /// Effective mass \[kg\].
    pub mass: f64,
    /// Restitution, contact time \[s\], largest overlap \[m\] and speed \[m/s\] where the numbers are found.
    pub restitution: f64,
    pub contact_time: f64,
    pub depth: f64,
    pub speed: f64,
    /// \[s\]
    pub step: Option<f64>,
}

/// The radii of the bodies as a tool has them \[m\].
#[derive(Clone, Copy, Debug)]
pub struct Radii {
    pub ball: f64,
    /// That of a target which is a sphere.
    pub other: Option<f64>,
    /// The effective one: a wall has no curvature. No tool has hollows.
    pub effective: f64,
}

impl Radii {
    pub fn new(ball: f64, target: Option<f64>) -> Radii {
        let other = target.filter(|radius| *radius > 0.0 && radius.is_finite());
        Radii { ball, other, effective: other.map_or(ball, |other| ball * other / (ball + other)) }
    }

    /// The effective one \[m\] where a flat or a wall counts as a sphere as large as the ball.
    fn between_spheres(&self) -> f64 {
        if self.other.is_some() { self.effective } else { 0.5 * self.ball }
    }

    /// The density \[kg/m^3\] with which the ball has the effective `mass` \[kg\], or two free spheres have it.
    fn density(&self, mass: f64) -> f64 {
        let volume = |radius: f64| 4.0 / 3.0 * PI * radius * radius * radius;
        mass / volume(self.ball) + self.other.map_or(0.0, |other| mass / volume(other))
    }
}

/// Steps in a contact of a tool that chooses its steps.
const OWN_STEPS: f64 = 3000.0;

impl Context<'_> {
    /// The number `key` of tools.toml \[SI\]; `None` if there is none of this name for such a law.
    pub fn value(&self, key: &str) -> Option<f64> {
        match key {
            "restitution" => return Some(self.restitution),
            "radius" => return Some(self.radii.effective),
            "ball_radius" => return Some(self.radii.ball),
            "other_radius" => return Some(self.radii.other.unwrap_or(self.radii.ball)),
            "density" => return Some(self.radii.density(self.mass)),
            "step" => return self.step,
            // of a tool that chooses its steps from the largest one
            "own_step" => return Some(self.contact_time / OWN_STEPS),
            _ => {}
        }
        let law = self.law?;
        match *law {
            Law::Spring { stiffness, damping, .. } => self.of_spring(key, stiffness, damping),
            Law::Approaching { stiffness, damping } | Law::Smooth { stiffness, damping, .. } => match key {
                "stiffness" => Some(stiffness),
                "damping" => Some(damping),
                _ => None,
            },
            Law::HuntCrossley { stiffness, exponent, dissipation } => match key {
                "stiffness" => Some(stiffness),
                "exponent" => Some(exponent),
                "dissipation" => Some(dissipation),
                "indentation_damping" => Some(stiffness * dissipation),
                // 1.5 (1 - E), the factor of a nearly elastic impact
                "hunt_crossley_restitution" => Some(1.0 - dissipation * self.speed / 1.5).filter(|typed| *typed > 0.0),
                "impact_model_restitution" => Some(impact_model_restitution(dissipation * self.speed)),
                // 8/5 (1 - E)/E
                "flores_restitution" => Some(8.0 / (8.0 + 5.0 * dissipation * self.speed)),
                _ => self.of_hertz(key, stiffness, 0.0),
            },
            Law::Proportional { stiffness, factor, .. } => self.of_hertz(key, stiffness, factor),
            Law::Impact { stiffness, exponent, damping, ramp } => match key {
                "stiffness" => Some(stiffness),
                "exponent" => Some(exponent),
                "damping" => Some(damping),
                "ramp" => Some(ramp),
                _ => None,
            },
            Law::ElastoGap { stiffness, exponent, damping } => match key {
                "stiffness" => Some(stiffness),
                "exponent" => Some(exponent),
                "damping" => Some(damping),
                _ => None,
            },
            Law::Steeper { stiffness, exponent, ratio } => match key {
                "stiffness" => Some(stiffness),
                "exponent" => Some(exponent),
                "plasticity_ratio" => Some(ratio),
                _ => None,
            },
            Law::Plastic(Plastic { modulus, strength, .. }) => match key {
                "youngs_modulus" => Some(modulus * (1.0 - POISSON * POISSON)),
                "yield_strength" => strength.is_finite().then_some(strength),
                _ => None,
            },
            Law::Thornton(Thornton { stiffness, limit, .. }) => match key {
                "yield_ratio" => limit.is_finite().then(|| sqrt(limit / self.radii.effective)),
                _ => self.of_hertz(key, stiffness, 0.0),
            },
            Law::Luding { loading, unloading, limit, .. } => match key {
                "loading_stiffness" => Some(loading),
                "unloading_stiffness" => Some(unloading),
                "stiffness_ratio" => Some(unloading / loading),
                // K/(K - k1) phi 2R is the limit
                "penetration_depth" => Some(0.5 * limit * (1.0 - loading / unloading) / self.radii.effective),
                // K/(K - k1) phi 2R of two spheres; the flat is one as large as the ball
                "sphere_penetration_depth" => {
                    Some(0.5 * limit * (1.0 - loading / unloading) / self.radii.between_spheres())
                }
                _ => None,
            },
        }
    }

    fn of_spring(&self, key: &str, stiffness: f64, damping: f64) -> Option<f64> {
        let frequency = sqrt(stiffness / self.mass);
        let ratio = 0.5 * damping / sqrt(stiffness * self.mass);
        match key {
            "stiffness" => Some(stiffness),
            "damping" => Some(damping),
            "twice_stiffness" => Some(2.0 * stiffness),
            "half_damping" => Some(0.5 * damping),
            // of two balls with half of the mass, which then rebound alike
            "pair_damping" => Some(damping * FRAC_1_SQRT_2),
            "stiffness_per_mass" => Some(stiffness / self.mass),
            "damping_per_mass" => Some(damping / self.mass),
            "damping_ratio" => Some(ratio),
            "time_constant" => Some(1.0 / (ratio * frequency)),
            "erp" => self.step.map(|step| step * stiffness / (step * stiffness + damping)),
            "relaxation_time" => Some(damping / stiffness),
            "cfm" => self.step.map(|step| 1.0 / (step * stiffness + damping)),
            "width" => Some(self.depth / 20.0),
            // from 16/15 E* sqrt(R) (15 m V^2/(16 E* sqrt(R)))^0.2 with V = 1 m/s
            "hooke_modulus" => {
                let product = pow(stiffness / (pow(16.0 / 15.0, 0.8) * pow(self.mass, 0.2)), 1.25);
                Some(2.0 * (1.0 - POISSON * POISSON) * product / sqrt(self.radii.effective))
            }
            "pulling_restitution" => (ratio < 1.0).then(|| exp(-PI * ratio / sqrt(1.0 - ratio * ratio))),
            _ => None,
        }
    }

    /// A Hertz contact `4/3 E* sqrt(R)` with the damping `g sqrt(m F/x)`: it has the damping ratio `g/sqrt(5)`, at every speed.
    fn of_hertz(&self, key: &str, stiffness: f64, factor: f64) -> Option<f64> {
        let modulus = |radius: f64| 0.75 * stiffness / sqrt(radius);
        // of two equal materials
        let youngs = |modulus: f64| 2.0 * (1.0 - POISSON * POISSON) * modulus;
        match key {
            "youngs_modulus" => Some(youngs(modulus(self.radii.effective))),
            "sphere_youngs_modulus" => Some(youngs(modulus(self.radii.between_spheres()))),
            "damping_fraction" => Some(0.5 * factor / sqrt(1.5)),
            "typed_restitution" | "pulling_restitution" => {
                let ratio = factor / sqrt(5.0);
                // z = -ln E/sqrt(pi^2 + ln^2 E), as if the force pulled until the bodies are apart
                (ratio < 1.0).then(|| exp(-PI * ratio / sqrt(1.0 - ratio * ratio)))
            }
            _ => None,
        }
    }
}

/// The restitution E to type for which Exudyn's impactModel 2 damps with this `factor`, the dissipation times the speed at touch:
/// `1.5 (1 - E) (11 - E)/(1 + 9 E)` above 1/3, `(1 - E^2)/E` below; both are 8/3 at 1/3.
///
/// Reference: A. S. Carvalho, J. M. Martins, *Mechanism and Machine Theory* 139 (2019) 174-194.
fn impact_model_restitution(factor: f64) -> f64 {
    let upper = |restitution: f64| 1.5 * (1.0 - restitution) * (11.0 - restitution) / (1.0 + 9.0 * restitution);
    let lower = |restitution: f64| (1.0 - restitution * restitution) / restitution;
    border((0.0, 1.0), |restitution| {
        let reached = if restitution > 1.0 / 3.0 { upper(restitution) } else { lower(restitution) };
        reached <= factor
    })
}

/// The factor from SI to mm, tonne and second for a number of this `unit` with the exponent n.
pub fn in_millimetres(unit: &str, exponent: f64) -> Option<(f64, &'static str)> {
    match unit {
        "1" => Some((1.0, "1")),
        "s" => Some((1.0, "s")),
        "m" => Some((1e3, "mm")),
        "N/m" => Some((1e-3, "N/mm")),
        "N/m^n" => Some((pow(1e3, -exponent), "N/mm^n")),
        "N.s/m" => Some((1e-3, "N.s/mm")),
        "N.s/m^(n+1)" => Some((pow(1e3, -exponent - 1.0), "N.s/mm^(n+1)")),
        _ => None,
    }
}
