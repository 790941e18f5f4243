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
use crate::numbers::quantity;
use crate::scene::Scene;
use brinell::contact::validity::LARGEST_RADIUS_RATIO;
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
    let before = Problem::new(scene, measured, fits.to_vec(), flow)?.differences(&flow).ok_or(BEYOND)?;
    let problem = within_bounds(scene, measured, fits, flow)?;
    let found = problem.flow(&problem.at);
    let differences = problem.differences(&found).ok_or(BEYOND)?;
    let (free, correlated) = problem.estimates(&differences)?;
    let mut free = free.into_iter();
    let estimate = |fit: &Fit| match problem.fits.contains(fit) {
        true => free.next(),
        false => fit.of(&flow).ok().map(at_bound),
    };
    let estimates = fits.iter().filter_map(estimate).collect();
    let mut remarks: Vec<String> = correlated.into_iter().collect();
    remarks.extend(trend(&differences));
    remarks.extend(measured.left_out());
    remarks.extend(outside(scene, measured, &found));
    Ok(Fitted { estimates, flow: found, rms: [rms(&before, measured), rms(&differences, measured)], remarks })
}

/// The best problem whose parameters are not negative: where the best value of one would be, it is zero, and the others are
/// fitted again.
fn within_bounds<'a>(
    scene: &'a Scene,
    measured: &'a Measured,
    fits: &[Fit],
    flow: Flow,
) -> Result<Problem<'a>, String> {
    let solved = |fixed: &[Fit]| {
        let free = fits.iter().copied().filter(|fit| !fixed.contains(fit)).collect();
        let given = fixed.iter().fold(flow, |flow, fit| fit.set(flow, 0.0));
        let problem = Problem::new(scene, measured, free, given)?;
        if problem.fits.is_empty() {
            return Ok::<_, String>(problem);
        }
        Ok(LevenbergMarquardt::new().with_patience(50).minimize(problem.at_best_start()).0)
    };
    let free = solved(&[])?;
    if free.is_inside() {
        return Ok(free);
    }
    let bounded: Vec<Fit> = fits.iter().copied().filter(|fit| !fit.is_logarithmic(&flow)).collect();
    // every choice of bounded parameters, as bits
    let choices = (1u32..1 << bounded.len()).map(|bits| {
        (0..bounded.len()).filter(|index| bits >> index & 1 == 1).map(|index| bounded[index]).collect::<Vec<_>>()
    });
    let problems = choices.map(|fixed| solved(&fixed)).collect::<Result<Vec<_>, _>>()?;
    let better = |one: &Problem, other: &Problem| one.squares(&one.at).total_cmp(&other.squares(&other.at));
    // with all of them at their bounds, nothing is outside
    Ok(problems.into_iter().filter(Problem::is_inside).min_by(better).unwrap_or(free))
}

/// The estimate of a parameter whose best value would be negative: its name, its unit and the scene's value are given.
fn at_bound((name, unit, scene): (&'static str, &'static str, f64)) -> Estimate {
    let doubt = "not distinguishable from 0: the best value would be negative".to_string();
    Estimate { name, unit, scene, value: 0.0, interval: None, doubt: Some(doubt) }
}

/// A remark on the points outside the validity of the law with this flow stress.
fn outside(scene: &Scene, measured: &Measured, flow: &Flow) -> Option<String> {
    let wide =
        |(at, _): &&(f64, f64)| flow.width(scene, measured.kind, *at).is_some_and(|width| width > LARGEST_RADIUS_RATIO);
    let wide: Vec<f64> = measured.points.iter().filter(wide).map(|point| point.0).collect();
    let (first, last) = (wide.first()?, wide.last()?);
    let (name, unit) = match measured.kind {
        Kind::Restitution => ("speeds", "m/s"),
        Kind::Force => ("depths", "m"),
    };
    Some(format!(
        "The contact radius exceeds {LARGEST_RADIUS_RATIO} effective radii, where no law is valid, at {} of {} points ({name} \
         from {} to {}): leave them out.",
        wide.len(),
        measured.points.len(),
        quantity(*first, unit),
        quantity(*last, unit)
    ))
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
    fn estimates(&self, differences: &DVector<f64>) -> Result<(Vec<Estimate>, Option<String>), String> {
        if self.fits.is_empty() {
            return Ok((Vec::new(), None));
        }
        let jacobian = &self.jacobian().ok_or(BEYOND)?;
        // points that repeat others to the last digit don't tell how much a measurement scatters
        let different = self.measured.different();
        let enough = different > self.fits.len();
        let freedom = if enough { differences.len() as i64 - self.fits.len() as i64 } else { 0 };
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
        Ok((estimates, remark))
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
            let (points, parameters) = (self.measured.different(), self.fits.len());
            let different = if points < self.measured.points.len() { "different " } else { "" };
            return Some(format!(
                "without an interval: {points} {different}points for {parameters} parameters leave nothing to judge it by"
            ));
        }
        let (error, (low, high)) = (error?, interval?);
        if fit.is_logarithmic(&self.given) {
            return (error > std::f64::consts::LN_2)
                .then(|| format!("hardly determined: its interval spans a factor of {:.2e}", high / low));
        }
        (self.at[index] - error <= 0.0).then(|| "not distinguishable from 0".into())
    }
}
