//! The FMUs of a report: the scene's first contact, once for each kind of coupling, each with only the features that its ways need.

use super::contact::Contact;
use super::ways::{Needs, WAYS, Way};
use super::{Progress, ReportError};
use crate::files::private_folder;
use crate::importer::{Archive, ImportError, Unit};
use crate::{package, parallel};
use brinell_exporter::plan::Plan;
use brinell_exporter::platform;
use brinell_exporter::scene::{Body, Both, Coupling, Group, Parameter, Scene};
use brinell_exporter::table::VARIABLES;

/// Outputs that a report reads, whatever the scene and the coupling.
const OUTPUTS: [&str; 3] = ["indentation", "residual_indentation", "dissipated_energy"];

/// The loaded FMUs. The unpacked files of an FMU must exist as long as it.
pub struct Units(Vec<(Needs, Unit, Archive)>);

/// The FMUs for `scene`. An FMU whose force follows the rate has no input derivatives and can't know the mass. One with
/// friction can't know the mass either.
fn kinds(scene: &Scene) -> Vec<(Needs, &'static str)> {
    let (damped, friction) = (scene.is_rate_dependent(), scene.has_friction());
    let mut all = vec![(Needs::Force, "the FMU"), (Needs::PredictedForce, "the FMU with predicted_force")];
    if !damped {
        all.push((Needs::MeanForce, "the FMU with mean_force"));
    }
    if !damped && !friction {
        all.push((Needs::Mass, "the FMU that knows the mass"));
        all.push((Needs::LateMass, "the FMU that knows the mass, for a parallel master"));
    }
    if !damped && friction {
        all.push((Needs::Friction, "the FMU with friction"));
    }
    all
}

impl Units {
    /// Builds and loads the FMUs of `scene`.
    ///
    /// # Errors
    /// [`ReportError`] if an FMU can't be built or loaded.
    pub fn build(scene: &Scene, progress: &Progress) -> Result<Units, ReportError> {
        let folder = private_folder("brinell-report-", &std::env::temp_dir())?;
        let here = [platform::here().map_err(ImportError::from)?];
        let kinds = kinds(scene);
        let path = |name: &str| folder.path().join(format!("{name}.fmu"));
        let build = |(needs, name): &(Needs, &str)| {
            progress.say(&format!("building {name}"));
            package::export(&Plan::of(&first_contact(scene, *needs)), package::LibraryWay::Any, &here, &path(name))
        };
        // the first one also makes what they share
        let (first, others) = kinds.split_at(1);
        for kinds in [first, others] {
            parallel::each(kinds, build)?;
        }
        let load = |(needs, name): (Needs, &str)| {
            let archive = Archive::open(&path(name))?;
            Ok((needs, archive.load()?, archive))
        };
        Ok(Units(kinds.into_iter().map(load).collect::<Result<_, ReportError>>()?))
    }

    /// A contact of each FMU.
    ///
    /// # Errors
    /// [`ImportError`] if an FMU can't be instantiated.
    pub fn contacts(&self) -> Result<Contacts<'_>, ImportError> {
        let mut contacts = Vec::new();
        for (needs, unit, archive) in &self.0 {
            contacts.push((*needs, Contact::new(archive, unit, &[])?));
        }
        Ok(Contacts(contacts))
    }
}

/// A contact for each kind of coupling with an FMU.
pub struct Contacts<'a>(Vec<(Needs, Contact<'a>)>);

impl<'a> Contacts<'a> {
    /// The available ways to couple.
    pub fn ways(&self) -> Vec<&'static Way> {
        WAYS.iter().filter(|way| self.0.iter().any(|(needs, _)| *needs == way.needs)).collect()
    }

    /// The contact of the FMU of a kind, if the scene has it.
    pub fn find(&mut self, needs: Needs) -> Option<&mut Contact<'a>> {
        self.0.iter_mut().find(|(own, _)| *own == needs).map(|(_, contact)| contact)
    }

    /// The contact for an [available](Contacts::ways) way.
    pub fn of(&mut self, way: &Way) -> &mut Contact<'a> {
        self.find(way.needs).expect("a way that can be run has a contact")
    }

    /// The contact with the features that all FMUs have.
    pub fn plain(&mut self) -> &mut Contact<'a> {
        &mut self.0[0].1
    }
}

/// The first contact of `scene` alone, for a kind of coupling; all its parameters can be set.
pub fn first_contact(scene: &Scene, needs: Needs) -> Scene {
    let mass = needs.knows_mass().then_some(scene.impact_of(0).mass);
    // the other ways move bodies along the normal only
    let friction = needs == Needs::Friction;
    let more: &[&str] = match needs {
        Needs::Force => &[],
        Needs::PredictedForce => &["predicted_force"],
        Needs::MeanForce | Needs::Mass => &["mean_force"],
        Needs::LateMass => &["mean_force", "closing_speed"],
        Needs::Friction => &["tangential_force"],
    };
    let mut parameters: Vec<Parameter> = Vec::new();
    // in the order of the table, like the parameters of every scene
    for variable in VARIABLES.iter().filter(|variable| friction || !variable.friction) {
        let is_it = |parameter: &&Parameter| parameter.name == variable.name;
        let found = scene.contacts[0].own.iter().find(is_it).or(scene.parameters.iter().find(is_it));
        parameters.extend(found.map(|found| Parameter::shared(found.name, found.value, true)));
    }
    if let (Some(value), None) = (mass, scene.group_value(0, "effective_mass")) {
        // it precedes the gap, which every contact has
        let gap = parameters.iter().position(|parameter| parameter.name == "initial_gap").unwrap_or(parameters.len());
        parameters.insert(gap, Parameter::shared("effective_mass", value, true));
    }
    // a body with its own strength has no power law
    let own = |body: Body| scene.contacts[0].own.iter().any(|own| own.name == body.yield_strength());
    let power_laws = Both {
        impactor: scene.power_laws.impactor.filter(|_| !own(Body::Impactor)),
        target: scene.power_laws.target.filter(|_| !own(Body::Target)),
    };
    let unit = Scene {
        name: scene.name.clone(),
        description: scene.description.clone(),
        parameters,
        contacts: vec![Group { name: None, count: None, own: Vec::new(), ..scene.contacts[0].clone() }],
        outputs: OUTPUTS.iter().chain(more).map(|name| (*name).to_string()).collect(),
        loading: scene.loading,
        unloading: scene.unloading,
        damped: scene.damped,
        loss: scene.loss,
        passivity_guard: scene.passivity_guard,
        yield_strength: scene.yield_strength,
        power_laws,
        rates: scene.rates,
        quasi_static: vec![scene.quasi_static[0]],
        factors: vec![1.0],
        coupling: mass.map(|_| Coupling { parallel: needs == Needs::LateMass, ..Coupling::default() }),
        directions: usize::from(friction),
        impact: scene.impact_of(0),
        predictions: vec![scene.predictions[0]],
        input_derivatives: true,
        watches: false,
        structured_names: false,
        standalone: false,
        impact_is_assumed: scene.impact_is_assumed,
        text: scene.text.clone(),
    };
    // a unit with a mass finds the strength by itself, the others have it as a parameter
    unit.with_strengths_for(None).expect("the scene has been predicted")
}
