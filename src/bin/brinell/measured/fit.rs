//! Least squares: the parameters of a scene that explain a measurement, with their confidence intervals.
//!
//! The covariance of the parameters is `s^2 (J^T J)^-1`, with the Jacobian `J` of the differences at the optimum and
//! `s^2` their sum of squares over the degrees of freedom. The interval is the estimate plus and minus the 97.5 %
//! quantile of Student's t distribution times the standard error. This holds if the law is right and the errors of the
//! measurement are independent, of equal size, and small enough for the law to be linear in their range.
//!
//! Reference: G. A. F. Seber, C. J. Wild, *Nonlinear Regression*, Wiley 1989, sections 2.1 and 5.1.

use super::{Flow, Kind, Measured};
use crate::scene::{QuasiStatic, Rate, Scene};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, Owned};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// A parameter that a measurement can determine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
#[clap(rename_all = "snake_case")]
pub enum Fit {
    /// Quasi-static yield strength of the target [Pa]
    YieldStrength,
    /// Hardening modulus of the target [Pa]
    HardeningModulus,
    /// Constant of the rate model: c of johnson-cook, d of cowper-symonds
    Rate,
}

/// Confidence of the intervals.
const CONFIDENCE: f64 = 0.95;

/// Yield strengths that are tried, relative to the effective modulus, and the number of starting values.
const STRENGTHS: (f64, f64) = (1e-6, 0.5);
const STARTS: u32 = 60;

/// Step of the central differences, in units of the fitted variables.
const STEP: f64 = 1e-5;

/// A parameter on which no point depends more than this is not determined.
const NO_EFFECT: f64 = 1e-9;

/// A correlation of two parameters of which only a combination is determined.
const CORRELATED: f64 = 0.999;

/// Durbin and Watson's number below which differences follow a trend. Independent ones have about 2.
const TREND: f64 = 1.0;

/// Fewest points for that number.
const FEWEST_FOR_TREND: usize = 8;

/// A fitted parameter.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// Its name in the scene.
    pub name: &'static str,
    pub unit: &'static str,
    /// The scene's value.
    pub scene: f64,
    pub value: f64,
    /// Confidence interval, if the measurement gives one.
    pub interval: Option<(f64, f64)>,
    /// The reason why the measurement doesn't determine the parameter.
    pub doubt: Option<String>,
}

/// The result of a fit.
#[derive(Clone, Debug)]
pub struct Fitted {
    pub estimates: Vec<Estimate>,
    pub flow: Flow,
    /// Root mean square of the differences before and after the fit, in the unit of the measurement.
    pub rms: [f64; 2],
    /// Remarks on the quality of the fit.
    pub remarks: Vec<String>,
}

impl Fit {
    /// The name of the parameter in the scene, its unit, and its value.
    fn of(self, flow: &Flow) -> Result<(&'static str, &'static str, f64), String> {
        match (self, flow.rate) {
            (Fit::YieldStrength, _) => Ok(("target.yield_strength", "Pa", flow.hardening.yield_strength)),
            (Fit::HardeningModulus, _) => Ok(("target.hardening_modulus", "Pa", flow.hardening.hardening_modulus)),
            (Fit::Rate, Some(Rate::JohnsonCook { c, .. })) => Ok(("target.rate.c", "", c)),
            (Fit::Rate, Some(Rate::CowperSymonds { d, .. })) => Ok(("target.rate.d", "1/s", d)),
            (Fit::Rate, None) => Err("--fit rate needs a rate model in the scene: give target.rate".into()),
        }
    }

    /// Whether the logarithm of the parameter is fitted: it is positive, and its errors are ratios.
    fn is_logarithmic(self, flow: &Flow) -> bool {
        matches!((self, flow.rate), (Fit::YieldStrength, _) | (Fit::Rate, Some(Rate::CowperSymonds { .. })))
    }

    /// Size of the fitted variable in the unit of the parameter.
    fn size(self, modulus: f64) -> f64 {
        if self == Fit::HardeningModulus { modulus } else { 1.0 }
    }

    /// `flow` with this value of the parameter.
    fn set(self, flow: Flow, value: f64) -> Flow {
        let QuasiStatic { yield_strength, hardening_modulus } = flow.hardening;
        let with = |yield_strength, hardening_modulus| QuasiStatic { yield_strength, hardening_modulus };
        match (self, flow.rate) {
            (Fit::YieldStrength, _) => Flow { hardening: with(value, hardening_modulus), ..flow },
            (Fit::HardeningModulus, _) => Flow { hardening: with(yield_strength, value), ..flow },
            (Fit::Rate, Some(Rate::JohnsonCook { reference_rate, .. })) => {
                Flow { rate: Some(Rate::JohnsonCook { c: value, reference_rate }), ..flow }
            }
            (Fit::Rate, Some(Rate::CowperSymonds { q, .. })) => {
                Flow { rate: Some(Rate::CowperSymonds { d: value, q }), ..flow }
            }
            (Fit::Rate, None) => flow,
        }
    }
}

/// The parameters `fits` of `scene` that explain `measured` best.
///
/// # Errors
/// A sentence if the scene has no such parameter, the measurement can't depend on it, or the law can't be evaluated.
pub fn fit(scene: &Scene, measured: &Measured, fits: &[Fit]) -> Result<Fitted, String> {
    let flow = check(scene, measured, fits)?;
    let problem = Problem::new(scene, measured, fits, flow)?;
    let before = rms(&problem.differences(&flow).ok_or(BEYOND)?, measured);
    let start = problem.best_start();
    let solver = LevenbergMarquardt::new().with_patience(50);
    let (problem, _) = solver.minimize(Problem { at: start, ..problem });
    let found = problem.flow(&problem.at);
    let differences = problem.residuals().ok_or(BEYOND)?;
    let jacobian = problem.jacobian().ok_or(BEYOND)?;
    let (estimates, correlated) = problem.estimates(&jacobian, &differences);
    let mut remarks: Vec<String> = correlated.into_iter().collect();
    remarks.extend(trend(&differences));
    Ok(Fitted { estimates, flow: found, rms: [before, rms(&differences, measured)], remarks })
}

const BEYOND: &str = "the law of the scene can't be evaluated for all points of the measurement";

/// The flow stress of the scene, if these parameters can be fitted.
fn check(scene: &Scene, measured: &Measured, fits: &[Fit]) -> Result<Flow, String> {
    let law = scene.damped.map_or(scene.loading.0, |(name, _)| name);
    let flow = Flow::of(scene).ok_or(format!("the law {law} doesn't yield: it has no parameter to fit"))?;
    for (index, fit) in fits.iter().enumerate() {
        let (name, ..) = fit.of(&flow)?;
        if fits[..index].contains(fit) {
            return Err(format!("--fit names {name} twice"));
        }
        if scene.power_law.is_some() && *fit != Fit::Rate {
            return Err(format!("{name} follows from target.power_law: there is nothing to fit"));
        }
        if *fit == Fit::Rate && measured.kind == Kind::Force {
            return Err("--fit rate needs speeds: a force over depth says nothing of the strain rate".into());
        }
        if *fit == Fit::HardeningModulus && scene.model().loading.strengthened(0.0).is_none() {
            return Err(format!("the law {law} has no hardening modulus; brinell has"));
        }
    }
    Ok(flow)
}

/// Root mean square of differences in the unit of the measurement.
fn rms(differences: &DVector<f64>, measured: &Measured) -> f64 {
    measured.size() * (differences.norm_squared() / differences.len() as f64).sqrt()
}

/// A remark if neighbouring differences resemble each other.
fn trend(differences: &DVector<f64>) -> Option<String> {
    let squares = differences.norm_squared();
    let steps: f64 = differences.as_slice().windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
    // rounding has trends, too
    let matters = differences.len() >= FEWEST_FOR_TREND && squares > 1e-18;
    (matters && steps / squares < TREND).then(|| {
        format!(
            "The remaining differences follow a trend (Durbin-Watson {:.2}; independent ones have about 2): the law does not have \
             the shape of the measurement, and the intervals are too narrow.",
            steps / squares
        )
    })
}

impl Measured {
    /// The unit of the differences: a restitution, or the largest force.
    fn size(&self) -> f64 {
        match self.kind {
            Kind::Restitution => 1.0,
            Kind::Force => self.points.iter().map(|point| point.1).fold(0.0, f64::max),
        }
    }

    /// The value by the law with this flow stress.
    pub fn by(&self, scene: &Scene, flow: &Flow, at: f64) -> Option<f64> {
        match self.kind {
            Kind::Restitution => flow.restitution(scene, at),
            Kind::Force => flow.force(scene, at),
        }
    }
}

/// The least-squares problem.
struct Problem<'a> {
    scene: &'a Scene,
    measured: &'a Measured,
    fits: &'a [Fit],
    /// The scene's.
    given: Flow,
    modulus: f64,
    /// The fitted variables: logarithms, or values in units of [`Fit::size`].
    at: DVector<f64>,
}

impl<'a> Problem<'a> {
    fn new(scene: &'a Scene, measured: &'a Measured, fits: &'a [Fit], given: Flow) -> Result<Self, String> {
        let modulus = scene.any_model().pair().modulus;
        let start = |fit: &Fit| {
            let value = fit.of(&given)?.2;
            Ok::<f64, String>(if fit.is_logarithmic(&given) { value.ln() } else { value / fit.size(modulus) })
        };
        let at = fits.iter().map(start).collect::<Result<Vec<_>, _>>()?;
        Ok(Problem { scene, measured, fits, given, modulus, at: DVector::from_vec(at) })
    }

    /// The value of the parameter at `index` for these variables.
    fn value(&self, index: usize, at: &DVector<f64>) -> f64 {
        let fit = self.fits[index];
        if fit.is_logarithmic(&self.given) { at[index].exp() } else { at[index] * fit.size(self.modulus) }
    }

    /// The flow stress for these variables. A negative hardening or rate constant counts as zero.
    fn flow(&self, at: &DVector<f64>) -> Flow {
        let set = |flow, (index, fit): (usize, &Fit)| fit.set(flow, self.value(index, at).max(0.0));
        self.fits.iter().enumerate().fold(self.given, set)
    }

    /// Differences of the law from the measurement, relative to [`Measured::size`].
    fn differences(&self, flow: &Flow) -> Option<DVector<f64>> {
        let size = self.measured.size();
        let points = self.measured.points.iter();
        let all = points.map(|(at, value)| Some((self.measured.by(self.scene, flow, *at)? - value) / size));
        Some(DVector::from_vec(all.collect::<Option<Vec<_>>>()?))
    }

    /// The differences at `at`. Beyond a limit of zero they go on in a straight line, so that an estimate may lie there.
    fn extended(&self, at: &DVector<f64>) -> Option<DVector<f64>> {
        let mut inside = at.clone();
        let mut beyond = Vec::new();
        for (index, fit) in self.fits.iter().enumerate() {
            if !fit.is_logarithmic(&self.given) && at[index] < 0.0 {
                inside[index] = 0.0;
                beyond.push(index);
            }
        }
        let base = self.differences(&self.flow(&inside))?;
        let mut sum = base.clone();
        for index in beyond {
            let mut moved = inside.clone();
            moved[index] = STEP;
            let slope = (self.differences(&self.flow(&moved))? - &base) / STEP;
            sum += slope * at[index];
        }
        Some(sum)
    }

    fn squares(&self, at: &DVector<f64>) -> f64 {
        self.extended(at).map_or(f64::INFINITY, |differences| differences.norm_squared())
    }

    /// The best of some starting values: the scene's, and for a yield strength others.
    fn best_start(&self) -> DVector<f64> {
        let mut all = vec![self.at.clone()];
        if let Some(index) = self.fits.iter().position(|fit| *fit == Fit::YieldStrength) {
            let (low, high) = STRENGTHS;
            for start in 0..=STARTS {
                let part = f64::from(start) / f64::from(STARTS);
                let mut other = self.at.clone();
                other[index] = (low * self.modulus).ln() + part * (high / low).ln();
                all.push(other);
            }
        }
        let better = |one: &DVector<f64>, other: &DVector<f64>| self.squares(one).total_cmp(&self.squares(other));
        all.into_iter().min_by(better).unwrap_or_else(|| self.at.clone())
    }

    /// The estimates with their intervals, and a remark on parameters that can't be told apart.
    fn estimates(&self, jacobian: &DMatrix<f64>, differences: &DVector<f64>) -> (Vec<Estimate>, Option<String>) {
        let freedom = differences.len() as i64 - self.fits.len() as i64;
        let covariance = (jacobian.transpose() * jacobian).try_inverse();
        let correlated = covariance.as_ref().filter(|_| self.fits.len() > 1).is_some_and(|covariance| {
            let pairs = (0..self.fits.len()).flat_map(|one| (0..one).map(move |other| (one, other)));
            let of =
                |(one, other)| covariance[(one, other)] / (covariance[(one, one)] * covariance[(other, other)]).sqrt();
            pairs.map(of).any(|correlation: f64| correlation.is_nan() || correlation.abs() >= CORRELATED)
        });
        let error = |index: usize| {
            let covariance = covariance.as_ref().filter(|_| freedom > 0)?;
            let variance = differences.norm_squared() / freedom as f64 * covariance[(index, index)];
            let quantile = StudentsT::new(0.0, 1.0, freedom as f64).ok()?.inverse_cdf(0.5 + 0.5 * CONFIDENCE);
            Some(quantile * variance.sqrt()).filter(|error| error.is_finite())
        };
        let estimate = |(index, fit): (usize, &Fit)| {
            let (name, unit, scene) = fit.of(&self.given).unwrap_or(("", "", f64::NAN));
            let error = error(index);
            let at = |variable: f64| {
                let mut moved = self.at.clone();
                moved[index] = variable;
                self.value(index, &moved).max(0.0)
            };
            let interval = error.map(|error| (at(self.at[index] - error), at(self.at[index] + error)));
            let effect = jacobian.column(index).amax();
            let doubt = self.doubt(index, effect, freedom, error, interval);
            // an interval says nothing where the parameter has no effect
            let interval = interval.filter(|_| effect > NO_EFFECT && !correlated);
            Estimate { name, unit, scene, value: at(self.at[index]), interval, doubt }
        };
        let estimates = self.fits.iter().enumerate().map(estimate).collect();
        let remark = correlated.then(|| {
            "The measurement determines only a combination of the parameters: each can make up for another. Fit one of them.".into()
        });
        (estimates, remark)
    }

    /// The reason why the parameter at `index` is not determined.
    fn doubt(
        &self,
        index: usize,
        effect: f64,
        freedom: i64,
        error: Option<f64>,
        interval: Option<(f64, f64)>,
    ) -> Option<String> {
        let fit = self.fits[index];
        if effect <= NO_EFFECT {
            let why = match self.measured.kind {
                Kind::Restitution => {
                    "no restitution depends on it; impacts that do not yield, for example, rebound with all their energy"
                }
                Kind::Force => "no force depends on it; contacts that do not yield, for example, are elastic",
            };
            return Some(format!("not determined: {why}"));
        }
        if freedom <= 0 {
            let (points, parameters) = (self.measured.points.len(), self.fits.len());
            return Some(format!(
                "without an interval: {points} points for {parameters} parameters leave nothing to judge it by"
            ));
        }
        let (error, (low, high)) = (error?, interval?);
        if fit.is_logarithmic(&self.given) {
            return (error > std::f64::consts::LN_2)
                .then(|| format!("hardly determined: its interval spans a factor of {:.2e}", high / low));
        }
        if self.at[index] < 0.0 {
            return Some("not distinguishable from 0: the best value would be negative".into());
        }
        (self.at[index] - error <= 0.0).then(|| "not distinguishable from 0".into())
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, at: &DVector<f64>) {
        self.at.copy_from(at);
    }

    fn params(&self) -> DVector<f64> {
        self.at.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        self.extended(&self.at)
    }

    /// By central differences.
    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let column = |index: usize| {
            let [low, high] = [-STEP, STEP].map(|step| {
                let mut moved = self.at.clone();
                moved[index] += step;
                self.extended(&moved)
            });
            Some((high? - low?) / (2.0 * STEP))
        };
        let columns = (0..self.fits.len()).map(column).collect::<Option<Vec<_>>>()?;
        Some(DMatrix::from_columns(&columns))
    }
}
