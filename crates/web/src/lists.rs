//! What there is to choose from: laws, materials, outputs, tools, platforms, units.

use crate::examples;
use brinell_contact::Regime;
use brinell_contact::damped::AnyDamped;
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use brinell_exporter::law_text::{self, LawText};
use brinell_exporter::pairing::DEFAULT_LOADING;
use brinell_exporter::platform::{Platform, Target};
use brinell_exporter::scene::rules;
use brinell_exporter::table::{Causality, Law, MATERIALS, VARIABLES};
use brinell_exporter::translate::tools::TOOLS;
use brinell_exporter::{pairing, regime, units};
use serde_json::{Value, json};

/// All lists of the page.
pub fn about() -> Value {
    let variables = |causality| {
        let those = VARIABLES.iter().filter(move |variable| variable.causality == causality);
        those.map(|it| json!({ "name": it.name, "unit": it.unit, "description": it.description })).collect::<Value>()
    };
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "laws": {
            "loading": AnyLoading::of_balls().map(|(name, it)| loading(&law_text::loading(name, &it))).collect::<Value>(),
            "unloading": AnyUnloading::ALL.iter().map(|(name, it)| law(&law_text::unloading(name, it))).collect::<Value>(),
            "damped": AnyDamped::ALL.iter().map(|(name, it)| of_scene(&law_text::damped(name, it))).collect::<Value>(),
        },
        "materials": *MATERIALS,
        "outputs": variables(Causality::Output),
        "parameters": variables(Causality::Parameter),
        "tools": TOOLS.iter().map(|tool| json!({ "name": tool.name, "title": tool.title })).collect::<Value>(),
        "platforms": Platform::ALL.iter().chain([&Platform::C_CODE]).map(platform).collect::<Value>(),
        "regimes": Regime::ALL.map(|it| json!({ "name": regime::words(it), "means": regime::means(it) })),
        "examples": examples::all(),
        "units": units::usual().map(|(unit, usual)| (unit.to_string(), json!(usual))).collect::<Value>(),
    })
}

fn law(text: &LawText) -> Value {
    let Law { name, title, accuracy, reference, .. } = text.law;
    json!({
        "name": name, "title": title, "says": text.notes, "validity": text.validity, "accuracy": accuracy, "reference": reference,
    })
}

/// A law by which a scene can load, with the keys of its table that don't go with it, and those that it needs.
fn of_scene(text: &LawText) -> Value {
    let [closes, needs] = rules::of_law(&text.law.name);
    let mut value = law(text);
    (value["closes"], value["needs"]) = (json!(closes), json!(needs));
    value
}

fn loading(text: &LawText) -> Value {
    let name = text.law.name.as_str();
    let mut value = of_scene(text);
    value["recommended"] = json!(name == DEFAULT_LOADING);
    value["needs_yield"] = json!(name != "hertz");
    value["unloading"] = json!(pairing::unloading_of(name).0);
    value
}

fn platform(platform: &Platform) -> Value {
    let targets: Vec<_> = platform.targets.iter().map(|Target { triple, .. }| triple).collect();
    json!({ "folder": platform.folder, "targets": targets })
}
