//! The strength that a hardness, a tensile strength or a tensile test says: a flow stress with the strain at which it holds, and how sure it is.
//!
//! A perfectly plastic law has one strength, the flow stress at the strain of its own dent, `0.2 a/R` (Tabor 1951). A hardness test makes
//! a deeper dent than an impact, so its flow stress is taken along the hardening `sigma ~ eps^n` to the strain of the impact.

use crate::bisection::border;
use crate::model::{AnyModel, paired};
use crate::numbers::{cell, in_message, quantity};
use crate::pairing::{published, unloading_of};
use crate::reading::{KGF_PER_MM2, Reading, Spread, parted};
use crate::table;
use crate::table::{Class, Material};
use crate::tension::Tension;
use brinell_contact::impact::Impact;
use brinell_contact::material::hardening::Hardening;
use brinell_contact::rate::{self, Rate, TABOR};
use brinell_contact::{Body, Model, OtherBody, Pair, Surface, TwoBodies};
use std::f64::consts::PI;

/// Tungsten carbide, of which the balls of hardness tests are: Young's modulus \[Pa\] and Poisson's ratio.
const CARBIDE: (f64, f64) = (600e9, 0.22);

/// Contact radius over ball radius, and the mean pressure over the flow stress at the strain `0.2 a/R`, for `E*/S` of 100 and 200. From
/// finite elements of a frictionless sphere with large deformation; at 200 beyond 0.36 assumed to join the other.
const CONSTRAINT: [(f64, f64, f64); 10] = [
    (0.15, 2.39, 2.69),
    (0.2, 2.54, 2.76),
    (0.25, 2.62, 2.78),
    (0.3, 2.67, 2.77),
    (0.36, 2.69, 2.75),
    (0.4, 2.69, 2.72),
    (0.44, 2.68, 2.68),
    (0.5, 2.65, 2.65),
    (0.57, 2.59, 2.59),
    // to the largest dent that ISO 6506-1 admits, along the last slope
    (0.6, 2.565, 2.565),
];

/// `E*/S` to which the constraint is continued, linearly in `S/E*`.
const STIFFNESS: (f64, f64) = (60.0, 400.0);

/// Measured tension and these pressures differ by 6 %, perhaps by friction; each is believed half.
const FRICTION: f64 = 1.03;

/// Vickers hardness at 20 to 68 HRC.
///
/// Reference: ASTM E140, table 1.
const ROCKWELL_C: [f64; 49] = [
    238.0, 243.0, 248.0, 254.0, 260.0, 266.0, 272.0, 279.0, 286.0, 294.0, 302.0, 310.0, 318.0, 327.0, 336.0, 345.0,
    354.0, 363.0, 372.0, 382.0, 392.0, 402.0, 412.0, 423.0, 434.0, 446.0, 458.0, 471.0, 484.0, 498.0, 513.0, 528.0,
    544.0, 560.0, 577.0, 595.0, 613.0, 633.0, 653.0, 674.0, 697.0, 720.0, 746.0, 772.0, 800.0, 832.0, 865.0, 900.0,
    940.0,
];

/// Vickers hardness at 55 to 100 HRB.
///
/// Reference: ASTM E140, table 2.
const ROCKWELL_B: [f64; 46] = [
    100.0, 101.0, 103.0, 104.0, 106.0, 107.0, 108.0, 110.0, 112.0, 114.0, 116.0, 117.0, 119.0, 121.0, 123.0, 125.0,
    127.0, 130.0, 132.0, 135.0, 137.0, 139.0, 141.0, 144.0, 147.0, 150.0, 153.0, 156.0, 159.0, 162.0, 165.0, 169.0,
    172.0, 176.0, 180.0, 185.0, 190.0, 195.0, 200.0, 205.0, 210.0, 216.0, 222.0, 228.0, 234.0, 240.0,
];

/// Strain of a Vickers test, and that at which the flow stress is 1.05 times the tensile strength \[-\].
const VICKERS_STRAIN: f64 = 0.08;

/// The rebound hardness device D: radius \[m\], Young's modulus \[Pa\] and Poisson's ratio of its ball, and its impact.
const DEVICE: (f64, f64, f64) = (1.5e-3, 620e9, 0.22);
const DEVICE_IMPACT: Impact = Impact { mass: 5.45e-3, speed: 2.05 };

/// How much stronger steel is in the impact of this device than in a slow test. It enters the choice of an exponent alone.
const DEVICE_RATE: f64 = 1.25;

/// A strain of impacts \[-\], for which messages name the flow stress of a tensile test.
pub const IMPACT_STRAIN: f64 = 0.03;

/// The strain rate of hardness and tensile tests \[1/s\], where a strain-rate law on top of their strength starts.
pub const TEST_RATE: f64 = 1e-3;

/// The rate dependence of steel if the scene gives none: that of AISI 4340.
///
/// Reference: G. R. Johnson, W. H. Cook, *7th International Symposium on Ballistics* (1983) 541-547.
pub const STEEL_RATE: Rate = Rate::JohnsonCook { c: 0.014, reference_rate: TEST_RATE };

impl Class {
    /// The class by Young's modulus \[Pa\].
    pub fn of_modulus(youngs_modulus: f64) -> Class {
        match youngs_modulus {
            modulus if (170e9..=230e9).contains(&modulus) => Class::Steel,
            modulus if (60e9..=80e9).contains(&modulus) => Class::Aluminium,
            _ => Class::Other,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Class::Steel => "steel",
            Class::Austenitic => "austenitic steel",
            Class::Aluminium => "aluminium",
            Class::Other => "this metal",
        }
    }

    /// The hardening exponent of tension, of steel with this Vickers hardness. Rows of handbooks have 0.15 +- 0.04 for soft steel, and
    /// 0.05 to 0.1 for hardened; 0.21 +- 0.06 for austenitic; 0.13 +- 0.07 for aluminium.
    fn exponent(self, vickers: f64) -> Option<f64> {
        const SOFT: (f64, f64) = (210.0, 0.15);
        const HARD: (f64, f64) = (450.0, 0.06);
        match self {
            Class::Steel => {
                let part = ((vickers - SOFT.0) / (HARD.0 - SOFT.0)).clamp(0.0, 1.0);
                Some(SOFT.1 + part * (HARD.1 - SOFT.1))
            }
            Class::Austenitic => Some(0.21),
            Class::Aluminium => Some(0.13),
            Class::Other => None,
        }
    }
}

/// The metal that was tested.
#[derive(Clone, Copy, Debug)]
pub struct Metal {
    /// Young's modulus \[Pa\].
    pub youngs_modulus: f64,
    pub poissons_ratio: f64,
    pub class: Class,
    /// Hardening exponent, if known.
    pub exponent: Option<f64>,
}

/// A flow stress from a reading.
#[derive(Clone, Debug)]
pub struct MeasuredStrength {
    /// The reading: `200 HBW 10/3000`.
    pub given: String,
    /// Flow stress \[Pa\] at the plastic `strain` \[-\].
    pub stress: f64,
    pub strain: f64,
    /// `n` of the hardening through that point, and whether it is that of the class.
    pub exponent: f64,
    exponent_is_assumed: bool,
    /// Relative uncertainty of the stress in an impact: one standard deviation \[-\].
    pub uncertainty: f64,
    /// How the stress was found.
    way: String,
    pub class: Class,
    /// Whether the test was an impact, so that its rate is in the strength already.
    pub has_rate: bool,
    /// The tensile test, if it was one.
    pub tension: Option<Tension>,
    /// Whether the law takes its hardening in the impact, too.
    hardens: bool,
}

impl MeasuredStrength {
    /// Flow stress \[Pa\] at a plastic `strain`.
    pub fn at(&self, strain: f64) -> f64 {
        self.stress * libm::pow(strain / self.strain, self.exponent)
    }

    /// What stands for it in an impact with this plastic `strain`: the tangent of a tensile test there, `(1 - n) S + (n S/eps) eps_p`, for a
    /// law that hardens; else the flow stress alone.
    pub fn hardening(&self, strain: f64) -> Hardening {
        let stress = self.at(strain);
        let part = if self.hardens { self.exponent } else { 0.0 };
        Hardening { yield_strength: (1.0 - part) * stress, hardening_modulus: part * stress / strain }
    }

    /// Whether the law takes its hardening in the impact.
    pub fn hardens(&self) -> bool {
        self.hardens
    }

    /// The flow stress \[Pa\] of whose tangent this is the yield strength \[Pa\], for a law that takes no hardening.
    pub fn without_hardening(&self, yield_strength: f64) -> f64 {
        if self.hardens { yield_strength / (1.0 - self.exponent) } else { yield_strength }
    }

    /// Whether it is that of steel in a slow test.
    pub fn is_slow_steel(&self) -> bool {
        self.class == Class::Steel && !self.has_rate
    }

    /// What was made of the reading, in words.
    pub fn words(&self) -> String {
        let MeasuredStrength { given, exponent, way, .. } = self;
        let assumed =
            if self.exponent_is_assumed { format!(", assumed for {}", self.class.name()) } else { String::new() };
        format!(
            "{given} is a flow stress of {} at a plastic strain of {} ({way}; standard deviation {} %); hardening exponent {}{assumed}",
            quantity(self.stress, "Pa"),
            cell(self.strain, 1.0),
            cell(100.0 * self.uncertainty, 1.0),
            cell(*exponent, 1.0),
        )
    }
}

/// What a `text` such as `200 HBW 10/3000` says of the flow stress of a `metal`.
///
/// # Errors
/// A sentence with what is wrong, and what is allowed.
pub fn of_hardness(text: &str, metal: &Metal) -> Result<MeasuredStrength, String> {
    let (reading, spread) = parted(text)?;
    let found = of_reading(text, &reading, metal)?;
    let Some(Spread { ends, deviations }) = spread else { return Ok(found) };
    let stress = |end: &String| of_reading(text, end, metal).map(|found| found.at(IMPACT_STRAIN));
    let [low, high] = [stress(&ends[0])?, stress(&ends[1])?];
    let of_spread = (high - low).abs() / (high + low) / deviations;
    let way = format!("{}; {} % of spread", found.way, cell(100.0 * of_spread, 1.0));
    Ok(MeasuredStrength { uncertainty: found.uncertainty.hypot(of_spread), way, ..found })
}

/// What one number on its scale says, which is `given` as this text.
fn of_reading(given: &str, reading: &str, metal: &Metal) -> Result<MeasuredStrength, String> {
    let class = metal.class;
    let reading = Reading::parse(reading)?;
    let has_rate = matches!(reading, Reading::Leeb(_));
    let (stress, strain, vickers, uncertainty, way) = match reading {
        Reading::Brinell(number, test) => {
            let (stress, strain) = by_brinell(number, test, metal)?;
            let uncertainty = match class {
                Class::Steel => 0.08,
                Class::Aluminium => 0.1,
                Class::Austenitic => 0.12,
                Class::Other => 0.15,
            };
            (
                stress,
                strain,
                number / 0.95,
                uncertainty,
                "mean pressure of a Brinell test by finite elements with large deformation",
            )
        }
        Reading::Vickers(number) => {
            let stress = by_vickers(number, metal)?;
            let uncertainty = if class == Class::Steel { of_hard_steel(number) } else { 0.15 };
            (stress, VICKERS_STRAIN, number, uncertainty, "constraint of a Vickers test")
        }
        Reading::Rockwell(number, scale) => {
            let vickers = by_table(number, scale, class)?;
            let stress = by_vickers(vickers, metal)?;
            (
                stress,
                VICKERS_STRAIN,
                vickers,
                of_hard_steel(vickers),
                "by ASTM E140 and the constraint of a Vickers test",
            )
        }
        Reading::Leeb(number) => {
            let (stress, strain) = by_rebound(number, metal)?;
            let vickers = 2.8 * stress / (DEVICE_RATE * KGF_PER_MM2);
            (stress, strain, vickers, 0.08, "rebound of device D by the law brinell, with its strain rate")
        }
    };
    // tension says 9 % more of aluminium than its hardness
    let stress = if class == Class::Aluminium && !has_rate { 1.09 * stress } else { stress };
    measured(given, (stress, strain), (uncertainty, way), has_rate, (vickers, metal))
}

/// What a tensile `strength` \[Pa\] says of the flow stress of a `metal`: 1.05 times it at a strain of 8 %.
///
/// # Errors
/// A sentence with what is wrong.
pub fn of_tensile_strength(strength: f64, metal: &Metal) -> Result<MeasuredStrength, String> {
    let uncertainty = match metal.class {
        Class::Steel => 0.07,
        // 4 % at the strain of the test, and an exponent of 0.13 +- 0.07 from there to an impact
        Class::Aluminium => 0.08,
        Class::Austenitic => 0.1,
        Class::Other => 0.15,
    };
    let stress = 1.05 * strength;
    // by ISO 18265, 3.3 MPa to each HV
    let vickers = strength / 3.3e6;
    let given = format!("A tensile strength of {}", quantity(strength, "Pa"));
    let point = (stress, VICKERS_STRAIN);
    measured(&given, point, (uncertainty, "1.05 times the tensile strength"), false, (vickers, metal))
}

/// What a tensile `test` says of the flow stress of a `metal`. `hardens` is whether the law of the scene takes hardening.
///
/// # Errors
/// None but those that every strength has.
pub fn of_tensile_test(given: &str, test: Tension, hardens: bool, metal: &Metal) -> Result<MeasuredStrength, String> {
    let metal = Metal { exponent: Some(test.law.exponent), ..*metal };
    let stress = test.law.coefficient * libm::pow(IMPACT_STRAIN, test.law.exponent);
    let way = (test.uncertainty, test.way.as_str());
    let found = measured(given, (stress, IMPACT_STRAIN), way, false, (0.0, &metal))?;
    Ok(MeasuredStrength { hardens, tension: Some(test), ..found })
}

/// The strength of a `material` that isn't a number alone, as that of a `metal`; `None` if it has a yield strength, or stays
/// elastic.
pub fn of_material(material: &Material, metal: &Metal) -> Option<MeasuredStrength> {
    let name = &material.name;
    let metal = Metal { exponent: material.hardening_exponent, ..*metal };
    if let Some(table::Tension { coefficient, exponent }) = material.tension {
        let metal = Metal { exponent: Some(exponent), ..metal };
        let point = (coefficient * libm::pow(VICKERS_STRAIN, exponent), VICKERS_STRAIN);
        let way = (0.1, "yield and tensile strength of handbooks");
        return measured(name, point, way, false, (0.0, &metal)).ok();
    }
    let found = of_hardness(material.hardness.as_ref()?, &metal).ok()?;
    Some(MeasuredStrength { given: format!("{name}, {},", found.given), ..found })
}

/// The strength with the hardening exponent of the metal, or of its class.
fn measured(
    given: &str,
    (stress, strain): (f64, f64),
    (uncertainty, way): (f64, &str),
    has_rate: bool,
    (vickers, metal): (f64, &Metal),
) -> Result<MeasuredStrength, String> {
    let Metal { class, youngs_modulus, .. } = *metal;
    let exponent = metal.exponent.or_else(|| class.exponent(vickers)).ok_or_else(|| {
        format!(
            "the flow stress is that of the test's strain, and how it changes to that of an impact is known for steel and aluminium; \
             with a Young's modulus of {} give hardening_exponent, the n of sigma = K eps^n (0 if it doesn't harden, copper and \
             brass 0.1 cold worked and 0.3 annealed, titanium 0.1)",
            quantity(youngs_modulus, "Pa")
        )
    })?;
    let exponent_is_assumed = metal.exponent.is_none();
    let given = given.trim().to_string();
    let way = way.into();
    let (tension, hardens) = (None, false);
    Ok(MeasuredStrength {
        given,
        stress,
        strain,
        exponent,
        exponent_is_assumed,
        uncertainty,
        way,
        class,
        has_rate,
        tension,
        hardens,
    })
}

/// The uncertainty of the strength of steel from a Vickers hardness. Tension says little of steel from 600 HV on.
fn of_hard_steel(vickers: f64) -> f64 {
    if vickers >= 600.0 { 0.1 } else { 0.08 }
}

/// A number on a scale must be in its range.
fn check(number: f64, scale: &str, (least, most): (f64, f64), why: &str) -> Result<(), String> {
    if (least..=most).contains(&number) {
        return Ok(());
    }
    Err(format!("{} {scale} is out of range: allowed is {least} to {most}{why}", in_message(number)))
}

/// Effective modulus \[Pa\] of a ball of tungsten carbide on a `metal`.
fn effective_modulus(metal: &Metal) -> f64 {
    let of = |modulus: f64, ratio: f64| (1.0 - ratio * ratio) / modulus;
    1.0 / (of(CARBIDE.0, CARBIDE.1) + of(metal.youngs_modulus, metal.poissons_ratio))
}

/// Mean pressure over flow stress at this contact radius over ball radius, and this `S/E*`.
fn constraint(ratio: f64, softness: f64) -> f64 {
    let softness = softness.clamp(1.0 / STIFFNESS.1, 1.0 / STIFFNESS.0);
    let place = CONSTRAINT.windows(2).position(|pair| ratio <= pair[1].0).unwrap_or(CONSTRAINT.len() - 2);
    let (from, to) = (CONSTRAINT[place], CONSTRAINT[place + 1]);
    let part = (ratio - from.0) / (to.0 - from.0);
    let [of_100, of_200] = [from.1 + part * (to.1 - from.1), from.2 + part * (to.2 - from.2)];
    of_200 + (of_100 - of_200) * (softness - 1.0 / 200.0) / (1.0 / 100.0 - 1.0 / 200.0)
}

/// The fixed point of `next`, which contracts: the constraint hardly depends on the strength.
fn settled(first: f64, next: impl Fn(f64) -> f64) -> f64 {
    (0..60).fold(first, |stress, _| next(stress))
}

/// Flow stress \[Pa\] and strain of a Brinell test with this ball \[m\] and load \[N\].
///
/// # Errors
/// A sentence about a test that isn't one.
pub fn by_brinell(number: f64, test: Option<(f64, f64)>, metal: &Metal) -> Result<(f64, f64), String> {
    check(number, "HBW", (3.0, 650.0), "; harder metals take HV or HRC")?;
    let (ball, load) = match test {
        Some(test) => test,
        // the test of steel
        None if metal.class != Class::Aluminium && metal.class != Class::Other && number >= 96.0 => {
            (1e-3 * 10.0, 1e-6 * KGF_PER_MM2 * 3000.0)
        }
        None => {
            let message =
                "the hardness of a soft metal depends on the load: give ball and load, as in \"95 HBW 10/500\"";
            return Err(message.into());
        }
    };
    let depth = load / (PI * ball * number * KGF_PER_MM2);
    let ratio = 2.0 * (depth * (ball - depth)).sqrt() / ball;
    let (least, most) = (CONSTRAINT[0].0, CONSTRAINT[CONSTRAINT.len() - 1].0);
    // NaN for a dent wider than the ball
    if depth > 0.5 * ball || !(least..=most).contains(&ratio) {
        let of_ball = if depth > 0.5 * ball { "more than the".into() } else { format!("{} of the", cell(ratio, 1.0)) };
        return Err(format!(
            "with this ball and load the dent's diameter would be {of_ball} ball's: {least} to {most} are known; is the load right?"
        ));
    }
    let radius = 0.5 * ratio * ball;
    let pressure = load / (PI * radius * radius);
    let modulus = effective_modulus(metal);
    let stress = settled(pressure / 2.8, |stress| pressure / (FRICTION * constraint(ratio, stress / modulus)));
    Ok((stress, TABOR * ratio))
}

/// The Brinell number that such a test finds for a `metal` with this flow stress \[Pa\] at a strain, the inverse of [`by_brinell`]; `None`
/// if it is none of the table.
pub fn brinell_of(flow_stress: impl Fn(f64) -> f64, (ball, load): (f64, f64), metal: &Metal) -> Option<f64> {
    let number = |ratio: f64| load / (PI * ball * 0.5 * ball * (1.0 - (1.0 - ratio * ratio).sqrt()) * KGF_PER_MM2);
    let over = |number: f64| {
        by_brinell(number, Some((ball, load)), metal).map(|(stress, strain)| stress - flow_stress(strain))
    };
    // the last digits of the ends of the table
    let (low, high) = (1.000_001 * number(0.6), (0.999_999 * number(0.15)).min(650.0));
    if !(over(low).is_ok_and(|over| over <= 0.0) && over(high).is_ok_and(|over| over >= 0.0)) {
        return None;
    }
    Some(border((low, high), |number| over(number).is_ok_and(|over| over >= 0.0)))
}

/// Flow stress \[Pa\] at a strain of 8 % from a Vickers hardness. Pyramid and ball are compared at HBW = 0.95 HV.
fn by_vickers(number: f64, metal: &Metal) -> Result<f64, String> {
    check(number, "HV", (5.0, 1000.0), "")?;
    let (pressure, modulus) = (number * KGF_PER_MM2, effective_modulus(metal));
    let constraint = |stress: f64| 2.8 + (0.5 * libm::log(modulus / (120.0 * stress))).min(0.0);
    Ok(settled(pressure / 2.8, |stress| pressure / constraint(stress)))
}

/// Vickers hardness for a Rockwell hardness of steel.
fn by_table(number: f64, scale: char, class: Class) -> Result<f64, String> {
    if class != Class::Steel {
        return Err(format!(
            "HR{scale} is converted by a table for steel that isn't austenitic, and this is {}: give HBW with ball and load, HV, or \
             tensile_strength",
            class.name()
        ));
    }
    let (table, first): (&[f64], f64) = if scale == 'C' { (&ROCKWELL_C, 20.0) } else { (&ROCKWELL_B, 55.0) };
    let last = first + (table.len() - 1) as f64;
    let why = if scale == 'C' { "; softer steel takes HRB, HBW or HV" } else { "; harder steel takes HRC, HBW or HV" };
    check(number, &format!("HR{scale}"), (first, last), why)?;
    let place = ((number - first) as usize).min(table.len() - 2);
    Ok(table[place] + (number - first - place as f64) * (table[place + 1] - table[place]))
}

/// Flow stress \[Pa\] and strain in the impact of device D, whose restitution is a thousandth of its number.
fn by_rebound(number: f64, metal: &Metal) -> Result<(f64, f64), String> {
    check(number, "HLD", (170.0, 900.0), "")?;
    let (radius, youngs_modulus, poissons_ratio) = DEVICE;
    let ball = Body { radius, youngs_modulus, poissons_ratio };
    let Metal { youngs_modulus, poissons_ratio, .. } = *metal;
    let plane = Body { radius: f64::INFINITY, youngs_modulus, poissons_ratio };
    let none = || format!("no strength explains {} HLD on this metal", in_message(number));
    let (loading, unloading) = (published("brinell"), unloading_of("brinell").1);
    let other =
        OtherBody { modulus: ball.plane_strain_modulus(), poissons_ratio: ball.poissons_ratio, ..OtherBody::RIGID };
    let bodies = TwoBodies { hardening_modulus: 0.0, curvature: 0.0, other };
    let model = |strength: f64| {
        let pair = Pair::new(&ball, &plane, strength)?;
        let model = Model { pair, loading, unloading, surface: Surface::Dented };
        Some(paired(&model, bodies, crate::body::Body::Target).prepared())
    };
    let predict = |strength: f64| AnyModel::Elastoplastic(model(strength)?).predict(&DEVICE_IMPACT);
    let restitution = |strength: f64| predict(strength).map_or(0.0, |prediction| prediction.restitution);
    let (soft, hard) = (1e-5 * youngs_modulus, 0.1 * youngs_modulus);
    if !(restitution(soft) < 1e-3 * number && 1e-3 * number < restitution(hard)) {
        return Err(none());
    }
    let hard = border((soft, hard), |strength| restitution(strength) >= 1e-3 * number);
    let (model, prediction) = model(hard).zip(predict(hard)).ok_or_else(none)?;
    Ok((hard, rate::strains(&model, &prediction).softer))
}
