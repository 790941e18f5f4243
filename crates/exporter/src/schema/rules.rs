//! What one key of a scene says about others, as far as a schema can express it.

use super::{complete_constants, object};
use crate::measured::{self, TEST_RATE};
use crate::model::Dampings;
use crate::pairing;
use crate::parameters::{self, LawConstant};
use crate::scene::{GROUND, LINE, WAVES, taken_names};
use crate::table;
use brinell_contact::damped::{AnyDamped, Damped};
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use serde_json::{Value, json};

/// Adds the rules to the `schema` of scenes.
pub fn add(schema: &mut Value) {
    let moved = any([has("body"), key("coupling", has("inverse_masses"))]);
    let knows_mass = any([has("body"), has("coupling")]);
    let damped = key("law", key("loading", names(AnyDamped::ALL.iter().map(|(name, _)| *name))));
    let damps_by_mass = AnyDamped::ALL.iter().filter(|(_, law)| law.needs_mass()).map(|(name, _)| *name);
    let damps_by_mass = key("law", key("loading", names(damps_by_mass)));
    let elastic_loss = key("law", has("elastic_restitution"));
    let loss = any([elastic_loss.clone(), key("target", has("plate_thickness"))]);
    let derivatives = |wanted: bool| key("fmu", key("input_derivatives", json!({ "const": wanted })));
    let mass_input = key("coupling", key("inputs", json!({ "contains": { "const": "effective_mass" } })));
    let masses = any([key("coupling", has("effective_mass")), mass_input.clone()]);
    let softening = AnyLoading::ALL.iter().filter(|(_, law)| !law.takes_both_bodies()).map(|(name, _)| *name);
    let softening = softening.chain(AnyDamped::ALL.iter().map(|(name, _)| *name));
    let hardens = any(["hardening_modulus", "tangent_modulus", "power_law"].map(has));
    let bodies_of = |so: Value| json!({ "impactor": so, "target": so });
    let rules = [
        implies(not(has("contact")), of_single_contact()),
        implies(key("law", key("loading", names(softening))), {
            let of_all = bodies_of(not(hardens));
            let of_contacts = each_contact(json!({ "properties": of_all }));
            all([json!({ "properties": of_all }), of_contacts])
        }),
        implies(all([has("coupling"), not(has("body"))]), {
            json!({ "properties": { "coupling": any([has("effective_mass"), has("inverse_masses")]) } })
        }),
        implies(
            has("body"),
            all([
                has("contact"),
                not(any([key("coupling", has("inverse_masses")), key("impact", has("mass"))])),
                each_contact(all([has("between"), not(has("count"))])),
                any([
                    each_contact(all([has("normal"), not(has("direction"))])),
                    each_contact(not(any(["normal", "arms"].map(has)))),
                ]),
            ]),
        ),
        implies(not(has("body")), each_contact(not(any(ENDS.map(has))))),
        implies(
            moved.clone(),
            all([
                not(any([damps_by_mass.clone(), masses.clone()])),
                implies(has("friction"), not(any([key("impactor", has("rate")), key("target", has("rate"))]))),
                each_contact(not(has("effective_mass"))),
            ]),
        ),
        implies(not(has("coupling")), each_contact(not(has("effective_mass")))),
        implies(all([has("body"), has("friction")]), each_contact(all([has("normal"), has("tangent")]))),
        implies(
            has("friction"),
            all([
                not(damped.clone()),
                not(key(
                    "law",
                    any([
                        key("passivity_guard", json!({ "const": true })),
                        key("unloading", names(without_friction())),
                    ]),
                )),
                any([not(loss.clone()), moved.clone()]),
                not(key("coupling", has("effective_mass"))),
            ]),
        ),
        implies(
            not(has("friction")),
            all([
                each_contact(not(any([key("friction", has("coefficient")), has("tangent")]))),
                no_output(&|variable| variable.friction),
            ]),
        ),
        implies(not(moved), no_output(&|variable| table::OF_SHARED.contains(&variable.name.as_str()))),
        implies(not(knows_mass.clone()), no_output(&|variable| variable.name == "closing_speed")),
        implies(knows_mass.clone(), not(derivatives(false))),
        implies(all([not(knows_mass), any([damped.clone(), elastic_loss.clone()])]), not(derivatives(true))),
        implies(damped, not(loss)),
        of_cylinders(),
        not(all([elastic_loss, key("target", has("plate_thickness"))])),
        implies(
            mass_input.clone(),
            each_contact(not(key("parameters_per_contact", json!({ "contains": { "const": "effective_mass" } })))),
        ),
        not(all([damps_by_mass, mass_input])),
    ];
    schema["allOf"] = json!(rules);
    let keys = &mut schema["properties"];
    for body in ["impactor", "target"] {
        keys[body]["allOf"] = json!(of_body());
        keys[body]["properties"]["rate"]["oneOf"] = of_rate();
        keys["contact"]["items"]["properties"][body]["allOf"] = json!(of_body());
    }
    keys["target"]["dependentSchemas"] = json!({ "plate_thickness": not(any([has("radius"), has("length")])) });
    let contact = &mut keys["contact"]["items"]["properties"];
    contact["name"]["not"] = json!({ "enum": taken_names() });
    contact["between"]["uniqueItems"] = json!(true);
    for direction in ["normal", "tangent"] {
        contact[direction]["not"] = json!({ "items": { "const": 0 } });
    }
    keys["body"]["items"]["properties"]["name"]["not"] = json!({ "const": GROUND });
    keys["impact"]["oneOf"] = json!([has("speed"), has("drop_height")]);
    keys["law"]["allOf"] = json!(of_laws());
}

/// What goes with a cylinder, and with a ball.
fn of_cylinders() -> Value {
    let line = key("impactor", key("shape", json!({ "const": "cylinder" })));
    let law = |so: Value| json!({ "properties": { "law": { "properties": { "loading": so } } } });
    let sizes = any([
        key("target", any([has("thickness"), has("base"), key("shape", json!({ "const": "cylinder" }))])),
        key("law", has("size_constant")),
    ]);
    let own = not(any(["area", "rate"].map(has)));
    let target = not(any(["plate_thickness", "length"].map(has)));
    let of_line = [
        law(json!({ "const": LINE })),
        json!({ "properties": { "impactor": own, "target": all([own.clone(), target]) } }),
        not(has("friction")),
        not(key("law", key("elastic_restitution", json!({ "type": "string" })))),
        not(all([key("target", has("thickness")), key("law", has("size_constant"))])),
        json!({ "properties": { "target": {
            "dependentRequired": { "base": ["thickness"] }, "properties": { "shape": { "const": "cylinder" } },
        } } }),
    ];
    all([
        implies(line.clone(), all(of_line)),
        implies(not(line), all([law(not(json!({ "const": LINE }))), not(sizes)])),
    ])
}

/// What a contact says of the bodies of its scene.
const ENDS: [&str; 5] = ["between", "direction", "normal", "arms", "tangent"];

/// The keys that say how strong a body is, beside its material.
const STRENGTHS: [&str; 5] = ["yield_strength", "hardness", "tensile_strength", "tensile_test", "power_law"];

/// A scene of one contact, which has all its numbers in the tables of both bodies.
fn of_single_contact() -> Value {
    let dense = || any([has("material"), has("density")]);
    let elastic = || any([has("material"), needs(&["youngs_modulus", "poissons_ratio"])]);
    let rod = || json!({ "dependentRequired": { "length": ["area"], "area": ["length"] } });
    let cylinder = || key("shape", json!({ "const": "cylinder" }));
    let of_impactor = all([
        implies(not(cylinder()), all([rod(), implies(has("length"), elastic())])),
        implies(cylinder(), has("length")),
    ]);
    let of_elastic = STRENGTHS.into_iter().chain(["hardening_modulus", "youngs_modulus", "poissons_ratio"]);
    let strong = any(STRENGTHS.into_iter().chain(["material"]).map(has));
    let plastic = AnyLoading::ALL.iter().map(|(name, _)| *name).filter(|name| *name != "hertz");
    all([
        needs(&["impactor", "target"]),
        json!({ "properties": {
            "impactor": all([
                has("radius"),
                of_impactor,
                implies(any(of_elastic.map(has)), elastic()),
                implies(has("hardening_modulus"), strong.clone()),
            ]),
            "target": all([elastic(), rod(), implies(any([has("length"), has("plate_thickness")]), dense())]),
        } }),
        implies(
            key("impactor", cylinder()),
            all([
                any([key("target", any(["thickness", "radius"].map(has))), key("law", has("size_constant"))]),
                any([key("impactor", strong.clone()), key("target", strong.clone())]),
            ]),
        ),
        implies(
            key("law", key("elastic_restitution", json!({ "const": WAVES }))),
            json!({ "properties": { "target": dense() } }),
        ),
        implies(
            not(any([key("impactor", strong.clone()), key("target", strong)])),
            not(key("law", any([has("unloading"), has("unloading_parameters"), key("loading", names(plastic))]))),
        ),
        implies(
            not(any([has("coupling"), key("impactor", dense())])),
            json!({ "properties": { "impact": has("mass") } }),
        ),
    ])
}

/// A scene each of whose contacts is so.
fn each_contact(so: Value) -> Value {
    json!({ "properties": { "contact": { "items": so } } })
}

/// The keys of a body that say the same.
fn of_body() -> Vec<Value> {
    let numbers = ["yield_strength", "hardening_modulus", "tangent_modulus"];
    let others = ["hardness", "tensile_strength", "tensile_test", "power_law"];
    let readings = others.iter().map(|reading| {
        let same: Vec<_> =
            numbers.iter().chain(others.iter().filter(|other| *other != reading)).map(|key| has(key)).collect();
        implies(has(reading), not(any(same)))
    });
    let slow = json!({ "properties": { "reference_rate": { "const": TEST_RATE } } });
    let rest = [
        implies(
            any(["hardness", "tensile_strength", "tensile_test"].map(has)),
            json!({ "properties": { "rate": slow } }),
        ),
        implies(key("hardness", json!({ "pattern": measured::of_impacts() })), not(has("rate"))),
        not(all([has("hardening_modulus"), has("tangent_modulus")])),
        implies(has("hardening_exponent"), any([needs(&["hardness"]), needs(&["tensile_strength"])])),
    ];
    readings.chain(rest).collect()
}

fn of_rate() -> Value {
    let model = |name: &str, own: &[&str], others: [&str; 2]| {
        all([key("model", json!({ "const": name })), needs(own), not(any(others.map(has)))])
    };
    let [johnson_cook, cowper_symonds] = crate::scene::RATE_MODELS;
    // the rate of a reading is known
    json!([model(johnson_cook, &["c"], ["d", "q"]), model(cowper_symonds, &["d", "q"], ["c", "reference_rate"])])
}

/// What goes with each law.
fn of_laws() -> Vec<Value> {
    let loading = |name: &str| key("loading", json!({ "const": name }));
    let unloading = |name: &str| key("unloading", json!({ "const": name }));
    let no_unloading = || {
        not(any(["unloading", "unloading_parameters"]
            .map(has)
            .into_iter()
            .chain([key("passivity_guard", json!({ "const": true }))])))
    };
    let mut rules = vec![implies(not(has("loading")), not(any(["restitution", "damping"].map(has))))];
    for (name, law) in AnyLoading::ALL {
        let others = AnyUnloading::ALL.iter().filter(|(other, _)| pairing::check(name, other).is_err());
        let fits = if name == "hertz" {
            no_unloading()
        } else {
            not(key("unloading", names(others.map(|(other, _)| *other))))
        };
        let constants = constants("loading_parameters", &parameters::constants(&law, table::loading_law(name)));
        rules.push(implies(loading(name), all([fits, constants, not(any(["restitution", "damping"].map(has)))])));
    }
    for (name, law) in AnyDamped::ALL {
        let restitution = if law.needs_restitution() { needs(&["restitution"]) } else { not(has("restitution")) };
        let damping = match law.dampings() {
            none if none.is_empty() => not(has("damping")),
            some => json!({ "properties": { "damping": { "enum": some } } }),
        };
        let constants = constants("loading_parameters", &parameters::constants(&law, table::damped_law(name)));
        rules.push(implies(loading(name), all([no_unloading(), restitution, damping, constants])));
    }
    for (name, law) in AnyUnloading::ALL {
        let mut all_of =
            vec![constants("unloading_parameters", &parameters::constants(&law, table::unloading_law(name)))];
        if law.guarded().is_none() {
            all_of.push(not(key("passivity_guard", json!({ "const": true }))));
        }
        if let Some(made) = &table::unloading_law(name).made_for {
            let published = pairing::published(&made.loading);
            let of = |name: &String| (name.clone(), json!({ "const": parameters::value_of(&published, name) }));
            let keys = object(made.as_published.iter().map(of));
            all_of.push(json!({ "properties": { "loading_parameters": { "properties": keys } } }));
        }
        rules.push(implies(unloading(name), all(all_of)));
    }
    rules
}

/// The constants of a law under this key.
fn constants(key: &str, constants: &[LawConstant]) -> Value {
    let of = |constant: &LawConstant| (constant.name.to_string(), complete_constants(constant));
    let keys = object(constants.iter().map(of));
    json!({ "properties": { key: { "properties": keys, "additionalProperties": false } } })
}

fn without_friction() -> impl Iterator<Item = &'static str> {
    table::unloading_laws().into_iter().filter(|law| law.no_friction.is_some()).map(|law| law.name.as_str())
}

/// A scene without these outputs.
fn no_output(of: &dyn Fn(&table::Variable) -> bool) -> Value {
    let outputs = table::VARIABLES.iter().filter(|variable| of(variable)).map(|variable| variable.name.as_str());
    json!({ "properties": { "fmu": { "properties": { "outputs": { "items": not(names(outputs)) } } } } })
}

fn names(names: impl Iterator<Item = &'static str>) -> Value {
    json!({ "enum": names.collect::<Vec<_>>() })
}

fn has(key: &str) -> Value {
    needs(&[key])
}

fn needs(keys: &[&str]) -> Value {
    json!({ "required": keys })
}

/// A table whose `key` exists, and is so.
fn key(key: &str, so: Value) -> Value {
    json!({ "required": [key], "properties": { key: so } })
}

fn not(what: Value) -> Value {
    json!({ "not": what })
}

fn all(of: impl IntoIterator<Item = Value>) -> Value {
    json!({ "allOf": of.into_iter().collect::<Vec<_>>() })
}

fn any(of: impl IntoIterator<Item = Value>) -> Value {
    json!({ "anyOf": of.into_iter().collect::<Vec<_>>() })
}

fn implies(one: Value, other: Value) -> Value {
    json!({ "if": one, "then": other })
}
