//! The FMUs of a report, one for each kind of coupling: each has only the features that its ways need.

use super::ReportError;
use super::contact::Contact;
use super::progress::{Progress, Work};
use super::unit;
use super::ways::{Needs, WAYS, Way};
use crate::files::private_folder;
use crate::importer::{Archive, ImportError, Unit};
use crate::package;
use crate::parallel;
use crate::plan::Plan;
use crate::platform;
use crate::scene::Scene;

/// The loaded FMUs.
pub struct Units(Vec<Loaded>);

struct Loaded {
    needs: Needs,
    unit: Unit,
    // the unpacked files must exist as long as the FMU
    archive: Archive,
}

/// The FMUs for `scene`. An FMU whose force follows the rate has no input derivatives and can't know the mass. One with
/// friction can't know the mass either.
fn kinds(scene: &Scene) -> impl Iterator<Item = (Needs, &'static str)> {
    let all = [
        (Needs::Force, "the FMU"),
        (Needs::PredictedForce, "the FMU with predicted_force"),
        (Needs::MeanForce, "the FMU with mean_force"),
        (Needs::Mass, "the FMU that knows the mass"),
        (Needs::LateMass, "the FMU that knows the mass, for a parallel master"),
        (Needs::Friction, "the FMU with friction"),
    ];
    let (damped, friction) = (scene.is_rate_dependent(), scene.has_friction());
    let knows_mass = |needs: Needs| matches!(needs, Needs::Mass | Needs::LateMass);
    let all = all.into_iter().filter(move |(needs, _)| friction || *needs != Needs::Friction);
    let all = all.filter(move |(needs, _)| !(friction && knows_mass(*needs)));
    all.filter(move |(needs, _)| !damped || matches!(needs, Needs::Force | Needs::PredictedForce))
}

impl Units {
    /// The work of [`Units::build`], and the available ways.
    pub fn work(scene: &Scene) -> (impl Iterator<Item = Work>, usize) {
        let kinds: Vec<_> = kinds(scene).map(|(needs, _)| needs).collect();
        let ways = WAYS.iter().filter(|way| kinds.contains(&way.needs)).count();
        (kinds.into_iter().map(|_| Work::Building), ways)
    }

    /// Builds and loads the FMUs of `scene`.
    ///
    /// # Errors
    /// [`ReportError`] if an FMU can't be built or loaded.
    pub fn build(scene: &Scene, progress: &Progress) -> Result<Units, ReportError> {
        let folder = private_folder("brinell-report-", &std::env::temp_dir())?;
        let here = [platform::here().map_err(ImportError::from)?];
        let kinds: Vec<_> = kinds(scene).collect();
        let path = |name: &str| folder.path().join(format!("{name}.fmu"));
        let build = |(needs, name): &(Needs, &str)| -> Result<(), ReportError> {
            progress.say(&format!("building {name}"));
            package::export(&Plan::of(&unit::first_contact(scene, *needs)), package::Way::Any, &here, &path(name))?;
            progress.done(Work::Building);
            Ok(())
        };
        // the first one also makes what they share
        let (first, others) = kinds.split_at(1);
        for kinds in [first, others] {
            parallel::each(kinds, build)?;
        }
        let mut loaded = Vec::new();
        for (needs, name) in kinds {
            let archive = Archive::open(&path(name))?;
            loaded.push(Loaded { needs, unit: archive.load()?, archive });
        }
        Ok(Units(loaded))
    }

    /// A contact of each FMU.
    ///
    /// # Errors
    /// [`ImportError`] if an FMU can't be instantiated.
    pub fn contacts(&self) -> Result<Contacts<'_>, ImportError> {
        let mut contacts = Vec::new();
        for Loaded { needs, unit, archive } in &self.0 {
            contacts.push((*needs, Contact::new(archive, unit, &[])?));
        }
        Ok(Contacts(contacts))
    }
}

/// A contact for each kind of coupling with an FMU.
pub struct Contacts<'a>(Vec<(Needs, Contact<'a>)>);

impl<'a> Contacts<'a> {
    /// The available ways to couple.
    pub fn ways(&self) -> impl Iterator<Item = &'static Way> + use<> {
        let kinds: Vec<_> = self.0.iter().map(|(needs, _)| *needs).collect();
        WAYS.iter().filter(move |way| kinds.contains(&way.needs))
    }

    /// The contact for an [available](Contacts::ways) way.
    pub fn of(&mut self, way: &Way) -> &mut Contact<'a> {
        let contact = self.0.iter_mut().find(|(needs, _)| *needs == way.needs);
        &mut contact.expect("a way that can be run has a contact").1
    }

    /// The contact with friction, if the scene has friction.
    pub fn rough(&mut self) -> Option<&mut Contact<'a>> {
        self.0.iter_mut().find(|(needs, _)| *needs == Needs::Friction).map(|(_, contact)| contact)
    }

    /// The contact with the features that all FMUs have.
    pub fn plain(&mut self) -> &mut Contact<'a> {
        &mut self.0[0].1
    }
}
