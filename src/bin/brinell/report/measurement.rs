//! A user's own measurement in a report: beside the law of the scene, and with fitted parameters.

use super::data::{Cell, Table, number, text};
use super::{Figure, Part};
use crate::html::escape;
use crate::measured::{Estimate, Fit, Fitted, Flow, Kind, Measured, MeasuredError, fit, read};
use crate::numbers::quantity;
use crate::plot::{Picture, Series};
use crate::scene::Scene;
use crate::wrong_call::WrongCall;
use std::error::Error;
use std::path::Path;

/// Number of points of a computed line.
const POINTS: u32 = 120;

/// Name of the data series.
pub const NAME: &str = "measured";

/// A measurement with its fit.
pub struct Measurement {
    /// Name of the file.
    file: String,
    pub measured: Measured,
    /// The scene's; `None` for a law that doesn't yield.
    flow: Option<Flow>,
    fitted: Option<Fitted>,
}

impl Measurement {
    /// Reads the measurement at `path` and fits these parameters of `scene`, or the yield strength if none is named and the law
    /// has one.
    ///
    /// # Errors
    /// [`MeasuredError`], or a sentence about an impossible fit.
    pub fn of(scene: &Scene, path: &Path, fits: &[Fit]) -> Result<Measurement, Box<dyn Error>> {
        let measured = read(path).map_err(|error: MeasuredError| Box::new(error) as Box<dyn Error>)?;
        let flow = Flow::of(scene);
        let usual = if flow.is_some() && scene.power_law(0).is_none() { &[Fit::YieldStrength][..] } else { &[] };
        let fits = if fits.is_empty() { usual } else { fits };
        let fitted = if fits.is_empty() { None } else { Some(fit(scene, &measured, fits).map_err(WrongCall)?) };
        let file = path.file_name().map_or(String::new(), |name| name.to_string_lossy().into_owned());
        Ok(Measurement { file, measured, flow, fitted })
    }

    /// The results, in sentences.
    pub fn sentences(&self) -> Vec<String> {
        let count = self.measured.points.len();
        let unit = if self.measured.kind == Kind::Force { "N" } else { "" };
        let Some(fitted) = &self.fitted else {
            return vec![format!("{}: {count} measured points; no parameter was fitted to them.", self.file)];
        };
        let [before, after] = fitted.rms.map(|rms| quantity(rms, unit));
        let mut sentences = vec![format!(
            "{}: {count} measured points. Root-mean-square difference of the scene's law: {before}; with the fitted value: {after}.",
            self.file
        )];
        sentences.extend(fitted.estimates.iter().map(sentence));
        sentences.extend(fitted.remarks.iter().cloned());
        sentences
    }

    /// The section of the report.
    pub fn part(&self, scene: &Scene) -> Part {
        let words = self.sentences().iter().map(|words| escape(words)).collect::<Vec<_>>().join(" ");
        let mut method = String::from(
            "Least squares with the method of Levenberg and Marquardt. The intervals have 95 % confidence: the covariance is \
             s^2 (J^T J)^-1 with the derivatives J of the computed values at the optimum and the variance s^2 of the remaining \
             differences, and the factor is that of Student's t distribution. They hold if the law is right and the errors of the \
             measurement are independent and of equal size.",
        );
        method.push_str(match self.measured.kind {
            Kind::Restitution => " All impacts have the mass of the scene.",
            Kind::Force => " The force is that of a first, slow loading; the strain rate has no part in it.",
        });
        Part {
            title: "Your measurement",
            words,
            figures: vec![self.figure(scene)],
            switches: Vec::new(),
            method,
            tables: vec![self.fit_table(), self.table(scene)],
        }
    }

    /// The value of the scene's law at an argument of the measurement.
    fn by_scene(&self, scene: &Scene, at: f64) -> Option<f64> {
        match (&self.flow, self.measured.kind) {
            (Some(flow), _) => self.measured.by(scene, flow, at),
            (None, Kind::Restitution) => {
                let mass = scene.impact_of(0).mass;
                scene.any_model().restitution(&brinell::contact::impact::Impact { mass, speed: at })
            }
            (None, Kind::Force) => {
                let model = scene.any_model();
                let model = model.elastoplastic()?;
                Some(brinell::contact::Loading::segment(&model.loading, &model.pair, at).force(at))
            }
        }
    }

    fn figure(&self, scene: &Scene) -> Figure {
        let (first, last) = (self.measured.points[0].0, self.measured.points[self.measured.points.len() - 1].0);
        let over_decades = first > 0.0 && last >= 10.0 * first && self.measured.kind == Kind::Restitution;
        let (low, high) = if over_decades { (first / 1.5, 1.5 * last) } else { (0.02 * last, 1.1 * last) };
        let at = |point: u32| {
            let part = f64::from(point) / f64::from(POINTS);
            if over_decades { low * (high / low).powf(part) } else { low + part * (high - low) }
        };
        let line = |label: &str, of: &dyn Fn(f64) -> Option<f64>| Series {
            label: label.into(),
            points: (0..=POINTS).map(|point| (at(point), of(at(point)).unwrap_or(f64::NAN))).collect(),
            dots: false,
        };
        let law = scene.damped.map_or(scene.loading.0, |(name, _)| name);
        let mut series = vec![line(law, &|at| self.by_scene(scene, at))];
        if let Some(fitted) = &self.fitted {
            series.push(line(&format!("{law}, fitted"), &|at| self.measured.by(scene, &fitted.flow, at)));
        }
        series.push(Series { label: NAME.into(), points: self.measured.points.clone(), dots: true });
        let [x, y] = self.measured.kind.titles();
        let picture = Picture { x_title: x.into(), y_title: y.into(), logarithmic: (over_decades, false), series };
        let caption = format!("{} over {}: {}", y, x, self.file);
        Figure { name: "measured", caption: escape(&caption), svg: picture.svg(860, 420), folded: false }
    }

    /// The fitted parameters.
    fn fit_table(&self) -> Table {
        let columns = [
            ("parameter", ""),
            ("unit", ""),
            ("scene", ""),
            ("fitted", ""),
            ("lowest", ""),
            ("highest", ""),
            ("remark", ""),
        ];
        let mut table = Table::new("fit", columns);
        let row = |estimate: &Estimate| {
            let Estimate { name, unit, scene, value, interval, doubt, .. } = estimate;
            let bound = |value: Option<f64>| value.map_or(Cell::Empty, number);
            vec![
                text(*name),
                text(*unit),
                number(*scene),
                number(*value),
                bound(interval.map(|(low, _)| low)),
                bound(interval.map(|(_, high)| high)),
                text(doubt.clone().unwrap_or_default()),
            ]
        };
        table.rows = self.fitted.iter().flat_map(|fitted| &fitted.estimates).map(row).collect();
        table
    }

    /// The measured points with the computed values.
    fn table(&self, scene: &Scene) -> Table {
        let columns = match self.measured.kind {
            Kind::Restitution => [("speed", "m/s"), ("measured restitution", ""), ("by the scene", ""), ("fitted", "")],
            Kind::Force => [("depth", "m"), ("measured force", "N"), ("by the scene", "N"), ("fitted", "N")],
        };
        let mut table = Table::new("measured", columns);
        let row = |(at, value): &(f64, f64)| {
            let fitted = self.fitted.as_ref().and_then(|fitted| self.measured.by(scene, &fitted.flow, *at));
            let cell = |value: Option<f64>| value.map_or(Cell::Empty, number);
            vec![number(*at), number(*value), cell(self.by_scene(scene, *at)), cell(fitted)]
        };
        table.rows = self.measured.points.iter().map(row).collect();
        table
    }
}

/// An estimate as a sentence.
fn sentence(estimate: &Estimate) -> String {
    let Estimate { name, unit, scene, value, interval, doubt, .. } = estimate;
    let own = |value: f64| quantity(value, unit);
    let doubt = doubt.as_ref().map_or(String::new(), |doubt| format!(" ({doubt})"));
    let interval =
        interval.map_or(String::new(), |(low, high)| format!(", with 95 % confidence {} to {}", own(low), own(high)));
    format!("{name}: {}{interval}{doubt}; in the scene {}.", own(*value), own(*scene))
}
