//! The impact of a scene on one of several contacts that share bodies: all of them move. The library's own motion is the prediction.

use super::impact::Row;
use super::oblique;
use crate::importer::{Archive, ImportError, Unit};
use brinell_contact::losses::{self, AnyLoss};
use brinell_contact::rate;
use brinell_contact::shared::{InverseMasses, Refused, SharedContact, Work, follow};
use brinell_contact::tangential::{FrictionalContact, FrictionalModel, PlaneContact};
use brinell_contact::{Contact, History};
use brinell_exporter::interface::{INVERSE_MASS, inverse_mass_inputs};
use brinell_exporter::library::MEMORY;
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
    /// Moves them for `step` \[s\] and returns the impulses of all rows \[N.s\].
    fn step(&mut self, step: f64) -> Result<Vec<f64>, Refused> {
        let mut work: Vec<_> = self.contacts.iter().map(|contact| Work::new(*contact)).collect();
        let still = vec![0.0; self.rates.len()];
        let model = |contact: usize| &self.models[contact];
        follow(&mut self.contacts, model, &self.masses, &still, &mut self.rates, &mut work, step)?;
        let tangential = |direction| work.iter().map(move |work: &Work<C>| work.tangential_impulse(direction));
        Ok(work.iter().map(Work::impulse).chain((0..C::DIRECTIONS).flat_map(tangential)).collect())
    }
}

/// Where the contacts of `scene` are, and what moves them.
struct Start<'a> {
    scene: &'a Scene,
    /// The group of each contact, and what precedes the names of its variables.
    contacts: Vec<(usize, String)>,
    /// Inverse masses \[1/kg\].
    entries: &'a [f64],
    /// Closing rates of all contacts, and then their tangential rates \[m/s\].
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
            let masses = InverseMasses::new(rates.len(), entries).expect("a checked scene has all inverse masses");
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
        scene::InverseMasses::Constant { entries, .. } => entries.clone(),
        scene::InverseMasses::Inputs => {
            let inverse = 0.5 / scene.impact.mass;
            let (count, rows) = (scene.contact_count(), scene.rows());
            // the bodies don't turn: one direction doesn't accelerate the others
            let entry = |row: usize, column: usize| match (row / count == column / count, column - row) {
                (true, apart) => [2.0 * inverse, -inverse].get(apart).copied().unwrap_or(0.0),
                _ => 0.0,
            };
            (0..rows).flat_map(|row| (row..rows).map(move |column| entry(row, column))).collect()
        }
    }
}

/// The impulses of all contacts when the first one of `group` closes with the speed of the scene's impact, with friction also slips
/// with half of it, and the others are at rest: predicted by the library, and simulated by the FMU. `entries` are the inverse
/// masses.
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
    let speed_of = |row: usize| if row / count == 0 { scene.impact.speed } else { 0.5 * scene.impact.speed };
    let rates = (0..scene.rows()).map(|row| if Some(row % count) == first { speed_of(row) } else { 0.0 }).collect();
    let start = Start { scene, contacts, entries, rates };
    let step = LENGTH * scene.predictions[group].contact_time() / f64::from(STEPS);
    let (predicted, step) = predicted(&start, step);
    let simulated = simulate(archive, unit, &start, step)?;
    let total = |impulses: &[Vec<f64>], row: usize| impulses.iter().map(|step| step[row]).sum::<f64>();
    let scale = (0..scene.rows()).map(|row| total(&predicted, row).abs()).fold(f64::MIN_POSITIVE, f64::max);
    let row = |row: usize| {
        let [predicted, simulated] = [&predicted, &simulated].map(|impulses| total(impulses, row));
        let contact = start.contacts[row % count].1.trim_end_matches('.');
        let what = match row / count {
            0 => "impulse of",
            1 => "tangential impulse of",
            _ => "second tangential impulse of",
        };
        Row::new(format!("{what} {contact}"), "N.s", predicted, simulated, scale)
    };
    Ok((0..scene.rows()).map(row).collect())
}

/// The prediction of the library, and the length of its steps \[s\].
fn predicted(start: &Start, step: f64) -> (Vec<Vec<f64>>, f64) {
    // each contact finds the strength of its own impact
    let is_rated = start.scene.finds_strength();
    let slow = is_rated.then(|| start.scene.clone().without_factors());
    let scene = slow.as_ref().unwrap_or(start.scene);
    let models: Vec<_> = start.contacts.iter().map(|(group, _)| scene.any_model_of(*group)).collect();
    let lossy: Vec<_> = models.iter().filter_map(AnyModel::lossy).copied().collect();
    let plastic: Vec<_> = models.iter().filter_map(AnyModel::elastoplastic).copied().collect();
    let friction = |place: usize| oblique::friction_of(scene, start.contacts[place].0);
    let frictional = || -> Vec<_> {
        let all = plastic.iter().enumerate();
        all.map(|(place, &normal)| FrictionalModel { normal, friction: friction(place), loss: () }).collect()
    };
    let rough_and_lossy = || -> Vec<_> {
        let all = lossy.iter().enumerate();
        all.map(|(place, &losses::Model { plastic: normal, loss })| FrictionalModel {
            normal,
            friction: friction(place),
            loss,
        })
        .collect()
    };
    fn rated<M: Copy>(start: &Start, models: &[M]) -> Vec<rate::Model<M>> {
        let all = start.contacts.iter().zip(models);
        all.map(|((group, _), &slow)| start.scene.at_any_rate(*group, slow)).collect()
    }
    type Lossy = losses::History<AnyLoss>;
    match (scene.directions, lossy.is_empty()) {
        (0, true) if is_rated => start.predicted::<_, rate::History>(&rated(start, &plastic), step),
        (0, false) if is_rated => start.predicted::<_, rate::History<Lossy>>(&rated(start, &lossy), step),
        (0, true) => start.predicted::<_, History>(&plastic, step),
        (0, false) => start.predicted::<_, Lossy>(&lossy, step),
        (1, true) => start.predicted::<_, FrictionalContact<MEMORY>>(&frictional(), step),
        (1, false) => start.predicted::<_, FrictionalContact<MEMORY, true, Lossy>>(&rough_and_lossy(), step),
        (_, true) => start.predicted::<_, PlaneContact<MEMORY>>(&frictional(), step),
        (_, false) => start.predicted::<_, PlaneContact<MEMORY, true, Lossy>>(&rough_and_lossy(), step),
    }
}

/// The impulses of each step of the FMU \[N.s\].
fn simulate(archive: &Archive, unit: &Unit, start: &Start, step: f64) -> Result<Vec<Vec<f64>>, ImportError> {
    let Start { scene, contacts, entries, rates: speeds } = start;
    let count = scene.rows();
    // of the normals, then of the tangents
    let references = |normal: &str, tangential: &str| {
        let names = match scene.directions {
            0 => vec![normal.to_string()],
            1 => vec![normal.into(), tangential.into()],
            _ => vec![normal.into(), format!("{tangential}[1]"), format!("{tangential}[2]")],
        };
        let all = names.iter().flat_map(|name| contacts.iter().map(move |(_, prefix)| format!("{prefix}{name}")));
        all.map(|name| archive.description.real(&name)).collect::<Result<Vec<_>, ImportError>>()
    };
    let rates = references("indentation_rate", "tangential_rate")?;
    let forces = references("mean_force", "mean_tangential_force")?;
    let mut instance = unit.instantiate()?;
    instance.setup_experiment(0.0)?;
    instance.call("fmi2EnterInitializationMode")?;
    let inputs = inverse_mass_inputs(scene) > 0;
    for (row, column) in (0..count).flat_map(|row| (row..count).map(move |column| (row, column))).filter(|_| inputs) {
        let reference = archive.description.real(&format!("{INVERSE_MASS}[{},{}]", row + 1, column + 1))?;
        instance.set_real(reference, entries[place(count, row, column)])?;
    }
    instance.call("fmi2ExitInitializationMode")?;
    let parallel = scene.is_parallel();
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
