//! The data of a planned FMU.

use super::parameters::{Sources, first_contact};
use crate::interface::{Entry, INVERSE_MASS, is_tunable};
use crate::plan::Plan;
use crate::scene::{InverseMasses, Loss, Scene, SceneLaws};
use crate::table::{Causality, Variable};
use brinell_contact::Surface;
use brinell_contact::rate::Rate;
use brinell_fmu::scene::library::block::{
    self, Data, FIRST_INTEGER, Flag, KINDS, List, RateNumbers, Run, SOURCE_WORDS, Table, Text,
};
use brinell_fmu::scene::variable::Source;
use brinell_fmu::scene::{Integer, Parameter, Real, identity_of};

/// The data of a scene, and the words of their lists.
pub struct SceneData {
    pub data: Data,
    pub lists: Vec<u64>,
}

/// The lists of a scene.
#[derive(Default)]
struct Lists {
    words: Vec<u64>,
    ends: [[u32; 2]; List::COUNT],
    texts: Vec<u8>,
}

impl Lists {
    /// Adds a list of rows.
    fn add<const WORDS: usize>(&mut self, list: List, rows: impl IntoIterator<Item = [u64; WORDS]>) {
        let start = self.words.len();
        self.words.extend(rows.into_iter().flatten());
        self.ends[list as usize] = [start as u32, (self.words.len() - start) as u32];
    }

    /// Adds a list of bytes, with zeros at its end.
    fn add_bytes(&mut self, list: List, bytes: &[u8]) {
        let word = |bytes: &[u8]| {
            let mut word = [0; 8];
            word[..bytes.len()].copy_from_slice(bytes);
            [u64::from_le_bytes(word)]
        };
        self.add(list, bytes.chunks(8).map(word));
    }

    /// Adds a text to the texts.
    fn text(&mut self, text: &str) -> Text {
        let start = self.texts.len() as u32;
        self.texts.extend(text.as_bytes());
        Text { start, length: text.len() as u32 }
    }
}

impl SceneData {
    /// The data of the planned FMU with the identification `guid`.
    pub fn of(plan: &Plan, guid: &str) -> SceneData {
        let scene = plan.scene;
        let mut lists = Lists::default();
        let mut end = 0;
        let tables = scene.contacts.iter().map(|group| {
            end += group.size() as u64;
            Table {
                end,
                is_counted: group.count.is_some(),
                is_fresh: group.surface == Surface::Fresh,
                density: group.density.unwrap_or(f64::NAN),
                size: group.ellipse.as_ref().map_or(f64::INFINITY, |elliptic| elliptic.size),
                name: lists.text(group.name.as_deref().unwrap_or_default()),
            }
        });
        let tables: Vec<_> = tables.collect();
        lists.add(List::Tables, tables.iter().map(Table::words));
        let runs = runs(plan, &mut lists);
        lists.add(List::Runs, runs.iter().map(Run::words));
        let (sources, rows) = sources(scene);
        lists.add(List::Sources, rows);
        if let Some(masses) = scene.inverse_masses() {
            lists.add(List::InverseMasses, inverse_masses(plan, masses).into_iter().map(|entry| [entry.to_bits()]));
        }
        if let Some(guard) = &plan.guard {
            lists.add_bytes(List::Guard, format!("the passivity guard {}", guard.words()).as_bytes());
        }
        if let Some(curve) = scene.laws.loading().1.table() {
            lists.add(List::Curve, curve.list().map(|number| [number.to_bits()]));
        }
        lists.add_bytes(List::Guid, guid.as_bytes());
        let texts = std::mem::take(&mut lists.texts);
        lists.add_bytes(List::Texts, &texts);
        let contacts = scene.contact_count();
        let kinds = kinds(plan);
        let mut data = Data {
            identity: identity_of(guid),
            flags: flags(scene),
            contacts: contacts as u64,
            groups: scene.group_count() as u64,
            values: runs.last().map_or(0, |run| run.end),
            kinds: kinds.len() as u64,
            impact_mass: if scene.watches { scene.impact.mass } else { 0.0 },
            rates: [scene.rates.target, scene.rates.impactor].map(|rate| RateNumbers::of(rate.unwrap_or(Rate::NONE))),
            sources,
            lists: lists.ends,
            ..Data::EMPTY
        };
        data.loading = match &scene.laws {
            SceneLaws::Damped(_, law) => law.numbers(),
            laws => laws.loading().1.numbers(),
        };
        data.unloading = scene.laws.plain_unloading().numbers();
        data.loss = match scene.laws.loss() {
            _ if scene.is_damped() => block::Loss::Damper,
            Some(Loss::Waves) => block::Loss::Waves,
            Some(Loss::Plate(_)) => block::Loss::Plate,
            Some(Loss::Fitted(_)) | None => block::Loss::Fitted,
        } as u64;
        const { assert!(Real::ALL.len() + Integer::ALL.len() <= KINDS && KINDS <= FIRST_INTEGER as usize) };
        for (slot, name) in data.codes.iter_mut().zip(&kinds) {
            let real = Real::ALL.iter().position(|(known, _)| known == name).map(|place| place as u8);
            let integer = || Integer::ALL.iter().position(|(known, _)| known == name).map(|place| place as u8);
            *slot = real.or_else(|| Some(FIRST_INTEGER + integer()?)).expect("every variable has a type");
        }
        SceneData { data, lists: lists.words }
    }

    /// All their words.
    pub fn words(&self) -> impl Iterator<Item = u64> {
        self.data.words().chain(self.lists.iter().copied())
    }
}

/// The kinds of variables of a contact without parameters, in the order of their references.
fn kinds<'a>(plan: &'a Plan) -> Vec<&'a str> {
    let mut kinds: Vec<&Variable> = plan.variables.iter().map(|entry| entry.variable).collect();
    kinds.retain(|variable| variable.causality != Causality::Parameter && variable.name != INVERSE_MASS);
    kinds.dedup_by_key(|variable| variable.name.as_str());
    kinds.into_iter().map(|variable| variable.name.as_str()).collect()
}

/// The features of a scene.
fn flags(scene: &Scene) -> u64 {
    let outputs = |names: &[&str]| scene.outputs.iter().any(|output| names.contains(&output.as_str()));
    let flags = [
        (Flag::Acceleration, scene.has_input("external_acceleration")),
        (Flag::Mass, scene.mass_is_input()),
        (Flag::Moves, scene.coupling.is_some()),
        (Flag::Parallel, scene.is_parallel()),
        (Flag::Shared, scene.inverse_masses().is_some()),
        (Flag::InverseMassInputs, scene.inverse_masses() == Some(&InverseMasses::Inputs)),
        (Flag::Momentum, outputs(&["impulse", "mean_force"])),
        (Flag::InputDerivatives, scene.has_course()),
        (Flag::Forces, keeps_forces(scene)),
        (Flag::Paired, scene.is_paired()),
        (Flag::FollowsRate, scene.follows_rate()),
        (Flag::Predicts, outputs(&["predicted_force", "predicted_tangential_force"])),
    ];
    flags.iter().filter(|(_, is)| *is).map(|(flag, _)| flag.bit()).sum()
}

/// Whether the forces of contacts are stored. A single contact, or one whose force depends on the rate, computes its own on request.
fn keeps_forces(scene: &Scene) -> bool {
    scene.contact_count() > 1 && !scene.is_rate_dependent()
}

/// The inverse masses, or their start values.
fn inverse_masses(plan: &Plan, masses: &InverseMasses) -> Vec<f64> {
    match masses {
        InverseMasses::Constant { entries, .. } => entries.clone(),
        InverseMasses::Inputs => {
            let starts = plan.variables.iter().filter(|entry| entry.variable.name == INVERSE_MASS);
            starts.flat_map(|entry| vec![entry.start.unwrap_or(0.0); entry.count]).collect()
        }
    }
}

/// The parameters that can be set, each with its values.
fn runs(plan: &Plan, lists: &mut Lists) -> Vec<Run> {
    let is_parameter = |entry: &&Entry| entry.variable.causality == Causality::Parameter;
    let mut end = 0;
    let run = |entry: &Entry| {
        end += entry.count as u64;
        let [minimum, maximum, start] = [entry.variable.minimum, entry.variable.maximum, entry.start]
            .map(|value| value.expect("a parameter has a start value and limits"));
        let first = entry.group.filter(|_| entry.count > 1).map(|group| first_contact(plan.scene, group));
        // with several values, the contact is named before
        let name = if entry.count == 1 { entry.name(0) } else { entry.variable.name.clone() };
        Run {
            end,
            first_contact: first.map_or(u64::MAX, |first| first as u64),
            is_tunable: is_tunable(plan.scene, &entry.variable.name),
            start,
            minimum,
            maximum,
            name: lists.text(&name),
            unit: lists.text(entry.variable.unit.as_deref().unwrap_or_default()),
        }
    };
    plan.variables.iter().filter(is_parameter).map(run).collect()
}

/// A source of a parameter as words.
type SourceWords = [u64; SOURCE_WORDS];

/// The sources of all parameters, and the rows of those that differ between tables.
fn sources(scene: &Scene) -> ([SourceWords; Parameter::ALL.len()], Vec<SourceWords>) {
    let sources = Sources::of(scene);
    let source = |table: usize, (name, parameter): (&str, Parameter)| {
        let without_effect = || Source::Constant(parameter.without_effect());
        block::source_words(&sources.get(table, name).unwrap_or_else(without_effect))
    };
    let tables = 0..scene.contacts.len();
    let mut differing = Vec::new();
    let of_all = Parameter::ALL.map(|parameter| {
        let first = source(0, parameter);
        if tables.clone().all(|table| source(table, parameter) == first) {
            return first;
        }
        differing.push(parameter);
        block::source_of_column(differing.len() - 1)
    });
    let rows = tables.flat_map(|table| differing.iter().map(move |&parameter| (table, parameter)));
    (of_all, rows.map(|(table, parameter)| source(table, parameter)).collect())
}
