//! What `brinell export` says: what the unit has, and what was left out of it.

use crate::guard;
use crate::interface::prediction;
use crate::package::Exported;
use crate::scene::{Group, Parameter, Scene};
use crate::table::{Causality, VARIABLES, Variable};
use crate::validity;
use brinell::contact::Surface;
use brinell::contact::damped::AnyDamped;
use brinell::contact::loading::AnyLoading;
use brinell::contact::unloading::AnyUnloading;
use serde_json::{Value, json};

/// Inputs and outputs, parameters, and what there could be besides.
pub struct Summary<'a> {
    scene: &'a Scene,
    /// Names of the variables, those of a counted group as one: `contact[1..1000].force`.
    variables: Vec<String>,
    /// Names of the constants.
    constants: Vec<String>,
    /// Outputs that weren't chosen.
    outputs: Vec<&'static str>,
    /// Parameters that no contact has.
    absent: Vec<&'static str>,
    laws: OtherLaws,
    features: Vec<&'static str>,
}

/// The laws that the unit hasn't got.
struct OtherLaws {
    loading: Vec<&'static str>,
    unloading: Vec<&'static str>,
    damped: Vec<&'static str>,
}

impl Summary<'_> {
    pub fn of(scene: &Scene) -> Summary<'_> {
        let (parameters, constants) = parameters(scene);
        let has_parameter = |name: &str| all_parameters(scene).any(|(_, parameter)| parameter.name == name);
        let absent = of_kind(Causality::Parameter).filter(|name| !has_parameter(name)).collect();
        let outputs = of_kind(Causality::Output).filter(|name| !shows(scene, name)).collect();
        let shown = |causality| of_kind(causality).filter(|name| shows(scene, name));
        let all = shown(Causality::Input).chain(shown(Causality::Output));
        let names = all.flat_map(|name| scene.contacts.iter().map(move |group| format!("{}{name}", prefixes(group))));
        let variables = names.chain(parameters).collect();
        Summary { scene, variables, constants, outputs, absent, laws: OtherLaws::of(scene), features: features(scene) }
    }

    /// How many variables the unit has.
    fn variable_count(&self) -> usize {
        let shown = VARIABLES.iter().filter(|variable| shows(self.scene, &variable.name)).count();
        let settable = all_parameters(self.scene).filter(|(_, parameter)| parameter.settable).count();
        shown * self.scene.contact_count() + settable
    }

    /// The variables, those of all contacts together.
    fn variables_by_kind(&self) -> Vec<String> {
        let kinds = VARIABLES.iter().filter(|variable| shows(self.scene, &variable.name));
        let named = self.scene.contacts[0].name.is_some();
        let kind = |variable: &Variable| format!("{}{}", if named { "*." } else { "" }, variable.name);
        kinds.map(kind).chain(parameters(self.scene).0).collect()
    }

    /// For programs.
    pub fn json(&self, exported: &Exported) -> Value {
        // every variable there can be that this unit doesn't show
        let settable = |name: &str| all_parameters(self.scene).any(|(_, p)| p.name == name && p.settable);
        let left_out = VARIABLES.iter().map(|variable| variable.name.as_str());
        let left_out: Vec<_> = left_out.filter(|name| !shows(self.scene, name) && !settable(name)).collect();
        let OtherLaws { loading, unloading, damped } = &self.laws;
        let mut object = json!({
            "fmu": exported.path, "guid": exported.guid, "size": exported.size, "library_size": exported.library_size,
            "imports": exported.imports, "warnings": warnings(self.scene), "passivity_guard": guard::ranges(self.scene),
            "variables": self.variables, "variable_count": self.variable_count(), "constants": self.constants,
            "left_out": left_out, "absent": self.absent, "left_out_features": self.features,
            "left_out_laws": { "loading": loading, "unloading": unloading, "damped": damped },
        });
        if self.scene.contacts[0].name.is_some() {
            let groups = 0..self.scene.contacts.len();
            object["contacts"] = groups.map(|group| self.group_json(group)).collect();
        }
        object
    }

    fn group_json(&self, group: usize) -> Value {
        let Group { name, count, own, .. } = &self.scene.contacts[group];
        let own: Value = own.iter().map(|parameter| (parameter.name.to_string(), json!(parameter.value))).collect();
        json!({ "name": name, "count": count, "own": own, "passivity_guard": guard::ranges_of(self.scene, group) })
    }

    /// For people.
    pub fn print(&self, exported: &Exported) {
        println!("{}", exported.path.display());
        println!(
            "  {} bytes, library {} bytes; needs no library, takes {} from the process",
            exported.size,
            exported.library_size,
            exported.imports.join(", ")
        );
        println!("  law        {}", law(self.scene));
        if let Some(words) = guard::words(self.scene) {
            println!("  guard      {words}");
        }
        for warning in warnings(self.scene) {
            println!("  warning    {warning}");
        }
        if self.scene.contacts[0].name.is_some() {
            println!("  contacts   {}", self.scene.contact_count());
            self.scene.contacts.iter().for_each(|group| println!("    {}", group_line(group)));
        }
        println!("  variables  {}: {}", self.variable_count(), self.variables_by_kind().join(", "));
        // what a group has of its own stands in its line
        for Parameter { name, value, .. } in self.scene.parameters.iter().filter(|parameter| !parameter.settable) {
            println!("  constant   {name} = {value:?}");
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
            println!("    {heading:<12}{}", names.join(", "));
        }
    }
}

/// Where the scene's impact leaves the validity of its law, on the first contact.
fn warnings(scene: &Scene) -> Vec<String> {
    validity::warnings(&scene.any_model().pair(), scene.contacts[0].density, &prediction(scene), scene.impact.speed)
}

impl OtherLaws {
    fn of(scene: &Scene) -> OtherLaws {
        let used = match scene.damped {
            Some((name, _)) => [Some(name), None],
            None => [Some(scene.loading.0), scene.unloading.map(|(name, _)| name)],
        };
        let [first, second] = used;
        let loading = AnyLoading::ALL.iter().map(|(name, _)| *name);
        let unloading = AnyUnloading::ALL.iter().map(|(name, _)| *name);
        let damped = AnyDamped::ALL.iter().map(|(name, _)| *name);
        OtherLaws {
            loading: loading.filter(|name| Some(*name) != first).collect(),
            unloading: unloading.filter(|name| Some(*name) != second).collect(),
            damped: damped.filter(|name| Some(*name) != first).collect(),
        }
    }
}

/// What the unit doesn't do, beside laws.
fn features(scene: &Scene) -> Vec<&'static str> {
    let surface = |asked: Surface| scene.contacts.iter().any(|group| group.surface == asked);
    // an elastic contact leaves no dent to remember
    let dents = scene.unloading.is_some();
    [
        (!scene.passivity_guard, "passivity guard"),
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

/// Whether every contact has the input or output `name`.
fn shows(scene: &Scene, name: &str) -> bool {
    let is_input = |variable: &Variable| variable.name == name && variable.causality == Causality::Input;
    name == "force" || VARIABLES.iter().any(is_input) || scene.outputs.iter().any(|output| output == name)
}

/// Every parameter with the group that it belongs to, if it doesn't belong to all.
fn all_parameters(scene: &Scene) -> impl Iterator<Item = (Option<&Group>, &Parameter)> {
    let shared = scene.parameters.iter().map(|parameter| (None, parameter));
    let own = scene.contacts.iter().flat_map(|group| group.own.iter().map(move |parameter| (Some(group), parameter)));
    shared.chain(own)
}

/// The names of the parameters that can be set, and of the others.
fn parameters(scene: &Scene) -> (Vec<String>, Vec<String>) {
    let (mut settable, mut constants) = (Vec::new(), Vec::new());
    for (group, parameter) in all_parameters(scene) {
        let name = group.map_or(parameter.name.into(), |group| group.variable(parameter.name));
        if parameter.settable {
            settable.push(name);
        } else {
            constants.push(name);
        }
    }
    (settable, constants)
}

/// What stands before the variables of all contacts of the group.
fn prefixes(group: &Group) -> String {
    match (&group.name, group.count) {
        (Some(name), Some(count @ 2..)) => format!("{name}[1..{count}]."),
        _ => group.prefix(0),
    }
}

/// One line about a group: what differs in it.
fn group_line(group: &Group) -> String {
    let own = group.own.iter().map(|Parameter { name, value, .. }| format!("{name} = {value:?}"));
    let own = own.collect::<Vec<_>>().join(", ");
    let own = if own.is_empty() { "as the scene".into() } else { own };
    format!("{:<20} {:>6}  {own}", prefixes(group).trim_end_matches('.'), group.len())
}

fn law(scene: &Scene) -> String {
    match (scene.damped, scene.unloading) {
        (Some((damped, _)), _) => format!("{damped} (the force depends on the rate)"),
        (None, Some((unloading, _))) => format!("{}, unloading by {unloading}", scene.loading.0),
        (None, None) => format!("{} (elastic)", scene.loading.0),
    }
}
