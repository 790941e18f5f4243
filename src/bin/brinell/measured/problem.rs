//! The differences of a law from a measurement, as a least-squares problem.

use super::{Fit, Flow, Measured};
use crate::scene::Scene;
use levenberg_marquardt::LeastSquaresProblem;
use nalgebra::{DMatrix, DVector, Dyn, Owned};

/// Yield strengths that are tried, relative to the effective modulus, and the number of starting values.
const STRENGTHS: (f64, f64) = (1e-6, 0.5);
const STARTS: u32 = 60;

/// Step of the central differences, in units of the fitted variables.
const STEP: f64 = 1e-5;

/// The least-squares problem.
pub struct Problem<'a> {
    scene: &'a Scene,
    pub measured: &'a Measured,
    pub fits: Vec<Fit>,
    /// The scene's.
    pub given: Flow,
    modulus: f64,
    /// The fitted variables: logarithms, or values in units of [`Fit::size`].
    pub at: DVector<f64>,
}

impl<'a> Problem<'a> {
    /// The problem that starts at the scene's values.
    ///
    /// # Errors
    /// As for [`Fit::of`].
    pub fn new(scene: &'a Scene, measured: &'a Measured, fits: Vec<Fit>, given: Flow) -> Result<Self, String> {
        let modulus = scene.any_model().pair().modulus;
        let start = |fit: &Fit| {
            let value = fit.of(&given)?.2;
            Ok::<f64, String>(if fit.is_logarithmic(&given) { value.ln() } else { value / fit.size(modulus) })
        };
        let at = fits.iter().map(start).collect::<Result<Vec<_>, _>>()?;
        Ok(Problem { scene, measured, fits, given, modulus, at: DVector::from_vec(at) })
    }

    /// The value of the parameter at `index` for these variables.
    pub fn value(&self, index: usize, at: &DVector<f64>) -> f64 {
        let fit = self.fits[index];
        if fit.is_logarithmic(&self.given) { at[index].exp() } else { at[index] * fit.size(self.modulus) }
    }

    /// The flow stress for these variables. A negative hardening or rate constant counts as zero.
    pub fn flow(&self, at: &DVector<f64>) -> Flow {
        let set = |flow, (index, fit): (usize, &Fit)| fit.set(flow, self.value(index, at).max(0.0));
        self.fits.iter().enumerate().fold(self.given, set)
    }

    /// Differences of the law from the measurement, relative to [`Measured::size`].
    pub fn differences(&self, flow: &Flow) -> Option<DVector<f64>> {
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

    /// Whether no variable is beyond a limit of zero.
    pub fn is_inside(&self) -> bool {
        let beyond = |(fit, at): (&Fit, &f64)| !fit.is_logarithmic(&self.given) && *at < 0.0;
        !self.fits.iter().zip(self.at.iter()).any(beyond)
    }

    /// The sum of the squared differences.
    pub fn squares(&self, at: &DVector<f64>) -> f64 {
        self.extended(at).map_or(f64::INFINITY, |differences| differences.norm_squared())
    }

    /// The problem at the best of some starting values: the scene's, and for a yield strength others.
    pub fn at_best_start(self) -> Self {
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
        let best = all.into_iter().min_by(better).unwrap_or_else(|| self.at.clone());
        Problem { at: best, ..self }
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
