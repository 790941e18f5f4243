//! The force laws of other tools, as they publish them, between a body of the effective mass and a fixed one.

use super::plastic::{Plastic, Thornton};
use libm::{pow, sqrt};
use std::f64::consts::PI;

/// The law of a tool with its numbers, in SI units. The overlap is `x`, the closing speed `w`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// `k x + c w`.
    Spring { stiffness: f64, damping: f64, pulls: bool },
    /// `k x + c max(w, 0)`: it damps only while the bodies approach.
    Approaching { stiffness: f64, damping: f64 },
    /// `k x^n (1 + d w)`.
    ///
    /// Reference: K. H. Hunt, F. R. E. Crossley, *J. Applied Mechanics* 42 (1975) 440-445.
    HuntCrossley { stiffness: f64, exponent: f64, dissipation: f64 },
    /// `k x^n + g sqrt(m k x^(n - 1)) w`: the same restitution at every speed.
    ///
    /// Reference: Y. Tsuji, T. Tanaka, T. Ishida, *Powder Technology* 71 (1992) 239-250.
    Proportional { stiffness: f64, exponent: f64, factor: f64, mass: f64, pulls: bool },
    /// `k x^n + C w`, where `C` grows from 0 to `c` over the `ramp` as `y^2 (3 - 2y)`: the function IMPACT.
    Impact { stiffness: f64, exponent: f64, damping: f64, ramp: f64 },
    /// `S + clip(d w, -S, S)` with `S = k x^n`: the damping never exceeds the spring.
    ElastoGap { stiffness: f64, exponent: f64, damping: f64 },
    /// `s (k x + c w)`, where `s` grows from 0 to 1 over the `width`; which way is not published, here as `y^2 (3 - 2y)`.
    Smooth { stiffness: f64, damping: f64, width: f64, pulls: bool },
    /// Loading with `k x^n`, unloading with `k/(1 - p) (x^n - p xm^n)` from the largest overlap `xm`: at every speed the same
    /// restitution.
    ///
    /// Reference: S. C. Thakur, J. P. Morrissey, J. Sun, J. F. Chen, J. Y. Ooi, *Granular Matter* 16 (2014) 383-400, without adhesion.
    Steeper { stiffness: f64, exponent: f64, ratio: f64 },
    /// Loading with `k1 x`, unloading with a slope that grows from `k1` to `k2` as the largest overlap grows to `limit`; beyond, both
    /// with the slope `k2`.
    ///
    /// `late`, in steps of a tool that takes the slope from the largest overlap of the step before: the last two of these \[m\].
    ///
    /// Reference: S. Luding, *Granular Matter* 10 (2008) 235-246.
    Luding { loading: f64, unloading: f64, limit: f64, late: Option<[f64; 2]> },
    /// An elastoplastic sphere on a rigid flat, without adhesion.
    Plastic(Plastic),
    /// Hertz, then linear; unloading as Hertz, summed up in steps.
    Thornton(Thornton),
}

impl Law {
    /// The force \[N\] at overlap `x` \[m\] and closing speed `w` \[m/s\]; `deepest` is the largest overlap of this contact so
    /// far. Negative where the surface would have to pull.
    pub fn force(&self, x: f64, w: f64, deepest: f64) -> f64 {
        let x = x.max(0.0);
        match *self {
            Law::Spring { stiffness, damping, .. } => stiffness * x + damping * w,
            Law::Approaching { stiffness, damping } => stiffness * x + damping * w.max(0.0),
            Law::HuntCrossley { stiffness, exponent, dissipation } => {
                stiffness * pow(x, exponent) * (1.0 + dissipation * w)
            }
            Law::Proportional { stiffness, exponent, factor, mass, .. } => {
                stiffness * pow(x, exponent) + factor * sqrt(mass * stiffness * pow(x, exponent - 1.0)) * w
            }
            Law::Impact { stiffness, exponent, damping, ramp } => {
                stiffness * pow(x, exponent) + damping * smooth(x / ramp) * w
            }
            Law::ElastoGap { stiffness, exponent, damping } => {
                let spring = stiffness * pow(x, exponent);
                spring + (damping * w).clamp(-spring, spring)
            }
            Law::Smooth { stiffness, damping, width, .. } => smooth(x / width) * (stiffness * x + damping * w),
            Law::Steeper { stiffness, exponent, ratio } => {
                let spring = stiffness * pow(x, exponent);
                let way_back = (spring - ratio * stiffness * pow(deepest.max(x), exponent)) / (1.0 - ratio);
                way_back.min(spring)
            }
            Law::Luding { loading, unloading, limit, late } => {
                let deepest = deepest.max(x);
                let slope = |deepest: f64| loading + (unloading - loading) * (deepest / limit).min(1.0);
                let way_back = match late {
                    Some([before, last]) if last > 0.0 => {
                        let left = (1.0 - loading / slope(before)) * deepest;
                        let most = (1.0 - loading / unloading) * limit;
                        slope(if x < deepest { deepest } else { before }) * (x - left.min(most))
                    }
                    _ if deepest < limit => loading * deepest - slope(deepest) * (deepest - x),
                    _ => loading * limit - unloading * (limit - x),
                };
                // beyond the limit loading and unloading are one line
                if x < limit { way_back.min(loading * x) } else { way_back }
            }
            Law::Plastic(plastic) => plastic.force(x, deepest.max(x)),
            Law::Thornton(thornton) => thornton.force(x, deepest.max(x)),
        }
    }

    /// Whether the surface may pull until the bodies are apart.
    pub fn pulls(&self) -> bool {
        match *self {
            Law::Spring { pulls, .. } | Law::Proportional { pulls, .. } | Law::Smooth { pulls, .. } => pulls,
            _ => false,
        }
    }

    /// Stiffness \[N/m^n\] and exponent of the elastic part.
    pub fn elastic(&self) -> (f64, f64) {
        match *self {
            Law::Spring { stiffness, .. } | Law::Approaching { stiffness, .. } | Law::Smooth { stiffness, .. } => {
                (stiffness, 1.0)
            }
            Law::HuntCrossley { stiffness, exponent, .. }
            | Law::Proportional { stiffness, exponent, .. }
            | Law::Impact { stiffness, exponent, .. }
            | Law::Steeper { stiffness, exponent, .. }
            | Law::ElastoGap { stiffness, exponent, .. } => (stiffness, exponent),
            Law::Luding { loading, .. } => (loading, 1.0),
            Law::Plastic(Plastic { modulus, radius, .. }) => (4.0 / 3.0 * modulus * sqrt(radius), 1.5),
            Law::Thornton(Thornton { stiffness, .. }) => (stiffness, 1.5),
        }
    }

    /// The law of a contact in steps that is at the overlap `x` \[m\], `deepest` at most so far: tools that remember more than
    /// this do so step by step.
    pub fn noticing(self, x: f64, deepest: f64) -> Law {
        match self {
            Law::Plastic(plastic) => Law::Plastic(plastic.noticing(x)),
            Law::Thornton(thornton) => Law::Thornton(thornton.noticing(x, deepest)),
            Law::Luding { loading, unloading, limit, late: Some([_, last]) } if x > last => {
                Law::Luding { loading, unloading, limit, late: Some([last, x]) }
            }
            law => law,
        }
    }
}

/// From 0 to 1 with slopes of zero at both ends.
fn smooth(y: f64) -> f64 {
    let y = y.clamp(0.0, 1.0);
    y * y * (3.0 - 2.0 * y)
}

/// The form of a law, whose two numbers are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Form {
    Spring,
    PullingSpring,
    Approaching,
    /// With the exponent 1.
    LinearHuntCrossley,
    /// With Hertz's exponent.
    HertzHuntCrossley,
    HuntCrossley,
    /// With Hertz's exponent and a damping in proportion.
    Hertz,
    PullingHertz,
    Impact,
    ElastoGap,
    Steeper,
    Luding,
    /// With the slope a step late.
    LateLuding,
    /// An elastoplastic sphere.
    Plastic,
    Thornton,
}

/// What a form may have to choose, beside its two numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    pub exponent: f64,
    /// The length over which the damping of IMPACT grows, in scales of the overlap.
    pub ramp: f64,
}

impl Form {
    /// The shape of a form that has none to choose.
    pub fn shape(self) -> Shape {
        let hertzian =
            matches!(self, Form::HertzHuntCrossley | Form::Hertz | Form::PullingHertz | Form::Plastic | Form::Thornton);
        Shape { exponent: if hertzian { 1.5 } else { 1.0 }, ramp: 1.0 }
    }

    /// Whether exponent and ramp are numbers that the user types.
    pub fn chooses(self) -> (bool, bool) {
        let exponent = matches!(self, Form::HuntCrossley | Form::Impact | Form::ElastoGap | Form::Steeper);
        (exponent, self == Form::Impact)
    }

    /// The law in which a mass at the speed of `impact` would come to rest at the overlap `scale` \[m\] by its spring alone, with a
    /// number without unit for its `losses`. All that happens in the impact, over the scales of length, speed and mass, depends on
    /// shape and losses only, but for a plastic sphere, which has its radius.
    pub fn law(self, scale: f64, shape: Shape, losses: f64, impact: &Scales) -> Law {
        let Scales { mass, speed, fastest, radius } = *impact;
        let exponent = shape.exponent;
        let stiffness = 0.5 * (exponent + 1.0) * mass * speed * speed / pow(scale, exponent + 1.0);
        let damping = 2.0 * losses * mass * speed / scale;
        match self {
            Form::Spring | Form::PullingSpring => {
                Law::Spring { stiffness, damping, pulls: self == Form::PullingSpring }
            }
            Form::Approaching => Law::Approaching { stiffness, damping },
            Form::LinearHuntCrossley | Form::HertzHuntCrossley | Form::HuntCrossley => {
                Law::HuntCrossley { stiffness, exponent, dissipation: losses / speed }
            }
            Form::Hertz | Form::PullingHertz => {
                let pulls = self == Form::PullingHertz;
                Law::Proportional { stiffness, exponent, factor: 2.0 * losses, mass, pulls }
            }
            Form::Impact => Law::Impact { stiffness, exponent, damping, ramp: shape.ramp * scale },
            Form::ElastoGap => Law::ElastoGap { stiffness, exponent, damping },
            Form::Steeper => Law::Steeper { stiffness, exponent, ratio: losses / (1.0 + losses) },
            Form::Luding | Form::LateLuding => {
                // below the limit the slope grows in proportion to the overlap, which is reached at the largest speed
                let (limit, growth) = (scale * fastest / speed, losses * fastest / speed);
                let late = (self == Form::LateLuding).then_some([0.0; 2]);
                Law::Luding { loading: stiffness, unloading: stiffness * (1.0 + growth), limit, late }
            }
            Form::Plastic => {
                // Hertz's mean pressure at the scale, over that of the yielding sphere
                let modulus = 0.75 * stiffness / sqrt(radius);
                let pressure = 4.0 * modulus * sqrt(scale / radius) / (3.0 * PI);
                Law::Plastic(Plastic::new(modulus, pressure / (2.75 * losses), radius))
            }
            // yield begins at this part of the scale
            Form::Thornton => Law::Thornton(Thornton::new(stiffness, scale / (losses * losses))),
        }
    }
}

/// What an impact has of its own.
#[derive(Clone, Copy, Debug)]
pub struct Scales {
    /// Effective mass \[kg\].
    pub mass: f64,
    /// Closing speed at touch \[m/s\] at which the numbers are found.
    pub speed: f64,
    /// Largest speed \[m/s\] of the range.
    pub fastest: f64,
    /// Effective radius \[m\].
    pub radius: f64,
}
