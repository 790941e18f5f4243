//! Fits a scene to a prebuilt library, and turns it into the data of that library.

use super::kinds::{Library, LibraryLaws};
use crate::constants::{parameters, start_value};
use crate::interface::Entry;
use crate::plan::Plan;
use crate::scene::{InverseMasses, Scene};
use crate::table::{Causality, VARIABLES};
use brinell_contact::Surface;
use brinell_contact::damped::AnyDamped;
use brinell_fmu::scene::Parameter;
use brinell_fmu::scene::identity_of;
use brinell_fmu::scene::prebuilt::block::{Data, FIRST_PARAMETER, Flag, GUID, TEXTS, VARIABLES as PLACES};

/// A scene that fits no prebuilt library.
#[derive(Debug, thiserror::Error)]
#[error("{key}: {reason}")]
pub struct NeedsCompiler {
    /// The part of the scene that is the reason.
    pub key: String,
    pub reason: String,
}

fn needs(key: impl Into<String>, reason: impl Into<String>) -> NeedsCompiler {
    NeedsCompiler { key: key.into(), reason: reason.into() }
}

impl Library {
    /// The smallest library that fits `scene`.
    ///
    /// # Errors
    /// [`NeedsCompiler`] with the first key that no prebuilt library supports.
    pub fn of(scene: &Scene) -> Result<Library, NeedsCompiler> {
        library_for(scene)
    }
}

fn library_for(scene: &Scene) -> Result<Library, NeedsCompiler> {
    let count = scene.contact_count();
    if count > 1 {
        return Err(needs("[[contact]]", format!("there are {count} contacts, and prebuilt libraries have one")));
    }
    if let Some(masses) = &scene.inverse_masses {
        let key = if *masses == InverseMasses::Inputs { "coupling.inverse_masses" } else { "[[body]]" };
        return Err(needs(key, "prebuilt libraries know one mass and no bodies"));
    }
    if scene.passivity_guard {
        return Err(needs("law.passivity_guard", "prebuilt libraries have no guard"));
    }
    if scene.has_friction() {
        return Err(needs("[friction]", "prebuilt libraries have no friction"));
    }
    if let Some(loss) = scene.loss {
        let key = if loss.follows_rate() { "law.elastic_restitution" } else { "target.plate_thickness" };
        return Err(needs(key, "prebuilt libraries have no losses below yield"));
    }
    if scene.finds_strength() {
        let reason = "with [coupling] the strength is found at the first touch of each impact, and prebuilt libraries have one \
                      strength for all";
        return Err(needs("target.rate", reason));
    }
    if let (Some((name, _)), Some(_)) = (scene.damped, scene.coupling) {
        return Err(needs("[coupling]", format!("prebuilt libraries with {name} don't move the bodies")));
    }
    let laws = laws_of(scene)?;
    let library = Library::for_scene(laws, scene).expect("some kind has all outputs");
    let (published, kind) = (&library.scene, "the prebuilt library has the constants of the reference");
    let differs = published.loading != scene.loading || published.damped != scene.damped;
    if differs {
        return Err(needs("law.loading_parameters", kind));
    }
    if published.unloading != scene.unloading {
        return Err(needs("law.unloading_parameters", kind));
    }
    Ok(library)
}

/// The prebuilt laws of `scene`, regardless of their constants.
fn laws_of(scene: &Scene) -> Result<LibraryLaws, NeedsCompiler> {
    let all = LibraryLaws::all();
    if let Some((name, law)) = scene.damped {
        let of_name: Vec<_> = all.into_iter().filter(|laws| laws.loading == name).collect();
        // the damping selects the variant; constants are compared later
        let same = of_name.iter().find(|laws| damped_of(laws) == Some(law)).or(of_name.first());
        return Ok(*same.expect("every rate-dependent law is prebuilt"));
    }
    let of_name: Vec<_> = all.into_iter().filter(|laws| laws.loading == scene.loading.0).collect();
    let partner = scene.unloading.map(|(name, _)| name);
    if let Some(laws) = of_name.iter().find(|laws| laws.partner == partner) {
        return Ok(*laws);
    }
    let prebuilt: Vec<_> = of_name.iter().filter_map(|laws| laws.partner).collect();
    let reason = format!("{} is prebuilt with unloading = \"{}\"", scene.loading.0, prebuilt.join("\", \""));
    Err(needs(format!("law.unloading = {:?}", partner.unwrap_or_default()), reason))
}

/// The rate-dependent law with these names and its reference constants.
fn damped_of(laws: &LibraryLaws) -> Option<AnyDamped> {
    use crate::model::Dampings;
    let (_, law) = AnyDamped::ALL.into_iter().find(|(name, _)| *name == laws.loading)?;
    laws.partner.map_or(Some(law), |damping| law.with_damping(damping))
}

/// The data of the planned FMU with the identification `guid`.
///
/// # Errors
/// [`NeedsCompiler`] if the names of the variables are too long.
pub fn data_of(plan: &Plan, guid: &str) -> Result<Data, NeedsCompiler> {
    let scene = plan.scene;
    let group = &scene.contacts[0];
    let mut data = Data { identity: identity_of(guid), guid: as_bytes(guid), ..Data::EMPTY };
    let flags = [
        (Flag::Fresh, group.surface == Surface::Fresh),
        (Flag::Acceleration, scene.has_input("external_acceleration")),
        (Flag::Mass, scene.has_input("effective_mass")),
    ];
    data.flags = flags.iter().filter(|(_, is)| *is).map(|(flag, _)| flag.bit()).sum();
    data.density = group.density.unwrap_or(f64::NAN);
    data.impact_mass = if scene.watches { scene.impact.mass } else { f64::NAN };
    let mut texts = String::new();
    let is_parameter = |entry: &&Entry| entry.variable.causality == Causality::Parameter;
    for (place, variable) in parameters().take(Parameter::PREBUILT).enumerate() {
        data.starts[place] = start_value(scene, 0, &variable.name);
        let entry = plan.variables.iter().filter(is_parameter).find(|entry| entry.variable.name == variable.name);
        if let Some(entry) = entry {
            data.settable |= 1 << place;
            data.minima[place] = variable.minimum.unwrap_or(f64::MIN);
            data.maxima[place] = variable.maximum.unwrap_or(f64::MAX);
            texts += &entry.name(0);
            data.variables[entry.reference] = FIRST_PARAMETER + place as u8;
        }
        texts.push('\0');
        texts += entry.and_then(|entry| entry.variable.unit.as_deref()).unwrap_or_default();
        texts.push('\0');
    }
    for entry in plan.variables.iter().filter(|entry| !is_parameter(entry)) {
        let place = VARIABLES.iter().position(|variable| std::ptr::eq(variable, entry.variable));
        data.variables[entry.reference] = place.expect("every variable is in the table") as u8;
    }
    let room = data.texts.get_mut(..texts.len()).ok_or_else(|| {
        let name = group.name.as_deref().unwrap_or_default();
        needs(
            format!("[[contact]] name = {name:?}"),
            format!(
                "the names of its variables take {} bytes, and prebuilt libraries have room for {TEXTS}",
                texts.len()
            ),
        )
    })?;
    room.copy_from_slice(texts.as_bytes());
    Ok(data)
}

fn as_bytes(guid: &str) -> [u8; GUID] {
    guid.as_bytes().try_into().expect("a GUID has 32 digits")
}

/// A value reference and an index into the table take one byte each.
const _: () = assert!(PLACES <= FIRST_PARAMETER as usize);
