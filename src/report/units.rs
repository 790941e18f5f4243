//! The FMUs of a report: the scene's first contact, once for each kind of coupling, with only the features that its ways need.

use super::runs::{Progress, ReportError};
use crate::importer::{Archive, ImportError, Unit};
use crate::temporary::PrivateFolder;
use crate::{package, parallel};
use brinell_contact::rate::Factors;
use brinell_exporter::master::Requirements;
use brinell_exporter::plan::Plan;
use brinell_exporter::platform;
use brinell_exporter::scene::{Coupling, Group, Masses, Parameter, Scene};
use brinell_exporter::table::VARIABLES;
use std::collections::BTreeMap;

/// Outputs that a report reads, whatever the scene and the coupling.
const OUTPUTS: [&str; 3] = ["indentation", "residual_indentation", "dissipated_energy"];

/// The FMUs for `scene`. An FMU whose force follows the rate has no input derivatives and can't know the mass. One with
/// friction can't know the mass either.
fn kinds(scene: &Scene) -> Vec<Requirements> {
    let (damped, friction) = (scene.is_rate_dependent(), scene.has_friction());
    let mut all = vec![
        Requirements::Force,
        Requirements::PredictedForce,
        Requirements::MeanForce,
        Requirements::Mass,
        Requirements::JacobiMass,
    ];
    all.retain(|needs| match needs {
        Requirements::Force | Requirements::PredictedForce => true,
        Requirements::MeanForce => !damped,
        Requirements::Mass | Requirements::JacobiMass => !damped && !friction,
    });
    all
}

/// Builds and loads the FMUs of `scene`. The unpacked files of an FMU must exist as long as it.
///
/// # Errors
/// [`ReportError`] if an FMU can't be built or loaded.
pub fn build(scene: &Scene, progress: &Progress) -> Result<BTreeMap<Requirements, (Unit, Archive)>, ReportError> {
    let folder = PrivateFolder::new("brinell-report-", &std::env::temp_dir())?;
    let here = [platform::here().map_err(ImportError::from)?];
    let kinds = kinds(scene);
    let path = |needs: Requirements| folder.path().join(format!("{needs:?}.fmu"));
    let build = |needs: &Requirements| {
        progress.say(&format!("building an FMU ({needs:?})"));
        package::export(&Plan::of(&first_contact(scene, *needs)), package::LibraryWay::Any, &here, &path(*needs))
    };
    // the first one also makes what they share
    let (first, others) = kinds.split_at(1);
    for kinds in [first, others] {
        parallel::each(kinds, build)?;
    }
    let load = |needs| {
        let archive = Archive::open(&path(needs))?;
        Ok((needs, (archive.load()?, archive)))
    };
    kinds.into_iter().map(load).collect()
}

/// The first contact of `scene` alone, for a kind of coupling; all its parameters can be set.
pub fn first_contact(scene: &Scene, needs: Requirements) -> Scene {
    let mass = needs.knows_mass().then_some(scene.impact_of(0).mass);
    let more: &[&str] = match needs {
        Requirements::Force => &[],
        Requirements::PredictedForce => &["predicted_force"],
        Requirements::MeanForce | Requirements::Mass => &["mean_force"],
        Requirements::JacobiMass => &["mean_force", "closing_speed"],
    };
    let mut parameters: Vec<Parameter> = Vec::new();
    // in the order of the table, like the parameters of every scene; the bodies move along the normal only
    for variable in VARIABLES.iter().filter(|variable| !variable.friction) {
        let is_it = |parameter: &&Parameter| parameter.name == variable.name;
        let found = scene.contacts[0].own.iter().find(is_it).or(scene.parameters.iter().find(is_it));
        parameters.extend(found.map(|found| Parameter::shared(found.name, found.value, true)));
    }
    if let (Some(value), None) = (mass, scene.group_value(0, "effective_mass")) {
        // it precedes the gap, which every contact has
        let gap = parameters.iter().position(|parameter| parameter.name == "initial_gap").unwrap_or(parameters.len());
        parameters.insert(gap, Parameter::shared("effective_mass", value, true));
    }
    let unit = Scene {
        parameters,
        contacts: vec![Group { name: None, count: None, own: Vec::new(), ..scene.contacts[0].clone() }],
        outputs: OUTPUTS.iter().chain(more).map(|name| (*name).to_string()).collect(),
        quasi_static: vec![scene.quasi_static[0]],
        factors: vec![Factors::SLOW],
        coupling: mass.map(|_| Coupling {
            parallel: needs == Requirements::JacobiMass,
            acceleration_input: false,
            masses: Masses::Effective { is_input: false },
        }),
        directions: 0,
        impact: scene.impact_of(0),
        predictions: vec![scene.predictions[0]],
        input_derivatives: true,
        watches: false,
        structured_names: false,
        standalone: false,
        ..scene.clone()
    };
    // a unit with a mass finds the strength by itself, the others have it as a parameter
    unit.with_strengths_for(None).expect("the scene has been predicted")
}
