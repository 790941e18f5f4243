//! What there is to choose from: laws, materials, outputs, tools, platforms, units.

use brinell_contact::damped::AnyDamped;
use brinell_contact::loading::AnyLoading;
use brinell_exporter::pairing::DEFAULT_LOADING;
use brinell_exporter::platform::{Platform, Target};
use brinell_exporter::table::{Causality, Law, MATERIALS, VARIABLES, damped_law, loading_law, unloading_laws};
use brinell_exporter::translate::tools::TOOLS;
use brinell_exporter::{pairing, units};
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
            "loading": AnyLoading::ALL.iter().map(|(name, _)| loading(loading_law(name))).collect::<Value>(),
            "unloading": unloading_laws().into_iter().map(law).collect::<Value>(),
            "damped": AnyDamped::ALL.iter().map(|(name, _)| law(damped_law(name))).collect::<Value>(),
        },
        "materials": *MATERIALS,
        "outputs": variables(Causality::Output),
        "parameters": variables(Causality::Parameter),
        "tools": TOOLS.iter().map(|tool| json!({ "name": tool.name, "title": tool.title })).collect::<Value>(),
        "platforms": Platform::ALL.iter().chain([&Platform::C_CODE]).map(platform).collect::<Value>(),
        "quantities": units::usual().map(|(unit, usual)| (unit.to_string(), json!(usual))).collect::<Value>(),
    })
}

fn law(law: &Law) -> Value {
    json!({
        "name": law.name, "title": law.title, "says": law.notes, "validity": law.validity, "accuracy": law.accuracy,
        "reference": law.reference,
    })
}

fn loading(one: &Law) -> Value {
    let mut value = law(one);
    value["recommended"] = json!(one.name == DEFAULT_LOADING);
    value["needs_yield"] = json!(one.name != "hertz");
    value["unloading"] = json!(pairing::unloading_of(&one.name).0);
    value
}

fn platform(platform: &Platform) -> Value {
    let targets: Vec<_> = platform.targets.iter().map(|Target { triple, .. }| triple).collect();
    json!({ "folder": platform.folder, "targets": targets })
}
