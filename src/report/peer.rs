//! Other FMUs with the same variables, measured together with the scene's.

use super::precision::{self, Line};
use super::{ReportError, Runs};
use crate::importer::{Archive, Unit};
use crate::master::Contact;
use brinell_exporter::master::{Needs, WAYS, Way};
use brinell_exporter::scene::Scene;
use std::path::{Path, PathBuf};

/// The variables that an FMU needs for this.
const NEEDED: [&str; 2] = ["indentation_rate", "force"];

/// Another FMU.
pub struct Peer {
    path: PathBuf,
    /// Its file name without extension.
    pub name: String,
    archive: Archive,
    unit: Unit,
    /// Whether it is made for the Jacobi scheme, which steps all FMUs at once.
    parallel: bool,
}

impl Peer {
    /// Loads the FMU at `path`.
    ///
    /// # Errors
    /// [`ReportError::Peer`] if it can't be loaded, or can't replace the scene's FMU.
    pub fn open(path: &Path) -> Result<Peer, ReportError> {
        let wrong = |reason: String| ReportError::Peer { path: path.into(), reason };
        let archive = Archive::open(path).map_err(|error| wrong(error.to_string()))?;
        let description = &archive.description;
        if description.fmi_version != "2.0" {
            return Err(wrong(format!("fmiVersion is {:?}, and only 2.0 can be run", description.fmi_version)));
        }
        if description.identifier.is_empty() {
            return Err(wrong("it is no co-simulation unit".into()));
        }
        let missing: Vec<_> = NEEDED.into_iter().filter(|name| description.real(name).is_err()).collect();
        if !missing.is_empty() {
            let (missing, needed) = (missing.join(", "), NEEDED.join(", "));
            return Err(wrong(format!("it has no Real variable {missing}; needed are {needed}")));
        }
        let unit = archive.load().map_err(|error| wrong(error.to_string()))?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let scene = archive.scene.as_ref().and_then(|text| Scene::parse(text.clone(), path).ok());
        let parallel = scene.and_then(|scene| scene.coupling).is_some_and(|coupling| coupling.parallel);
        Ok(Peer { path: path.into(), name, archive, unit, parallel })
    }

    /// Runs every way that it supports, with the bodies of `scene`.
    ///
    /// # Errors
    /// [`ReportError::Peer`] if it rejects a call.
    pub fn measure(&self, scene: &Scene, runs: &Runs) -> Result<Vec<Line>, ReportError> {
        let mut parameters: Vec<(&str, f64)> = scene.parameters.iter().map(|known| (known.name, known.value)).collect();
        parameters.push(("effective_mass", scene.impact.mass));
        let lines = Contact::new(&self.archive, &self.unit, "", &parameters).and_then(|mut contact| {
            contact.start(&[])?;
            self.ways().into_iter().map(|way| precision::measure(runs, &mut contact, way, Some(&self.name))).collect()
        });
        lines.map_err(|error| ReportError::Peer { path: self.path.clone(), reason: error.to_string() })
    }

    /// The ways to couple that it supports.
    fn ways(&self) -> Vec<&'static Way> {
        let description = &self.archive.description;
        let has = |name| description.real(name).is_ok();
        let derivatives = description.interpolates_inputs && description.output_derivatives > 0;
        // an FMU that moves the mass itself supports nothing else
        let knows_mass = has("effective_mass");
        let offered = |way: &&Way| match way.needs {
            Needs::Mass => knows_mass && has("mean_force") && !self.parallel,
            Needs::LateMass => self.parallel,
            _ if knows_mass => false,
            Needs::Force => true,
            Needs::PredictedForce => has("predicted_force"),
            Needs::MeanForce => derivatives && has("mean_force"),
            Needs::Friction => false,
        };
        WAYS.iter().filter(offered).collect()
    }
}
