//! The impact of a scene on one of several contacts that share bodies: all of them move. The library's own motion is the prediction.

use super::Row;
use crate::importer::{Archive, ImportError, Unit};
use brinell_contact::shared::{InverseMasses, Refused, Work, follow};
use brinell_contact::{History, Model};
use brinell_contact::{loading::AnyLoading, unloading::AnyUnloading};
use brinell_exporter::interface::{INVERSE_MASS, inverse_mass_inputs};
use brinell_exporter::scene::{self, Scene, place};

/// Number of steps of a check.
const STEPS: u32 = 3;

/// Length of a check, in contact times of the impact.
const LENGTH: f64 = 4.0;

/// Contacts that share bodies, as the library moves them.
struct Together<'a> {
    models: Vec<Model<AnyLoading, AnyUnloading>>,
    contacts: Vec<History>,
    masses: InverseMasses<'a>,
    rates: Vec<f64>,
}

impl Together<'_> {
    /// Moves them for `step` \[s\] and returns the impulses \[N.s\].
    fn step(&mut self, step: f64) -> Result<Vec<f64>, Refused> {
        let mut work: Vec<_> = self.contacts.iter().map(|contact| Work::new(*contact)).collect();
        let still = vec![0.0; self.contacts.len()];
        let model = |contact: usize| &self.models[contact];
        follow(&mut self.contacts, model, &self.masses, &still, &mut self.rates, &mut work, step)?;
        Ok(work.iter().map(Work::impulse).collect())
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
    let count = scene.contacts.len();
    let speed = |contact: usize| if contact == group { scene.impact.speed } else { 0.0 };
    let start = || {
        let models: Vec<_> = (0..count).map(|contact| scene.model_of(contact)).collect();
        let gap = |contact| scene.group_value(contact, "initial_gap").unwrap_or(0.0);
        let contacts = models.iter().enumerate();
        let contacts = contacts.map(|(contact, model)| History::start(model, gap(contact)).expect("a checked scene"));
        let masses = InverseMasses::new(count, entries).expect("a checked scene has all inverse masses");
        Together { contacts: contacts.collect(), models, masses, rates: (0..count).map(speed).collect() }
    };
    // a step whose contacts touch too often is refused; a shorter one isn't
    let mut step = LENGTH * scene.predictions[group].contact_time() / f64::from(STEPS);
    let predicted = loop {
        let mut bodies = start();
        match (0..STEPS).map(|_| bodies.step(step)).collect::<Result<Vec<_>, Refused>>() {
            Ok(impulses) => break impulses,
            Err(Refused::TooLong { .. }) => step *= 0.1,
            Err(refused) => panic!("the impact of a checked scene is within the range of its law: {refused:?}"),
        }
    };
    let total = |impulses: &[Vec<f64>], contact: usize| impulses.iter().map(|step| step[contact]).sum::<f64>();
    let simulated = simulate(archive, unit, scene, (entries, &speed), step)?;
    let scale = (0..count).map(|contact| total(&predicted, contact)).fold(f64::MIN_POSITIVE, f64::max);
    let row = |contact: usize| {
        let [predicted, simulated] = [&predicted, &simulated].map(|impulses| total(impulses, contact));
        Row::new(
            format!("impulse of {}", scene.contacts[contact].prefix(0).trim_end_matches('.')),
            "N.s",
            predicted,
            simulated,
            scale,
        )
    };
    Ok((0..count).map(row).collect())
}

/// The impulses of each step of the FMU \[N.s\], whose bodies begin at these speeds \[m/s\].
fn simulate(
    archive: &Archive,
    unit: &Unit,
    scene: &Scene,
    (entries, speed): (&[f64], &dyn Fn(usize) -> f64),
    step: f64,
) -> Result<Vec<Vec<f64>>, ImportError> {
    let count = scene.contacts.len();
    let references = |name: &str| {
        let all = scene.contacts.iter().map(|group| archive.description.real(&format!("{}{name}", group.prefix(0))));
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
            instance.set_real(*rate, speed(contact) - lost.sum::<f64>())?;
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
