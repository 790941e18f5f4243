//! Least squares: the parameters of a scene that explain a measurement, with their confidence intervals.
//!
//! The covariance of the parameters is `s^2 (J^T J)^-1`, with the Jacobian `J` of the differences at the optimum and
//! `s^2` their sum of squares over the degrees of freedom. The interval is the estimate plus and minus the 97.5 %
//! quantile of Student's t distribution times the standard error. This holds if the law is right and the errors of the
//! measurement are independent, of equal size, and small enough for the law to be linear in their range.
//!
//! Reference: G. A. F. Seber, C. J. Wild, *Nonlinear Regression*, Wiley 1989, sections 2.1 and 5.1.

use super::problem::Problem;
use super::{Fit, Flow, Kind, Measured};
use crate::scene::Scene;
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Confidence of the intervals.
const CONFIDENCE: f64 = 0.95;

/// A parameter on which no point depends more than this is not determined.
const NO_EFFECT: f64 = 1e-9;

/// A correlation of two parameters of which only a combination is determined.
const CORRELATED: f64 = 0.999;

/// Durbin and Watson's number below which differences follow a trend. Independent ones have about 2.
const TREND: f64 = 1.0;

/// A sum of squares that is rounding.
const ROUNDING: f64 = 1e-14;

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

/// The parameters `fits` of `scene` that explain `measured` best.
///
/// # Errors
/// A sentence if the scene has no such parameter, the measurement can't depend on it, or the law can't be evaluated.
pub fn fit(scene: &Scene, measured: &Measured, fits: &[Fit]) -> Result<Fitted, String> {
    let flow = check(scene, measured, fits)?;
    let problem = Problem::new(scene, measured, fits, flow)?;
    let before = rms(&problem.differences(&flow).ok_or(BEYOND)?, measured);
    let problem = problem.at_best_start();
    let solver = LevenbergMarquardt::new().with_patience(50);
    let (problem, _) = solver.minimize(problem);
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
        if scene.power_law(0).is_some() && *fit != Fit::Rate {
            let body = flow.body.name();
            return Err(format!("{name} follows from {body}.power_law: there is nothing to fit"));
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

/// Whether two parameters of this covariance can hardly be told apart.
fn is_correlated(covariance: &DMatrix<f64>) -> bool {
    let pairs = (0..covariance.nrows()).flat_map(|one| (0..one).map(move |other| (one, other)));
    let of = |(one, other): (usize, usize)| {
        covariance[(one, other)] / (covariance[(one, one)] * covariance[(other, other)]).sqrt()
    };
    // rounding may make the root of a negative number
    pairs.map(of).any(|correlation| correlation.is_nan() || correlation.abs() >= CORRELATED)
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
    let matters = differences.len() >= FEWEST_FOR_TREND && squares > ROUNDING;
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
    pub(super) fn size(&self) -> f64 {
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

impl Problem<'_> {
    /// The estimates with their intervals, and a remark on parameters that can't be told apart.
    fn estimates(&self, jacobian: &DMatrix<f64>, differences: &DVector<f64>) -> (Vec<Estimate>, Option<String>) {
        let freedom = differences.len() as i64 - self.fits.len() as i64;
        let covariance = (jacobian.transpose() * jacobian).try_inverse();
        let all_matter = jacobian.column_iter().all(|column| column.amax() > NO_EFFECT);
        let correlated = self.fits.len() > 1 && all_matter && covariance.as_ref().is_none_or(is_correlated);
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
