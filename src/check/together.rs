//! The impact of a scene on one of several contacts that share bodies: all of them move. The library's own motion is the prediction.

use super::Row;
use crate::importer::{Archive, ImportError, Unit};
use brinell_contact::losses::{self, AnyLoss};
use brinell_contact::shared::{InverseMasses, Refused, SharedContact, Work, follow};
use brinell_contact::{Contact, History};
use brinell_exporter::interface::{INVERSE_MASS, inverse_mass_inputs};
use brinell_exporter::model::AnyModel;
use brinell_exporter::scene::{self, Scene, place};

/// Number of steps of a check.
const STEPS: u32 = 3;

/// Length of a check, in contact times of the impact.
const LENGTH: f64 = 4.0;

/// Contacts that share bodies, as the library moves them.
struct Together<'a, M, C> {
    models: &'a [M],
    contacts: Vec<C>,
    masses: InverseMasses<'a>,
    rates: Vec<f64>,
}

impl<M, C: SharedContact<M>> Together<'_, M, C> {
    /// Moves them for `step` \[s\] and returns the impulses \[N.s\].
    fn step(&mut self, step: f64) -> Result<Vec<f64>, Refused> {
        let mut work: Vec<_> = self.contacts.iter().map(|contact| Work::new(*contact)).collect();
        let still = vec![0.0; self.contacts.len()];
        let model = |contact: usize| &self.models[contact];
        follow(&mut self.contacts, model, &self.masses, &still, &mut self.rates, &mut work, step)?;
        Ok(work.iter().map(Work::impulse).collect())
    }
}

/// Where the contacts of `scene` are, and what moves them.
struct Start<'a> {
    scene: &'a Scene,
    /// The group of each contact, and what precedes the names of its variables.
    contacts: Vec<(usize, String)>,
    /// Inverse masses \[1/kg\].
    entries: &'a [f64],
    /// Closing rates \[m/s\].
    rates: Vec<f64>,
}

impl Start<'_> {
    /// The impulses of all contacts in each of the [`STEPS`] \[N.s\], and the length of a step: `step` \[s\], or less if contacts touch too
    /// often in it.
    fn predicted<M, C: Contact<M> + SharedContact<M>>(&self, models: &[M], mut step: f64) -> (Vec<Vec<f64>>, f64) {
        let Start { scene, contacts, entries, rates } = self;
        let gap = |contact: usize| scene.group_value(contacts[contact].0, "initial_gap").unwrap_or(0.0);
        loop {
            let contacts = models.iter().enumerate();
            let contacts = contacts.map(|(contact, model)| C::start(model, gap(contact)).expect("a checked scene"));
            let masses = InverseMasses::new(models.len(), entries).expect("a checked scene has all inverse masses");
            let mut bodies = Together { models, contacts: contacts.collect::<Vec<C>>(), masses, rates: rates.clone() };
            match (0..STEPS).map(|_| bodies.step(step)).collect::<Result<Vec<_>, Refused>>() {
                Ok(impulses) => return (impulses, step),
                Err(Refused::TooLong { .. }) => step *= 0.1,
                Err(refused) => panic!("the impact of a checked scene is within the range of its law: {refused:?}"),
            }
        }
    }
}

/// The inverse masses of a check \[1/kg\]: those of the scene, or for inputs those of bodies in a row, twice the mass of the scene's
/// impact each.
pub fn entries(masses: &scene::InverseMasses, scene: &Scene) -> Vec<f64> {
    match masses {
        scene::InverseMasses::Constant(entries) => entries.clone(),
        scene::InverseMasses::Inputs => {
            let inverse = 0.5 / scene.impact.mass;
            let entry = |apart: usize| [2.0 * inverse, -inverse].get(apart).copied().unwrap_or(0.0);
            let count = scene.contact_count();
            (0..count).flat_map(|row| (0..count - row).map(entry)).collect()
        }
    }
}

/// The impulses of all contacts when the first one of `group` closes with the speed of the scene's impact, and the others are at
/// rest: predicted by the library, and simulated by the FMU. `entries` are the inverse masses.
///
/// # Errors
/// [`ImportError`] if the FMU rejects a call.
pub fn compare(
    archive: &Archive,
    unit: &Unit,
    scene: &Scene,
    group: usize,
    entries: &[f64],
) -> Result<Vec<Row>, ImportError> {
    let groups = scene.contacts.iter().enumerate();
    let contacts = groups.flat_map(|(group, given)| (0..given.size()).map(move |index| (group, given.prefix(index))));
    let contacts: Vec<_> = contacts.collect();
    let count = contacts.len();
    let first = contacts.iter().position(|(other, _)| *other == group);
    let rates = (0..count).map(|contact| if Some(contact) == first { scene.impact.speed } else { 0.0 }).collect();
    let start = Start { scene, contacts, entries, rates };
    let step = LENGTH * scene.predictions[group].contact_time() / f64::from(STEPS);
    let models: Vec<_> = start.contacts.iter().map(|(group, _)| scene.any_model_of(*group)).collect();
    let lossy: Vec<_> = models.iter().filter_map(AnyModel::lossy).copied().collect();
    let (predicted, step) = match lossy.is_empty() {
        false => start.predicted::<_, losses::History<AnyLoss>>(&lossy, step),
        true => {
            let plastic: Vec<_> = models.iter().filter_map(AnyModel::elastoplastic).copied().collect();
            start.predicted::<_, History>(&plastic, step)
        }
    };
    let total = |impulses: &[Vec<f64>], contact: usize| impulses.iter().map(|step| step[contact]).sum::<f64>();
    let simulated = simulate(archive, unit, &start, step)?;
    let scale = (0..count).map(|contact| total(&predicted, contact)).fold(f64::MIN_POSITIVE, f64::max);
    let row = |contact: usize| {
        let [predicted, simulated] = [&predicted, &simulated].map(|impulses| total(impulses, contact));
        Row::new(
            format!("impulse of {}", start.contacts[contact].1.trim_end_matches('.')),
            "N.s",
            predicted,
            simulated,
            scale,
        )
    };
    Ok((0..count).map(row).collect())
}

/// The impulses of each step of the FMU \[N.s\].
fn simulate(archive: &Archive, unit: &Unit, start: &Start, step: f64) -> Result<Vec<Vec<f64>>, ImportError> {
    let Start { scene, contacts, entries, rates: speeds } = start;
    let count = contacts.len();
    let references = |name: &str| {
        let all = contacts.iter().map(|(_, prefix)| archive.description.real(&format!("{prefix}{name}")));
        all.collect::<Result<Vec<_>, ImportError>>()
    };
    let (rates, forces) = (references("indentation_rate")?, references("mean_force")?);
    let mut instance = unit.instantiate()?;
    instance.setup_experiment(0.0)?;
    instance.call("fmi2EnterInitializationMode")?;
    let inputs = inverse_mass_inputs(scene) > 0;
    for (row, column) in (0..count).flat_map(|row| (row..count).map(move |column| (row, column))).filter(|_| inputs) {
        let reference = archive.description.real(&format!("{INVERSE_MASS}[{},{}]", row + 1, column + 1))?;
        instance.set_real(reference, entries[place(count, row, column)])?;
    }
    instance.call("fmi2ExitInitializationMode")?;
    let parallel = scene.coupling.is_some_and(|coupling| coupling.parallel);
    let mut before = forces.iter().map(|force| instance.real(*force)).collect::<Result<Vec<_>, _>>()?;
    let (mut applied, mut impulses) = (vec![0.0; count], Vec::new());
    for index in 0..STEPS {
        for (contact, rate) in rates.iter().enumerate() {
            let lost = (0..count).map(|other| entries[place(count, contact, other)] * applied[other]);
            instance.set_real(*rate, speeds[contact] - lost.sum::<f64>())?;
        }
        instance.do_step(f64::from(index) * step, step)?;
        let after = forces.iter().map(|force| instance.real(*force)).collect::<Result<Vec<_>, _>>()?;
        let over_this_step = if parallel { &before } else { &after };
        applied.iter_mut().zip(over_this_step).for_each(|(sum, force)| *sum += force * step);
        impulses.push(after.iter().map(|force| force * step).collect());
        before = after;
    }
    instance.call("fmi2Terminate")?;
    Ok(impulses)
}
