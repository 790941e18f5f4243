//! The summary of `brinell export`: the contents of the FMU, and the omitted features.

use crate::package::{Exported, Origin};
use brinell_contact::Surface;
use brinell_contact::damped::AnyDamped;
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use brinell_exporter::interface::Entry;
use brinell_exporter::layout::{paragraph, shown};
use brinell_exporter::numbers::quantity;
use brinell_exporter::package::Packed;
use brinell_exporter::plan::{FixedParameter, Plan};
use brinell_exporter::scene::{Body, Group, InImpact, Parameter, Scene, SceneLaws};
use brinell_exporter::table::{self, Causality, VARIABLES};
use serde_json::{Value, json};

/// Inputs, outputs, parameters and the features that the FMU does not have.
pub struct Summary<'a> {
    plan: &'a Plan<'a>,
    /// Outputs that were not requested.
    outputs: Vec<&'static str>,
    /// Parameters that no contact has.
    absent: Vec<&'static str>,
    laws: OtherLaws,
    features: Vec<&'static str>,
}

/// The laws that the FMU does not contain.
struct OtherLaws {
    loading: Vec<&'static str>,
    unloading: Vec<&'static str>,
    damped: Vec<&'static str>,
}

impl Summary<'_> {
    pub fn of<'a>(plan: &'a Plan<'a>) -> Summary<'a> {
        let scene = plan.scene;
        let parameters = scene.parameters.iter().chain(scene.contacts.iter().flat_map(|group| &group.own));
        // without friction, its variables are not listed one by one
        let exists = |name: &&str| {
            let variable = table::variable(name);
            (scene.has_friction() || !variable.friction) && (scene.directions > 1 || variable.second_of.is_none())
        };
        let absent = of_kind(Causality::Parameter).filter(|name| !parameters.clone().any(|other| other.name == *name));
        let absent = absent.filter(exists);
        let outputs = of_kind(Causality::Output).filter(|name| !shows(plan, name)).filter(exists);
        let (outputs, absent) = (outputs.collect(), absent.collect());
        Summary { plan, outputs, absent, laws: OtherLaws::of(scene), features: features(scene) }
    }

    /// The number of variables of the FMU.
    fn variable_count(&self) -> usize {
        self.plan.variables.iter().map(|entry| entry.count).sum()
    }

    /// The variables by kind, with those of all contacts together.
    fn variables_by_kind(&self) -> Vec<String> {
        let named = self.plan.scene.contacts[0].name.is_some();
        let mut names: Vec<String> = Vec::new();
        for entry in &self.plan.variables {
            let name = match entry.variable.causality {
                Causality::Parameter => entry.label(),
                _ if named => format!("*.{}", entry.component()),
                _ => entry.component(),
            };
            if names.last() != Some(&name) {
                names.push(name);
            }
        }
        names
    }

    /// As JSON.
    pub fn json(&self, exported: &Exported) -> Value {
        let Plan { scene, variables, constants, guard, warnings, .. } = self.plan;
        // all variables that this FMU does not have
        let left_out = VARIABLES.iter().map(|variable| variable.name.as_str());
        let left_out: Vec<_> = left_out.filter(|name| !shows(self.plan, name)).collect();
        let OtherLaws { loading, unloading, damped } = &self.laws;
        let libraries = exported.libraries.iter();
        let libraries: Value = libraries
            .map(|Packed { platform, size, imports }| {
                (platform.to_string(), json!({ "size": size, "imports": imports }))
            })
            .collect();
        let mut object = json!({
            "fmu": exported.path.to_string_lossy(), "guid": exported.guid, "size": exported.size, "library_size": exported.library_size(),
            "imports": exported.imports(), "libraries": libraries, "made": exported.origin.as_ref().map(Origin::json), "warnings": warnings, "rods": self.plan.waves, "shared_bodies": self.plan.shared_bodies,
            "makes_energy": self.plan.makes_energy, "passivity_guard": guard.as_ref().map(|guard| &guard.ranges),
            "variables": variables.iter().map(Entry::label).collect::<Vec<_>>(), "variable_count": self.variable_count(),
            "constants": constants.iter().map(|constant| &constant.name).collect::<Vec<_>>(),
            "left_out": left_out, "absent": self.absent, "left_out_features": self.features,
            "left_out_laws": { "loading": loading, "unloading": unloading, "damped": damped },
        });
        object["materials"] = json!(scene.materials);
        object["strengths"] = json!(strengths(scene));
        if scene.contacts[0].name.is_some() {
            let groups = 0..scene.contacts.len();
            object["contacts"] = groups.map(|group| self.group_json(group)).collect();
        }
        object
    }

    fn group_json(&self, group: usize) -> Value {
        let Plan { scene, guard, .. } = self.plan;
        let Group { name, count, own, .. } = &scene.contacts[group];
        let per_contact = own.iter().filter(|own| own.per_contact).map(|own| own.name).collect::<Vec<_>>();
        let own: Value = own.iter().map(|parameter| (parameter.name.to_string(), json!(parameter.value))).collect();
        let ranges = guard.as_ref().map(|guard| &guard.by_group[group]);
        json!({
            "name": name, "count": count, "own": own, "parameters_per_contact": per_contact, "passivity_guard": ranges
        })
    }

    /// As text.
    pub fn print(&self, exported: &Exported) {
        println!("{}", shown(&exported.path));
        println!("  {} bytes", exported.size);
        let line = |heading: &str, text: &str| print!("{}", paragraph(&format!("  {heading:<11}"), text));
        for Packed { platform, size, imports } in &exported.libraries {
            let from = if platform.starts_with("win") { "kernel32" } else { "the process" };
            let imported = if imports.is_empty() { "nothing".into() } else { imports.join(", ") };
            print!(
                "{}",
                paragraph(&format!("  {platform:<15}"), &format!("{size} bytes; takes {imported} from {from}"))
            );
        }
        if let Some(origin) = &exported.origin {
            line("made", &origin.words());
        }
        let Plan { scene, constants, guard, warnings, .. } = self.plan;
        line("law", &law(scene));
        scene.materials.iter().for_each(|words| line("material", words));
        strengths(scene).iter().for_each(|words| line("strength", words));
        if let Some(guard) = guard {
            line("guard", &guard.words());
        }
        if self.plan.makes_energy {
            line("energy", "these laws can give back more than they took");
        }
        for warning in warnings.iter().map(String::as_str).chain(self.plan.shared_bodies) {
            line("warning", warning);
        }
        if let Some(note) = self.plan.waves_note() {
            line("rods", &note);
        }
        if scene.contacts[0].name.is_some() {
            line("contacts", &scene.contact_count().to_string());
            scene.contacts.iter().for_each(|group| print!("{}", group_line(group)));
        }
        line("variables", &format!("{}: {}", self.variable_count(), self.variables_by_kind().join(", ")));
        // constants of a group are in the line of the group
        for FixedParameter { name, value, unit, .. } in constants.iter().filter(|constant| constant.shared) {
            line("constant", format!("{name} = {value:?} {unit}").trim_end());
        }
        let OtherLaws { loading, unloading, damped } = &self.laws;
        println!("  left out");
        let parts = [
            ("outputs", &self.outputs),
            ("parameters", &self.absent),
            ("loading", loading),
            ("unloading", unloading),
            ("damped", damped),
            ("besides", &self.features),
        ];
        for (heading, names) in parts.into_iter().filter(|(_, names)| !names.is_empty()) {
            print!("{}", paragraph(&format!("    {heading:<12}"), &names.join(", ")));
        }
    }
}

impl OtherLaws {
    fn of(scene: &Scene) -> OtherLaws {
        let (first, second) = (scene.laws.name(), scene.laws.unloading().map(|(name, _)| name));
        let loading = AnyLoading::ALL.iter().map(|(name, _)| *name);
        let unloading = AnyUnloading::ALL.iter().map(|(name, _)| *name);
        let damped = AnyDamped::ALL.iter().map(|(name, _)| *name);
        OtherLaws {
            loading: loading.filter(|name| *name != first).collect(),
            unloading: unloading.filter(|name| Some(*name) != second).collect(),
            damped: damped.filter(|name| *name != first).collect(),
        }
    }
}

/// Features that the FMU does not have, other than laws.
fn features(scene: &Scene) -> Vec<&'static str> {
    let surface = |asked: Surface| scene.contacts.iter().any(|group| group.surface == asked);
    // an elastic contact leaves no dent to remember
    let dents = scene.laws.unloading().is_some();
    [
        (!scene.laws.is_guarded(), "passivity guard"),
        (!scene.has_friction(), "friction"),
        (!(dents && surface(Surface::Dented)), "surface that keeps its dents"),
        (!(dents && surface(Surface::Fresh)), "surface that is fresh at every contact"),
    ]
    .into_iter()
    .filter_map(|(left_out, name)| left_out.then_some(name))
    .collect()
}

fn of_kind(causality: Causality) -> impl Iterator<Item = &'static str> {
    VARIABLES.iter().filter(move |variable| variable.causality == causality).map(|variable| variable.name.as_str())
}

/// Whether at least one contact of the FMU has the variable `name`.
fn shows(plan: &Plan, name: &str) -> bool {
    plan.variables.iter().any(|entry| entry.variable.name == name)
}

/// One line about a group with its differences.
fn group_line(group: &Group) -> String {
    let own = group.own.iter().map(|Parameter { name, value, per_contact, .. }| {
        format!("{name} = {value:?}{}", if *per_contact { " for each" } else { "" })
    });
    let own = own.collect::<Vec<_>>().join(", ");
    let own = if own.is_empty() { "as the scene".into() } else { own };
    paragraph(&format!("    {:<20} {:>6}  ", group.label(), group.size()), &own)
}

/// What was made of the hardness, the tensile strength, the tensile test or the material of the bodies, for the impact of the scene: once for
/// all contacts that say the same.
fn strengths(scene: &Scene) -> Vec<String> {
    let of = |group: usize| -> Vec<String> {
        let has_words = Body::ALL.iter().any(|body| scene.measured(group, *body).is_some());
        let found = has_words.then(|| scene.in_impact(group, &scene.impact_of(group))).flatten();
        let words = |found: InImpact| {
            let words = Body::ALL.into_iter().filter_map(|body| scene.measured_words(group, body, &found));
            let rate = scene.rate(group).map(|_| {
                let strength = quantity(found.yield_strength, "Pa");
                format!("{}: S = {strength} at the strain rate of the impact", scene.softer(group).name())
            });
            words.chain(rate).collect()
        };
        found.map(words).unwrap_or_default()
    };
    let by_group = scene.by_bodies(of);
    let mut all: Vec<String> = Vec::new();
    for (group, words) in scene.contacts.iter().zip(by_group) {
        let owner = if by_name(scene) { format!("{}: ", group.label()) } else { String::new() };
        let said = |word: &String| all.iter().any(|known| known.ends_with(word.as_str()));
        let new: Vec<_> = words.iter().filter(|word| !said(word)).map(|word| format!("{owner}{word}")).collect();
        all.extend(new);
        if all.len() >= MOST_STRENGTHS {
            break;
        }
    }
    all
}

/// Whether contacts have strengths of their own.
fn by_name(scene: &Scene) -> bool {
    let own =
        |group: &Group| Body::ALL.iter().any(|body| group.own.iter().any(|own| own.name == body.yield_strength()));
    scene.contacts.iter().any(own)
}

/// The largest number of lines about strengths.
const MOST_STRENGTHS: usize = 20;

fn law(scene: &Scene) -> String {
    let laws = match scene.laws {
        SceneLaws::Damped(name, _) => format!("{name} (the force depends on the rate)"),
        SceneLaws::Plastic { loading, unloading, .. } => format!("{}/{} (loading/unloading)", loading.0, unloading.0),
        SceneLaws::Elastic { .. } => "hertz (elastic)".into(),
    };
    scene.laws.loss().map_or(laws.clone(), |loss| format!("{laws}, with {}", loss.name()))
}
